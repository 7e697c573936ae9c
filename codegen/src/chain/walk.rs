//! Follows the chain factor by factor: equation (2).

use abbe_spec::{Elementary, Expression, Factor, Motion, Symbol};

use crate::graph::{Frame, Graph, Node, Vector};

/// A factor at its position in the chain, expressed in `F_0`.
pub(super) enum Step {
    /// A translation by `amount` along `direction`.
    Translation { direction: Vector, amount: Node },
    /// A rotation by `amount` about `axis` through the point `at`.
    Rotation { axis: Vector, at: Vector, amount: Node },
    /// Any other rigid motion, from the frame `before` it to the point `after` it.
    Matrix { before: Frame, local: Frame, after: Vector },
}

impl Step {
    /// Returns the symbols that the step itself depends on, regardless of the factors before it.
    pub(super) fn symbols(&self, graph: &Graph) -> Vec<Symbol> {
        match self {
            Self::Translation { amount, .. } | Self::Rotation { amount, .. } => graph.symbols(&[*amount]),
            Self::Matrix { local, .. } => graph.symbols(&local.entries()),
        }
    }
}

/// Extends the pose `frame` by a product of factors and appends their steps.
pub(super) fn walk(graph: &mut Graph, frame: Frame, factors: &[Factor], steps: &mut Vec<Step>) -> Frame {
    let mut frame = frame;
    let mut rest = factors;
    while let [factor, ..] = rest {
        let constant = rest.iter().take_while(|factor| is_constant_rotation(factor)).count();
        if rest[..constant].iter().filter(|factor| !is_quarter_turn(graph, factor)).count() > 1 {
            // Several constant rotations are folded into one.
            let identity = graph.identity();
            let folded = rest[..constant].iter().fold(identity, |f, factor| apply(graph, f, factor).0);
            frame = graph.then(&frame, &folded);
            rest = &rest[constant..];
            continue;
        }
        let (next, step) = apply(graph, frame, factor);
        frame = next;
        steps.push(step);
        rest = &rest[1..];
    }
    frame
}

/// Returns the motion of a product of factors: a local `A_i`, from `F_i` to `F_{i-1}`.
pub fn transform(graph: &mut Graph, factors: &[Factor]) -> Frame {
    let identity = graph.identity();
    factors.iter().fold(identity, |frame, factor| apply(graph, frame, factor).0)
}

fn apply(graph: &mut Graph, frame: Frame, factor: &Factor) -> (Frame, Step) {
    apply_with(graph, frame, factor, &|graph, amount| graph.lower(amount))
}

/// Extends a pose by a factor; `lower` converts its expressions to nodes.
pub(super) fn apply_with(
    graph: &mut Graph,
    frame: Frame,
    factor: &Factor,
    lower: &dyn Fn(&mut Graph, &Expression) -> Node,
) -> (Frame, Step) {
    match factor {
        Factor::Elementary(Elementary { motion: Motion::Translation, axis, amount }) => {
            let amount = lower(graph, amount);
            let step = Step::Translation { direction: frame.axes[*axis], amount };
            (graph.moved(&frame, *axis, amount), step)
        }
        Factor::Elementary(Elementary { motion: Motion::Rotation, axis, amount }) => {
            let amount = lower(graph, amount);
            let step = Step::Rotation { axis: frame.axes[*axis], at: frame.position, amount };
            (graph.turned(&frame, *axis, amount), step)
        }
        Factor::About { motion, axis, amount } => {
            let amount = lower(graph, amount);
            let local = axis.map(|component| graph.constant(component));
            let direction = graph.turn(&frame.axes, local);
            match motion {
                Motion::Translation => {
                    let position = graph.add_scaled(frame.position, amount, direction);
                    (Frame { position, ..frame }, Step::Translation { direction, amount })
                }
                Motion::Rotation => {
                    let rotation = about(graph, *axis, amount);
                    let axes = rotation.map(|column| graph.turn(&frame.axes, column));
                    (Frame { axes, ..frame }, Step::Rotation { axis: direction, at: frame.position, amount })
                }
            }
        }
        Factor::Matrix(matrix) => {
            let entry = |graph: &mut Graph, column: usize| {
                [0, 1, 2].map(|row| lower(graph, &matrix.rows[row][column]))
            };
            let local =
                Frame { axes: [0, 1, 2].map(|column| entry(graph, column)), position: entry(graph, 3) };
            let next = graph.then(&frame, &local);
            (next, Step::Matrix { before: frame, local, after: next.position })
        }
    }
}

/// Returns the columns of `R = cos θ I + sin θ [a] + (1 − cos θ) a aᵀ`.
pub(super) fn about(graph: &mut Graph, axis: [f64; 3], angle: Node) -> [Vector; 3] {
    let (sine, cosine, one) = (graph.sin(angle), graph.cos(angle), graph.constant(1.0));
    let versine = graph.sub(one, cosine);
    std::array::from_fn(|j| {
        std::array::from_fn(|i| {
            let (square, skew) = (graph.constant(axis[i] * axis[j]), graph.constant(skew(axis, i, j)));
            let (first, second) = (graph.mul(square, versine), graph.mul(skew, sine));
            let sum = graph.add(first, second);
            if i == j { graph.add(cosine, sum) } else { sum }
        })
    })
}

/// Returns entry (i, j) of the matrix `[a]` with `[a] v = a × v`.
fn skew(a: [f64; 3], i: usize, j: usize) -> f64 {
    match (3 + j - i) % 3 {
        0 => 0.0,
        1 => -a[(j + 1) % 3],
        _ => a[(i + 1) % 3],
    }
}

fn is_constant_rotation(factor: &Factor) -> bool {
    matches!(factor, Factor::Elementary(Elementary { motion: Motion::Rotation, amount, .. })
        if amount.constant().is_some())
}

fn is_quarter_turn(graph: &mut Graph, factor: &Factor) -> bool {
    let Factor::Elementary(Elementary { amount, .. }) = factor else { return false };
    let angle = graph.lower(amount);
    let sine = graph.sin(angle);
    graph.value(sine).is_some_and(|sine| sine.fract() == 0.0)
}

#[cfg(test)]
mod tests;
