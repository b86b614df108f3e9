//! The iterator over the rays of an image.

use core::iter::FusedIterator;
use core::ops::Range;

use glam::DVec3;

use super::Camera;
use super::image::Image;
use crate::{Ray, Vector};

/// An iterator over the rays of an image, row by row: see [`Camera::rays`].
///
/// The length is exact, unless it exceeds `usize` on a target of less than 64 bits: then `len` is `usize::MAX`. `nth`, `last` and
/// `count` take constant time, so that `skip` gives each thread its own rows:
///
/// ```
/// use eyeray::{Camera, Hittable, Sphere};
/// use glam::{Vec3, vec3};
/// use rayon::prelude::*;
///
/// # fn main() -> Result<(), eyeray::CameraError> {
/// let camera = Camera::perspective_fov(vec3(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y, 0.8, 1.5)?;
/// // Any shapes, for many threads.
/// let scene: Vec<Box<dyn Hittable + Send + Sync>> = vec![Box::new(Sphere::new(Vec3::ZERO, 1.0))];
///
/// const WIDTH: usize = 60;
/// let mut distances = vec![f32::INFINITY; WIDTH * 40];
/// distances.par_chunks_mut(WIDTH).enumerate().for_each(|(row, distances)| {
///     for (distance, ray) in distances.iter_mut().zip(camera.rays(60, 40).skip(row * WIDTH)) {
///         if let Some(hit) = scene.intersect(&ray, 0.0..f32::INFINITY) {
///             *distance = hit.t;
///         }
///     }
/// });
/// assert!(distances[0] == f32::INFINITY && distances[20 * WIDTH + 30] < 5.0);
/// # Ok(())
/// # }
/// ```
///
/// rayon's `par_bridge` would lose the order of the rays.
#[derive(Clone, Debug)]
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Rays<V: Vector = glam::Vec3> {
    image: Image<V>,
    width: u32,
    /// What is left of the pixels, counted row by row.
    pixels: Range<u64>,
    /// The column and the row of the next pixel, unless the row has ended, and what the rays of that row have in common.
    column: u32,
    row: u32,
    in_row: DVec3,
}

impl<V: Vector> Rays<V> {
    #[inline]
    pub(super) fn new(camera: &Camera<V>, width: u32, height: u32) -> Self {
        let mut rays = Self {
            image: Image::new(camera, width, height),
            width,
            pixels: 0..u64::from(width) * u64::from(height),
            column: 0,
            row: 0,
            in_row: DVec3::ZERO,
        };
        rays.begin_row(0);
        rays
    }

    /// Goes to the first pixel of a row.
    #[inline]
    fn begin_row(&mut self, row: u32) {
        self.column = 0;
        self.row = row;
        self.in_row = self.image.row(row);
    }

    /// The column and the row of a pixel. There must be one.
    #[inline]
    fn place(&self, index: u64) -> (u32, u32) {
        let width = u64::from(self.width);
        #[expect(clippy::cast_possible_truncation, reason = "columns and rows are counted in u32")]
        ((index % width) as u32, (index / width) as u32)
    }

    /// The ray of a pixel, wherever it is.
    fn ray_of(&self, index: u64) -> Ray<V> {
        let (column, row) = self.place(index);
        self.image.ray(column, self.image.row(row))
    }
}

impl<V: Vector> Iterator for Rays<V> {
    type Item = Ray<V>;

    #[inline]
    fn next(&mut self) -> Option<Ray<V>> {
        self.pixels.next()?;
        if self.column == self.width {
            self.begin_row(self.row + 1);
        }
        let ray = self.image.ray(self.column, self.in_row);
        self.column += 1;
        Some(ray)
    }

    fn nth(&mut self, n: usize) -> Option<Ray<V>> {
        let index = self.pixels.nth(n)?;
        let (column, row) = self.place(index);
        self.begin_row(row);
        self.column = column + 1;
        Some(self.image.ray(column, self.in_row))
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
        self.pixels.next_back().map(|index| self.ray_of(index))
    }

    #[inline]
    fn nth_back(&mut self, n: usize) -> Option<Ray<V>> {
        self.pixels.nth_back(n).map(|index| self.ray_of(index))
    }
}

impl<V: Vector> ExactSizeIterator for Rays<V> {
    #[inline]
    fn len(&self) -> usize {
        self.pixels.size_hint().0
    }
}

impl<V: Vector> FusedIterator for Rays<V> {}
