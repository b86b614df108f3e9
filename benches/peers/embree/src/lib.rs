//! Spheres in Embree 3, asked ray by ray with `rtcIntersect1`, or 16 coherent rays at a time with
//! `rtcIntersect16`. Built where Debian's libembree-dev is installed; elsewhere
//! there is no scene to be had.

#[cfg(embree)]
mod c {
    #![expect(unsafe_code, reason = "Embree is a library in C")]

    use std::ptr::NonNull;

    /// Spheres in Embree.
    pub enum Spheres {}

    unsafe extern "C" {
        pub fn spheres_new() -> Option<NonNull<Spheres>>;
        pub fn spheres_free(spheres: NonNull<Spheres>);
        pub fn spheres_build(spheres: NonNull<Spheres>, numbers: *const f32, count: usize) -> i32;
        pub fn spheres_nearest(
            spheres: NonNull<Spheres>,
            origin: *const f32,
            direction: *const f32,
            t: *mut f32,
        ) -> u32;
        pub fn spheres_occluded(
            spheres: NonNull<Spheres>,
            origin: *const f32,
            direction: *const f32,
            t: f32,
        ) -> i32;
        pub fn spheres_nearest_16(
            spheres: NonNull<Spheres>,
            numbers: *const f32,
            found: *mut u32,
            t: *mut f32,
        );
        pub fn spheres_occluded_16(spheres: NonNull<Spheres>, numbers: *const f32, t: *mut f32);
    }
}

#[cfg(embree)]
pub use with::Device;
#[cfg(not(embree))]
pub use without::Device;

#[cfg(embree)]
mod with {
    #![expect(unsafe_code, reason = "Embree is a library in C")]

    use std::ptr::NonNull;

    use crate::c;

    /// A device, of one thread, with at most one scene.
    #[derive(Debug)]
    pub struct Device(NonNull<c::Spheres>);

    // SAFETY: Embree's functions may be called from any thread.
    unsafe impl Send for Device {}
    // SAFETY: likewise; queries do not change a scene.
    unsafe impl Sync for Device {}

    impl Device {
        /// Creates a device. `None` if Embree is missing.
        pub fn new() -> Option<Self> {
            // SAFETY: nothing is asked of the caller.
            unsafe { c::spheres_new() }.map(Self)
        }

        /// Builds the scene: x, y, z and radius of each sphere. `None` if that fails.
        pub fn build(self, spheres: &[[f32; 4]]) -> Option<Scene> {
            // SAFETY: the numbers are there, 4 a sphere, and are copied.
            let built =
                unsafe { c::spheres_build(self.0, spheres.as_flattened().as_ptr(), spheres.len()) };
            (built != 0).then_some(Scene(self))
        }
    }

    impl Drop for Device {
        fn drop(&mut self) {
            // SAFETY: it came from `spheres_new`, and is freed once.
            unsafe { c::spheres_free(self.0) }
        }
    }

    /// A scene that is built.
    #[derive(Debug)]
    pub struct Scene(Device);

    impl Scene {
        /// Returns which sphere the ray meets first, and at which t.
        #[inline]
        pub fn nearest(&self, origin: [f32; 3], direction: [f32; 3]) -> Option<(u32, f32)> {
            let mut t = f32::INFINITY;
            // SAFETY: the scene is built, and the arrays have the 3 numbers.
            let index = unsafe {
                c::spheres_nearest(self.0.0, origin.as_ptr(), direction.as_ptr(), &raw mut t)
            };
            (index != u32::MAX).then_some((index, t))
        }

        /// Returns whether the ray meets any sphere before `t`.
        #[inline]
        pub fn occludes(&self, origin: [f32; 3], direction: [f32; 3], t: f32) -> bool {
            // SAFETY: the scene is built, and the arrays have the 3 numbers.
            unsafe { c::spheres_occluded(self.0.0, origin.as_ptr(), direction.as_ptr(), t) != 0 }
        }

        /// Returns which spheres 16 rays that lie together meet first, `u32::MAX` for none, and at which t: of the x of their
        /// origins, the y, the z, and the same of their directions.
        #[inline]
        pub fn nearest_16(&self, rays: &[[f32; 16]; 6]) -> ([u32; 16], [f32; 16]) {
            let (mut found, mut t) = ([0; 16], [f32::INFINITY; 16]);
            // SAFETY: the scene is built, and the arrays have the 96 and the 16 numbers.
            unsafe {
                let numbers = rays.as_flattened().as_ptr();
                c::spheres_nearest_16(self.0.0, numbers, found.as_mut_ptr(), t.as_mut_ptr());
            }
            (found, t)
        }

        /// Returns whether each of 16 rays that lie together meets any sphere before `t`.
        #[inline]
        pub fn occludes_16(&self, rays: &[[f32; 16]; 6], t: f32) -> [bool; 16] {
            let mut t = [t; 16];
            // SAFETY: the scene is built, and the arrays have the 96 and the 16 numbers.
            unsafe {
                let numbers = rays.as_flattened().as_ptr();
                c::spheres_occluded_16(self.0.0, numbers, t.as_mut_ptr());
            }
            t.map(|t| t < 0.0)
        }
    }
}

#[cfg(embree)]
pub use with::Scene;
#[cfg(not(embree))]
pub use without::Scene;

#[cfg(not(embree))]
mod without {
    /// There is none.
    #[derive(Debug)]
    pub enum Device {}

    impl Device {
        /// Returns `None`: Embree is missing.
        pub fn new() -> Option<Self> {
            None
        }

        /// There is no device to build with.
        pub fn build(self, _: &[[f32; 4]]) -> Option<Scene> {
            match self {}
        }
    }

    /// There is none.
    #[derive(Debug)]
    pub enum Scene {}

    impl Scene {
        /// There is no scene to ask.
        pub fn nearest(&self, _: [f32; 3], _: [f32; 3]) -> Option<(u32, f32)> {
            match *self {}
        }

        /// There is no scene to ask.
        pub fn occludes(&self, _: [f32; 3], _: [f32; 3], _: f32) -> bool {
            match *self {}
        }

        /// There is no scene to ask.
        pub fn nearest_16(&self, _: &[[f32; 16]; 6]) -> ([u32; 16], [f32; 16]) {
            match *self {}
        }

        /// There is no scene to ask.
        pub fn occludes_16(&self, _: &[[f32; 16]; 6], _: f32) -> [bool; 16] {
            match *self {}
        }
    }
}
