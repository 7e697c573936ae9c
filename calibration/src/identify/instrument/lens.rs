//! Lens of a camera: the image of a point, and the line of sight of a pixel.
//!
//! With `P` a point in the frame of the camera (x to the right, y down, z along the line of sight),
//! the pinhole model with the distortion of Brown and Conrady, in the order of OpenCV, is
//!
//! ```text
//! x = X/Z, y = Y/Z, r² = x² + y², g = 1 + k1 r² + k2 r⁴ + k3 r⁶
//! u = fx (x g + 2 p1 x y + p2 (r² + 2 x²)) + cx,   v = fy (y g + p1 (r² + 2 y²) + 2 p2 x y) + cy
//! ```

use abbe_analysis::sampling::vectors::{dot, unit};
use abbe_core::Pose;

/// Number of the intrinsic parameters of a camera.
pub const INTRINSICS: usize = 9;

/// A camera: its intrinsic parameters, and where it is mounted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// `fx fy cx cy` in pixels, then `k1 k2 p1 p2 k3`.
    pub intrinsics: [f64; INTRINSICS],
    /// Width and height of the image, in pixels.
    pub image: [f64; 2],
    /// The intrinsic parameters have no unknowns.
    pub is_known: bool,
    /// The camera is on the tool and the board in the room; otherwise the other way round.
    pub is_on_tool: bool,
}

/// Image of a point and its derivatives.
pub(super) struct Image {
    /// `u` and `v`.
    pub(super) pixel: [f64; 2],
    /// Derivatives of `u` and `v` with respect to the point, in the frame of the camera.
    pub(super) by_point: [[f64; 3]; 2],
    /// Derivatives of `u` and `v` with respect to the intrinsic parameters.
    pub(super) by_intrinsics: [[f64; INTRINSICS]; 2],
}

impl Camera {
    /// Names of the intrinsic parameters.
    pub const NAMES: [&'static str; INTRINSICS] = ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"];

    /// Returns whether an intrinsic parameter is in pixels.
    pub fn is_pixel(parameter: usize) -> bool {
        parameter < 4
    }

    /// Returns the expected deviation of an intrinsic parameter from its nominal value: a tenth of
    /// the focal length for the first four, 1 for radial and 0.05 for tangential distortion.
    pub(in super::super) fn expected(&self, parameter: usize) -> f64 {
        match parameter {
            0..4 => 0.1 * self.intrinsics[0].abs(),
            6 | 7 => 0.05,
            _ => 1.0,
        }
    }

    /// Returns the largest rank of the derivatives of one view: its pixels depend on the pose of
    /// the board and on unknown intrinsic parameters alone.
    pub(in super::super) fn rank(&self) -> usize {
        if self.is_known { 6 } else { 6 + INTRINSICS }
    }

    /// Returns whether a pixel is in the image; its center is at whole numbers from 0.
    pub fn is_inside(&self, pixel: [f64; 2]) -> bool {
        (0..2).all(|k| (-0.5..=self.image[k] - 0.5).contains(&pixel[k]))
    }

    /// Returns a point of the board in the frame of the camera; `tool` is the pose of the measured
    /// frame in the frame of the instrument.
    pub fn seen(&self, tool: &Pose, corner: [f64; 3]) -> [f64; 3] {
        if self.is_on_tool { tool.inverse().apply(corner) } else { tool.apply(corner) }
    }

    /// Returns the pixel of a point in the frame of the camera.
    pub fn pixel(&self, point: [f64; 3]) -> [f64; 2] {
        self.image(point).pixel
    }

    /// Computes the image of a point in the frame of the camera.
    ///
    /// With `(x', y')` the distorted point, `D = ∂(x', y')/∂(x, y)` and `∂x/∂P = (1, 0, −x)/Z`,
    /// `∂y/∂P = (0, 1, −y)/Z`.
    pub(super) fn image(&self, [x, y, z]: [f64; 3]) -> Image {
        let [fx, fy, cx, cy, ..] = self.intrinsics;
        // A point in the plane of the camera has no image.
        let depth = if z.abs() < f64::MIN_POSITIVE { f64::MIN_POSITIVE } else { z };
        let (x, y) = (x / depth, y / depth);
        let ([a, b], [[ax, ay], [bx, by]]) = self.distorted(x, y);
        let s = x * x + y * y;
        let row = |f: f64, px: f64, py: f64| [f * px / depth, f * py / depth, -f * (px * x + py * y) / depth];
        let radial = |f: f64, v: f64| [f * v * s, f * v * s * s, f * v * s * s * s];
        let ([u1, u2, u3], [v1, v2, v3]) = (radial(fx, x), radial(fy, y));
        let (across_u, across_v) = (2.0 * fx * x * y, 2.0 * fy * x * y);
        let (along_u, along_v) = (fx * (s + 2.0 * x * x), fy * (s + 2.0 * y * y));
        Image {
            pixel: [fx * a + cx, fy * b + cy],
            by_point: [row(fx, ax, ay), row(fy, bx, by)],
            by_intrinsics: [
                [a, 0.0, 1.0, 0.0, u1, u2, across_u, along_u, u3],
                [0.0, b, 0.0, 1.0, v1, v2, along_v, across_v, v3],
            ],
        }
    }

    /// Returns the distorted point and its derivatives with respect to `x` and `y`.
    fn distorted(&self, x: f64, y: f64) -> ([f64; 2], [[f64; 2]; 2]) {
        let [.., k1, k2, p1, p2, k3] = self.intrinsics;
        let s = x * x + y * y;
        let g = 1.0 + s * (k1 + s * (k2 + s * k3));
        let slope = k1 + s * (2.0 * k2 + s * 3.0 * k3);
        let mixed = 2.0 * (x * y * slope + p1 * x + p2 * y);
        (
            [
                x * g + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x),
                y * g + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y,
            ],
            [
                [g + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, mixed],
                [mixed, g + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x],
            ],
        )
    }

    /// Returns `(x, y)` of the line of sight of a pixel, by Newton's method on the distortion.
    pub fn undistorted(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [fx, fy, cx, cy, ..] = self.intrinsics;
        let wanted = [(u - cx) / fx, (v - cy) / fy];
        let [mut x, mut y] = wanted;
        for _ in 0..20 {
            let ([a, b], [[ax, ay], [bx, by]]) = self.distorted(x, y);
            let (da, db) = (wanted[0] - a, wanted[1] - b);
            let determinant = ax * by - ay * bx;
            // Beyond the fold of the polynomial no point has this image.
            if determinant <= 0.0 {
                return wanted;
            }
            let (dx, dy) = ((by * da - ay * db) / determinant, (ax * db - bx * da) / determinant);
            (x, y) = (x + dx, y + dy);
            if dx.abs().max(dy.abs()) < 1e-14 {
                break;
            }
        }
        if x.is_finite() && y.is_finite() { [x, y] } else { wanted }
    }

    /// Returns the vector from the line of sight of a pixel to a point, in the frame of the camera.
    ///
    /// It is perpendicular to the line of sight; its length is about the distance in pixels times
    /// the distance of the point over the focal length.
    pub fn off_sight(&self, point: [f64; 3], pixel: [f64; 2]) -> [f64; 3] {
        let [x, y] = self.undistorted(pixel);
        let direction = unit([x, y, 1.0]);
        // A point behind the camera is as far from the line of sight as from the camera.
        let along = dot(point, direction).max(0.0);
        core::array::from_fn(|i| point[i] - along * direction[i])
    }
}

#[cfg(test)]
mod tests;
