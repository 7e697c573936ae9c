//! Reader of an instrument of the kind `camera`.

use abbe::identify::{CAMERA, Camera, INTRINSICS, Observable, register};
use abbe_spec::document::Section;
use abbe_spec::expr::Dimension;

use super::choices::{INTRINSIC_CHOICES, MOUNTS};
use super::read_channels::{column, deviation};
use super::{Column, Instrument, Instruments};

/// Initial value of an uncertainty to be estimated: 0.2 pixels.
const GUESS: f64 = 0.2;

/// Smallest breadth of the corners of a board, as a share of its length.
const NARROWEST: f64 = 1e-3;

/// Reads a camera; its observables are two pixels for each corner.
pub(super) fn camera(
    section: &Section<'_>,
    name: String,
    setup: Option<f64>,
    all: &mut Instruments,
) -> Option<Instrument> {
    let mount = section.required("mount").and_then(|item| item.choice(&MOUNTS));
    let image = pixels(section, "image");
    let focal = pixels(section, "focal");
    let center = center(section, image);
    let distortion = distortion(section);
    let is_known = section.get("intrinsics").map_or(Some(true), |item| item.choice(&INTRINSIC_CHOICES));
    let corners = corners(section);
    let prefixes = prefixes(section);
    let uncertainty = deviation(&section.required("uncertainty")?, Dimension::NONE)?;
    let (corners, prefixes, [fx, fy], [cx, cy]) = (corners?, prefixes?, focal?, center?);
    let mut intrinsics = [0.0; INTRINSICS];
    intrinsics[..4].copy_from_slice(&[fx, fy, cx, cy]);
    intrinsics[4..].copy_from_slice(&distortion?);
    for corner in &corners {
        all.observables.extend((0..2).map(|axis| Observable {
            name: name.clone(),
            kind: &CAMERA,
            instrument: 0,
            axis,
            targets: [0; 2],
            fixture: None,
            at: [0.0; 3],
            mirror: [0.0; 3],
            corner: *corner,
            zero: 0.0,
            zero_known: true,
            uncertainty: uncertainty.unwrap_or(GUESS),
        }));
    }
    all.camera = Some(Camera { intrinsics, image: image?, is_known: is_known?, is_on_tool: mount? });
    let column = |i: usize, k: usize| {
        let Column { name, span } = &prefixes[k];
        Column { name: format!("{name}{}", i + 1), span: span.clone() }
    };
    Some(Instrument {
        name,
        kind: &CAMERA,
        columns: (0..corners.len()).flat_map(|i| [column(i, 0), column(i, 1)]).collect(),
        factor: 1.0,
        unit: "px".to_owned(),
        setup,
        range: None,
        uncertainty,
        observables: 0..all.observables.len(),
    })
}

/// Reads two positive numbers of pixels.
fn pixels(section: &Section<'_>, key: &str) -> Option<[f64; 2]> {
    let item = section.required(key)?;
    let [x, y] = item.quantities("two numbers of pixels", Dimension::NONE)?;
    if x.min(y) >= 1.0 {
        return Some([x, y]);
    }
    let help = match key {
        "focal" => {
            "write fx and fy in pixels: the focal length over the size of a pixel, such as 8 mm / 0.005 mm = 1600"
        }
        _ => "write the width and the height of the image in pixels",
    };
    item.refuse(format!("`{key}` must be at least one pixel"), help)
}

/// Reads the principal point, which must be in the image; its middle if it is not stated.
///
/// The center of the first pixel is at (0, 0), as for OpenCV.
fn center(section: &Section<'_>, image: Option<[f64; 2]>) -> Option<[f64; 2]> {
    let Some(item) = section.get("center") else {
        return image.map(|image| image.map(|size| (size - 1.0) / 2.0));
    };
    let [x, y] = item.quantities("two numbers of pixels", Dimension::NONE)?;
    let (center, image) = ([x, y], image?);
    if (0..2).all(|k| (0.0..image[k]).contains(&center[k])) {
        return Some(center);
    }
    let help = "write cx and cy of the camera matrix, and the size of the image it was calibrated with";
    item.refuse("the principal point is outside the image", help)
}

/// Reads the distortion; none if it is not stated.
fn distortion(section: &Section<'_>) -> Option<[f64; INTRINSICS - 4]> {
    let Some(item) = section.get("distortion") else { return Some([0.0; INTRINSICS - 4]) };
    item.quantities("five numbers: k1 k2 p1 p2 k3", Dimension::NONE)
}

/// Reads the beginnings of the headings of `u` and `v`, which must differ.
fn prefixes(section: &Section<'_>) -> Option<[Column; 2]> {
    let item = section.required("pixels")?;
    let [u, v] = item.entries("the beginnings of two headings")?.map(|item| column(&item));
    let (u, v) = (u?, v?);
    if u.name != v.name {
        return Some([u, v]);
    }
    let help = "write `pixels = [\"u\", \"v\"]` for the columns u1, v1, u2, v2 …";
    item.refuse("both pixels have the same headings", help)
}

/// Reads the corners of the board: a grid, row by row, or a list.
fn corners(section: &Section<'_>) -> Option<Vec<[f64; 3]>> {
    match (section.get("board"), section.get("corners")) {
        (Some(board), None) => {
            let [columns, rows] =
                board.quantities("two numbers: corners in a row, and rows", Dimension::NONE)?;
            let is_count = |count: f64| count.fract() == 0.0 && (2.0..=100.0).contains(&count);
            if !is_count(columns) || !is_count(rows) {
                let help = "count the inner corners, as for `cv2.findChessboardCorners`";
                return board.refuse("`board` must be two whole numbers from 2 to 100", help);
            }
            let item = section.required("pitch")?;
            let pitch = item.quantity(Dimension::LENGTH)?;
            if pitch < 1e-9 {
                let help = "write the side of a square of the chessboard";
                return item.refuse("`pitch` must be positive", help);
            }
            let (columns, rows) = (columns as usize, rows as usize);
            let at = |i: usize| [(i % columns) as f64 * pitch, (i / columns) as f64 * pitch, 0.0];
            Some((0..columns * rows).map(at).collect())
        }
        (None, Some(list)) => {
            let mut corners = Vec::new();
            let expected = "two lengths on a flat board: x, y, or three: x, y, z";
            for item in list.array("corners, each two or three lengths on the board")? {
                corners.push(match item.array(expected)?.len() {
                    2 => {
                        let [x, y] = item.quantities(expected, Dimension::LENGTH)?;
                        [x, y, 0.0]
                    }
                    _ => item.quantities(expected, Dimension::LENGTH)?,
                });
            }
            if let Some(pitch) = section.get("pitch") {
                let message = "`pitch` belongs to `board`, and this board lists its `corners`";
                return pitch.refuse_key(message, "remove it");
            }
            let (message, help) = match corners.len() {
                0..4 => ("a camera needs at least four corners", "a tag has four"),
                _ if register(&corners, &corners).is_none_or(|found| found.breadth < NARROWEST) => (
                    "these corners are collinear: they do not determine the pose of the board",
                    "add corners beside that line",
                ),
                _ => return Some(corners),
            };
            list.refuse(message, help)
        }
        _ => {
            let message = "a camera needs either `board` with `pitch`, or `corners`";
            let help =
                "write `board = [9, 6]` and `pitch = \"25 mm\"` for a chessboard with 9 × 6 inner corners";
            section.refuse(message, help)
        }
    }
}
