//! `abbe list`: the shipped manipulators.

use abbe_codegen::spec::{Spec, VariableKind};
use abbe_manipulators::SHIPPED;
use serde::Serialize;

use crate::arguments::List;
use crate::failure::Failure;
use crate::output::{Outcome, json};
use crate::table::Table;
use abbe_study::Machine;

#[derive(Serialize)]
struct Line {
    name: String,
    title: String,
    frames: usize,
    joints: String,
    length: &'static str,
    sources: usize,
    study: bool,
}

pub(crate) fn run(arguments: &List) -> Result<Outcome, Failure> {
    let mut lines = Vec::new();
    for shipped in SHIPPED {
        let found = Machine::shipped(shipped)?;
        lines.push(line(&found.spec, shipped.study.is_some()));
    }
    if arguments.json {
        return Ok(Outcome::passed(json(&lines)?));
    }
    let mut table = Table::new(&["name", "manipulator", "joints", "unit", "sources", "study"]);
    for line in lines {
        let study = if line.study { "yes" } else { "" };
        table.row([
            line.name,
            line.title,
            line.joints,
            line.length.into(),
            line.sources.to_string(),
            study.into(),
        ]);
    }
    Ok(Outcome::passed(table.right(&[4]).to_string()))
}

fn line(spec: &Spec, study: bool) -> Line {
    // PPPRRR: what each frame does, base to tip; a fixed one is F.
    let joints = spec.frames.iter().map(|frame| match frame.variable.map(|i| spec.variables[i].kind) {
        Some(VariableKind::Prismatic) => 'P',
        Some(VariableKind::Revolute) => 'R',
        None => 'F',
    });
    Line {
        name: spec.name.clone(),
        title: spec.title.clone(),
        frames: spec.frames.len(),
        joints: joints.collect(),
        length: spec.length.symbol(),
        sources: spec.sources.len(),
        study,
    }
}
