//! Merges parts.

use abbe_spec::option::{DISABLE, ENABLE, SCALE, SET, SHARD_NUMBER, shard_command};
use std::sync::Arc;

use super::part::{Build, Part};
use super::shard::Shard;
use crate::analyze::{Analyze, Report};
use crate::{Notes, Result, mistake};

/// All parts of an analysis, with its job.
pub struct Merge {
    job: Analyze,
    /// Name and content of each part, sorted by shard.
    parts: Vec<(String, Part)>,
}

impl Merge {
    /// Checks that the parts are all of one analysis. Each part comes with its name for messages;
    /// their order does not matter. Opens no file: part 1 carries the contents of all tables and
    /// paths.
    pub fn new(parts: Vec<(String, Part)>, notes: &mut dyn Notes) -> Result<Self> {
        let mut parts = sorted_and_complete(parts)?;
        // The remaining computations must agree bit for bit with those of the parts.
        for (name, Part { made_by: Build { version, machine }, .. }) in parts.iter().take(1) {
            let here = Build::current();
            if (version, machine) != (&here.version, &here.machine) {
                let message = format!(
                    "this part was created by abbe {version} on {machine}; this is abbe {} on {}",
                    here.version, here.machine
                );
                let help = "merge with the same version of abbe on the same kind of machine";
                return Err(mistake::with_help(name, message, help));
            }
        }
        let Some((name, first)) = parts.first_mut() else {
            return Err(mistake::with_help("merge", "no part is given", "give all parts of one analysis"));
        };
        let contents = Arc::new(std::mem::take(&mut first.files));
        let job = first.request.job_from(Some(&contents), notes)?;
        if first.request.identity(&job, Some(&contents))? != first.identity {
            let message = "the files that this part carries are not those that it was created from";
            return Err(mistake::with_help(name, message, "create it again"));
        }
        Ok(Self { job, parts })
    }

    /// Returns the job of the analysis.
    pub fn job(&self) -> &Analyze {
        &self.job
    }

    /// Returns the study as an option names it: its file, or its name if it is shipped; `None` for
    /// that of the machine.
    pub fn study(&self) -> Option<String> {
        let (_, first) = self.parts.first()?;
        let study = first.request.study.as_ref()?;
        let shipped = study.name.strip_prefix("studies/").and_then(|name| name.strip_suffix(".toml"));
        Some(shipped.filter(|_| study.folder.is_none()).unwrap_or(&study.name).to_owned())
    }

    /// Returns the report, byte for byte that of a single run.
    pub fn report(self, notes: &mut dyn Notes) -> Result<Report> {
        let named = self.parts.into_iter().map(|(name, part)| (name, part.shard, part.gathered));
        self.job.report_on_parts(named.collect(), notes)
    }
}

/// Sorts the parts by shard, and checks that they are one analysis, complete and without
/// duplicates.
fn sorted_and_complete(mut parts: Vec<(String, Part)>) -> Result<Vec<(String, Part)>> {
    parts.sort_by_key(|(_, part)| part.shard);
    let Some((first_name, first)) = parts.first() else { return Ok(parts) };
    let Build { version, machine } = &first.made_by;
    for (name, part) in &parts {
        let Build { version: other, machine: another } = &part.made_by;
        let (message, help) = if other != version {
            let message =
                format!("this part was created by abbe {other}, but {first_name} by abbe {version}");
            (message, "use one version of abbe for all parts and for the merge".to_owned())
        } else if another != machine {
            let message = format!(
                "this part was created on {another}, but {first_name} on {machine}: the \
                    last digits differ"
            );
            (message, "create all parts on machines of one kind".to_owned())
        } else if part.identity != first.identity {
            let message = format!(
                "this part and {first_name} belong to different analyses: {}",
                difference(first, part)
            );
            (message, "merge the parts of one spec, one study and the same options".to_owned())
        } else if part.shard.count() != first.shard.count() {
            let [one, other] = [first.shard.count(), part.shard.count()];
            let message = format!("this is one of {other} parts, but {first_name} is one of {one}");
            (message, format!("merge the parts of one division: use the same N in `{SHARD_NUMBER}`"))
        } else {
            continue;
        };
        return Err(mistake::with_help(name, message, help));
    }
    for ((one, a), (other, b)) in parts.iter().zip(parts.iter().skip(1)) {
        if a.shard == b.shard {
            let message = format!("this is part {}, and so is {one}", b.shard);
            return Err(mistake::with_help(other, message, "give every part once"));
        }
    }
    let count = first.shard.count();
    let missing = (1..=count)
        .filter(|number| parts.binary_search_by_key(number, |(_, part)| part.shard.number()).is_err());
    let missing = missing.filter_map(|number| Shard::new(number, count).ok()).collect::<Vec<_>>();
    if let Some(shard) = missing.first() {
        let shown = missing.iter().take(5).map(Shard::to_string).collect::<Vec<_>>().join(", ");
        let more = if missing.len() > 5 { format!(" and {} more", missing.len() - 5) } else { String::new() };
        let is = if missing.len() == 1 { "part" } else { "parts" };
        let message = format!("missing: {is} {shown}{more}");
        let help = format!(
            "create it: `{}`, with the same options",
            shard_command(&first.request.spec, shard.number(), shard.count())
        );
        return Err(mistake::with_help("merge", message, help));
    }
    Ok(parts)
}

/// Describes the first difference between two questions.
fn difference(one: &Part, other: &Part) -> String {
    let (a, b) = (&one.request, &other.request);
    let text = |file: &Option<super::FileText>| file.as_ref().map(|file| file.text.clone());
    let difference = if a.spec_text.is_none() && b.spec_text.is_none() && a.spec != b.spec
        || text(&a.spec_text) != text(&b.spec_text)
    {
        "the specs differ"
    } else if text(&a.study) != text(&b.study) {
        "the studies differ"
    } else if a.tolerances != b.tolerances {
        "the tolerances differ"
    } else if a.changes != b.changes {
        return format!("the changes by {SET}, {ENABLE}, {DISABLE} or {SCALE} differ");
    } else if a.seed != b.seed {
        "the seeds differ"
    } else if a.monte_carlo != b.monte_carlo {
        "the numbers of draws differ"
    } else if a.figures != b.figures {
        "one was created with figures, the other without"
    } else if a.interpret != b.interpret {
        "one was computed by the interpreter, the other by generated code"
    } else {
        "other input files differ"
    };
    difference.to_owned()
}
