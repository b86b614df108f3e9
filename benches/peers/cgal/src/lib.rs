//! Whether a line or a ray meets a sphere, decided by CGAL: `CGAL::do_intersect` with two of its kernels.
//!
//! Without CGAL this compiles to nothing that can be asked.

/// A ray and a sphere.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Case {
    pub origin: [f64; 3],
    pub direction: [f64; 3],
    pub center: [f64; 3],
    pub radius: f64,
}

/// What is asked, of which kernel.
#[derive(Clone, Copy, Debug)]
pub struct Decision {
    /// Its short name.
    pub name: &'static str,
    /// Whether the path is the whole line rather than the ray.
    pub is_line: bool,
    #[cfg(cgal)]
    function: unsafe extern "C" fn(*const Case, usize, *mut bool),
}

#[cfg(not(cgal))]
pub const DECISIONS: [Decision; 0] = [];

#[cfg(cgal)]
pub const DECISIONS: [Decision; 4] = [
    Decision { name: "line, inexact", is_line: true, function: eyeray_cgal_line_inexact },
    Decision { name: "ray, inexact", is_line: false, function: eyeray_cgal_ray_inexact },
    Decision { name: "line, exact", is_line: true, function: eyeray_cgal_line_exact },
    Decision { name: "ray, exact", is_line: false, function: eyeray_cgal_ray_exact },
];

#[cfg(cgal)]
unsafe extern "C" {
    fn eyeray_cgal_line_inexact(cases: *const Case, count: usize, answers: *mut bool);
    fn eyeray_cgal_ray_inexact(cases: *const Case, count: usize, answers: *mut bool);
    fn eyeray_cgal_line_exact(cases: *const Case, count: usize, answers: *mut bool);
    fn eyeray_cgal_ray_exact(cases: *const Case, count: usize, answers: *mut bool);
}

impl Decision {
    /// Decides each case.
    #[allow(
        unused_variables,
        clippy::missing_panics_doc,
        reason = "only with CGAL is there a decision"
    )]
    pub fn decide(&self, cases: &[Case], answers: &mut [bool]) {
        #[cfg(cgal)]
        {
            let count = cases.len().min(answers.len());
            // SAFETY: the function reads so many cases, whose layout is that of the C++ struct, and writes a bool, which is
            // C++'s, to so many answers.
            unsafe { (self.function)(cases.as_ptr(), count, answers.as_mut_ptr()) }
        }
    }
}
