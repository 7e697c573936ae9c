//! Shipped manipulators.

use abbe::VariableKind;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::machine::Machine;
use crate::notes::Notes;

/// Job of `abbe list`: lists the shipped manipulators.
#[derive(Clone, Copy, Debug, Default)]
pub struct List;

/// A shipped manipulator.
#[derive(Clone, Debug, Serialize)]
pub struct ShippedManipulator {
    /// Name to pass to commands.
    pub name: String,
    /// Title for display.
    pub title: String,
    /// Number of frames.
    pub frames: usize,
    /// Joint of each frame, base to tip: `P` prismatic, `R` revolute, `F` fixed.
    pub joints: String,
    /// Symbol of the length unit.
    pub length: &'static str,
    /// Number of error sources.
    pub sources: usize,
    /// Indicates that a study is shipped with it.
    pub study: bool,
}

impl List {
    /// Returns all shipped manipulators, sorted by name.
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<ShippedManipulator>, Diagnostics> {
        let manipulators = SHIPPED.iter().map(|shipped| {
            let machine = Machine::shipped(shipped)?;
            Ok(describe(&machine.spec, shipped.study.is_some()))
        });
        manipulators.collect()
    }
}

fn describe(spec: &Spec, study: bool) -> ShippedManipulator {
    let joints = spec.frames.iter().map(|frame| match frame.variable.map(|i| spec.variables[i].kind) {
        Some(VariableKind::Prismatic) => 'P',
        Some(VariableKind::Revolute) => 'R',
        None => 'F',
    });
    ShippedManipulator {
        name: spec.name.clone(),
        title: spec.title.clone(),
        frames: spec.frames.len(),
        joints: joints.collect(),
        length: spec.length.symbol(),
        sources: spec.sources.len(),
        study,
    }
}
