//! Tests of `lens.rs`.

use super::{Camera, INTRINSICS};

const CAMERA: Camera = Camera {
    intrinsics: [810.0, 805.0, 322.0, 238.0, -0.21, 0.09, 1.2e-3, -0.8e-3, -0.02],
    image: [640.0, 480.0],
    is_known: true,
    is_on_tool: true,
};

/// The pixels are those of OpenCV 5.0, `cv2.projectPoints` of the same points.
#[test]
fn pixels_are_those_of_opencv() {
    let points = [[0.0, 0.0, 500.0], [120.0, -80.0, 500.0], [-200.0, 150.0, 600.0]];
    let expected =
        [[322.0, 238.0], [512.9191026937692, 111.55092419054799], [60.721085141782396, 432.8334157045048]];
    for (point, expected) in points.into_iter().zip(expected) {
        let pixel = CAMERA.pixel(point);
        assert!((0..2).all(|k| (pixel[k] - expected[k]).abs() < 1e-9), "{pixel:?} {expected:?}");
    }
}

#[test]
fn a_line_of_sight_is_that_of_its_pixel() {
    for point in [[120.0, -80.0, 500.0], [-200.0, 150.0, 600.0], [3.0, 1.0, 200.0]] {
        let pixel = CAMERA.pixel(point);
        let [x, y] = CAMERA.undistorted(pixel);
        assert!((x - point[0] / point[2]).abs() < 1e-12 && (y - point[1] / point[2]).abs() < 1e-12);
        assert!(CAMERA.off_sight(point, pixel).iter().all(|v| v.abs() < 1e-9));
        // One pixel is one distance over the focal length.
        let away = CAMERA.off_sight([point[0] + 1.0, point[1], point[2]], pixel);
        let size = away.iter().map(|v| v * v).sum::<f64>().sqrt();
        assert!(size <= 1.0 && size > 0.8, "{size}");
    }
    assert_eq!(Camera::NAMES.len(), INTRINSICS);
}
