//! A collection of few or changing spheres, which are all tested: by a filter over many lanes, and the few that pass by the exact
//! routine.

use alloc::vec::Vec;
use core::ops::Range;
use core::{fmt, iter, slice};

use super::filter::{Block, FEW, MARGIN, Segment};
use super::lanes::{Instructions, LANES, Lanes, Vectorized};
use crate::hittable::{nearest, nearest_among};
use crate::{Hit, Hittable, Ray, Sphere};

/// How many blocks have a bit for each sphere in one word.
const BLOCKS_IN_A_WORD: usize = 64 / LANES;

/// A collection of few or changing spheres in `f32`, which finds the nearest hit by testing many spheres at a time.
///
/// It returns what [`nearest`] returns for a slice of the same spheres, bit for bit: the same hit and the same index, the lowest
/// among equal distances. It takes less time, because most spheres are dropped in single precision, many at a time. The error of this
/// test is bounded, so it never drops a sphere that is hit; the spheres that pass it are intersected exactly.
///
/// Any spheres are allowed. Those that no ray can hit, with a NaN, an infinity or a negative radius, cost no more than others. A
/// sphere with a coordinate or a radius beyond 2⁶⁰ is always intersected exactly, and so are all spheres with a ray whose origin is
/// farther than 2⁶⁰ from the world's, or whose direction is longer than that or shorter than 2⁻³⁰.
///
/// # When to use it
///
/// For two spheres or more, up to some hundred, or for any number that changes: spheres can be added, changed and removed one by one.
/// The time of a query is proportional to their number. For more than some hundred that stay as they are,
/// [`SphereBvh`](crate::SphereBvh) skips those far from the ray in groups. (`cargo bench --bench spheres` measures 1
/// to 65,536.)
///
/// # Instructions
///
/// On x86-64 with the feature `std`, AVX-512 (from Rust 1.89 on) or else AVX2 and FMA are used if the machine has them. Otherwise,
/// the instructions are those that the crate is compiled for: SSE2 on x86-64, NEON on aarch64, in WebAssembly 128-bit SIMD with
/// `-C target-feature=+simd128`, and more with `-C target-cpu`. The results are the same. In WebAssembly, in Node.js, 1,024 spheres
/// take 0.26 times as long as a loop over the textbook's formula, 46 take 0.4 times, and 8 as long (`tests/targets/run costs`, in
/// the repository).
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
pub struct Spheres {
    pub(super) spheres: Vec<Sphere>,
    /// The same spheres as the filter needs them.
    pub(super) blocks: Vec<Block>,
}

impl Spheres {
    /// Creates an empty collection.
    #[inline]
    #[must_use]
    pub const fn new() -> Self {
        Self { spheres: Vec::new(), blocks: Vec::new() }
    }

    /// Creates an empty collection with space for at least `capacity` spheres.
    #[must_use]
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            spheres: Vec::with_capacity(capacity),
            blocks: Vec::with_capacity(capacity.div_ceil(LANES)),
        }
    }

    /// Reserves space for at least `additional` more spheres.
    pub fn reserve(&mut self, additional: usize) {
        self.spheres.reserve(additional);
        let blocks = self.len().saturating_add(additional).div_ceil(LANES);
        self.blocks.reserve(blocks.saturating_sub(self.blocks.len()));
    }

    /// Appends a sphere. Its index is the number of spheres before it.
    pub fn push(&mut self, sphere: Sphere) {
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
    pub fn set(&mut self, index: usize, sphere: Sphere) -> Option<Sphere> {
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
    pub fn swap_remove(&mut self, index: usize) -> Option<Sphere> {
        if index >= self.len() {
            return None;
        }
        let removed = self.spheres.swap_remove(index);
        if index < self.len() {
            self.update(index);
        }
        let last = self.len();
        if let Some(block) = self.blocks.last_mut() {
            block.clear(last % LANES);
        }
        self.blocks.truncate(last.div_ceil(LANES));
        Some(removed)
    }

    /// Removes all spheres, and keeps the allocated memory.
    pub fn clear(&mut self) {
        self.spheres.clear();
        self.blocks.clear();
    }

    /// Tells the filter of a sphere.
    fn update(&mut self, index: usize) {
        if let (Some(sphere), Some(block)) =
            (self.spheres.get(index), self.blocks.get_mut(index / LANES))
        {
            block.set(index % LANES, sphere, MARGIN);
        }
    }

    /// Returns the number of spheres.
    #[inline]
    pub fn len(&self) -> usize {
        self.spheres.len()
    }

    /// Returns whether there are no spheres.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// Returns the sphere at `index`, or `None` if `index` is out of bounds.
    #[inline]
    pub fn get(&self, index: usize) -> Option<Sphere> {
        self.spheres.get(index).copied()
    }

    /// Returns a slice of all spheres, by ascending index.
    #[inline]
    pub fn as_slice(&self) -> &[Sphere] {
        &self.spheres
    }

    /// Returns an iterator over the spheres, by ascending index.
    #[inline]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Sphere> + DoubleEndedIterator + Clone + '_ {
        self.into_iter()
    }

    /// Returns the nearest hit with `t` in `range`, and the index of its sphere: of equal `t`, the lowest index.
    #[inline]
    pub fn nearest(&self, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        if self.len() <= FEW {
            return self.nearest_of(self.few_near(ray), ray, range);
        }
        self.nearest_in_lanes(Lanes::best(), ray, range)
    }

    /// The same with that set of instructions.
    pub(super) fn nearest_in_lanes(
        &self,
        lanes: Lanes,
        ray: &Ray,
        range: Range<f32>,
    ) -> Option<(usize, Hit)> {
        if !Segment::allows(ray) {
            return nearest(&self.spheres, ray, range);
        }
        let segment = Segment::new(ray, MARGIN);
        if let Some(near) = self.word_near(lanes, &segment, range.end) {
            return self.nearest_of(near, ray, range);
        }
        let mut near = Near::new(self, lanes, &segment);
        nearest_among(ray, range, |end| near.next(end))
    }

    /// [`Hittable::occludes`] with that set of instructions.
    pub(super) fn occludes_in_lanes(&self, lanes: Lanes, ray: &Ray, range: Range<f32>) -> bool {
        if !Segment::allows(ray) {
            return self.spheres.occludes(ray, range);
        }
        let segment = Segment::new(ray, MARGIN);
        if let Some(near) = self.word_near(lanes, &segment, range.end) {
            return self.any_of(near, ray, range);
        }
        let mut near = Near::new(self, lanes, &segment);
        iter::from_fn(|| near.next(range.end))
            .any(|(_, sphere)| sphere.occludes(ray, range.clone()))
    }

    /// A bit for each of the first [`FEW`] spheres that the ray may meet, and perhaps for others.
    #[inline]
    fn few_near(&self, ray: &Ray) -> u64 {
        match self.blocks.first() {
            Some(block) if Segment::allows(ray) => {
                block.few_near_half_line(&Segment::new(ray, MARGIN)).into()
            }
            Some(_) => (1 << FEW) - 1,
            None => 0,
        }
    }

    /// A bit for each sphere that the ray may meet before `end`, and perhaps for others, if a word has bits for all.
    #[inline(always)]
    fn word_near(&self, lanes: Lanes, segment: &Segment, end: f32) -> Option<u64> {
        let blocks = self.blocks.as_slice();
        (blocks.len() <= BLOCKS_IN_A_WORD).then(|| lanes.run(&Filter { blocks, segment, end }).1)
    }

    /// The nearest of those of the first 64 that have a bit. Where none has, that takes no call.
    #[inline(always)]
    fn nearest_of(&self, near: u64, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        if near == 0 { None } else { self.nearest_of_some(near, ray, range) }
    }

    #[inline(never)]
    fn nearest_of_some(&self, near: u64, ray: &Ray, range: Range<f32>) -> Option<(usize, Hit)> {
        let mut near = self.near(near);
        nearest_among(ray, range, |_| near.next())
    }

    /// Whether any of those of the first 64 that have a bit is hit.
    #[inline(always)]
    fn any_of(&self, near: u64, ray: &Ray, range: Range<f32>) -> bool {
        near != 0 && self.any_of_some(near, ray, range)
    }

    #[inline(never)]
    fn any_of_some(&self, near: u64, ray: &Ray, range: Range<f32>) -> bool {
        self.near(near).any(|(_, sphere)| sphere.occludes(ray, range.clone()))
    }

    /// Those of the first 64 that have a bit.
    #[inline(always)]
    fn near(&self, near: u64) -> impl Iterator<Item = (usize, &Sphere)> {
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
struct Near<'a> {
    lanes: Lanes,
    segment: &'a Segment,
    spheres: &'a [Sphere],
    blocks: &'a [Block],
    /// How many of the blocks have been filtered.
    filtered: usize,
    /// The spheres that have passed and were not given yet, and the index of the first of that word.
    passed: Bits,
    first: usize,
}

impl<'a> Near<'a> {
    // The segment by reference: to copy it just after it was written costs more than all else here.
    #[inline(always)]
    fn new(Spheres { spheres, blocks }: &'a Spheres, lanes: Lanes, segment: &'a Segment) -> Self {
        Self { lanes, segment, spheres, blocks, filtered: 0, passed: Bits(0), first: 0 }
    }

    /// The next one that the ray may meet before `end`.
    #[inline(always)]
    fn next(&mut self, end: f32) -> Option<(usize, &'a Sphere)> {
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

impl Hittable for Spheres {
    #[inline]
    fn intersect(&self, ray: &Ray, range: Range<f32>) -> Option<Hit> {
        self.nearest(ray, range).map(|(_, hit)| hit)
    }

    /// Returns whether any sphere is hit, at the first one found.
    #[inline]
    fn occludes(&self, ray: &Ray, range: Range<f32>) -> bool {
        if self.len() <= FEW {
            return self.any_of(self.few_near(ray), ray, range);
        }
        self.occludes_in_lanes(Lanes::best(), ray, range)
    }
}

/// Formats the spheres as a list.
impl fmt::Debug for Spheres {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.spheres.fmt(formatter)
    }
}

/// Compares the spheres, as slices do.
impl PartialEq for Spheres {
    fn eq(&self, other: &Self) -> bool {
        self.spheres == other.spheres
    }
}

/// Takes the spheres without copying them.
impl From<Vec<Sphere>> for Spheres {
    fn from(spheres: Vec<Sphere>) -> Self {
        let blocks = spheres
            .chunks(LANES)
            .map(|spheres| {
                let mut block = Block::EMPTY;
                for (lane, sphere) in spheres.iter().enumerate() {
                    block.set(lane, sphere, MARGIN);
                }
                block
            })
            .collect();
        Self { spheres, blocks }
    }
}

impl FromIterator<Sphere> for Spheres {
    fn from_iter<I: IntoIterator<Item = Sphere>>(iter: I) -> Self {
        iter.into_iter().collect::<Vec<_>>().into()
    }
}

impl Extend<Sphere> for Spheres {
    fn extend<I: IntoIterator<Item = Sphere>>(&mut self, iter: I) {
        let iter = iter.into_iter();
        let (at_least, _) = iter.size_hint();
        self.reserve(at_least);
        for sphere in iter {
            self.push(sphere);
        }
    }
}

impl<'a> IntoIterator for &'a Spheres {
    type Item = Sphere;
    type IntoIter = iter::Copied<slice::Iter<'a, Sphere>>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.spheres.iter().copied()
    }
}
