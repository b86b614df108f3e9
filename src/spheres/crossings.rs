//! The crossings that were found and not given yet: the first along the ray first.

use core::cmp::Ordering;
use core::ops::Range;

use super::queue::Queue;
use crate::root::Side;
use crate::root::order::compare_crossings;
use crate::{Hit, Hittable, Ray, Sphere};

/// For how many crossings there is room without allocating.
const FEW: usize = 4;

/// Spheres that each have a place, and an index in the order in which they were given.
pub(super) trait Places {
    /// The sphere at a place.
    fn sphere(&self, place: usize) -> Option<Sphere>;

    /// Its index.
    fn index(&self, place: usize) -> usize;
}

/// In a slice, each sphere's place is its index.
impl Places for &[Sphere] {
    #[inline(always)]
    fn sphere(&self, place: usize) -> Option<Sphere> {
        self.get(place).copied()
    }

    #[inline(always)]
    fn index(&self, place: usize) -> usize {
        place
    }
}

/// Where a ray enters or leaves a sphere.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    hit: Hit,
    side: Side,
    /// The place of the sphere.
    place: usize,
}

/// The crossings of a ray with t in a range.
///
/// Where a ray enters a sphere, it is not asked where it leaves before the entry is given.
#[derive(Clone, Debug)]
pub(super) struct Crossings<P> {
    pub(super) places: P,
    pub(super) ray: Ray,
    pub(super) range: Range<f32>,
    found: Queue<Crossing, FEW>,
    /// The place of the sphere whose entry was given last, and where that is.
    entered: Option<(usize, f32)>,
}

impl<P: Places> Crossings<P> {
    #[inline(always)]
    pub(super) fn new(places: P, ray: &Ray, range: Range<f32>) -> Self {
        Self { places, ray: *ray, range, found: Queue::new(), entered: None }
    }

    /// Asks where the ray crosses the sphere at a place first.
    ///
    /// Not inlined: a loop over vectors that shared a function with the exact routine would save them around it.
    #[inline(never)]
    pub(super) fn ask(&mut self, place: usize) {
        let Self { places, ray, range, .. } = self;
        let Some(sphere) = places.sphere(place) else { return };
        let Some(hit) = sphere.intersect(ray, range.clone()) else { return };
        let side = side(&hit, &sphere, ray);
        self.add(Crossing { hit, side, place });
    }

    /// Asks where the ray leaves the sphere that it has entered.
    #[inline(always)]
    pub(super) fn ask_for_exit(&mut self) {
        if let Some((place, t)) = self.entered.take() {
            self.ask_for_exit_of(place, t);
        }
    }

    #[inline(never)]
    fn ask_for_exit_of(&mut self, place: usize, t: f32) {
        let Self { places, ray, range, .. } = self;
        let Some(sphere) = places.sphere(place) else { return };
        let just_after = f32::from_bits(t.to_bits() + 1);
        let hit = sphere.intersect(ray, just_after..range.end).or_else(|| {
            // Out of the range, or so close that both round to the same t.
            let [_, exit] = sphere.roots_algebraic(ray)?;
            sphere.intersect(ray, exit..range.end)
        });
        if let Some(hit) = hit {
            self.add(Crossing { hit, side: Side::Far, place });
        }
    }

    #[inline(always)]
    fn add(&mut self, crossing: Crossing) {
        let Self { places, ray, found, .. } = self;
        found.push(crossing, |a, b| is_before(places, ray, a, b));
    }

    /// The t of the first.
    #[inline(always)]
    pub(super) fn first(&self) -> Option<f32> {
        self.found.first().map(|crossing| crossing.hit.t)
    }

    /// Takes the first.
    #[inline(always)]
    pub(super) fn take(&mut self) -> Option<(usize, Hit)> {
        let Self { places, ray, found, entered, .. } = self;
        let Crossing { hit, side, place } = found.pop(|a, b| is_before(places, ray, a, b))?;
        if side == Side::Near {
            *entered = Some((place, hit.t));
        }
        Some((places.index(place), hit))
    }
}

/// On which side of the sphere a hit is.
#[inline(always)]
fn side(hit: &Hit, sphere: &Sphere, ray: &Ray) -> Side {
    /// The square of a cosine that is certain to have the right sign. A coordinate of the normal is within 2 ulp of 1.
    const CERTAIN: f32 = 1.0 / 1_099_511_627_776.0; // 2^-40

    let along = hit.normal.dot(ray.direction);
    if along * along > CERTAIN * ray.direction.length_squared() {
        if along < 0.0 { Side::Near } else { Side::Far }
    } else {
        side_by_roots(hit, sphere, ray)
    }
}

#[cold]
#[inline(never)]
fn side_by_roots(hit: &Hit, sphere: &Sphere, ray: &Ray) -> Side {
    let is_near = sphere.roots_algebraic(ray).is_some_and(|[near, _]| near == hit.t);
    if is_near { Side::Near } else { Side::Far }
}

/// Whether a crossing comes before another.
///
/// They are told apart by value: a reference would keep each in memory, from where it is loaded long before it has arrived.
#[inline(always)]
fn is_before<P: Places>(places: &P, ray: &Ray, a: &Crossing, b: &Crossing) -> bool {
    a.hit.t < b.hit.t
        || (a.hit.t == b.hit.t
            && is_before_at_equal_t(places, ray, (a.place, a.side), (b.place, b.side)))
}

/// Whether it does where both have the same t, rounded: by the exact roots, of equal ones by index. They are not of one
/// sphere, whose exit is found after its entry was taken.
#[cold]
#[inline(never)]
fn is_before_at_equal_t<P: Places>(
    places: &P,
    ray: &Ray,
    (first, first_side): (usize, Side),
    (second, second_side): (usize, Side),
) -> bool {
    let [Some(first_sphere), Some(second_sphere)] =
        [first, second].map(|place| places.sphere(place))
    else {
        return false;
    };
    let order = compare_crossings(ray, (&first_sphere, first_side), (&second_sphere, second_side));
    order.then_with(|| places.index(first).cmp(&places.index(second))) == Ordering::Less
}
