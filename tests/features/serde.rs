//! Data is the same after serializing and deserializing, bit for bit, in JSON and in a binary format; invalid cameras are
//! rejected.
//!
//! Of `serde_json`, this takes the feature `float_roundtrip`; `tests/json` does without.

use core::fmt::Debug;
use core::ops::Range;

use eyeray::{
    Algebraic, Camera, CameraArgument, CameraError, Frame, Geometric, Hit, Hittable, Ray, Sphere,
    SphereBvh, Spheres, ViewRect,
};
use glam::{DVec3, Vec3, dvec3, vec3};
use proptest::prelude::*;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

/// Writes and reads. `Debug` tells -0 from 0, which `==` does not.
#[track_caller]
fn round_trip<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let written = to_string(value).expect("finite");
    let read: T = from_str(&written).expect("as it was written");
    assert_eq!(read, *value, "{written}");
    assert_eq!(format!("{read:?}"), format!("{value:?}"), "{written}");

    let written = postcard::to_stdvec(value).expect("any value");
    let read: T = postcard::from_bytes(&written).expect("as it was written");
    assert_eq!(read, *value);
    assert_eq!(format!("{read:?}"), format!("{value:?}"));
}

#[test]
fn the_shape_of_the_plain_data() {
    let sphere = Sphere::new(vec3(1.0, 2.0, 3.0), 0.5);
    for (written, expected) in [
        (
            to_value(Ray::new(Vec3::X, Vec3::NEG_Z)),
            json!({ "origin": [1.0, 0.0, 0.0], "direction": [0.0, 0.0, -1.0] }),
        ),
        (to_value(sphere), json!({ "center": [1.0, 2.0, 3.0], "radius": 0.5 })),
        (to_value(Algebraic(sphere)), json!({ "center": [1.0, 2.0, 3.0], "radius": 0.5 })),
        (to_value(Geometric(sphere)), json!({ "center": [1.0, 2.0, 3.0], "radius": 0.5 })),
        (
            to_value(ViewRect::centered(4.0, 3.0)),
            json!({ "left": -2.0, "right": 2.0, "bottom": -1.5, "top": 1.5 }),
        ),
        (
            to_value(Hit::new(2.0, Vec3::X, Vec3::Y, 0.25)),
            json!({ "t": 2.0, "point": [1.0, 0.0, 0.0], "normal": [0.0, 1.0, 0.0], "error": 0.25 }),
        ),
    ] {
        assert_eq!(written.expect("finite"), expected);
    }
}

#[test]
fn the_shape_of_a_camera() {
    let view = ViewRect::centered(4.0, 3.0);
    let eye = vec3(0.0, 0.0, 5.0);
    let camera = Camera::perspective(eye, Vec3::ZERO, Vec3::Y, view, 2.0).expect("a camera");
    assert_eq!(to_value(camera).expect("finite"), perspective());

    let camera = Camera::orthographic(eye, Vec3::ZERO, Vec3::Y, view).expect("a camera");
    let mut orthographic = perspective();
    orthographic["projection"] = json!("orthographic");
    assert_eq!(to_value(camera).expect("finite"), orthographic);

    let mut frame = perspective();
    frame.as_object_mut().expect("an object").retain(|field, _| field == "eye" || field == "basis");
    assert_eq!(to_value(camera.frame()).expect("finite"), frame);
}

fn perspective() -> Value {
    json!({
        "eye": [0.0, 0.0, 5.0],
        "basis": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        "view": { "left": -2.0, "right": 2.0, "bottom": -1.5, "top": 1.5 },
        "projection": { "perspective": { "distance": 2.0 } },
    })
}

/// The error for the camera above with another value at this place.
fn refusal(place: &str, value: Value) -> String {
    let mut camera = perspective();
    *camera.pointer_mut(place).expect("a place in it") = value;
    let refusal = from_value::<Camera>(camera.clone()).expect_err("no camera").to_string();
    if place.starts_with("/eye") || place.starts_with("/basis") {
        let frame = from_value::<Frame>(camera).expect_err("no frame").to_string();
        assert_eq!(frame, refusal);
    }
    refusal
}

#[test]
fn errors_are_data_too() {
    for error in [
        CameraError::NotFinite(CameraArgument::FovY),
        CameraError::UpAlongView,
        CameraError::EmptyView,
    ] {
        round_trip(&error);
    }
    let error = CameraError::NotFinite(CameraArgument::FovY);
    assert_eq!(to_value(error).expect("finite"), json!({ "NotFinite": "FovY" }));
}

#[test]
fn what_is_no_camera() {
    assert_eq!(refusal("/eye/1", json!(1e300)), "the camera's eye is not finite");
    assert_eq!(refusal("/view/left", json!(2.0)), "the camera's view rectangle is empty");
    assert_eq!(refusal("/view/top", json!(-7.0)), "the camera's view rectangle is empty");
    for distance in [0.0, -2.0] {
        assert_eq!(
            refusal("/projection/perspective/distance", json!(distance)),
            "the camera's distance to the view plane is not positive"
        );
    }
    assert_eq!(
        refusal("/projection/perspective/distance", json!(1e300)),
        "the camera's distance is not finite"
    );
    let wide = json!({ "left": -f64::MAX, "right": f64::MAX, "bottom": -1.0, "top": 1.0 });
    assert_eq!(refusal("/view", wide), "the camera's view is not finite");
    assert!(refusal("/projection", json!("fisheye")).contains("unknown variant `fisheye`"));
}

/// That of a left-handed view matrix.
#[test]
fn a_left_handed_basis_is_one() {
    for basis in [[Vec3::NEG_X, Vec3::Y, Vec3::Z], [Vec3::Y, Vec3::X, Vec3::Z]] {
        let mut camera = perspective();
        camera["basis"] = json!(basis);
        let read: Camera = from_value(camera.clone()).expect("a camera");
        assert_eq!(read.basis(), basis);
        assert_eq!(to_value(read).expect("finite"), camera);
        round_trip(&read);
    }
}

#[test]
fn what_is_no_basis() {
    for basis in [
        [Vec3::ZERO; 3],
        // Too long, and not at right angles.
        [Vec3::X * 2.0, Vec3::Y, Vec3::Z],
        [Vec3::X, Vec3::Y, Vec3::new(1e-7, 0.0, 1.0)],
        [Vec3::X, Vec3::Y, Vec3::Y],
    ] {
        assert_eq!(
            refusal("/basis", json!(basis)),
            "the camera's basis is not three unit vectors at right angles"
        );
    }
    for axis in 0..3 {
        // Off by a few ulp, more than by rounding or a fast parser.
        let place = format!("/basis/{axis}/{axis}");
        assert!(refusal(&place, json!(1.0 + 10.0 * f64::EPSILON)).contains("basis"));
    }
}

#[test]
fn a_camera_that_lacks_something() {
    for field in ["eye", "basis", "view", "projection"] {
        let mut camera = perspective();
        camera.as_object_mut().expect("an object").remove(field);
        let error = from_value::<Camera>(camera).expect_err("no camera").to_string();
        assert!(error.contains(&format!("missing field `{field}`")), "{error}");
    }
}

#[test]
fn a_hit_that_was_read_spawns_the_same_rays() {
    let sphere = Sphere::new(vec3(1.0, 2.0, -30.0), 0.7);
    let ray = Ray::new(Vec3::ZERO, vec3(0.02, 0.06, -1.0));
    let hit = sphere.intersect(&ray, 0.0..f32::INFINITY).expect("a hit");
    let read: Hit = from_str(&to_string(&hit).expect("finite")).expect("as it was written");
    assert_eq!(read.spawn(Vec3::Y), hit.spawn(Vec3::Y));
}

/// Collections in `f64`, as a scan and as a tree: a list of spheres in their order.
#[test]
fn collections_of_many_digits() {
    for count in [0_u16, 3, 500] {
        let slice: Vec<Sphere<DVec3>> = (0..count)
            .map(|i| Sphere::new(dvec3(0.1, 0.2, 1e11) + f64::from(i).sqrt(), 0.3))
            .collect();
        round_trip(&Spheres::from(slice.as_slice()));
        let bvh = SphereBvh::new(&slice);
        round_trip(&bvh);
        assert_eq!(to_value(&bvh).expect("finite"), to_value(&slice).expect("finite"));
    }
}

/// Any finite number, and often an ordinary one.
fn f32s() -> impl Strategy<Value = f32> {
    use proptest::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![-10.0_f32..10.0, NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE]
}

fn f64s() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![-10.0_f64..10.0, NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE]
}

fn vec3s() -> impl Strategy<Value = Vec3> {
    [f32s(), f32s(), f32s()].prop_map(Vec3::from)
}

fn dvec3s() -> impl Strategy<Value = DVec3> {
    [f64s(), f64s(), f64s()].prop_map(DVec3::from)
}

macro_rules! round_trips {
    ($plain_data:ident, $cameras:ident, $float:ident, $floats:ident, $vectors:ident) => {
        proptest! {
            #[test]
            fn $plain_data(a in $vectors(), b in $vectors(), s in $floats(), r in $floats()) {
                round_trip(&Ray::new(a, b));
                round_trip(&Sphere::new(a, r));
                round_trip(&Algebraic(Sphere::new(b, r)));
                round_trip(&Geometric(Sphere::new(b, r)));
                round_trip(&Hit::new(s, a, b, r));
                round_trip(&ViewRect { left: s, right: r, bottom: a.x, top: a.y });
            }

            #[test]
            fn $cameras(
                eye in $vectors(), target in $vectors(), up in $vectors(),
                sides in [$floats(), $floats(), $floats(), $floats()], distance in $floats(),
                fov_y in Range::<$float> { start: 0.0, end: 3.2 },
            ) {
                let [left, right, bottom, top] = sides;
                let view = ViewRect { left, right, bottom, top };
                let cameras = [
                    Camera::orthographic(eye, target, up, view),
                    Camera::perspective(eye, target, up, view, distance),
                    Camera::perspective_fov(eye, target, up, fov_y, distance),
                ];
                for camera in cameras.into_iter().flatten() {
                    round_trip(&camera);
                    round_trip(&camera.frame());
                }
            }
        }
    };
}

round_trips!(plain_data_in_f32, cameras_in_f32, f32, f32s, vec3s);
round_trips!(plain_data_in_f64, cameras_in_f64, f64, f64s, dvec3s);

/// One that comes back an ulp off from a `serde_json` without `float_roundtrip`.
#[test]
fn a_camera_of_many_digits() {
    let (eye, target, up) = (vec3(1.0, 2.0, 4.0), Vec3::ZERO, Vec3::Y);
    round_trip(&Camera::perspective_fov(eye, target, up, 0.9, 1.6).expect("a camera"));
}

#[test]
fn a_camera_that_was_read_makes_the_same_rays() {
    let eye = dvec3(0.1, 0.2, 0.3);
    let camera = Camera::perspective_fov(eye, DVec3::X, DVec3::Y, 0.7, 1.5).expect("a camera");
    let read: Camera<DVec3> = from_str(&to_string(&camera).expect("finite")).expect("a camera");
    assert!(read.rays(5, 4).eq(camera.rays(5, 4)));
}
