//! Inverse kinematics in closed form, all branches, as nodes.
//!
//! | structure, of six lower pairs or of loops | file |
//! |---|---|
//! | an arm of three joints, then three revolute joints whose axes intersect | `arm`, `wrist` |
//! | three parallel axes between the first joint and the last two, whose axes intersect | `parallel` |
//! | three slides and three revolute joints, in any order | `gantry` |
//! | a platform on legs, each with a drive of its own | `platform` |
//!
//! A joint may stand on the motor of an earlier one and turn, or slide, back with it (`q3 - q2`):
//! the chain is solved for the sums, of which the joints are differences.
//!
//! Of the arm two consecutive axes intersect or are parallel; its third joint may be a slide. A
//! chain that has one of the first two from the tool to the base is solved backwards. `lines` finds
//! the axes, the product of exponentials at zero, from the expressions of the spec, and verifies
//! the structure for several values of its parameters. `angles` solves the subproblems by square
//! roots only, so that each joint takes one arc tangent at the end.

mod angles;
mod arm;
mod gantry;
mod lines;
mod motion;
mod parallel;
mod partial;
mod platform;
mod wrist;

use std::f64::consts::PI;

use abbe_core::VariableKind;
use abbe_spec::{Function, Spec, Symbol, Variable};

use self::angles::{Angle, Root, Rounding, angle_between, are_square, linear, tilt_angles};
use self::arm::Arm;
use self::lines::{Line, Lines, Probes, at_zero, line, reject};
use self::motion::Motion;
use self::partial::{Joint, Partial};
use self::wrist::Wrist;
use crate::graph::{Frame, Graph, Node, Op, Vector};

/// Inverse kinematics of a spec in closed form. The variables are the joints near which solutions
/// are wanted.
#[derive(Clone, Debug)]
pub(crate) struct Inverse {
    /// Joints of each solution, within their limits.
    pub(crate) solutions: Vec<Vec<Node>>,
    /// 1 if the solution exists within the limits, otherwise 0.
    pub(crate) found: Vec<Node>,
}

impl Inverse {
    /// Adds the nodes for a checked spec. Returns `None` if the machine has none of the structures
    /// with a closed form.
    pub(crate) fn new(graph: &mut Graph, spec: &Spec) -> Option<Self> {
        // Values of nodes in a small graph are found soon.
        let mut apart = Graph::with_tables(&spec.tables);
        apart.is_single = graph.is_single;
        let Self { solutions, found } = Self::apart(&mut apart, spec)?;
        let mut nodes = graph.adopt(&apart, &[solutions.concat(), found].concat());
        let joints = spec.variables.len();
        let found = nodes.split_off(joints * solutions.len());
        Some(Self { solutions: nodes.chunks_exact(joints).map(<[_]>::to_vec).collect(), found })
    }

    fn apart(g: &mut Graph, spec: &Spec) -> Option<Self> {
        let target: Vec<Node> = (0..12).map(|i| g.symbol(Symbol::Target(i))).collect();
        let target = Frame::from_entries(&target);
        let start = (0..spec.variables.len()).map(|i| {
            let q = g.symbol(Symbol::Variable(i));
            Angle { sine: g.sin(q), cosine: g.cos(q) }
        });
        let free: Vec<Angle> = start.collect();
        let found = match spec.is_serial() {
            true => chain(g, spec, target, free.as_slice().try_into().ok()?),
            false => platform::solve(g, spec, target, &free),
        }?;
        let (solutions, found) = found.into_iter().map(|partial| finished(g, spec, &partial, &free)).unzip();
        Some(Self { solutions, found })
    }
}

/// Returns the solutions of a chain of six joints.
fn chain(g: &mut Graph, spec: &Spec, target: Frame, mut free: [Angle; 6]) -> Option<Vec<Partial>> {
    let lines = Lines::new(g, spec)?;
    let joints = free;
    for (sum, others) in free.iter_mut().zip(&lines.couplings) {
        for (other, share) in others {
            let turned = joints[*other].signed(g, *share);
            *sum = sum.plus(g, turned);
        }
    }
    let motion = Motion { target, tool: lines.tool, is_reversed: false };
    let found = forwards(g, &lines, &motion, free).or_else(|| {
        let back = Lines { lines: lines.lines.iter().rev().copied().collect(), ..lines.clone() };
        let motion = Motion { is_reversed: true, ..motion };
        let mut free = free.map(|angle| angle.signed(g, -1.0));
        free.reverse();
        // Of the gantry all orders are forwards.
        let found = arms(g, &back, &motion, free)?;
        Some(found.into_iter().map(|partial| backwards(g, partial)).collect())
    })?;
    Some(found.into_iter().map(|partial| uncoupled(g, partial, &lines.couplings)).collect())
}

/// Takes from the sums of a solution the joints that their frames share with earlier ones.
fn uncoupled(g: &mut Graph, mut partial: Partial, couplings: &[Vec<(usize, f64)>]) -> Partial {
    for (joint, others) in couplings.iter().enumerate() {
        for (other, share) in others {
            let [sum, other] = [joint, *other].map(|i| partial.joints[i]);
            partial.joints[joint] = match (sum, other) {
                (Joint::Turn(sum), Joint::Turn(other)) => {
                    let back = other.angle.signed(g, -share);
                    Joint::Turn(Root { angle: sum.angle.plus(g, back), ..sum })
                }
                (Joint::Slide(sum), Joint::Slide(other)) => {
                    let shared = if *share > 0.0 { other } else { g.neg(other) };
                    Joint::Slide(g.sub(sum, shared))
                }
                (other, _) => other,
            };
        }
    }
    partial
}

fn forwards(g: &mut Graph, lines: &Lines, motion: &Motion, free: [Angle; 6]) -> Option<Vec<Partial>> {
    let slides = lines.lines.iter().filter(|line| line.kind == VariableKind::Prismatic).count();
    if slides == 3 { gantry::solve(g, lines, motion, free) } else { arms(g, lines, motion, free) }
}

/// Returns the solutions of chains that end with a wrist or begin with parallel axes.
fn arms(g: &mut Graph, lines: &Lines, motion: &Motion, free: [Angle; 6]) -> Option<Vec<Partial>> {
    let probes = &lines.probes;
    let all: &[Line; 6] = lines.lines.as_slice().try_into().ok()?;
    let [first, second, third, fourth, fifth, sixth] = *all;
    if !all[3..].iter().all(|line| line.kind == VariableKind::Revolute) {
        return None;
    }
    if let Some(centre) = probes.common_point(g, &fourth, &fifth) {
        let away = probes.offset(g, &sixth, centre);
        if probes.are_zero(g, &away, probes.size) {
            let wrist = Wrist::new(g, probes, [fourth.along, fifth.along, sixth.along])?;
            let to = motion.point(g, probes, centre);
            let arm = Arm {
                lines: [first, second, third],
                point: centre,
                probes,
                free: [free[0], free[1], free[2]],
            };
            let sets = arm.solve(g, to)?;
            let mut found = Vec::new();
            for set in sets {
                let back = |g: &mut Graph, v: Vector| {
                    let turned = motion.turn(g, v);
                    set.joints.iter().zip(&arm.lines).fold(turned, |v, (joint, line)| match joint {
                        Joint::Turn(root) => root.angle.signed(g, -1.0).turn(g, line.along, v),
                        Joint::Slide(_) => v,
                    })
                };
                let ends = wrist.solve(g, back, [free[3], free[5]]);
                found.extend(ends.map(|roots| set.clone().with(roots)));
            }
            return Some(found);
        }
    }
    parallel::solve(g, lines, motion, free)
}

/// Returns the solution of the chain from the tool to the base.
fn backwards(g: &mut Graph, mut partial: Partial) -> Partial {
    partial.joints.reverse();
    for joint in &mut partial.joints {
        *joint = match *joint {
            Joint::Turn(Root { angle, exists }) => Joint::Turn(Root { angle: angle.signed(g, -1.0), exists }),
            Joint::Slide(travel) => Joint::Slide(g.neg(travel)),
        };
    }
    partial
}

/// Returns an angle between −π and π. Of two angles half a turn apart, one follows from the other.
fn value(g: &mut Graph, Angle { sine, cosine }: Angle) -> Node {
    match (g.op(sine), g.op(cosine)) {
        (Op::Neg(sine), Op::Neg(cosine)) => {
            let (other, half) = (g.atan2(sine, cosine), g.constant(PI));
            let side = g.call(Function::Side, other);
            g.sub_product(other, half, side)
        }
        _ => g.atan2(sine, cosine),
    }
}

/// Returns the joints of a solution in the turns nearest to the start that the limits permit, and
/// whether it exists.
fn finished(g: &mut Graph, spec: &Spec, partial: &Partial, free: &[Angle]) -> (Vec<Node>, Node) {
    let mut margins = partial.exists.clone();
    let mut within = |g: &mut Graph, value: Node, variable: &Variable| {
        let [lower, upper] = variable.limits;
        let slack = if (upper - lower).is_finite() { Rounding::Limit.size(g) * (upper - lower) } else { 0.0 };
        let mut value = value;
        let ends = [(lower, lower - slack), (upper, upper + slack)]
            .map(|(limit, end)| limit.is_finite().then(|| (g.constant(limit), g.constant(end))));
        let [below, above] = ends;
        let beyond = [below.map(|(_, end)| g.sub(end, value)), above.map(|(_, end)| g.sub(value, end))];
        if variable.kind == VariableKind::Revolute {
            // By one turn upwards if it is below, downwards if it is above.
            let [below, above] = beyond.map(|beyond| {
                let least = g.constant(-1.0);
                beyond.map_or(least, |beyond| g.call(Function::Side, beyond))
            });
            let (turns, half) = (g.sub(below, above), g.constant(PI));
            value = g.add_product(value, half, turns);
        }
        if let Some((limit, end)) = below {
            margins.push(g.sub(value, end));
            value = g.max(value, limit);
        }
        if let Some((limit, end)) = above {
            margins.push(g.sub(end, value));
            value = g.min(value, limit);
        }
        value
    };
    let joints = partial.joints.iter().enumerate().map(|(i, joint)| {
        let value = match *joint {
            Joint::Turn(Root { angle, .. }) => {
                let start = g.symbol(Symbol::Variable(i));
                let back = free[i].signed(g, -1.0);
                let way = angle.plus(g, back);
                let way = value(g, way);
                g.add(start, way)
            }
            Joint::Slide(travel) => travel,
        };
        within(g, value, &spec.variables[i])
    });
    let solution = joints.collect();
    margins.extend(partial.joints.iter().filter_map(|joint| match joint {
        Joint::Turn(root) => Some(root.exists),
        Joint::Slide(_) => None,
    }));
    margins.sort_unstable();
    margins.dedup();
    margins.retain(|margin| g.value(*margin).is_none_or(|value| value < 0.0));
    let one = g.constant(1.0);
    let least = margins.into_iter().reduce(|a, b| g.min(a, b)).unwrap_or(one);
    let (side, half) = (g.call(Function::Side, least), g.constant(0.5));
    (solution, g.add_product(half, half, side))
}
