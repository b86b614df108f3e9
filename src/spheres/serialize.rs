//! [`Serialize`] and [`Deserialize`] for [`Spheres`] and [`SphereBvh`].

use alloc::vec::Vec;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{SphereBvh, Spheres};
use crate::Sphere;

/// Serializes the spheres as a list.
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

/// Serializes the spheres as a list, in the order in which they were collected. Deserializing it builds the hierarchy again.
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
