//! Of nodes that are equal those whose program takes the fewest operations.
//!
//! All that are equal are a class, and each of them is a way to compute it. The search begins with the nodes that the
//! outputs were made of, so that it never ends with more; `moves` says how it goes on. Finding the fewest of all is as
//! hard as any problem of covering: this finds few.

use std::rc::Rc;

mod moves;
mod search;
mod ways;

use crate::graph::{Graph, Node, Signed};
use search::Search;
use ways::Ways;

/// What stands for every node that is needed.
pub(super) struct Selection {
    /// The number of the class that a node stands for.
    classes: Vec<Option<u32>>,
    /// What is computed for each class.
    chosen: Vec<Signed>,
}

/// What was selected, and for which outputs: several functions have the same.
#[derive(Default)]
pub(super) struct Selections {
    known: Vec<(Vec<Node>, Rc<Selection>)>,
}

impl Selections {
    /// What to compute for some outputs.
    pub(super) fn of(&mut self, graph: &Graph, outputs: &[Node]) -> Rc<Selection> {
        let mut firsts: Vec<Node> = outputs.iter().map(|output| graph.class(*output).node).collect();
        firsts.sort_unstable();
        firsts.dedup();
        if let Some((_, selection)) = self.known.iter().find(|(known, _)| *known == firsts) {
            return Rc::clone(selection);
        }
        let selection = Rc::new(Selection::new(graph, outputs));
        self.known.push((firsts, Rc::clone(&selection)));
        selection
    }
}

impl Selection {
    fn new(graph: &Graph, outputs: &[Node]) -> Self {
        if graph.classes().next().is_none() {
            return Self { classes: Vec::new(), chosen: Vec::new() };
        }
        let ways = Ways::new(graph, outputs);
        let mut search = Search::new(&ways, ways.as_made(graph, outputs));
        search.descend();
        search.give();
        search.change_together(graph);
        search.compute_anew();
        let chosen = search.chosen().map(|way| ways.node(way)).collect();
        Self { classes: ways.classes, chosen }
    }

    /// The node to compute for one that stands for all that are equal, and whether that is its negative.
    pub(super) fn of(&self, first: Node) -> Signed {
        let class = self.classes.get(first.index()).copied().flatten();
        class.map_or(Signed { node: first, negative: false }, |class| self.chosen[class as usize])
    }

    /// Whether a node is what is computed for itself.
    pub(super) fn is(&self, first: Node) -> bool {
        self.classes.get(first.index()) != Some(&None) && self.of(first).node == first
    }
}
