//! A figure: the request in the study, and the gathered data.

use serde::Serialize;

use super::extremes::{Envelope, Mesh};
use super::histogram::Histogram;
use super::points::Points;
use super::stick::Stick;
use crate::study_file;

/// Figures of a study.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Figures {
    /// Figures in the order of the study.
    pub figures: Vec<Figure>,
    /// Names of sources with a figure that are switched off.
    pub left_out: Vec<String>,
}

/// Data of one figure. Lengths are in the spec's unit, along the axes of `F_0`; angles are in rad.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// Request in the study.
    pub request: study_file::Figure,
    /// Shows error bounds instead of signed errors: every source that contributes is random.
    pub bounds: bool,
    /// Numbers of reached and unreachable configurations, if the figure has its own workspace.
    pub own_workspace: Option<[usize; 2]>,
    /// Data to draw.
    pub data: FigureData,
}

/// Data of a figure, by its kind.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FigureData {
    /// Errors over the travel of one variable, parameter or input.
    Travel(Envelope),
    /// Errors over two travels.
    Surface(Mesh),
    /// Errors as points in space.
    Cloud(Points),
    /// Frequencies of errors.
    Histogram(Histogram),
    /// Frames at the home configuration.
    Manipulator(Stick),
    /// Shares of the sources, which follow from the budget.
    Pareto,
}
