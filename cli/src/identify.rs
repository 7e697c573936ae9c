//! `abbe identify`: the generalized errors of a real machine, from measurements.

use std::path::{Path, PathBuf};
use std::time::Duration;

use abbe::{VariableKind, identify::Loss};
use abbe_metrology::AcceptanceVerdict;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::options::{FOLDS, LOSSES, ONLY, TERMS};
use abbe_metrology::identify::{self, Family, Harmonics, Prior, Report, Settings};
use abbe_report::text::{Detail, wrapped};
use abbe_report::views;
use abbe_spec::Spec;
use clap::Args;

use crate::arguments::{Measured, Page, Running, Showing, Subject, Writing, duration, named, whole};
use crate::output::{Outcome, Outputs, Pending, note};
use crate::{Console, Failure, Result};

#[derive(Args, Debug)]
#[command(after_help = after_help!(
    "  abbe identify ur5 data.csv --map ur5 --test test.csv
  abbe identify ur5 data.csv --map ur5 --terms joint,load --time 60s --out found.toml
  abbe identify ur5 data.csv --map ur5 --full
", "--accept, or the map's `accept`, is not met"))]
pub(crate) struct Identify {
    #[command(flatten)]
    subject: Subject,
    #[command(flatten)]
    measured: Measured,
    /// Test data: a CSV file of measurements that is used for validation only, never for fitting or
    /// model selection
    #[arg(long, value_name = "FILE")]
    test: Option<PathBuf>,
    /// Fit nothing but this: by itself if there are too few rows for the errors of the machine
    #[arg(long, value_parser = named(ONLY), value_name = "PART", conflicts_with_all = ["terms", "harmonics"])]
    only: Option<bool>,
    /// Families of additional error terms to try besides constant errors; a term is kept if it
    /// lowers the cross-validation error
    #[arg(long, value_parser = named(TERMS), value_delimiter = ',', value_name = "FAMILY,…")]
    terms: Vec<&'static [Family]>,
    /// Cycles per turn of a revolute joint at which to try periodic errors, such as gear ratios:
    /// `--harmonics q2=1,2,101`
    #[arg(long, value_name = "JOINT=N,…")]
    harmonics: Vec<String>,
    /// Time limit for the search for additional terms (`60s`, `5min`, `1h`); the result then
    /// depends on the speed of the computer. [default: none]
    #[arg(long, value_name = "TIME", value_parser = duration)]
    time: Option<Duration>,
    /// Robust loss, which down-weights outliers
    #[arg(long, value_parser = named(LOSSES), default_value = LOSSES.name(Loss::default()))]
    robust: Loss,
    /// Prior standard deviation of the errors, relative to the length of the arm for offsets and in
    /// rad for angles: `auto` for 0.001 times a scale that the data choose, a number (0 holds them
    /// at zero), or `spec` for the spec's random sources. Additional terms have 0.001 at most
    #[arg(long, value_name = "SHARE", default_value_t)]
    prior: Prior,
    /// Acceptance limits on mean, rms, p95 and max of the position error on data that nothing was
    /// fitted to: `mean 0.15 mm, max 0.3 mm`. Exit with status 1 if they are not met
    #[arg(long, value_name = "LIMITS")]
    accept: Option<String>,
    /// Number of folds of the cross-validation
    #[arg(long, value_name = "N", default_value_t = FOLDS.default, value_parser = whole(FOLDS.range))]
    folds: usize,
    /// Write the spec with the identified errors as repeatable sources to this file, and beside it,
    /// as FILE.map.toml, the map with the identified station and targets
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    showing: Showing,
    #[command(flatten)]
    page: Page,
    #[command(flatten)]
    writing: Writing,
    #[command(flatten)]
    running: Running,
}

pub(crate) fn run(arguments: &Identify) -> Result<Outcome> {
    arguments.running.start()?;
    let detail = arguments.showing.detail();
    let mut machine = arguments.subject.as_written()?;
    let changes = arguments.subject.changes.read(&machine.spec)?;
    if arguments.out.is_some() && !changes.is_empty() {
        return Err(Failure::new(
            "--out",
            "the identified spec cannot hold the changes by --set, --enable, --disable and --scale",
        )
        .help("change a copy of the spec instead, and identify that"));
    }
    machine.change(&changes);
    let mut map = Map::find(&arguments.measured.map, &machine.spec)?;
    arguments.page.dated.date(&mut map.record);
    let data = Data::read(&arguments.measured.data, &map)?;
    let test = arguments.test.as_ref().map(|file| Data::read(file, &map)).transpose()?;
    let settings = Settings {
        loss: arguments.robust,
        only_placement: arguments.only.unwrap_or_default(),
        prior: arguments.prior,
        folds: arguments.folds,
        time: arguments.time,
        points: arguments.page.report.is_some(),
    };
    let accept = map.limits("--accept", arguments.accept.as_deref(), &machine.spec)?;
    let harmonics = harmonics(&arguments.harmonics, &machine.spec)?;
    let terms = arguments.terms.concat();
    let mut job = identify::Identify { machine, map, data, test, terms, harmonics, settings, accept };
    let mut outputs = Outputs::new(&job, arguments.writing.force);
    let out = arguments.out.as_deref().map(|file| begin(file, &mut outputs)).transpose()?;
    let page = outputs.wanted(arguments.page.report.as_deref())?;
    let report = job.run_once(&mut Console::default())?;
    let (written, out) = match out {
        None => (None, Vec::new()),
        Some((spec, map, name)) => {
            let [found, found_map, printed] = identified_files(name, &job, &report, detail)?;
            (Some(printed), vec![spec.fill(&found)?, map.fill(&found_map)?])
        }
    };
    let document = || views::identification(&job.machine.spec, &job.map, &report);
    let page = page.map(|file| {
        let test = arguments.test.iter().map(|file| ("test", file));
        let files = [("measurements", &arguments.measured.data)].into_iter().chain(test);
        let (map, residuals) = (Some(&job.map), report.residuals());
        file.fill(&document().measured_page(&job.machine, map, files, residuals, &mut Console::default())?)
    });
    let printed = outputs.finish(out.into_iter().chain(page.transpose()?))?;
    let accepted = report.accepted.as_ref().is_none_or(AcceptanceVerdict::is_met);
    let next = match (&arguments.out, report.found.is_placement) {
        (None, _) => "--out SPEC writes the identified machine, --full lists every error",
        (Some(_), true) => "--full lists every place with its standard deviation",
        (Some(_), false) => "abbe compensate with both files corrects commands, --full lists every error",
    };
    let is_json = arguments.showing.json;
    let mut text = arguments.showing.answer(&report, document(), next)?;
    match is_json {
        true => report.notes.iter().for_each(|line| note(line)),
        false => text.extend(written.map(|written| format!("\n{written}"))),
    }
    Ok(Outcome::checked(text, accepted).beside(printed))
}

/// Begins the spec of the identified machine, and its map beside it.
fn begin<'f>(file: &'f Path, outputs: &mut Outputs) -> Result<(Pending, Pending, &'f Path)> {
    let spec = outputs.file(file)?;
    if !spec.is_file() {
        return Err(Failure::new(
            file.display(),
            "this is not a regular file, so the map cannot be written beside it",
        )
        .help("give the path of a file"));
    }
    Ok((spec, outputs.file(&map_file(file))?, file))
}

/// Returns the path of the map that belongs to an identified spec.
fn map_file(spec: &Path) -> PathBuf {
    spec.with_extension("map.toml")
}

/// Returns the identified spec, the identified map, and the text printed about their files: all
/// lines added to the nominal spec, or their number only.
fn identified_files(
    file: &Path,
    job: &identify::Identify,
    report: &Report,
    detail: Detail,
) -> Result<[String; 3]> {
    let identify::Identify { machine, map, .. } = job;
    let [path, map_path] = [file, &map_file(file)].map(|path| path.display().to_string());
    let spec = report.found.identified_spec(&machine.spec, &machine.text_for(file)?, &path)?;
    let map = report.found.identified_map(map, &machine.spec, &map_path)?;
    let lines = spec.added.trim_end().lines().map(|line| format!("+ {line}").trim_end().to_owned());
    let lines: Vec<String> = lines.collect();
    let with = |what: &str| {
        format!("Written to {path}: the nominal spec, {what}, and the covariance of the identified errors")
    };
    let of_spec = match detail {
        _ if lines.is_empty() => wrapped(&format!("Written to {path}: the nominal spec."), 0),
        Detail::Full => format!("{}\n{}", with("these lines"), lines.join("\n")),
        Detail::Answer => wrapped(&format!("{}.", with(&format!("{} lines", lines.len()))), 0),
    };
    let of_map = format!(
        "Written to {map_path}: the map with the identified station and targets; `measure`, \
         `simulate`, `compensate` and `plan` need both files."
    );
    Ok([spec.text, map, format!("{of_spec}\n{}\n", wrapped(&of_map, 0))])
}

/// Parses `q2=1,2,101`.
fn harmonics(arguments: &[String], spec: &Spec) -> Result<Vec<Harmonics>> {
    let read = |argument: &String| {
        let mistake = |message: &str| {
            Failure::new(format!("--harmonics {argument}"), message)
                .help("give a revolute joint and its cycles per turn: `--harmonics q2=1,2,101`")
        };
        let (joint, times) = argument.split_once('=').ok_or_else(|| mistake("expected JOINT=N,…"))?;
        let variable = spec.variables.iter().position(|variable| variable.name == joint.trim());
        let revolute = variable.filter(|i| spec.variables[*i].kind == VariableKind::Revolute);
        let variable = revolute.ok_or_else(|| mistake("unknown revolute joint"))?;
        let number = |text: &str| {
            let number = text.trim().parse::<u16>().ok().filter(|number| *number > 0);
            number.ok_or_else(|| mistake("expected whole numbers from 1 to 65535"))
        };
        let times = times.split(',').map(number).collect::<Result<Vec<_>, _>>()?;
        Ok(Harmonics { variable, times })
    };
    arguments.iter().map(read).collect()
}
