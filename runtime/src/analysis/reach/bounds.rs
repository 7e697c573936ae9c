//! Where the tool point of a chain of lower pairs can be at most: known without a search.
//!
//! From the tip to the base, all points where the tool may be are enclosed by how far they are along the axis of a joint, off it,
//! and away from its origin. A turn about the axis changes none of the three. Every step encloses at least what is there,
//! so that a point outside is not reached: with limits of turns or without, as those are not looked at.

use super::Target;
use super::joint_chain::{JointChain, scaled};
use super::quest::{Problem, Prospect};
use crate::analysis::sampling::norm;
use crate::{Pose, VariableKind};

/// By how much bounds are widened, in arm lengths: more than what rounding and the numbers of the chain can make.
const SLACK: f64 = 1e-7;

type Interval = [f64; 2];

/// Where a target can be.
pub(super) struct Bounds {
    arm: f64,
    /// Of the tool point: limits aside, and within those of the slides.
    tool: [Region; 2],
    /// Of the origin of the last joint, which the pose of the tool tells, and the way to it.
    last: Option<(Pose, [Region; 2])>,
}

/// Where a point at the end of a chain can be.
struct Region {
    /// From `F_0` to the first axis, and the extent about that.
    to_axis: Pose,
    extent: Extent,
    /// Along x, y and z of `F_0`: sharper where slides come first.
    sides: [Interval; 3],
}

/// Points enclosed: distances along an axis, off it, and from its origin.
#[derive(Clone, Copy, Debug)]
struct Extent {
    along: Interval,
    off: Interval,
    away: Interval,
}

impl Bounds {
    pub(super) fn new(problem: &Problem<'_>, chain: &JointChain) -> Self {
        let limits = |j: usize| problem.variable(j).limits.map(|limit| limit / problem.unit(j));
        let regions = |chain: &JointChain| {
            [Region::new(chain, &|_| [f64::NEG_INFINITY, f64::INFINITY]), Region::new(chain, &limits)]
        };
        let last = match chain.joints.split_last() {
            Some((last, others)) if last.kind == VariableKind::Revolute => {
                let shorter = JointChain { joints: others.to_vec(), tool: last.before };
                Some((chain.tool.inverse(), regions(&shorter)))
            }
            _ => None,
        };
        Self { arm: problem.arm, tool: regions(chain), last }
    }

    /// What is known of a target.
    pub(super) fn prospect(&self, target: &Target) -> Prospect {
        let of = |regions: &[Region; 2], point: [f64; 3]| match regions.each_ref().map(|r| r.holds(point)) {
            [false, _] => Prospect::Never,
            [true, false] => Prospect::BeyondLimits,
            [true, true] => Prospect::Open,
        };
        match (target, &self.last) {
            (Target::Point(point), _) => of(&self.tool, point.map(|x| x / self.arm)),
            (Target::Pose(pose), None) => of(&self.tool, scaled(pose, self.arm).position()),
            (Target::Pose(pose), Some((back, regions))) => {
                let pose = scaled(pose, self.arm);
                of(&self.tool, pose.position()).min(of(regions, pose.then(back).position()))
            }
        }
    }
}

impl Region {
    /// With slides between these limits.
    fn new(chain: &JointChain, limits: &dyn Fn(usize) -> Interval) -> Self {
        let slides = |joint: &&super::joint_chain::Joint| joint.kind == VariableKind::Prismatic;
        let first_turn = chain.joints.iter().take_while(slides).count();
        let mut extent = Extent::of(chain.tool.position());
        // As seen from F_0, in front of the slides that come first.
        let mut turned = (first_turn == chain.joints.len()).then_some(extent);
        for (j, joint) in chain.joints.iter().enumerate().rev() {
            if joint.kind == VariableKind::Prismatic {
                extent = extent.slid(limits(j));
            }
            if j == first_turn {
                turned = Some(extent);
            }
            if j > 0 {
                extent = extent.seen_from(&joint.before);
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
            // Slides only: the point goes along.
            None => (frame, frame.then(&chain.tool).position().map(|x| [x; 2])),
        };
        let to_axis = chain.joints.first().map_or(point, |joint| joint.before).inverse();
        let sides = core::array::from_fn(|i| sum(sides[i], travel[i]));
        Self { to_axis, extent, sides }
    }

    /// Whether a point, in arm lengths, may be reached.
    fn holds(&self, point: [f64; 3]) -> bool {
        let seen = self.to_axis.apply(point);
        let Extent { along, off, away } = self.extent;
        let inside = |value: f64, [least, most]: Interval| least - SLACK <= value && value <= most + SLACK;
        inside(seen[2], along)
            && inside(seen[0].hypot(seen[1]), off)
            && inside(norm(seen), away)
            && point.into_iter().zip(self.sides).all(|(value, side)| inside(value, side))
    }
}

impl Extent {
    /// A point.
    fn of(point: [f64; 3]) -> Self {
        let [x, y, z] = point;
        Self { along: [z; 2], off: [x.hypot(y); 2], away: [norm(point); 2] }
    }

    /// Along a direction: `u · x = u_z z + u_ρ ρ cos φ`, and no more than `r`.
    fn along(&self, direction: [f64; 3]) -> Interval {
        let across = times([-self.off[1], self.off[1]], direction[0].hypot(direction[1]));
        let [least, most] = sum(times(self.along, direction[2]), across);
        [least.max(-self.away[1]), most.min(self.away[1])]
    }

    /// Moved along the axis by anything between two limits.
    fn slid(&self, limits: Interval) -> Self {
        let along = sum(self.along, limits);
        let away = [0, 1].map(|end| {
            let z = if end == 0 { least_size(along) } else { largest_size(along) };
            z.hypot(self.off[end])
        });
        Self { along, off: self.off, away }
    }

    /// As seen from the frame before, `x' = R x + d`.
    ///
    /// `z' = u · x + d_z` with `u` the z axis there; `r'² = (z + w_z)² + ρ² + w_ρ² + 2 w_ρ ρ cos φ` with `w = Rᵀ d`, so that
    /// `(|z + w_z|, |ρ − w_ρ|)` is the least and `(|z + w_z|, ρ + w_ρ)` the most, and `|r − |d|| ≤ r' ≤ r + |d|`. What is off the
    /// new axis is `ρ' = |d_⊥ + (R x)_⊥|`, with `(R x)_⊥² = r² − (u · x)²`, and `ρ'² = r'² − z'²`.
    fn seen_from(&self, motion: &Pose) -> Self {
        let back = motion.inverse();
        let u = back.0[2];
        let d = motion.position();
        let w = back.turn(d);
        let share = self.along(u);
        let along = sum(share, [d[2]; 2]);

        let (wide, shifted) = (w[0].hypot(w[1]), sum(self.along, [w[2]; 2]));
        let across = sum(self.off, [-wide; 2]);
        let (near, far) =
            (least_size(shifted).hypot(least_size(across)), largest_size(shifted).hypot(self.off[1] + wide));
        let length = norm(d);
        let away = [near.max(least_size(sum(self.away, [-length; 2]))), far.min(self.away[1] + length)];

        let parallel = u[0] == 0.0 && u[1] == 0.0;
        let beside = if parallel { self.off } else { legs(self.away, share) };
        let offset = d[0].hypot(d[1]);
        let [least, most] = legs(away, along);
        let off = [least.max(least_size(sum(beside, [-offset; 2]))), most.min(beside[1] + offset)];
        Self { along, off, away }
    }
}

/// What is left of hypotenuses beside legs of these sizes.
fn legs(hypotenuse: Interval, leg: Interval) -> Interval {
    let root = |hypotenuse: f64, leg: f64| (hypotenuse * hypotenuse - leg * leg).max(0.0).sqrt();
    let most = if hypotenuse[1].is_finite() { root(hypotenuse[1], least_size(leg)) } else { f64::INFINITY };
    [root(hypotenuse[0], largest_size(leg)), most]
}

fn sum(a: Interval, b: Interval) -> Interval {
    [a[0] + b[0], a[1] + b[1]]
}

fn times(a: Interval, factor: f64) -> Interval {
    if factor == 0.0 {
        return [0.0; 2];
    }
    let [least, most] = a.map(|end| end * factor);
    [least.min(most), least.max(most)]
}

/// The size of what is nearest to zero.
fn least_size([least, most]: Interval) -> f64 {
    least.max(-most).max(0.0)
}

/// The size of what is farthest from zero.
fn largest_size([least, most]: Interval) -> f64 {
    most.max(-least)
}

#[cfg(test)]
mod tests {
    use core::f64::consts::{PI, TAU};

    use super::*;
    use crate::analysis::reach::joint_chain::Joint;
    use crate::analysis::sampling::{halton, stream};
    use rand::RngExt;

    fn turn(axis: usize, angle: f64) -> Pose {
        let mut columns = Pose::IDENTITY.0;
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let (sine, cosine) = angle.sin_cos();
        (columns[i][i], columns[i][j], columns[j][i], columns[j][j]) = (cosine, sine, -sine, cosine);
        Pose(columns)
    }

    fn shift(by: [f64; 3]) -> Pose {
        let Pose([x, y, z, _]) = Pose::IDENTITY;
        Pose([x, y, z, by])
    }

    /// Chains of every mix of turns and slides, their axes in general position, parallel, at right angles and meeting; random
    /// values of all turns, of slides within their limits and beyond: each point is where it may be.
    #[test]
    fn what_is_reached_is_never_called_out_of_reach() {
        for seed in 0..400 {
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
            let limits: Vec<Interval> = (0..count).map(|_| [number(-1.0, 0.0), number(0.0, 1.0)]).collect();
            let narrow = Region::new(&chain, &|j| limits[j]);
            let wide = Region::new(&chain, &|_| [f64::NEG_INFINITY, f64::INFINITY]);
            for index in 0..300 {
                let q: Vec<f64> = (0..count)
                    .map(|j| match chain.joints[j].kind {
                        VariableKind::Revolute => TAU * halton(index, j),
                        // Both ends, too.
                        VariableKind::Prismatic => {
                            let share = (1.2 * halton(index, j) - 0.1).clamp(0.0, 1.0);
                            limits[j][0] + share * (limits[j][1] - limits[j][0])
                        }
                    })
                    .collect();
                assert!(narrow.holds(chain.pose(&q).position()), "{seed}, {index}: {q:?}");
                let further: Vec<f64> = q.iter().map(|value| 10.0 * value).collect();
                assert!(wide.holds(chain.pose(&further).position()), "{seed}, {index}: {further:?}");
            }
        }
    }

    /// Two links in a plane: the ring between |a − b| and a + b, and nothing beside it.
    #[test]
    fn a_ring_is_a_ring() {
        let joint = |at: f64| Joint { before: shift([at, 0.0, 0.0]), kind: VariableKind::Revolute };
        let chain = JointChain { joints: vec![joint(0.0), joint(0.5)], tool: shift([0.3, 0.0, 0.1]) };
        let region = Region::new(&chain, &|_| [0.0; 2]);
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

    /// Slides along x, y and z: a box.
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
