//! The rays through the centers of an image's pixels.

use glam::DVec3;

use super::Camera;
use super::pixels::Axis;
use crate::{Ray, Vector};

/// A camera, and the image that shows its view rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Image<V: Vector> {
    camera: Camera<V>,
    common: V,
    columns: Axis,
    rows: Axis,
}

impl<V: Vector> Image<V> {
    #[inline]
    pub(super) fn new(camera: &Camera<V>, width: u32, height: u32) -> Self {
        let [columns, rows] = camera.axes(width, height);
        Self { camera: *camera, common: camera.common(), columns, rows }
    }

    /// What the rays of a row have in common.
    #[inline]
    pub(super) fn row(&self, row: u32) -> DVec3 {
        self.camera.row(self.rows.at(f64::from(row) + 0.5))
    }

    /// The ray of a column in such a row.
    #[inline]
    pub(super) fn ray(&self, column: u32, in_row: DVec3) -> Ray<V> {
        self.camera.ray_in_row(self.common, in_row, self.columns.at_center(f64::from(column) + 0.5))
    }
}
