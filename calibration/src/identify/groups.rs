//! Indistinguishable errors, derived from the joint twists before any measurement.
//!
//! `E_{i-1} A_i(q) = A_i(q) E'` with a constant `E'` if the twist ξ of `E_{i-1}` commutes with the
//! twist of joint i, that is, lies in the kernel of ad(S_i), `S_i = vee((dA_i/dq_i) A_i⁻¹)`. The
//! kernel has the rotation about and the translation along the axis of a revolute joint; all
//! translations and the rotation about the direction of a prismatic joint; all six components for a
//! joint at rest. Then `E' = Ad(A_i⁻¹) ξ` is an equivalent error of frame i.

use super::{Model, Unknown};
use abbe_analysis::sampling::vectors::cross;
use abbe_core::{Component, Error, Pose, VariableKind, rotation_vector};

/// A combination of errors and its equivalent.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Combination of unknowns.
    pub these: Vec<(Unknown, f64)>,
    /// Equivalent combination; empty if the measurements cannot see it at all.
    pub act_as: Vec<(Unknown, f64)>,
    /// Cause of the equivalence.
    pub reason: Reason,
}

/// Cause of an equivalence of errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The errors commute with the motion of this variable.
    Commutes(usize),
    /// This variable does not move.
    Still(usize),
    /// No variable acts between this frame and the previous one.
    Fixed(usize),
    /// The mounting on the tool is unknown.
    Tool,
    /// Rotations about a single target do not move it.
    Unseen,
}

/// A twist `(v, ω)`: translation and rotation, in the axes of a frame.
type Twist = ([f64; 3], [f64; 3]);

/// Finds the groups of a model whose variables in `moved` vary and whose others stay at `q`.
///
/// Each group needs all six errors of two neighbouring frames among the unknowns; other groups are
/// omitted, and all of a machine that is not a chain. `pose`: whole poses are measured.
pub fn groups(model: &Model, q: &[f64], moved: &[usize], pose: bool) -> Result<Vec<Group>, Error> {
    let description = model.manipulator.description();
    let mut groups = Vec::new();
    if !description.is_chain() {
        return Ok(groups);
    }
    let mut transforms = vec![Pose::IDENTITY; description.frames.len() + 1];
    model.manipulator.transforms(q, &model.s, &mut transforms)?;
    let has = |unknown| model.unknowns.contains(&unknown);
    let six = |of: &dyn Fn(Component) -> Unknown| Component::ALL.iter().all(|component| has(of(*component)));
    let errors_of = |frame: usize| move |component| Unknown::Error(frame, component);
    let stations = 0..model.stations.len();
    let base = |station: usize| move |component| Unknown::Base(station, component);
    for (i, frame) in description.frames.iter().enumerate() {
        let before = match i.checked_sub(1) {
            Some(before) => six(&errors_of(before)),
            None => stations.clone().all(|station| six(&base(station))),
        };
        if !before || !six(&errors_of(i)) {
            continue;
        }
        let (kernel, reason) = match frame.variable {
            None => (every(), Reason::Fixed(i)),
            Some(variable) if !moved.contains(&variable) => (every(), Reason::Still(variable)),
            Some(variable) => {
                let kind = description.variables[variable].kind;
                let Some(twist) = joint_twist(model, q, variable, i, kind)? else { continue };
                (commuting(twist, kind), Reason::Commutes(variable))
            }
        };
        for twist in kernel {
            // An error before the first joint is an error of the base at each station.
            let these = match i.checked_sub(1) {
                Some(before) => named(&twist, errors_of(before)),
                None => stations.clone().flat_map(|station| named(&twist, base(station))).collect(),
            };
            let act_as = named(&seen_from(&transforms[i], &twist), errors_of(i));
            groups.push(Group { these, act_as, reason });
        }
    }
    let tool = transforms[description.frames.len()];
    let Some(last) = description.frames.len().checked_sub(1) else { return Ok(groups) };
    let placements = 0..model.mountings.len();
    let of_tool = |placement: usize| move |component| Unknown::Tool(placement, component);
    if pose && placements.clone().all(|i| six(&of_tool(i))) && six(&errors_of(last)) {
        for twist in every() {
            // E_n T = T E_T: an error of the last frame as an error of the tool.
            let group = match placements.len() {
                1 => Group {
                    these: named(&twist, of_tool(0)),
                    act_as: named(&seen_from(&tool.inverse(), &twist), errors_of(last)),
                    reason: Reason::Tool,
                },
                _ => Group {
                    these: named(&twist, errors_of(last)),
                    act_as: placements.clone().flat_map(|i| at_placement(model, &tool, &twist, i)).collect(),
                    reason: Reason::Tool,
                },
            };
            groups.push(group);
        }
    }
    if !pose && six(&errors_of(last)) {
        groups.extend(at_targets(model, &tool, &errors_of(last)));
    }
    Ok(groups)
}

/// Returns an error of the last frame as an error of the tool in a placement: `E_n T M = T M E_T`.
fn at_placement(model: &Model, tool: &Pose, twist: &Twist, placement: usize) -> Vec<(Unknown, f64)> {
    let mounted = tool.then(&model.mountings[placement]);
    named(&seen_from(&mounted, twist), |component| Unknown::Tool(placement, component))
}

/// Returns the displacements of the targets by errors of the last frame.
fn at_targets(model: &Model, tool: &Pose, last: &dyn Fn(Component) -> Unknown) -> Vec<Group> {
    let targets = 0..model.targets.len();
    let unknown = |j: usize| (0..3).all(|axis| model.unknowns.contains(&Unknown::Target(j, axis)));
    if targets.clone().all(unknown) && !targets.is_empty() {
        return every()
            .into_iter()
            .map(|twist| {
                let (shift, turn) = seen_from(tool, &twist);
                let moves = targets.clone().flat_map(|j| {
                    let by = cross(turn, model.targets[j]);
                    [0, 1, 2].map(|axis| (Unknown::Target(j, axis), shift[axis] + by[axis]))
                });
                let act_as: Vec<_> = moves.filter(|(_, factor)| *factor != 0.0).collect();
                Group { these: named(&twist, last), act_as, reason: Reason::Tool }
            })
            .collect();
    }
    if let [target] = model.targets[..] {
        let at = tool.apply(target);
        let turns = every().into_iter().skip(3).map(|(_, turn)| {
            // A rotation about the target translates the origin of the frame by −ω × d.
            let shift = cross(turn, at);
            Group {
                these: named(&([0.0; 3], turn), last),
                act_as: named(&(shift, [0.0; 3]), last),
                reason: Reason::Unseen,
            }
        });
        return turns.collect();
    }
    Vec::new()
}

/// Returns three unit translations and three unit rotations.
fn every() -> Vec<Twist> {
    let unit = |i: usize| core::array::from_fn(|j| f64::from(u8::from(i == j)));
    (0..3).map(|i| (unit(i), [0.0; 3])).chain((0..3).map(|i| ([0.0; 3], unit(i)))).collect()
}

/// Returns a basis of the kernel of ad(S).
fn commuting((shift, turn): Twist, kind: VariableKind) -> Vec<Twist> {
    match kind {
        VariableKind::Revolute => vec![(turn, [0.0; 3]), (shift, turn)],
        VariableKind::Prismatic => {
            let mut all = every();
            all.truncate(3);
            all.push(([0.0; 3], shift));
            all
        }
    }
}

/// Returns `Ad(A⁻¹) ξ`: `ω' = Rᵀ ω`, `v' = Rᵀ (v + ω × p)`.
fn seen_from(a: &Pose, (shift, turn): &Twist) -> Twist {
    let moved = cross(*turn, a.position());
    let shift = core::array::from_fn(|i| shift[i] + moved[i]);
    let mut back = a.inverse();
    back.0[3] = [0.0; 3];
    (back.turn(shift), back.turn(*turn))
}

/// Returns the nonzero components of a small twist.
fn named((shift, turn): &Twist, of: impl Fn(Component) -> Unknown) -> Vec<(Unknown, f64)> {
    let largest = |v: &[f64; 3]| v.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let all = Component::ALL.into_iter().map(|component| {
        let from = if component.is_rotation() { turn } else { shift };
        let value = from[component.axis()];
        (of(component), if value.abs() > 1e-9 * largest(from).max(1.0) { value } else { 0.0 })
    });
    all.filter(|(_, factor)| *factor != 0.0).collect()
}

/// Returns `S` of unit length; none if it depends on the joint's position.
fn joint_twist(
    model: &Model,
    q: &[f64],
    variable: usize,
    frame: usize,
    kind: VariableKind,
) -> Result<Option<Twist>, Error> {
    let mut transforms = vec![Pose::IDENTITY; model.manipulator.description().frames.len() + 1];
    let mut at = |value: f64| {
        let mut q = q.to_vec();
        q[variable] = value;
        model.manipulator.transforms(&q, &model.s, &mut transforms).map(|()| transforms[frame])
    };
    let twist = |from: &Pose, to: &Pose| {
        let motion = to.then(&from.inverse());
        match kind {
            VariableKind::Prismatic => unit(motion.position()).map(|along| (along, [0.0; 3])),
            VariableKind::Revolute => {
                let mut turn = motion;
                turn.0[3] = [0.0; 3];
                let axis = unit(rotation_vector(&turn))?;
                // t = (1 − R) c: with c ⊥ axis, c = t/2 + axis × t / (2 tan(θ/2)).
                let (t, angle) = (motion.position(), rotation_vector(&turn));
                let half = (angle.iter().map(|a| a * a).sum::<f64>().sqrt() / 2.0).tan();
                let beside = cross(axis, t);
                let centre: [f64; 3] = core::array::from_fn(|i| t[i] / 2.0 + beside[i] / (2.0 * half));
                Some((cross(centre, axis), axis))
            }
        }
    };
    let here = at(q[variable])?;
    let (one, two) = (at(q[variable] + 0.7)?, at(q[variable] + 1.6)?);
    let (Some(first), Some(second)) = (twist(&here, &one), twist(&one, &two)) else { return Ok(None) };
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() <= 1e-8 * (1.0 + a[i].abs()));
    Ok((near(first.0, second.0) && near(first.1, second.1)).then_some(first))
}

fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-12).then(|| v.map(|x| x / length))
}
