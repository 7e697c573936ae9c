//! The nominal chain at home: the matrices `A_i` from the spec, and their product.

use std::borrow::Cow;

use abbe::{Manipulator, Pose, analysis::sampling};
use abbe_codegen::graph::Graph;
use abbe_spec::{DhConvention, DhNumber, Factor, Spec, expr::Elementary};
use serde::Serialize;

use crate::closing::value_at_home;

/// Matrices `A_1 … A_n`, the tool and the tool's pose at home, with nominal parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Chain {
    /// Frames, base to tip.
    pub frames: Vec<Link>,
    /// Tool `T`, from the frame that carries it, `F_n` in a chain, to the tool point, a homogeneous
    /// matrix, row by row.
    pub tool: [[f64; 4]; 4],
    /// Pose of the tool in `F_0`, a homogeneous matrix, row by row.
    pub pose: [[f64; 4]; 4],
}

/// One matrix `A_i` at home.
#[derive(Clone, Debug, Serialize)]
pub struct Link {
    /// Name of the frame.
    pub name: String,
    /// Denavit-Hartenberg parameters, if the spec states them, or a product of motions in their
    /// order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dh: Option<Dh>,
    /// Matrix from `F_i` coordinates to those of the frame that it hangs on, `F_{i-1}` in a chain,
    /// a homogeneous matrix, row by row.
    pub matrix: [[f64; 4]; 4],
}

/// Denavit-Hartenberg parameters: lengths in the spec's unit, angles in rad.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Dh {
    /// Convention, `standard` for `Rz(theta) Tz(d) Tx(a) Rx(alpha)`, `modified` for `Rx(alpha)
    /// Tx(a) Rz(theta) Tz(d)`.
    pub convention: &'static str,
    /// Rotation about z.
    pub theta: f64,
    /// Translation along z.
    pub d: f64,
    /// Translation along x.
    pub a: f64,
    /// Rotation about x.
    pub alpha: f64,
}

impl Chain {
    /// Evaluates the chain; returns `None` if its pose at home is not finite.
    pub(super) fn at_home(spec: &Spec, manipulator: &dyn Manipulator) -> Option<Self> {
        let description = manipulator.description();
        let (q, s) = (sampling::home(description), sampling::nominal_parameters(description));
        let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
        manipulator.transforms(&q, &s, &mut transforms).ok()?;
        let spec = &at_closed_loops(spec, manipulator, &q, &s)?;
        // Adding 0 turns −0 into 0.
        let rows = |pose: &Pose| pose.rows().map(|row| row.map(|entry| entry + 0.0));
        let frames = spec.frames.iter().zip(&transforms).map(|(frame, matrix)| Link {
            name: frame.name.clone(),
            dh: Dh::new(&frame.factors, frame.convention, spec),
            matrix: rows(matrix),
        });
        Some(Self {
            frames: frames.collect(),
            tool: transforms.last().map(rows)?,
            pose: rows(&manipulator.pose(&q, &s).ok()?),
        })
    }
}

/// Returns the spec with the values of the passive variables for which the loops close as home.
fn at_closed_loops<'s>(
    spec: &'s Spec,
    manipulator: &dyn Manipulator,
    q: &[f64],
    s: &[f64],
) -> Option<Cow<'s, Spec>> {
    if spec.passive.is_empty() {
        return Some(Cow::Borrowed(spec));
    }
    let mut passive = vec![0.0; spec.passive.len()];
    manipulator.passive(q, s, &mut passive).ok()?;
    let mut spec = spec.clone();
    spec.passive.iter_mut().zip(passive).for_each(|(variable, value)| variable.home = value);
    Some(Cow::Owned(spec))
}

impl Dh {
    /// Returns the parameters of a frame that states them, or whose elementary motions are some of
    /// the four in the order of either convention. Missing parameters are 0.
    fn new(factors: &[Factor], convention: Option<DhConvention>, spec: &Spec) -> Option<Self> {
        let all = [DhConvention::Standard, DhConvention::Modified];
        let conventions = convention.as_ref().map_or(&all[..], std::slice::from_ref);
        let (convention, numbers) =
            conventions.iter().find_map(|convention| Some((convention, assigned(factors, *convention)?)))?;
        let value = |wanted: DhNumber| {
            let found = numbers.iter().find(|(number, _)| *number == wanted);
            found.map_or(0.0, |(_, factor)| at_home(factor, spec))
        };
        Some(Self {
            convention: convention.name(),
            theta: value(DhNumber::Theta),
            d: value(DhNumber::D),
            a: value(DhNumber::A),
            alpha: value(DhNumber::Alpha),
        })
    }
}

/// Assigns a parameter to each factor; returns `None` unless the factors are some of the four in
/// the convention's order.
fn assigned(factors: &[Factor], convention: DhConvention) -> Option<Vec<(DhNumber, &Elementary)>> {
    let mut left = convention.order().into_iter();
    let mut numbers = Vec::new();
    for factor in factors {
        let Factor::Elementary(elementary) = factor else { return None };
        let number = left.find(|number| number.motion() == (elementary.motion, elementary.axis))?;
        numbers.push((number, elementary));
    }
    Some(numbers)
}

fn at_home(factor: &Elementary, spec: &Spec) -> f64 {
    let mut graph = Graph::with_tables(&spec.tables);
    let node = graph.lower(&factor.amount);
    graph.evaluate(&[node], |symbol| value_at_home(symbol, spec))[0] + 0.0
}
