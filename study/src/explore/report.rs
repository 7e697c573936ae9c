//! Data of a live page.

use std::sync::Arc;

use abbe::Manipulator;
use abbe_interpreter::Interpreter;
use abbe_spec::{Closure, Loop, Spec};
use serde::Serialize;

use crate::analyze::Analyze;
use crate::calibration::named_as_one;
use crate::jacobian::column_names;
use crate::machine::followed_source;
use crate::study_file::{Content, Criterion, Figure, JudgedMachine, Study, UP};
use crate::{Residuals, number};

/// Data of a live page: a machine, its study, and its generated code. Lengths are in the spec's
/// unit, angles in rad, vectors in `F_0`.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// SPEC as it was given: path of a spec, or name of a shipped manipulator. Empty if spec or
    /// study is a text, which no command can name.
    pub spec: String,
    /// Name of the manipulator.
    pub name: String,
    /// Title of the spec.
    pub title: String,
    /// Description of the machine.
    pub description: String,
    /// Options of `abbe analyze` that give the figures of this machine: its study and changes.
    pub command: Vec<String>,
    /// Options of `abbe jacobian` for this machine: the changes of the study, then the given ones.
    pub jacobian_command: Vec<String>,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Units in which errors are shown.
    pub error_unit: ErrorUnit,
    /// Convention of rows 4–6: `rotation-vector`, `euler-yzx` or `iec-61217`.
    pub orientation: &'static str,
    /// Names of the rows of `J_e`.
    pub rows: [&'static str; 6],
    /// Names of the columns of `J_e`: `e_x1 … e_p1`, then those of frame 2, …
    pub columns: Vec<String>,
    /// The study.
    pub study: StudyFacts,
    /// Frames, from base to tip.
    pub frames: Vec<FrameName>,
    /// Lines of the picture, each between two of `F_0`, the frames, and the tool, as indices from
    /// 0: for each frame and the tool one from what it hangs on, then the legs.
    pub links: Vec<[usize; 2]>,
    /// `true` if loops determine passive variables: then the code returns NaN where they do not
    /// close.
    pub has_loops: bool,
    /// `true` if a tool follows the last frame.
    pub tool: bool,
    /// Index of the axis of `F_0` that points up in pictures of the manipulator.
    pub up: usize,
    /// Joint variables, in order.
    pub variables: Vec<LiveVariable>,
    /// Inputs of the spec, in order. The code has further ones, the factors of repeatable sources.
    pub inputs: Vec<LiveInput>,
    /// Structural parameters, in order.
    pub parameters: Vec<LiveParameter>,
    /// Error sources in the order of the code, including disabled ones, and the uncertainty of the
    /// repeatable errors as normal random sources.
    pub sources: Vec<LiveSource>,
    /// Generalized errors that `effects` of the code returns, in its order: indices of source,
    /// frame and component.
    pub effects: Vec<[usize; 3]>,
    /// Reachable configurations of the study's workspace, at most 1,000, evenly chosen; or those of
    /// the measured rows.
    pub configurations: Configurations,
    /// Measured rows with their errors; absent without any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residuals: Option<Residuals>,
    /// ES module of the machine, with every source enabled and a factor of each repeatable source
    /// as an input.
    pub code: String,
}

/// Units in which errors are shown.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ErrorUnit {
    /// Symbol of the unit of position errors, and its number in the length unit (a factor).
    pub length: (&'static str, f64),
    /// Symbol of the unit of orientation errors, and its number in 1 rad (a factor).
    pub angle: (&'static str, f64),
}

/// Study of a live page.
#[derive(Clone, Debug, Serialize)]
pub struct StudyFacts {
    /// Title of the study.
    pub title: String,
    /// Permitted position error of the tool point, in the length unit; `None` without a tolerance.
    pub tolerance: Option<f64>,
    /// Permitted norm of rows 4–6, in rad; `None` without one.
    pub orientation_tolerance: Option<f64>,
    /// Machine that the tolerance is held against.
    pub judged: JudgedMachine,
    /// Criterion of the verdict.
    pub criterion: Criterion,
}

/// Name of a frame.
#[derive(Clone, Debug, Serialize)]
pub struct FrameName {
    /// Name of the frame.
    pub name: String,
}

/// A joint variable.
#[derive(Clone, Debug, Serialize)]
pub struct LiveVariable {
    /// Name of the variable.
    pub name: String,
    /// `revolute` or `prismatic`.
    pub kind: &'static str,
    /// Lower and upper limit, in the length unit or rad; infinite without one.
    #[serde(serialize_with = "crate::finite::or_null")]
    pub limits: [f64; 2],
    /// Value at home, in the length unit or rad.
    pub home: f64,
    /// Description.
    pub description: String,
}

/// An input of the spec.
#[derive(Clone, Debug, Serialize)]
pub struct LiveInput {
    /// Name of the input.
    pub name: String,
    /// Nominal value, in coherent units.
    pub nominal: f64,
    /// Lower and upper end of its range, in coherent units; infinite without one.
    #[serde(serialize_with = "crate::finite::or_null")]
    pub range: [f64; 2],
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Description.
    pub description: String,
}

/// A structural parameter.
#[derive(Clone, Debug, Serialize)]
pub struct LiveParameter {
    /// Name of the parameter.
    pub name: String,
    /// Nominal value, in coherent units.
    pub nominal: f64,
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Smallest and largest value in the study, in coherent units; `None` if it is nominal there.
    pub range: Option<[f64; 2]>,
    /// Description.
    pub description: String,
}

/// An error source.
#[derive(Clone, Debug, Serialize)]
pub struct LiveSource {
    /// Name of the source.
    pub name: String,
    /// `repeatable`, `tolerance` or `random`.
    pub class: &'static str,
    /// Distribution of a random error.
    pub distribution: Option<&'static str>,
    /// Bound of a random error, as a factor of its value: 3 for a normal one, 1 for all others.
    pub bound: f64,
    /// Location of its errors, such as `joint q4`.
    pub at: String,
    /// `true` if the source is enabled.
    pub enabled: bool,
    /// Sources of the code: its own, or the parts of its error.
    pub parts: Vec<usize>,
    /// Index of the input of the code that is the factor of a repeatable source.
    pub magnitude: Option<usize>,
    /// Factor of its errors in this machine: its magnitude in the spec.
    pub value: f64,
    /// Index of the source whose factor and switch it shares: its own; that of the source whose
    /// magnitude is uncertain. `None` without both: for an error of the calibration, and for a
    /// disabled source with a weight, which loads the structure only where the source is enabled.
    pub follows: Option<usize>,
    /// Description.
    pub description: String,
}

/// Configurations of the workspace.
#[derive(Clone, Debug, Serialize)]
pub struct Configurations {
    /// Joint variables of each, in the length unit or rad.
    pub q: Vec<Vec<f64>>,
    /// Inputs of each, in coherent units; empty if all are nominal.
    pub u: Vec<Vec<f64>>,
    /// Parameters of each, in coherent units; empty if all are nominal.
    pub s: Vec<Vec<f64>>,
}

impl Report {
    pub(super) fn new(
        analysis: &Analyze,
        [command, jacobian_command]: [Vec<String>; 2],
        tunable: &Spec,
        effects: Vec<[usize; 3]>,
        configurations: Configurations,
        code: String,
    ) -> Self {
        let (machine, study) = (analysis.machine(), analysis.study());
        let spec = &machine.spec;
        let (factor, symbol) = number::error_unit(spec.length.symbol());
        let sources = sources(spec, tunable);
        // All parts of an error are one source.
        let place =
            |k: usize| sources.iter().position(|source| source.parts.contains(&k)).unwrap_or_default();
        let effects = effects.into_iter().map(|[source, frame, error]| [place(source), frame, error]);
        let effects: Vec<[usize; 3]> = effects.collect();
        Self {
            spec: machine.origin.clone(),
            name: spec.name.clone(),
            title: spec.title.clone(),
            description: spec.description.clone(),
            command,
            jacobian_command,
            length: spec.length.symbol(),
            error_unit: ErrorUnit { length: (symbol, factor), angle: ("mrad", 1e3) },
            orientation: spec.orientation.name(),
            rows: spec.orientation.rows(),
            columns: column_names(spec.frames.len()),
            study: StudyFacts {
                title: study.title.clone(),
                tolerance: study.tolerance,
                orientation_tolerance: study.orientation_tolerance,
                judged: study.judged,
                criterion: study.criterion,
            },
            frames: spec.frames.iter().map(|frame| FrameName { name: frame.name.clone() }).collect(),
            links: links(spec),
            has_loops: !spec.loops.is_empty(),
            tool: !spec.tool.is_empty(),
            up: up(study),
            variables: variables(spec),
            inputs: inputs(spec),
            parameters: parameters(spec, |i| study.region.parameter_range(i)),
            sources,
            effects,
            configurations,
            residuals: None,
            code,
        }
    }

    /// Returns the report without its code, as JSON.
    pub fn data(&self) -> Result<String, serde_json::Error> {
        let mut data = serde_json::to_value(self)?;
        data.as_object_mut().map(|fields| fields.remove("code"));
        serde_json::to_string(&data)
    }
}

/// Returns the indices of source, frame and component of each effect.
pub(super) fn effects(manipulator: &Interpreter) -> Vec<[usize; 3]> {
    let effects = manipulator.description().effects.iter();
    effects.map(|effect| [effect.source, effect.frame, effect.component.index()]).collect()
}

/// Returns the lines of the picture.
fn links(spec: &Spec) -> Vec<[usize; 2]> {
    let after = |frame: Option<usize>| frame.map_or(0, |frame| frame + 1);
    let carriers = spec.frames.iter().map(|frame| frame.parent).chain([Some(spec.tool_frame)]);
    let is_leg = |closed: &&Loop| matches!(closed.closure, Closure::Distance(_));
    let legs = spec.loops.iter().filter(is_leg).map(|leg| leg.frames.map(after));
    carriers.enumerate().map(|(i, carrier)| [after(carrier), i + 1]).chain(legs).collect()
}

/// Returns the axis that points up in the study's picture of the manipulator, or in others.
fn up(study: &Study) -> usize {
    let of_picture = |figure: &Figure| match figure.content {
        Content::Manipulator(up) => Some(up),
        _ => None,
    };
    study.figures.iter().find_map(of_picture).unwrap_or(UP)
}

fn variables(spec: &Spec) -> Vec<LiveVariable> {
    let variable = |one: &abbe_spec::Variable| LiveVariable {
        name: one.name.clone(),
        kind: one.kind.either("revolute", "prismatic"),
        limits: one.limits,
        home: one.home,
        description: one.description.clone(),
    };
    spec.variables.iter().map(variable).collect()
}

fn inputs(spec: &Spec) -> Vec<LiveInput> {
    let input = |one: &abbe_spec::Input| LiveInput {
        name: one.name.clone(),
        nominal: one.value,
        range: one.range,
        unit: one.unit.clone(),
        description: one.description.clone(),
    };
    spec.inputs.iter().map(input).collect()
}

fn parameters(spec: &Spec, range: impl Fn(usize) -> Option<[f64; 2]>) -> Vec<LiveParameter> {
    let parameter = |(i, one): (usize, &abbe_spec::Parameter)| LiveParameter {
        name: one.name.clone(),
        nominal: one.value,
        unit: one.unit.clone(),
        range: range(i),
        description: one.description.clone(),
    };
    spec.parameters.iter().enumerate().map(parameter).collect()
}

/// Returns the sources of the code, with all parts of an error as one.
fn sources(spec: &Arc<Spec>, tunable: &Spec) -> Vec<LiveSource> {
    let spec = named_as_one(spec);
    let mut parts = vec![Vec::new(); spec.sources.len()];
    (0..spec.sources.len()).for_each(|k| parts[spec.whole(k)].push(k));
    let place = |whole: usize| parts[..whole].iter().filter(|parts| !parts.is_empty()).count();
    let source = |(i, one): (usize, &abbe_spec::Source)| {
        let (class, distribution) = number::class(one.class);
        LiveSource {
            parts: parts[i].clone(),
            name: one.name.clone(),
            class,
            distribution,
            bound: one.class.bound(),
            at: spec.place(one),
            enabled: one.enabled,
            magnitude: tunable.sources[i].tuned_by,
            value: one.factor(),
            follows: followed_source(&spec, i).filter(|_| one.enabled || !one.has_weight()).map(place),
            description: one.description.clone(),
        }
    };
    spec.sources.iter().enumerate().filter(|(i, _)| !parts[*i].is_empty()).map(source).collect()
}
