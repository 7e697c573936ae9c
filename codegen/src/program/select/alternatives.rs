//! The classes that outputs may need, and the alternatives for each.

use std::ops::Range;

use abbe_spec::Function;

use crate::graph::{Graph, Node, Op, Signed};

/// One alternative to compute a class.
pub(super) struct Alternative {
    node: Signed,
    /// Cost of its own operation.
    pub(super) cost: u32,
    /// Classes that it uses; [`Alternatives::count`] stands for an absent operand.
    pub(super) operands: [u32; 2],
}

impl Alternative {
    /// Returns the cost for these prices of the operands.
    pub(super) fn price(&self, of: &[u32]) -> u32 {
        let [a, b] = self.operands.map(|operand| of[operand as usize]);
        self.cost + a + b
    }
}

/// The classes of a program, operands before users as far as possible.
pub(super) struct Alternatives {
    /// Index of the class that each node represents.
    pub(super) classes: Vec<Option<u32>>,
    alternatives: Vec<Alternative>,
    of: Vec<Range<u32>>,
    /// Users of each class, concatenated, and the start of each class's users.
    users: Vec<u32>,
    users_of: Vec<usize>,
    /// Classes of the outputs, without duplicates.
    pub(super) outputs: Vec<u32>,
}

impl Alternatives {
    pub(super) fn new(graph: &Graph, outputs: &[Node]) -> Self {
        let firsts: Vec<Node> = outputs.iter().map(|output| graph.class(*output).node).collect();
        let (classes, reached) = reached(graph, firsts.clone());
        let number = |node: Node| classes[node.index()].expect("it was reached");
        let mut alternatives = Vec::with_capacity(2 * reached.len());
        let mut of = Vec::with_capacity(reached.len());
        for first in &reached {
            let start = alternatives.len() as u32;
            for node in graph.equal(*first) {
                let op = graph.op(node.node);
                let mut operands = [reached.len() as u32; 2];
                for (place, operand) in operands.iter_mut().zip(op.operands()) {
                    *place = number(graph.class(operand).node);
                }
                alternatives.push(Alternative { node, cost: cost(op), operands });
            }
            of.push(start..alternatives.len() as u32);
        }
        let mut is_known = vec![false; reached.len()];
        let is_new = |class: &u32| !std::mem::replace(&mut is_known[*class as usize], true);
        let outputs = firsts.into_iter().map(number).filter(is_new).collect();
        let (users, users_of) = users(&alternatives, &of);
        Self { classes, alternatives, of, users, users_of, outputs }
    }

    /// Returns the number of classes.
    pub(super) fn count(&self) -> usize {
        self.of.len()
    }

    pub(super) fn alternative(&self, alternative: u32) -> &Alternative {
        &self.alternatives[alternative as usize]
    }

    /// Returns the node that an alternative computes.
    pub(super) fn node(&self, alternative: u32) -> Signed {
        self.alternative(alternative).node
    }

    /// Returns the indices of a class's alternatives.
    pub(super) fn of_class(&self, class: u32) -> Range<u32> {
        self.of[class as usize].clone()
    }

    /// Returns the alternatives of a class.
    pub(super) fn list(&self, class: u32) -> &[Alternative] {
        let Range { start, end } = self.of[class as usize];
        &self.alternatives[start as usize..end as usize]
    }

    /// Returns the classes with an alternative that uses a class.
    pub(super) fn users(&self, class: u32) -> &[u32] {
        &self.users[self.users_of[class as usize]..self.users_of[class as usize + 1]]
    }

    /// Returns the classes that an alternative uses.
    pub(super) fn operands(&self, alternative: u32) -> impl Iterator<Item = u32> + use<> {
        let nothing = self.count() as u32;
        self.alternative(alternative).operands.into_iter().filter(move |operand| *operand != nothing)
    }

    /// Returns the classes with several alternatives.
    pub(super) fn several(&self) -> Vec<u32> {
        (0..self.count() as u32).filter(|class| self.of_class(*class).len() > 1).collect()
    }

    /// Returns the class of a node and the index of the alternative that computes it, if any.
    pub(super) fn find(&self, graph: &Graph, node: Node) -> Option<(u32, u32)> {
        let class = self.classes[graph.class(node).node.index()]?;
        let node = match graph.op(node) {
            Op::Neg(inner) => inner,
            _ => node,
        };
        Some((class, self.of_class(class).find(|alternative| self.node(*alternative).node == node)?))
    }

    /// Returns, for each class, the alternative that is the node the outputs were built from. If
    /// there are several, it is the oldest one, which comes after all of its operands.
    pub(super) fn as_made(&self, graph: &Graph, outputs: &[Node]) -> Vec<u32> {
        let mut made = vec![false; graph.len()];
        let mut stack = outputs.to_vec();
        while let Some(node) = stack.pop() {
            if !std::mem::replace(&mut made[node.index()], true) {
                stack.extend(graph.op(node).operands());
            }
        }
        let oldest = |alternatives: &Range<u32>| {
            let made = alternatives.clone().filter(|alternative| made[self.node(*alternative).node.index()]);
            made.min_by_key(|alternative| self.node(*alternative).node).unwrap_or(alternatives.start)
        };
        self.of.iter().map(oldest).collect()
    }
}

/// Numbers all classes that the given ones may need.
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

/// Returns the users of each class, concatenated, and the start of each class's users.
fn users(alternatives: &[Alternative], of: &[Range<u32>]) -> (Vec<u32>, Vec<usize>) {
    // Absent operands are counted as well and dropped at the end.
    let mut ends = vec![0; of.len() + 1];
    alternatives
        .iter()
        .flat_map(|alternative| alternative.operands)
        .for_each(|operand| ends[operand as usize] += 1);
    let mut total = 0;
    for end in &mut ends {
        total += *end;
        *end = total;
    }
    let mut users = vec![0; total];
    for (class, alternatives_of) in of.iter().enumerate().rev() {
        let alternatives = &alternatives[alternatives_of.start as usize..alternatives_of.end as usize];
        for operand in alternatives.iter().flat_map(|alternative| alternative.operands) {
            ends[operand as usize] -= 1;
            users[ends[operand as usize]] = class as u32;
        }
    }
    (users, ends)
}

/// Returns the cost of an operation. A negation is free, because sums absorb it.
fn cost(op: Op) -> u32 {
    match op {
        Op::Constant(_) | Op::Symbol(_) | Op::Neg(_) => 0,
        Op::Add(..) | Op::Sub(..) | Op::Mul(..) => 1,
        Op::Div(..) | Op::Call(Function::Sqrt, _) => 4,
        _ => 16,
    }
}
