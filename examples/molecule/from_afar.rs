//! Which atom is in front, from so far away that distances round to the same number.

use std::error::Error;
use std::fmt::Write as _;

use eyeray::{Ray, Sphere};
use glam::DVec3;

use crate::arguments::Arguments;
use crate::crystal::{self, Atom};
use crate::viewer::Viewer;

/// The rays of the picture from far away, and how many of them are given an atom that another one hides.
pub(crate) fn report(arguments: &Arguments) -> Result<String, Box<dyn Error>> {
    let mut text = String::from("radii away  hits  wrong atom: SphereBvh  least f32 distance");
    for distance in [1e6, 1e7] {
        let viewer = Viewer::new(crystal::atoms(), &Arguments { distance, ..arguments.clone() })?;
        let [mut hits, mut ours, mut rounded] = [0; 3];
        for ray in viewer.rays() {
            let Some(in_front) = in_front(viewer.atoms(), &ray) else { continue };
            hits += 1;
            ours += u32::from(viewer.nearest(&ray).is_none_or(|(index, _)| index != in_front));
            rounded += u32::from(by_rounded_distance(viewer.atoms(), &ray) != Some(in_front));
        }
        write!(text, "\n{distance:10e}  {hits}  {ours}  {rounded}")?;
    }
    Ok(text)
}

/// The index of the atom in front: from a point of the ray beside the atoms, where their distances in `f64` are small and differ
/// in their leading digits.
fn in_front(atoms: &[Atom], ray: &Ray) -> Option<usize> {
    let Ray { origin, direction } = Ray::<DVec3>::from(*ray);
    let closest = origin - direction * (origin.dot(direction) / direction.dot(direction));
    let from_close_by = Ray::new(closest, direction);
    let entries = atoms.iter().enumerate().filter_map(|(index, atom)| {
        let [entry, _] = Sphere::<DVec3>::from(atom.sphere).roots(&from_close_by)?;
        Some((index, entry))
    });
    entries.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
}

/// The index of the atom with the least distance, correctly rounded to `f32`; of equal ones the first.
fn by_rounded_distance(atoms: &[Atom], ray: &Ray) -> Option<usize> {
    let entries = atoms.iter().enumerate().filter_map(|(index, atom)| {
        let [entry, _] = atom.sphere.roots(ray)?;
        Some((index, entry))
    });
    entries.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
}
