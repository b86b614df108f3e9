//! Slices, arrays, references and pointers are hittable as their content is.

use std::rc::Rc;
use std::sync::Arc;

use eyeray::{Hit, Hittable, Ray, Sphere};
use glam::{Vec3, vec3};

const ALL: core::ops::Range<f32> = 0.0..f32::INFINITY;

/// Two spheres along -z, the farther one first.
const SCENE: [Sphere; 2] =
    [Sphere::new(vec3(0.0, 0.0, -9.0), 1.0), Sphere::new(vec3(0.0, 0.0, -3.0), 1.0)];

fn t(scene: &(impl Hittable + ?Sized), range: core::ops::Range<f32>) -> Option<f32> {
    let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    let hit = scene.intersect(&ray, range.clone());
    assert_eq!(scene.occludes(&ray, range), hit.is_some());
    hit.map(|hit: Hit| hit.t)
}

/// The nearest of all, and of those in a range.
fn check(scene: &(impl Hittable + ?Sized)) {
    assert_eq!(t(scene, ALL), Some(2.0));
    assert_eq!(t(scene, 5.0..9.0), Some(8.0));
    assert_eq!(t(scene, 0.0..2.0), None);
    let aside = Ray::new(Vec3::X * 2.0, Vec3::NEG_Z);
    assert!(scene.intersect(&aside, ALL).is_none() && !scene.occludes(&aside, ALL));
}

#[test]
fn collections_have_the_nearest_hit() {
    check(SCENE.as_slice());
    check(&SCENE);
    check(&SCENE.to_vec());
    check(&Box::new(SCENE));
    check(&Rc::new(SCENE));
    check(&Arc::new(SCENE));
    check(&[&SCENE[0], &SCENE[1]]);
    let none: [Sphere; 0] = [];
    assert_eq!(t(&none, ALL), None);
}

#[test]
fn things_of_several_kinds_share_a_scene() {
    let [far, near] = SCENE;
    let shared: [Arc<dyn Hittable>; 2] = [Arc::new(far), Arc::new([near])];
    check(&shared);
    check(&shared.to_vec());
    let boxed: Vec<Box<dyn Hittable>> = vec![Box::new(far), Box::new(vec![near])];
    check(&boxed);
    let counted: Rc<dyn Hittable> = Rc::new(boxed);
    check(&counted);
    check(&*counted);
    let slice: Arc<[Sphere]> = Arc::new(SCENE);
    check(&slice);
}

/// A container forwards `occludes` to its content, which may have a faster implementation than the default.
#[test]
fn occlusion_is_passed_on() {
    struct Fog;
    impl Hittable for Fog {
        fn intersect(&self, _: &Ray, _: core::ops::Range<f32>) -> Option<Hit> {
            None
        }

        fn occludes(&self, _: &Ray, _: core::ops::Range<f32>) -> bool {
            true
        }
    }

    let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    let scenes: [&dyn Hittable; 6] =
        [&&Fog, &[Fog], &vec![Fog], &Box::new(Fog), &Rc::new(Fog), &Arc::new(Fog)];
    assert!(scenes.iter().all(|scene| scene.occludes(&ray, ALL)));
}
