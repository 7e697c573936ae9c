//! `abbe export`: writes the errors of a machine to files that controllers and other programs load.

use std::path::PathBuf;

use abbe_report::views;
use abbe_study::export;
use abbe_study::export::{Ends, FORMATS, Format, FormatMismatch, SAMPLES, SAMPLES_RANGE};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, ValueHint};

use crate::arguments::{Showing, Subject, Writing, whole};
use crate::{Console, Failure, Outcome, Outputs, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe export found.toml --to dh -o found.dh.csv
  abbe export calibrated.toml --to urdf --from robot.urdf -o calibrated.urdf
  abbe export ur5 --to ur-calibration -o calibration.yaml
  abbe export machine3 --to isg-csv --set temperature_rise=3K -o volcomp.csv
  abbe export machine3 --to linuxcnc --nodes 61 -o comp
  abbe export machine3 --to linuxcnc-matrixkins -o comp
  abbe export hexapod --to linuxcnc-genhexkins -o genhexkins.hal
  abbe export hexapod --to urdf -o urdf
  abbe export machine3 --to table --nodes 11 -o corrections.csv
"))]
pub(crate) struct Export {
    #[command(flatten)]
    subject: Subject,
    /// File format to write
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    to: String,
    /// URDF file of the nominal robot, for `--to urdf`: the output is a copy of it with corrected
    /// joint origins. [default: a URDF of the frames of the spec]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    from: Option<PathBuf>,
    /// Link of the URDF file whose frame is F_0. [default: the root link]
    #[arg(long, value_name = "LINK", requires = "from")]
    base: Option<String>,
    /// Link of the URDF file whose frame is the tool point. [default: the last link, if there is
    /// only one]
    #[arg(long, value_name = "LINK", requires = "from")]
    tip: Option<String>,
    /// Number of table nodes per axis or joint. [default: 101 per axis; about 10,000 nodes in all
    /// for `--to table`]
    #[arg(long, value_name = "N", value_parser = whole(Format::NODES_RANGE))]
    nodes: Option<usize>,
    /// Write to this file instead of stdout; formats of several files write into this folder
    #[arg(long, short, value_name = "PATH", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
    /// Number of random configurations at which the remaining errors are evaluated
    #[arg(long, value_name = "N", default_value_t = SAMPLES, value_parser = whole(SAMPLES_RANGE))]
    samples: usize,
    /// Seed of the random configurations
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    writing: Writing,
    #[command(flatten)]
    showing: Showing,
}

/// Returns a parser of the names of formats. Help lists them.
fn formats() -> PossibleValuesParser {
    FORMATS.map(|format| PossibleValue::new(format.name).help(format.title)).into()
}

impl Export {
    /// Returns the output format with its options.
    pub(crate) fn format(&self) -> Result<Format> {
        let Self { to, from, base, tip, nodes, .. } = self;
        let ends = Ends { base: base.clone(), tip: tip.clone() };
        Format::choose(to, from.clone(), ends, *nodes).map_err(|unfit| {
            let needless = |option: &str| {
                let message = format!("`{option}` has no effect on `--to {to}`");
                Failure::new(option, message).help(format!("leave `{option}` out"))
            };
            match unfit {
                FormatMismatch::NeedlessNodes => needless("--nodes"),
                FormatMismatch::NeedlessRobot | FormatMismatch::Unknown => needless("--from"),
            }
        })
    }
}

pub(crate) fn run(arguments: &Export) -> Result<Outcome> {
    let Export { subject, out, samples, seed, writing, showing, .. } = arguments;
    let format = arguments.format()?;
    let job = export::Export { machine: subject.machine()?, format, samples: *samples, seed: *seed };
    let mut outputs = Outputs::new(&job, writing.force);
    let report = job.run(&mut Console::default())?;
    let paths = match (out, &report.files[..]) {
        (None, _) if showing.json => Vec::new(),
        (None, [_]) => vec![PathBuf::from("-")],
        (None, several) => {
            let message = format!("this format consists of {} files", several.len());
            return Err(Failure::new("--to", message).help("give a folder: `-o DIR`"));
        }
        (Some(file), [_]) => vec![file.clone()],
        (Some(folder), several) => {
            outputs.folder(folder)?;
            several.iter().map(|file| folder.join(&file.name)).collect()
        }
    };
    let texts = report.files.iter().map(|file| &file.text);
    let printed = outputs.write(paths.iter().cloned().zip(texts))?;
    let next = "--full lists all differences and what the format cannot store";
    let mut text = showing.answer(&report, views::exported(&report), next)?;
    if out.is_some() && !showing.json {
        text += &paths.iter().map(|path| format!("\nWritten to {}.\n", path.display())).collect::<String>();
    }
    Ok(Outcome::passed(text).beside(printed))
}
