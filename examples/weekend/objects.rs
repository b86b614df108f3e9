//! The spheres of the scene, kept in one of four ways that all find the same hits.

use std::fmt;
use std::str::FromStr;

use eyeray::{Hit, Hittable, Ray, Sphere, SphereBvh, Spheres, nearest};

/// The collection that the spheres are kept in.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Slice,
    Boxes,
    Spheres,
    Bvh,
}

/// The spheres of the scene.
pub(crate) enum Objects {
    /// One after the other in memory, each tested in turn.
    Slice(Vec<Sphere>),
    /// The book's way, a list of pointers to anything hittable.
    Boxes(Vec<Box<dyn Hittable + Send + Sync>>),
    /// Filtered many at a time.
    Spheres(Spheres),
    /// Sorted into a hierarchy.
    Bvh(SphereBvh),
}

impl Objects {
    pub(crate) fn new(kind: Kind, spheres: Vec<Sphere>) -> Self {
        match kind {
            Kind::Slice => Self::Slice(spheres),
            Kind::Boxes => {
                Self::Boxes(spheres.into_iter().map(|sphere| Box::new(sphere) as _).collect())
            }
            Kind::Spheres => Self::Spheres(spheres.into()),
            Kind::Bvh => Self::Bvh(spheres.into_iter().collect()),
        }
    }

    /// Returns the nearest hit and the index of the object. The range begins at 0, because no ray hits the surface that it
    /// leaves.
    pub(crate) fn nearest(&self, ray: &Ray) -> Option<(usize, Hit)> {
        let range = 0.0..f32::INFINITY;
        match self {
            Self::Slice(spheres) => nearest(spheres, ray, range),
            Self::Boxes(objects) => nearest(objects, ray, range),
            Self::Spheres(spheres) => spheres.nearest(ray, range),
            Self::Bvh(spheres) => spheres.nearest(ray, range),
        }
    }
}

impl FromStr for Kind {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "slice" => Ok(Self::Slice),
            "boxes" => Ok(Self::Boxes),
            "spheres" => Ok(Self::Spheres),
            "bvh" => Ok(Self::Bvh),
            _ => Err(format!("\"{name}\" is none of slice, boxes, spheres and bvh")),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Slice => "a slice",
            Self::Boxes => "boxes of dyn Hittable",
            Self::Spheres => "Spheres",
            Self::Bvh => "a SphereBvh",
        })
    }
}
