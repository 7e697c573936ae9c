//! Bounds of sums of errors from the maximum of each part: not tight, but fast for any number of
//! joints.

use abbe_codegen::chain::{Magnitude, PerFrameMagnitudes};
use abbe_codegen::graph::Graph;
use abbe_spec::expr::Symbol;

use crate::effort::Effort;
use crate::largest::largest;
use crate::moving::Moving;

/// Effort for one part. Parts depend on few names and converge fast.
const EFFORT: Effort = Effort { gap: 1e-3, boxes: 2000, ..Effort::DEFAULT };

/// Upper bounds of the norm of the position error and of the rotation error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Position: repeatable sources, random sources, and their sum.
    pub position: [f64; 3],
    /// Rotation in rad: repeatable sources, random sources, and their sum.
    pub rotation: [f64; 3],
}

/// Bounds the sums of errors from the maximum of each part, over the box of the moving names with
/// all others `fixed`. A bound is infinite if one of its parts is.
///
/// ```text
/// ‖δ‖ ≤ Σ_i ‖d_i‖ + ‖θ_i‖ Σ_{k > i} ‖t_k‖        ‖θ‖ ≤ Σ_i ‖θ_i‖
/// ```
pub fn limits(
    graph: &mut Graph,
    apart: &PerFrameMagnitudes,
    moving: &[Moving],
    fixed: &dyn Fn(Symbol) -> f64,
) -> Limits {
    let mut size = |magnitude: &Magnitude| {
        largest(graph, magnitude, &[], moving, fixed, &EFFORT, &mut |_| true).certified
    };
    // Maximum distance of the tool point from each frame, last frame first.
    let mut reach = 0.0;
    let mut levers: Vec<f64> = Vec::with_capacity(apart.links.len());
    for link in apart.links.iter().rev() {
        reach = (reach + size(link)).next_up();
        levers.push(reach);
    }
    levers.reverse();
    let mut sums = |errors: &[[Magnitude; 2]]| {
        let mut sums = [0.0_f64; 2];
        for ([shift, turn], lever) in errors.iter().zip(&levers) {
            let [shift, turn] = [shift, turn].map(&mut size);
            // Without rotation the lever does not matter, even an infinite one.
            let swing = if turn == 0.0 { 0.0 } else { (turn * lever).next_up() };
            sums = [(sums[0] + (shift + swing).next_up()).next_up(), (sums[1] + turn).next_up()];
        }
        sums
    };
    let repeatable = sums(&apart.repeatable);
    let mut random = [0.0_f64; 2];
    for source in &apart.random {
        let own = sums(source);
        random = std::array::from_fn(|i| (random[i] + own[i]).next_up());
    }
    let of = |i: usize| [repeatable[i], random[i], (repeatable[i] + random[i]).next_up()];
    Limits { position: of(0), rotation: of(1) }
}
