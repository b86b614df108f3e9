//! The crossings that were found and not given yet: the first along the ray first.

use core::ops::Range;

use super::queue::Queue;
use crate::order::{compare_crossings, next_above};
use crate::root::Side;
use crate::{Hit, Hittable, Ray, Sphere, Vector};

/// For how many crossings there is room without allocating.
const FEW: usize = 4;

/// Finds spheres by the place that a collection keeps them at, and their indices in the order in which they were given.
pub(super) trait Places<V: Vector> {
    /// The sphere at a place.
    fn sphere(&self, place: usize) -> Option<Sphere<V>>;

    /// Its index.
    fn index(&self, place: usize) -> usize;
}

/// In a slice, each sphere's place is its index.
impl<V: Vector> Places<V> for &[Sphere<V>] {
    #[inline(always)]
    fn sphere(&self, place: usize) -> Option<Sphere<V>> {
        self.get(place).copied()
    }

    #[inline(always)]
    fn index(&self, place: usize) -> usize {
        place
    }
}

/// Where a ray enters or leaves a sphere.
#[derive(Clone, Copy, Debug)]
struct Crossing<V: Vector> {
    hit: Hit<V>,
    side: Side,
    /// The place of the sphere.
    place: usize,
}

/// The crossings of a ray with t in a range.
///
/// Where a ray enters a sphere, it is not asked where it leaves before the entry is given.
#[derive(Clone, Debug)]
pub(super) struct Crossings<V: Vector, P> {
    pub(super) places: P,
    pub(super) ray: Ray<V>,
    pub(super) range: Range<V::Scalar>,
    found: Queue<Crossing<V>, FEW>,
    /// The place of the sphere whose entry was given last, and where that is.
    entered: Option<(usize, V::Scalar)>,
}

impl<V: Vector, P: Places<V>> Crossings<V, P> {
    #[inline(always)]
    pub(super) fn new(places: P, ray: &Ray<V>, range: Range<V::Scalar>) -> Self {
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
    fn ask_for_exit_of(&mut self, place: usize, t: V::Scalar) {
        let Self { places, ray, range, .. } = self;
        let Some(sphere) = places.sphere(place) else { return };
        let just_after = next_above::<V>(t);
        // If there is none, it is out of the range, or so close that both round to the same t.
        let hit = sphere
            .intersect(ray, just_after..range.end)
            .or_else(|| sphere.exit(ray, t..just_after));
        if let Some(hit) = hit {
            self.add(Crossing { hit, side: Side::Far, place });
        }
    }

    #[inline(always)]
    fn add(&mut self, crossing: Crossing<V>) {
        let Self { places, ray, found, .. } = self;
        found.push(crossing, |a, b| is_before(places, ray, a, b));
    }

    /// The t of the first.
    #[inline(always)]
    pub(super) fn first(&self) -> Option<V::Scalar> {
        self.found.first().map(|crossing| crossing.hit.t)
    }

    /// Takes the first.
    #[inline(always)]
    pub(super) fn take(&mut self) -> Option<(usize, Hit<V>)> {
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
fn side<V: Vector>(hit: &Hit<V>, sphere: &Sphere<V>, ray: &Ray<V>) -> Side {
    /// The square of a cosine that is certain to have the right sign, in either precision: with each coordinate of the normal
    /// within 2 ulp of 1, in `f32` 2⁻²², the cosine errs by less than 2⁻²¹.
    const CERTAIN: f64 = 1.0 / 274_877_906_944.0; // 2^-38

    let direction = ray.direction.to_f64();
    let along = hit.normal.to_f64().dot(direction);
    // What overflows or underflows is not more.
    if along * along > CERTAIN * direction.length_squared() {
        if along < 0.0 { Side::Near } else { Side::Far }
    } else {
        side_by_roots(hit, sphere, ray)
    }
}

#[cold]
#[inline(never)]
fn side_by_roots<V: Vector>(hit: &Hit<V>, sphere: &Sphere<V>, ray: &Ray<V>) -> Side {
    let is_near = sphere.roots(ray).is_some_and(|[near, _]| near == hit.t);
    if is_near { Side::Near } else { Side::Far }
}

/// Whether a crossing comes before another.
///
/// They are told apart by value: a reference would keep each in memory, from where it is loaded long before it has arrived.
#[inline(always)]
fn is_before<V: Vector, P: Places<V>>(
    places: &P,
    ray: &Ray<V>,
    a: &Crossing<V>,
    b: &Crossing<V>,
) -> bool {
    let t = a.hit.t;
    t < b.hit.t
        || (t == b.hit.t && is_before_at(t, places, ray, (a.place, a.side), (b.place, b.side)))
}

/// Whether it does where both have the same t, rounded: by the exact roots, of equal ones by index. They are not of one
/// sphere, whose exit is found after its entry was taken.
#[cold]
#[inline(never)]
fn is_before_at<V: Vector, P: Places<V>>(
    t: V::Scalar,
    places: &P,
    ray: &Ray<V>,
    (first, first_side): (usize, Side),
    (second, second_side): (usize, Side),
) -> bool {
    let [Some(first_sphere), Some(second_sphere)] =
        [first, second].map(|place| places.sphere(place))
    else {
        return false;
    };
    compare_crossings(ray, t, (&first_sphere, first_side), (&second_sphere, second_side))
        .then_with(|| places.index(first).cmp(&places.index(second)))
        .is_lt()
}
