//! What was gathered over a share of a workspace.

use abbe::lanes::InstructionSet;
use abbe_spec::diagnostic::Diagnostics;
use serde::{Deserialize, Serialize};

use super::question::Question;
use super::shard::Shard;
use crate::analyze::sweep::SweepData;
use crate::finite::finite;
use crate::mistake;
use crate::notes::Notes;

/// What was gathered over a share of a workspace, with the question that it is part of an answer to.
///
/// Draws, budgets at single configurations, the verdict and the comparison with the exact chain follow from where errors are worst:
/// they are made when the parts are merged.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Part {
    pub(super) made_by: Maker,
    pub(super) identity: String,
    pub(super) question: Question,
    pub(super) shard: Shard,
    pub(super) gathered: SweepData,
}

/// On what the last bits of all numbers depend.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Maker {
    pub(super) version: String,
    /// Operating system, processor and instruction set.
    pub(super) machine: String,
}

impl Maker {
    /// This program, on this machine.
    pub(super) fn here() -> Self {
        use std::env::consts::{ARCH, OS};
        let instructions = InstructionSet::best().name();
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            machine: format!("{OS} {ARCH}, {instructions}"),
        }
    }
}

impl Part {
    /// Sweeps a share of the workspace.
    pub fn new(question: Question, shard: Shard, notes: &mut dyn Notes) -> Result<Self, Diagnostics> {
        let job = question.job(&mut ())?;
        let refused = |message| mistake::with_help(&question.spec, message, "ask for fewer draws");
        question.check_draws().map_err(refused)?;
        let identity = question.identity(&job)?;
        let gathered = job.gather(|count| shard.chunks(count), notes)?;
        let origin = job.machine().origin.clone();
        finite(origin, Self { made_by: Maker::here(), identity, question, shard, gathered })
    }

    /// Which share it is.
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// What is asked.
    pub fn question(&self) -> &Question {
        &self.question
    }

    /// How many configurations were reached, and how many were not.
    pub fn configurations(&self) -> [usize; 2] {
        let budget = &self.gathered.budget;
        [budget.configurations(), budget.unreachable()]
    }
}
