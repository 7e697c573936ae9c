//! Three slides and three revolute joints, in any order.

use abbe_core::{Pose, VariableKind};
use nalgebra::{Matrix3, Vector3};

use super::line::{Line, turn};
use super::wrist::Wrist;
use crate::reach::joint_chain::JointChain;

/// The revolute joints give the orientation, the slides the position.
#[derive(Clone, Debug)]
pub(super) struct Gantry {
    chain: JointChain,
    axes: [Line; 6],
    wrist: Wrist,
}

impl Gantry {
    /// Returns `None` if consecutive axes of the revolute joints are parallel.
    pub(super) fn new(chain: &JointChain, axes: &[Line; 6]) -> Option<Self> {
        let turning = chain.joints.iter().zip(axes).filter(|(joint, _)| joint.kind == VariableKind::Revolute);
        let turning: Vec<Vector3<f64>> = turning.map(|(_, line)| line.along).collect();
        let wrist = Wrist::new(turning.try_into().ok()?)?;
        Some(Self { chain: chain.clone(), axes: *axes, wrist })
    }

    /// Adds the solutions for a pose of the tool point, at most two. A revolute joint that is
    /// free to move stays at `free`.
    pub(super) fn solve(
        &self,
        target: &Pose,
        rotation: &Matrix3<f64>,
        free: [f64; 6],
        found: &mut Vec<[f64; 6]>,
    ) {
        let is_turning = |i: &usize| self.chain.joints[*i].kind == VariableKind::Revolute;
        let first = (0..6).find(is_turning).map_or(0.0, |i| free[i]);
        for angles in self.wrist.solve(rotation, first) {
            let mut angles = angles.into_iter();
            let mut q = [0.0; 6];
            let mut slides = Vec::with_capacity(3);
            let mut before = Matrix3::identity();
            for (i, (joint, line)) in self.chain.joints.iter().zip(&self.axes).enumerate() {
                match joint.kind {
                    VariableKind::Revolute => {
                        q[i] = angles.next().unwrap_or(0.0);
                        before *= turn(line.along, q[i]);
                    }
                    VariableKind::Prismatic => slides.push((i, before * line.along)),
                }
            }
            let [from, to] = [self.chain.pose(&q), *target].map(|pose| Vector3::from(pose.position()));
            let directions: Vec<Vector3<f64>> = slides.iter().map(|(_, direction)| *direction).collect();
            let Some(travels) = Matrix3::from_columns(&directions).lu().solve(&(to - from)) else { continue };
            slides.iter().zip(&travels).for_each(|((i, _), travel)| q[*i] = *travel);
            found.push(q);
        }
    }
}
