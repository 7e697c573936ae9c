//! The classes that outputs may need, and the ways to compute each.

use std::ops::Range;

use abbe_spec::expr::Function;

use crate::graph::{Graph, Node, Op, Signed};

/// A way to compute a class.
pub(super) struct Way {
    node: Signed,
    /// What its own operation takes.
    pub(super) cost: u32,
    /// The classes that it uses; [`Ways::count`] where there is none.
    pub(super) operands: [u32; 2],
}

impl Way {
    /// What it takes where its operands take this.
    pub(super) fn price(&self, of: &[u32]) -> u32 {
        let [a, b] = self.operands.map(|operand| of[operand as usize]);
        self.cost + a + b
    }
}

/// All classes, those that others use before these as far as that goes.
pub(super) struct Ways {
    /// The number of the class that a node stands for.
    pub(super) classes: Vec<Option<u32>>,
    ways: Vec<Way>,
    of: Vec<Range<u32>>,
    /// The classes with ways that use each, one after the other, and where those of each begin.
    users: Vec<u32>,
    users_of: Vec<usize>,
    /// The classes of the outputs, each once.
    pub(super) outputs: Vec<u32>,
}

impl Ways {
    pub(super) fn new(graph: &Graph, outputs: &[Node]) -> Self {
        let firsts: Vec<Node> = outputs.iter().map(|output| graph.class(*output).node).collect();
        let (classes, reached) = reached(graph, firsts.clone());
        let number = |node: Node| classes[node.index()].expect("it was reached");
        let mut ways = Vec::with_capacity(2 * reached.len());
        let mut of = Vec::with_capacity(reached.len());
        for first in &reached {
            let start = ways.len() as u32;
            for node in graph.equal(*first) {
                let op = graph.op(node.node);
                let mut operands = [reached.len() as u32; 2];
                for (place, operand) in operands.iter_mut().zip(op.operands()) {
                    *place = number(graph.class(operand).node);
                }
                ways.push(Way { node, cost: cost(op), operands });
            }
            of.push(start..ways.len() as u32);
        }
        let mut outputs = Vec::new();
        let mut is_known = vec![false; reached.len()];
        for class in firsts.into_iter().map(number) {
            if !std::mem::replace(&mut is_known[class as usize], true) {
                outputs.push(class);
            }
        }
        let (users, users_of) = users(&ways, &of);
        Self { classes, ways, of, users, users_of, outputs }
    }

    /// How many classes there are.
    pub(super) fn count(&self) -> usize {
        self.of.len()
    }

    pub(super) fn way(&self, way: u32) -> &Way {
        &self.ways[way as usize]
    }

    /// What a way computes.
    pub(super) fn node(&self, way: u32) -> Signed {
        self.way(way).node
    }

    /// The ways of a class.
    pub(super) fn of(&self, class: u32) -> Range<u32> {
        self.of[class as usize].clone()
    }

    /// The same, one after the other.
    pub(super) fn list(&self, class: u32) -> &[Way] {
        let Range { start, end } = self.of[class as usize];
        &self.ways[start as usize..end as usize]
    }

    /// The classes with a way that uses one.
    pub(super) fn users(&self, class: u32) -> &[u32] {
        &self.users[self.users_of[class as usize]..self.users_of[class as usize + 1]]
    }

    /// The classes that a way uses.
    pub(super) fn operands(&self, way: u32) -> impl Iterator<Item = u32> + use<> {
        let nothing = self.count() as u32;
        self.way(way).operands.into_iter().filter(move |operand| *operand != nothing)
    }

    /// The classes with several ways.
    pub(super) fn several(&self) -> Vec<u32> {
        (0..self.count() as u32).filter(|class| self.of(*class).len() > 1).collect()
    }

    /// The class of a node and which of its ways it is, if it is any.
    pub(super) fn find(&self, graph: &Graph, node: Node) -> Option<(u32, u32)> {
        let class = self.classes[graph.class(node).node.index()]?;
        let node = match graph.op(node) {
            Op::Neg(inner) => inner,
            _ => node,
        };
        Some((class, self.of(class).find(|way| self.node(*way).node == node)?))
    }

    /// Of each class the way that is the node of which the outputs were made; of several the oldest, which comes after all
    /// that it uses.
    pub(super) fn as_made(&self, graph: &Graph, outputs: &[Node]) -> Vec<u32> {
        let mut made = vec![false; graph.len()];
        let mut stack = outputs.to_vec();
        while let Some(node) = stack.pop() {
            if !std::mem::replace(&mut made[node.index()], true) {
                stack.extend(graph.op(node).operands());
            }
        }
        let oldest = |ways: &Range<u32>| {
            let made = ways.clone().filter(|way| made[self.node(*way).node.index()]);
            made.min_by_key(|way| self.node(*way).node).unwrap_or(ways.start)
        };
        self.of.iter().map(oldest).collect()
    }
}

/// Numbers all classes that some may need.
fn reached(graph: &Graph, mut stack: Vec<Node>) -> (Vec<Option<u32>>, Vec<Node>) {
    let (mut classes, mut is_open) = (vec![None; graph.len()], vec![false; graph.len()]);
    let mut reached = Vec::new();
    while let Some(&first) = stack.last() {
        if std::mem::replace(&mut is_open[first.index()], true) {
            stack.pop();
            if classes[first.index()].is_none() {
                classes[first.index()] = Some(reached.len() as u32);
                reached.push(first);
            }
            continue;
        }
        for node in graph.equal(first) {
            let operands = graph.op(node.node).operands().map(|operand| graph.class(operand).node);
            stack.extend(operands.filter(|operand| !is_open[operand.index()]));
        }
    }
    (classes, reached)
}

/// The classes that use each, and where those of each begin.
fn users(ways: &[Way], of: &[Range<u32>]) -> (Vec<u32>, Vec<usize>) {
    // What uses nothing is counted as well, and left out at the end.
    let mut ends = vec![0; of.len() + 1];
    ways.iter().flat_map(|way| way.operands).for_each(|operand| ends[operand as usize] += 1);
    let mut total = 0;
    for end in &mut ends {
        total += *end;
        *end = total;
    }
    let mut users = vec![0; total];
    for (class, ways_of) in of.iter().enumerate().rev() {
        let ways = &ways[ways_of.start as usize..ways_of.end as usize];
        for operand in ways.iter().flat_map(|way| way.operands) {
            ends[operand as usize] -= 1;
            users[ends[operand as usize]] = class as u32;
        }
    }
    (users, ends)
}

/// What an operation takes; a change of sign takes nothing, as sums take it in.
fn cost(op: Op) -> u32 {
    match op {
        Op::Constant(_) | Op::Symbol(_) | Op::Neg(_) => 0,
        Op::Add(..) | Op::Sub(..) | Op::Mul(..) => 1,
        Op::Div(..) | Op::Call(Function::Sqrt, _) => 4,
        _ => 16,
    }
}
