//! Frames that branch, and loops: the freedoms, and how the loops close at home.
//!
//! Numbers without a unit have lengths relative to those of the loops.

use abbe::{Manipulator, analysis::sampling};
use abbe_spec::{Spec, expr::Symbol};
use nalgebra::DMatrix;
use serde::Serialize;

use super::modes::{LoopModes, SINGULAR, search};
use crate::{closing::Closing, dead_point::DeadPoint};

/// Largest equation, without a unit, of loops that close.
const CLOSED: f64 = 1e-9;

/// Smallest share of a passive variable, or of an equation, in a singular direction that is named.
const SHARE: f64 = 1e-4;

/// Machine whose frames are not a chain.
#[derive(Clone, Debug, Serialize)]
pub struct Tree {
    /// Name of the frame that carries the tool.
    pub tool: String,
    /// Number of commanded variables: the freedoms of the machine.
    pub commanded: usize,
    /// Passive variables, which the loops determine.
    pub passive: Vec<Passive>,
    /// Number of equations of all loops; as many as passive variables.
    pub equations: usize,
    /// Loops.
    pub loops: Vec<Loop>,
    /// Conditioning of the loops at home; absent without loops.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub home: Option<Home>,
}

/// Passive joint variable, in the length unit or rad.
#[derive(Clone, Debug, Serialize)]
pub struct Passive {
    /// Name of the variable.
    pub name: String,
    /// Name of the frame that it moves.
    pub frame: String,
    /// Kind of the joint: `revolute` or `prismatic`.
    pub kind: &'static str,
    /// Value at home in the spec, from which its value is found.
    pub start: f64,
    /// Value at home for which the loops close, or for which they are nearest to closing.
    pub value: f64,
}

/// A loop.
#[derive(Clone, Debug, Serialize)]
pub struct Loop {
    /// Name of the loop.
    pub name: String,
    /// Names of its two frames, `base` for `F_0`.
    pub frames: [String; 2],
    /// Number of its equations.
    pub equations: usize,
    /// Names of the passive variables that move it.
    pub passive: Vec<String>,
    /// Distance by which it stays open at home, in the length unit: root of the sum of squares of
    /// its equations of lengths; null without one.
    pub gap: Option<f64>,
    /// Angle by which it stays open at home, in rad; null without equations of angles.
    pub angular_gap: Option<f64>,
}

/// Loops at home.
#[derive(Clone, Debug, Serialize)]
pub struct Home {
    /// State of the loops.
    pub state: State,
    /// Condition number of φ_p in the 2-norm, with lengths relative to those of the loops; null
    /// if it is not finite.
    pub condition: Option<f64>,
    /// Smallest singular value of φ_p, without a unit; null if it is not finite.
    pub smallest_singular: Option<f64>,
    /// Nearest dead point that one joint reaches alone from home; absent if there is none within
    /// the limits of the joints, or unless closed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dead_point: Option<DeadPoint>,
    /// Assembly modes of the loops, where these do not depend on each other one by one; empty
    /// unless closed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub modes: Vec<LoopModes>,
    /// Directions in which the passive variables can move by themselves; empty unless singular.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub free: Vec<Free>,
}

/// State of the loops at home.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum State {
    /// They close.
    Closed,
    /// No values of the passive variables near home close them.
    Open,
    /// They close at values that Newton's method does not reach from home.
    Far,
    /// Passive variables can move by themselves.
    Singular,
}

/// Direction in which passive variables can move by themselves.
#[derive(Clone, Debug, Serialize)]
pub struct Free {
    /// Names of the passive variables that move.
    pub passive: Vec<String>,
    /// Motion of each, relative to the fastest, without a unit: lengths relative to those of the
    /// loops.
    pub motion: Vec<f64>,
    /// Names of the loops whose equations depend on each other.
    pub loops: Vec<String>,
}

impl Tree {
    /// Describes a machine; `None` for a chain.
    pub(super) fn new(spec: &Spec, manipulator: &dyn Manipulator) -> Option<Self> {
        if spec.is_serial() {
            return None;
        }
        let found = (!spec.loops.is_empty()).then(|| at_home(spec, manipulator));
        let (values, gaps, home) =
            found.map(|(values, gaps, home)| (values, gaps, Some(home))).unwrap_or_default();
        let frame = |frame: usize| spec.frames[frame].name.clone();
        let passive = spec.passive.iter().zip(values).map(|(variable, value)| Passive {
            name: variable.name.clone(),
            frame: frame(variable.frame),
            kind: variable.kind.either("revolute", "prismatic"),
            start: variable.home,
            value,
        });
        let mut gaps = gaps.into_iter();
        let loops = spec.loops.iter().map(|closed| {
            let symbols = spec.tree().symbols(closed);
            let moves = |index: &usize| symbols.contains(&Symbol::Passive(*index));
            let moved = (0..spec.passive.len()).filter(moves);
            let equations = closed.closure.equations();
            let own: Vec<(usize, f64)> = gaps.by_ref().take(equations).enumerate().collect();
            let norm = |is_angle: bool| {
                let rows = own.iter().filter(|(i, _)| closed.closure.is_angle(*i) == is_angle);
                rows.map(|(_, gap)| gap.abs()).reduce(f64::hypot)
            };
            Loop {
                name: closed.name.clone(),
                frames: closed.frames.map(|end| end.map_or("base".to_owned(), frame)),
                equations,
                passive: moved.map(|index| spec.passive[index].name.clone()).collect(),
                gap: norm(false),
                angular_gap: norm(true),
            }
        });
        Some(Self {
            tool: frame(spec.tool_frame),
            commanded: spec.variables.len(),
            passive: passive.collect(),
            equations: spec.equations(),
            loops: loops.collect(),
            home,
        })
    }

    /// Returns `true` if the machine can be evaluated at home.
    pub fn closes(&self) -> bool {
        self.home.as_ref().is_none_or(|home| home.state == State::Closed)
    }
}

/// Returns the passive variables and the equations at home, and what follows from them.
fn at_home(spec: &Spec, manipulator: &dyn Manipulator) -> (Vec<f64>, Vec<f64>, Home) {
    let description = manipulator.description();
    let (q, s) = (sampling::home(description), sampling::nominal_parameters(description));
    let mut closing = Closing::new(spec, &q, &s);
    let mut passive = vec![0.0; spec.passive.len()];
    let is_found = manipulator.passive(&q, &s, &mut passive).is_ok();
    if !is_found {
        passive = closing.nearest(&closing.home());
    }
    let is_closed = closing.size(&passive) <= CLOSED;
    let (condition, free) = conditioning(spec, closing.derivatives(&passive));
    let state = match (is_closed, free.is_empty(), is_found) {
        (false, _, _) => State::Open,
        (true, false, _) => State::Singular,
        (true, true, false) => State::Far,
        (true, true, true) => State::Closed,
    };
    let free = if state == State::Singular { free } else { Vec::new() };
    let gaps = closing.residual(&passive);
    let smallest_singular = closing.singular_values(&passive).map(|[_, smallest]| smallest);
    let (mut dead_point, mut modes) = (None, Vec::new());
    if state == State::Closed {
        dead_point = DeadPoint::nearest(spec, manipulator, [&q, &s], &closing.equations.variable_units);
        modes = search(spec, &mut closing, &passive);
    }
    (passive, gaps, Home { state, condition, smallest_singular, dead_point, modes, free })
}

/// Returns the condition number of `φ_p` and its null directions.
fn conditioning(spec: &Spec, derivatives: DMatrix<f64>) -> (Option<f64>, Vec<Free>) {
    if derivatives.iter().any(|entry| !entry.is_finite()) {
        return (None, Vec::new());
    }
    let svd = derivatives.svd(true, true);
    let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
    let condition = Some(largest / smallest).filter(|condition| condition.is_finite());
    let (Some(left), Some(right)) = (&svd.u, &svd.v_t) else { return (condition, Vec::new()) };
    let owners: Vec<&str> = spec
        .loops
        .iter()
        .flat_map(|closed| std::iter::repeat_n(closed.name.as_str(), closed.closure.equations()))
        .collect();
    let singular = (0..svd.singular_values.len()).filter(|i| svd.singular_values[*i] * SINGULAR <= largest);
    let free = singular.map(|i| {
        let (direction, equations) = (right.row(i), left.column(i));
        // The sign of the fastest is positive.
        let fastest = direction.iter().copied().reduce(|a, b| if b.abs() > a.abs() { b } else { a });
        let fastest = fastest.unwrap_or(1.0);
        let motion = direction.iter().map(|rate| rate / fastest);
        let (moved, motion) = (0..).zip(motion).filter(|(_, rate)| rate.abs() > SHARE).unzip();
        let moved: Vec<usize> = moved;
        let mut loops: Vec<String> = Vec::new();
        for (owner, share) in owners.iter().zip(equations.iter()) {
            if share.abs() > SHARE && !loops.iter().any(|name| name == owner) {
                loops.push((*owner).to_owned());
            }
        }
        Free {
            passive: moved.into_iter().map(|index| spec.passive[index].name.clone()).collect(),
            motion,
            loops,
        }
    });
    (condition, free.collect())
}
