//! The view and projection matrices of glam, in both precisions and of every convention.

use eyeray::{Scalar, Vector, ViewRect};
use glam::{DMat4, DVec3, Mat4, Vec3};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Api {
    OpenGl,
    DirectX,
    Vulkan,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Frustum,
    ReversedFrustum,
    Perspective,
    Infinite,
    InfiniteReversed,
    Orthographic,
    ReversedOrthographic,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Convention {
    pub is_left_handed: bool,
    pub api: Api,
    pub kind: Kind,
}

impl Convention {
    /// Those that glam has a function for.
    pub(crate) fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for is_left_handed in [false, true] {
            for api in [Api::OpenGl, Api::DirectX, Api::Vulkan] {
                for kind in [
                    Kind::Frustum,
                    Kind::ReversedFrustum,
                    Kind::Perspective,
                    Kind::Orthographic,
                    Kind::ReversedOrthographic,
                ] {
                    all.push(Self { is_left_handed, api, kind });
                }
                if api != Api::OpenGl {
                    all.push(Self { is_left_handed, api, kind: Kind::Infinite });
                    all.push(Self { is_left_handed, api, kind: Kind::InfiniteReversed });
                }
            }
        }
        all
    }

    pub(crate) fn is_orthographic(self) -> bool {
        matches!(self.kind, Kind::Orthographic | Kind::ReversedOrthographic)
    }

    pub(crate) fn is_symmetric(self) -> bool {
        matches!(self.kind, Kind::Perspective | Kind::Infinite | Kind::InfiniteReversed)
    }
}

/// What a projection matrix is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    /// Of an orthographic camera, or of a frustum in the plane at distance 1.
    pub view: ViewRect<f64>,
    pub near: f64,
    pub far: f64,
    pub fov_y: f64,
    pub aspect: f64,
}

/// The matrices of a precision.
pub(crate) trait Matrices: Vector {
    const IS_SINGLE: bool;

    fn look_to(is_left_handed: bool, eye: Self, direction: Self, up: Self) -> Self::Mat4;
    fn projection(convention: Convention, lens: Lens) -> Self::Mat4;

    fn to_doubles(matrix: Self::Mat4) -> DMat4;
    fn rounded(matrix: DMat4) -> Self::Mat4;
}

macro_rules! matrices {
    ($vector:ident, $camera:ident, $is_single:literal, $to_doubles:expr, $rounded:expr) => {
        impl Matrices for $vector {
            const IS_SINGLE: bool = $is_single;

            fn to_doubles(matrix: Self::Mat4) -> DMat4 {
                $to_doubles(matrix)
            }

            fn rounded(matrix: DMat4) -> Self::Mat4 {
                $rounded(matrix)
            }

            fn look_to(is_left_handed: bool, eye: Self, direction: Self, up: Self) -> Self::Mat4 {
                let (direction, up) = (direction.normalize(), up.normalize());
                if is_left_handed {
                    glam::$camera::lh::view::look_to_mat4(eye, direction, up)
                } else {
                    glam::$camera::rh::view::look_to_mat4(eye, direction, up)
                }
            }

            fn projection(convention: Convention, lens: Lens) -> Self::Mat4 {
                use glam::$camera::{lh, rh};
                let is_frustum = matches!(convention.kind, Kind::Frustum | Kind::ReversedFrustum);
                if convention.is_left_handed && is_frustum {
                    // z is the other way. The left-handed frusta of glam's older versions move x and y the wrong way.
                    let right_handed = Convention { is_left_handed: false, ..convention };
                    let mut matrix = Self::projection(right_handed, lens);
                    matrix.z_axis = -matrix.z_axis;
                    return matrix;
                }
                let is_orthographic =
                    matches!(convention.kind, Kind::Orthographic | Kind::ReversedOrthographic);
                if matches!(convention.api, Api::Vulkan) && is_orthographic {
                    // y is the other way, which older versions of glam forget in the translation.
                    let directx = Convention { api: Api::DirectX, ..convention };
                    let mut matrix = Self::projection(directx, lens);
                    let [x, y] = [&mut matrix.x_axis, &mut matrix.y_axis];
                    (x.y, y.y) = (-x.y, -y.y);
                    let [z, w] = [&mut matrix.z_axis, &mut matrix.w_axis];
                    (z.y, w.y) = (-z.y, -w.y);
                    return matrix;
                }
                let number = <Self as Vector>::Scalar::from_f64;
                let Lens { view, near, far, fov_y, aspect } = lens;
                let [near, far, fov_y, aspect] = [near, far, fov_y, aspect].map(number);
                let [l, r, b, t] = [view.left, view.right, view.bottom, view.top].map(number);
                // Of frusta, in the near plane.
                let near_plane = |[start, end]: [_; 2]| match convention.kind {
                    Kind::ReversedFrustum => [start * far, end * far],
                    _ => [start * near, end * near],
                };
                let ([fl, fr], [fb, ft]) = (near_plane([l, r]), near_plane([b, t]));
                macro_rules! with {
                    ($module:path, $infinite:expr) => {{
                        use $module as functions;
                        match convention.kind {
                            Kind::Frustum => functions::frustum(fl, fr, fb, ft, near, far),
                            Kind::ReversedFrustum => functions::frustum(fl, fr, fb, ft, far, near),
                            Kind::Perspective => functions::perspective(fov_y, aspect, near, far),
                            Kind::Orthographic => functions::orthographic(l, r, b, t, near, far),
                            Kind::ReversedOrthographic => {
                                functions::orthographic(l, r, b, t, far, near)
                            }
                            Kind::Infinite => $infinite.0,
                            Kind::InfiniteReversed => $infinite.1,
                        }
                    }};
                }
                macro_rules! infinite {
                    ($module:path) => {{
                        use $module as functions;
                        (
                            functions::perspective_infinite(fov_y, aspect, near),
                            functions::perspective_infinite_reverse(fov_y, aspect, near),
                        )
                    }};
                }
                let none = Default::default();
                match (convention.is_left_handed, convention.api) {
                    (false, Api::OpenGl) => with!(rh::proj::opengl, (none, none)),
                    (false, Api::DirectX) => {
                        with!(rh::proj::directx, infinite!(rh::proj::directx))
                    }
                    (false, Api::Vulkan) => with!(rh::proj::vulkan, infinite!(rh::proj::vulkan)),
                    (true, Api::OpenGl) => with!(lh::proj::opengl, (none, none)),
                    (true, Api::DirectX) => {
                        with!(lh::proj::directx, infinite!(lh::proj::directx))
                    }
                    (true, Api::Vulkan) => with!(lh::proj::vulkan, infinite!(lh::proj::vulkan)),
                }
            }
        }
    };
}

matrices!(Vec3, camera, true, |matrix: Mat4| matrix.as_dmat4(), |matrix: DMat4| matrix.as_mat4());
matrices!(DVec3, dcamera, false, |matrix| matrix, |matrix| matrix);
