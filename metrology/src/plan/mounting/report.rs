//! Report of hidden numbers and of a place for a target.

use serde::Serialize;

/// Numbers of the machine that the targets of a plan hide, and a place for a target that shows
/// them.
#[derive(Clone, Debug, Serialize)]
pub struct TargetMounting {
    /// Last revolute joint, if all targets are on its axis.
    pub target_on_axis: Option<String>,
    /// Hidden numbers, then those that they are confused with.
    pub numbers: Vec<HiddenNumber>,
    /// Advised position of a target in the frame of the tool, in the length unit.
    pub position: [f64; 3],
    /// Distance of that position from the planned target, or from the first of several, in the
    /// length unit.
    pub distance: f64,
    /// Is true if the advised target is an additional one; otherwise it replaces the planned one.
    pub is_additional: bool,
    /// Number of planned targets.
    pub planned_targets: usize,
    /// Is true if the place of the planned targets is known exactly, as that of the advised target
    /// must be.
    pub is_exact: bool,
}

/// Number of the machine that is hidden, or confused with a hidden one.
#[derive(Clone, Debug, Serialize)]
pub struct HiddenNumber {
    /// Name: `zero of q5`, `a of shoulder`, `e_x of wrist`.
    pub name: String,
    /// Is true if the planned rows determine it no better than to half of its prior.
    pub is_hidden: bool,
    /// Names of the numbers that it is confused with: the correlation is above one half.
    pub confused_with: Vec<String>,
    /// Unit: the length unit, or rad.
    pub unit: &'static str,
    /// Standard deviation of the prior, in `unit`.
    pub prior: f64,
    /// Predicted standard deviation after the planned measurement, in `unit`.
    pub standard_deviation: f64,
    /// Predicted standard deviation with the advised target at the same configurations, in
    /// `unit`.
    pub standard_deviation_there: f64,
}
