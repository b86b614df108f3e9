//! The public API, name by name and type by type: what other people's code calls. A change that breaks it does not compile
//! here, and then is one for the changelog and the version.

use core::ops::Range;
use std::rc::Rc;
use std::sync::Arc;

use eyeray::{
    Algebraic, Camera, CameraArgument, CameraError, Frame, Geometric, Hit, Hittable, Ray, Rays,
    Scalar, Sphere, SphereBvh, Spheres, Vector, ViewRect, nearest,
};
use glam::{DVec2, DVec3, Vec2, Vec3};

type Near<V> = Option<(usize, Hit<V>)>;
type Framed<V> = Result<Frame<V>, CameraError>;
type Built<V> = Result<Camera<V>, CameraError>;

/// The API of a precision.
macro_rules! precision {
    ($test:ident, $V:ty, $V2:ty, $S:ty) => {
        #[test]
        fn $test() {
            const RAY: Ray<$V> = Ray::new(<$V>::ZERO, <$V>::Z);
            const SPHERE: Sphere<$V> = Sphere::new(<$V>::ZERO, 1.0);
            let Ray { origin, direction }: Ray<$V> = RAY;
            let Sphere { center, radius }: Sphere<$V> = SPHERE;
            let _: ($V, $V, $V, $S) = (origin, direction, center, radius);
            let _: fn(&Ray<$V>, $S) -> $V = Ray::at;

            let _: fn(&Sphere<$V>) -> ($V, $V) = Sphere::bounds;
            let _: fn(&Sphere<$V>, &Ray<$V>) -> Option<[$S; 2]> = Sphere::roots_algebraic;
            let _: fn(&Sphere<$V>, &Ray<$V>) -> Option<[$S; 2]> = Sphere::roots_geometric;
            let (Algebraic(_), Geometric(_)) = (Algebraic(SPHERE), Geometric(SPHERE));

            hittable::<$V>(&SPHERE);
            hittable::<$V>(&Algebraic(SPHERE));
            hittable::<$V>(&Geometric(SPHERE));
            hittable::<$V>(&&SPHERE);
            hittable::<$V>([SPHERE].as_slice());
            hittable::<$V>(&[SPHERE]);
            hittable::<$V>(&vec![SPHERE]);
            let boxed: Box<dyn Hittable<$V>> = Box::new(SPHERE);
            hittable::<$V>(&boxed);
            let shared: Rc<dyn Hittable<$V>> = Rc::new(SPHERE);
            hittable::<$V>(&shared);
            let shared: Arc<dyn Hittable<$V>> = Arc::new(SPHERE);
            hittable::<$V>(&shared);
            hittable::<$V>(&vec![shared]);
            let _: fn(&[Sphere<$V>], &Ray<$V>, Range<$S>) -> Near<$V> = nearest;

            let _: fn($S, $V, $V, $S) -> Hit<$V> = Hit::new;
            let _: fn(&Hit<$V>, &Ray<$V>) -> bool = Hit::front_face;
            let _: fn(&Hit<$V>, $V) -> Ray<$V> = Hit::spawn;
            if let Some(Hit { t, point, normal, .. }) = SPHERE.intersect(&RAY, 0.0..9.0) {
                let _: ($S, $V, $V) = (t, point, normal);
            }

            let view: ViewRect<$S> = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
            let _: fn($S, $S) -> ViewRect<$S> = ViewRect::centered;
            let _: ($S, $S) = (view.width(), view.height());
            let _: fn($V, $V, $V) -> Framed<$V> = Frame::look_at;
            let _: fn($V, $V, $V) -> Framed<$V> = Frame::look_to;
            let _: fn(&Frame<$V>) -> $V = Frame::eye;
            let _: fn(&Frame<$V>) -> [$V; 3] = Frame::basis;
            let _: fn(&Frame<$V>, ViewRect<$S>) -> Built<$V> = Frame::orthographic;
            let _: fn(&Frame<$V>, ViewRect<$S>, $S) -> Built<$V> = Frame::perspective;
            let _: fn(&Frame<$V>, $S, $S) -> Built<$V> = Frame::perspective_fov;
            let _: fn($V, $V, $V, ViewRect<$S>) -> Built<$V> = Camera::orthographic;
            let _: fn($V, $V, $V, ViewRect<$S>, $S) -> Built<$V> = Camera::perspective;
            let _: fn($V, $V, $V, $S, $S) -> Built<$V> = Camera::perspective_fov;
            let _: fn(&Camera<$V>, $V2) -> Ray<$V> = Camera::ray;
            let _: fn(&Camera<$V>, $V2, u32, u32) -> Ray<$V> = Camera::pixel_ray;
            let _: fn(&Camera<$V>, u32, u32) -> Rays<$V> = Camera::rays;
            let _: fn(&Camera<$V>, $V) -> Option<$V2> = Camera::project;
            let _: fn(&Camera<$V>, $V, u32, u32) -> Option<$V2> = Camera::project_to_pixel;
            let _: fn(&Camera<$V>, $V) -> $S = Camera::depth;
            let _: fn(&Camera<$V>) -> Frame<$V> = Camera::frame;
            let _: fn(&Camera<$V>) -> [$V; 3] = Camera::basis;
            let _: fn(&Camera<$V>) -> $V = Camera::eye;
            let _: fn(&Camera<$V>) -> ViewRect<$S> = Camera::view;
            let _: fn(&Camera<$V>) -> Option<$S> = Camera::distance;
            vector::<$V, $S>();
        }
    };
}

precision!(single_precision, Vec3, Vec2, f32);
precision!(double_precision, DVec3, DVec2, f64);

fn hittable<V: Vector>(object: &(impl Hittable<V> + ?Sized)) {
    let ray = Ray::new(V::default(), V::default());
    let range = || V::Scalar::ZERO..V::Scalar::INFINITY;
    let hit: Option<Hit<V>> = object.intersect(&ray, range());
    let blocked: bool = object.occludes(&ray, range());
    assert!(hit.is_none() && !blocked, "a zero direction meets nothing");
}

fn vector<V: Vector<Scalar = S>, S: Scalar>() {
    let _: fn(V) -> DVec3 = V::to_f64;
    let _: fn(DVec3) -> V = V::from_f64;
    let _: fn(V, V) -> S = V::dot;
    let _: fn(f64) -> S = S::from_f64;
    let _: [S; 3] = [S::ZERO, S::ONE, S::INFINITY];
}

#[test]
fn the_default_is_single_precision() {
    let _: (Ray, Sphere, Algebraic, Geometric) = Default::default();
    let _: Option<(Hit, Frame, Camera, ViewRect)> = None;
    let _: Option<Box<dyn Hittable>> = None;
}

#[test]
fn from_one_precision_to_the_other() {
    let _: fn(Ray) -> Ray<DVec3> = From::from;
    let _: fn(Sphere) -> Sphere<DVec3> = From::from;
    let _: fn(Hit) -> Hit<DVec3> = From::from;
    let _: fn(ViewRect) -> ViewRect<f64> = From::from;
    let _: fn(Frame) -> Frame<DVec3> = From::from;
    let _: fn(Camera) -> Camera<DVec3> = From::from;
    let _: fn(Ray<DVec3>) -> Ray = Ray::to_f32;
    let _: fn(Sphere<DVec3>) -> Sphere = Sphere::to_f32;
    let _: fn(ViewRect<f64>) -> ViewRect = ViewRect::to_f32;
}

#[test]
fn many_spheres() {
    let mut spheres: Spheres = [Sphere::default()].into_iter().collect();
    spheres.extend([Sphere::default()]);
    spheres.push(Sphere::default());
    let _: (usize, bool, Option<Sphere>) = (spheres.len(), spheres.is_empty(), spheres.get(0));
    let _: Option<Sphere> = spheres.iter().next();
    let _: fn(&Spheres, &Ray, Range<f32>) -> Near<Vec3> = Spheres::nearest;
    hittable::<Vec3>(&spheres);
    spheres.reserve(1);
    let _: (Option<Sphere>, Option<Sphere>) =
        (spheres.set(0, Sphere::default()), spheres.swap_remove(0));
    let _: &[Sphere] = spheres.as_slice();
    let _: Option<Sphere> = (&spheres).into_iter().next();
    let _: bool = spheres == spheres.clone();
    spheres.clear();
    let _: (Spheres, Spheres) = (Spheres::new(), Spheres::with_capacity(1));
    let _: Spheres = vec![Sphere::default()].into();
}

#[test]
fn very_many_spheres() {
    let bvh: SphereBvh = [Sphere::default()].into_iter().collect();
    let _: (usize, bool, Option<Sphere>) = (bvh.len(), bvh.is_empty(), bvh.get(0));
    let _: Option<Sphere> = bvh.iter().next();
    let _: fn(&SphereBvh, &Ray, Range<f32>) -> Near<Vec3> = SphereBvh::nearest;
    hittable::<Vec3>(&bvh);
    let _: SphereBvh = Spheres::new().into();
}

#[test]
fn errors() {
    let error = Camera::perspective_fov(Vec3::ZERO, Vec3::ZERO, Vec3::Y, 1.0, 1.0).err();
    let _: Option<&dyn core::error::Error> = error.as_ref().map(|error| error as _);
    for argument in [
        CameraArgument::Eye,
        CameraArgument::Target,
        CameraArgument::Direction,
        CameraArgument::Up,
        CameraArgument::View,
        CameraArgument::Distance,
        CameraArgument::FovY,
        CameraArgument::Aspect,
    ] {
        let _: CameraError = CameraError::NotFinite(argument);
    }
}

#[test]
fn the_vectors_are_those_of_glam() {
    let _: eyeray::glam::Vec3 = Vec3::ZERO;
}
