//! Many spheres: each way to hold them has a cheap test in many lanes that never drops a sphere that is hit, and asks the exact
//! routine for the few that pass. [`scan`] tests all, [`hierarchy`] those in the boxes along the ray.

mod filter;
mod hierarchy;
mod lanes;
mod scan;
#[cfg(feature = "serde")]
mod serialize;
#[cfg(test)]
mod tests;

pub use hierarchy::SphereBvh;
pub use scan::Spheres;
