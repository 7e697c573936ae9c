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
            Target::Point(point) => self.of_tool[0].reachability(point.map(|x| x / self.arm)),
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
mod tests {
    use core::f64::consts::PI;

    use super::*;
    use crate::reach::joint_chain::Joint;
    use crate::sampling::{halton, stream};
    use rand::RngExt;

    fn turn(axis: usize, angle: f64) -> Pose {
        let mut columns = Pose::IDENTITY.0;
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let (sine, cosine) = angle.sin_cos();
        (columns[i][i], columns[i][j], columns[j][i], columns[j][j]) = (cosine, sine, -sine, cosine);
        Pose(columns)
    }

    /// Checks chains of all mixes of revolute and prismatic joints, with axes in general position,
    /// parallel, perpendicular and intersecting, within narrow and wide limits, and beyond them:
    /// each point is in its enclosure, and so is the base relative to the tool.
    #[test]
    fn what_is_reached_is_never_called_out_of_reach() {
        for seed in 0..1000 {
            let mut random = stream(seed, 0);
            let mut number = |from: f64, to: f64| from + (to - from) * random.random::<f64>();
            let count = 1 + number(0.0, 7.0) as usize;
            let mut motion = |special: f64| {
                let angles: [f64; 3] = core::array::from_fn(|_| match number(0.0, 1.0) < special {
                    true => number(-2.0, 3.0).floor() * PI / 2.0,
                    false => number(-PI, PI),
                });
                let at =
                    core::array::from_fn(
                        |_| if number(0.0, 1.0) < special { 0.0 } else { number(-1.0, 1.0) },
                    );
                shift(at).then(&turn(0, angles[0])).then(&turn(1, angles[1])).then(&turn(2, angles[2]))
            };
            let special = [0.0, 0.5, 0.9][seed as usize % 3];
            let joints: Vec<Pose> = (0..count).map(|_| motion(special)).collect();
            let tool = motion(special);
            let joints = joints.into_iter().map(|before| {
                let kind =
                    if number(0.0, 1.0) < 0.3 { VariableKind::Prismatic } else { VariableKind::Revolute };
                Joint { before, kind }
            });
            let chain = JointChain { joints: joints.collect(), tool };
            let wide = [1.0, 3.0][seed as usize % 2];
            let limits: Vec<Interval> = (0..count).map(|_| [number(-wide, 0.0), number(0.0, wide)]).collect();
            let back: Vec<Interval> = limits.iter().rev().map(|[lower, upper]| [-upper, -lower]).collect();
            let (of_tool, of_base) = (bounds(&chain, &limits), bounds(&chain.reversed(), &back));
            for index in 0..300 {
                // Includes both ends.
                let q: Vec<f64> = (0..count)
                    .map(|j| {
                        let share = (1.2 * halton(1 + index, j) - 0.1).clamp(0.0, 1.0);
                        limits[j][0] + share * (limits[j][1] - limits[j][0])
                    })
                    .collect();
                let further: Vec<f64> = q.iter().map(|value| 10.0 * value).collect();
                for (q, least) in [(q, Reachability::Open), (further, Reachability::BeyondLimits)] {
                    let pose = chain.pose(&q);
                    for (bounds, pose) in [(&of_tool, pose), (&of_base, pose.inverse())] {
                        for bound in bounds {
                            let reachability = bound.reachability(pose.apply(bound.point));
                            assert!(reachability >= least, "{seed}, {index}: {q:?}, {:?}", bound.point);
                        }
                    }
                }
            }
        }
    }

    /// Checks an elbow that cannot fold: points that its limits or the shoulder's limits exclude
    /// are outside.
    #[test]
    fn limits_of_turns_are_looked_at() {
        let joint = |at: f64| Joint { before: shift([at, 0.0, 0.0]), kind: VariableKind::Revolute };
        let chain = JointChain { joints: vec![joint(0.0), joint(0.4)], tool: shift([0.3, 0.0, 0.0]) };
        let region = Region::new(&chain, &|j| [[-2.0, 2.0], [-PI / 2.0, PI / 2.0]][j]);
        // At a right angle it reaches 0.5, and 0.6435 rad beyond the shoulder's limit.
        let at = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin(), 0.0];
        for (radius, angle, held) in [
            (0.51, 0.0, true),
            (0.49, 0.0, false),
            (0.49, -1.0, false),
            (0.55, 2.6, true),
            (0.55, -2.6, true),
            (0.55, 2.7, false),
            (0.55, PI, false),
        ] {
            assert_eq!(region.holds(at(radius, angle)), held, "{radius}, {angle}");
        }
    }

    /// Checks a planar arm of two links: the enclosure is the ring between |a − b| and a + b.
    #[test]
    fn a_ring_is_a_ring() {
        let joint = |at: f64| Joint { before: shift([at, 0.0, 0.0]), kind: VariableKind::Revolute };
        let chain = JointChain { joints: vec![joint(0.0), joint(0.5)], tool: shift([0.3, 0.0, 0.1]) };
        let region = Region::new(&chain, &|_| ANY);
        for (radius, height, held) in [
            (0.2, 0.1, true),
            (0.8, 0.1, true),
            (0.5, 0.1, true),
            (0.19, 0.1, false),
            (0.81, 0.1, false),
            (0.5, 0.11, false),
        ] {
            let (sine, cosine) = 2.0_f64.sin_cos();
            assert_eq!(region.holds([radius * cosine, radius * sine, height]), held, "{radius}, {height}");
        }
    }

    /// Checks prismatic joints along x, y and z: the enclosure is a box.
    #[test]
    fn slides_are_a_box() {
        let joint = |before: Pose| Joint { before, kind: VariableKind::Prismatic };
        let (to_x, to_y) = (turn(1, PI / 2.0), turn(0, -PI / 2.0));
        let chain = JointChain {
            joints: vec![joint(to_x), joint(to_x.inverse().then(&to_y)), joint(to_y.inverse())],
            tool: shift([0.1, 0.2, 0.3]),
        };
        let region = Region::new(&chain, &|j| [[0.0, 1.0], [-2.0, 0.0], [0.0, 0.5]][j]);
        for (point, held) in [
            ([0.1, 0.2, 0.3], true),
            ([1.1, -1.8, 0.8], true),
            ([0.0, 0.0, 0.5], false),
            ([0.5, 0.3, 0.5], false),
            ([0.5, 0.0, 0.9], false),
        ] {
            assert_eq!(region.holds(point), held, "{point:?}");
        }
    }
}
