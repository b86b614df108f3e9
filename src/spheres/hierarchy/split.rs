//! Splits spheres in two, and these again, until 16 are left: a binary tree.
//!
//! A surface-area heuristic tells where (Goldsmith and Salmon, *Automatic Creation of Object Hierarchies for Ray Tracing*, 1987):
//! where the cost is least, which is the sum over both halves of the area of the box around one times the number of leaves that
//! it needs. Leaves are counted whole, so halves that fill them are preferred. The candidates are the limits of a few bins on
//! each axis (Wald, *On fast Construction of SAH-based Bounding Volume Hierarchies*, 2007).
//!
//! The median is taken where it costs hardly more, rounded so that one half is full leaves in full nodes: then the tree takes
//! less memory, and more of it stays in the caches.
//!
//! Where a few spheres are far from the others, bins of equal width hold nearly all in one or two. Then those two are divided
//! into bins again and again, on each axis, and one more candidate is to split what is in them all from the strays.
//!
//! Centers are in `f32`, relative to that of their region ([`region`](super::region)). Where what is left is small beside the
//! region, it becomes one of its own.

use alloc::vec::Vec;
use core::ops::Range;

use glam::{DVec3, Vec4};

use super::number::{MOST, number};
use crate::spheres::lanes::LANES;
use crate::spheres::local::{narrow, to_f32};
use crate::{Sphere, Vector};

/// Into how many bins spheres are sorted on each axis.
const BINS: usize = 16;

/// Of how many spheres, at least, the bins are made up.
const SAMPLE: usize = 2048;

/// Up to which multiple of the least cost spheres are split by the median.
const TOLERANCE: f32 = 1.05;

/// A float whose bits end with those of an integer that was added to it.
const INTEGER: f32 = 8_388_608.0; // 2^23

/// How many spheres are in a leaf on average, at least, except in the last one: this limits the memory.
const LEAST_IN_A_LEAF: usize = 14;

/// How much deeper the tree may be than one of equal halves.
const MORE_SPLITS: u32 = 12;

/// How deep the tree is at most, of [`MOST`] spheres.
pub(super) const DEEPEST: usize = (MOST / LANES).ilog2() as usize + MORE_SPLITS as usize;

/// Which part of a region's extent a subtree is at most that becomes a region of its own. The errors of the boxes are 2⁻²⁰ of the
/// extent: 2⁻⁸ of what is a little larger than that part.
const SMALL: f32 = 1.0 / 4096.0;

/// How many regions are one in the other at most.
pub(super) const MOST_NESTED: usize = 12;

/// How often a center is found: coordinates of 24 bits make that of 53 in three times.
const MOST_CENTERINGS: usize = 3;

/// How far off the center may be, in half the size of what is around it.
const OFF_CENTER: f64 = 1.0 / 16.0;

/// Which part of all makes two bins of sixteen the place of nearly all.
const NEARLY_ALL: [usize; 2] = [7, 8];

/// A sphere, and its place in the order in which the spheres were given.
#[derive(Clone, Copy)]
pub(super) struct Member {
    /// The center, relative to that of the region, and the radius, in a vector.
    pub(super) sphere: Vec4,
    pub(super) index: u32,
}

impl Member {
    #[inline(always)]
    pub(super) fn new<V: Vector>(index: u32, sphere: &Sphere<V>, center: V) -> Self {
        let Sphere { center: own, radius } = *sphere;
        Self { sphere: narrow(own - center).extend(to_f32(radius)), index }
    }
}

/// A binary tree.
pub(super) struct Binary<V> {
    /// The root last; of no members, none.
    pub(super) splits: Vec<Split>,
    /// The centers of its regions, the whole tree's first.
    pub(super) centers: Vec<V>,
}

/// A node of the binary tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    /// Half the surface area of the box around its members.
    pub(super) area: f32,
    /// Where they are among all members.
    first: u32,
    count: u32,
    /// The places of its halves in the tree, lower than its own. Zeros in a leaf.
    pub(super) halves: [u32; 2],
    /// Which region it is the root of, if of one.
    pub(super) region: Option<u32>,
}

impl Split {
    /// Where its members are among all.
    pub(super) fn members(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }

    /// Whether its members fit into a leaf.
    pub(super) fn is_leaf(&self) -> bool {
        self.count as usize <= LANES
    }
}

/// Sorts the members, which are some of the spheres, so that those of each half lie together.
pub(super) fn split_up<V: Vector>(members: &mut [Member], spheres: &[Sphere<V>]) -> Binary<V> {
    let mut splitter =
        Splitter { spheres, tree: Binary { splits: Vec::new(), centers: Vec::new() } };
    if !members.is_empty() {
        let fewest = members.len().div_ceil(LANES);
        let limits = Limits {
            leaves: fewest.max(members.len() / LEAST_IN_A_LEAF),
            splits: halvings(members) + MORE_SPLITS,
        };
        let mut frame = Frame { center: V::ZERO, extent: f32::INFINITY, nested: 0 };
        splitter.begin_region(members, &mut frame);
        splitter.split(members, 0, limits, frame);
    }
    splitter.tree
}

/// How many leaves the members may become, and how many splits one below the other.
#[derive(Clone, Copy)]
struct Limits {
    leaves: usize,
    splits: u32,
}

/// The region that members are in.
#[derive(Clone, Copy)]
struct Frame<V> {
    center: V,
    extent: f32,
    /// In how many others it is.
    nested: usize,
}

struct Splitter<'a, V: Vector> {
    spheres: &'a [Sphere<V>],
    tree: Binary<V>,
}

impl<V: Vector> Splitter<'_, V> {
    /// Splits the members, the first of which has that place among all. Returns the place of the split in the tree.
    fn split(
        &mut self,
        members: &mut [Member],
        first: u32,
        limits: Limits,
        mut frame: Frame<V>,
    ) -> u32 {
        let mut extent = members.iter().fold(Extent::NONE, Extent::with);
        let mut halves = [0; 2];
        let mut region = None;
        if members.len() > LANES {
            if extent.around.half_size() < frame.extent * SMALL && frame.nested < MOST_NESTED {
                region = Some(number(self.tree.centers.len()));
                extent = self.begin_region(members, &mut frame);
            }
            let by_area = if limits.splits > halvings(members) {
                split_by_area(members, &extent, limits.leaves)
            } else {
                None
            };
            let before = by_area.unwrap_or_else(|| halve(members, &extent));
            let count = members.len();
            let (left, right) = members.split_at_mut(before);
            let [least_left, least_right] = leaves_of([left.len(), right.len()]);
            let more = limits.leaves.saturating_sub(least_left + least_right);
            let more_left = share(number(more), number(left.len()), number(count)) as usize;
            let splits = limits.splits.saturating_sub(1);
            let limits_left = Limits { leaves: least_left + more_left, splits };
            let limits_right = Limits { leaves: least_right + more - more_left, splits };
            let first_right = first + number(before);
            halves = [
                self.split(left, first, limits_left, frame),
                self.split(right, first_right, limits_right, frame),
            ];
        }
        let area = extent.around.area();
        self.tree.splits.push(Split { area, first, count: number(members.len()), halves, region });
        number(self.tree.splits.len() - 1)
    }

    /// Makes a region of the members: their coordinates are relative to a center of its own from now on. Returns their extent.
    fn begin_region(&mut self, members: &mut [Member], frame: &mut Frame<V>) -> Extent {
        let mut extent = members.iter().fold(Extent::NONE, Extent::with);
        let mut center = frame.center;
        for _ in 0..MOST_CENTERINGS {
            center = V::from_f64(center.to_f64() + extent.around.middle());
            for member in &mut *members {
                *member = Member::new(member.index, &self.spheres[member.index as usize], center);
            }
            extent = members.iter().fold(Extent::NONE, Extent::with);
            let off = extent.around.middle().abs().max_element();
            if off <= f64::from(extent.around.half_size()) * OFF_CENTER {
                break;
            }
        }
        self.tree.centers.push(center);
        *frame = Frame { center, extent: extent.around.half_size(), nested: frame.nested + 1 };
        extent
    }
}

/// That part of a number that `part` is of `whole`. The product does not fit into 32 bits.
fn share(number: u32, part: u32, whole: u32) -> u32 {
    let share = u64::from(number) * u64::from(part) / u64::from(whole.max(1));
    // No more than the number, for the part is no more than the whole.
    u32::try_from(share).unwrap_or(number)
}

/// How many halvings it takes until the members fit into leaves.
fn halvings(members: &[Member]) -> u32 {
    members.len().div_ceil(LANES).next_power_of_two().trailing_zeros()
}

/// How many leaves so many members need.
fn leaves_of(counts: [usize; 2]) -> [usize; 2] {
    counts.map(|count| count.div_ceil(LANES))
}

/// A box. The fourth numbers are of no account.
#[derive(Clone, Copy)]
struct Around {
    low: Vec4,
    high: Vec4,
}

impl Around {
    const NONE: Self = Self { low: Vec4::INFINITY, high: Vec4::NEG_INFINITY };

    /// The box of a sphere, but for rounding.
    #[inline(always)]
    fn of(member: &Member) -> Self {
        let radius = Vec4::splat(member.sphere.w);
        Self { low: member.sphere - radius, high: member.sphere + radius }
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Half its largest side.
    fn half_size(self) -> f32 {
        ((self.high - self.low) * 0.5).truncate().max_element()
    }

    fn middle(self) -> DVec3 {
        (self.low.truncate().as_dvec3() + self.high.truncate().as_dvec3()) * 0.5
    }

    /// Half its surface area.
    #[inline(always)]
    fn area(self) -> f32 {
        let size = self.high - self.low;
        size.x * (size.y + size.z) + size.y * size.z
    }
}

/// The box around spheres, and that around their centers.
struct Extent {
    around: Around,
    centers: Around,
}

impl Extent {
    const NONE: Self = Self { around: Around::NONE, centers: Around::NONE };

    #[inline(always)]
    fn with(self, member: &Member) -> Self {
        let center = Around { low: member.sphere, high: member.sphere };
        Self { around: self.around.and(Around::of(member)), centers: self.centers.and(center) }
    }
}

/// The members of a bin.
#[derive(Clone, Copy)]
struct Bin {
    around: Around,
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self { around: Around::NONE, count: 0 };

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self { around: self.around.and(other.around), count: self.count + other.count }
    }
}

/// Splits where it costs least or hardly more, into so many leaves at most. Returns how many members are before: `None` if all
/// their centers are nearly the same, or if that takes too many leaves.
fn split_by_area(members: &mut [Member], extent: &Extent, leaves: usize) -> Option<usize> {
    let Around { low, high } = extent.centers;
    // A size of zero has all in the first bin.
    #[expect(clippy::cast_precision_loss, reason = "it is small")]
    let scale = Vec4::splat((BINS - 1) as f32) / (high - low).max(Vec4::splat(f32::MIN_POSITIVE));
    let bins_of = |member: &Member| (member.sphere - low) * scale + INTEGER;
    let bin_of = |number: f32| number.to_bits() as usize % BINS;

    let mut bins = [[Bin::EMPTY; BINS]; 3];
    // A sample of many is enough.
    let step = (members.len() / SAMPLE).max(1);
    for member in members.iter().step_by(step) {
        let bin = Bin { around: Around::of(member), count: step };
        for (bins, number) in bins.iter_mut().zip(bins_of(member).to_array()) {
            let place = bin_of(number);
            bins[place] = bins[place].and(bin);
        }
    }
    let half = half_of_full(members.len());
    let mut least_half = f32::INFINITY;
    let mut best_half = None;
    let mut least = f32::INFINITY;
    let mut best = None;
    for (axis, bins) in bins.iter().enumerate() {
        let mut all_after = [Bin::EMPTY; BINS];
        let mut after = Bin::EMPTY;
        for place in (0..BINS).rev() {
            after = after.and(bins[place]);
            all_after[place] = after;
        }
        let mut before = Bin::EMPTY;
        for place in 1..BINS {
            if bins[place - 1].count == 0 {
                // Nothing changes.
                continue;
            }
            before = before.and(bins[place - 1]);
            let (after, sooner) = (all_after[place], all_after[place - 1]);
            // The half ends in the bin before this place: at worst, that is in both boxes.
            if (all_after[0].count - sooner.count..before.count).contains(&(half - 1)) {
                let after = if before.count == half { after } else { sooner };
                let cost =
                    cost_of(before.around, half) + cost_of(after.around, members.len() - half);
                if cost < least_half {
                    least_half = cost;
                    best_half = Some(axis);
                }
            }
            if after.count == 0 {
                break;
            }
            let cost = cost_of(before.around, before.count) + cost_of(after.around, after.count);
            let [left, right] = leaves_of([before.count, after.count]);
            if cost < least && left + right <= leaves {
                least = cost;
                best = Some((axis, place));
            }
        }
    }
    if let Some(bulk) = bulk_of(members, step, &bins, extent) {
        if let Some(before) = split_off_strays(members, bulk, least, leaves) {
            return Some(before);
        }
    }
    let (axis, place) = best?;
    if let Some(axis) = best_half.filter(|_| least_half <= least * TOLERANCE) {
        members.select_nth_unstable_by(half, |a, b| a.sphere[axis].total_cmp(&b.sphere[axis]));
        return Some(half);
    }
    let before = partition(members, |member| bin_of(bins_of(member)[axis]) < place);
    (before > 0 && before < members.len()).then_some(before)
}

/// Moves those members to the front. Returns how many there are.
fn partition(members: &mut [Member], is_before: impl Fn(&Member) -> bool) -> usize {
    let (mut before, mut end) = (0, members.len());
    while before < end {
        if is_before(&members[before]) {
            before += 1;
        } else {
            end -= 1;
            members.swap(before, end);
        }
    }
    before
}

/// Where nearly all members of a sample are on each axis, if that is a small part of an axis.
fn bulk_of(
    members: &[Member],
    step: usize,
    bins: &[[Bin; BINS]; 3],
    extent: &Extent,
) -> Option<Around> {
    let mut bulk = Around { low: Vec4::NEG_INFINITY, high: Vec4::INFINITY };
    let mut is_small = false;
    for (axis, bins) in bins.iter().enumerate() {
        let counts = bins.map(|bin| bin.count);
        let size = extent.centers.high[axis] - extent.centers.low[axis];
        if size > 0.0 && place_of_nearly_all(&counts).is_some() {
            let sample = members.iter().step_by(step).map(|member| member.sphere[axis]);
            let (low, high) = zoom(&sample, extent.centers.low[axis], extent.centers.high[axis]);
            // On either side, what the last bins cut off is still close: it would be a region of its own.
            (bulk.low[axis], bulk.high[axis]) = (low - (high - low), high + (high - low));
            is_small = true;
        }
    }
    is_small.then_some(bulk)
}

/// The first of two neighboring bins that hold nearly all.
fn place_of_nearly_all(counts: &[usize; BINS]) -> Option<usize> {
    let [part, of] = NEARLY_ALL;
    let all: usize = counts.iter().sum();
    // Counts are of a sample, and at most 2³¹: their eighths do not overflow.
    counts.windows(2).position(|two| two[0] + two[1] >= all.div_ceil(of) * part)
}

/// Narrows an interval down to two of its bins that hold nearly all of what is in it, again and again.
fn zoom(sample: &(impl Iterator<Item = f32> + Clone), mut low: f32, mut high: f32) -> (f32, f32) {
    // Each time, to an eighth or to nothing.
    loop {
        #[expect(clippy::cast_precision_loss, reason = "it is small")]
        let width = (high - low) / BINS as f32;
        if width.is_nan() || width <= low.abs().max(high.abs()) * f32::EPSILON {
            return (low, high);
        }
        let mut counts = [0; BINS];
        for number in sample.clone().filter(|number| (low..=high).contains(number)) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "of the number of a bin"
            )]
            let place = ((number - low) / width) as usize;
            counts[place.min(BINS - 1)] += 1;
        }
        let Some(place) = place_of_nearly_all(&counts) else { return (low, high) };
        #[expect(clippy::cast_precision_loss, reason = "it is small")]
        let place = place as f32;
        (low, high) = (low + width * place, low + width * (place + 2.0));
    }
}

/// Splits the members whose centers are in a box from the others, if that costs less, into so many leaves at most. Returns how
/// many members are before.
fn split_off_strays(
    members: &mut [Member],
    bulk: Around,
    least: f32,
    leaves: usize,
) -> Option<usize> {
    let is_in_bulk = |member: &Member| {
        let Around { low, high } = bulk;
        let is_in = member.sphere.cmpge(low) & member.sphere.cmple(high);
        is_in.bitmask() & 0b111 == 0b111
    };
    let mut sides = [Bin::EMPTY; 2];
    for member in &*members {
        let side = &mut sides[usize::from(is_in_bulk(member))];
        *side = side.and(Bin { around: Around::of(member), count: 1 });
    }
    let [strays, others] = sides;
    let needed: usize = leaves_of([strays.count, others.count]).iter().sum();
    if strays.count == 0 || others.count == 0 || needed > leaves {
        return None;
    }
    let cost = cost_of(strays.around, strays.count) + cost_of(others.around, others.count);
    (cost < least).then(|| partition(members, is_in_bulk))
}

/// What so many spheres in a box cost a ray: how probably it enters the box, times their leaves.
#[inline(always)]
fn cost_of(around: Around, count: usize) -> f32 {
    #[expect(clippy::cast_precision_loss, reason = "it is an estimate")]
    let leaves = count.div_ceil(LANES) as f32;
    around.area() * leaves
}

/// About half of so many members: as many as fill some of the subtrees that 16 children of a node can be.
fn half_of_full(count: usize) -> usize {
    let mut child = LANES;
    while child < count.div_ceil(LANES) {
        child *= LANES;
    }
    count.div_ceil(child) / 2 * child
}

/// Splits by the median on the axis on which the centers are farthest apart, rounded to full leaves. Returns how many members are
/// before.
fn halve(members: &mut [Member], extent: &Extent) -> usize {
    let half = members.len().div_ceil(LANES) / 2 * LANES;
    let Around { low, high } = extent.centers;
    let axis = (high - low).truncate().max_position();
    members.select_nth_unstable_by(half, |a, b| a.sphere[axis].total_cmp(&b.sphere[axis]));
    half
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use glam::Vec3;
    use sobol_burley::sample;

    use super::*;
    use crate::Sphere;

    fn members(spheres: impl Iterator<Item = Sphere>) -> Vec<Member> {
        (0..).zip(spheres).map(|(index, sphere)| Member::new(index, &sphere, Vec3::ZERO)).collect()
    }

    fn split_members(members: &mut [Member]) -> Vec<Split> {
        let mut spheres = std::vec![Sphere::default(); members.len()];
        for member in &*members {
            spheres[member.index as usize] = Sphere::new(member.sphere.truncate(), member.sphere.w);
        }
        split_up(members, &spheres).splits
    }

    fn random(index: u32) -> Vec3 {
        Vec3::from([0, 1, 2].map(|dimension| sample(index, dimension, 5)))
    }

    /// Checks the tree of the members, and returns how deep it is and how many leaves it has.
    fn depth_and_leaves(members: &mut [Member]) -> (usize, usize) {
        let tree = split_members(members);
        let mut depths: Vec<usize> = Vec::new();
        let mut leaves = 0;
        for split in &tree {
            let [left, right] = split.halves.map(|half| half as usize);
            if split.is_leaf() {
                leaves += 1;
                depths.push(0);
            } else {
                // The halves are all of it, one after the other, and none is empty.
                let [left_half, right_half] = [&tree[left], &tree[right]].map(Split::members);
                assert_eq!(left_half.end, right_half.start);
                assert_eq!(left_half.start..right_half.end, split.members());
                assert!(!left_half.is_empty() && !right_half.is_empty());
                depths.push(1 + depths[left].max(depths[right]));
            }
        }
        assert_eq!(tree.last().map(Split::members), Some(0..members.len()));
        // Each member once.
        let mut indices: Vec<u32> = members.iter().map(|member| member.index).collect();
        indices.sort_unstable();
        assert!(indices.iter().copied().eq(0..number(members.len())));
        (depths.last().copied().unwrap_or(0), leaves)
    }

    #[test]
    fn no_members_are_no_tree() {
        assert!(split_members(&mut []).is_empty());
    }

    /// Spheres in a row, each so much farther out that to cut off the last ones is always the best split.
    #[test]
    fn a_tree_is_not_too_deep() {
        let mut row = members((0..5000_u16).map(|i| {
            let distance = 1e-18 * (0.018 * f32::from(i)).exp2();
            Sphere::new(Vec3::X * distance, distance / 1000.0)
        }));
        let limit = halvings(&row) + MORE_SPLITS;
        let (depth, _) = depth_and_leaves(&mut row);
        assert!(depth <= limit as usize, "{depth}");
        // Without a limit, it would be deeper.
        assert!(depth + 1 >= limit as usize, "{depth}");
    }

    #[test]
    fn leaves_are_full_enough() {
        for (group, extent) in [(9, 0.001), (9, 0.3), (17, 0.001), (3, 0.01), (100, 0.1)] {
            let mut groups = members((0..6000).map(|i| {
                Sphere::new(100.0 * random(i / group) + extent * random(10_000 + i), extent / 20.0)
            }));
            let (_, leaves) = depth_and_leaves(&mut groups);
            assert!(leaves <= 1 + groups.len() / LEAST_IN_A_LEAF, "{group}: {leaves}");
        }
    }

    /// Of a million spheres, on a machine of 32 bits too.
    #[test]
    fn a_share_does_not_overflow() {
        assert_eq!(share(71_428, 500_000, 1_000_000), 35_714);
        assert_eq!(share(u32::MAX, u32::MAX, u32::MAX), u32::MAX);
        assert_eq!(share(7, 0, 0), 0);
    }

    /// What cannot be split by area, for there is no place, or no finite area.
    #[test]
    fn all_spheres_can_be_split() {
        let far = 2.0_f32.powi(60);
        for spheres in [
            members((0..1000).map(|_| Sphere::new(Vec3::ONE, 1.0))),
            members((0..1000).map(|i| Sphere::new(1e-42 * random(i), 0.0))),
            members((0..1000).map(|i| Sphere::new(far * (2.0 * random(i) - 1.0), far))),
        ] {
            let (depth, _) = depth_and_leaves(&mut spheres.clone());
            assert!(depth <= 6 + MORE_SPLITS as usize, "{depth}");
        }
    }

    #[test]
    fn clusters_are_split_apart() {
        let mut clusters = members(
            (0..200).map(|i| Sphere::new((if i % 2 == 0 { -9.0 } else { 9.0 }) + random(i), 0.1)),
        );
        let tree = split_members(&mut clusters);
        let [left, _] = tree.last().map_or([0; 2], |split| split.halves);
        assert_eq!(tree[left as usize].members().len(), 100);
    }
}
