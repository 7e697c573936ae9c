//! Three slides and three revolute joints, in any order.

use abbe_core::VariableKind;
use abbe_spec::Symbol;

use super::{Angle, Joint, Lines, Motion, Partial, Root, Wrist};
use crate::graph::{Graph, Node, Vector};

/// Volume spanned by the directions of three slides below which they count as coplanar.
const COPLANAR: f64 = 1e-9;

/// Returns the two solutions for a motion from zero. The revolute
/// joints give the orientation, the slides the position. Returns `None` if consecutive axes of
/// revolute joints are parallel, or if the slides are coplanar.
pub(super) fn solve(g: &mut Graph, lines: &Lines, motion: &Motion, free: [Angle; 6]) -> Option<Vec<Partial>> {
    let turns: Vec<usize> = (0..6).filter(|i| lines.lines[*i].kind == VariableKind::Revolute).collect();
    let &[a, b, c] = turns.as_slice() else { return None };
    let axes = [a, b, c].map(|i| lines.lines[i].along);
    let wrist = Wrist::new(g, &lines.probes, axes)?;
    let ends = wrist.solve(g, |g, v| motion.turn(g, v), [free[a], free[c]]);
    ends.into_iter()
        .map(|mut roots| {
            // Its pair is not of unit length.
            roots[2] = Root { angle: roots[2].angle.normalized(g), ..roots[2] };
            let mut left = roots.into_iter().rev();
            let mut joints: Vec<Option<Root>> = vec![None; 6];
            // The tool point, from a point on the axis.
            let (mut arm, mut origin) = ([g.zero(); 3], lines.tool.position);
            let mut ways: Vec<Vector> = Vec::new();
            for (i, line) in lines.lines.iter().enumerate().rev() {
                if line.kind == VariableKind::Prismatic {
                    ways.insert(0, line.along);
                    continue;
                }
                let root = left.next()?;
                let between = lines.probes.between(g, origin, line.at);
                let unturned = g.add_vectors(arm, between);
                arm = root.angle.turn(g, line.along, unturned);
                origin = line.at;
                ways.iter_mut().for_each(|way| *way = root.angle.turn(g, line.along, *way));
                joints[i] = Some(root);
            }
            let point = g.add_vectors(origin, arm);
            let (travels, exists) = travels(g, lines, &ways, point, motion.target.position)?;
            let mut travels = travels.into_iter();
            let joints = joints.into_iter().map(|root| match root {
                Some(root) => Some(Joint::Turn(root)),
                None => travels.next().map(Joint::Slide),
            });
            Some(Partial { joints: joints.collect::<Option<_>>()?, exists })
        })
        .collect()
}

/// Returns the travels along three directions from a point to a place, by Cramer's rule, and what
/// must not be negative. Returns `None` if the directions are coplanar.
fn travels(
    g: &mut Graph,
    lines: &Lines,
    ways: &[Vector],
    from: Vector,
    to: Vector,
) -> Option<([Node; 3], Vec<Node>)> {
    let &[x, y, z] = ways else { return None };
    let [yz, zx, xy] = [(y, z), (z, x), (x, y)].map(|(a, b)| g.cross(a, b));
    let determinant = g.dot(x, yz);
    let moves = g.symbols(&[determinant]).into_iter().any(|symbol| !matches!(symbol, Symbol::Parameter(_)));
    if !moves && lines.probes.are_zero(g, &[determinant], 1.0) {
        return None;
    }
    let way = g.sub_vectors(to, from);
    let heights = [yz, zx, xy].map(|normal| g.dot(normal, way));
    if !moves {
        return Some((heights.map(|height| g.div(height, determinant)), Vec::new()));
    }
    // Slides that turning makes coplanar reach nothing, but nothing is divided by zero.
    let (square, least) = (g.mul(determinant, determinant), g.constant(COPLANAR * COPLANAR));
    let exists = g.sub(square, least);
    let square = g.max(square, least);
    let inverse = g.div(determinant, square);
    Some((heights.map(|height| g.mul(height, inverse)), vec![exists]))
}
