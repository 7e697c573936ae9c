use std::path::PathBuf;

use abbe_study::export::{Format, SAMPLES, SAMPLES_RANGE};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueHint};

use super::shared::{Subject, Writing};
use super::values::whole;
use crate::failure::Failure;

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe export found.toml --to dh -o found.dh.csv
  abbe export calibrated.toml --to urdf --from robot.urdf -o calibrated.urdf
  abbe export ur5 --to ur-calibration -o calibration.yaml
  abbe export machine3 --to isg-csv --set temperature_rise=3K -o volcomp.csv
  abbe export machine3 --to linuxcnc --nodes 61 -o comp
  abbe export machine3 --to table --nodes 11 -o corrections.csv
"))]
pub(crate) struct Export {
    #[command(flatten)]
    pub(crate) subject: Subject,
    /// What is to be written
    #[arg(long, value_name = "FORMAT", value_parser = PossibleValuesParser::new(Format::NAMES))]
    to: String,
    /// The URDF file of the nominal robot, for `--to urdf`: a copy is written in which the origins of joints are changed
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    from: Option<PathBuf>,
    /// The link of that file whose frame is F_0. The root if not given
    #[arg(long, value_name = "LINK", requires = "from")]
    base: Option<String>,
    /// The link of that file whose frame is the tool point. The last link, if there is only one
    #[arg(long, value_name = "LINK", requires = "from")]
    tip: Option<String>,
    /// How many values of each axis or joint a table has. If not given, 101 of an axis, and about 10,000 of all joints together
    #[arg(long, value_name = "N", value_parser = whole(Format::NODES_RANGE))]
    nodes: Option<usize>,
    /// Write to this file instead of stdout; several files, to this folder
    #[arg(long, short, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    pub(crate) out: Option<PathBuf>,
    /// Over how many random configurations the differences are taken
    #[arg(long, value_name = "N", default_value_t = SAMPLES, value_parser = whole(SAMPLES_RANGE))]
    pub(crate) samples: usize,
    /// Of these configurations
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) writing: Writing,
    /// Print JSON
    #[arg(long, display_order = 111)]
    pub(crate) json: bool,
}

impl Export {
    /// What is to be written, and from what.
    pub(crate) fn format(&self) -> Result<Format, Failure> {
        let Self { to, from, base, tip, nodes, .. } = self;
        let of_axis = nodes.unwrap_or(Format::NODES);
        let has_nodes = Format::WITH_NODES.contains(&to.as_str());
        if nodes.is_some() && !has_nodes {
            let failure = Failure::of("--nodes", format!("`--to {to}` has no nodes"));
            return Err(failure.help("leave `--nodes` out"));
        }
        match (to.as_str(), from) {
            ("urdf", Some(file)) => {
                Ok(Format::Urdf { file: file.clone(), base: base.clone(), tip: tip.clone() })
            }
            ("urdf", None) => {
                let failure = Failure::of("--to urdf", "the URDF file of the nominal robot is not given");
                Err(failure.help("name it: `--from robot.urdf`"))
            }
            (_, Some(_)) => {
                let failure = Failure::of("--from", format!("`--to {to}` is made of the spec alone"));
                Err(failure.help("leave `--from` out"))
            }
            ("ur-calibration", None) => Ok(Format::UrCalibration),
            ("isg-csv", None) => Ok(Format::IsgCsv { nodes: of_axis }),
            ("linuxcnc", None) => Ok(Format::LinuxCnc { nodes: of_axis }),
            ("table", None) => Ok(Format::Table { nodes: *nodes }),
            _ => Ok(Format::Dh),
        }
    }
}
