//! Converts a deviation of a number of the chain to errors of the frames whose transforms depend on
//! it.
//!
//! With `A_i E_i = A_i(x + δx)`, the errors of frame i are, to first order,
//!
//! ```text
//! ε_i = vee(A_i⁻¹ ∂A_i/∂x) δx          and of the tool, after E_n:   ε_n = vee(∂T/∂x T⁻¹) δx
//! ```

use abbe_spec::{ChainNumber, Elementary, Factor, Function, Motion, Spec, Symbol};

use super::symbol_jacobian::{Steps, twist};
use super::{FrameTwist, Local, tree};
use crate::graph::{Graph, Node, Op, Vector};

/// Returns the twist of every frame that depends on a number of the chain. The tool's twist is
/// added to that of the frame that carries it; a leg that becomes longer moves the frame at its end
/// back.
pub fn frame_twists(graph: &mut Graph, spec: &Spec, number: ChainNumber) -> Vec<FrameTwist> {
    let symbol = match number {
        ChainNumber::Joint(variable) => Symbol::Variable(variable),
        ChainNumber::Parameter(parameter) => Symbol::Parameter(parameter),
        ChainNumber::DenavitHartenberg { frame, number } => {
            let order = spec.frames[frame].convention.map(|convention| convention.order());
            let chosen = order.and_then(|order| order.iter().position(|&of_frame| of_frame == number));
            let mut body = Body::at_rest(graph);
            for (place, factor) in spec.frames[frame].factors.iter().enumerate() {
                body.go_through(graph, factor);
                if Some(place) == chosen {
                    let (motion, axis) = number.motion();
                    let one = graph.constant(1.0);
                    body.add_elementary(graph, motion, axis, one);
                }
            }
            return vec![FrameTwist { frame, velocity: body.velocity, rotation: body.rotation }];
        }
    };
    let mut twists = transform_twists(graph, spec, symbol);
    tree::add_lengths(graph, spec, symbol, &mut twists);
    let at_rest = [graph.zero(); 3];
    twists.retain(|twist| [twist.velocity, twist.rotation] != [at_rest; 2]);
    twists
}

/// Returns the twist of every frame per unit of a symbol in its transform.
pub(super) fn transform_twists(graph: &mut Graph, spec: &Spec, symbol: Symbol) -> Vec<FrameTwist> {
    let frames = 0..spec.frames.len();
    let mut twists: Vec<FrameTwist> = frames.map(|frame| local_twist(graph, spec, symbol, frame)).collect();
    if let Some(carrier) = twists.get_mut(spec.tool_frame) {
        add_tool(graph, spec, symbol, carrier);
    }
    twists
}

/// Returns the twist of the frame that declares a joint. For the last frame it includes the tool's
/// twist.
pub fn joint_twist(graph: &mut Graph, spec: &Spec, joint: usize) -> FrameTwist {
    let (frame, symbol) = (spec.variables[joint].frame, Symbol::Variable(joint));
    let mut twist = local_twist(graph, spec, symbol, frame);
    if frame + 1 == spec.frames.len() {
        add_tool(graph, spec, symbol, &mut twist);
    }
    twist
}

/// Returns the twist of one frame per unit of a symbol.
pub(super) fn local_twist(graph: &mut Graph, spec: &Spec, symbol: Symbol, frame: usize) -> FrameTwist {
    let mut body = Body::at_rest(graph);
    for factor in &spec.frames[frame].factors {
        body.go_through(graph, factor);
        body.add_factor(graph, factor, symbol);
    }
    FrameTwist { frame, velocity: body.velocity, rotation: body.rotation }
}

/// Adds the twist of the tool, which follows the errors of the last frame.
fn add_tool(graph: &mut Graph, spec: &Spec, symbol: Symbol, last: &mut FrameTwist) {
    let steps = Steps::of_transform(graph, &spec.tool);
    let origin = [graph.zero(); 3];
    let [velocity, rotation] = twist(graph, &steps, symbol, origin);
    last.velocity = graph.add_vectors(last.velocity, velocity);
    last.rotation = graph.add_vectors(last.rotation, rotation);
}

/// Twist of a frame that passes through a product of factors, in the axes behind the factors passed
/// so far:
///
/// ```text
/// through (R, t):     v ← Rᵀ (v + ω × t)     ω ← Rᵀ ω
/// the factor's own:   v ← v + Rᵀ ∂t/∂x       ω ← ω + vee(Rᵀ ∂R/∂x)
/// ```
struct Body {
    velocity: Vector,
    rotation: Vector,
}

impl Body {
    fn at_rest(graph: &mut Graph) -> Self {
        let zero = [graph.zero(); 3];
        Self { velocity: zero, rotation: zero }
    }

    fn go_through(&mut self, graph: &mut Graph, factor: &Factor) {
        for motion in Local::motions(graph, std::slice::from_ref(factor)) {
            self.go_through_motion(graph, &motion);
        }
    }

    fn go_through_motion(&mut self, graph: &mut Graph, motion: &Local) {
        if let Local::Shift(shift) = motion {
            self.velocity = graph.add_cross(self.velocity, self.rotation, *shift);
        }
        self.velocity = motion.direction_behind(graph, self.velocity);
        self.rotation = motion.direction_behind(graph, self.rotation);
    }

    /// Adds the twist that a symbol causes within a factor already passed.
    fn add_factor(&mut self, graph: &mut Graph, factor: &Factor, symbol: Symbol) {
        match factor {
            Factor::Elementary(Elementary { motion, axis, amount }) => {
                let amount = graph.lower(amount);
                let slope = graph.diff(amount, symbol);
                self.add_elementary(graph, *motion, *axis, slope);
            }
            Factor::About { motion, axis, amount } => {
                let amount = graph.lower(amount);
                let slope = graph.diff(amount, symbol);
                let axis = axis.map(|component| graph.constant(component));
                let part = graph.scale(slope, axis);
                self.add(graph, *motion, part);
            }
            Factor::Matrix(_) => {
                // The local motions of a matrix move one after the other as well.
                let mut body = Self::at_rest(graph);
                for motion in Local::motions(graph, std::slice::from_ref(factor)) {
                    body.go_through_motion(graph, &motion);
                    body.add_motion(graph, &motion, symbol);
                }
                self.add(graph, Motion::Translation, body.velocity);
                self.add(graph, Motion::Rotation, body.rotation);
            }
        }
    }

    fn add_motion(&mut self, graph: &mut Graph, motion: &Local, symbol: Symbol) {
        match motion {
            Local::Shift(shift) => {
                let slopes = shift.map(|component| graph.diff(component, symbol));
                self.add(graph, Motion::Translation, slopes);
            }
            Local::Turn { axis, sine, cosine } => {
                let slope = turning(graph, *sine, *cosine, symbol);
                self.add_elementary(graph, Motion::Rotation, *axis, slope);
            }
            Local::Rotation(axes) => {
                let slopes = axes.map(|axis| axis.map(|component| graph.diff(component, symbol)));
                // Entry (k, j) of Rᵀ ∂R/∂x.
                let rotation = [0, 1, 2].map(|i: usize| graph.dot(axes[(i + 2) % 3], slopes[(i + 1) % 3]));
                self.add(graph, Motion::Rotation, rotation);
            }
        }
    }

    fn add_elementary(&mut self, graph: &mut Graph, motion: Motion, axis: usize, slope: Node) {
        let mut part = [graph.zero(); 3];
        part[axis] = slope;
        self.add(graph, motion, part);
    }

    fn add(&mut self, graph: &mut Graph, motion: Motion, part: Vector) {
        let sum = match motion {
            Motion::Translation => &mut self.velocity,
            Motion::Rotation => &mut self.rotation,
        };
        *sum = graph.add_vectors(*sum, part);
    }
}

/// Returns `∂θ/∂x = cos θ ∂sin θ/∂x − sin θ ∂cos θ/∂x`. If the two are the sine and cosine of a
/// known angle a, in either order and with either sign, this is `±∂a/∂x`.
fn turning(graph: &mut Graph, sine: Node, cosine: Node, symbol: Symbol) -> Node {
    let plain = |graph: &Graph, node: Node| match graph.op(node) {
        Op::Call(function, angle) => Some((function, angle)),
        _ => None,
    };
    let signed = |graph: &Graph, node: Node| match graph.op(node) {
        Op::Neg(inner) => plain(graph, inner).map(|(function, angle)| (function, angle, true)),
        _ => plain(graph, node).map(|(function, angle)| (function, angle, false)),
    };
    if let (Some((first, a, first_negative)), Some((second, b, second_negative))) =
        (signed(graph, sine), signed(graph, cosine))
        && a == b
        && matches!((first, second), (Function::Sin, Function::Cos) | (Function::Cos, Function::Sin))
    {
        let slope = graph.diff(a, symbol);
        let backwards = (first == Function::Cos) ^ first_negative ^ second_negative;
        return if backwards { graph.neg(slope) } else { slope };
    }
    let slopes = graph.diff_all(&[sine, cosine], symbol);
    let (left, right) = (graph.mul(cosine, slopes[0]), graph.mul(sine, slopes[1]));
    graph.sub(left, right)
}
