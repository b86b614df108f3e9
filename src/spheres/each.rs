//! Many rays at once, for [`Spheres`] and [`SphereBvh`]: `nearest_each` and `occludes_each`.

use core::ops::Range;

use super::filter::is_in_reach;
use super::hierarchy::Shape;
use super::lanes::Lanes;
use super::packet::bounds::{Meet, Met};
use super::packet::{Mask, Packet, Question, RAYS};
use super::scan::Bits;
use super::{SphereBvh, Spheres};
use crate::{Hit, Hittable, Ray, Sphere};

/// What is found for each ray: which sphere, and where.
type Found = Option<(usize, Hit)>;

/// Which sphere each ray of a packet meets first.
struct Nearest<'a, F> {
    rays: &'a [Ray],
    range: &'a Range<f32>,
    found: &'a mut [Found],
    /// The sphere at a place, and its index.
    member: F,
}

impl<F: Fn(u32) -> Option<(usize, Sphere)>> Nearest<'_, F> {
    /// Asks a ray exactly whether it meets the sphere at that place first.
    fn ask_exactly(&mut self, ray_place: usize, place: u32) {
        let Self { rays, range, found, member } = self;
        let (Some(ray), Some(found), Some((index, sphere))) =
            (rays.get(ray_place), found.get_mut(ray_place), member(place))
        else {
            return;
        };
        if let Some(hit) = sphere.intersect(ray, range.clone()) {
            if found.is_none_or(|(lowest, nearest)| (hit.t, index) < (nearest.t, lowest)) {
                *found = Some((index, hit));
            }
        }
    }

    /// Asks all rays exactly whose nearest sphere is known.
    fn finish(&mut self, packet: &Packet) {
        for ray_place in Bits(packet.alive) {
            if let Some(place) = packet.nearest(ray_place) {
                // It is certainly nearer than what was found before.
                let Self { rays, range, found, member } = self;
                let (Some(ray), Some(found), Some((index, sphere))) =
                    (rays.get(ray_place), found.get_mut(ray_place), member(place))
                else {
                    continue;
                };
                *found = sphere.intersect(ray, Range::clone(range)).map(|hit| (index, hit));
            }
        }
    }
}

impl<F: Fn(u32) -> Option<(usize, Sphere)>> Question for Nearest<'_, F> {
    fn ask(&mut self, packet: &mut Packet, lanes: Lanes, rays: Mask, sphere: &Sphere, place: u32) {
        // Where the bounds overlap, what was known so far is needed after it.
        let doubtfully = meet(packet, lanes, rays, sphere, place).doubtfully;
        for ray_place in Bits(doubtfully) {
            if let Some(nearest) = packet.nearest(ray_place) {
                // It was certainly nearer than what was found before.
                if let Some(found) = self.found.get_mut(ray_place) {
                    *found = None;
                }
                self.ask_exactly(ray_place, nearest);
            }
            self.ask_exactly(ray_place, place);
            match self.found.get(ray_place) {
                Some(Some((_, hit))) => {
                    packet.set_nearest(ray_place, hit.t, f32::from_bits(hit.t.to_bits() + 1));
                }
                _ => {}
            }
        }
    }
}

/// Which rays of a packet meet any sphere.
struct Occluded<'a> {
    rays: &'a [Ray],
    range: &'a Range<f32>,
    occluded: &'a mut [bool],
}

impl Question for Occluded<'_> {
    fn ask(&mut self, packet: &mut Packet, lanes: Lanes, rays: Mask, sphere: &Sphere, place: u32) {
        let Met { mut surely, doubtfully } = meet(packet, lanes, rays, sphere, place);
        for ray_place in Bits(doubtfully) {
            let is_met = |ray| sphere.occludes(ray, self.range.clone());
            surely |= Mask::from(self.rays.get(ray_place).is_some_and(is_met)) << ray_place;
        }
        for ray_place in Bits(surely) {
            packet.drop_ray(ray_place);
            if let Some(occluded) = self.occluded.get_mut(ray_place) {
                *occluded = true;
            }
        }
    }
}

/// What is known of the rays that meet a sphere: nothing of one that is too large.
fn meet(packet: &mut Packet, lanes: Lanes, rays: Mask, sphere: &Sphere, place: u32) -> Met {
    if !is_in_reach(sphere) {
        return Met { surely: 0, doubtfully: rays };
    }
    lanes.run(Meet { packet, sphere, place, rays })
}

/// A collection that packets can be asked of.
pub(super) trait Collection {
    /// Asks all spheres that a ray of the packet may be the first to meet. Returns `false` if the rays share too little of their way.
    fn ask<Q: Question>(&self, lanes: Lanes, packet: &mut Packet, question: &mut Q) -> bool;

    /// The sphere at one of the places that a question is asked with, and its index.
    fn member(&self, place: u32) -> Option<(usize, Sphere)>;

    /// Asks a single ray.
    fn nearest_alone(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> Found;

    /// Asks a single ray.
    fn occludes_alone(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool;
}

/// Finds the nearest hit of each ray.
fn nearest_each(
    collection: &impl Collection,
    lanes: Lanes,
    rays: &[Ray],
    range: &Range<f32>,
    found: &mut [Found],
) {
    let mut packet = Packet::EMPTY;
    for (rays, found) in pairs(rays, found) {
        let mut asked = packet.load(lanes, rays, range);
        if asked != 0 {
            found.fill(None);
            let member = |place| collection.member(place);
            let mut question = Nearest { rays, range, found: &mut *found, member };
            if collection.ask(lanes, &mut packet, &mut question) {
                question.finish(&packet);
            } else {
                asked = 0;
            }
        }
        for ((place, ray), found) in rays.iter().enumerate().zip(found) {
            if asked >> place & 1 == 0 {
                *found = collection.nearest_alone(lanes, ray, range.clone());
            }
        }
    }
}

/// Finds whether each ray hits anything.
fn occludes_each(
    collection: &impl Collection,
    lanes: Lanes,
    rays: &[Ray],
    range: &Range<f32>,
    occluded: &mut [bool],
) {
    let mut packet = Packet::EMPTY;
    for (rays, occluded) in pairs(rays, occluded) {
        let mut asked = packet.load(lanes, rays, range);
        if asked != 0 {
            occluded.fill(false);
            let mut question = Occluded { rays, range, occluded: &mut *occluded };
            if !collection.ask(lanes, &mut packet, &mut question) {
                // Of those that are not known to be occluded, nothing is known.
                asked &= !packet.alive;
            }
        }
        for ((place, ray), occluded) in rays.iter().enumerate().zip(occluded) {
            if asked >> place & 1 == 0 {
                *occluded = collection.occludes_alone(lanes, ray, range.clone());
            }
        }
    }
}

/// The rays of each packet, and what is found for them: as many as there are of both.
fn pairs<'a, T>(
    rays: &'a [Ray],
    found: &'a mut [T],
) -> impl Iterator<Item = (&'a [Ray], &'a mut [T])> {
    let count = rays.len().min(found.len());
    rays[..count].chunks(RAYS).zip(found[..count].chunks_mut(RAYS))
}

impl Collection for Spheres {
    fn ask<Q: Question>(&self, lanes: Lanes, packet: &mut Packet, question: &mut Q) -> bool {
        packet.scan(lanes, self, 0, question)
    }

    fn member(&self, place: u32) -> Option<(usize, Sphere)> {
        Some((place as usize, self.get(place as usize)?))
    }

    fn nearest_alone(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> Found {
        self.nearest_in_lanes(lanes, ray, range)
    }

    fn occludes_alone(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool {
        self.occludes_in_lanes(lanes, ray, range)
    }
}

impl Spheres {
    /// Finds the nearest hit of each ray with `t` in `range`, and the index of its sphere: writes what [`nearest`](Self::nearest)
    /// returns for `rays[i]` to `found[i]`, bit for bit.
    ///
    /// This takes less time than to ask one by one where rays that lie together follow each other, as those of the pixels of a small
    /// square do: give as many at once as there are, best in groups of 64, and of 16 in these. Any rays in any order are allowed;
    /// those that share nothing take about as long as one by one.
    ///
    /// If the slices differ in length, the shorter one counts: rays without a place in `found` are not asked, and places in `found`
    /// without a ray are left as they are.
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
    pub fn nearest_each(&self, rays: &[Ray], range: Range<f32>, found: &mut [Found]) {
        self.nearest_each_in_lanes(Lanes::best(), rays, &range, found);
    }

    /// Finds for each ray whether it hits any sphere with `t` in `range`, for shadow rays: writes what
    /// [`occludes`](crate::Hittable::occludes) returns for `rays[i]` to `occluded[i]`.
    ///
    /// What [`nearest_each`](Self::nearest_each) says of the order of rays and of slices that differ in length holds here, too. All
    /// rays share the range: give the shadow rays to a lamp directions that end there, and `0.0..1.0`.
    pub fn occludes_each(&self, rays: &[Ray], range: Range<f32>, occluded: &mut [bool]) {
        self.occludes_each_in_lanes(Lanes::best(), rays, &range, occluded);
    }

    /// [`nearest_each`](Self::nearest_each) with that set of instructions.
    pub(super) fn nearest_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray],
        range: &Range<f32>,
        found: &mut [Found],
    ) {
        nearest_each(self, lanes, rays, range, found);
    }

    /// [`occludes_each`](Self::occludes_each) with that set of instructions.
    pub(super) fn occludes_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray],
        range: &Range<f32>,
        occluded: &mut [bool],
    ) {
        occludes_each(self, lanes, rays, range, occluded);
    }
}

impl SphereBvh {
    /// Finds the nearest hit of each ray with `t` in `range`, and the index of its sphere: writes what [`nearest`](Self::nearest)
    /// returns for `rays[i]` to `found[i]`, bit for bit.
    ///
    /// This takes less time than to ask one by one where rays that lie together follow each other, as those of the pixels of a small
    /// square do: give as many at once as there are, best in groups of 64, and of 16 in these. Any rays in any order are allowed;
    /// those that share nothing take about as long as one by one.
    ///
    /// If the slices differ in length, the shorter one counts: rays without a place in `found` are not asked, and places in `found`
    /// without a ray are left as they are.
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
    pub fn nearest_each(&self, rays: &[Ray], range: Range<f32>, found: &mut [Found]) {
        self.nearest_each_in_lanes(Lanes::best(), rays, &range, found);
    }

    /// Finds for each ray whether it hits any sphere with `t` in `range`, for shadow rays: writes what
    /// [`occludes`](crate::Hittable::occludes) returns for `rays[i]` to `occluded[i]`.
    ///
    /// What [`nearest_each`](Self::nearest_each) says of the order of rays and of slices that differ in length holds here, too. All
    /// rays share the range: give the shadow rays to a lamp directions that end there, and `0.0..1.0`.
    pub fn occludes_each(&self, rays: &[Ray], range: Range<f32>, occluded: &mut [bool]) {
        self.occludes_each_in_lanes(Lanes::best(), rays, &range, occluded);
    }

    /// [`nearest_each`](Self::nearest_each) with that set of instructions.
    pub(super) fn nearest_each_in_lanes(
        &self,
        lanes: Lanes,
        rays: &[Ray],
        range: &Range<f32>,
        found: &mut [Found],
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
        rays: &[Ray],
        range: &Range<f32>,
        occluded: &mut [bool],
    ) {
        match &self.0 {
            Shape::Scan(spheres) => occludes_each(spheres, lanes, rays, range, occluded),
            Shape::Tree(tree) => occludes_each(tree, lanes, rays, range, occluded),
        }
    }
}
