//! Origins of the joints of the real machine, for formats that place each joint and let it turn
//! about, or slide along, an axis of its own frame.
//!
//! With all variables 0, let `U_k` be the frame of joint k of the format in `F_0`, and `N_i`, `R_i`
//! the nominal and the real chain up to the motion of the frame i that is this joint. The errors
//! before the joint displace it by `D_i = R_i N_i⁻¹`:
//!
//! ```text
//! U_k' = D_i U_k         the errors E_i after the joint displace the next joint, and the last ones the tool
//! ```
//!
//! By the product of exponentials `A_T(q) = exp(S_1 q_1) … exp(S_n q_n) A_T(0)` the tool is right
//! everywhere if every axis is, and if the tool is with all variables 0. Where spec and format
//! place an axis differently (rounded angles, catalogue numbers), the smallest motion brings `U_k'`
//! to the axis of the spec.
//!
//! Frames and legs of machines whose frames branch and close loops, with the mean errors.

use abbe::analysis::sampling::JointAxis;
use abbe::analysis::sampling::vectors::{add, cross, dot, scale};
use abbe::{Error, Manipulator, Pose, real_pose};
use abbe_codegen::chain::transform;
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_spec::{Expression, Factor, Symbol};

use super::{ChainErrors, Link, RealMachine, product};

/// Joint of the format.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    /// Pose of the joint in the previous link, in the unit of length of the spec.
    pub(crate) origin: Pose,
    /// Unit vector of the axis in the frame of the joint; `None` for a fixed joint.
    pub(crate) axis: Option<[f64; 3]>,
    /// Motion where all variables are 0.
    pub(crate) at_zero: Pose,
    /// Index of the frame of the spec that the joint corresponds to; every moving joint has one.
    pub(crate) frame: Option<usize>,
}

/// Returns the origins of the joints of the real machine; `tool` is the pose of the nominal tool in
/// the last link of the format.
///
/// `joints` are in the order from base to tip.
pub(crate) fn origins(machine: &RealMachine, joints: &[Joint], tool: &Pose) -> Result<Vec<Pose>, Error> {
    let zero = vec![0.0; machine.spec.variables.len()];
    let (nominal, _) = machine.links(&zero, &ChainErrors::none(&machine.spec))?;
    let (real, real_tool) = machine.links(&zero, &machine.mean)?;
    // Required pose of the last link.
    let tip = product(&real).then(&real_tool).then(&tool.inverse());
    let (mut old, mut new) = (Pose::IDENTITY, Pose::IDENTITY);
    let mut origins = Vec::with_capacity(joints.len());
    for (k, joint) in joints.iter().enumerate() {
        let frame = old.then(&joint.origin);
        let is_last = k + 1 == joints.len();
        let displaced = joint.frame.map(|i| {
            let up_to = |links: &[Link]| product(&links[..i]).then(&links[i].transform);
            let reached = up_to(&real);
            let reached = if joint.axis.is_none() { reached.then(&real[i].error) } else { reached };
            (reached.then(&up_to(&nominal).inverse()).then(&frame), up_to(&real))
        });
        let placed = match (joint.axis, displaced, joint.frame) {
            (Some(axis), Some((displaced, reached)), Some(i)) => {
                let wanted = if is_last { tip.then(&joint.at_zero.inverse()) } else { displaced };
                let own = axis_of_frame(machine, i)?;
                aligned(&wanted, axis, &own.in_outer_frame(&reached))
            }
            _ if is_last => tip,
            (None, Some((displaced, _)), _) => displaced,
            _ => new.then(&joint.origin),
        };
        origins.push(new.inverse().then(&placed));
        old = frame.then(&joint.at_zero);
        new = placed.then(&joint.at_zero);
    }
    Ok(origins)
}

/// Returns the axis of the joint of a frame, in the frame after the motion: the axis of `A_i(0)⁻¹
/// A_i(q)`.
fn axis_of_frame(machine: &RealMachine, frame: usize) -> Result<JointAxis, Error> {
    const SOME: f64 = 0.5;
    let variable = machine.spec.variables_of_transforms()[frame].first().copied().unwrap_or_default();
    let mut q = vec![0.0; machine.spec.variables.len()];
    let mut at = |value: f64| {
        let mut transforms = vec![Pose::IDENTITY; machine.spec.frames.len() + 1];
        q[variable] = value;
        machine.manipulator.transforms(&q, &machine.s, &mut transforms).map(|()| transforms[frame])
    };
    Ok(JointAxis::of_motion(&at(0.0)?.inverse().then(&at(SOME)?)))
}

/// Moves a frame by the smallest motion that puts its axis onto another.
fn aligned(frame: &Pose, axis: [f64; 3], wanted: &JointAxis) -> Pose {
    let from = frame.turn(axis);
    let sign = if dot(from, wanted.direction) < 0.0 { -1.0 } else { 1.0 };
    let to = scale(wanted.direction, sign);
    // R = 1 + [v]× + [v]×² / (1 + cos): the rotation from one direction to the other.
    let (v, c) = (cross(from, to), dot(from, to));
    let turned = |w: [f64; 3]| {
        let first = cross(v, w);
        add(add(w, first), scale(cross(v, first), 1.0 / (1.0 + c)))
    };
    let [x, y, z, p] = frame.0;
    Pose([turned(x), turned(y), turned(z), wanted.nearest(p)])
}

/// Returns `true` if joint variables, or passive ones, move a transform.
pub(crate) fn moves(factors: &[Factor]) -> bool {
    factors.iter().flat_map(Factor::expressions).flat_map(Expression::symbols).any(Symbol::is_joint)
}

impl RealMachine {
    /// Returns a transform where all variables are 0; loops stay open.
    pub(crate) fn pose_at_zero(&self, factors: &[Factor]) -> Pose {
        let mut graph = Graph::with_tables(&self.spec.tables);
        let Frame { axes: [x, y, z], position } = transform(&mut graph, factors);
        Pose([x, y, z, position].map(|column| column.map(|node| self.at_zero(&graph, node))))
    }

    /// Returns the errors of a frame.
    pub(crate) fn mean_error(&self, frame: usize) -> Pose {
        real_pose(&[Pose::IDENTITY; 2], &self.mean.frames[frame..=frame])
    }

    /// Returns an amount where all variables are 0, and the variable that is added to it or
    /// subtracted from it, if any, with its sign; `None` if it is anything else.
    pub(crate) fn affine(&self, amount: &Expression) -> Option<(f64, Option<(Symbol, f64)>)> {
        let mut graph = Graph::with_tables(&self.spec.tables);
        let node = graph.lower(amount);
        let mut own = None;
        for symbol in amount.symbols().filter(|symbol| symbol.is_joint()) {
            // Nodes read passive variables as local symbols.
            let slope =
                graph.diff(node, if let Symbol::Passive(i) = symbol { Symbol::Local(i) } else { symbol });
            let sign = graph.value(slope).filter(|slope| slope.abs() == 1.0)?;
            if own.replace((symbol, sign)).is_some_and(|(other, _)| other != symbol) {
                return None;
            }
        }
        Some((self.at_zero(&graph, node), own))
    }

    fn at_zero(&self, graph: &Graph, node: Node) -> f64 {
        graph.evaluate(&[node], |symbol| match symbol {
            Symbol::Variable(i) => self.mean.joints[i],
            Symbol::Parameter(i) => self.s[i] + self.mean.parameters[i],
            _ => 0.0,
        })[0]
    }

    /// Returns the pose of the tool, loops closed.
    pub(crate) fn mean_tool(&self, q: &[f64]) -> Result<Pose, Error> {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
        let (q, s) = (sum(q, &self.mean.joints), sum(&self.s, &self.mean.parameters));
        self.manipulator.displaced_pose(&q, &s, &self.mean.frames)
    }
}
