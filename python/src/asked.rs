//! The jobs of a machine, as users ask for them: what the commands of the same names do, without their files.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use abbe::identify::{Criterion, Loss};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_spec::expr::Dimension;
use abbe_spec::value::parse_value;
use abbe_spec::Spec;
use abbe_report::{Provenance, text};
use abbe_study::analyze::parts::{Part, Question, Shard, Written};
use abbe_study::analyze::{self, Analyze};
use abbe_study::check::Check;
use abbe_study::data::{Data, Map};
use abbe_study::generate::{Generate, Language, Real};
use abbe_study::identify::{Family, Identify, Prior, Settings};
use abbe_study::measure::Measure;
use abbe_study::monitor::{self, Checks, Monitor};
use abbe_study::plan::{Choice, Plan, Sets};
use abbe_study::simulate::{Places, Simulate};
use abbe_study::{Acceptance, Notes, Study};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyString;

use crate::failure::{guarded, spec_error};
use crate::job::run;
use crate::machine::Machine;
use crate::measured::Measured;
use crate::report::{Pages, Report};

impl Machine {
    /// What an analysis asks, with the texts of its files, and no options.
    fn question(&self, study: Option<&Path>, study_text: Option<&str>) -> Result<Question, Diagnostics> {
        let folder = self.unchanged.file.as_deref().and_then(Path::parent);
        let spec_text = self.text.clone().map(|text| Written {
            name: self.unchanged.origin.clone(),
            folder: folder.map(|folder| folder.to_string_lossy().into_owned()),
            text,
        });
        let mut question =
            Question { spec_text, changes: self.each_change(), ..Question::new(&self.unchanged, study)? };
        if let (Some(text), None) = (study_text, study) {
            let name = "study_text".to_owned();
            question.study = Some(Written { name, folder: None, text: text.to_owned() });
        }
        Ok(question)
    }
}

#[pymethods]
impl Machine {
    /// Checks the spec: what it says, its chain at home, what measurements could tell, and J_e against the exact chain.
    ///
    /// Fields as those of `abbe check --json`.
    ///
    /// >>> import abbe
    /// >>> all(law.holds for law in abbe.load("scara").check().laws)
    /// True
    fn check(&self, py: Python<'_>) -> PyResult<Report> {
        let job = Check { machine: self.machine.clone() };
        let (report, notes) = run(py, None, None, |notes| job.run(notes))?;
        Report::new("check", &report, notes)
    }

    /// Every error source alone and all together, over a workspace: what leads, where, and whether a tolerance is met.
    ///
    /// `study`: a study file; `study_text`: the text of one; if neither is given, the one beside the spec or shipped with it, or
    /// else samples of the joints. `monte_carlo` draws at the worst configuration and at home. `figures` gathers what the pictures of
    /// `.report(folder)` and `.figure(name)` show. Lengths in the unit of the spec; fields as those of `abbe analyze --json`.
    ///
    /// >>> import abbe
    /// >>> report = abbe.load("pps").analyze()
    /// >>> print(f"{report.combined.radius:.3f}")
    /// 5.480
    ///
    /// With `shard=(i, n)`, i from 1 to n, one of n shares of the workspace is swept, and a Part is given: `abbe.merge` of all
    /// parts is the report.
    #[pyo3(signature = (study=None, *, study_text=None, monte_carlo=0, seed=None, figures=true, shard=None, threads=None, progress=None))]
    fn analyze<'py>(
        &self,
        py: Python<'py>,
        study: Option<PathBuf>,
        study_text: Option<&str>,
        monte_carlo: usize,
        seed: Option<u64>,
        figures: bool,
        shard: Option<(u32, u32)>,
        threads: Option<usize>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let monte_carlo = Some(monte_carlo).filter(|draws| *draws > 0);
        if let Some((number, of)) = shard {
            let shard = Shard::new(number, of)
                .map_err(|message| PyValueError::new_err(format!("`shard`: {message}")))?;
            let (part, _) = run(py, threads, progress, |notes| {
                let question = self.question(study.as_deref(), study_text)?;
                Part::new(Question { monte_carlo, seed, figures, ..question }, shard, notes)
            })?;
            return Ok(Bound::new(py, crate::part::Part(part))?.into_any());
        }
        let (report, notes) = run(py, threads, progress, |notes| {
            let machine = self.unchanged.clone();
            let study = match (study_text, &study) {
                (Some(text), None) => Study::read(Document::new("study_text", text), &machine.spec)?,
                (_, file) => Study::find(file.as_deref(), &machine)?,
            };
            let mut job = Analyze::new(machine, study);
            self.changes()?.iter().for_each(|changes| job.change(changes, notes));
            job.monte_carlo = monte_carlo;
            job.seed = seed;
            job.figures = figures;
            job.run(notes)
        })?;
        Ok(Bound::new(py, analysis(report, notes)?)?.into_any())
    }

    /// How good the machine is: what was measured against the ideal machine and against what its sources predict.
    ///
    /// `data`: a CSV file, or a table with the columns that the map names: a dict of arrays, a frame of pandas or polars, a table of
    /// pyarrow; rows are then counted from 0. Those that cannot be used are in `.notes`. `map`: what the columns are, a file or a shipped name. `new_station`: the instrument stands where no map
    /// knows. `accept`: limits such as "mean 0.15 mm, max 0.3 mm". Fields as those of `abbe measure --json`.
    #[pyo3(signature = (data, map, *, new_station=false, accept=None))]
    fn measure(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: PathBuf,
        new_station: bool,
        accept: Option<&str>,
    ) -> PyResult<Report> {
        let map = self.map(py, &map)?;
        let measured = Measured::new("data", data, &map)?;
        let ((job, report), notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let map = if new_station { map.newly_stationed() } else { map };
            let accept = limits(accept, &machine.spec, &map)?;
            let data = Data::read(measured.source(), &map)?;
            unusable(&data, notes);
            let job = Measure { data, machine, map, accept };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let found = Report::new("measure", &report, notes)?.with_rows(report.table());
        Ok(found.with_pages(move || {
            let spec = &job.machine.spec;
            let provenance =
                Provenance::new(spec, Some(&job.map), [("measurements", measured.source())], None)?;
            let page = abbe_report::measurement(spec, &job.map, &report, &provenance);
            Ok(vec![("report.html".into(), page), ("errors.csv".into(), report.table().csv())])
        }))
    }

    /// Which errors the real machine has, from measurements, how well each is known, and how good the result is on unseen rows.
    ///
    /// `data`, `test`: CSV files or tables, as for `measure`; `map`: what their columns are. `terms`: "auto" for all families of richer terms, or names of some:
    /// joint, load, elastic, backlash, product, drift. `robust`: "huber" or "tukey". `prior`: how large errors are expected to be, as
    /// a share of the arm and in rad, or "spec" or "auto". `time`: seconds for richer terms. `resample=b`: repetition b of the bootstrap, with
    /// configurations drawn with replacement (`abbe.fleet.bootstrap` does many). `.report(folder)` writes found.toml and
    /// found.map.toml, too. Fields as those of `abbe identify --json`.
    #[pyo3(signature = (data, map, *, test=None, terms=None, robust=None, prior=None, folds=10, time=None, resample=None, accept=None, threads=None, progress=None))]
    fn identify(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: PathBuf,
        test: Option<&Bound<'_, PyAny>>,
        terms: Option<&Bound<'_, PyAny>>,
        robust: Option<&str>,
        prior: Option<&Bound<'_, PyAny>>,
        folds: usize,
        time: Option<f64>,
        resample: Option<usize>,
        accept: Option<&str>,
        threads: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Report> {
        let terms = families(terms)?;
        let settings = Settings {
            loss: match robust {
                None => Loss::Squares,
                Some("huber") => Loss::Huber,
                Some("tukey") => Loss::Tukey,
                Some(other) => {
                    return Err(PyValueError::new_err(format!(
                        "robust={other:?}: None, \"huber\" or \"tukey\""
                    )));
                }
            },
            prior: expected(prior)?,
            folds: Some(folds)
                .filter(|folds| (2..=1000).contains(folds))
                .ok_or_else(|| PyValueError::new_err("`folds`: from 2 to 1000"))?,
            time: time
                .map(Duration::try_from_secs_f64)
                .transpose()
                .map_err(|error| PyValueError::new_err(format!("`time`: {error}")))?,
            points: true,
        };
        let map = self.map(py, &map)?;
        let measured = Measured::new("data", data, &map)?;
        let unseen = test.map(|test| Measured::new("test", test, &map)).transpose()?;
        let ((job, report), notes) = run(py, threads, progress, |notes| {
            let machine = self.machine.clone();
            let test = unseen.as_ref().map(|test| Data::read(test.source(), &map)).transpose()?;
            let accept = limits(accept, &machine.spec, &map)?;
            let data = Data::read(measured.source(), &map)?;
            test.iter().chain([&data]).for_each(|data| unusable(data, notes));
            let data = resample.map_or_else(|| data.clone(), |number| data.resampled(0, number));
            let job = Identify { machine, map, data, test, terms, harmonics: Vec::new(), settings, accept };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        // A spec with changes has no room for what was found.
        let nominal = self.machine.spec.hash == self.unchanged.spec.hash
            && self.changes().is_ok_and(|changes| changes.is_empty());
        let text = self.text();
        Ok(Report::new("identify", &report, notes)?.with_spec("found.toml").with_pages(move || {
            let Identify { machine, map, .. } = &job;
            let test = unseen.iter().map(|test| ("test", test.source()));
            let files = [("measurements", measured.source())].into_iter().chain(test);
            let provenance = Provenance::new(&machine.spec, Some(map), files, None)?;
            let page = abbe_report::identification(&machine.spec, map, &report, &provenance);
            let mut pages: Pages = vec![("report.html".into(), page)];
            if nominal {
                let spec = report.found.identified_spec(&machine.spec, &text.clone()?, "found.toml")?;
                let map = report.found.identified_map(map, &machine.spec, "found.map.toml")?;
                pages.extend([("found.toml".into(), spec.text), ("found.map.toml".into(), map)]);
            }
            Ok(pages)
        }))
    }

    /// Where to measure, and how well the errors of the machine will then be known where it is used.
    ///
    /// `map`: what will be measured. `sets`: a plan file; else the `count` configurations that tell most of `candidates` samples, by
    /// `criterion` "v" or "d"; `seed` draws the samples. `model_error`: a length in the unit of the spec, or text. `.report(folder)` writes plan.csv. Fields as
    /// those of `abbe plan --json`.
    #[pyo3(signature = (map, *, sets=None, count=50, criterion="v", candidates=500, model_error=None, study=None, seed=None, progress=None))]
    fn plan(
        &self,
        py: Python<'_>,
        map: PathBuf,
        sets: Option<PathBuf>,
        count: usize,
        criterion: &str,
        candidates: usize,
        model_error: Option<&Bound<'_, PyAny>>,
        study: Option<PathBuf>,
        seed: Option<u64>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Report> {
        let criterion = match criterion {
            "v" => Criterion::Variance,
            "d" => Criterion::Determinant,
            other => return Err(PyValueError::new_err(format!("criterion={other:?}: \"v\" or \"d\""))),
        };
        if !(1..=5000).contains(&count) || !(1..=1_000_000).contains(&candidates) {
            return Err(PyValueError::new_err("`count` is from 1 to 5000, `candidates` from 1 to 1000000"));
        }
        let model_error =
            model_error.map(|value| length("model_error", value, &self.machine.spec)).transpose()?;
        let ((job, report), notes) = run(py, None, progress, |notes| {
            let machine = self.machine.clone();
            let map = Map::find(&map, &machine.spec)?;
            let choice = match &sets {
                Some(file) => Choice::Sets(Sets::find(file, &machine.spec)?),
                None => Choice::Optimal { criterion, count, candidates },
            };
            let study = Study::find(study.as_deref(), &machine)?;
            let job = Plan { machine, map, choice, study, model_error: model_error.unwrap_or(0.0), seed };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let found = Report::new("plan", &report, notes)?.with_rows(report.table(&job.map));
        Ok(found.with_pages(move || Ok(vec![("plan.csv".into(), report.table(&job.map).csv())])))
    }

    /// What an instrument would measure of the machine with the errors of its sources.
    ///
    /// `map`: what is measured; `data`: commands in a CSV file or a table, else `samples` random configurations. `noise`: one standard deviation
    /// of a coordinate, in the length unit or as text; `outliers`: which share of the rows is grossly wrong; `random`: draw the random
    /// sources, too. `.report(folder)` writes measurements.csv. Fields as those of `abbe simulate --json`.
    #[pyo3(signature = (map, *, data=None, samples=100, noise=None, outliers=0.0, random=false, seed=0))]
    fn simulate(
        &self,
        py: Python<'_>,
        map: PathBuf,
        data: Option<&Bound<'_, PyAny>>,
        samples: usize,
        noise: Option<&Bound<'_, PyAny>>,
        outliers: f64,
        random: bool,
        seed: u64,
    ) -> PyResult<Report> {
        if !(0.0..=1.0).contains(&outliers) || !(1..=10_000_000).contains(&samples) {
            return Err(PyValueError::new_err("`outliers` is from 0 to 1, `samples` from 1 to 10000000"));
        }
        let noise = noise.map(|value| length("noise", value, &self.machine.spec)).transpose()?;
        let map = self.map(py, &map)?;
        let commands = data.map(|data| Measured::new("data", data, &map)).transpose()?;
        let (report, notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let at = match &commands {
                Some(commands) => Places::Rows(Data::read_commanded(commands.source(), &map)?),
                None => Places::Samples(samples),
            };
            Simulate { machine, map, at, noise, outliers, random, seed }.run(notes)
        })?;
        let found = Report::new("simulate", &report, notes)?.with_rows(report.table.clone());
        Ok(found.with_pages(move || Ok(vec![("measurements.csv".into(), report.table.csv())])))
    }

    /// Whether the machine is still what it was: charts of a few points that are measured again and again.
    ///
    /// `data`: CSV files or tables in the order of their dates, or one with a column of dates. `tolerance`: how far the tool point may move, in the length unit or as text.
    /// `since`: begin with the check of this date. `false_alarm`: one in so many checks. Fields as those of `abbe monitor --json`.
    #[pyo3(signature = (data, map, *, tolerance=None, since=None, false_alarm=365))]
    fn monitor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: PathBuf,
        tolerance: Option<&Bound<'_, PyAny>>,
        since: Option<&str>,
        false_alarm: u32,
    ) -> PyResult<Report> {
        if !(10..=100_000).contains(&false_alarm) {
            return Err(PyValueError::new_err("`false_alarm` is from 10 to 100000"));
        }
        let tolerance = tolerance.map(|value| length("tolerance", value, &self.machine.spec)).transpose()?;
        let map = self.map(py, &map)?;
        let measured = Measured::several("data", data, &map)?;
        let ((job, report), notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let mut checks = Checks::read(measured.iter().map(Measured::source), &map)?;
            since.map_or(Ok(()), |date| checks.since("since", date))?;
            let checks_per_false_alarm = f64::from(false_alarm);
            let settings = monitor::Settings { checks_per_false_alarm, tolerance, ..Default::default() };
            let job = Monitor { machine, map, checks, settings };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        Ok(Report::new("monitor", &report, notes)?.with_pages(move || {
            let files = measured.iter().map(|check| ("check", check.source()));
            let provenance = Provenance::new(&job.machine.spec, Some(&job.map), files, None)?;
            let page = abbe_report::monitoring(&job.machine.spec, &job.map, &report, &provenance);
            Ok(vec![("report.html".into(), page)])
        }))
    }

    /// The closed form as source code: `language` is "rust", "c", "js", "python" or "matlab". The same spec gives the same text; the header and
    /// the source of C stand in it one after the other; it computes in `real`, "double" if nothing is said, or "float".
    #[pyo3(signature = (language="rust", *, real=None))]
    fn generate(&self, py: Python<'_>, language: &str, real: Option<&str>) -> PyResult<String> {
        let mut texts = Language::ALL.into_iter().filter(|known| !matches!(known, Language::Fmu(_)));
        let known = texts.find(|known| known.name() == language);
        let language = known.ok_or_else(|| {
            PyValueError::new_err(format!(
                "language={language:?}: \"rust\", \"c\", \"js\", \"python\" or \"matlab\""
            ))
        })?;
        let known = real.map(|real| (real, Real::ALL.into_iter().find(|known| known.name() == real)));
        let language = match (language, known) {
            (language, None) => language,
            (Language::C(_), Some((_, Some(real)))) => Language::C(real),
            (_, Some((real, _))) => {
                let message = format!("real={real:?}: \"double\" or \"float\", with language=\"c\"");
                return Err(PyValueError::new_err(message));
            }
        };
        let job = Generate { machine: self.machine.clone(), language };
        let files = run(py, None, None, |notes| job.run(notes))?.0;
        Ok(files.into_iter().map(|file| file.text).collect())
    }
}

/// The report of an analysis, with its text, its tables and its pages.
pub(crate) fn analysis(report: analyze::Report, notes: Vec<String>) -> PyResult<Report> {
    let (text, tables) = guarded(|| Ok((text::analysis(&report), budget(&report))))?;
    let found = Report::new("analyze", &report, notes)?.shown(text, tables);
    let report = Arc::new(report);
    let drawn = Arc::clone(&report);
    let found = found.with_figures(move || abbe_report::figures(&drawn));
    Ok(found.with_pages(move || {
        let files = abbe_report::analysis(&report);
        Ok(files.into_iter().map(|file| (file.name, file.text)).collect())
    }))
}

/// The ledger and the uncertainty budgets as tables.
fn budget(report: &analyze::Report) -> String {
    let ledgers = [Some(analyze::ledger(report)), analyze::turns(report)];
    let budgets = report
        .uncertainty_budgets()
        .flat_map(|budget| [analyze::contributions(report, budget), analyze::totals(report, budget)]);
    ledgers.into_iter().flatten().chain(budgets).map(|listing| abbe_report::listed(&listing)).collect()
}

/// Says which rows cannot be used, as the command does.
fn unusable(data: &Data, notes: &mut dyn Notes) {
    if !data.unusable.is_empty() {
        notes.note(&data.summary().lines().join("\n"));
    }
}

fn limits(text: Option<&str>, spec: &Spec, map: &Map) -> Result<Acceptance, Diagnostics> {
    text.map_or(Ok(map.accept.clone()), |text| Acceptance::read("accept", text, spec.length))
}

/// A length that is not negative: a number in the unit of the spec, or text.
pub(crate) fn length(name: &str, value: &Bound<'_, PyAny>, spec: &Spec) -> PyResult<f64> {
    let number: f64 = match value.cast::<PyString>() {
        Ok(text) => {
            let text = text.to_str()?;
            let mut document = Document::new(name, text);
            let number = parse_value(&mut document, 0..text.len(), spec.length, Dimension::LENGTH, "this");
            document.finish(number).map_err(|mistakes| spec_error(value.py(), &mistakes))?
        }
        Err(_) => value.extract()?,
    };
    match number.is_finite() && number >= 0.0 {
        true => Ok(number),
        false => Err(PyValueError::new_err(format!("`{name}` is a length that is not negative"))),
    }
}

fn families(terms: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Family>> {
    let names: Vec<String> = match terms {
        None => Vec::new(),
        Some(one) if one.is_instance_of::<PyString>() => vec![one.extract()?],
        Some(several) => several.extract()?,
    };
    let known = Family::ALL.map(Family::name).join(", ");
    let found = names.iter().map(|name| match &name[..] {
        "auto" => Ok(Family::ALL.to_vec()),
        name => match Family::ALL.into_iter().find(|family| family.name() == name) {
            Some(family) => Ok(vec![family]),
            None => Err(PyValueError::new_err(format!("there are no terms `{name}`; terms: auto, {known}"))),
        },
    });
    Ok(found.collect::<PyResult<Vec<_>>>()?.concat())
}

fn expected(prior: Option<&Bound<'_, PyAny>>) -> PyResult<Prior> {
    let Some(prior) = prior else { return Ok(Prior::Share(0.01)) };
    let wrong = || PyTypeError::new_err("`prior` is a share from 0 to 1, \"spec\" or \"auto\"");
    match prior.extract::<String>().as_deref() {
        Ok("spec") => Ok(Prior::Spec),
        Ok("auto") => Ok(Prior::Auto),
        Ok(_) => Err(wrong()),
        Err(_) => match prior.extract::<f64>() {
            Ok(share) if (0.0..=1.0).contains(&share) => Ok(Prior::Share(share)),
            _ => Err(wrong()),
        },
    }
}
