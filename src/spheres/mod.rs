//! Collections of spheres. Each has a cheap test over many lanes, which never drops a sphere that is hit, and calls the exact
//! routine for the few that pass. [`scan`] tests all, [`hierarchy`] those in the boxes along the ray.

mod crossings;
mod each;
mod filter;
mod hierarchy;
mod hits;
mod lanes;
mod local;
mod middle;
mod packet;
mod queue;
mod scan;
#[cfg(feature = "serde")]
mod serialize;
#[cfg(test)]
mod tests;

pub use hierarchy::{SphereBvh, SphereBvhIter};
pub use scan::Spheres;
