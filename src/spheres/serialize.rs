//! [`Serialize`] and [`Deserialize`] for [`Spheres`] and [`SphereBvh`].

use alloc::vec::Vec;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{SphereBvh, Spheres};
use crate::Sphere;

/// Written as a list of spheres.
impl Serialize for Spheres {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self)
    }
}

impl<'de> Deserialize<'de> for Spheres {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<Sphere>::deserialize(deserializer).map(Self::from)
    }
}

/// Written as a list of spheres, in the order in which they were given, and sorted again when it is read.
impl Serialize for SphereBvh {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de> Deserialize<'de> for SphereBvh {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<Sphere>::deserialize(deserializer).map(|spheres| spheres.into_iter().collect())
    }
}
