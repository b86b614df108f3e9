//! What is asked about the crossings of a line, the choice of the root that answers it, and the answer.

use core::cmp::Ordering;
use core::ops::Range;

use glam::DVec3;

/// One of the two roots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    /// Where the line enters.
    Near,
    /// Where it leaves.
    Far,
}

impl Side {
    /// How the root compares with a number, by the signs of the quadratic there and of what is from there to the closest
    /// approach, which does not count within the chord.
    #[inline(always)]
    pub(crate) fn compared(self, quadratic: Ordering, ahead: Ordering) -> Ordering {
        match (self, quadratic) {
            // Outside the chord, the number lies before both roots or behind both.
            (_, Ordering::Greater) => ahead,
            // At a root: at the near one where the closest approach is still ahead, at the far one where it is past.
            (Self::Near, Ordering::Equal) if ahead.is_ge() => Ordering::Equal,
            (Self::Far, Ordering::Equal) if ahead.is_le() => Ordering::Equal,
            (Self::Near, _) => Ordering::Less,
            (Self::Far, _) => Ordering::Greater,
        }
    }
}

/// What a step says.
pub(crate) enum Verdict<T> {
    /// The line misses, or nothing is ahead in the range.
    Miss,
    Hit(T),
    /// The next step has to look.
    Doubt,
}

impl<T> Verdict<T> {
    /// The verdict of `next` on a hit.
    #[inline(always)]
    pub(crate) fn and_then<U>(self, next: impl FnOnce(T) -> Verdict<U>) -> Verdict<U> {
        match self {
            Self::Miss => Verdict::Miss,
            Self::Hit(hit) => next(hit),
            Self::Doubt => Verdict::Doubt,
        }
    }
}

/// A hit in `f64`, whose `t` is rounded to the format asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) t: f64,
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
}

/// The two crossings, as a step knows them.
pub(crate) trait Crossings {
    /// What the step knows of a root.
    type Root;

    /// The root, correctly rounded, if this step can tell it.
    fn root(&mut self, side: Side) -> Option<(f64, Self::Root)>;

    /// The hit at that root, as [`points`](super::points) rounds it, if this step can tell it.
    fn hit(&mut self, side: Side, t: f64, root: Self::Root) -> Option<Found>;
}

/// What is asked of the crossings.
#[derive(Clone, Debug)]
pub(crate) enum Question {
    /// The first crossing with a finite t > 0 in the range.
    Nearest(Range<f64>),
    /// The far crossing, if its t is finite and above 0.
    Exit,
    /// Both roots.
    Both,
}

/// The answer to each question.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Answer {
    /// To [`Question::Exit`], too.
    Nearest(Found),
    /// Ascending.
    Roots([f64; 2]),
}

impl Answer {
    #[inline(always)]
    pub(crate) fn nearest(self) -> Option<Found> {
        if let Self::Nearest(found) = self { Some(found) } else { None }
    }

    #[inline(always)]
    pub(crate) fn roots(self) -> Option<[f64; 2]> {
        if let Self::Roots(roots) = self { Some(roots) } else { None }
    }
}

impl Question {
    #[inline(always)]
    pub(crate) fn ask(&self, crossings: &mut impl Crossings) -> Verdict<Answer> {
        let mut roots = [0.0; 2];
        for (side, t) in [Side::Near, Side::Far].into_iter().zip(&mut roots) {
            if matches!(self, Self::Exit) && side == Side::Near {
                continue;
            }
            let Some((rounded, root)) = crossings.root(side) else { return Verdict::Doubt };
            *t = rounded;
            let is_in_range = match self {
                Self::Nearest(range) => range.contains(&rounded),
                Self::Exit => true,
                Self::Both => continue,
            };
            if rounded > 0.0 && rounded < f64::INFINITY && is_in_range {
                let found = crossings.hit(side, rounded, root);
                return found.map_or(Verdict::Doubt, |found| Verdict::Hit(Answer::Nearest(found)));
            }
        }
        match self {
            Self::Nearest(_) | Self::Exit => Verdict::Miss,
            Self::Both => Verdict::Hit(Answer::Roots(roots)),
        }
    }
}
