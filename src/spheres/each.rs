//! Many rays at once, for [`Spheres`] and [`SphereBvh`]: `nearest_each` and `occludes_each`.

use core::ops::Range;

use super::filter::is_in_reach;
use super::hierarchy::Shape;
use super::lanes::Lanes;
use super::local::{narrow, to_f32};
use super::middle::Middle;
use super::packet::bounds::{Meet, Met};
use super::packet::{Around, Mask, Packet, Question, RAYS};
use super::scan::Bits;
use super::{SphereBvh, Spheres};
use crate::order::{is_nearer, next_above};
use crate::{Hit, Hittable, Ray, Sphere, Vector};

/// What is found for each ray: which sphere, and where.
type Found<V> = Option<(usize, Hit<V>)>;

/// Which sphere each ray of a packet meets first.
struct Nearest<'a, V: Vector, C> {
    collection: &'a C,
    rays: &'a [Ray<V>],
    range: &'a Range<V::Scalar>,
    found: &'a mut [Found<V>],
}

impl<V: Vector, C: Collection<V>> Nearest<'_, V, C> {
    /// Asks a ray exactly whether it meets the sphere at that place first, or, if that is known, where.
    fn ask_exactly(&mut self, ray_place: usize, place: u32, is_known: bool) {
        let Self { collection, rays, range, found } = self;
        let (Some(ray), Some(found), Some((index, sphere))) =
            (rays.get(ray_place), found.get_mut(ray_place), collection.member(place))
        else {
            return;
        };
        let hit = sphere.intersect(ray, Range::clone(range));
        let is_first = |hit: &Hit<V>| {
            is_known
                || found.is_none_or(|(other, nearest)| {
                    let spheres = || [Some(sphere), collection.sphere(other)];
                    is_nearer(ray, (index, hit.t), (other, nearest.t), spheres)
                })
        };
        if let Some(hit) = hit.filter(is_first) {
            *found = Some((index, hit));
        }
    }

    /// Asks all rays exactly whose nearest sphere is known: it is certainly nearer than what was found before.
    fn finish(&mut self, packet: &Packet) {
        for ray_place in Bits(packet.alive) {
            if let Some(place) = packet.nearest(ray_place) {
                self.ask_exactly(ray_place, place, true);
            }
        }
    }
}

impl<V: Vector, C: Collection<V>> Question<V> for Nearest<'_, V, C> {
    fn ask(
        &mut self,
        packet: &mut Packet,
        lanes: Lanes,
        rays: Mask,
        sphere: &Sphere<V>,
        place: u32,
    ) {
        // Where the bounds overlap, what was known so far is needed after it.
        let doubtfully = meet(packet, lanes, rays, sphere, place).doubtfully;
        for ray_place in Bits(doubtfully) {
            if let Some(nearest) = packet.nearest(ray_place) {
                self.ask_exactly(ray_place, nearest, true);
            }
            self.ask_exactly(ray_place, place, false);
            if let Some(Some((_, hit))) = self.found.get(ray_place) {
                packet.set_nearest(ray_place, to_f32(hit.t), to_f32(next_above::<V>(hit.t)));
            }
        }
    }
}

/// Which rays of a packet meet any sphere.
struct Occluded<'a, V: Vector> {
    rays: &'a [Ray<V>],
    range: &'a Range<V::Scalar>,
    answers: &'a mut [bool],
}

impl<V: Vector> Question<V> for Occluded<'_, V> {
    fn ask(
        &mut self,
        packet: &mut Packet,
        lanes: Lanes,
        rays: Mask,
        sphere: &Sphere<V>,
        place: u32,
    ) {
        let Met { mut surely, doubtfully } = meet(packet, lanes, rays, sphere, place);
        for ray_place in Bits(doubtfully) {
            let is_met = |ray| sphere.occludes(ray, self.range.clone());
            surely |= Mask::from(self.rays.get(ray_place).is_some_and(is_met)) << ray_place;
        }
        for ray_place in Bits(surely) {
            packet.drop_ray(ray_place);
            if let Some(is_occluded) = self.answers.get_mut(ray_place) {
                *is_occluded = true;
            }
        }
    }
}

/// What is known of the rays that meet a sphere: nothing of one that is too large.
fn meet<V: Vector>(
    packet: &mut Packet,
    lanes: Lanes,
    rays: Mask,
    sphere: &Sphere<V>,
    place: u32,
) -> Met {
    if !is_in_reach(sphere) {
        return Met { surely: 0, doubtfully: rays };
    }
    let sphere = &Sphere::new(narrow(sphere.center), to_f32(sphere.radius));
    lanes.run(Meet { packet, sphere, place, rays })
}

/// A collection that packets can be asked of.
pub(super) trait Collection<V: Vector> {
    /// Where rays are asked together.
    fn around(&self) -> Around;

    /// Asks all spheres that a ray of the packet may be the first to meet. Rays that share too little of their way are left
    /// alone.
    fn ask<Q: Question<V>>(&self, lanes: Lanes, packet: &mut Packet, question: &mut Q);

    /// The sphere at an index.
    fn sphere(&self, index: usize) -> Option<Sphere<V>>;

    /// The sphere at one of the places that a question is asked with, and its index.
    fn member(&self, place: u32) -> Option<(usize, Sphere<V>)>;

    /// Asks a single ray.
    fn nearest_alone(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> Found<V>;

    /// Asks a single ray.
    fn occludes_alone(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> bool;
}

/// Whether rays are asked together: the bounds of t are those of numbers in `f32`.
const fn is_single<V: Vector>() -> bool {
    size_of::<V::Scalar>() == size_of::<f32>()
}

/// Finds the nearest hit of each ray.
fn nearest_each<V: Vector>(
    collection: &impl Collection<V>,
    lanes: Lanes,
    rays: &[Ray<V>],
    range: &Range<V::Scalar>,
    found: &mut [Found<V>],
) {
    let together = |packet: &mut Packet, rays: &[Ray<V>], found: &mut [Found<V>]| {
        found.fill(None);
        let mut question = Nearest { collection, rays, range, found };
        collection.ask(lanes, packet, &mut question);
        question.finish(packet);
    };
    let alone = |ray: &Ray<V>| collection.nearest_alone(lanes, ray, range.clone());
    each(collection, lanes, (rays, range), found, together, alone);
}

/// Finds whether each ray hits anything.
fn occludes_each<V: Vector>(
    collection: &impl Collection<V>,
    lanes: Lanes,
    rays: &[Ray<V>],
    range: &Range<V::Scalar>,
    occluded: &mut [bool],
) {
    let together = |packet: &mut Packet, rays: &[Ray<V>], answers: &mut [bool]| {
        answers.fill(false);
        collection.ask(lanes, packet, &mut Occluded { rays, range, answers });
    };
    let alone = |ray: &Ray<V>| collection.occludes_alone(lanes, ray, range.clone());
    each(collection, lanes, (rays, range), occluded, together, alone);
}

/// Answers for each ray: those that a packet takes together, and the others alone.
fn each<V: Vector, T>(
    collection: &impl Collection<V>,
    lanes: Lanes,
    (rays, range): (&[Ray<V>], &Range<V::Scalar>),
    answers: &mut [T],
    together: impl Fn(&mut Packet, &[Ray<V>], &mut [T]),
    alone: impl Fn(&Ray<V>) -> T,
) {
    let mut packet = Packet::EMPTY;
    let around = collection.around();
    for (rays, answers) in rays.chunks(RAYS).zip(answers.chunks_mut(RAYS)) {
        // The last may be fewer of either.
        let count = rays.len().min(answers.len());
        let (rays, answers) = (&rays[..count], &mut answers[..count]);
        let mut asked = 0;
        if is_single::<V>() {
            asked = packet.load(lanes, rays, range, around);
        }
        if asked != 0 {
            together(&mut packet, rays, answers);
            asked &= !packet.alone;
            #[cfg(test)]
            tests::count(asked);
        }
        for ((place, ray), answer) in rays.iter().enumerate().zip(answers) {
            if asked >> place & 1 == 0 {
                *answer = alone(ray);
            }
        }
    }
}

impl<V: Vector> Collection<V> for Spheres<V> {
    fn around(&self) -> Around {
        let Middle { center, extent, near_squared } = self.middle;
        Around::new(center, near_squared, extent)
    }

    fn ask<Q: Question<V>>(&self, lanes: Lanes, packet: &mut Packet, question: &mut Q) {
        packet.scan(lanes, self, 0, question);
    }

    fn sphere(&self, index: usize) -> Option<Sphere<V>> {
        self.get(index)
    }

    fn member(&self, place: u32) -> Option<(usize, Sphere<V>)> {
        Some((place as usize, self.get(place as usize)?))
    }

    fn nearest_alone(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> Found<V> {
        self.nearest_in_lanes(lanes, ray, range)
    }

    fn occludes_alone(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.occludes_in_lanes(lanes, ray, range)
    }
}

impl<V: Vector> Spheres<V> {
    /// Finds the nearest hit of each ray with `t` in `range`, and the index of its sphere: writes what [`nearest`](Self::nearest)
    /// returns for `rays[i]` to `found[i]`, bit for bit.
    ///
    /// This takes less time than to ask one by one where rays that lie together follow each other, as those of the pixels of a
    /// small square do: give as many at once as there are, best in groups of 64, and of 16 in these. Any rays in any order are
    /// allowed; those that share nothing take about as long as one by one, and so do all in `f64`.
    ///
    /// If the slices differ in length, the shorter one counts: rays without a place in `found` are not asked, and places in
    /// `found` without a ray are left as they are.
    ///
    /// Nothing is allocated.
    ///
    /// ```
    /// use eyeray::{Camera, Sphere, Spheres};
    /// use glam::{Vec3, vec2};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let (eye, target) = (Vec3::Z * 5.0, Vec3::ZERO);
    /// let camera = Camera::perspective_fov(eye, target, Vec3::Y, 1.0, 1.0)?;
    /// let spheres: Spheres = [Sphere::new(target, 1.0)].into_iter().collect();
    ///
    /// // A square of 8 by 8 pixels around the middle of a picture of 640 by 640.
    /// let pixel = |i: u8| vec2(316.5 + f32::from(i % 8), 316.5 + f32::from(i / 8));
    /// let rays: Vec<_> = (0..64).map(|i| camera.pixel_ray(pixel(i), 640, 640)).collect();
    /// let mut found = [None; 64];
    /// spheres.nearest_each(&rays, 0.0..f32::INFINITY, &mut found);
    /// assert_eq!(found[27], spheres.nearest(&rays[27], 0.0..f32::INFINITY));
    /// assert!(found.iter().all(|found| found.is_some_and(|(index, _)| index == 0)));
    /// # Ok(())
    /// # }
    /// ```
    pub fn nearest_each(&self, rays: &[Ray<V>], range: Range<V::Scalar>, found: &mut [Found<V>]) {
        self.nearest_each_in_lanes(Lanes::best(), rays, &range, found);
    }

    /// Finds for each ray whether it hits any sphere with `t` in `range`, for shadow rays: writes what
    /// [`occludes`](crate::Hittable::occludes) returns for `rays[i]` to `occluded[i]`.
    ///
    /// What [`nearest_each`](Self::nearest_each) says of the order of rays and of slices that differ in length holds here, too.
    /// All rays share the range: give the shadow rays to a lamp directions that end there, and `0.0..1.0`.
    pub fn occludes_each(&self, rays: &[Ray<V>], range: Range<V::Scalar>, occluded: &mut [bool]) {
        self.occludes_each_in_lanes(Lanes::best(), rays, &range, occluded);
    }

    /// [`nearest_each`](Self::nearest_each) with that set of instructions.
    pub(super) fn nearest_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray<V>],
        range: &Range<V::Scalar>,
        found: &mut [Found<V>],
    ) {
        nearest_each(self, lanes, rays, range, found);
    }

    /// [`occludes_each`](Self::occludes_each) with that set of instructions.
    pub(super) fn occludes_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray<V>],
        range: &Range<V::Scalar>,
        occluded: &mut [bool],
    ) {
        occludes_each(self, lanes, rays, range, occluded);
    }
}

impl<V: Vector> SphereBvh<V> {
    /// Finds the nearest hit of each ray with `t` in `range`, and the index of its sphere: writes what [`nearest`](Self::nearest)
    /// returns for `rays[i]` to `found[i]`, bit for bit.
    ///
    /// This takes less time than to ask one by one where rays that lie together follow each other, as those of the pixels of a
    /// small square do: give as many at once as there are, best in groups of 64, and of 16 in these. Any rays in any order are
    /// allowed; those that share nothing take about as long as one by one, and so do all in `f64`.
    ///
    /// If the slices differ in length, the shorter one counts: rays without a place in `found` are not asked, and places in
    /// `found` without a ray are left as they are.
    ///
    /// Nothing is allocated.
    ///
    /// ```
    /// use eyeray::{Camera, Sphere, SphereBvh};
    /// use glam::{Vec3, vec2};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let (eye, target) = (Vec3::Z * 5.0, Vec3::ZERO);
    /// let camera = Camera::perspective_fov(eye, target, Vec3::Y, 1.0, 1.0)?;
    /// let spheres: SphereBvh = [Sphere::new(target, 1.0)].into_iter().collect();
    ///
    /// // A square of 8 by 8 pixels around the middle of a picture of 640 by 640.
    /// let pixel = |i: u8| vec2(316.5 + f32::from(i % 8), 316.5 + f32::from(i / 8));
    /// let rays: Vec<_> = (0..64).map(|i| camera.pixel_ray(pixel(i), 640, 640)).collect();
    /// let mut found = [None; 64];
    /// spheres.nearest_each(&rays, 0.0..f32::INFINITY, &mut found);
    /// assert_eq!(found[27], spheres.nearest(&rays[27], 0.0..f32::INFINITY));
    /// assert!(found.iter().all(|found| found.is_some_and(|(index, _)| index == 0)));
    /// # Ok(())
    /// # }
    /// ```
    pub fn nearest_each(&self, rays: &[Ray<V>], range: Range<V::Scalar>, found: &mut [Found<V>]) {
        self.nearest_each_in_lanes(Lanes::best(), rays, &range, found);
    }

    /// Finds for each ray whether it hits any sphere with `t` in `range`, for shadow rays: writes what
    /// [`occludes`](crate::Hittable::occludes) returns for `rays[i]` to `occluded[i]`.
    ///
    /// What [`nearest_each`](Self::nearest_each) says of the order of rays and of slices that differ in length holds here, too.
    /// All rays share the range: give the shadow rays to a lamp directions that end there, and `0.0..1.0`.
    pub fn occludes_each(&self, rays: &[Ray<V>], range: Range<V::Scalar>, occluded: &mut [bool]) {
        self.occludes_each_in_lanes(Lanes::best(), rays, &range, occluded);
    }

    /// [`nearest_each`](Self::nearest_each) with that set of instructions.
    pub(super) fn nearest_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray<V>],
        range: &Range<V::Scalar>,
        found: &mut [Found<V>],
    ) {
        match &self.0 {
            Shape::Scan(spheres) => nearest_each(spheres, lanes, rays, range, found),
            Shape::Tree(tree) => nearest_each(tree, lanes, rays, range, found),
        }
    }

    /// [`occludes_each`](Self::occludes_each) with that set of instructions.
    pub(super) fn occludes_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray<V>],
        range: &Range<V::Scalar>,
        occluded: &mut [bool],
    ) {
        match &self.0 {
            Shape::Scan(spheres) => occludes_each(spheres, lanes, rays, range, occluded),
            Shape::Tree(tree) => occludes_each(tree, lanes, rays, range, occluded),
        }
    }
}

/// How many rays were asked together: else the tests of packets would test nothing.
#[cfg(test)]
pub(super) mod tests {
    use core::cell::Cell;

    use crate::spheres::packet::Mask;

    std::thread_local!(static TOGETHER: Cell<u32> = const { Cell::new(0) });

    pub(super) fn count(asked: Mask) {
        TOGETHER.set(TOGETHER.get() + asked.count_ones());
    }

    /// Those of this thread since the last call.
    pub(in crate::spheres) fn together() -> u32 {
        TOGETHER.take()
    }
}
