//! `abbe plan`: plans measurements, and predicts the uncertainty of the errors that they identify.

use std::path::PathBuf;

use abbe::identify::Criterion;
use abbe_metrology::data::Map;
use abbe_metrology::plan::options::{CANDIDATES, COUNT, CRITERIA, CRITERION};
use abbe_metrology::plan::{self, Choice, Sets};
use abbe_report::views;
use clap::Args;

use crate::arguments::{Common, Subject, length, named, study, whole};
use crate::{Console, Outcome, Outputs, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe plan pps --map pps --sets pps
  abbe plan ur5 --map ur5 --optimal 30 --out plan.csv
"))]
pub(crate) struct Plan {
    #[command(flatten)]
    subject: Subject,
    /// Map (TOML) that describes the columns of the measurements, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    /// Plan file (TOML) with sets of configurations to evaluate, or to choose from with --optimal;
    /// or name of a shipped plan
    #[arg(long, value_name = "FILE")]
    sets: Option<PathBuf>,
    /// Number of configurations to choose
    #[arg(long, value_name = "N", value_parser = whole(COUNT.range))]
    optimal: Option<usize>,
    /// Optimality criterion: the smallest mean variance of the tool point over the workspace, or
    /// the largest determinant of the information matrix
    #[arg(long, value_parser = named(CRITERIA), default_value = CRITERIA.name(CRITERION))]
    criterion: Criterion,
    /// Number of candidate configurations, sampled within the limits
    #[arg(long, value_name = "N", conflicts_with = "sets", default_value_t = CANDIDATES.default, value_parser = whole(CANDIDATES.range))]
    candidates: usize,
    /// Seed of random candidates. [default: evenly distributed candidates]
    #[arg(long, value_name = "S", conflicts_with = "sets")]
    seed: Option<u64>,
    /// Model error at the tool point, in addition to the noise of the instrument: the root mean
    /// square of the distances that an earlier fit left
    #[arg(long, value_name = "LENGTH", default_value = "0mm", allow_hyphen_values = true)]
    model_error: String,
    /// Study file (TOML) whose workspace is where the machine will be used. [default:
    /// arm.study.toml beside the spec arm.toml, or the study shipped with the manipulator, or joint
    /// samples]
    #[arg(long, value_name = "FILE")]
    study: Option<PathBuf>,
    /// Write the chosen configurations to this CSV file, with empty columns for the measurements
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    common: Common,
}

pub(crate) fn run(arguments: &Plan) -> Result<Outcome> {
    arguments.common.running.start()?;
    let machine = arguments.subject.machine()?;
    let map = Map::find(&arguments.map, &machine.spec)?;
    let sets = arguments.sets.as_deref().map(|file| Sets::find(file, &machine.spec)).transpose()?;
    let choice = Choice::new(sets, arguments.optimal, arguments.criterion, arguments.candidates);
    let model_error = length("--model-error", &arguments.model_error, &machine.spec)?;
    let study = study(arguments.study.as_deref(), &[], &machine)?;
    let job = plan::Plan { machine, map, choice, study, model_error, seed: arguments.seed };
    let mut outputs = Outputs::new(&job, arguments.common.writing.force);
    let out = outputs.wanted(arguments.out.as_deref())?;
    let report = job.run(&mut Console::default())?;
    let out = out.map(|file| file.fill(&report.table(&job.map).csv())).transpose()?;
    let printed = outputs.finish(out)?;
    let next = match &arguments.out {
        None => "--out FILE writes the configurations, --full lists indistinguishable errors",
        Some(_) => "--full lists indistinguishable errors",
    };
    let is_json = arguments.common.showing.json;
    let document = views::plan(&job.machine.spec, &job.map, &report);
    let mut text = arguments.common.showing.answer(&report, document, next)?;
    if let (Some(file), false) = (&arguments.out, is_json) {
        text += &format!("Written to {}.\n", file.display());
    }
    Ok(Outcome::passed(text).beside(printed))
}
