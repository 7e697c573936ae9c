//! Tests of `bounds.rs`.

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
                core::array::from_fn(|_| if number(0.0, 1.0) < special { 0.0 } else { number(-1.0, 1.0) });
            shift(at).then(&turn(0, angles[0])).then(&turn(1, angles[1])).then(&turn(2, angles[2]))
        };
        let special = [0.0, 0.5, 0.9][seed as usize % 3];
        let joints: Vec<Pose> = (0..count).map(|_| motion(special)).collect();
        let tool = motion(special);
        let joints = joints.into_iter().map(|before| {
            let kind = if number(0.0, 1.0) < 0.3 { VariableKind::Prismatic } else { VariableKind::Revolute };
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
