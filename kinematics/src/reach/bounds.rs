//! Enclosures of the reachable positions of a chain of lower pairs, which prove without a search
//! that a target is out of reach.
//!
//! From the tip to the base, an [`Extent`] about the axis of each joint encloses all positions of a
//! point, without limits and within them. Every step encloses at least the reachable positions, so
//! a point outside is unreachable.
//!
//! The tool pose determines further points: those of the last axis, which its joint does not move.
//! The same applies to the chain from the tool to the base, `A_T⁻¹`: the pose determines the
//! positions of the base and of the first axis relative to the tool.

use super::Target;
use super::extent::{ANY, Extent, Interval, inside, sum, times};
use super::joint_chain::{Joint, JointChain, scaled, shift};
use super::target_search::{Problem, Reachability};
use abbe_core::{Pose, VariableKind};

/// Squared sine of the angle below which two axes count as parallel.
const PARALLEL: f64 = 1e-4;

/// Enclosures for the targets of a chain.
pub(super) struct Bounds {
    arm: f64,
    /// Points of the tool's frame, the tool point first, with their enclosures in `F_0`.
    of_tool: Vec<Bound>,
    /// Points of `F_0`, with their enclosures relative to the tool.
    of_base: Vec<Bound>,
}

/// Point at the end of a chain with its enclosures.
struct Bound {
    point: [f64; 3],
    /// Enclosure without limits, and within them.
    regions: [Region; 2],
}

/// Enclosure of a point at the end of a chain.
struct Region {
    /// Transform from the base of the chain to the first axis; the extent is about that axis.
    to_axis: Pose,
    extent: Extent,
    /// Intervals of x, y and z of the base: sharper than the extent where prismatic joints come
    /// first.
    sides: [Interval; 3],
}

impl Bounds {
    pub(super) fn new(problem: &Problem<'_>, chain: &JointChain) -> Self {
        let limits = |j: usize| problem.variable(j).limits.map(|limit| limit / problem.unit(j));
        let limits: Vec<Interval> = (0..chain.joints.len()).map(limits).collect();
        let back: Vec<Interval> = limits.iter().rev().map(|[lower, upper]| [-upper, -lower]).collect();
        let (of_tool, of_base) = (bounds(chain, &limits), bounds(&chain.reversed(), &back));
        Self { arm: problem.arm, of_tool, of_base }
    }

    /// Classifies a target.
    pub(super) fn reachability(&self, target: &Target) -> Reachability {
        match target {
            Target::Point(point) | Target::Axis { point, .. } => {
                self.of_tool[0].reachability(point.map(|x| x / self.arm))
            }
            Target::Pose(pose) => {
                let pose = scaled(pose, self.arm);
                let back = pose.inverse();
                let of_tool = self.of_tool.iter().map(|bound| bound.reachability(pose.apply(bound.point)));
                let of_base = self.of_base.iter().map(|bound| bound.reachability(back.apply(bound.point)));
                of_tool.chain(of_base).min().unwrap_or(Reachability::Open)
            }
        }
    }
}

/// Returns the enclosures of the end of a chain and, if its last joint is revolute, of the points
/// of its axis nearest to the end and to the axis before.
fn bounds(chain: &JointChain, limits: &[Interval]) -> Vec<Bound> {
    let of = |point: [f64; 3], chain: &JointChain| Bound {
        point,
        regions: [Region::new(chain, &|_| ANY), Region::new(chain, &|j| limits[j])],
    };
    let mut bounds = vec![of([0.0; 3], chain)];
    if let Some((last, others)) = chain.joints.split_last()
        && last.kind == VariableKind::Revolute
    {
        let [_, _, [x, y, _], [at_x, at_y, _]] = last.before.0;
        let to_end = chain.tool.position()[2];
        let slope = x * x + y * y;
        let to_axis_before = (slope > PARALLEL).then(|| -(x * at_x + y * at_y) / slope);
        bounds.extend([Some(to_end), to_axis_before].into_iter().flatten().map(|height| {
            let tool = last.before.then(&shift([0.0, 0.0, height]));
            let shorter = JointChain { joints: others.to_vec(), tool };
            of(chain.tool.inverse().apply([0.0, 0.0, height]), &shorter)
        }));
    }
    bounds
}

impl Bound {
    /// Classifies a target with the point at `here`, in arm lengths.
    fn reachability(&self, here: [f64; 3]) -> Reachability {
        let [anyhow, within] = &self.regions;
        match (within.holds(here), anyhow.holds(here)) {
            (true, _) => Reachability::Open,
            (false, true) => Reachability::BeyondLimits,
            (false, false) => Reachability::Never,
        }
    }
}

impl Region {
    /// Encloses the end of a chain with joints within these limits.
    fn new(chain: &JointChain, limits: &dyn Fn(usize) -> Interval) -> Self {
        let chain = chain.centred();
        let slides = |joint: &&Joint| joint.kind == VariableKind::Prismatic;
        let first_turn = chain.joints.iter().take_while(slides).count();
        let mut extent = Extent::from_point(chain.tool.position());
        // Extent in the frame before the first revolute joint.
        let mut turned = (first_turn == chain.joints.len()).then_some(extent);
        for (j, joint) in chain.joints.iter().enumerate().rev() {
            extent = match joint.kind {
                VariableKind::Revolute => extent.turned(limits(j)),
                VariableKind::Prismatic => extent.slid(limits(j)),
            };
            if j == first_turn {
                turned = Some(extent);
            }
            if j > 0 {
                extent = extent.in_preceding_frame(&joint.before);
            }
        }
        let mut frame = Pose::IDENTITY;
        let mut travel = [[0.0; 2]; 3];
        for (j, joint) in chain.joints[..first_turn].iter().enumerate() {
            frame = frame.then(&joint.before);
            for (side, share) in travel.iter_mut().zip(frame.0[2]) {
                *side = sum(*side, times(limits(j), share));
            }
        }
        let (point, sides) = match chain.joints.get(first_turn) {
            Some(joint) => {
                frame = frame.then(&joint.before);
                let turned = turned.unwrap_or(extent);
                let [x, y, z, at] = frame.0;
                let side = |i: usize| sum(turned.along([x[i], y[i], z[i]]), [at[i]; 2]);
                (frame, [side(0), side(1), side(2)])
            }
            // Prismatic joints only: the point itself.
            None => (frame, frame.then(&chain.tool).position().map(|x| [x; 2])),
        };
        let to_axis = chain.joints.first().map_or(point, |joint| joint.before).inverse();
        let sides = core::array::from_fn(|i| sum(sides[i], travel[i]));
        Self { to_axis, extent, sides }
    }

    /// Returns whether a point, in arm lengths, may be reachable.
    fn holds(&self, point: [f64; 3]) -> bool {
        self.extent.holds(self.to_axis.apply(point))
            && point.into_iter().zip(self.sides).all(|(value, side)| inside(value, side))
    }
}

#[cfg(test)]
mod tests;
