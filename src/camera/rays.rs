//! The rays of an image, one after the other.

use core::iter::FusedIterator;
use core::ops::Range;

use glam::DVec3;

use super::Camera;
use super::pixels::Axis;
use crate::{Ray, Vector};

/// The rays of an image, row by row: see [`Camera::rays`].
///
/// Its length is exact, except where `usize` cannot hold it, on targets of less than 64 bits: there `len` is
/// `usize::MAX`. `nth`, `last` and `count` take no longer than `next`.
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Rays<V: Vector = glam::Vec3> {
    camera: Camera<V>,
    columns: Axis,
    rows: Axis,
    width: u32,
    /// What is left of the pixels, counted row by row.
    pixels: Range<u64>,
    /// The center of the next pixel, and what the rays of its row have in common.
    x: f64,
    y: f64,
    row: DVec3,
}

impl<V: Vector> Rays<V> {
    #[inline]
    pub(super) fn new(camera: &Camera<V>, width: u32, height: u32) -> Self {
        let [columns, rows] = camera.axes(width, height);
        let mut rays = Self {
            camera: *camera,
            columns,
            rows,
            width,
            pixels: 0..u64::from(width) * u64::from(height),
            x: 0.5,
            y: 0.5,
            row: DVec3::ZERO,
        };
        rays.begin_row(0.5);
        rays
    }

    /// Goes to the first pixel of the row whose centers have this y.
    #[inline]
    fn begin_row(&mut self, y: f64) {
        self.x = 0.5;
        self.y = y;
        self.row = self.camera.row(self.rows.at(y));
    }

    /// The center of a pixel. There must be one.
    #[inline]
    fn center(&self, index: u64) -> (f64, f64) {
        let width = u64::from(self.width);
        // Both are below 2^32: exact.
        #[expect(clippy::cast_precision_loss, reason = "columns and rows are below 2^32")]
        let (column, row) = ((index % width) as f64, (index / width) as f64);
        (column + 0.5, row + 0.5)
    }

    /// The ray through the center of a pixel, wherever it is.
    fn ray(&self, index: u64) -> Ray<V> {
        let (x, y) = self.center(index);
        self.camera.ray_in_row(self.camera.row(self.rows.at(y)), self.columns.at_center(x))
    }
}

impl<V: Vector> Iterator for Rays<V> {
    type Item = Ray<V>;

    #[inline]
    fn next(&mut self) -> Option<Ray<V>> {
        self.pixels.next()?;
        if self.x > f64::from(self.width) {
            self.begin_row(self.y + 1.0);
        }
        let ray = self.camera.ray_in_row(self.row, self.columns.at_center(self.x));
        self.x += 1.0;
        Some(ray)
    }

    fn nth(&mut self, n: usize) -> Option<Ray<V>> {
        let index = self.pixels.nth(n)?;
        let (x, y) = self.center(index);
        self.begin_row(y);
        self.x = x + 1.0;
        Some(self.camera.ray_in_row(self.row, self.columns.at_center(x)))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.pixels.size_hint()
    }

    #[inline]
    fn count(self) -> usize {
        self.len()
    }

    #[inline]
    fn last(mut self) -> Option<Ray<V>> {
        self.next_back()
    }
}

impl<V: Vector> DoubleEndedIterator for Rays<V> {
    #[inline]
    fn next_back(&mut self) -> Option<Ray<V>> {
        self.pixels.next_back().map(|index| self.ray(index))
    }

    #[inline]
    fn nth_back(&mut self, n: usize) -> Option<Ray<V>> {
        self.pixels.nth_back(n).map(|index| self.ray(index))
    }
}

impl<V: Vector> ExactSizeIterator for Rays<V> {
    #[inline]
    fn len(&self) -> usize {
        self.pixels.size_hint().0
    }
}

impl<V: Vector> FusedIterator for Rays<V> {}
