//! A picture, labels, and the picture file.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "pixels are counted in whole numbers and in f32, and colors become bytes"
)]

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use font8x8::{BASIC_FONTS, UnicodeFonts};
use glam::{Vec2, Vec3, vec2};

/// Colors, row by row from the top.
pub(crate) struct Picture {
    width: u16,
    pixels: Vec<Vec3>,
}

impl Picture {
    pub(crate) fn new(width: u16, pixels: Vec<Vec3>) -> Self {
        Self { width, pixels }
    }

    /// Writes the text, centered at that point.
    pub(crate) fn write(&mut self, center: Vec2, text: &str) {
        /// The width and the height of a letter.
        const SIZE: f32 = 8.0;
        let letters: Vec<_> = text.chars().filter_map(|letter| BASIC_FONTS.get(letter)).collect();
        let mut corner = center.round() - SIZE / 2.0 * vec2(letters.len() as f32, 1.0);
        for letter in letters {
            for (row, bits) in letter.into_iter().enumerate() {
                for column in (0..8).filter(|column| bits >> column & 1 == 1) {
                    self.set(corner + vec2(column as f32, row as f32), Vec3::ONE);
                }
            }
            corner.x += SIZE;
        }
    }

    /// Sets the color of the pixel there, if there is one.
    fn set(&mut self, place: Vec2, color: Vec3) {
        let width = usize::from(self.width);
        if place.cmpge(Vec2::ZERO).all() && (place.x as usize) < width {
            let index = place.y as usize * width + place.x as usize;
            if let Some(pixel) = self.pixels.get_mut(index) {
                *pixel = color;
            }
        }
    }

    /// Returns this picture with another of the same size to its right, and a line between them.
    pub(crate) fn beside(mut self, other: &Self) -> Self {
        let width = usize::from(self.width);
        for row in self.pixels.chunks_mut(width) {
            row[width - 1] = Vec3::ONE;
        }
        let rows = self.pixels.chunks(width).zip(other.pixels.chunks(width));
        let pixels = rows.flat_map(|(left, right)| [left, right].concat()).collect();
        Self { width: 2 * self.width, pixels }
    }

    /// Writes the picture as a PNG.
    pub(crate) fn save(&self, output: &Path) -> Result<(), png::EncodingError> {
        let width = u32::from(self.width);
        let height = (self.pixels.len() / usize::from(self.width)) as u32;
        let file = BufWriter::new(File::create(output)?);
        let mut encoder = png::Encoder::new(file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        let bytes = self.pixels.iter().flat_map(|color| {
            // Of linear light, encoded with a gamma of 2.2.
            color
                .to_array()
                .map(|linear| (255.0 * linear.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8)
        });
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes.collect::<Vec<_>>())?;
        writer.finish()
    }
}
