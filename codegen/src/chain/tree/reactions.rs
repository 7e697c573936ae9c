//! Forces that close the loops of a loaded machine.
//!
//! The machine rests where its energy `V = ½ Σ ε_iᵀ C_i⁻¹ ε_i − W(q, p, ε)` is smallest under
//! `φ(q, p, ε) = 0`; W is the work of the loads. With multipliers λ of φ, to first order,
//!
//! ```text
//! by p:      W_p + φ_pᵀ λ = 0              λ = −φ_p⁻ᵀ W_p
//! by ε_i:    C_i⁻¹ ε_i = w_i               w_i = W_ε + φ_εᵀ λ
//! by l:      −k δl = λ                     for a leg, whose φ = |d| − l
//! ```
//!
//! Hence w_i is `(J_ε − J_p φ_p⁻¹ φ_ε)ᵀ F` for a load F and J at its point: passive joints carry
//! nothing along their motions. `φ_εᵀ λ` is the wrench of forces on the frames of the loops: λ u and
//! −λ u on the ends of a leg, along its direction u. A leg that is pressed has a positive λ.

use super::closure::{self, Wrenches};
use super::parts::Parts;
use crate::graph::{Graph, Node};

/// Forces of all loops, in the axes of `F_0`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reactions {
    /// λ, one per equation of the loops.
    pub(crate) forces: Vec<Node>,
    /// Forces and moments on the frames of each loop.
    pub(crate) wrenches: Vec<Wrenches>,
}

impl Reactions {
    /// Solves for the forces, given the force or moment of the loads on each passive variable.
    pub(crate) fn new(graph: &mut Graph, parts: &Parts<'_>, loads: &[Node]) -> Self {
        let opposite: Vec<Node> = loads.iter().map(|load| graph.neg(*load)).collect();
        let forces = parts.factored.solve_row(graph, &opposite);
        let mut rest = &forces[..];
        let mut wrenches = Vec::new();
        for (ends, closure) in parts.closures() {
            let (own, others) = rest.split_at(closure.equations());
            rest = others;
            wrenches.push(closure::wrenches(graph, ends, closure, own, |frame| *parts.whole.pose(frame)));
        }
        Self { forces, wrenches }
    }
}
