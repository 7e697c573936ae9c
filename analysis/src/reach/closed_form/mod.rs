//! Inverse kinematics in closed form of arms with skew axes and a spherical wrist.
//!
//! Arms with axes that intersect or are parallel, and gantries, have functions of their own
//! ([`Manipulator::inverse`](abbe_core::Manipulator::inverse)); the quartic equation of this one
//! has its place here. Chains with the wrist at the base are solved backwards. The structure is
//! found in the numbers of the chain, the product of exponentials of its axes at zero. `arm` and
//! `wrist` solve the halves, `angles` has the subproblems, `line` the axes.

mod angles;
mod arm;
mod line;
mod wrist;

use abbe_core::{Pose, VariableKind};
use nalgebra::Vector3;

use self::arm::Arm;
use self::line::{Line, TOLERANCE, axes, common_point, matrix, vector};
use self::wrist::Wrist;
use super::joint_chain::JointChain;

/// Closed form of a chain. Lengths are in arm lengths.
#[derive(Clone, Debug)]
pub(super) struct ClosedForm {
    arm: Arm,
    wrist: Wrist,
    /// Point where the axes of the wrist intersect.
    centre: Vector3<f64>,
    /// Pose of the tool point with all joints at zero, inverted.
    from_tool: Pose,
    /// The chain goes from the tool to the base.
    is_reversed: bool,
}

impl ClosedForm {
    /// Finds the structure of a chain. Returns `None` if it has another one.
    pub(super) fn new(chain: &JointChain) -> Option<Self> {
        Self::forwards(chain).or_else(|| {
            let form = Self::forwards(&chain.reversed())?;
            Some(Self { is_reversed: true, ..form })
        })
    }

    fn forwards(chain: &JointChain) -> Option<Self> {
        let (axes, tool) = axes(chain);
        let &[first, second, third, fourth, fifth, sixth]: &[Line; 6] = axes.as_slice().try_into().ok()?;
        let centre = common_point(&fourth, &fifth)?;
        let turns = chain.joints.iter().all(|joint| joint.kind == VariableKind::Revolute);
        if !turns || sixth.distance(centre) > TOLERANCE {
            return None;
        }
        let wrist = Wrist::new([fourth.along, fifth.along, sixth.along])?;
        let arm = Arm::new([first, second, third], centre)?;
        Some(Self { arm, wrist, centre, from_tool: tool.inverse(), is_reversed: false })
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
        let moved = vector(motion.apply(self.centre.into()));
        let mut found = Vec::with_capacity(8);
        for [q1, q2, q3] in self.arm.solve(moved, [start[0], start[1], start[2]]) {
            let rest = self.arm.rotation([q1, q2, q3]).transpose() * rotation;
            let ends = self.wrist.solve(&rest, start[3]).into_iter();
            found.extend(ends.map(|[q4, q5, q6]| [q1, q2, q3, q4, q5, q6]));
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
