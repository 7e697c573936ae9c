//! Shipped manipulators.

use abbe::VariableKind;
use abbe_manipulators::{MECHANISMS, SHIPPED};
use abbe_spec::Spec;
use serde::Serialize;

use crate::{Machine, Notes, Result};

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
    /// Joint of each frame, base to tip: `P` prismatic, `R` revolute, `F` fixed. With loops, the
    /// commanded joints and the number of loops.
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
    pub fn run(&self, _: &mut dyn Notes) -> Result<Vec<ShippedManipulator>> {
        let names = SHIPPED.iter().map(|shipped| shipped.name).chain(MECHANISMS.iter().map(|one| one.0));
        let mut listed = Vec::new();
        for name in names {
            let Some(Machine { spec, shipped, .. }) = Machine::named(name)? else { continue };
            listed.push(describe(&spec, shipped.is_some_and(|shipped| shipped.study.is_some())));
        }
        listed.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(listed)
    }
}

fn describe(spec: &Spec, study: bool) -> ShippedManipulator {
    let letter = |variable: Option<usize>| match variable.map(|i| spec.variables[i].kind) {
        Some(VariableKind::Prismatic) => 'P',
        Some(VariableKind::Revolute) => 'R',
        None => 'F',
    };
    let joints = match spec.loops.len() {
        0 => spec.frames.iter().map(|frame| letter(frame.variable)).collect(),
        loops => {
            let commanded: String = (0..spec.variables.len()).map(|i| letter(Some(i))).collect();
            format!("{commanded}, {loops} loops")
        }
    };
    ShippedManipulator {
        name: spec.name.clone(),
        title: spec.title.clone(),
        frames: spec.frames.len(),
        joints,
        length: spec.length.symbol(),
        sources: spec.sources.len(),
        study,
    }
}
