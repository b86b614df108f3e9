//! The view of the molecule: the atom at a pixel, and the pixel of an atom.

use eyeray::{Camera, CameraError, Frame, Hit, Ray, SphereBvh, ViewRect};
use glam::{Vec2, Vec3, vec3};
use rayon::prelude::*;

use crate::arguments::Arguments;
use crate::crystal::{Atom, Element};
use crate::picture::Picture;

pub(crate) struct Viewer {
    atoms: Vec<Atom>,
    spheres: SphereBvh,
    camera: Camera,
    width: u16,
    height: u16,
}

impl Viewer {
    pub(crate) fn new(atoms: Vec<Atom>, arguments: &Arguments) -> Result<Self, CameraError> {
        /// How much of the scene the height of the picture shows.
        const HEIGHT: f32 = 52.0;
        let Arguments { distance, zoom, beside_textbook, width, height, .. } = *arguments;
        // Each of two pictures has half the width.
        let width = if beside_textbook { width.div_ceil(2) } else { width };

        let backwards = vec3(0.5, 0.35, 1.0).normalize();
        let eye = backwards * (distance * Element::Carbon.radius());
        let view_height = HEIGHT / zoom;
        let view_width = view_height * f32::from(width) / f32::from(height);
        let camera = Frame::look_to(eye, -backwards, Vec3::Y)?
            .orthographic(ViewRect::centered(view_width, view_height))?;

        let spheres = atoms.iter().map(|atom| atom.sphere).collect();
        Ok(Self { atoms, spheres, camera, width, height })
    }

    pub(crate) fn atoms(&self) -> &[Atom] {
        &self.atoms
    }

    /// Returns the nearest hit and the index of its atom.
    pub(crate) fn nearest(&self, ray: &Ray) -> Option<(usize, Hit)> {
        self.spheres.nearest(ray, 0.0..f32::INFINITY)
    }

    /// Returns the atom that is seen at a pixel: what the mouse is over.
    pub(crate) fn pick(&self, pixel: Vec2) -> Option<(usize, Hit)> {
        self.nearest(&self.camera.pixel_ray(pixel, self.width.into(), self.height.into()))
    }

    /// Returns the labels of the potassium atoms whose middle is in sight, and the pixels at which they belong.
    pub(crate) fn labels(&self) -> impl Iterator<Item = (Vec2, String)> {
        let of = |&(_, atom): &(usize, &Atom)| atom.element == Element::Potassium;
        self.atoms.iter().enumerate().filter(of).filter_map(|(index, atom)| {
            let Self { camera, width, height, .. } = self;
            let pixel =
                camera.project_to_pixel(atom.sphere.center, (*width).into(), (*height).into())?;
            // In sight if it is itself what is seen there.
            let (seen, _) = self.pick(pixel)?;
            (seen == index).then(|| (pixel, format!("K{index}")))
        })
    }

    /// Returns the rays of the pixels.
    pub(crate) fn rays(&self) -> impl Iterator<Item = Ray> {
        self.camera.rays(self.width.into(), self.height.into())
    }

    /// Draws the picture with the hits of `nearest`.
    pub(crate) fn picture(&self, nearest: impl Fn(&Ray) -> Option<(usize, Hit)> + Sync) -> Picture {
        /// So many rays a pixel, in each direction.
        const SAMPLES: u16 = 3;
        let (width, height) = (u32::from(self.width), u32::from(self.height));
        let samples = u32::from(SAMPLES);
        let row_of_rays = |y: u32| {
            let rays = self.camera.rays(width * samples, height * samples);
            rays.skip((y * width * samples) as usize).take((width * samples) as usize)
        };
        let rows = (0..height).into_par_iter().flat_map_iter(|y| {
            let mut row = vec![Vec3::ZERO; width as usize];
            for y in y * samples..(y + 1) * samples {
                for (x, ray) in row_of_rays(y).enumerate() {
                    row[x / usize::from(SAMPLES)] += self.color(&ray, nearest(&ray));
                }
            }
            row
        });
        let scale = 1.0 / f32::from(SAMPLES * SAMPLES);
        Picture::new(self.width, rows.map(|sum| sum * scale).collect())
    }

    /// The color of a hit: lit from the upper left, and paler in the distance.
    fn color(&self, ray: &Ray, found: Option<(usize, Hit)>) -> Vec3 {
        const BACKGROUND: Vec3 = Vec3::ONE;
        /// How deep the crystal is, at most.
        const DEPTH: f32 = 50.0;
        let Some((index, hit)) = found else { return BACKGROUND };
        let [u, v, w] = self.camera.basis();
        let light = (w + 0.6 * v - 0.5 * u).normalize();
        let diffuse = hit.normal.dot(light).max(0.0);
        let mirrored = ray.direction.reflect(hit.normal).dot(light).max(0.0).powi(24);
        let color = self.atoms[index].element.color() * (0.15 + diffuse) + 0.25 * mirrored;
        let depth = self.camera.depth(hit.point) - self.camera.depth(Vec3::ZERO);
        color.min(Vec3::ONE).lerp(BACKGROUND, (0.5 + depth / DEPTH).clamp(0.0, 1.0) * 0.5)
    }
}
