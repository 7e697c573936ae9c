//! What sums of errors cannot exceed, from the largest size of each part by itself: loose, but soon known of any number of joints.

use abbe_codegen::chain::{Apart, Magnitude};
use abbe_codegen::graph::Graph;
use abbe_spec::expr::Symbol;

use crate::effort::Effort;
use crate::largest::largest;
use crate::moving::Moving;

/// Parts depend on little, and are soon known.
const EFFORT: Effort = Effort { gap: 1e-3, boxes: 2000, at_most: f64::INFINITY };

/// What neither the norm of a position's error nor that of a rotation exceeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Of the repeatable sources, of the random ones, and of both added.
    pub position: [f64; 3],
    /// The same of rotations, rad.
    pub rotation: [f64; 3],
}

/// From the parts, over the box in which some names move, all others being as `fixed` says; infinite where a part is.
///
/// ```text
/// ‖δ‖ ≤ Σ_i ‖d_i‖ + ‖θ_i‖ Σ_{k > i} ‖t_k‖        ‖θ‖ ≤ Σ_i ‖θ_i‖
/// ```
pub fn limits(graph: &mut Graph, apart: &Apart, moving: &[Moving], fixed: impl Fn(Symbol) -> f64) -> Limits {
    let mut size =
        |magnitude: &Magnitude| largest(graph, magnitude, moving, &fixed, &EFFORT, &mut |_| true).certified;
    // How far the tool point may be from each frame, the last one first.
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
            // No turn moves nothing, however far away.
            let swing = if turn == 0.0 { 0.0 } else { (turn * lever).next_up() };
            sums = [(sums[0] + (shift + swing).next_up()).next_up(), (sums[1] + turn).next_up()];
        }
        sums
    };
    let repeatable = sums(&apart.repeatable);
    let mut squares = [0.0_f64; 2];
    for source in &apart.random {
        let own = sums(source);
        squares = std::array::from_fn(|i| (squares[i] + (own[i] * own[i]).next_up()).next_up());
    }
    let random = squares.map(|square| square.sqrt().next_up());
    let of = |i: usize| [repeatable[i], random[i], (repeatable[i] + random[i]).next_up()];
    Limits { position: of(0), rotation: of(1) }
}
