use std::path::PathBuf;

use abbe::identify::Criterion;
use abbe_metrology::plan::options::{CANDIDATES, COUNT, CRITERIA, CRITERION};
use clap::Args;

use super::shared::{Running, Showing, Subject, Writing};
use super::values::{named, whole};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe plan pps --map pps --sets pps
  abbe plan ur5 --map ur5 --optimal 30 --out plan.csv
"))]
pub(crate) struct Plan {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// Map (TOML) that describes the columns of the measurements, or name of a shipped map
    #[arg(long, value_name = "FILE")]
    pub(crate) map: PathBuf,
    /// Plan file (TOML) with sets of configurations to evaluate, or name of a shipped plan
    #[arg(long, value_name = "FILE", conflicts_with = "optimal")]
    pub(crate) sets: Option<PathBuf>,
    /// Number of configurations to choose
    #[arg(long, value_name = "N", value_parser = whole(COUNT.range))]
    pub(crate) optimal: Option<usize>,
    /// Optimality criterion: the smallest mean variance of the tool point over the workspace, or
    /// the largest determinant of the information matrix
    #[arg(long, value_parser = named(CRITERIA), default_value = CRITERIA.name(CRITERION))]
    pub(crate) criterion: Criterion,
    /// Number of candidate configurations, sampled within the limits
    #[arg(long, value_name = "N", default_value_t = CANDIDATES.default, value_parser = whole(CANDIDATES.range))]
    pub(crate) candidates: usize,
    /// Seed of random candidates. [default: evenly distributed candidates]
    #[arg(long, value_name = "S", conflicts_with = "sets")]
    pub(crate) seed: Option<u64>,
    /// Model error at the tool point, in addition to the noise of the instrument: the root mean
    /// square of the distances that an earlier fit left
    #[arg(long, value_name = "LENGTH", default_value = "0mm", allow_hyphen_values = true)]
    pub(crate) model_error: String,
    /// Study file (TOML) whose workspace is where the machine will be used. [default:
    /// arm.study.toml beside the spec arm.toml, or the study shipped with the manipulator, or joint
    /// samples]
    #[arg(long, value_name = "FILE")]
    pub(crate) study: Option<PathBuf>,
    /// Write the chosen configurations to this CSV file, with empty columns for the measurements
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) running: Running,
}
