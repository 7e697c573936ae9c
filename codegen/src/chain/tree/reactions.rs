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
//! nothing along their motions. `φ_εᵀ λ` is the wrench of forces on the frames of the loops: λ u
//! and −λ u on the ends of a leg, along its direction u. A leg that is pressed has a positive λ.

use abbe_spec::Closure;

use super::closure::{Ends, Wrenches, wrenches};
use super::parts::Parts;
use crate::graph::{Graph, Node};

/// Forces of a loop, in the axes of `F_0`.
pub(crate) struct Reaction {
    /// λ, one per equation.
    pub(crate) forces: Vec<Node>,
    /// Forces and moments on its frames.
    pub(crate) wrenches: Wrenches,
}

impl Parts<'_> {
    /// Returns the forces of each loop, given the force or moment of the loads on each passive
    /// variable.
    pub(crate) fn reactions(&self, graph: &mut Graph, loads: &[Node]) -> Vec<Reaction> {
        let opposite: Vec<Node> = loads.iter().map(|load| graph.neg(*load)).collect();
        let mut rest = self.factored.solve_row(graph, &opposite);
        let reaction = |(ends, closure): (Ends, &Closure)| {
            let forces: Vec<Node> = rest.drain(..closure.equations()).collect();
            let pose = |frame| *self.whole.pose(frame);
            let wrenches = wrenches(graph, ends, closure, &forces, pose);
            Reaction { forces, wrenches }
        };
        self.closures().map(reaction).collect()
    }
}
