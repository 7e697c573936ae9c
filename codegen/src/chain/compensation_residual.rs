//! Error left after one step of compensation, as nodes to be maximized.

use abbe_spec::{ChainNumber, Elementary, Factor, Spec, Symbol};

use super::kinematics::of_repeatable;
use super::{Causes, JOINTS_OF_A_POSE, Links, Magnitude, RealChain, joint_step, sources};
use crate::graph::{Graph, Node, Vector};

/// Deviation of the real tool from the ideal one after one step of compensation, `q′ = q − J_q⁻¹
/// J_e ε`.
///
/// With t times the step d and t times the errors of the repeatable sources, the exact chain has
/// the tool point at p(t). Because `p′(0) = J_e ε + J_q d` is 0,
///
/// ```text
/// p(1) − p(0)  =  ∫₀¹ (1 − t) p″(t) dt        which is no longer than ½ ‖p″(t)‖ is anywhere in 0 ≤ t ≤ 1
/// ```
///
/// and the tool rotates by at most `∫₀¹ ‖ω(t)‖ dt ≤ ½ max ‖ω′(t)‖`. An error e that depends on
/// joints is `t e(q + t d)`. An error with kinks or jumps is `t e(q) + t² (e(q + d) − e(q))`, which
/// is smooth in t.
#[derive(Clone, Debug)]
pub struct CompensationResidual {
    /// The graph of the nodes.
    pub graph: Graph,
    /// ½ ‖p″(t)‖.
    pub point: Magnitude,
    /// ½ ‖ω′(t)‖; `None` for fewer than six joints, which correct the tool point only.
    pub turn: Option<Magnitude>,
    /// t.
    pub share: Symbol,
}

impl CompensationResidual {
    /// Builds the residual of a checked spec. Returns `None` for fewer than three joints, or if the
    /// transforms have kinks.
    pub fn new(spec: &Spec) -> Option<Self> {
        let (mut graph, effects, mut causes) = sources::effects_and_causes(spec);
        let g = &mut graph;
        let links = Links::new(g, spec);
        let errors = sources::generalized_errors(g, spec, &effects);
        let step = joint_step(g, spec, &links, &errors)?;

        let [t, zero, half] = [g.symbol(SHARE), g.zero(), g.constant(0.5)];
        let first = leading_joint(g, spec, &causes);
        causes.errors_mut().for_each(|error| *error = without_kinks(g, *error, &step));
        let links = RealChain::new(g, spec, &causes, of_repeatable(spec, t, zero)).links(g);
        let tool = g.identity();
        let tool = (0..=spec.frames.len()).rev().fold(tool, |tool, link| links.before(g, link, tool));
        let nodes = [&tool.position[..], tool.axes.as_flattened()].concat();
        // The bound from derivatives does not hold if the chain itself has kinks.
        if nodes.iter().any(|node| g.may_have_kinks(*node, is_joint)) {
            return None;
        }
        let moved: Vec<Node> = step
            .iter()
            .enumerate()
            .map(|(joint, step)| {
                let step = g.mul(t, *step);
                let q = g.symbol(Symbol::Variable(joint));
                if Some(joint) == first { step } else { g.add(q, step) }
            })
            .collect();
        let nodes = g.substitute(&nodes, |symbol| match symbol {
            Symbol::Variable(joint) => Some(moved[joint]),
            _ => None,
        });
        let variables: Vec<Node> = (0..step.len()).map(|joint| g.symbol(Symbol::Variable(joint))).collect();
        let nodes = g.substitute(&nodes, |symbol| held_joint(symbol).map(|joint| variables[joint]));
        let slopes = g.diff_all(&nodes, SHARE);
        let curves = g.diff_all(&slopes, SHARE);

        let vector =
            |nodes: &[Node], i: usize| -> Vector { [nodes[3 * i], nodes[3 * i + 1], nodes[3 * i + 2]] };
        let point = g.scale(half, vector(&curves, 0));
        // ω = ½ Σ a × a′ over the axes of the tool, and ω′ = ½ Σ a × a″.
        let mut turn = [zero; 3];
        for axis in 1..=3 {
            turn = g.add_cross(turn, vector(&nodes, axis), vector(&curves, axis));
        }
        let quarter = g.constant(0.25);
        let turn = g.scale(quarter, turn);
        let [point, turn] = [point, turn].map(|vector| Magnitude::length(g, vector));
        let turn = (spec.variables.len() >= JOINTS_OF_A_POSE).then_some(turn);
        Some(Self { graph, point, turn, share: SHARE })
    }
}

/// The symbol t.
const SHARE: Symbol = Symbol::Magnitude(0);

/// Returns the symbol of a joint at t = 0.
fn held(joint: usize) -> Symbol {
    Symbol::Magnitude(1 + joint)
}

fn is_joint(symbol: Symbol) -> bool {
    matches!(symbol, Symbol::Variable(_))
}

fn held_joint(symbol: Symbol) -> Option<usize> {
    match symbol {
        Symbol::Magnitude(number) => number.checked_sub(1),
        _ => None,
    }
}

/// Replaces an error with kinks or jumps along a joint by its value at t = 0 plus t times its
/// change over the step.
fn without_kinks(graph: &mut Graph, error: Node, step: &[Node]) -> Node {
    if !graph.may_have_kinks(error, is_joint) {
        return error;
    }
    let joints: Vec<Node> = (0..step.len()).map(|joint| graph.symbol(held(joint))).collect();
    let hold = |graph: &mut Graph, nodes: &[Node]| {
        graph.substitute(nodes, |symbol| match symbol {
            Symbol::Variable(joint) => Some(joints[joint]),
            _ => None,
        })
    };
    let before = hold(graph, &[error])[0];
    let step = hold(graph, step);
    let behind: Vec<Node> = joints.iter().zip(step).map(|(joint, step)| graph.add(*joint, step)).collect();
    let after = graph.substitute(&[error], |symbol| match symbol {
        Symbol::Variable(joint) => Some(behind[joint]),
        _ => None,
    })[0];
    let (t, change) = (graph.symbol(SHARE), graph.sub(after, before));
    graph.add_product(before, t, change)
}

/// Returns the joint that rotates or translates the whole machine: no moving factor precedes it,
/// and nothing else, in particular no norm, depends on it.
fn leading_joint(graph: &mut Graph, spec: &Spec, causes: &Causes) -> Option<usize> {
    let factors = &spec.frames.first()?.factors;
    let symbols = |factor: &Factor| -> Vec<Symbol> {
        factor.expressions().into_iter().flat_map(|expression| expression.symbols()).collect()
    };
    let moving = factors.iter().find(|factor| !symbols(factor).is_empty())?;
    let (Factor::Elementary(Elementary { amount, .. }) | Factor::About { amount, .. }) = moving else {
        return None;
    };
    let amount = graph.lower(amount);
    let [symbol @ Symbol::Variable(joint)] = graph.symbols(&[amount])[..] else { return None };
    let slope = graph.diff(amount, symbol);
    graph.value(slope)?;
    let all = spec.frames.iter().flat_map(|frame| &frame.factors).chain(&spec.tool);
    let dependent = all.filter(|factor| symbols(factor).contains(&symbol)).count();
    let is_off = |number: ChainNumber| matches!(number, ChainNumber::DenavitHartenberg { frame: 0, .. });
    let errors = causes.errors.iter().flat_map(|caused| {
        let place =
            caused.place.iter().flat_map(|place| place.axes.into_iter().flatten().chain(place.position));
        caused.errors.into_iter().chain(place)
    });
    let errors: Vec<Node> = errors.chain(causes.deviations.iter().map(|deviation| deviation.error)).collect();
    let is_alike = dependent == 1
        && !causes.deviations.iter().any(|deviation| is_off(deviation.number))
        && !graph.symbols(&errors).contains(&symbol);
    is_alike.then_some(joint)
}
