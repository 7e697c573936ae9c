//! Differences between transforms: entries as sums of constants and of constants times few terms,
//! the data of the loops.

use std::collections::BTreeMap;

use abbe_core::Orientation;
use abbe_spec::Spec;
use indexmap::IndexSet;

use crate::chain::{LocalTwist, Model};
use crate::graph::{Frame, Graph, Node, Op};
use crate::program::{Sums, Table};

/// Collects sums and tables.
pub(super) struct Sum<'g> {
    graph: &'g Graph,
    /// Terms that are not constant.
    pub(super) terms: IndexSet<Node>,
    pub(super) sums: Vec<Sums>,
    pub(super) tables: Vec<Table>,
}

/// Twists of transforms per unit of symbols.
pub(super) struct Twists {
    /// Number of nonzero twists.
    pub(super) count: usize,
    /// Index of the table with the transform and the column of each twist.
    pub(super) table: usize,
    /// Index of the sums of the entries.
    pub(super) sums: usize,
}

impl<'g> Sum<'g> {
    pub(super) fn new(graph: &'g Graph) -> Self {
        Self { graph, terms: IndexSet::new(), sums: Vec::new(), tables: Vec::new() }
    }

    /// Adds the entries of the identity (for `F_0`) and of all transforms.
    pub(super) fn motions(&mut self, transforms: &[Frame]) -> usize {
        let entries: Vec<Node> = transforms.iter().flat_map(Frame::entries).collect();
        let sums = self.entries("MOTION", &entries);
        let Sums { constants, factors, .. } = &mut self.sums[sums];
        let base = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        constants.splice(0..0, base);
        factors.iter_mut().for_each(|(entry, ..)| *entry += base.len());
        sums
    }

    /// Adds the velocities and rotations per unit of symbols.
    pub(super) fn twists(&mut self, [table, name]: [&'static str; 2], twists: &[LocalTwist]) -> Twists {
        let rows = twists.iter().map(|twist| [twist.transform, twist.column]).collect();
        let documentation = "Transform and column of every nonzero twist.";
        self.tables.push(Table { name: table, documentation, rows });
        let entries: Vec<Node> = twists.iter().flat_map(|twist| twist.twist).collect();
        let sums = self.entries(name, &entries);
        Twists { count: twists.len(), table: self.tables.len() - 1, sums }
    }

    fn entries(&mut self, name: &'static str, entries: &[Node]) -> usize {
        let (mut constants, mut factors) = (Vec::with_capacity(entries.len()), Vec::new());
        for (entry, node) in entries.iter().enumerate() {
            let (mut constant, mut sum) = (0.0, BTreeMap::new());
            self.add(*node, 1.0, &mut constant, &mut sum);
            constants.push(constant);
            factors.extend(sum.into_iter().filter(|(_, k)| *k != 0.0).map(|(term, k)| (entry, term, k)));
        }
        self.sums.push(Sums { name, constants, factors });
        self.sums.len() - 1
    }

    fn add(&mut self, node: Node, factor: f64, constant: &mut f64, sum: &mut BTreeMap<usize, f64>) {
        let term = match self.graph.op(node) {
            Op::Constant(bits) => {
                *constant += factor * f64::from_bits(bits);
                return;
            }
            Op::Neg(a) => return self.add(a, -factor, constant, sum),
            Op::Add(a, b) => {
                self.add(a, factor, constant, sum);
                return self.add(b, factor, constant, sum);
            }
            Op::Sub(a, b) => {
                self.add(a, factor, constant, sum);
                return self.add(b, -factor, constant, sum);
            }
            Op::Mul(a, b) if self.graph.value(a).is_some() => {
                return self.add(b, factor * self.graph.value(a).unwrap_or(f64::NAN), constant, sum);
            }
            Op::Mul(a, b) if self.graph.value(b).is_some() => {
                return self.add(a, factor * self.graph.value(b).unwrap_or(f64::NAN), constant, sum);
            }
            _ => self.terms.insert_full(node).0,
        };
        *sum.entry(term).or_default() += factor;
    }
}

/// Data of the loops, and their tables and sums.
pub(in crate::program) struct FrameLoops<'m> {
    pub(super) model: &'m Model,
    pub(super) orientation: Orientation,
    pub(super) motions: usize,
    pub(super) joints: Twists,
    pub(super) parameters: Twists,
    pub(super) terms: Vec<Node>,
    pub(super) sums: Vec<Sums>,
    pub(super) tables: Vec<Table>,
}

impl<'m> FrameLoops<'m> {
    pub(in crate::program) fn new(spec: &Spec, model: &'m Model) -> Self {
        let mut sum = Sum::new(&model.graph);
        let motions = sum.motions(&model.transforms);
        let joints = sum.twists(["JOINT_TWISTS", "JOINT_TWIST"], &model.joint_local_twists);
        let parameters = sum.twists(["PARAMETER_TWISTS", "PARAMETER_TWIST"], &model.parameter_local_twists);
        let Sum { terms, sums, mut tables, .. } = sum;
        let by_source =
            model.effects.iter().map(|effect| [6 * effect.frame + effect.component as usize, effect.source]);
        let documentation = "Column of `J_e` and source of every effect.";
        tables.push(Table { name: "EFFECT_COLUMNS", documentation, rows: by_source.collect() });
        let mut terms: Vec<Node> = terms.into_iter().collect();
        if terms.is_empty() {
            // A chain without motion still needs a nonempty array of terms.
            terms.extend(model.transforms.first().map(|first| first.position[0]));
        }
        Self { model, orientation: spec.orientation, motions, joints, parameters, terms, sums, tables }
    }
}
