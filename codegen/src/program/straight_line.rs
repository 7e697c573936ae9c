//! Converts the nodes of a result to steps that compute it.

use std::rc::Rc;

use indexmap::IndexMap;

use super::select::{Selection, Selections};
use super::step::{Operand, Program};
use super::write::Writer;
use crate::graph::{Graph, Node};

impl Program {
    /// Returns the steps that compute the nodes, in the order in which the nodes were made. Among
    /// equal nodes those that take the fewest operations are computed.
    pub fn new(graph: &Graph, outputs: &[Node]) -> Self {
        Self::with(graph, outputs, &mut Selections::default())
    }

    /// Returns the steps that compute the nodes, reusing earlier selections.
    pub(super) fn with(graph: &Graph, outputs: &[Node], selections: &mut Selections) -> Self {
        Self::from_selection(graph, outputs, selections.select(graph, outputs))
    }

    /// Returns the steps that compute the nodes as they are selected.
    pub(super) fn from_selection(graph: &Graph, outputs: &[Node], selection: Rc<Selection>) -> Self {
        let mut program = Self {
            steps: Vec::new(),
            outputs: Vec::new(),
            numbers: Vec::new(),
            registers: 0,
            uses: Vec::new(),
        };
        program.outputs = Writer::new(graph, outputs, selection, &mut program).outputs(outputs);
        program.count_uses();
        program.fuse();
        program.sines_first();
        program.name_numbers(graph);
        program
    }

    fn name_numbers(&mut self, graph: &Graph) {
        let mut uses: IndexMap<u64, usize> = IndexMap::new();
        for operand in self.steps.iter().flat_map(|step| step.action.operands()) {
            if let Operand::Constant(value) = operand {
                *uses.entry(value.to_bits()).or_default() += 1;
            }
        }
        let recurring = uses.into_iter().filter(|(_, uses)| *uses > 1).map(|(bits, _)| f64::from_bits(bits));
        let named = recurring.filter_map(|value| Some((value, graph.name_of_number(value)?.to_owned())));
        self.numbers = named.collect();
    }
}
