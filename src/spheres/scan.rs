//! A collection of few spheres, or of few rays between changes, which are all tested: by a filter over many lanes, and the few
//! that pass by the exact routine.

use alloc::vec::Vec;
use core::ops::Range;
use core::{fmt, iter, slice};

use glam::Vec3;

use super::filter::{Block, FEW, LARGEST, MARGIN, Segment};
use super::hierarchy::bounds::Bounds;
use super::lanes::{Instructions, LANES, Lanes, Vectorized};
use super::local::{Approach, narrow};
use super::middle::Middle;
use crate::hittable::{nearest, nearest_among};
use crate::{Hit, Hittable, Ray, Sphere, Vector};

/// How many blocks have a bit for each sphere in one word.
const BLOCKS_IN_A_WORD: usize = 64 / LANES;

/// A collection of few spheres, or for few rays between changes, which finds the nearest hit by testing many spheres at a time.
///
/// It returns what [`nearest`] returns for a slice of the same spheres, bit for bit: the same hit and the same index, that of the
/// sphere in front, also where distances round to the same number. It takes less time, because most spheres are dropped in single
/// precision, many at a time, in both precisions. The error of this test is bounded, so it never drops a sphere that is hit; the
/// spheres that pass it are intersected exactly.
///
/// Any spheres are allowed. Those that no ray can hit, with a NaN, an infinity or a negative radius, cost no more than others.
/// Where the spheres are does not matter, nor from how far away a ray comes. Only a sphere with a radius beyond 2⁶⁰, or farther
/// than that from most others, is always intersected exactly, and so are all spheres with a ray whose origin is farther than 2⁶⁰
/// from them, or whose direction is longer than that or shorter than 2⁻³⁰.
///
/// # When to use it
///
/// For two spheres or more, up to some hundred, and for more where few rays are asked between changes: spheres can be added,
/// changed and removed one by one. The time of a query is proportional to their number. For more than some hundred,
/// [`SphereBvh`](crate::SphereBvh) skips those far from the ray in groups. To build it takes time: of 20,000 spheres, some 6 ms,
/// which pays from some 1,200 rays between changes. (`cargo bench --bench spheres` measures 1 to 65,536 spheres, and `cargo bench
/// --bench sphere_scenes` building and both precisions.)
///
/// # Instructions
///
/// On x86-64 with the feature `std`, AVX-512 (from Rust 1.89 on) or else AVX2 and FMA are used if the machine has them.
/// Otherwise, the instructions are those that the crate is compiled for: SSE2 on x86-64, NEON on aarch64, in WebAssembly 128-bit
/// SIMD with `-C target-feature=+simd128`, and more with `-C target-cpu`. The results are the same. In WebAssembly, in Node.js,
/// 1,024 spheres take 0.26 times as long as a loop over the textbook's formula, 46 take 0.4 times, and 8 as long
/// (`tests/targets/run costs`, in the repository).
///
/// ```
/// use eyeray::{Ray, Sphere, Spheres};
/// use glam::{Vec3, vec3};
///
/// // A row of spheres, seen from its end.
/// let spheres: Spheres = (1..=1000_u16).map(|i| Sphere::new(Vec3::X * (3.0 * f32::from(i)), 1.0)).collect();
///
/// let along = Ray::new(Vec3::ZERO, Vec3::X);
/// let found = spheres.nearest(&along, 0.0..f32::INFINITY);
/// assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((0, 2.0)));
///
/// let across = Ray::new(vec3(300.0, 0.0, 8.0), Vec3::NEG_Z);
/// let found = spheres.nearest(&across, 0.0..f32::INFINITY);
/// assert_eq!(found.map(|(index, hit)| (index, hit.t)), Some((99, 7.0)));
/// ```
#[derive(Clone, Default)]
#[expect(clippy::struct_field_names, reason = "the spheres are spheres")]
pub struct Spheres<V: Vector = Vec3> {
    pub(super) spheres: Vec<Sphere<V>>,
    /// The same spheres as the filter needs them.
    pub(super) blocks: Vec<Block>,
    /// Where they are.
    pub(super) middle: Middle<V>,
    /// So many more changes, and where they are is found anew.
    changes_left: usize,
}

impl<V: Vector> Spheres<V> {
    /// Creates an empty collection.
    ///
    /// `From` takes a `Vec`, an array or a slice of spheres, and `collect` an iterator. [`extend`](Extend::extend) adds many, and
    /// [`push`](Self::push) one.
    ///
    /// ```
    /// use eyeray::{Sphere, Spheres};
    /// use glam::Vec3;
    ///
    /// let row = [1.0, 2.0, 3.0].map(|x| Sphere::new(Vec3::X * x, 0.1));
    /// let mut spheres = Spheres::new();
    /// spheres.push(row[0]);
    /// spheres.extend(&row[1..]);
    /// assert_eq!(spheres, Spheres::from(row));
    /// ```
    #[inline]
    #[must_use]
    pub const fn new() -> Self {
        Self { spheres: Vec::new(), blocks: Vec::new(), middle: Middle::OF_NONE, changes_left: 0 }
    }

    /// Creates an empty collection with space for at least `capacity` spheres.
    #[must_use]
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            spheres: Vec::with_capacity(capacity),
            blocks: Vec::with_capacity(capacity.div_ceil(LANES)),
            ..Self::new()
        }
    }

    /// Reserves space for at least `additional` more spheres.
    pub fn reserve(&mut self, additional: usize) {
        self.spheres.reserve(additional);
        let blocks = self.len().saturating_add(additional).div_ceil(LANES);
        self.blocks.reserve(blocks.saturating_sub(self.blocks.len()));
    }

    /// Appends a sphere. Its index is the number of spheres before it.
    pub fn push(&mut self, sphere: Sphere<V>) {
        let index = self.len();
        if index % LANES == 0 {
            self.blocks.push(Block::EMPTY);
        }
        self.spheres.push(sphere);
        self.update(index);
    }

    /// Replaces the sphere at `index`, and returns the previous one.
    ///
    /// Returns `None` and changes nothing if `index` is out of bounds.
    ///
    /// ```
    /// use eyeray::{Sphere, Spheres};
    /// use glam::Vec3;
    ///
    /// let mut spheres = Spheres::from(vec![Sphere::new(Vec3::ZERO, 1.0)]);
    /// let moved = Sphere::new(Vec3::X, 1.0);
    /// assert_eq!(spheres.set(0, moved), Some(Sphere::new(Vec3::ZERO, 1.0)));
    /// assert_eq!(spheres.as_slice(), [moved]);
    /// assert_eq!(spheres.set(1, moved), None);
    /// ```
    pub fn set(&mut self, index: usize, sphere: Sphere<V>) -> Option<Sphere<V>> {
        let replaced = core::mem::replace(self.spheres.get_mut(index)?, sphere);
        self.update(index);
        Some(replaced)
    }

    /// Removes the sphere at `index` and returns it. The last sphere takes its place.
    ///
    /// Returns `None` if `index` is out of bounds.
    ///
    /// ```
    /// use eyeray::{Sphere, Spheres};
    /// use glam::Vec3;
    ///
    /// let [a, b, c] = [1.0, 2.0, 3.0].map(|radius| Sphere::new(Vec3::ZERO, radius));
    /// let mut spheres = Spheres::from(vec![a, b, c]);
    /// assert_eq!(spheres.swap_remove(0), Some(a));
    /// assert_eq!(spheres.as_slice(), [c, b]);
    /// assert_eq!(spheres.swap_remove(2), None);
    /// ```
    pub fn swap_remove(&mut self, index: usize) -> Option<Sphere<V>> {
        if index >= self.len() {
            return None;
        }
        let removed = self.spheres.swap_remove(index);
        let last = self.len();
        if let Some(block) = self.blocks.last_mut() {
            block.clear(last % LANES);
        }
        self.blocks.truncate(last.div_ceil(LANES));
        if index < last {
            self.update(index);
        }
        Some(removed)
    }

    /// Removes all spheres, and keeps the allocated memory.
    pub fn clear(&mut self) {
        self.spheres.clear();
        self.blocks.clear();
        self.changes_left = 0;
    }

    /// Tells the filter of a sphere that has changed.
    ///
    /// After as many changes as there were spheres, those may be elsewhere, and all are told anew: on average, one for a change.
    fn update(&mut self, index: usize) {
        if let Some(left) = self.changes_left.checked_sub(1) {
            self.changes_left = left;
            if let (Some(sphere), Some(block)) =
                (self.spheres.get(index), self.blocks.get_mut(index / LANES))
            {
                block.set(index % LANES, sphere, self.middle.center, MARGIN);
            }
        } else {
            self.measure();
        }
    }

    /// Finds out where the spheres are, and tells the filter of all.
    fn measure(&mut self) {
        self.middle = Middle::of(&self.spheres);
        self.changes_left = self.len();
        self.blocks.clear();
        self.blocks.extend(self.spheres.chunks(LANES).map(|spheres| {
            let mut block = Block::EMPTY;
            for (lane, sphere) in spheres.iter().enumerate() {
                block.set(lane, sphere, self.middle.center, MARGIN);
            }
            block
        }));
    }

    /// Returns the number of spheres.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        self.spheres.len()
    }

    /// Returns whether there are no spheres.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// Returns the sphere at `index`, or `None` if `index` is out of bounds.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Option<Sphere<V>> {
        self.spheres.get(index).copied()
    }

    /// Returns a slice of all spheres, by ascending index.
    #[inline]
    #[must_use]
    pub fn as_slice(&self) -> &[Sphere<V>] {
        &self.spheres
    }

    /// Returns an iterator over the spheres, by ascending index.
    #[inline]
    pub fn iter(
        &self,
    ) -> impl ExactSizeIterator<Item = Sphere<V>> + DoubleEndedIterator + Clone + '_ {
        self.into_iter()
    }

    /// Returns the axis-aligned bounding box of all spheres: its lowest and its highest corner, each coordinate rounded outwards.
    ///
    /// Spheres that no ray can hit do not count. Without others, the box is empty: from +∞ to -∞. It takes time in proportion to
    /// the number of spheres.
    ///
    /// ```
    /// use eyeray::{Camera, Sphere, Spheres, ViewRect};
    /// use glam::{Vec3, vec3};
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let spheres = Spheres::from([
    ///     Sphere::new(vec3(-3.0, 1.0, 0.0), 1.0),
    ///     Sphere::new(vec3(7.0, 2.0, 0.0), 2.0),
    /// ]);
    /// let (low, high) = spheres.bounds();
    /// assert_eq!((low, high), (vec3(-4.0, 0.0, -2.0), vec3(9.0, 4.0, 2.0)));
    ///
    /// // A camera that looks along -z and sees all of them.
    /// let middle = (low + high) / 2.0;
    /// let size = high - low;
    /// let view = ViewRect::centered(size.x, size.y);
    /// let eye = middle + Vec3::Z * size.z;
    /// let camera = Camera::orthographic(eye, middle, Vec3::Y, view)?;
    /// # assert!(camera.project(low).is_some());
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub fn bounds(&self) -> (V, V) {
        Bounds::of_all(self.iter()).corners()
    }

    /// Returns the nearest hit with `t` in `range`, and the index of its sphere: of equal `t`, the sphere in
    /// front by the exact roots, and of equal exact roots the lowest index.
    #[inline]
    #[must_use]
    pub fn nearest(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<(usize, Hit<V>)> {
        if self.len() <= FEW {
            return self.nearest_of(self.few_near(ray, range.start), ray, range);
        }
        self.nearest_in_lanes(Lanes::best(), ray, range)
    }

    /// The same with that set of instructions.
    pub(super) fn nearest_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        if self.blocks.len() > BLOCKS_IN_A_WORD {
            return self.nearest_of_many(lanes, ray, range);
        }
        // Not one segment for rays from near and from afar: in one place for both, its numbers would be written, and waited for.
        match self.near_segment(ray, range.start) {
            Some(segment) => {
                self.nearest_of(self.word_near(lanes, &segment, range.end), ray, range)
            }
            None => self.nearest_from_afar(lanes, ray, range),
        }
    }

    /// The same of a ray that begins far away, or that the filter cannot compute with.
    #[cold]
    #[inline(never)]
    fn nearest_from_afar(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        match self.segment_from_afar(ray, &range) {
            Some(segment) => {
                self.nearest_of(self.word_near(lanes, &segment, range.end), ray, range)
            }
            None => nearest(&self.spheres, ray, range),
        }
    }

    /// The same where no word has a bit for each sphere.
    #[inline(never)]
    fn nearest_of_many(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        let Some(segment) = self.segment(ray, &range) else {
            return nearest(&self.spheres, ray, range);
        };
        let mut near = Near::new(self, lanes, &segment);
        nearest_among(ray, range, |end| near.next(segment.end(end)))
    }

    /// [`Hittable::occludes`] with that set of instructions.
    pub(super) fn occludes_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> bool {
        if self.blocks.len() > BLOCKS_IN_A_WORD {
            return self.any_of_many(lanes, ray, range);
        }
        match self.near_segment(ray, range.start) {
            Some(segment) => self.any_of(self.word_near(lanes, &segment, range.end), ray, range),
            None => self.any_from_afar(lanes, ray, range),
        }
    }

    /// The same of a ray that begins far away, or that the filter cannot compute with.
    #[cold]
    #[inline(never)]
    fn any_from_afar(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        match self.segment_from_afar(ray, &range) {
            Some(segment) => self.any_of(self.word_near(lanes, &segment, range.end), ray, range),
            None => self.spheres.occludes(ray, range),
        }
    }

    /// The same where no word has a bit for each sphere.
    #[inline(never)]
    fn any_of_many(&self, lanes: Lanes, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        let Some(segment) = self.segment(ray, &range) else {
            return self.spheres.occludes(ray, range);
        };
        let mut near = Near::new(self, lanes, &segment);
        let end = segment.end(range.end);
        iter::from_fn(|| near.next(end)).any(|(_, sphere)| sphere.occludes(ray, range.clone()))
    }

    /// What the filter knows of a ray, if it can compute with that.
    #[inline(always)]
    fn segment(&self, ray: &Ray<V>, range: &Range<V::Scalar>) -> Option<Segment> {
        match self.near_segment(ray, range.start) {
            Some(segment) => Some(segment),
            // Not returned as it is: with one place for both, what was just written would be copied, and waited for.
            None => Some(self.segment_from_afar(ray, range)?),
        }
    }

    /// What the filter knows of a ray, if that does not begin far away and the filter can compute with it.
    #[inline(always)]
    fn near_segment(&self, ray: &Ray<V>, start: V::Scalar) -> Option<Segment> {
        let (origin, direction) = self.relative(ray);
        Segment::allows(origin, direction, self.middle.near_squared)
            .then(|| Segment::new::<V>(origin, direction, start, MARGIN))
    }

    /// The same of one that begins far away.
    #[cold]
    #[inline(never)]
    fn segment_from_afar(&self, ray: &Ray<V>, range: &Range<V::Scalar>) -> Option<Segment> {
        let (origin, direction) = self.relative(ray);
        Segment::allows(origin, direction, LARGEST * LARGEST).then(|| {
            let origin = ray.origin.to_f64() - self.middle.center.to_f64();
            let extent = self.middle.extent.into();
            let moved =
                Approach::new(origin, ray.direction.to_f64(), extent).moved(range.end.into());
            Segment::moved::<V>(moved, direction, range.start, MARGIN)
        })
    }

    /// The origin of a ray relative to the middle of the spheres, and its direction.
    #[inline(always)]
    fn relative(&self, ray: &Ray<V>) -> (Vec3, Vec3) {
        (narrow(ray.origin - self.middle.center), narrow(ray.direction))
    }

    /// Calls `ask` for the index of every sphere that the ray may meet in the range, and perhaps for others.
    pub(super) fn for_each_near(
        &self,
        lanes: Lanes,
        ray: &Ray<V>,
        range: &Range<V::Scalar>,
        mut ask: impl FnMut(usize),
    ) {
        if self.len() <= FEW {
            Bits(self.few_near(ray, range.start)).for_each(ask);
        } else if let Some(segment) = self.segment(ray, range) {
            let mut near = Near::new(self, lanes, &segment);
            let end = segment.end(range.end);
            while let Some((index, _)) = near.next(end) {
                ask(index);
            }
        } else if ray.origin.to_f64().is_finite() && ray.direction.to_f64().is_finite() {
            (0..self.len()).for_each(ask);
        }
    }

    /// A bit for each of the first [`FEW`] spheres that the ray may meet from `start` on, and perhaps for others.
    #[inline]
    fn few_near(&self, ray: &Ray<V>, start: V::Scalar) -> u64 {
        let (origin, direction) = self.relative(ray);
        match self.blocks.first() {
            Some(block) if Segment::allows(origin, direction, LARGEST * LARGEST) => {
                let segment = Segment::new::<V>(origin, direction, start, MARGIN);
                block.few_near_half_line(&segment).into()
            }
            Some(_) => (1 << FEW) - 1,
            None => 0,
        }
    }

    /// A bit for each sphere that the ray may meet before `end`, and perhaps for others, where a word has bits for all.
    #[inline(always)]
    fn word_near(&self, lanes: Lanes, segment: &Segment, end: V::Scalar) -> u64 {
        let blocks = self.blocks.as_slice();
        lanes.run(&Filter { blocks, segment, end: segment.end(end) }).1
    }

    /// The nearest of those of the first 64 that have a bit. Where none has, that takes no call.
    #[inline(always)]
    fn nearest_of(
        &self,
        near: u64,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        if near == 0 { None } else { self.nearest_of_some(near, ray, range) }
    }

    #[inline(never)]
    fn nearest_of_some(
        &self,
        near: u64,
        ray: &Ray<V>,
        range: Range<V::Scalar>,
    ) -> Option<(usize, Hit<V>)> {
        let mut near = self.near(near);
        nearest_among(ray, range, |_| near.next())
    }

    /// Whether any of those of the first 64 that have a bit is hit.
    #[inline(always)]
    fn any_of(&self, near: u64, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        near != 0 && self.any_of_some(near, ray, range)
    }

    #[inline(never)]
    fn any_of_some(&self, near: u64, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        self.near(near).any(|(_, sphere)| sphere.occludes(ray, range.clone()))
    }

    /// Those of the first 64 that have a bit.
    #[inline(always)]
    fn near(&self, near: u64) -> impl Iterator<Item = (usize, &Sphere<V>)> {
        Bits(near).filter_map(|index| Some((index, self.spheres.get(index)?)))
    }
}

/// The places of the bits of a word, ascending.
pub(super) struct Bits(pub(super) u64);

impl Iterator for Bits {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let place = self.0.trailing_zeros();
        self.0 &= self.0.wrapping_sub(1);
        (place < u64::BITS).then_some(place as usize)
    }
}

/// The spheres that a ray may meet, and perhaps others, by ascending index.
struct Near<'a, V: Vector> {
    lanes: Lanes,
    segment: &'a Segment,
    spheres: &'a [Sphere<V>],
    blocks: &'a [Block],
    /// How many of the blocks have been filtered.
    filtered: usize,
    /// The spheres that have passed and were not given yet, and the index of the first of that word.
    passed: Bits,
    first: usize,
}

impl<'a, V: Vector> Near<'a, V> {
    // The segment by reference: to copy it just after it was written costs more than all else here.
    #[inline(always)]
    fn new(all: &'a Spheres<V>, lanes: Lanes, segment: &'a Segment) -> Self {
        let Spheres { spheres, blocks, .. } = all;
        Self { lanes, segment, spheres, blocks, filtered: 0, passed: Bits(0), first: 0 }
    }

    /// The next one that the ray may meet before `end`.
    #[inline(always)]
    fn next(&mut self, end: f32) -> Option<(usize, &'a Sphere<V>)> {
        loop {
            if let Some(place) = self.passed.next() {
                let index = self.first + place;
                return Some((index, self.spheres.get(index)?));
            }
            let blocks = self.blocks.get(self.filtered..)?;
            if blocks.is_empty() {
                return None;
            }
            let (skipped, passed) = self.lanes.run(&Filter { blocks, segment: self.segment, end });
            self.first = (self.filtered + skipped) * LANES;
            self.passed = Bits(passed);
            self.filtered +=
                if blocks.len() <= BLOCKS_IN_A_WORD { blocks.len() } else { skipped + 1 };
        }
    }
}

/// Finds the next spheres that pass the filter.
///
/// The loops over the blocks call nothing, and the exact routine is not among them: else the compiler saves the vectors
/// around its call, and where the stack happens to be misaligned for them that doubles the time.
struct Filter<'a> {
    blocks: &'a [Block],
    segment: &'a Segment,
    end: f32,
}

impl Vectorized for &Filter<'_> {
    /// How many blocks are skipped, and a bit for each sphere from there that passes: of the next block, or, where no more
    /// blocks are left than a word has bits for, of all.
    type Output = (usize, u64);

    #[inline(always)]
    fn run<I: Instructions>(self, instructions: I) -> (usize, u64) {
        let Filter { blocks, segment, end } = *self;
        if blocks.len() <= BLOCKS_IN_A_WORD {
            let mut near = 0;
            for (place, block) in blocks.iter().enumerate() {
                near |=
                    u64::from(block.near_segment(instructions, segment, end)) << (place * LANES);
            }
            return (0, near);
        }
        for (skipped, block) in blocks.iter().enumerate() {
            if block.is_near_line(instructions, segment) {
                let near = block.near_segment(instructions, segment, end);
                if near != 0 {
                    return (skipped, u64::from(near));
                }
            }
        }
        (blocks.len(), 0)
    }
}

impl<V: Vector> Hittable<V> for Spheres<V> {
    #[inline]
    fn intersect(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> Option<Hit<V>> {
        self.nearest(ray, range).map(|(_, hit)| hit)
    }

    /// Returns whether any sphere is hit, at the first one found.
    #[inline]
    fn occludes(&self, ray: &Ray<V>, range: Range<V::Scalar>) -> bool {
        if self.len() <= FEW {
            return self.any_of(self.few_near(ray, range.start), ray, range);
        }
        self.occludes_in_lanes(Lanes::best(), ray, range)
    }
}

/// Formats the spheres as a list.
impl<V: Vector> fmt::Debug for Spheres<V> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.spheres.fmt(formatter)
    }
}

/// Compares the spheres, as slices do.
impl<V: Vector> PartialEq for Spheres<V> {
    fn eq(&self, other: &Self) -> bool {
        self.spheres == other.spheres
    }
}

/// Takes the spheres without copying them.
impl<V: Vector> From<Vec<Sphere<V>>> for Spheres<V> {
    fn from(spheres: Vec<Sphere<V>>) -> Self {
        let mut all = Self { spheres, ..Self::new() };
        all.measure();
        all
    }
}

/// Moves the spheres into a `Vec`.
impl<V: Vector, const N: usize> From<[Sphere<V>; N]> for Spheres<V> {
    fn from(spheres: [Sphere<V>; N]) -> Self {
        Vec::from(spheres).into()
    }
}

/// Copies the spheres.
impl<V: Vector> From<&[Sphere<V>]> for Spheres<V> {
    fn from(spheres: &[Sphere<V>]) -> Self {
        spheres.to_vec().into()
    }
}

/// Collects the spheres into a `Vec`. The index of each is its place among them.
impl<V: Vector> FromIterator<Sphere<V>> for Spheres<V> {
    fn from_iter<I: IntoIterator<Item = Sphere<V>>>(iter: I) -> Self {
        iter.into_iter().collect::<Vec<_>>().into()
    }
}

/// Collects copies of the spheres.
impl<'a, V: Vector> FromIterator<&'a Sphere<V>> for Spheres<V> {
    fn from_iter<I: IntoIterator<Item = &'a Sphere<V>>>(iter: I) -> Self {
        iter.into_iter().copied().collect()
    }
}

/// Appends the spheres.
impl<V: Vector> Extend<Sphere<V>> for Spheres<V> {
    fn extend<I: IntoIterator<Item = Sphere<V>>>(&mut self, iter: I) {
        let iter = iter.into_iter();
        let (at_least, _) = iter.size_hint();
        self.reserve(at_least);
        for sphere in iter {
            self.push(sphere);
        }
    }
}

/// Appends copies of the spheres.
impl<'a, V: Vector> Extend<&'a Sphere<V>> for Spheres<V> {
    fn extend<I: IntoIterator<Item = &'a Sphere<V>>>(&mut self, iter: I) {
        self.extend(iter.into_iter().copied());
    }
}

/// Returns the spheres by ascending index.
impl<V: Vector> IntoIterator for Spheres<V> {
    type Item = Sphere<V>;
    type IntoIter = alloc::vec::IntoIter<Sphere<V>>;

    fn into_iter(self) -> Self::IntoIter {
        self.spheres.into_iter()
    }
}

/// Returns the spheres by ascending index.
impl<'a, V: Vector> IntoIterator for &'a Spheres<V> {
    type Item = Sphere<V>;
    type IntoIter = iter::Copied<slice::Iter<'a, Sphere<V>>>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.spheres.iter().copied()
    }
}
