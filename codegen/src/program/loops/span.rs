//! Data of the loops.

use abbe_core::Orientation;
use abbe_spec::Spec;

use super::sums::{Sum, Twists};
use crate::chain::Model;
use crate::graph::Node;
use crate::program::routine::{Sums, Table};

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
        let rows = by_source.collect();
        tables.push(Table {
            name: "EFFECT_COLUMNS",
            documentation: "Column of `J_e` and source of every effect.",
            rows,
        });
        let mut terms: Vec<Node> = terms.into_iter().collect();
        if terms.is_empty() {
            // A chain without motion still needs a nonempty array of terms.
            terms.extend(model.transforms.first().map(|first| first.position[0]));
        }
        Self { model, orientation: spec.orientation, motions, joints, parameters, terms, sums, tables }
    }
}
