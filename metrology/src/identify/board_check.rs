//! Tests whether the corners that a camera found lie on the board of the map.

use abbe::identify::{Model, Observable, Observation};

use crate::data::Data;
use abbe_study::{Result, mistake, number::digits};

/// Largest number of views that are tested.
const VIEWS: usize = 40;

/// Residual of a board, as a share of its extent in the image, above which the corners do not lie
/// on it. An unknown distortion of the lens leaves less.
const MISMATCH: f64 = 0.05;

/// Returns an error if the corners do not lie on the board in most views. The machine does not
/// matter.
pub(super) fn check_board(model: &Model, data: &Data) -> Result<()> {
    let rows = &data.observations;
    if model.camera.is_none() || rows.is_empty() {
        return Ok(());
    }
    if misfit(model, rows).share < MISMATCH {
        return Ok(());
    }
    let message = "in most views the corners do not lie on the board of the map, or they are collinear";
    let transposed = transposed(&model.observables).and_then(|(board, observables)| {
        let misfit = misfit(&Model { observables, ..model.clone() }, rows);
        (misfit.share < MISMATCH).then_some((board, misfit.pixels))
    });
    let help = match transposed {
        Some(([columns, rows], pixels)) => {
            format!("write `board = [{columns}, {rows}]`: it fits within {} px", digits(pixels, 2))
        }
        None => "check the order of the corners, `pixels`, `board` or `corners`, and `focal`".to_owned(),
    };
    Err(mistake::with_help(&data.file, message, help))
}

/// Residual of the board alone in one view.
struct Misfit {
    /// Share of the extent of the board in the image.
    share: f64,
    pixels: f64,
}

/// Returns the median misfit; infinite where no pose of the board explains the corners.
fn misfit(model: &Model, rows: &[Observation]) -> Misfit {
    let one = |row: &Observation| match model.board_view(row) {
        Some(view) => Misfit { share: view.rms / view.extent, pixels: view.rms },
        None => Misfit { share: f64::INFINITY, pixels: f64::INFINITY },
    };
    let mut misfits: Vec<Misfit> = rows.iter().step_by(rows.len().div_ceil(VIEWS)).map(one).collect();
    misfits.sort_by(|a, b| a.share.total_cmp(&b.share));
    misfits.swap_remove(misfits.len() / 2)
}

/// Returns a grid with as many columns as this one has rows, and the corners in its order; none if
/// the corners are no grid.
fn transposed(observables: &[Observable]) -> Option<([usize; 2], Vec<Observable>)> {
    let corners: Vec<[f64; 3]> = observables.iter().step_by(2).map(|one| one.corner).collect();
    let first = corners.first()?;
    let columns = corners.iter().take_while(|corner| corner[1] == first[1]).count();
    let rows = corners.len() / columns;
    let pitch = corners.get(1)?[0] - first[0];
    let at = |i: usize, columns: usize| [(i % columns) as f64 * pitch, (i / columns) as f64 * pitch, 0.0];
    if columns == rows || corners.iter().enumerate().any(|(i, corner)| *corner != at(i, columns)) {
        return None;
    }
    let turned = observables.iter().enumerate();
    let turned = turned.map(|(i, one)| Observable { corner: at(i / 2, rows), ..one.clone() });
    Some(([rows, columns], turned.collect()))
}
