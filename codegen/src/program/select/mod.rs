//! Selects, among equal nodes, those whose program takes the fewest operations.
//!
//! Equal nodes form a class; each member is one alternative. The search starts from the nodes that
//! the outputs were built from, so that it never ends with more operations; `moves` improves on
//! that. Finding the optimum is a covering problem and NP-hard; this search is a heuristic.

use std::rc::Rc;

mod alternatives;
mod moves;
mod search;

use crate::graph::{Graph, Node, Signed};
use alternatives::Alternatives;
use search::Search;

/// Largest number of classes for which moves beyond descent are tried. It covers chains of six or
/// seven axes; for long chains these moves would take time quadratic in their length.
const LARGEST_SEARCHED: usize = 4000;

/// Selected node of every class.
pub(super) struct Selection {
    /// Index of the class that each node represents.
    classes: Vec<Option<u32>>,
    /// Selected member of each class.
    chosen: Vec<Signed>,
}

/// Selections by outputs, as several functions have the same outputs.
#[derive(Default)]
pub(super) struct Selections {
    known: Vec<(Vec<Node>, Rc<Selection>)>,
}

impl Selections {
    /// Returns the selection for some outputs.
    pub(super) fn select(&mut self, graph: &Graph, outputs: &[Node]) -> Rc<Selection> {
        let mut firsts: Vec<Node> = outputs.iter().map(|output| graph.class(*output).node).collect();
        firsts.sort_unstable();
        firsts.dedup();
        if let Some((_, selection)) = self.known.iter().find(|(known, _)| *known == firsts) {
            return Rc::clone(selection);
        }
        let selection = Rc::new(Selection::new(graph, outputs, None));
        self.known.push((firsts, Rc::clone(&selection)));
        selection
    }

    /// Returns the selection for `outputs`, in which `others` keep the operations selected for them
    /// alone.
    pub(super) fn after(&mut self, graph: &Graph, others: &[Node], outputs: &[Node]) -> Rc<Selection> {
        let selection = self.select(graph, others);
        Rc::new(Selection::new(graph, outputs, Some((others, &selection))))
    }
}

impl Selection {
    fn new(graph: &Graph, outputs: &[Node], given: Option<(&[Node], &Self)>) -> Self {
        if graph.classes().next().is_none() {
            return Self { classes: Vec::new(), chosen: Vec::new() };
        }
        let alternatives = Alternatives::new(graph, outputs);
        let mut chosen = alternatives.as_made(graph, outputs);
        let mut fixed = vec![false; alternatives.count()];
        if let Some((others, selection)) = given {
            let mut stack: Vec<Node> = others.iter().map(|node| graph.class(*node).node).collect();
            while let Some(first) = stack.pop() {
                let node = selection.member(first).node;
                if let Some((class, alternative)) = alternatives.find(graph, node)
                    && !std::mem::replace(&mut fixed[class as usize], true)
                {
                    chosen[class as usize] = alternative;
                    stack.extend(graph.op(node).operands().map(|operand| graph.class(operand).node));
                }
            }
        }
        let mut search = Search::new(&alternatives, chosen, fixed);
        search.descend();
        if alternatives.count() <= LARGEST_SEARCHED {
            search.give();
            search.change_together(graph);
            search.compute_anew();
        }
        let chosen = search.chosen.iter().map(|alternative| alternatives.node(*alternative)).collect();
        Self { classes: alternatives.classes, chosen }
    }

    /// Returns the selected member of the class with this representative.
    pub(super) fn member(&self, first: Node) -> Signed {
        let class = self.classes.get(first.index()).copied().flatten();
        class.map_or(Signed { node: first, negative: false }, |class| self.chosen[class as usize])
    }

    /// Returns `true` if the representative itself is selected.
    pub(super) fn is(&self, first: Node) -> bool {
        self.classes.get(first.index()) != Some(&None) && self.member(first).node == first
    }
}
