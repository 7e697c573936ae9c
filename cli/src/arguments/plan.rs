use std::path::PathBuf;

use abbe::identify::Criterion;
use abbe_study::plan::options::{CANDIDATES, COUNT, CRITERIA, CRITERION};
use clap::Args;

use super::shared::{Running, Subject, Writing};
use super::values::{named, whole};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe plan pps --map pps --sets pps
  abbe plan ur5 --map ur5 --optimal 30 --out plan.csv
"))]
pub(crate) struct Plan {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// What the columns will be: a map (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Sets of configurations: a plan file (TOML), or the name of a shipped one
    #[arg(long, value_name = "FILE", conflicts_with = "optimal")]
    pub(crate) sets: Option<PathBuf>,
    /// The N configurations that tell most
    #[arg(long, value_name = "N", value_parser = whole(COUNT.range))]
    pub(crate) optimal: Option<usize>,
    /// What is best: the smallest mean variance of the tool point where the machine is used, or the largest determinant of
    /// the information
    #[arg(long, value_parser = named(CRITERIA), default_value = CRITERIA.name(CRITERION))]
    pub(crate) criterion: Criterion,
    /// From how many samples within the limits these are chosen
    #[arg(long, value_name = "N", default_value_t = CANDIDATES.default, value_parser = whole(CANDIDATES.range))]
    pub(crate) candidates: usize,
    /// Seed of the samples: random ones. If not given they are spread evenly
    #[arg(long, value_name = "S", conflicts_with = "sets")]
    pub(crate) seed: Option<u64>,
    /// What the identified model leaves of the tool point by itself, beside the instrument's noise: the root mean square of its
    /// distance in an earlier fit
    #[arg(long, value_name = "LENGTH", default_value = "0mm", allow_hyphen_values = true)]
    pub(crate) model_error: String,
    /// Where the machine is to be used: the workspace of this study. If not given: that of the study beside the spec
    /// (arm.study.toml), or of the one shipped with the manipulator, or else joint samples
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Write the configurations: a CSV file to be completed by measuring
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
