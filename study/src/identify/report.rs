//! What comes out of an identification.

use abbe::identify::Comparison;
use serde::Serialize;

use super::as_joint_errors::JointError;
use super::counts::Counts;
use super::drift::ResidualDrift;
use super::extrapolation::Extrapolation;
use super::found::FoundModel;
use super::indistinguishable::Indistinguishable;
use super::instruments::InstrumentFit;
use super::placed::Placed;
use super::point_residuals::PointResidual;
use super::weakly_determined::WeaklyDetermined;
use crate::Accepted;
use crate::data::{Summary, Unusable};
use crate::sizes::Sizes;

/// What is found, how well it is known, and how good it is.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The machine's name.
    pub name: String,
    /// The length unit of everything.
    pub length: &'static str,
    /// What the map is called.
    pub title: String,
    /// How many combinations of the unknowns these data determine.
    pub rank: usize,
    /// Of how many unknowns.
    pub unknowns: usize,
    /// Of base and frames alone, without the targets on the tool.
    pub machine: Counts,
    /// The smallest singular value that counts over the largest that does not; none if all count.
    pub gap: Option<f64>,
    /// The condition number of the kept columns, each of unit length.
    pub condition: f64,
    /// Indices of observability.
    pub observability: Indices,
    /// What cannot be told apart, and why.
    pub groups: Vec<Indistinguishable>,
    /// What stays unknown for other reasons than the groups say: 0 if they explain it all.
    pub unexplained: usize,
    /// The unknowns that stand for the combinations that are known.
    pub parameters: Vec<Parameter>,
    /// Joints' zeros, parameters and Denavit-Hartenberg numbers that can stand in the place of some of these.
    pub meanings: Vec<JointError>,
    /// Errors of which these data tell too little beside what is known before; they are held at zero.
    pub not_known: Vec<WeaklyDetermined>,
    /// The magnitudes of sources of the spec that are to be found.
    pub magnitudes: Vec<Magnitude>,
    /// The others.
    pub held: Vec<Held>,
    /// Parameters that are correlated by more than 0.9, either sign.
    pub correlations: Vec<Pair>,
    /// What the stated uncertainty must be multiplied with to explain what is left.
    pub uncertainty_factor: f64,
    /// How sure all standard deviations are.
    pub certainty: Certainty,
    /// Instruments that are read one by one, each with what is left of its own numbers.
    pub instruments: Vec<InstrumentFit>,
    /// Where `F_0` stands as the instrument sees it, errors of the base aside: rows of a homogeneous matrix.
    pub base: [[f64; 4]; 4],
    /// Where the machine stands and what is mounted on its tool, as found.
    pub placed: Placed,
    /// How good it is on the data, gross errors left out.
    pub fit: Compared,
    /// How good it is on the test data.
    pub test: Option<Compared>,
    /// How many of the test rows are rows of the fit, digit by digit: by them nothing is judged.
    pub test_rows_of_the_fit: usize,
    /// Test rows outside the ranges of joints and inputs that were fitted; none if there are no such rows.
    pub outside: Option<Extrapolation>,
    /// How good it is on rows left out in turn.
    pub cross_validation: CrossValidation,
    /// Whether it is within the limits that were declared, if any were.
    pub accepted: Option<Accepted>,
    /// The richer terms that were taken in, in the order in which they were.
    pub terms: Vec<TermGain>,
    /// How many groups of terms were tried.
    pub tried: usize,
    /// Whether what is left follows the order of the rows; none for too few rows to tell.
    pub order: Option<ResidualDrift>,
    /// Rows that cannot be used.
    pub unusable: Vec<LeftOut>,
    /// Lines that a robust loss left out.
    pub rejected: Vec<u64>,
    /// What must be said.
    pub notes: Vec<String>,
    /// The files: the data, and the test data if there are any.
    #[serde(skip)]
    pub files: Vec<Summary>,
    /// What is left of every point, if the settings ask for it: of the data, then of the test data.
    #[serde(skip)]
    pub points: Vec<PointResidual>,
    /// The identified machine.
    #[serde(skip)]
    pub found: FoundModel,
}

/// What stands behind the standard deviations.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Certainty {
    /// How many independent configurations.
    pub configurations: usize,
    /// What was counted: `numbers`, all measured ones; `points`, those of a configuration once; or `configurations`.
    pub counted: &'static str,
    /// Degrees of freedom that are left.
    pub freedom: f64,
    /// What a standard deviation is multiplied with for 95 %: Student's t.
    pub factor_95: f64,
    /// How likely an uncertainty factor as far from 1 is by chance.
    pub p_of_factor: f64,
}

/// Indices of observability; see [`abbe::identify::Observability`].
#[derive(Clone, Copy, Debug, Serialize)]
#[expect(missing_docs, reason = "their meaning is that of the literature")]
pub struct Indices {
    pub o1: f64,
    pub o2: f64,
    pub o3: f64,
    pub o4: f64,
    pub o5: f64,
}

/// What an unknown belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The machine: it goes into the spec.
    Machine,
    /// Where the machine stands.
    Station,
    /// What is mounted on its tool.
    Placement,
}

/// An unknown that stands for a combination that is known.
#[derive(Clone, Debug, Serialize)]
pub struct Parameter {
    /// `e_x1`, of the base `e_x0`.
    pub name: String,
    /// Whether it is an error of the machine, where it stands, or what is mounted on its tool.
    pub kind: Kind,
    /// The frame of an error, from 1; 0 is the base.
    pub frame: Option<usize>,
    /// What that is called.
    pub frame_name: Option<String>,
    /// What was found.
    pub value: f64,
    /// How well.
    pub standard_deviation: f64,
    /// The length unit, rad, or nothing.
    pub unit: &'static str,
    /// Whether the data say less of it than was known before.
    pub hardly_known: bool,
}

/// The magnitude of a source of the spec.
#[derive(Clone, Debug, Serialize)]
pub struct Magnitude {
    /// The source.
    pub source: String,
    /// What the spec says.
    pub declared: f64,
    /// How well that was known, if the spec says so.
    pub declared_deviation: Option<f64>,
    /// What was found; what the spec says if these data do not tell.
    pub value: f64,
    /// How well it is known; nothing if these data do not tell.
    pub standard_deviation: Option<f64>,
    /// All this as a sentence.
    pub sentence: String,
}

/// An unknown that is held at zero, and what it acts as.
#[derive(Clone, Debug, Serialize)]
pub struct Held {
    /// The unknown.
    pub name: String,
    /// Names of parameters and factors.
    pub acts_as: Vec<(String, f64)>,
}

/// Two parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// Their names.
    pub of: [String; 2],
    /// Their correlation.
    pub correlation: f64,
}

/// Position errors of some rows.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Compared {
    /// How many rows.
    pub rows: usize,
    /// How many independent configurations they are of.
    pub configurations: usize,
    /// As delivered: with the sources that the spec has itself.
    pub before: Sizes,
    /// With base and tool fitted.
    pub base_and_tool: Sizes,
    /// With everything.
    pub after: Sizes,
    /// By how much everything is better than base and tool alone.
    pub gain: Gain,
}

/// By how much one model's position errors are smaller than another's, at the same points.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Gain {
    /// The mean of the differences; below 0 it is worse.
    pub mean: f64,
    /// The standard error of that, configurations counted; none if there is only one.
    pub standard_error: Option<f64>,
    /// How likely a mean so far from 0 is by chance if both are as good: paired, Student's t.
    pub p: f64,
}

/// Position errors of rows that are left out in turn.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CrossValidation {
    /// In how many parts.
    pub folds: usize,
    /// How many independent configurations are dealt to them.
    pub configurations: usize,
    /// With constants alone, if richer terms were tried.
    pub constant: Option<Sizes>,
    /// With everything.
    pub after: Sizes,
    /// By how much the richer terms are better than constants alone, if they were tried.
    pub gain: Option<Gain>,
}

/// A group of terms that earned its place.
#[derive(Clone, Debug, Serialize)]
pub struct TermGain {
    /// What it is called.
    pub name: String,
    /// Its terms as a spec reads, with what was found: a source's effect each.
    pub lines: Vec<String>,
    /// Whether a spec can say it.
    pub written: bool,
    /// Root mean square of a coordinate on rows left out, the length unit, before it.
    pub before: f64,
    /// … and with it.
    pub after: f64,
    /// The F-test of it, with configurations as what is independent.
    pub f: f64,
    /// How likely so large an F is by chance.
    pub p: f64,
}

/// A row that cannot be used.
#[derive(Clone, Debug, Serialize)]
pub struct LeftOut {
    /// Its file.
    pub file: String,
    /// Its line there.
    pub line: u64,
    /// Why not.
    pub reason: String,
}

impl From<Comparison> for Gain {
    fn from(Comparison { gain, standard_error, p, .. }: Comparison) -> Self {
        Self { mean: gain + 0.0, standard_error: Some(standard_error).filter(|error| error.is_finite()), p }
    }
}

impl LeftOut {
    pub(super) fn of_file(file: &Summary) -> impl Iterator<Item = Self> {
        let left_out =
            |row: &Unusable| Self { file: file.file.clone(), line: row.line, reason: row.reason.clone() };
        file.unusable.iter().map(left_out)
    }
}
