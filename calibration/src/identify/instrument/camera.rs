//! Camera: pixels of the corners of a board.
//!
//! The instrument's frame is that of the thing that stands in the room: the camera, or the board if
//! the camera is on the tool. The other one is the measured frame on the tool.

use super::{Evaluation, Geometry, InstrumentKind, Observable, SizeInformation};

/// Pixels `u` and `v` of a corner.
pub static CAMERA: InstrumentKind = InstrumentKind {
    name: "camera",
    reads: "the pixels of the corners of a board: a camera on the tool with the board in the room, or the other way round; \
            it is the only instrument of its map",
    keys: &[
        "mount",
        "pixels",
        "board",
        "pitch",
        "corners",
        "image",
        "focal",
        "center",
        "distortion",
        "intrinsics",
    ],
    numbers: 2,
    sees_base: true,
    size: SizeInformation::Length,
    evaluate,
    ..InstrumentKind::LENGTH
};

/// Evaluates the pixel of a corner.
///
/// A camera in the room sees `P = T c` on the tool, whose motion is that of the tool at `P`. To a
/// camera on the tool, the motion of the tool at the corner `c` of the board moves `P = T⁻¹ c` the
/// other way.
fn evaluate(observable: &Observable, geometry: &Geometry) -> Evaluation {
    let Some(camera) = geometry.camera else { return Evaluation::ZERO };
    let (tool, k) = (&geometry.tool, observable.axis);
    let seen = camera.seen(tool, observable.corner);
    let image = camera.image(seen);
    let (along, at) = match camera.is_on_tool {
        true => (tool.turn(image.by_point[k]).map(|v| -v), observable.corner),
        false => (image.by_point[k], seen),
    };
    Evaluation {
        value: image.pixel[k],
        along: geometry.base.inverse().turn(along),
        at: Some(at),
        by_intrinsics: image.by_intrinsics[k],
        ..Evaluation::ZERO
    }
}
