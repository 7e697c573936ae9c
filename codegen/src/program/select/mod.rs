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

/// Of how many classes there may be more than descents: all of six or seven axes, where long chains would take the square of
/// their length.
const LARGEST_SEARCHED: usize = 4000;

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
        let selection = Rc::new(Selection::new(graph, outputs, None));
        self.known.push((firsts, Rc::clone(&selection)));
        selection
    }

    /// What to compute for some outputs if others come with the operations that were selected for them alone.
    pub(super) fn after(&mut self, graph: &Graph, others: &[Node], outputs: &[Node]) -> Rc<Selection> {
        let selection = self.of(graph, others);
        Rc::new(Selection::new(graph, outputs, Some((others, &selection))))
    }
}

impl Selection {
    fn new(graph: &Graph, outputs: &[Node], given: Option<(&[Node], &Self)>) -> Self {
        if graph.classes().next().is_none() {
            return Self { classes: Vec::new(), chosen: Vec::new() };
        }
        let ways = Ways::new(graph, outputs);
        let mut chosen = ways.as_made(graph, outputs);
        let mut fixed = vec![false; ways.count()];
        if let Some((others, selection)) = given {
            let mut stack: Vec<Node> = others.iter().map(|node| graph.class(*node).node).collect();
            while let Some(first) = stack.pop() {
                let node = selection.of(first).node;
                if let Some((class, way)) = ways.find(graph, node)
                    && !std::mem::replace(&mut fixed[class as usize], true)
                {
                    chosen[class as usize] = way;
                    stack.extend(graph.op(node).operands().map(|operand| graph.class(operand).node));
                }
            }
        }
        let mut search = Search::new(&ways, chosen, fixed);
        search.descend();
        if ways.count() <= LARGEST_SEARCHED {
            search.give();
            search.change_together(graph);
            search.compute_anew();
        }
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
