//! The tiles of an image: every pixel once, near ones together, with the rays of `rays`.

use std::collections::HashSet;

use eyeray::{Camera, CameraError, Frame, Ray, Tile, ViewRect};
use glam::{DVec3, Vec3, dvec3, vec3};

fn camera() -> Result<Camera, CameraError> {
    let view = ViewRect { left: -1.0, right: 3.0, bottom: -0.5, top: 1.5 };
    Camera::perspective(vec3(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y, view, 2.0)
}

type Corner = (u32, u32, u32, u32);

fn corner(tile: &Tile) -> Corner {
    (tile.x(), tile.y(), tile.width(), tile.height())
}

#[test]
fn tiles_go_row_by_row_and_end_with_the_image() -> Result<(), CameraError> {
    let tiles = camera()?.tiles(20, 11, 8);
    let expected: [Corner; 6] =
        [(0, 0, 8, 8), (8, 0, 8, 8), (16, 0, 4, 8), (0, 8, 8, 3), (8, 8, 8, 3), (16, 8, 4, 3)];
    assert_eq!(tiles.clone().map(|tile| corner(&tile)).collect::<Vec<_>>(), expected);
    assert_eq!((tiles.len(), tiles.size_hint(), tiles.clone().count()), (6, (6, Some(6)), 6));
    assert_eq!(tiles.clone().nth(4).map(|tile| corner(&tile)), Some(expected[4]));
    assert_eq!(tiles.clone().nth_back(1).map(|tile| corner(&tile)), Some(expected[4]));
    assert_eq!(tiles.clone().last().map(|tile| corner(&tile)), Some(expected[5]));
    let back: Vec<_> = tiles.clone().rev().map(|tile| corner(&tile)).collect();
    assert!(back.iter().eq(expected.iter().rev()));
    // Every second tile, as for one of two threads.
    let odd: Vec<_> = tiles.skip(1).step_by(2).map(|tile| corner(&tile)).collect();
    assert_eq!(odd, [expected[1], expected[3], expected[5]]);
    Ok(())
}

#[test]
fn an_image_without_pixels_has_no_tiles_and_a_side_of_none_is_one() -> Result<(), CameraError> {
    let camera = camera()?;
    for (width, height) in [(0, 0), (0, 7), (7, 0)] {
        assert_eq!(camera.tiles(width, height, 8).next().map(|tile| corner(&tile)), None);
    }
    let single: Vec<_> = camera.tiles(2, 2, 0).map(|tile| corner(&tile)).collect();
    assert_eq!(single, [(0, 0, 1, 1), (1, 0, 1, 1), (0, 1, 1, 1), (1, 1, 1, 1)]);
    Ok(())
}

#[test]
fn the_largest_image_has_tiles_to_its_end() -> Result<(), CameraError> {
    let camera = camera()?;
    let last = camera.tiles(u32::MAX, u32::MAX, 1 << 16).last().map(|tile| corner(&tile));
    let (start, side) = (0xffff << 16, 0xffff);
    assert_eq!(last, Some((start, start, side, side)));
    let whole = camera.tiles(u32::MAX, 3, u32::MAX).next();
    assert_eq!(whole.map(|tile| corner(&tile)), Some((0, 0, u32::MAX, 3)));
    // The last of its pixels, after all of the first squares.
    let pixels = whole.map(|tile| tile.pixels());
    assert_eq!(
        pixels.clone().map(|pixels| pixels.size_hint().0),
        usize::try_from(0x2_ffff_fffd_u64).ok()
    );
    assert_eq!(pixels.and_then(|mut pixels| pixels.nth(4 * 3 * 2)), Some((8, 0)));
    Ok(())
}

/// Each ray has the bits of the ray of its pixel, and each pixel is there once.
fn check_bits(camera: &Camera<DVec3>, width: u32, height: u32, side: u32) {
    let bits = |ray: Ray<DVec3>| {
        let ([a, b, c], [d, e, f]) = (ray.origin.to_array(), ray.direction.to_array());
        [a, b, c, d, e, f].map(f64::to_bits)
    };
    let expected: Vec<_> = camera.rays(width, height).map(bits).collect();
    let mut seen = HashSet::new();
    for tile in camera.tiles(width, height, side) {
        let count = tile.width() as usize * tile.height() as usize;
        assert_eq!((tile.pixels().len(), tile.rays().len()), (count, count));
        assert_eq!((tile.pixels().count(), tile.rays().count()), (count, count));
        for ((x, y), ray) in tile.pixels().zip(tile.rays()) {
            assert!((tile.x()..tile.x() + tile.width()).contains(&x));
            assert!((tile.y()..tile.y() + tile.height()).contains(&y));
            assert!(seen.insert((x, y)), "{x}, {y} again");
            assert_eq!(bits(ray), expected[(y * width + x) as usize], "{x}, {y} of {camera:?}");
        }
    }
    assert_eq!(seen.len(), expected.len());
}

#[test]
fn tiles_have_the_rays_of_all_pixels_bit_for_bit() -> Result<(), CameraError> {
    let frame = Frame::look_at(dvec3(0.1, 0.2, 0.3), DVec3::ZERO, DVec3::Y)?;
    for view in [
        ViewRect::centered(1.6, 0.9),
        ViewRect { left: -0.3, right: 1.1, bottom: -0.7, top: 0.1 },
        ViewRect { left: 0.0, right: 1e-310, bottom: -1e-310, top: -0.0 },
    ] {
        for camera in [frame.perspective(view, 0.7)?, frame.orthographic(view)?] {
            for (width, height) in [(1, 1), (1, 7), (7, 1), (16, 9), (33, 21)] {
                for side in [1, 2, 3, 4, 7, 8, 12, 16, 100] {
                    check_bits(&camera, width, height, side);
                }
            }
        }
    }
    Ok(())
}

/// The least square around the places.
fn extent(places: &[(u32, u32)]) -> u32 {
    let extent = |place: fn(&(u32, u32)) -> u32| {
        let numbers = || places.iter().map(place);
        numbers().max().unwrap_or(0) - numbers().min().unwrap_or(0) + 1
    };
    extent(|(x, _)| *x).max(extent(|(_, y)| *y))
}

#[test]
fn every_sixteen_and_sixty_four_pixels_are_a_square() -> Result<(), CameraError> {
    let camera = camera()?;
    for side in [8, 16, 64] {
        for tile in camera.tiles(128, 64, side) {
            let pixels: Vec<_> = tile.pixels().collect();
            assert!(pixels.chunks(16).all(|pixels| extent(pixels) == 4), "{side}");
            assert!(pixels.chunks(64).all(|pixels| extent(pixels) == 8), "{side}");
        }
    }
    // At the edges, too, they lie together.
    for tile in camera.tiles(61, 37, 16) {
        let pixels: Vec<_> = tile.pixels().collect();
        assert!(pixels.chunks(16).all(|pixels| extent(pixels) <= 16));
    }
    Ok(())
}
