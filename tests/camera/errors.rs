//! The errors of the constructors, and their messages.

use core::f32::consts::{FRAC_PI_2, PI};

use eyeray::{Camera, CameraArgument, CameraError, Frame, ViewRect};
use glam::{DVec3, Vec3, vec3};

const VIEW: ViewRect = ViewRect { left: -1.0, right: 1.0, bottom: -1.0, top: 1.0 };
const EYE: Vec3 = Vec3::new(0.0, 0.0, 5.0);
const NOT_FINITE: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

/// The errors of the three constructors for a frame.
fn errors(eye: Vec3, target: Vec3, up: Vec3) -> [Option<CameraError>; 3] {
    [
        Camera::orthographic(eye, target, up, VIEW).err(),
        Camera::perspective(eye, target, up, VIEW, 1.0).err(),
        Camera::perspective_fov(eye, target, up, FRAC_PI_2, 1.0).err(),
    ]
}

fn view_error(view: ViewRect) -> Option<CameraError> {
    Camera::orthographic(EYE, Vec3::ZERO, Vec3::Y, view).err()
}

fn distance_error(distance: f32) -> Option<CameraError> {
    Camera::perspective(EYE, Vec3::ZERO, Vec3::Y, VIEW, distance).err()
}

fn fov_error(fov_y: f32, aspect: f32) -> Option<CameraError> {
    Camera::perspective_fov(EYE, Vec3::ZERO, Vec3::Y, fov_y, aspect).err()
}

#[test]
fn a_vector_that_is_not_finite() {
    for value in NOT_FINITE {
        for axis in Vec3::AXES {
            let wrong = Vec3::select(axis.cmpeq(Vec3::ONE), Vec3::splat(value), Vec3::ZERO);
            assert_eq!(
                errors(wrong, Vec3::ZERO, Vec3::Y),
                [Some(CameraError::NotFinite(CameraArgument::Eye)); 3]
            );
            assert_eq!(
                errors(EYE, wrong, Vec3::Y),
                [Some(CameraError::NotFinite(CameraArgument::Target)); 3]
            );
            assert_eq!(
                errors(EYE, Vec3::ZERO, wrong),
                [Some(CameraError::NotFinite(CameraArgument::Up)); 3]
            );
        }
    }
}

#[test]
fn an_eye_at_the_target() {
    assert_eq!(errors(EYE, EYE, Vec3::Y), [Some(CameraError::EyeAtTarget); 3]);
    assert_eq!(
        errors(vec3(0.0, 1.0, 2.0), vec3(-0.0, 1.0, 2.0), Vec3::Y),
        [Some(CameraError::EyeAtTarget); 3]
    );
}

#[test]
fn an_up_that_gives_no_direction() {
    assert_eq!(errors(EYE, Vec3::ZERO, Vec3::ZERO), [Some(CameraError::ZeroUp); 3]);
    assert_eq!(errors(EYE, Vec3::ZERO, Vec3::Z), [Some(CameraError::UpAlongView); 3]);
    assert_eq!(errors(EYE, Vec3::ZERO, Vec3::Z * -1e-40), [Some(CameraError::UpAlongView); 3]);
}

#[test]
fn a_frame_that_looks_nowhere() {
    let look_to = |eye, direction, up| Frame::look_to(eye, direction, up).err();
    for value in NOT_FINITE {
        for axis in Vec3::AXES {
            let wrong = Vec3::select(axis.cmpeq(Vec3::ONE), Vec3::splat(value), Vec3::ZERO);
            let error = |argument| Some(CameraError::NotFinite(argument));
            assert_eq!(look_to(wrong, Vec3::Z, Vec3::Y), error(CameraArgument::Eye));
            assert_eq!(look_to(EYE, wrong, Vec3::Y), error(CameraArgument::Direction));
            assert_eq!(look_to(EYE, Vec3::Z, wrong), error(CameraArgument::Up));
        }
    }
    assert_eq!(look_to(EYE, Vec3::ZERO, Vec3::Y), Some(CameraError::ZeroDirection));
    assert_eq!(look_to(EYE, vec3(-0.0, 0.0, -0.0), Vec3::Y), Some(CameraError::ZeroDirection));
    assert_eq!(look_to(EYE, Vec3::Z, Vec3::ZERO), Some(CameraError::ZeroUp));
    assert_eq!(look_to(EYE, Vec3::Z, Vec3::Z * 3.0), Some(CameraError::UpAlongView));
    assert_eq!(look_to(EYE, Vec3::Z, Vec3::Z * -1e-45), Some(CameraError::UpAlongView));
    assert_eq!(look_to(EYE, Vec3::Z * 1e-45, vec3(1e-45, 0.0, f32::MAX)), None);
}

#[test]
fn a_view_rectangle_without_area() {
    for empty in [
        ViewRect { left: 1.0, ..VIEW },
        ViewRect { right: -2.0, ..VIEW },
        ViewRect { bottom: 1.0, ..VIEW },
        ViewRect { top: -2.0, ..VIEW },
    ] {
        assert_eq!(view_error(empty), Some(CameraError::EmptyView), "{empty:?}");
    }
    assert_eq!(
        view_error(ViewRect { left: 0.0, right: 1e-45, bottom: -f32::MAX, top: f32::MAX }),
        None
    );
}

#[test]
fn a_view_rectangle_that_is_not_finite() {
    for value in NOT_FINITE {
        for wrong in [
            ViewRect { left: value, ..VIEW },
            ViewRect { right: value, ..VIEW },
            ViewRect { bottom: value, ..VIEW },
            ViewRect { top: value, ..VIEW },
            ViewRect { left: value, right: value, ..VIEW },
            ViewRect { bottom: -value, top: value, ..VIEW },
        ] {
            assert_eq!(
                view_error(wrong),
                Some(CameraError::NotFinite(CameraArgument::View)),
                "{wrong:?}"
            );
        }
    }
    let too_wide = ViewRect { left: -f64::MAX, right: f64::MAX, bottom: -1.0, top: 1.0 };
    let error = Camera::orthographic(DVec3::Z, DVec3::ZERO, DVec3::Y, too_wide).err();
    assert_eq!(error, Some(CameraError::NotFinite(CameraArgument::View)));
}

#[test]
fn a_distance_that_is_not_positive() {
    for distance in [0.0, -0.0, -1.0, -1e-45, -f32::MAX] {
        assert_eq!(distance_error(distance), Some(CameraError::DistanceNotPositive), "{distance}");
    }
    for distance in NOT_FINITE {
        assert_eq!(
            distance_error(distance),
            Some(CameraError::NotFinite(CameraArgument::Distance)),
            "{distance}"
        );
    }
    assert_eq!(distance_error(1e-45), None);
    assert_eq!(distance_error(f32::MAX), None);
}

#[test]
fn a_field_of_view_out_of_range() {
    for fov_y in [0.0, -0.0, -1.0, PI, 4.0, -f32::MAX, f32::MAX] {
        assert_eq!(fov_error(fov_y, 1.0), Some(CameraError::FovOutOfRange), "{fov_y}");
    }
    for fov_y in NOT_FINITE {
        assert_eq!(
            fov_error(fov_y, 1.0),
            Some(CameraError::NotFinite(CameraArgument::FovY)),
            "{fov_y}"
        );
    }
    assert_eq!(fov_error(1e-45, 1.0), None);
    assert_eq!(fov_error(f32::from_bits(PI.to_bits() - 1), 1.0), None);

    let error = |fov_y| Camera::perspective_fov(DVec3::Z, DVec3::ZERO, DVec3::Y, fov_y, 1.0).err();
    assert_eq!(error(core::f64::consts::PI), Some(CameraError::FovOutOfRange));
    assert_eq!(error(f64::from_bits(core::f64::consts::PI.to_bits() - 1)), None);
}

#[test]
fn an_aspect_that_is_not_positive() {
    for aspect in [0.0, -0.0, -1.5, -f32::MAX] {
        assert_eq!(fov_error(1.0, aspect), Some(CameraError::AspectNotPositive), "{aspect}");
    }
    for aspect in [f32::NAN, f32::INFINITY] {
        assert_eq!(
            fov_error(1.0, aspect),
            Some(CameraError::NotFinite(CameraArgument::Aspect)),
            "{aspect}"
        );
    }
    assert_eq!(fov_error(1.0, 1e-45), None);
    assert_eq!(fov_error(1.0, f32::MAX), None);

    // A view rectangle beyond f64, and one that underflows it.
    let error = |fov_y, aspect| {
        Camera::perspective_fov(DVec3::Z, DVec3::ZERO, DVec3::Y, fov_y, aspect).err()
    };
    assert_eq!(error(3.0, f64::MAX), Some(CameraError::NotFinite(CameraArgument::Aspect)));
    // Half of it would be finite.
    assert_eq!(error(1.5, f64::MAX), Some(CameraError::NotFinite(CameraArgument::Aspect)));
    assert_eq!(error(1.5, f64::MAX / 2.0), None);
    assert_eq!(error(1e-200, 1e-200), Some(CameraError::EmptyView));
}

#[test]
fn every_error_is_a_sentence_that_names_its_argument() {
    for (error, sentence) in [
        (CameraError::NotFinite(CameraArgument::Target), "the camera's target is not finite"),
        (CameraError::EyeAtTarget, "the camera's eye and target are the same point"),
        (CameraError::ZeroDirection, "the camera's direction of view is zero"),
        (CameraError::ZeroUp, "the camera's up vector is zero"),
        (CameraError::UpAlongView, "the camera's up vector is parallel to the direction of view"),
        (CameraError::EmptyView, "the camera's view rectangle is empty"),
        (
            CameraError::DistanceNotPositive,
            "the camera's distance to the view plane is not positive",
        ),
        (CameraError::FovOutOfRange, "the camera's field of view is not between 0 and π"),
        (CameraError::AspectNotPositive, "the camera's aspect is not positive"),
        (
            CameraError::NotFinite(CameraArgument::ViewMatrix),
            "the camera's view_matrix is not finite",
        ),
        (
            CameraError::ViewMatrixProjects,
            "the last row of the camera's view matrix is not (0, 0, 0, 1)",
        ),
        (
            CameraError::ViewMatrixScales,
            "the camera's view matrix scales: a row is not of length 1",
        ),
        (
            CameraError::ViewMatrixShears,
            "the camera's view matrix shears: two rows are not at a right angle",
        ),
        (
            CameraError::ProjectionMatrixUnknown,
            "the last row of the camera's projection matrix is neither (0, 0, -1, 0), (0, 0, 1, 0) nor (0, 0, 0, 1)",
        ),
        (
            CameraError::ProjectionMatrixSkews,
            "the camera's projection matrix rotates or shears the image, or moves the eye",
        ),
        (CameraError::ProjectionMatrixMirrors, "the camera's projection matrix mirrors the image"),
        (CameraError::ProjectionMatrixFlat, "the camera's projection matrix is flat"),
    ] {
        let error: Box<dyn core::error::Error> = Box::new(error);
        assert_eq!(error.to_string(), sentence);
    }
}

#[test]
fn an_argument_is_called_what_the_functions_call_it() {
    for (argument, name) in [
        (CameraArgument::Eye, "eye"),
        (CameraArgument::Target, "target"),
        (CameraArgument::Direction, "direction"),
        (CameraArgument::Up, "up"),
        (CameraArgument::View, "view"),
        (CameraArgument::Distance, "distance"),
        (CameraArgument::FovY, "fov_y"),
        (CameraArgument::Aspect, "aspect"),
        (CameraArgument::ViewMatrix, "view_matrix"),
        (CameraArgument::ProjectionMatrix, "projection_matrix"),
    ] {
        assert_eq!(argument.to_string(), name);
    }
}
