//! Report of an identification.
//!
//! Number of identifiable errors of a machine.
//!
//! Tests drift of the residuals with the row order.
//!
//! Test rows outside the fitted ranges, and the uncertainty of the machine there.
//!
//! Errors that the data determine poorly.

use std::{borrow::Cow, fmt, sync::Arc};

use abbe::identify::{
    Drift, Fit, FixtureGeometry, Identifiable, Independent, Model, Unknown, deviation_beyond,
};
use abbe::{LengthUnit, Pose, analysis::student_factor};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_study::{Residual, Residuals, RunRecord, extrapolation::ToolPointDeviation};
use serde::Serialize;

use super::{
    FoundModel, FoundPlacement, Gain, Indistinguishable, InstrumentFit, JointError, JointProfiles,
    KnownDistanceFit, PointResidual,
};
use crate::AcceptanceVerdict;
use crate::data::{Data, Summary, Table, Unusable};
use crate::sizes::Sizes;

/// Identified errors, their uncertainty, and the accuracy of the identified machine.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Name of the machine.
    pub name: String,
    /// Length unit of all values.
    pub length: &'static str,
    /// Title of the map.
    pub title: String,
    /// Number of combinations of unknowns that the data determine.
    pub rank: usize,
    /// Number of unknowns.
    pub unknowns: usize,
    /// Number of identifiable errors of base and frames alone, without targets on the tool.
    pub machine: Counts,
    /// Ratio of the smallest significant singular value to the largest insignificant one; none if
    /// all are significant.
    pub gap: Option<f64>,
    /// Condition number of the kept columns of the design matrix, each scaled to unit length.
    #[serde(serialize_with = "abbe_study::finite::or_null")]
    pub condition: f64,
    /// Combinations of unknowns that cannot be distinguished, with the reason.
    pub groups: Vec<Indistinguishable>,
    /// Number of undetermined combinations that `groups` and `weakly_determined` do not explain;
    /// normally 0.
    pub unexplained: usize,
    /// Kept unknowns, which stand for the identifiable combinations.
    pub parameters: Vec<Parameter>,
    /// Significant errors expressed as errors of joint zeros, parameters and Denavit-Hartenberg
    /// numbers.
    pub joint_errors: Vec<JointError>,
    /// Last revolute joint, if all targets are on its axis; some errors cannot be distinguished
    /// then.
    pub target_on_axis: Option<String>,
    /// Prior standard deviation of errors of frames, as a share of the size of the machine, and in
    /// rad; `None` if it is that of the spec, or if they are not fitted.
    pub prior: Option<f64>,
    /// Errors that these data determine poorly compared with their prior.
    pub weakly_determined: Vec<WeaklyDetermined>,
    /// Magnitudes of sources of the spec that were unknown.
    pub magnitudes: Vec<Magnitude>,
    /// Unknowns that act as others in every configuration, which stand for them.
    pub redundant: Vec<Redundant>,
    /// Pairs of parameters with an absolute correlation above 0.9.
    pub correlations: Vec<Pair>,
    /// Factor of the stated uncertainty that explains the residuals.
    pub uncertainty_factor: f64,
    /// Basis of all standard deviations.
    pub certainty: Certainty,
    /// Instruments that are read one by one, with statistics of their residuals.
    pub instruments: Vec<InstrumentFit>,
    /// Known distances between instruments, with their residuals; absent if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub known_distances: Vec<KnownDistanceFit>,
    /// Positions and rotations, with statistics of their residuals, where poses are measured or
    /// their uncertainty was estimated from the data; otherwise empty.
    pub coordinates: Vec<InstrumentFit>,
    /// Initial pose of `F_0` in the frame of the instrument at the first station, without
    /// identified errors of the base, as rows of a homogeneous matrix.
    pub base: [[f64; 4]; 4],
    /// Identified placement of the machine and of what is mounted on its tool.
    pub placed: FoundPlacement,
    /// Position errors of the fitted rows, without outliers.
    pub fit: Compared,
    /// Position errors of the test rows.
    pub test: Option<Compared>,
    /// Number of test rows that are identical to fitted rows. They cannot assess the fit.
    pub test_rows_of_the_fit: usize,
    /// Test rows outside the fitted ranges of joints and inputs; none if there are no such rows.
    pub extrapolated: Option<TestExtrapolation>,
    /// Position errors of cross-validation.
    pub cross_validation: CrossValidation,
    /// Verdict on the declared limits, if there are any.
    pub accepted: Option<AcceptanceVerdict>,
    /// Richer terms that were accepted, in the order of acceptance.
    pub terms: Vec<TermGain>,
    /// Number of groups of terms that were tried.
    pub tried: usize,
    /// Families that have them, by their names in `--terms`.
    pub families: String,
    /// Profiles of joints; none if they were not tried, or do not reduce the cross-validation error
    /// significantly.
    pub profiles: Option<JointProfiles>,
    /// Drift of the residuals with the row order; none if there are too few rows for the test, or
    /// where a place moved between two rows.
    pub drift: Option<ResidualDrift>,
    /// Rows that cannot be used.
    pub unusable: Vec<LeftOut>,
    /// Lines rejected as outliers by a robust loss.
    pub rejected: Vec<u64>,
    /// Notes for the user.
    pub notes: Vec<String>,
    /// Stated date, persons and instruments, and the version of abbe; absent if nothing is stated.
    #[serde(skip_serializing_if = "RunRecord::is_empty")]
    pub record: RunRecord,
    /// Files of the data and of the test data.
    #[serde(skip)]
    pub files: Vec<Summary>,
    /// Residuals of every point of the data, then of the test data, if the settings request them.
    #[serde(skip)]
    pub points: Vec<PointResidual>,
    /// Identified machine.
    #[serde(skip)]
    pub found: FoundModel,
    /// Spec of the identified machine as it is written; none if the given one has changes.
    #[serde(skip)]
    pub written: Option<Arc<Spec>>,
}

impl Report {
    /// Returns the residuals of every point, in the frame of the instrument and the length unit:
    /// measurement minus the model with only base and tool fitted, then minus the identified model.
    pub fn residual_rows(&self) -> Table {
        let yes = |is: bool| Some(f64::from(u8::from(is)));
        let row = |point: &PointResidual| {
            let head = [Some(point.line as f64), yes(point.is_test), yes(point.is_rejected)];
            head.into_iter()
                .chain([point.before, point.after].as_flattened().iter().map(|v| Some(*v)))
                .collect()
        };
        let heading = ["line", "test", "rejected", "x before", "y before", "z before", "x", "y", "z"];
        let rows = self.points.iter().map(row).collect();
        Table { heading: heading.map(str::to_owned).to_vec(), rows, ..Table::default() }
    }

    /// Returns the residuals of the fitted points, without outliers; `None` for instruments that
    /// measure no points, and if the points were not requested.
    pub fn residuals(&self) -> Option<Residuals> {
        if !self.instruments.is_empty() {
            return None;
        }
        let poses = self.found.placed.stations.iter().map(|station| {
            Pose(std::array::from_fn(|column| std::array::from_fn(|row| station.pose[row][column])))
        });
        let stations: Vec<Pose> = poses.collect();
        let is_fitted = |point: &&PointResidual| !point.is_test && !point.is_rejected;
        let fitted: Vec<&PointResidual> = self.points.iter().filter(is_fitted).collect();
        let residuals = Residuals::new(Some("base and tool fitted"), "identified", &fitted, |point| {
            let PointResidual { line, point: at, before, after, .. } = **point;
            let (q, u) = (point.q.clone(), point.u.clone());
            Residual { line, q, u, point: at, before: Some(before), after }.in_f0(&stations[point.station])
        });
        Some(Residuals { found: self.written.clone(), ..residuals? })
    }
}

/// Basis of the standard deviations.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Certainty {
    /// Number of independent configurations.
    pub configurations: usize,
    /// Unit of counting for degrees of freedom: `numbers` for every measured value, `points` for
    /// one point per configuration, or `configurations`.
    pub counted: &'static str,
    /// Residual degrees of freedom; 0 with as many values as unknowns, which leave nothing to test.
    pub freedom: f64,
    /// Degrees of freedom of the standard deviations: those of the residuals, and 2 for the stated
    /// uncertainties.
    pub coverage_freedom: f64,
    /// Coverage factor for 95 %, from Student's t.
    pub factor_95: f64,
    /// Probability of an uncertainty factor at least as far from 1 by chance.
    pub p_of_factor: f64,
}

impl Certainty {
    pub(super) fn new(fit: &Fit) -> Self {
        Self {
            configurations: fit.configurations,
            counted: match fit.independent {
                Independent::Numbers => "numbers",
                Independent::Points => "points",
                Independent::Configurations => "configurations",
            },
            freedom: fit.freedom,
            coverage_freedom: fit.coverage_freedom,
            factor_95: student_factor(0.95, fit.coverage_freedom),
            p_of_factor: if fit.freedom > 0.0 { deviation_beyond(fit.sigma, fit.freedom) } else { 1.0 },
        }
    }

    /// Returns the coverage factor at which all of `count` intervals together hold with 95 %
    /// (Bonferroni): the limit for the errors that are called significant.
    pub fn factor_of_all(&self, count: usize) -> f64 {
        student_factor(1.0 - 0.05 / count.max(1) as f64, self.coverage_freedom)
    }
}

/// Object that an unknown belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Machine: the value goes into the spec.
    Machine,
    /// Placement of the machine.
    Station,
    /// Placement of what is mounted on the tool.
    Placement,
}

/// Kept unknown, which stands for an identifiable combination.
#[derive(Clone, Debug, Serialize)]
pub struct Parameter {
    /// Name: `e_x1`, or `e_x0` for the base.
    pub name: String,
    /// Number that is written in its place, with its own value; `None` if it is the unknown itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<Written>,
    /// Object that the unknown belongs to.
    pub kind: Kind,
    /// Frame of an error, from 1; 0 is the base. None for other unknowns.
    pub frame: Option<usize>,
    /// Name of that frame.
    pub frame_name: Option<String>,
    /// Name of the error by ISO 230-1, of a machine with slides along X, Y and Z; with a minus sign
    /// where the frame has the opposite one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iso: Option<String>,
    /// Identified value, in `unit`.
    pub value: f64,
    /// Standard deviation of the value, in `unit`.
    pub standard_deviation: f64,
    /// Unit: the length unit, rad, or empty.
    pub unit: &'static str,
    /// Is true if the standard deviation exceeds half of the prior's: the data contribute little.
    pub prior_dominated: bool,
}

/// Number that is written in place of a kept unknown.
#[derive(Clone, Debug, Serialize)]
pub struct Written {
    /// Name: `zero of q2`, `a of shoulder`, `e_x1`; `inner + outer` for magnitudes that act alike.
    pub name: String,
    /// Identified value, in `unit`.
    pub value: f64,
    /// Standard deviation of the value, in `unit`.
    pub standard_deviation: f64,
    /// Unit: the length unit, rad, or empty.
    pub unit: &'static str,
}

impl Parameter {
    /// Returns the number that is written, under its own name.
    pub fn as_written(&self) -> Written {
        let Self { name, value, standard_deviation, unit, .. } = self.clone();
        self.written.clone().unwrap_or(Written { name, value, standard_deviation, unit })
    }
}

/// Identified magnitude of a source of the spec.
#[derive(Clone, Debug, Serialize)]
pub struct Magnitude {
    /// Name of the source.
    pub source: String,
    /// Magnitude declared in the spec, in coherent units.
    pub declared: f64,
    /// Standard deviation declared in the spec, in coherent units; `None` if there is none.
    pub declared_deviation: Option<f64>,
    /// Identified magnitude, in coherent units; the declared one if it has no effect of its own.
    pub value: f64,
    /// Standard deviation of the magnitude, in coherent units; `None` if it has no effect
    /// of its own.
    pub standard_deviation: Option<f64>,
    /// Sum of this magnitude and of those that act as it; `None` if there are none.
    pub sum: Option<MagnitudeSum>,
    /// Is true if the standard deviation exceeds half of the declared one: the data contribute
    /// little.
    pub prior_dominated: bool,
}

/// Sum of magnitudes that act alike.
#[derive(Clone, Debug, Serialize)]
pub struct MagnitudeSum {
    /// Names of the sources and their factors.
    pub of: Vec<(String, f64)>,
    /// Identified value, in coherent units.
    pub value: f64,
    /// Standard deviation of the value, in coherent units.
    pub standard_deviation: f64,
}

/// Unknown that others stand for, and the combination that it is equivalent to.
#[derive(Clone, Debug, Serialize)]
pub struct Redundant {
    /// Name of the unknown.
    pub name: String,
    /// Names and factors of the equivalent combination of parameters; empty if the unknown has no
    /// effect.
    pub acts_as: Vec<(String, f64)>,
}

/// Two correlated parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Pair {
    /// Names of the parameters.
    pub of: [String; 2],
    /// Correlation coefficient.
    pub correlation: f64,
}

/// Position errors of a set of rows.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Compared {
    /// Number of rows.
    pub rows: usize,
    /// Number of independent configurations among them.
    pub configurations: usize,
    /// Errors as delivered: with the sources of the spec.
    pub before: Sizes,
    /// Errors with base and tool fitted.
    pub base_and_tool: Sizes,
    /// Errors with constants alone, if the model has richer terms or profiles.
    pub constant: Option<Sizes>,
    /// Errors with the identified model.
    pub after: Sizes,
    /// Improvement of the identified model over base and tool alone.
    pub gain: Gain,
    /// Improvement of the identified model over constants alone, if it has richer terms or
    /// profiles.
    pub gain_of_terms: Option<Gain>,
}

/// Position errors of k-fold cross-validation.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct CrossValidation {
    /// Number of parts.
    pub folds: usize,
    /// Number of independent configurations distributed over the parts.
    pub configurations: usize,
    /// Errors with constants alone, if richer terms were tried.
    pub constant: Option<Sizes>,
    /// Errors with the complete model.
    pub after: Sizes,
    /// Improvement by the richer terms over constants alone, if they were tried.
    pub gain: Option<Gain>,
}

/// Accepted group of terms.
#[derive(Clone, Debug, Serialize)]
pub struct TermGain {
    /// Name of the group.
    pub name: String,
    /// Terms of the group as lines of a spec with the identified magnitudes, one source effect
    /// each.
    pub lines: Vec<String>,
    /// Is true if a spec can contain these terms.
    pub written: bool,
    /// Root mean square residual of a coordinate in cross-validation without the group, in the
    /// length unit.
    pub before: f64,
    /// Root mean square residual of a coordinate in cross-validation with the group, in the length
    /// unit.
    pub after: f64,
    /// F statistic of the group, with configurations as independent samples.
    #[serde(serialize_with = "abbe_study::finite::or_null")]
    pub f: f64,
    /// Probability of an F at least as large by chance.
    pub p: f64,
}

/// Row that cannot be used.
#[derive(Clone, Debug, Serialize)]
pub struct LeftOut {
    /// File of the row.
    pub file: String,
    /// Line of the row in the file.
    pub line: u64,
    /// Reason, in words.
    pub reason: String,
}

impl LeftOut {
    pub(super) fn of_file(file: &Summary) -> impl Iterator<Item = Self> {
        let left_out =
            |row: &Unusable| Self { file: file.file.clone(), line: row.line, reason: row.reason.clone() };
        file.unusable.iter().map(left_out)
    }
}

/// Number of identifiable errors of base and frames, out of how many.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Counts {
    /// Number of identifiable combinations.
    pub rank: usize,
    /// Number of unknown errors.
    pub unknowns: usize,
    /// Is true if the errors of the base are among the unknowns.
    pub base: bool,
}

impl Counts {
    pub(crate) fn new(model: &Model, identifiable: &Identifiable) -> Self {
        let machine = |unknown: &Unknown| matches!(unknown, Unknown::Base(..) | Unknown::Error(..));
        let stands = |unknown: &Unknown| matches!(unknown, Unknown::Fixture(..) | Unknown::Zero(_));
        let kept = || identifiable.kept.iter().map(|k| &model.unknowns[*k]);
        Self {
            // Fixtures and zeros that absorb errors are not errors of the machine.
            rank: match model.unknowns.iter().any(stands) {
                true => kept().filter(|unknown| machine(unknown)).count(),
                false => identifiable.errors,
            },
            unknowns: model.unknowns.iter().filter(|unknown| machine(unknown)).count(),
            base: model.unknowns.iter().any(|unknown| matches!(unknown, Unknown::Base(..))),
        }
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = if self.base { "frames and base" } else { "frames" };
        write!(f, "{} of the {} errors of {of}", self.rank, self.unknowns)
    }
}

/// False-alarm rate of the test.
const FALSE_ALARMS: f64 = 0.01;

/// Autocorrelation and drift of the residuals over time.
#[derive(Clone, Debug, Serialize)]
pub struct ResidualDrift {
    /// Correlation of the residuals with time.
    #[serde(flatten)]
    pub found: Drift,
    /// Is true if `p` is at most the false-alarm rate.
    pub is_drift: bool,
    /// False-alarm rate of the test.
    pub false_alarms: f64,
}

impl ResidualDrift {
    pub(crate) fn new(found: Drift) -> Self {
        Self { found, is_drift: found.p <= FALSE_ALARMS, false_alarms: FALSE_ALARMS }
    }
}

/// Test rows outside the fitted ranges of joints and inputs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct TestExtrapolation {
    /// Number of such rows.
    pub count: usize,
    /// Standard deviation of the tool point; `null` if the spec cannot be written.
    pub standard_deviation: Option<ToolPointDeviation>,
}

impl TestExtrapolation {
    /// Returns none if there are no such rows. `written` is the machine of the written spec,
    /// `points` are the measured ones in the frame of the tool.
    ///
    /// The deviations follow from the covariance and the random sources of the written spec, as in
    /// `measure`.
    pub(super) fn new(
        found: &FoundModel,
        spec: &Spec,
        test: &Data,
        written: Option<&Interpreter>,
        points: &[[f64; 3]],
    ) -> Option<Self> {
        let test = written.map_or(Cow::Borrowed(test), |_| found.as_written(spec, test));
        let places = test.observations.iter().map(|row| (&row.q[..], &row.u[..]));
        let fitted = written.map_or(&found.fitted, |written| &written.spec().fitted);
        let outside = places.filter(|(q, u)| fitted.iter().any(|range| range.is_outside(q, u)));
        let outside = outside.collect::<Vec<_>>();
        if outside.is_empty() {
            return None;
        }
        let standard_deviation =
            written.and_then(|written| ToolPointDeviation::new(written.spec(), written, points, &outside));
        Some(Self { count: outside.len(), standard_deviation })
    }
}

/// Error whose standard deviation from the data alone exceeds half of the prior's.
#[derive(Clone, Debug, Serialize)]
pub struct WeaklyDetermined {
    /// Name of the error.
    pub name: String,
    /// Standard deviation from the data alone, beside all kept unknowns, in `unit`.
    pub standard_deviation: f64,
    /// Standard deviation of the prior about zero, in `unit`.
    pub expected: f64,
    /// Unit: the length unit, rad, or empty.
    pub unit: &'static str,
}

impl WeaklyDetermined {
    pub(crate) fn all(model: &Model, identifiable: &Identifiable, length: LengthUnit) -> Vec<Self> {
        // A direction or a zero need not be known better than its prior.
        let matters = |k: usize| match model.unknowns[k] {
            Unknown::Fixture(fixture, _) => {
                matches!(model.fixtures[fixture].geometry, FixtureGeometry::Point(_))
            }
            Unknown::Zero(_) | Unknown::Intrinsic(_) => false,
            _ => true,
        };
        let weak = identifiable.weak.iter();
        let weak = weak.filter(|weak| weak.expected.is_finite() && matters(weak.unknown));
        let determined_weakly = weak.map(|weak| {
            let unknown = model.unknowns[weak.unknown];
            Self {
                name: model.name(unknown),
                standard_deviation: weak.deviation,
                expected: weak.expected,
                unit: match unknown {
                    Unknown::Magnitude(_) => "",
                    _ if unknown.is_rotation() => "rad",
                    _ => length.symbol(),
                },
            }
        });
        determined_weakly.collect()
    }
}
