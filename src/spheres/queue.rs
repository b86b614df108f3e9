//! A priority queue whose first items need no allocation.

use alloc::vec::Vec;

use arrayvec::ArrayVec;

/// Items of which the first is taken first: up to `FEW` in the queue itself, the first of them last; more in allocated memory, as
/// a binary heap, where the item at place n comes before those at 2 n + 1 and 2 n + 2.
///
/// Few items take less time sorted, and any number takes little time in a heap. What comes first is told with each call, for it
/// depends on more than the items.
#[derive(Clone, Debug)]
pub(super) enum Queue<T, const FEW: usize> {
    Few(ArrayVec<T, FEW>),
    Many(Vec<T>),
}

impl<T: Copy, const FEW: usize> Queue<T, FEW> {
    /// How many items are allocated for at first, as a multiple of the few.
    const MORE: usize = 4;

    #[inline(always)]
    pub(super) fn new() -> Self {
        Self::Few(ArrayVec::new())
    }

    /// The first item.
    #[inline(always)]
    pub(super) fn first(&self) -> Option<&T> {
        match self {
            Self::Few(items) => items.last(),
            Self::Many(items) => items.first(),
        }
    }

    /// Adds an item.
    #[inline(always)]
    pub(super) fn push(&mut self, item: T, is_before: impl Fn(&T, &T) -> bool) {
        if let Self::Few(items) = self {
            if items.try_push(item).is_ok() {
                // What comes before it moves behind it.
                let mut place = items.len() - 1;
                while place > 0 && is_before(&items[place - 1], &item) {
                    items[place] = items[place - 1];
                    place -= 1;
                }
                items[place] = item;
                return;
            }
        }
        self.push_to_many(item, is_before);
    }

    /// Takes the first item.
    #[inline(always)]
    pub(super) fn pop(&mut self, is_before: impl Fn(&T, &T) -> bool) -> Option<T> {
        match self {
            Self::Few(items) => items.pop(),
            Self::Many(items) => pop_from_heap(items, is_before),
        }
    }

    #[cold]
    #[inline(never)]
    fn push_to_many(&mut self, item: T, is_before: impl Fn(&T, &T) -> bool) {
        if let Self::Few(items) = self {
            let mut many = Vec::with_capacity(Self::MORE * FEW);
            // From the first to the last, they are a heap.
            many.extend(items.iter().rev());
            *self = Self::Many(many);
        }
        let Self::Many(items) = self else { return };
        let mut place = items.len();
        items.push(item);
        while place > 0 {
            let above = (place - 1) / 2;
            if !is_before(&item, &items[above]) {
                break;
            }
            items[place] = items[above];
            place = above;
        }
        items[place] = item;
    }
}

#[inline(never)]
fn pop_from_heap<T: Copy>(items: &mut Vec<T>, is_before: impl Fn(&T, &T) -> bool) -> Option<T> {
    let last = items.pop()?;
    let Some(&first) = items.first() else { return Some(last) };
    // The last takes its place, and moves down as long as one below comes before it.
    let mut place = 0;
    loop {
        let mut below = 2 * place + 1;
        if below >= items.len() {
            break;
        }
        if below + 1 < items.len() && is_before(&items[below + 1], &items[below]) {
            below += 1;
        }
        if !is_before(&items[below], &last) {
            break;
        }
        items[place] = items[below];
        place = below;
    }
    items[place] = last;
    Some(first)
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::testing::Random;

    #[test]
    fn gives_the_least_first() {
        let mut random = Random::new(1);
        for most in [1, 2, 7, 8, 9, 33, 200] {
            let mut queue = Queue::<usize, 8>::new();
            let mut expected = Vec::new();
            for _ in 0..2000 {
                if expected.len() < most && random.below(5) < 3 {
                    let item = random.below(50);
                    queue.push(item, |a, b| a < b);
                    expected.push(item);
                    expected.sort_unstable_by(|a, b| b.cmp(a));
                } else {
                    assert_eq!(queue.pop(|a, b| a < b), expected.pop());
                }
                assert_eq!(queue.first(), expected.last());
                if most <= 8 {
                    assert!(matches!(queue, Queue::Few(_)), "allocated for {most}");
                }
            }
        }
    }
}
