//! [`Serialize`] and [`Deserialize`] for [`Spheres`] and [`SphereBvh`].

use alloc::vec::Vec;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{SphereBvh, Spheres};
use crate::{Sphere, Vector};

/// Serializes the spheres as a list.
impl<V: Vector + Serialize> Serialize for Spheres<V>
where
    V::Scalar: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self)
    }
}

impl<'de, V: Vector + Deserialize<'de>> Deserialize<'de> for Spheres<V>
where
    V::Scalar: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<Sphere<V>>::deserialize(deserializer).map(Self::from)
    }
}

/// Serializes the spheres as a list, in the order in which they were collected. Deserializing it builds the hierarchy again.
impl<V: Vector + Serialize> Serialize for SphereBvh<V>
where
    V::Scalar: Serialize,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de, V: Vector + Deserialize<'de>> Deserialize<'de> for SphereBvh<V>
where
    V::Scalar: Deserialize<'de>,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::<Sphere<V>>::deserialize(deserializer).map(Self::from)
    }
}
