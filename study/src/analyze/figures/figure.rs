//! A figure: what was asked for, and what was gathered.

use serde::Serialize;

use super::extremes::{Envelope, Mesh};
use super::histogram::Histogram;
use super::points::Points;
use super::stick::Stick;
use crate::study_file;

/// The figures of a study.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Figures {
    /// In the order of the study.
    pub figures: Vec<Figure>,
    /// The sources that had a figure and are switched off.
    pub left_out: Vec<String>,
}

/// A figure, ready to be drawn. Lengths in the spec's unit and along the axes of `F_0`.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// What was asked for.
    pub asked: study_file::Figure,
    /// Whether there are only bounds to show, of one random source or of many.
    pub bounds: bool,
    /// Of a workspace of its own: how many configurations were reached, and how many were not.
    pub own_workspace: Option<[usize; 2]>,
    /// What it shows.
    pub data: Gathered,
}

/// What a figure shows.
#[derive(Clone, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Gathered {
    /// The errors along a travel.
    Travel(Envelope),
    /// The errors over two travels.
    Surface(Mesh),
    /// The errors in space.
    Cloud(Points),
    /// How often which error occurs.
    Histogram(Histogram),
    /// The frames at home.
    Manipulator(Stick),
    /// The shares of the sources: they follow from the budget.
    Pareto,
}
