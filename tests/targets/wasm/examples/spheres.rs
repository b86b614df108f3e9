//! Finds the nearest of many spheres in a WebAssembly engine, which takes the time: by `Spheres`, by `nearest` of a slice, and by
//! a loop over the formula.

#[path = "../../../support/families.rs"]
mod families;

use std::cell::RefCell;
use std::hint::black_box;
use std::ops::Range;

use eyeray::{Ray, Scalar, Sphere, Spheres, nearest};
use families::Rng;
use glam::Vec3;

const ALL: Range<f32> = 0.0..f32::INFINITY;
const RAYS: usize = 256;

/// Spheres, and the rays to ask for.
struct Scene {
    slice: Vec<Sphere>,
    spheres: Spheres,
    rays: Vec<Ray>,
}

thread_local! {
    static SCENE: RefCell<Option<Scene>> = const { RefCell::new(None) };
}

fn within(rng: &mut Rng, extent: f64) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| f32::from_f64(rng.uniform(-extent, extent))))
}

/// Places that many spheres, the same density for every number.
#[unsafe(no_mangle)]
extern "C" fn place(count: u32) {
    let mut rng = Rng::new(count.into());
    let extent = 2.0 * f64::from(count).cbrt();
    let slice: Vec<_> = (0..count)
        .map(|_| Sphere::new(within(&mut rng, extent), f32::from_f64(rng.uniform(0.2, 0.8))))
        .collect();
    let mut rays = Vec::new();
    for _ in 0..RAYS {
        let eye = within(&mut rng, extent * 2.5);
        let target = within(&mut rng, extent * 0.7);
        rays.push(Ray::new(eye, target - eye));
    }
    let spheres = slice.iter().copied().collect();
    SCENE.set(Some(Scene { slice, spheres, rays }));
}

/// Asks for the nearest hit of every ray. The sum of their indices shows that the answers are the same.
fn ask(nearest: impl Fn(&Scene, &Ray) -> Option<usize>) -> u32 {
    SCENE.with_borrow(|scene| {
        let scene = scene.as_ref().expect("spheres have been placed");
        let sum: usize = scene.rays.iter().filter_map(|ray| nearest(scene, black_box(ray))).sum();
        u32::try_from(sum).expect("they are few")
    })
}

#[unsafe(no_mangle)]
extern "C" fn by_spheres() -> u32 {
    ask(|scene, ray| Some(black_box(scene.spheres.nearest(ray, ALL))?.0))
}

#[unsafe(no_mangle)]
extern "C" fn by_slice() -> u32 {
    ask(|scene, ray| Some(black_box(nearest(&scene.slice, ray, ALL))?.0))
}

/// By the lecture's formula for each sphere in turn, with the point and the normal of the nearest.
#[unsafe(no_mangle)]
extern "C" fn by_formula() -> u32 {
    ask(|scene, ray| {
        let mut end = f32::INFINITY;
        let mut found = None;
        for (index, sphere) in scene.slice.iter().enumerate() {
            if let Some(t) = formula(ray, sphere).filter(|&t| t < end) {
                end = t;
                found = Some(index);
            }
        }
        let sphere = scene.slice.get(found?)?;
        let point = ray.at(end);
        black_box((point, (point - sphere.center) / sphere.radius));
        found
    })
}

/// The lecture's formula, S. Marschner, CS4620 lecture 6, *Ray Tracing Basics*: the first root ahead.
#[inline(always)]
fn formula(ray: &Ray, sphere: &Sphere) -> Option<f32> {
    let o = sphere.center - ray.origin;
    let a = ray.direction.dot(ray.direction);
    let h = ray.direction.dot(o);
    let c = o.dot(o) - sphere.radius * sphere.radius;
    let discriminant = h * h - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    [(h - root) / a, (h + root) / a].into_iter().find(|&t| t > 0.0)
}
