use std::path::PathBuf;
use std::time::Duration;

use abbe::identify::Loss;
use abbe_study::identify::options::{FOLDS, LOSSES, TERMS};
use abbe_study::identify::{Family, Prior};
use clap::Args;

use super::shared::{Measured, Page, Running, Subject, Writing};
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
    /// Measurements to judge by; nothing is chosen after them
    #[arg(long, value_name = "FILE")]
    pub(crate) test: Option<PathBuf>,
    /// Richer terms to try beside constant errors; those stay that help on rows left out in turn
    #[arg(long, value_parser = named(TERMS), value_delimiter = ',', value_name = "FAMILY,…")]
    pub(crate) terms: Vec<&'static [Family]>,
    /// Gear ratios: errors of a joint so many times per turn of it are tried as well: `--harmonics q2=1,2,101`
    #[arg(long, value_name = "JOINT=N,…")]
    pub(crate) harmonics: Vec<String>,
    /// How long richer terms are tried: `60s`, `5min`; then what comes out depends on the computer. As long as it takes if not
    /// given
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time: Option<Duration>,
    /// A loss that gross errors cannot pull at
    #[arg(long, value_parser = named(LOSSES), default_value = LOSSES.name(Loss::default()))]
    pub(crate) robust: Loss,
    /// How large errors are expected to be, as a share of the arm's length and in rad, 0 for no expectation; `spec`: as its
    /// random sources have them; `auto`: as rows left out in turn fit best
    #[arg(long, value_name = "SHARE", default_value_t)]
    pub(crate) prior: Prior,
    /// Limits for rows that nothing is fitted to, `mean 0.15 mm, max 0.3 mm`: of mean, rms, p95 and max. End with status 1 if
    /// they are not met
    #[arg(long, value_name = "LIMITS")]
    pub(crate) accept: Option<String>,
    /// Into how many parts the rows are dealt, each left out in turn
    #[arg(long, value_name = "N", default_value_t = FOLDS.default, value_parser = whole(FOLDS.range))]
    pub(crate) folds: usize,
    /// Write the spec with the errors found, as repeatable sources; beside it, as FILE.map.toml, the map with where the
    /// machine stands and what is mounted on its tool
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Print all that came out: every error, what acts alike, what is correlated, every line that is written
    #[arg(long, conflicts_with = "json")]
    pub(crate) full: bool,
    #[command(flatten)]
    pub(crate) page: Page,
    #[command(flatten)]
    pub(crate) writing: Writing,
    #[command(flatten)]
    pub(crate) running: Running,
}
