//! Three parallel axes between the first joint and the last two, whose axes intersect.

use abbe_core::VariableKind;

use super::arm::{back_to_height, plane};
use super::wrist::across;
use super::{Angle, Line, Lines, Motion, Partial, Root, angle_between, tilt_angles};
use crate::graph::Graph;

/// Returns the eight solutions for a motion from zero; `None` if the axes are others.
///
/// The parallel axes keep heights along them. That of the center of the last two axes gives q_1,
/// that of the last axis q_5, and the direction of the parallel axes seen from the last link q_6.
/// What remains is a plane arm of two links with a known last angle.
pub(super) fn solve(g: &mut Graph, lines: &Lines, motion: &Motion, free: [Angle; 6]) -> Option<Vec<Partial>> {
    let probes = &lines.probes;
    let all: &[Line; 6] = lines.lines.as_slice().try_into().ok()?;
    let [first, second, third, fourth, fifth, sixth] = *all;
    let is_parallel = probes.are_parallel(g, second.along, third.along)
        && probes.are_parallel(g, second.along, fourth.along);
    let others = probes.are_parallel(g, first.along, second.along)
        || probes.are_parallel(g, fourth.along, fifth.along);
    let between = [(second, third), (third, fourth)].map(|(a, b)| probes.offset(g, &a, b.at));
    let is_one = between.iter().any(|between| probes.are_zero(g, between, probes.size));
    if all.iter().any(|line| line.kind == VariableKind::Prismatic) || !is_parallel || others || is_one {
        return None;
    }
    let centre = probes.common_point(g, &fifth, &sixth)?;
    let h = second.along;
    let signs = [third, fourth].map(|line| {
        let sign = g.dot(h, line.along);
        probes.nominal(g, sign)
    });
    let place = motion.point(g, probes, centre);
    let place = g.sub_vectors(place, first.at);
    let kept = probes.between(g, centre, first.at);
    let between = probes.between(g, first.at, second.at);
    let height = g.dot(h, kept);
    let end = motion.turn(g, sixth.along);
    let unit = across(g, probes, h);
    let lever = probes.between(g, centre, fourth.at);
    let mut found = Vec::new();
    for q1 in back_to_height(g, [first.along, h], place, height, free[0], probes.size) {
        let back = q1.angle.signed(g, -1.0);
        let image = back.turn(g, first.along, end);
        let ahead = q1.angle.turn(g, first.along, h);
        let seen = motion.turn_back(g, ahead);
        let wrist = back.turn(g, first.along, place);
        let wrist = g.add_vectors(wrist, between);
        let goal = q1.angle.turn(g, first.along, wrist);
        let goal = motion.turn_back(g, goal);
        let fifths = tilt_angles(g, [h, fifth.along, sixth.along], image, probes);
        for (q5, keeps_start) in fifths.into_iter().zip([true, false]) {
            let back_5 = q5.angle.signed(g, -1.0);
            // Where the sixth axis is parallel to the others, both q_5 are one, and q_6 is free:
            // first as in the start, then so that the arm has to reach least.
            let last = if keeps_start {
                free[5].signed(g, -1.0)
            } else {
                let lever = back_5.turn(g, fifth.along, lever);
                angle_between(g, sixth.along, lever, goal, free[5], probes.size).normalized(g)
            };
            // R_6ᵀ R_5ᵀ h = Rᵀ R_1 h
            let tilted = back_5.turn(g, fifth.along, h);
            let back_6 = angle_between(g, sixth.along, tilted, seen, last, 1.0).normalized(g);
            let q6 = back_6.signed(g, -1.0);
            let ends = back_5.turn(g, fifth.along, unit);
            let ends = back_6.turn(g, sixth.along, ends);
            let together = motion.turn(g, ends);
            let together = back.turn(g, first.along, together);
            let beyond = g.cross(h, unit);
            let total = Angle { sine: g.dot(beyond, together), cosine: g.dot(unit, together) };
            let total = total.normalized(g);
            let lever = total.turn(g, h, lever);
            let reach = g.sub_vectors(wrist, lever);
            for [q2, q3] in plane(g, probes, [&second, &third], fourth.at, reach, [free[1], free[2]]) {
                let before = [q2.angle, q3.angle.signed(g, signs[0])];
                let q4 = before.into_iter().fold(total, |sum, angle| {
                    let back = angle.signed(g, -1.0);
                    sum.plus(g, back)
                });
                let q4 = q4.signed(g, signs[1]);
                let exists = q5.exists;
                let [q4, q5, q6] = [q4, q5.angle, q6].map(|angle| Root { angle, exists });
                found.push(Partial::new(vec![q1, q2, q3, q4, q5, q6]));
            }
        }
    }
    Some(found)
}
