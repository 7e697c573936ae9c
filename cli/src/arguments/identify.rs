use std::path::PathBuf;
use std::time::Duration;

use abbe::identify::Loss;
use abbe_metrology::identify::options::{FOLDS, LOSSES, TERMS};
use abbe_metrology::identify::{Family, Prior};
use clap::Args;

use super::shared::{Measured, Page, Running, Showing, Subject, Writing};
use super::values::{duration, named, whole};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe identify ur5 data.csv --map ur5 --test test.csv
  abbe identify ur5 data.csv --map ur5 --terms joint,load --time 60s --out found.toml
  abbe identify ur5 data.csv --map ur5 --full
", "--accept, or the map's `accept`, is not met"))]
pub(crate) struct Identify {
    #[command(flatten)]
    pub(crate) subject: Subject,
    #[command(flatten)]
    pub(crate) measured: Measured,
    /// Test data: a CSV file of measurements that is used for validation only, never for fitting or
    /// model selection
    #[arg(long, value_name = "FILE")]
    pub(crate) test: Option<PathBuf>,
    /// Families of additional error terms to try besides constant errors; a term is kept if it
    /// lowers the cross-validation error
    #[arg(long, value_parser = named(TERMS), value_delimiter = ',', value_name = "FAMILY,…")]
    pub(crate) terms: Vec<&'static [Family]>,
    /// Cycles per turn of a revolute joint at which to try periodic errors, such as gear ratios:
    /// `--harmonics q2=1,2,101`
    #[arg(long, value_name = "JOINT=N,…")]
    pub(crate) harmonics: Vec<String>,
    /// Time limit for the search for additional terms (`60s`, `5min`, `1h`); the result then
    /// depends on the speed of the computer. [default: none]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    /// Robust loss, which down-weights outliers
    #[arg(long, value_parser = named(LOSSES), default_value = LOSSES.name(Loss::default()))]
    pub(crate) robust: Loss,
    /// Prior standard deviation of the errors, relative to the length of the arm for offsets and in
    /// rad for angles: a number (0 for no prior), `spec` for the spec's random sources, or `auto`
    /// for the value chosen by cross-validation
    #[arg(long, value_name = "SHARE", default_value_t)]
    pub(crate) prior: Prior,
    /// Acceptance limits on mean, rms, p95 and max of the position error on data that nothing was
    /// fitted to: `mean 0.15 mm, max 0.3 mm`. Exit with status 1 if they are not met
    #[arg(long, value_name = "LIMITS")]
    pub(crate) accept: Option<String>,
    /// Number of folds of the cross-validation
    #[arg(long, value_name = "N", default_value_t = FOLDS.default, value_parser = whole(FOLDS.range))]
    pub(crate) folds: usize,
    /// Write the spec with the identified errors as repeatable sources to this file, and beside it,
    /// as FILE.map.toml, the map with the identified station and targets
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) showing: Showing,
    #[command(flatten)]
    pub(crate) page: Page,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
