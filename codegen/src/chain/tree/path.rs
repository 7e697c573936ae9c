//! Newton's method along a path: how the passive variables are found.
//!
//! From home to the command, joint variables and parameters move together along a straight line;
//! for a machine with errors, these grow from zero at the nominal passive variables. With the share
//! t of the way that is behind, each step of Newton's method is, at a trial share t + h,
//!
//! ```text
//! δ = φ_p⁻¹ φ        p ← p − δ        s² = Σ (δ_i / unit_i)²        d_b = det φ_p,bb
//! ```
//!
//! for every irreducible block b of φ_p. It is good if s is at most half of the one before, or if
//! the loops close already, and if each `d_b` has its sign at home and at least a quarter of its
//! size at t. Otherwise p and t go back to where they were, and h is halved. When a later step is
//! at most a quarter of the one before, t + h is reached; p goes on by as much as it has moved, and
//! h is doubled if the step was at most an eighth. At the end of the path, the estimate of the next
//! step, `(s / s_before)² s`, has to be below the tolerance. Where a `d_b` becomes zero, h does,
//! too: the path ends there, although the loops may close further on in another mode.

use abbe_spec::{Function as Call, Symbol};

use super::{ClosedLoops, RealNodes, system::LoopSystem};
use crate::graph::{Graph, Node};

/// Largest number of steps.
pub(crate) const STEPS: usize = 256;

/// Smallest step of the share; below it the path has ended.
const SMALLEST: f64 = 1e-9;

/// Largest motion of a joint variable per step, in rad or in the unit of lengths.
const FARTHEST: f64 = 1.0;

/// Square of the size that stands for the step before the first one: the first is at most 1.
const FIRST: f64 = 4.0;

/// Square of a size from which larger ones are not told apart.
const HUGE: f64 = 100.0;

/// Largest equation of loops that close, in double and in single precision: relative to the length
/// of the loop, and in rad.
const CLOSED: [f64; 2] = [1e-10, 1e-5];

/// Nodes that find passive variables. Local symbols are, in this order, the passive variables p,
/// the errors of the machine, p at the share that was reached, and the state.
pub(crate) struct Path {
    pub(crate) graph: Graph,
    /// State at the beginning, from p.
    pub(crate) start: Vec<Node>,
    /// p, p at the share that was reached, and the state after a step. The first number of the
    /// state is positive while there is more to do.
    pub(crate) advance: Vec<Node>,
    /// Passive variables after a last step: not finite unless the loops close in home's mode, and
    /// infinite where a limit is exceeded.
    pub(crate) finish: Vec<Node>,
}

/// Numbers of the state, followed by `d_b` of each block.
const STATE: usize = 6;

impl Path {
    /// Builds the path from home to the nominal passive variables.
    pub(crate) fn nominal(graph: &Graph, loops: &ClosedLoops) -> Self {
        Self::new(graph, loops, &loops.nominal, None)
    }

    /// Builds the path from the nominal passive variables to those of a machine with errors.
    pub(crate) fn with_errors(graph: &Graph, loops: &ClosedLoops, real: &RealNodes) -> Self {
        Self::new(graph, loops, &real.system, Some(real.errors.len()))
    }

    /// Builds a path; `errors` is the number of errors that are local symbols, if there are any.
    fn new(graph: &Graph, loops: &ClosedLoops, system: &LoopSystem, errors: Option<usize>) -> Self {
        let (mut graph, passive) = (graph.clone(), loops.passive_home.len());
        let g = &mut graph;
        let first = passive + errors.unwrap_or(0);
        let count = first + passive + STATE + system.determinants.len();
        let locals: Vec<Node> = (0..count).map(|i| g.symbol(Symbol::Local(i))).collect();
        let (p, before) = (&locals[..passive], &locals[first..first + passive]);
        let state = &locals[first + passive..];
        let start = start(g, loops, p[0], errors.is_some(), system.determinants.len());
        let advance = advance(g, loops, system, [p, before, state], errors.is_some());
        let finish = finish(g, loops, system, p, state, errors.is_some());
        Self { graph, start, advance, finish }
    }

    /// Returns the passive variables, from those where the path begins.
    pub(crate) fn run(&self, start: &[f64], errors: &[f64], symbol: impl Fn(Symbol) -> f64) -> Vec<f64> {
        let evaluate = |nodes: &[Node], locals: &[&[f64]]| {
            let locals = locals.concat();
            self.graph.evaluate(nodes, |given| match given {
                // Other nodes may read more of them.
                Symbol::Local(i) => locals.get(i).copied().unwrap_or(f64::NAN),
                given => symbol(given),
            })
        };
        let mut values = [start, start, &evaluate(&self.start, &[start])].concat();
        for _ in 0..STEPS {
            let (p, others) = values.split_at(start.len());
            values = evaluate(&self.advance, &[p, errors, others]);
            let goes_on = values[2 * start.len()] > 0.0;
            if !goes_on {
                break;
            }
        }
        let (p, others) = values.split_at(start.len());
        evaluate(&self.finish, &[p, errors, others])
    }
}

/// Returns the state at the beginning: 1, the remaining share, h, the largest h, and the tolerance
/// of the equations, and `s²` before the first step; and 0 for each block, so that at first only
/// the signs count.
///
/// ```text
/// h = 1 / max(1, |q_i − home_i| / unit_i)        3 (4 / 3 − 1) − 1 = ± the rounding unit
/// ```
fn start(g: &mut Graph, loops: &ClosedLoops, passive: Node, has_errors: bool, blocks: usize) -> Vec<Node> {
    let (zero, one) = (g.zero(), g.constant(1.0));
    let mut span = one;
    for (i, (home, unit)) in loops.home.iter().zip(&loops.units.variables).enumerate().filter(|_| !has_errors)
    {
        let (value, home) = (g.symbol(Symbol::Variable(i)), g.constant(*home));
        let (way, unit) = (g.sub(value, home), g.constant(1.0 / (FARTHEST * unit)));
        let way = g.mul(way, unit);
        let way = g.call(Call::Abs, way);
        span = g.max(span, way);
    }
    let largest = g.div(one, span);
    // Zero, but not known to be before the program runs in its precision.
    let size = g.call(Call::Abs, passive);
    let nothing = g.min(size, zero);
    let [four_thirds, three, double, per_unit] =
        [4.0 / 3.0, 3.0, CLOSED[0], CLOSED[1] / f64::from(f32::EPSILON)].map(|value| g.constant(value));
    let sum = g.add(nothing, four_thirds);
    let third = g.sub(sum, one);
    let whole = g.mul(three, third);
    let unit = g.sub(whole, one);
    let unit = g.call(Call::Abs, unit);
    let single = g.mul(per_unit, unit);
    let tolerance = g.max(double, single);
    let first = g.constant(FIRST);
    let of_blocks = std::iter::repeat_n(zero, blocks);
    [one, one, largest, largest, tolerance, first].into_iter().chain(of_blocks).collect()
}

/// Returns p, p at the share that was reached, and the state after a step.
fn advance(
    g: &mut Graph,
    loops: &ClosedLoops,
    system: &LoopSystem,
    [p, before, state]: [&[Node]; 3],
    has_errors: bool,
) -> Vec<Node> {
    let [active, remaining, h, largest, tolerance, before_size] = [0, 1, 2, 3, 4, 5].map(|i| state[i]);
    let accepted = &state[STATE..];
    let one = g.constant(1.0);
    let rest = g.sub(remaining, h);
    let share = g.sub(one, rest);
    let system = system.substituted(g, |g, symbol| moved(g, loops, symbol, share, has_errors));

    let [half, quarter, huge] = [0.5, 0.25, HUGE].map(|value| g.constant(value));
    let gap = system.gap(g, &loops.units.equations);
    let is_closed = difference_is_positive(g, tolerance, gap);
    let size = system.size(g, &loops.units.passive);
    let size = g.min(size, huge);
    let [contracts, halfway, quickly, second] =
        [0.25, 1.0 / 16.0, 1.0 / 64.0, 2.0].map(|part| g.constant(part));
    let [contracts, halfway, quickly] = [contracts, halfway, quickly].map(|part| {
        let allowed = g.mul(before_size, part);
        difference_is_positive(g, allowed, size)
    });
    // Of the next step: s'² = (s / s_before)⁴ s².
    let (old, new) = (g.mul(before_size, before_size), g.mul(size, size));
    let tenth = g.constant(0.1);
    let small = g.mul(tenth, tolerance);
    let small = g.mul(small, small);
    let (old, new) = (g.mul(small, old), g.mul(new, size));
    let estimated = difference_is_positive(g, old, new);
    let mut margin = one;
    for (determinant, accepted) in system.determinants.iter().zip(accepted) {
        let left = g.sub_product(*determinant, quarter, *accepted);
        margin = g.min(margin, left);
    }
    let sound = is_positive(g, margin);
    let is_second = difference_is_positive(g, second, before_size);
    let contracts_or_closed = g.max(contracts, is_closed);
    let good = g.mul(sound, contracts_or_closed);
    let [halfway, there] = [halfway, estimated].map(|enough| g.mul(is_second, enough));
    let [halfway, there] = [halfway, there].map(|enough| g.max(enough, is_closed));
    let is_last = difference_is_positive(g, h, remaining);
    let enough = between(g, is_last, halfway, there);
    let reached = g.mul(good, enough);
    let back = g.sub(one, good);
    // After the end nothing changes: other lanes may go on.
    let [good, reached, back] = [good, reached, back].map(|choice| g.mul(active, choice));

    let way = g.mul(reached, h);
    let remaining = g.sub(remaining, way);
    let (longer, shorter) = (g.mul(reached, quickly), g.mul(half, back));
    let factor = g.add(one, longer);
    let factor = g.sub(factor, shorter);
    let next = g.mul(h, factor);
    let next = g.min(next, largest);
    let smallest = g.constant(SMALLEST);
    // Nothing is left over.
    let longer = g.add(next, smallest);
    let is_rest = difference_is_positive(g, longer, remaining);
    let next = between(g, is_rest, next, remaining);
    let more = difference_is_positive(g, next, smallest);
    let h = g.max(h, smallest);
    let ratio = g.div(next, h);
    let ratio = g.mul(reached, ratio);

    let (mut after, mut afterwards) = (Vec::new(), Vec::new());
    for (i, step) in system.step.iter().enumerate() {
        let (step, way) = (g.mul(good, *step), g.sub(p[i], before[i]));
        let way = g.mul(back, way);
        let moved = g.sub(p[i], step);
        let moved = g.sub(moved, way);
        let way = g.sub(moved, before[i]);
        let (further, way) = (g.mul(ratio, way), g.mul(reached, way));
        after.push(g.add(moved, further));
        afterwards.push(g.add(before[i], way));
    }
    after.extend(afterwards);
    let (anew, first) = (g.add(reached, back), g.constant(FIRST));
    let size = between(g, anew, size, first);
    after.extend([more, remaining, next, largest, tolerance, size]);
    for (determinant, accepted) in system.determinants.iter().zip(accepted) {
        let change = g.sub(*determinant, *accepted);
        after.push(g.add_product(*accepted, reached, change));
    }
    after
}

/// Returns the passive variables after a last step, where it has been found that the equations are
/// small, that no rotation is upside down, that the determinants have their signs, and that nothing
/// remains of the path.
fn finish(
    g: &mut Graph,
    loops: &ClosedLoops,
    system: &LoopSystem,
    p: &[Node],
    state: &[Node],
    has_errors: bool,
) -> Vec<Node> {
    let gap = system.gap(g, &loops.units.equations);
    let mut margin = g.sub(state[4], gap);
    let missing = g.neg(state[1]);
    for positive in system.upright.iter().chain(&system.determinants).chain([&missing]) {
        margin = g.min(margin, *positive);
    }
    // 1, or the root of a negative number.
    let side = g.call(Call::Side, margin);
    let closed = g.sqrt(side);
    let (zero, one) = (g.zero(), g.constant(1.0));
    let mut found = Vec::new();
    for (i, step) in system.step.iter().enumerate() {
        let step = g.div(*step, closed);
        let value = g.sub(p[i], step);
        let mut inside = None;
        for (limit, sign) in loops.limits[i].into_iter().zip([1.0, -1.0]).filter(|_| !has_errors) {
            if limit.is_finite() {
                // A limit itself may be reached.
                let slack = CLOSED[0] * limit.abs().max(loops.units.passive[i]);
                let (limit, sign) = (g.constant(limit - sign * slack), g.constant(sign));
                let margin = g.sub(value, limit);
                let margin = g.mul(sign, margin);
                inside = Some(inside.map_or(margin, |inside| g.min(inside, margin)));
            }
        }
        found.push(match inside {
            Some(margin) => {
                // 0, or 1 / 0.
                let side = g.call(Call::Side, margin);
                let side = g.max(side, zero);
                let reciprocal = g.div(one, side);
                let excess = g.sub(reciprocal, one);
                g.add(value, excess)
            }
            None => value,
        });
    }
    found
}

/// Returns the node that a symbol becomes at a share of the path.
fn moved(g: &mut Graph, loops: &ClosedLoops, symbol: Symbol, share: Node, has_errors: bool) -> Option<Node> {
    let value = g.symbol(symbol);
    let home = match (symbol, has_errors) {
        (Symbol::Variable(i), false) => loops.home[i],
        (Symbol::Parameter(i), false) => loops.parameters[i],
        (Symbol::Error(_), true) => 0.0,
        (Symbol::Local(i), true) if i >= loops.passive_home.len() => 0.0,
        _ => return None,
    };
    let home = g.constant(home);
    let way = g.sub(value, home);
    Some(g.add_product(home, share, way))
}

/// Returns 1 if a number is not negative, otherwise 0.
fn is_positive(g: &mut Graph, margin: Node) -> Node {
    let (one, half) = (g.constant(1.0), g.constant(0.5));
    let side = g.call(Call::Side, margin);
    let sum = g.add(one, side);
    g.mul(half, sum)
}

/// Returns 1 if the first number is not less than the second, otherwise 0.
fn difference_is_positive(g: &mut Graph, a: Node, b: Node) -> Node {
    let margin = g.sub(a, b);
    is_positive(g, margin)
}

/// Returns the first number for a choice of 0, the second for 1.
fn between(g: &mut Graph, choice: Node, first: Node, second: Node) -> Node {
    let one = g.constant(1.0);
    let other = g.sub(one, choice);
    let (a, b) = (g.mul(other, first), g.mul(choice, second));
    g.add(a, b)
}
