//! The traits of the crate approx: two values are close if each of their fields is.
//!
//! For a [`Hit`], these are the distance, the point and the normal. The clearance is a bound on rounding errors, and is not
//! compared.

use approx::{AbsDiffEq, RelativeEq, UlpsEq};
use glam::{DVec3, Vec3};

use crate::{Hit, Ray, Sphere, ViewRect};

macro_rules! field_by_field {
    ($scalar:ident: $type:ty { $($field:ident),+ }) => {
        impl AbsDiffEq for $type {
            type Epsilon = $scalar;

            fn default_epsilon() -> $scalar {
                $scalar::default_epsilon()
            }

            fn abs_diff_eq(&self, other: &Self, epsilon: $scalar) -> bool {
                true $(&& AbsDiffEq::abs_diff_eq(&self.$field, &other.$field, epsilon))+
            }
        }

        impl RelativeEq for $type {
            fn default_max_relative() -> $scalar {
                $scalar::default_max_relative()
            }

            fn relative_eq(&self, other: &Self, epsilon: $scalar, max_relative: $scalar) -> bool {
                true $(&& RelativeEq::relative_eq(&self.$field, &other.$field, epsilon, max_relative))+
            }
        }

        impl UlpsEq for $type {
            fn default_max_ulps() -> u32 {
                $scalar::default_max_ulps()
            }

            fn ulps_eq(&self, other: &Self, epsilon: $scalar, max_ulps: u32) -> bool {
                true $(&& UlpsEq::ulps_eq(&self.$field, &other.$field, epsilon, max_ulps))+
            }
        }
    };
}

field_by_field!(f32: Ray<Vec3> { origin, direction });
field_by_field!(f64: Ray<DVec3> { origin, direction });
field_by_field!(f32: Sphere<Vec3> { center, radius });
field_by_field!(f64: Sphere<DVec3> { center, radius });
field_by_field!(f32: Hit<Vec3> { t, point, normal });
field_by_field!(f64: Hit<DVec3> { t, point, normal });
field_by_field!(f32: ViewRect<f32> { left, right, bottom, top });
field_by_field!(f64: ViewRect<f64> { left, right, bottom, top });
