//! The numbers of spheres, places, leaves and nodes, in 32 bits.

/// How many spheres a hierarchy has at most: the places of all, with the lanes of leaves that are not full, are numbers of 32
/// bits.
pub(super) const MOST: usize = 1 << 31;

/// A number that 32 bits hold, for there are at most [`MOST`] spheres.
#[expect(clippy::cast_possible_truncation, reason = "it is not beyond them")]
pub(super) fn number(number: usize) -> u32 {
    number as u32
}
