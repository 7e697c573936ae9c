//! What acts alike and cannot be told apart, from the joint twists alone, before anything is measured.
//!
//! `E_{i-1} A_i(q) = A_i(q) E'` with a constant `E'` if the twist ξ of `E_{i-1}` commutes with that of joint i: if it
//! is in the kernel of ad(S_i), `S_i = vee((dA_i/dq_i) A_i⁻¹)`. These are the turn about and the shift along the axis
//! of a revolute joint, all shifts and the turn about the direction of a prismatic one; all six where the joint stays
//! as it is. Then `E' = Ad(A_i⁻¹) ξ` is an error of frame i, and that one stands for both.

use super::columns::cross;
use super::{Model, Unknown};
use abbe_core::rotation_vector;
use abbe_core::{Component, Error, Pose, VariableKind};

/// Errors that act as others do.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// A combination of unknowns …
    pub these: Vec<(Unknown, f64)>,
    /// … and that which acts the same; nothing if it cannot be seen at all.
    pub act_as: Vec<(Unknown, f64)>,
    /// Why.
    pub reason: Reason,
}

/// Why errors act alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// They commute with the motion of this variable.
    Commutes(usize),
    /// This variable stays as it is.
    Still(usize),
    /// Nothing moves between this frame and the one before it.
    Fixed(usize),
    /// The tool, or the targets on it, are unknown themselves.
    Tool,
    /// Turns about a single target do not move it.
    Unseen,
}

/// A twist `(v, ω)`: shift and turn, in the axes of a frame.
type Twist = ([f64; 3], [f64; 3]);

/// The groups of a model whose variables in `moved` are moved, all others staying at `q`.
///
/// Of each model unknowns of all six errors of two neighbours are needed; of others nothing is said. `pose`: whole
/// poses are measured.
pub fn groups(model: &Model, q: &[f64], moved: &[usize], pose: bool) -> Result<Vec<Group>, Error> {
    let description = model.manipulator.description();
    let mut groups = Vec::new();
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
            // What turns or shifts before the first joint does so at every station.
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
    if pose && six(&Unknown::Tool) && six(&errors_of(last)) {
        for twist in every() {
            // E_n T = T E_T: an error of the tool, as the last frame has it.
            let act_as = named(&seen_from(&tool.inverse(), &twist), errors_of(last));
            groups.push(Group { these: named(&twist, Unknown::Tool), act_as, reason: Reason::Tool });
        }
    }
    if !pose && six(&errors_of(last)) {
        groups.extend(at_targets(model, &tool, &errors_of(last)));
    }
    Ok(groups)
}

/// What the errors of the last frame do to the targets.
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
            // A turn about the target: its shift at the origin of the frame is −ω × d.
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

/// Three shifts and three turns.
fn every() -> Vec<Twist> {
    let unit = |i: usize| core::array::from_fn(|j| f64::from(u8::from(i == j)));
    (0..3).map(|i| (unit(i), [0.0; 3])).chain((0..3).map(|i| ([0.0; 3], unit(i)))).collect()
}

/// A basis of the kernel of ad(S).
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

/// `Ad(A⁻¹) ξ`: `ω' = Rᵀ ω`, `v' = Rᵀ (v + ω × p)`.
fn seen_from(a: &Pose, (shift, turn): &Twist) -> Twist {
    let moved = cross(*turn, a.position());
    let shift = core::array::from_fn(|i| shift[i] + moved[i]);
    let mut back = a.inverse();
    back.0[3] = [0.0; 3];
    (back.turn(shift), back.turn(*turn))
}

/// The six errors that a small twist is, without those that are rounding.
fn named((shift, turn): &Twist, of: impl Fn(Component) -> Unknown) -> Vec<(Unknown, f64)> {
    let largest = |v: &[f64; 3]| v.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let all = Component::ALL.into_iter().map(|component| {
        let from = if component.is_rotation() { turn } else { shift };
        let value = from[component.axis()];
        (of(component), if value.abs() > 1e-9 * largest(from).max(1.0) { value } else { 0.0 })
    });
    all.filter(|(_, factor)| *factor != 0.0).collect()
}

/// `S`, of length 1, if it is the same wherever the joint stands.
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
