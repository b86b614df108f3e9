//! The unit in which the numbers of a line are integers.

use glam::DVec3;

use super::line::Line;
use crate::arithmetic::scaling::integer_and_exponent;

/// The unit of integers, 2^`exponent`, and how many binary places the largest of them has.
#[derive(Clone, Copy)]
pub(crate) struct Unit {
    pub(crate) exponent: i32,
    pub(crate) places: u32,
}

impl Unit {
    /// The exponent of what is above all of them.
    pub(super) fn top(self) -> i32 {
        self.exponent.saturating_add_unsigned(self.places)
    }

    /// The largest power of two that all coordinates are multiples of, any if these are zeros; `None` where one is not finite.
    #[inline(never)]
    pub(crate) fn common(vectors: &[DVec3]) -> Option<Self> {
        /// The exponent of the last place of the largest number.
        const LARGEST: i32 = 971;
        let (mut unit, mut top) = (LARGEST, i32::MIN);
        for vector in vectors {
            for coordinate in vector.to_array() {
                let (integer, exponent) = integer_and_exponent(coordinate);
                if exponent > LARGEST {
                    return None;
                }
                if integer != 0 {
                    #[expect(clippy::cast_possible_wrap, reason = "at most 64")]
                    let [zeros, bits] =
                        [integer.trailing_zeros(), u64::BITS - integer.leading_zeros()]
                            .map(|places| places as i32);
                    unit = unit.min(exponent + zeros);
                    top = top.max(exponent + bits);
                }
            }
        }
        Some(Self { exponent: unit, places: top.saturating_sub(unit).max(0).unsigned_abs() })
    }

    /// Those of the lengths and of the direction of a line.
    pub(super) fn of_line(line: &Line) -> Option<[Self; 2]> {
        let Line { origin, direction, center, radius } = *line;
        let lengths = Self::common(&[origin, center, DVec3::new(radius, 0.0, 0.0)])?;
        Some([lengths, Self::common(&[direction])?])
    }
}
