//! Data gathered over a share of a workspace.

use abbe::lanes::InstructionSet;
use abbe_spec::bounded::Contents;
use abbe_spec::diagnostic::Diagnostics;
use serde::{Deserialize, Serialize};

use super::request::{self, AnalysisRequest};
use super::shard::Shard;
use crate::analyze::sweep::PartialAnalysis;
use crate::finite::finite;
use crate::mistake;
use crate::notes::Notes;

/// Data gathered over a share of a workspace, with the question that they belong to.
///
/// Monte Carlo draws, uncertainty budgets, verdicts and the comparison with the exact chain need
/// the worst configurations. They are computed when the parts are merged.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Part {
    pub(super) made_by: Build,
    pub(super) identity: String,
    pub(super) request: AnalysisRequest,
    /// Contents of the tables and paths, in part 1 alone: a merge opens no file that a part names.
    pub(super) files: Contents,
    pub(super) shard: Shard,
    pub(super) gathered: PartialAnalysis,
}

/// Program version and machine, on which the last bits of all results depend.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Build {
    pub(super) version: String,
    /// Operating system, processor and instruction set.
    pub(super) machine: String,
}

impl Build {
    /// Returns the version and machine of this process.
    pub(super) fn current() -> Self {
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
    pub fn new(request: AnalysisRequest, shard: Shard, notes: &mut dyn Notes) -> Result<Self, Diagnostics> {
        let job = request.job(&mut ())?;
        let refused = |message| mistake::with_help(&request.spec, message, "choose fewer draws");
        request.check_draws().map_err(refused)?;
        let identity = request.identity(&job, None)?;
        let files = if shard.number() == 1 { request::contents(&job)? } else { Contents::new() };
        let gathered = job.sweep_chunks(|count| shard.chunks(count), notes)?;
        let origin = job.machine().origin.clone();
        finite(origin, Self { made_by: Build::current(), identity, request, files, shard, gathered })
    }

    /// Returns the share that this part covers.
    pub fn shard(&self) -> Shard {
        self.shard
    }

    /// Returns the path of the spec, or the name of the shipped manipulator.
    pub fn spec(&self) -> &str {
        &self.request.spec
    }

    /// Returns the numbers of reached and unreachable configurations.
    pub fn configurations(&self) -> [usize; 2] {
        let budget = &self.gathered.budget;
        [budget.configurations(), budget.unreachable()]
    }
}
