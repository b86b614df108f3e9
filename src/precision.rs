//! Provisional.
use crate::{Hit, Ray, Scalar, Sphere, Vector};
use core::ops::Range;
use glam::{DVec3, Vec3};

pub trait Precision: Sized {
    fn roots<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>) -> Option<[V::Scalar; 2]> {
        let o = sphere.center.to_f64() - ray.origin.to_f64();
        let d = ray.direction.to_f64();
        let r: f64 = sphere.radius.into();
        let a = d.dot(d);
        let h = o.dot(d);
        let c = o.dot(o) - r * r;
        let discriminant = a * r * r - o.cross(d).length_squared();
        if !(discriminant >= 0.0 && a > 0.0 && r >= 0.0) {
            return None;
        }
        let s = discriminant.sqrt();
        let q = if h < 0.0 { h - s } else { h + s };
        let (x, y) = if q == 0.0 { (0.0, 0.0) } else { (q / a, c / q) };
        Some([V::Scalar::from_f64(x.min(y)), V::Scalar::from_f64(x.max(y))])
    }
    fn intersect<V: Vector>(sphere: &Sphere<V>, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        let t = Self::roots(sphere, ray)?
            .into_iter()
            .find(|t| *t > V::Scalar::ZERO && *t < V::Scalar::INFINITY && range.contains(t))?;
        let r: f64 = sphere.radius.into();
        let c = sphere.center.to_f64();
        let n = ((ray.origin.to_f64() - c) + ray.direction.to_f64() * t.into()).normalize_or_zero();
        let m = c.abs().max_element() + r;
        Some(Hit {
            t,
            point: V::from_f64(c + n * r),
            normal: V::from_f64(n),
            clearance: V::Scalar::from_f64(m * 2f64.powi(-21)),
        })
    }
}
impl Precision for Vec3 {}
impl Precision for DVec3 {}
