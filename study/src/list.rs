//! The shipped manipulators.

use abbe::VariableKind;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use serde::Serialize;

use crate::machine::Machine;
use crate::notes::Notes;

/// What is shipped?
#[derive(Clone, Copy, Debug, Default)]
pub struct List;

/// A shipped manipulator.
#[derive(Clone, Debug, Serialize)]
pub struct ShippedManipulator {
    /// What a command is told.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// How many frames it has.
    pub frames: usize,
    /// What each frame does, base to tip: `P` slides, `R` turns, `F` is fixed.
    pub joints: String,
    /// The unit of its lengths.
    pub length: &'static str,
    /// How many error sources it has.
    pub sources: usize,
    /// Whether a study is shipped with it.
    pub study: bool,
}

impl List {
    /// Every shipped manipulator, in the order of their names.
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<ShippedManipulator>, Diagnostics> {
        let described = SHIPPED.iter().map(|shipped| {
            let machine = Machine::shipped(shipped)?;
            Ok(describe(&machine.spec, shipped.study.is_some()))
        });
        described.collect()
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
