//! Cameras from matrices: what is read from them, and what is rejected.

use eyeray::{Camera, CameraArgument, CameraError, Frame, Vector, ViewRect};
use glam::camera::rh::{proj::directx, proj::opengl, view::look_at_mat4, view::look_to_mat4};
use glam::camera::{lh, rh};
use glam::{DMat4, DVec3, Mat4, Quat, Vec2, Vec3, Vec4, vec2, vec3, vec4};

const EYE: Vec3 = Vec3::new(1.0, 2.0, 3.0);

fn view_matrix() -> Mat4 {
    look_to_mat4(EYE, Vec3::NEG_Z, Vec3::Y)
}

fn projection_matrix() -> Mat4 {
    directx::frustum(-1.0, 3.0, -0.5, 1.5, 2.0, 100.0)
}

fn camera(view_matrix: Mat4, projection_matrix: Mat4) -> Result<Camera, CameraError> {
    Camera::from_matrices(&view_matrix, &projection_matrix)
}

#[test]
fn a_camera_is_read_from_plain_matrices() -> Result<(), CameraError> {
    let view = ViewRect { left: -0.5, right: 1.5, bottom: -0.25, top: 0.75 };
    let expected = Frame::look_to(EYE, Vec3::NEG_Z, Vec3::Y)?.perspective(view, 1.0)?;
    assert_eq!(camera(view_matrix(), projection_matrix())?, expected);
    let doubles = [view_matrix(), projection_matrix()].map(|matrix| matrix.as_dmat4());
    let wide: Camera<DVec3> = Camera::from_matrices(&doubles[0], &doubles[1])?;
    assert_eq!(wide, expected.into());
    // Nothing names the precision but the matrix.
    assert_eq!(Camera::from_matrices(&doubles[0], &doubles[1])?.eye(), EYE.as_dvec3());
    Ok(())
}

/// In code for both precisions.
fn again<V: Vector>(
    camera: &Camera<V>,
    projection_matrix: &V::Mat4,
) -> Result<Camera<V>, CameraError> {
    Camera::from_matrices(&camera.view_matrix(), projection_matrix)
}

#[test]
fn a_function_for_both_precisions_takes_matrices() -> Result<(), CameraError> {
    let camera = camera(view_matrix(), projection_matrix())?;
    assert_eq!(again(&camera, &projection_matrix())?, camera);
    let wide = Camera::<DVec3>::from(camera);
    assert_eq!(again(&wide, &projection_matrix().as_dmat4())?, wide);
    Ok(())
}

/// y is downwards in Vulkan's clip space, where it can also be turned by a scale of -1: the image is the same.
#[test]
fn y_downwards_gives_the_same_image() -> Result<(), CameraError> {
    let upwards = camera(view_matrix(), projection_matrix())?;
    let flip = Mat4::from_scale(vec3(1.0, -1.0, 1.0));
    assert_eq!(camera(view_matrix(), flip * projection_matrix())?, upwards);
    let vulkan = rh::proj::vulkan::frustum(-1.0, 3.0, -0.5, 1.5, 2.0, 100.0);
    assert_eq!(camera(view_matrix(), vulkan)?, upwards);
    Ok(())
}

/// An orthographic projection says by its depths alone which way is ahead.
#[test]
fn an_orthographic_camera_looks_to_where_it_sees() -> Result<(), CameraError> {
    let right_handed = [rh::proj::opengl::orthographic, directx::orthographic];
    let left_handed = [lh::proj::opengl::orthographic, lh::proj::directx::orthographic];
    let orthographic = |function: fn(f32, f32, f32, f32, f32, f32) -> Mat4, near, far| {
        camera(Mat4::IDENTITY, function(-4.0, 4.0, -3.0, 3.0, near, far))
    };
    // Before the eye; from it; in part behind it; and from the far plane to the near.
    for (near, far) in [
        (0.1, 100.0),
        (0.0, 100.0),
        (0.0, 1.0),
        (99.0, 100.0),
        (-1.0, 100.0),
        (-99.0, 100.0),
        (100.0, 0.0),
        (100.0, 0.1),
        (100.0, -10.0),
        (1e30, 0.0),
    ] {
        for function in right_handed {
            assert_eq!(orthographic(function, near, far)?.basis()[2], Vec3::Z, "{near} {far}");
        }
        for function in left_handed {
            assert_eq!(orthographic(function, near, far)?.basis()[2], Vec3::NEG_Z, "{near} {far}");
        }
    }
    // As far behind the eye as before it, as in 2D, there is no telling: right-handed.
    // Of many far planes, because few leave a depth that is not quite 1/2.
    for far in (1..=2000_u16).map(|tenths| f32::from(tenths) / 10.0) {
        for function in [right_handed[0], right_handed[1], left_handed[1]] {
            assert_eq!(orthographic(function, -far, far)?.basis()[2], Vec3::Z, "{far}");
        }
        assert_eq!(orthographic(directx::orthographic, far, -far)?.basis()[2], Vec3::Z, "{far}");
    }
    // However the middle was rounded.
    for (near, far) in [(-10.0, 10.0), (10.0, -10.0)] {
        for bits in -2..=2 {
            let mut matrix = directx::orthographic(-4.0, 4.0, -3.0, 3.0, near, far);
            matrix.w_axis.z = f32::from_bits(0.5_f32.to_bits().wrapping_add_signed(bits));
            assert_eq!(camera(Mat4::IDENTITY, matrix)?.basis()[2], Vec3::Z, "{near} {far} {bits}");
        }
    }
    // Where there are no depths: likewise.
    let mut flat = directx::orthographic(-4.0, 4.0, -3.0, 3.0, 0.0, 1.0);
    flat.z_axis.z = 0.0;
    assert_eq!(camera(Mat4::IDENTITY, flat)?.basis()[2], Vec3::Z);
    Ok(())
}

/// An oblique near plane, as for mirrors and portals, changes the depths only; a jitter moves the image by a part of a pixel.
#[test]
fn depths_do_not_matter_and_a_jitter_does() -> Result<(), CameraError> {
    let expected = camera(view_matrix(), projection_matrix())?;
    let mut oblique = projection_matrix();
    let plane = vec4(0.3, -0.2, -1.0, 5.0);
    (oblique.x_axis.z, oblique.y_axis.z, oblique.z_axis.z, oblique.w_axis.z) = plane.into();
    assert_eq!(camera(view_matrix(), oblique)?, expected);

    // Half a pixel to the right and upwards, in an image of 64 by 32.
    let jitter = Mat4::from_translation(vec3(1.0 / 64.0, 1.0 / 32.0, 0.0));
    let moved = camera(view_matrix(), jitter * projection_matrix())?;
    assert_eq!(moved.pixel_ray(vec2(8.5, 7.5), 64, 32), expected.pixel_ray(vec2(8.0, 8.0), 64, 32));
    Ok(())
}

#[test]
fn a_view_that_mirrors_has_a_left_handed_basis() -> Result<(), CameraError> {
    // A reflection in the plane y = 0.
    let mirror = Mat4::from_scale(vec3(1.0, -1.0, 1.0));
    let camera = camera(view_matrix() * mirror, projection_matrix())?;
    assert_eq!(
        (camera.eye(), camera.basis()),
        (vec3(1.0, -2.0, 3.0), [Vec3::X, Vec3::NEG_Y, Vec3::Z])
    );
    assert_eq!(camera.view_matrix(), view_matrix() * mirror);
    // A point in the mirror's world is seen where its image is in the other.
    let point = vec3(2.0, 1.5, -7.0);
    let seen = self::camera(view_matrix(), projection_matrix())?.project(point);
    assert_eq!(camera.project(point * vec3(1.0, -1.0, 1.0)), seen);
    assert!(seen.is_some());
    Ok(())
}

#[test]
fn what_is_behind_a_left_handed_eye_is_not_seen() -> Result<(), CameraError> {
    let view_matrix = lh::view::look_to_mat4(EYE, Vec3::Z, Vec3::Y);
    let projection_matrix = lh::proj::directx::perspective(1.0, 1.5, 0.1, 10.0);
    let camera = camera(view_matrix, projection_matrix)?;
    assert_eq!(camera.basis(), [Vec3::X, Vec3::Y, Vec3::NEG_Z]);
    assert_eq!(camera.depth(EYE + Vec3::Z * 2.0), 2.0);
    assert_eq!(camera.project(EYE + Vec3::Z * 2.0), Some(Vec2::ZERO));
    assert_eq!(camera.project(EYE - Vec3::Z), None);
    assert_eq!(Camera::<DVec3>::from(camera).frame(), Frame::<DVec3>::from(camera.frame()));
    Ok(())
}

#[test]
fn rows_are_orthonormal_but_for_rounding() {
    let frame = |matrix: Mat4| Frame::from_view_matrix(&matrix);
    // Rounding that has added up over many rotations; and a matrix of f32 in f64.
    let step = Mat4::from_quat(Quat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize());
    let turned = (0..100).fold(Mat4::IDENTITY, |matrix, _| step * matrix);
    assert!(frame(turned).is_ok(), "{turned}");
    assert!(Frame::from_view_matrix(&turned.as_dmat4()).is_ok());

    for scale in [0.999, 1.001, -2.0, 0.0, 1e-30, 1e30] {
        for axis in Vec3::AXES {
            let scaled = Mat4::from_scale(Vec3::ONE + (scale - 1.0) * axis) * view_matrix();
            let expected = Err(CameraError::ViewMatrixScales);
            assert_eq!(frame(scaled), expected, "{scale}");
            assert_eq!(camera(scaled, projection_matrix()).map(|camera| camera.frame()), expected);
        }
    }
    for (from, to) in [(0, 1), (1, 2), (2, 0), (0, 2)] {
        // Turned by a thousandth, and as long as before.
        let mut sheared = Mat4::IDENTITY;
        sheared.col_mut(from)[to] = 1e-3;
        assert_eq!(frame(sheared), Err(CameraError::ViewMatrixShears), "{from} {to}");
    }
}

#[test]
fn what_is_no_view_matrix() {
    let frame = |matrix: Mat4| Frame::from_view_matrix(&matrix);
    // Transposed, as from rows instead of columns; multiplied by a projection; of another w.
    for matrix in [
        view_matrix().transpose(),
        projection_matrix() * view_matrix(),
        view_matrix() * 2.0,
        Mat4::ZERO,
    ] {
        assert_eq!(frame(matrix), Err(CameraError::ViewMatrixProjects));
    }
    let not_finite = CameraError::NotFinite(CameraArgument::ViewMatrix);
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for (column, row) in (0..4).flat_map(|column| (0..4).map(move |row| (column, row))) {
            let mut matrix = view_matrix();
            matrix.col_mut(column)[row] = value;
            assert_eq!(frame(matrix), Err(not_finite));
        }
    }
    // The eye overflows: √2 times the largest number away.
    let mut matrix = look_at_mat4(Vec3::ZERO, vec3(1.0, 0.0, -1.0), Vec3::Y);
    matrix.w_axis = vec4(f32::MAX, 0.0, f32::MAX, 1.0);
    assert_eq!(frame(matrix), Err(not_finite));
}

#[test]
fn what_is_no_projection_matrix() {
    let error = |matrix: Mat4| camera(view_matrix(), matrix).err();
    let not_finite = Some(CameraError::NotFinite(CameraArgument::ProjectionMatrix));
    for value in [f32::NAN, f32::INFINITY] {
        for (column, row) in (0..4).flat_map(|column| (0..4).map(move |row| (column, row))) {
            let mut matrix = projection_matrix();
            matrix.col_mut(column)[row] = value;
            assert_eq!(error(matrix), not_finite);
        }
    }

    let orthographic = opengl::orthographic(-4.0, 4.0, -3.0, 3.0, 0.1, 10.0);
    for matrix in [
        Mat4::ZERO,
        projection_matrix() * 2.0,
        projection_matrix().transpose(),
        orthographic.transpose(),
        projection_matrix() * look_to_mat4(EYE, vec3(0.5, -0.3, 1.0), Vec3::Y),
        orthographic * 0.5,
    ] {
        assert_eq!(error(matrix), Some(CameraError::ProjectionMatrixUnknown), "{matrix}");
    }

    // A turned image, as of some telephones; a skew, as of some lenses; an eye that is moved; an orthographic view from aslant.
    let turned = Mat4::from_cols(Vec4::Y, Vec4::NEG_X, Vec4::Z, Vec4::W) * projection_matrix();
    let (mut skewed, mut moved, mut aslant) =
        (projection_matrix(), projection_matrix(), orthographic);
    skewed.y_axis.x = 1e-3;
    moved.w_axis.x = 1e-3;
    aslant.z_axis.y = 0.5;
    for matrix in [turned, skewed, moved, aslant] {
        assert_eq!(error(matrix), Some(CameraError::ProjectionMatrixSkews), "{matrix}");
    }

    let mirror = Mat4::from_scale(vec3(-1.0, 1.0, 1.0));
    for matrix in [projection_matrix(), orthographic] {
        assert_eq!(error(mirror * matrix), Some(CameraError::ProjectionMatrixMirrors));
        for flat in [vec3(0.0, 1.0, 1.0), vec3(1.0, 0.0, 1.0)] {
            let flat = Mat4::from_scale(flat) * matrix;
            assert_eq!(error(flat), Some(CameraError::ProjectionMatrixFlat));
        }
    }
    // As good as flat: the sides of the view are the same f64, and then infinite.
    let mut matrix = DMat4::from_cols_array(&[0.0; 16]);
    (matrix.x_axis.x, matrix.y_axis.y, matrix.z_axis.w) = (1.0, 1.0, -1.0);
    let error = |matrix: DMat4| Camera::from_matrices(&DMat4::IDENTITY, &matrix).err();
    assert_eq!(error(matrix), None);
    matrix.z_axis.x = 1e20;
    assert_eq!(error(matrix), Some(CameraError::ProjectionMatrixFlat));
    (matrix.x_axis.x, matrix.z_axis.x) = (1e-320, 0.0);
    assert_eq!(error(matrix), not_finite);
}

/// The eye is rounded once, also where the matrix is not quite a rotation: its transpose would be off by 5e8.
#[test]
fn an_eye_far_away_is_where_the_matrix_says() -> Result<(), CameraError> {
    // Half the turn that rounding may leave, and exact.
    let mut matrix = DMat4::IDENTITY;
    matrix.z_axis.x = 2f64.powi(-14);
    let eye = DVec3::new(3e12, -1e12, 2f64.powi(43));
    let translation = DVec3::new(-eye.x - eye.z * matrix.z_axis.x, -eye.y, -eye.z);
    matrix.w_axis = translation.extend(1.0);
    assert_eq!(Frame::from_view_matrix(&matrix)?.eye(), eye);
    // The largest and the smallest there are.
    for size in [f64::MAX, 1e-320] {
        let eye = DVec3::new(size, -size, size);
        let matrix = DMat4::from_translation(-eye);
        let frame = Frame::from_view_matrix(&matrix)?;
        assert_eq!((frame.eye(), frame.view_matrix()), (eye, matrix));
    }
    Ok(())
}
