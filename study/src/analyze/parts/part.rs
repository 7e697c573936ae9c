//! Data gathered over a share of a workspace.
//!
//! File format of parts, described in `docs/scale.md`.

use std::path::Path;

use abbe::lanes::InstructionSet;
use abbe_spec::bounded::{Bounded, Contents, UnreadableFile};
use abbe_spec::option::SHARD;
use serde::{Deserialize, Serialize};

use super::request::{self, AnalysisRequest};
use super::shard::Shard;
use crate::{Notes, Result, analyze::sweep::PartialAnalysis, finite, hash, mistake};

/// Prefix of each part file, followed by the format version.
const BEGINNING: &str = "abbe part ";
const VERSION: &str = "4";
/// Largest number of a part.
const LARGEST: f64 = 1e100;

/// Length of the checksum line at the end, newline included.
const CHECKSUM: usize = 65;
/// Largest file that is read, in bytes.
const LONGEST: u64 = 1 << 30;

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
    pub fn new(request: AnalysisRequest, shard: Shard, notes: &mut dyn Notes) -> Result<Self> {
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

    /// Returns the file content, three lines: the format version, the part as JSON, and the SHA-256
    /// of both.
    pub fn to_bytes(&self) -> Vec<u8> {
        // Infallible: numbers are finite, and map keys are integers.
        let json = serde_json::to_string(self).expect("expected a part, which is a JSON file");
        let content = format!("{BEGINNING}{VERSION}\n{json}\n");
        let checksum = hash::text(&content);
        format!("{content}{checksum}\n").into_bytes()
    }

    /// Parses the output of [`to_bytes`](Self::to_bytes). Mistakes are reported under `name`.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self> {
        let wrong = |message: &str, help: &str| mistake::with_help(name, message, help);
        let Some(rest) = bytes.strip_prefix(BEGINNING.as_bytes()) else {
            return Err(wrong("this is not a part of an analysis", &format!("`{SHARD}` writes one")));
        };
        let damaged =
            || wrong("this part is damaged: its checksum differs", "create it again, or copy it again");
        let end = rest.iter().take(20).position(|byte| *byte == b'\n').ok_or_else(damaged)?;
        if &rest[..end] != VERSION.as_bytes() {
            let version = String::from_utf8_lossy(&rest[..end]);
            let message =
                format!("this part has the format {version}, but this version of abbe reads {VERSION}");
            return Err(wrong(&message, "use one version of abbe for all parts and for the merge"));
        }
        let text = std::str::from_utf8(bytes).map_err(|_| damaged())?;
        let (content, checksum) = text
            .len()
            .checked_sub(CHECKSUM)
            .and_then(|end| text.split_at_checked(end))
            .ok_or_else(damaged)?;
        if hash::text(content) + "\n" != checksum {
            return Err(damaged());
        }
        let json = &content[BEGINNING.len() + end + 1..];
        // Sums of errors overflow beyond this, and no machine has such errors.
        let is_large = |word: &&str| word.parse::<f64>().is_ok_and(|number| number.abs() > LARGEST);
        if let Some(number) = json.split([',', ':', '[', ']', '{', '}']).find(is_large) {
            return Err(wrong(&format!("this part has the impossible number {number}"), "create it again"));
        }
        let part: Result<Self, String> = serde_json::from_str(json).map_err(|error| error.to_string());
        part.and_then(|part| part.request.check_draws().map(|()| part)).map_err(|message| {
            wrong(
                &format!("this part has content that this version of abbe does not write: {message}"),
                "create it again; use one version of abbe for all parts and for the merge",
            )
        })
    }

    /// Reads a part file.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = Bounded::read_all(path, LONGEST).map_err(|error| {
            UnreadableFile::diagnostics(path.display(), &error, "give the path of a part")
        })?;
        Self::from_bytes(&path.display().to_string(), &bytes)
    }
}
