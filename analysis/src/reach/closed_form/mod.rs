//! Inverse kinematics in closed form, all branches, of chains of six lower pairs.
//!
//! | structure | file |
//! |---|---|
//! | three revolute joints, then three whose axes intersect | `arm`, `wrist` |
//! | the same with a slide as third joint, behind axes that intersect or are parallel | `polar`, `wrist` |
//! | three parallel axes between the first joint and the last two, whose axes intersect | `parallel` |
//! | three slides and three revolute joints, in any order | `gantry` |
//!
//! A chain that has one of the first three from the tool to the base is solved backwards. The
//! structure is found in the numbers of the chain, the product of exponentials of its axes at zero.
//! `angles` has the subproblems, `line` the axes.

mod angles;
mod arm;
mod gantry;
mod line;
mod parallel;
mod polar;
mod wrist;

use abbe_core::{Pose, VariableKind};
use nalgebra::Vector3;

use self::arm::Arm;
use self::gantry::Gantry;
use self::line::{Line, TOLERANCE, axes, common_point, matrix, vector};
use self::parallel::Parallel;
use self::polar::Polar;
use self::wrist::Wrist;
use super::joint_chain::JointChain;

/// Closed form of a chain. Lengths are in arm lengths.
#[derive(Clone, Debug)]
pub(super) struct ClosedForm {
    structure: Structure,
    /// Pose of the tool point with all joints at zero, inverted.
    from_tool: Pose,
    /// The chain goes from the tool to the base.
    is_reversed: bool,
}

#[derive(Clone, Debug)]
enum Structure {
    Wrist { arm: Positioner, wrist: Wrist, centre: Vector3<f64> },
    Parallel(Parallel),
    Gantry(Gantry),
}

/// First three joints, which bring the center of the wrist to its place.
#[derive(Clone, Debug)]
enum Positioner {
    Arm(Arm),
    Polar(Polar),
}

impl ClosedForm {
    /// Finds the structure of a chain. Returns `None` if it has none of those with a closed form.
    pub(super) fn new(chain: &JointChain) -> Option<Self> {
        Self::forwards(chain).or_else(|| {
            let form = Self::forwards(&chain.reversed())?;
            Some(Self { is_reversed: true, ..form })
        })
    }

    fn forwards(chain: &JointChain) -> Option<Self> {
        let (axes, tool) = axes(chain);
        let axes: &[Line; 6] = axes.as_slice().try_into().ok()?;
        let slides: Vec<usize> =
            (0..6).filter(|i| chain.joints[*i].kind == VariableKind::Prismatic).collect();
        let structure = match slides[..] {
            [] => {
                let arm = |axes, centre| Arm::new(axes, centre).map(Positioner::Arm);
                wrist(axes, arm).or_else(|| Some(Structure::Parallel(Parallel::new(axes)?)))?
            }
            [2] => wrist(axes, |axes, centre| Polar::new(axes, centre).map(Positioner::Polar))?,
            [_, _, _] => Structure::Gantry(Gantry::new(chain, axes)?),
            _ => return None,
        };
        Some(Self { structure, from_tool: tool.inverse(), is_reversed: false })
    }

    /// Returns all solutions for a pose of the tool point, without limits. Joints that are free to
    /// move there stay as in `start`.
    pub(super) fn solve(&self, target: &Pose, start: [f64; 6]) -> Vec<[f64; 6]> {
        let (target, start) = match self.is_reversed {
            true => (&target.inverse(), backwards(start)),
            false => (target, start),
        };
        // exp(S_1 q_1) … exp(S_6 q_6)
        let motion = target.then(&self.from_tool);
        let rotation = matrix(&motion);
        let mut found = Vec::with_capacity(8);
        match &self.structure {
            Structure::Wrist { arm, wrist, centre } => {
                let moved = vector(motion.apply((*centre).into()));
                let first = [start[0], start[1], start[2]];
                let sets = match arm {
                    Positioner::Arm(arm) => arm.solve(moved, first),
                    Positioner::Polar(polar) => polar.solve(moved, first),
                };
                for [q1, q2, q3] in sets {
                    let turned = match arm {
                        Positioner::Arm(arm) => arm.rotation([q1, q2, q3]),
                        Positioner::Polar(polar) => polar.rotation([q1, q2, q3]),
                    };
                    let rest = turned.transpose() * rotation;
                    let ends = wrist.solve(&rest, start[3]).into_iter();
                    found.extend(ends.map(|[q4, q5, q6]| [q1, q2, q3, q4, q5, q6]));
                }
            }
            Structure::Parallel(parallel) => parallel.solve(&motion, &rotation, start, &mut found),
            Structure::Gantry(gantry) => gantry.solve(target, &rotation, start, &mut found),
        }
        if self.is_reversed {
            found.iter_mut().for_each(|q| *q = backwards(*q));
        }
        found
    }
}

/// Returns the joints of the chain from the tool to the base.
fn backwards([a, b, c, d, e, f]: [f64; 6]) -> [f64; 6] {
    [-f, -e, -d, -c, -b, -a]
}

/// Returns the structure of an arm with a wrist whose three axes intersect. `arm` makes it from its
/// axes and the center of the wrist.
fn wrist(
    axes: &[Line; 6],
    arm: impl FnOnce([Line; 3], Vector3<f64>) -> Option<Positioner>,
) -> Option<Structure> {
    let [first, second, third, fourth, fifth, sixth] = *axes;
    let centre = common_point(&fourth, &fifth)?;
    if sixth.distance(centre) > TOLERANCE {
        return None;
    }
    let wrist = Wrist::new([fourth.along, fifth.along, sixth.along])?;
    Some(Structure::Wrist { arm: arm([first, second, third], centre)?, wrist, centre })
}
