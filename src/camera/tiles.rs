//! The iterator over the square tiles of an image, and the pixels of a tile, near ones together.

use core::iter::FusedIterator;
use core::ops::Range;

use super::Camera;
use super::image::Image;
use crate::{Ray, Vector};

/// An iterator over the tiles of an image, row by row: see [`Camera::tiles`].
///
/// The length is exact, unless it exceeds `usize` on a target of less than 64 bits: then `len` is `usize::MAX`. `nth`, `last` and
/// `count` take constant time, so that `skip` or `step_by` gives each thread its own tiles.
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Tiles<V: Vector = glam::Vec3> {
    image: Image<V>,
    width: u32,
    height: u32,
    side: u32,
    /// The tiles in a row of tiles.
    columns: u32,
    /// What is left of the tiles, counted row by row.
    left: Range<u64>,
}

/// A tile of an image: a square part of it, less at the right and at the bottom edge. See [`Camera::tiles`].
#[derive(Clone, Copy, Debug)]
pub struct Tile<V: Vector = glam::Vec3> {
    image: Image<V>,
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

impl<V: Vector> Tiles<V> {
    #[inline]
    pub(super) fn new(camera: &Camera<V>, width: u32, height: u32, side: u32) -> Self {
        let side = side.max(1);
        let [columns, rows] = [width, height].map(|pixels| pixels.div_ceil(side));
        let left = 0..u64::from(columns) * u64::from(rows);
        Self { image: Image::new(camera, width, height), width, height, side, columns, left }
    }

    /// The tile of that number. There must be one.
    #[inline]
    fn tile(&self, index: u64) -> Tile<V> {
        let columns = u64::from(self.columns);
        #[expect(clippy::cast_possible_truncation, reason = "columns and rows are counted in u32")]
        let [column, row] = [(index % columns) as u32, (index / columns) as u32];
        let (x, y) = (column * self.side, row * self.side);
        Tile {
            image: self.image,
            x,
            y,
            width: self.side.min(self.width - x),
            height: self.side.min(self.height - y),
        }
    }
}

impl<V: Vector> Iterator for Tiles<V> {
    type Item = Tile<V>;

    #[inline]
    fn next(&mut self) -> Option<Tile<V>> {
        self.left.next().map(|index| self.tile(index))
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<Tile<V>> {
        self.left.nth(n).map(|index| self.tile(index))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.left.size_hint()
    }

    #[inline]
    fn count(self) -> usize {
        self.len()
    }

    #[inline]
    fn last(mut self) -> Option<Tile<V>> {
        self.next_back()
    }
}

impl<V: Vector> DoubleEndedIterator for Tiles<V> {
    #[inline]
    fn next_back(&mut self) -> Option<Tile<V>> {
        self.left.next_back().map(|index| self.tile(index))
    }

    #[inline]
    fn nth_back(&mut self, n: usize) -> Option<Tile<V>> {
        self.left.nth_back(n).map(|index| self.tile(index))
    }
}

impl<V: Vector> ExactSizeIterator for Tiles<V> {
    #[inline]
    fn len(&self) -> usize {
        self.left.size_hint().0
    }
}

impl<V: Vector> FusedIterator for Tiles<V> {}

impl<V: Vector> Tile<V> {
    /// Returns the column of the image where the tile begins.
    #[inline]
    #[must_use]
    pub const fn x(&self) -> u32 {
        self.x
    }

    /// Returns the row of the image where the tile begins.
    #[inline]
    #[must_use]
    pub const fn y(&self) -> u32 {
        self.y
    }

    /// Returns the width in pixels: the side of the tiles, or what is left of it at the right edge of the image.
    #[inline]
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Returns the height in pixels: the side of the tiles, or what is left of it at the bottom edge of the image.
    #[inline]
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Returns an iterator over the pixels of the tile: the column x and the row y of each, in the image.
    ///
    /// They go in squares of 8 by 8, each of which goes in squares of 4 by 4, each of which goes row by row: every 64 and every
    /// 16 of them lie together, except at the edges of the image.
    ///
    /// ```
    /// use eyeray::Camera;
    /// use glam::Vec3;
    ///
    /// # fn main() -> Result<(), eyeray::CameraError> {
    /// let camera = Camera::perspective_fov(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 0.9, 1.5)?;
    /// if let Some(tile) = camera.tiles(24, 16, 8).nth(1) {
    ///     let pixels: Vec<(u32, u32)> = tile.pixels().collect();
    ///     assert_eq!(pixels[..5], [(8, 0), (9, 0), (10, 0), (11, 0), (8, 1)]);
    ///     assert_eq!(pixels[16..18], [(12, 0), (13, 0)]);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    #[inline]
    pub fn pixels(&self) -> impl ExactSizeIterator<Item = (u32, u32)> + Clone + use<V> {
        let Self { x, y, .. } = *self;
        Places::new(self.width, self.height).map(move |(right, down)| (x + right, y + down))
    }

    /// Returns an iterator over the rays through the centers of the pixels, in the order of [`pixels`](Self::pixels).
    ///
    /// Each has the bits of the ray that [`Camera::rays`] returns for the pixel.
    #[inline]
    pub fn rays(&self) -> impl ExactSizeIterator<Item = Ray<V>> + Clone + use<V> {
        let Self { image, x, y, .. } = *self;
        let (mut row, mut in_row) = (y, image.row(y));
        Places::new(self.width, self.height).map(move |(right, down)| {
            if row != y + down {
                row = y + down;
                in_row = image.row(row);
            }
            image.ray(x + right, in_row)
        })
    }
}

/// The places in a rectangle, from its corner, in squares of 8 by 8, each in squares of 4 by 4.
#[derive(Clone, Debug)]
struct Places {
    width: u32,
    height: u32,
    next: (u32, u32),
    left: u64,
}

impl Places {
    #[inline]
    fn new(width: u32, height: u32) -> Self {
        Self { width, height, next: (0, 0), left: u64::from(width) * u64::from(height) }
    }

    /// The place after this one, unless that is the last.
    #[inline]
    fn after(&self, (x, y): (u32, u32)) -> (u32, u32) {
        // In steps of a pixel within a square of 4, of such a square within one of 8, and of that within the rectangle: by the
        // bits of x and y that tell one square from another.
        for [step, square] in [[!0, !3], [!3, !7], [!7, 0]] {
            let last = |x: u32, square: u32| x | !square;
            let [right, below] = [x, y].map(|x| last(x, step).saturating_add(1));
            if right <= last(x, square) && right < self.width {
                return (right, y & step);
            }
            if below <= last(y, square) && below < self.height {
                return (x & square, below);
            }
        }
        (x, y)
    }
}

impl Iterator for Places {
    type Item = (u32, u32);

    #[inline]
    fn next(&mut self) -> Option<(u32, u32)> {
        self.left = self.left.checked_sub(1)?;
        let place = self.next;
        self.next = self.after(place);
        Some(place)
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        (0..self.left).size_hint()
    }
}

impl ExactSizeIterator for Places {
    #[inline]
    fn len(&self) -> usize {
        self.size_hint().0
    }
}
