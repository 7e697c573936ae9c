//! Measurements: the path of a CSV file, or a table in memory; and the jobs on them: evaluation of
//! a machine, monitoring by repeated checks, simulated measurements, measurement plans, conventions
//! of data, and runs of an axis of a machine tool or of body diagonals.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::path::PathBuf;
use std::sync::Arc;

use abbe_metrology::data::{Cells, Columns, Data, Map, Source};
use abbe_metrology::doctor::Doctor;
use abbe_metrology::measure::Measure;
use abbe_metrology::monitor::options::FALSE_ALARM;
use abbe_metrology::monitor::{Checks, Monitor, Settings};
use abbe_metrology::plan::options::{CANDIDATES, COUNT, CRITERIA};
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_metrology::positioning::Positioning;
use abbe_metrology::simulate::options::{OUTLIERS, SAMPLES};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_report::views;
use abbe_study::{Notes, Study};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};

use crate::failure::{guarded, spec_error};
use crate::job::{length, limits, named, run, within};
use crate::machine::Machine;
use crate::report::{Pages, Report};

/// Rows of measurements.
pub(crate) enum Measured {
    /// Path of a CSV file.
    File(PathBuf),
    /// Columns in memory: those that the map names.
    Table(Columns),
}

impl Measured {
    /// Converts an argument with this name to measurements.
    pub(crate) fn new(what: &str, value: &Bound<'_, PyAny>, map: &Map) -> PyResult<Self> {
        if let Ok(file) = value.extract() {
            return Ok(Self::File(file));
        }
        Self::table(what, value, Some(map.columns()))
    }

    /// Converts an argument without a map: all columns are read.
    pub(crate) fn all(what: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        value.extract().map_or_else(|_| Self::table(what, value, None), |file| Ok(Self::File(file)))
    }

    fn table(what: &str, value: &Bound<'_, PyAny>, wanted: Option<Vec<&str>>) -> PyResult<Self> {
        let py = value.py();
        let read = py.import("abbe._arrays")?.getattr("columns")?;
        let read = read.call1((value, what, wanted))?;
        let (columns, others): (Vec<(String, Bound<'_, PyAny>)>, Vec<String>) = read.extract()?;
        let columns = columns.into_iter().map(|(name, cells)| Ok((name, cells_of(&cells)?)));
        let columns = Columns::new(what, columns.collect::<PyResult<_>>()?, others);
        Ok(Self::Table(columns.map_err(|mistakes| spec_error(py, &mistakes))?))
    }

    /// Converts a list or tuple of measurements, or a single one.
    pub(crate) fn several(what: &str, value: &Bound<'_, PyAny>, map: &Map) -> PyResult<Vec<Self>> {
        if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            return value.try_iter()?.map(|one| Self::new(what, &one?, map)).collect();
        }
        Ok(vec![Self::new(what, value, map)?])
    }

    pub(crate) fn source(&self) -> Source<'_> {
        match self {
            Self::File(file) => file.into(),
            Self::Table(columns) => columns.into(),
        }
    }
}

impl Machine {
    /// Reads the map in a file, the shipped map of that name, or a map as a dict or text of several
    /// lines.
    pub(crate) fn map(&self, map: &Bound<'_, PyAny>) -> PyResult<Map> {
        let (py, spec) = (map.py(), &self.machine.spec);
        let text = match map.cast::<PyString>() {
            Ok(text) => Some(text.to_str()?.to_owned()).filter(|text| text.contains('\n')),
            Err(_) => None,
        };
        let text = match text {
            None if map.is_instance_of::<PyDict>() => {
                Some(py.import("abbe._arrays")?.getattr("toml")?.call1((map,))?.extract()?)
            }
            text => text,
        };
        let read = match text {
            Some(text) => guarded(|| Ok(py.detach(|| Map::parse("map", &text, spec)))),
            None => {
                let file: PathBuf = map.extract()?;
                guarded(|| Ok(py.detach(|| Map::find(&file, spec))))
            }
        };
        read?.map_err(|mistakes| spec_error(py, &mistakes))
    }
}

/// Notes which rows cannot be used, as the command does.
pub(crate) fn unusable(data: &Data, notes: &mut dyn Notes) {
    if !data.unusable.is_empty() {
        notes.note(&data.summary().lines().join("\n"));
    }
}

fn cells_of(cells: &Bound<'_, PyAny>) -> PyResult<Cells> {
    match cells.cast::<PyArray1<f64>>() {
        Ok(array) => Ok(Cells::Numbers(array.try_readonly()?.as_slice()?.to_vec())),
        Err(_) => Ok(Cells::Texts(cells.extract()?)),
    }
}

#[pymethods]
impl Machine {
    /// Evaluates measurements: accuracy and repeatability against the ideal machine, and the
    /// residuals after its sources.
    ///
    /// `data`: a CSV file, or a table with the columns of the map: a dict of arrays, a pandas or
    /// polars frame, a pyarrow table; its rows count from 0. Rows that cannot be used are listed in
    /// `.messages`. `map`: path of the map of the columns, or a shipped name. `new_station`:
    /// estimate the station of the instrument from the data instead of taking it from the map.
    /// `accept`: limits such as "mean 0.15 mm, max 0.3 mm".
    ///
    /// `.table("rows")` has ΔX of each row, the prediction by the machine with its sources, and
    /// measured minus predicted; for instruments that read numbers, reading minus prediction and
    /// prediction.
    ///
    /// `.report(folder)` writes report.html and errors.csv. Fields: `abbe.reports.MeasureReport`.
    #[pyo3(signature = (data, map, *, new_station=false, accept=None))]
    fn measure(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: &Bound<'_, PyAny>,
        new_station: bool,
        accept: Option<&str>,
    ) -> PyResult<Py<Report>> {
        let map = self.map(map)?;
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
        let (report, spec, map) = (Arc::new(report), job.machine.spec.clone(), job.map.clone());
        let document = move |report: &_| views::measurement(&spec, &map, report);
        let found = Report::from_document("measure", &report, notes, document)?.with_rows(report.table());
        let found = found.with_pages(move || {
            let document = views::measurement(&job.machine.spec, &job.map, &report);
            let (files, residuals) = ([("measurements", measured.source())], report.residuals());
            let page = document.measured_page(&job.machine, Some(&job.map), files, residuals, &mut ())?;
            Ok(vec![("report.html".into(), page), ("errors.csv".into(), report.table().csv())])
        });
        found.create(py)
    }
}

#[pymethods]
impl Machine {
    /// Detects drift and jumps of a machine with control charts of a few points that are measured
    /// repeatedly.
    ///
    /// `data`: CSV files or tables in chronological order, or one with a date column. `map`: path
    /// of the map of the columns, or a shipped name. `tolerance`: allowed displacement of the tool
    /// point since the first check, in the length unit or as text with a unit. `since`: date of the
    /// first check to use. `false_alarm`: average number of checks per false alarm, over all
    /// charts.
    ///
    /// `.report(folder)` writes report.html. Fields: `abbe.reports.MonitorReport`.
    #[pyo3(signature = (data, map, *, tolerance=None, since=None, false_alarm=365))]
    fn monitor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: &Bound<'_, PyAny>,
        tolerance: Option<&Bound<'_, PyAny>>,
        since: Option<&str>,
        false_alarm: usize,
    ) -> PyResult<Py<Report>> {
        let false_alarm = within("false_alarm", false_alarm, FALSE_ALARM.range)?;
        let tolerance = tolerance.map(|value| length("tolerance", value, &self.machine.spec)).transpose()?;
        let map = self.map(map)?;
        let measured = Measured::several("data", data, &map)?;
        let ((job, report), notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let mut checks = Checks::read(measured.iter().map(Measured::source), &map)?;
            since.map_or(Ok(()), |date| checks.since("since", date))?;
            let checks_per_false_alarm = false_alarm as f64;
            let settings = Settings { checks_per_false_alarm, tolerance, ..Settings::default() };
            let job = Monitor { machine, map, checks, settings };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec, map) = (Arc::new(report), job.machine.spec.clone(), job.map.clone());
        let document = move |report: &_| views::monitoring(&spec, &map, report);
        let found = Report::from_document("monitor", &report, notes, document)?.with_pages(move || {
            let files = measured.iter().map(|check| ("check", check.source()));
            let document = views::monitoring(&job.machine.spec, &job.map, &report);
            let (map, residuals) = (Some(&job.map), report.residuals.clone());
            let page = document.measured_page(&job.machine, map, files, residuals, &mut ())?;
            Ok(vec![("report.html".into(), page)])
        });
        found.create(py)
    }
}

#[pymethods]
impl Machine {
    /// Simulates measurements of the machine with the repeatable errors of its sources.
    ///
    /// `map`: path of the map of the columns to write, or a shipped name. `data`: joint commands in
    /// a CSV file or a table; without it, `samples` random configurations. `noise`: standard
    /// deviation of each coordinate, in the length unit or as text with a unit; by default the
    /// uncertainty in the map. `outliers`: fraction of the rows that are outliers. `random`: also
    /// draw the random sources, independently in every row. `seed`: of configurations, noise,
    /// outliers and random sources.
    ///
    /// `.report(folder)` writes measurements.csv. Fields: `abbe.reports.SimulateReport`.
    #[pyo3(signature = (map, *, data=None, samples=100, noise=None, outliers=0.0, random=false, seed=0))]
    fn simulate(
        &self,
        py: Python<'_>,
        map: &Bound<'_, PyAny>,
        data: Option<&Bound<'_, PyAny>>,
        samples: usize,
        noise: Option<&Bound<'_, PyAny>>,
        outliers: f64,
        random: bool,
        seed: u64,
    ) -> PyResult<Py<Report>> {
        let samples = within("samples", samples, SAMPLES.range)?;
        let outliers = within("outliers", outliers, OUTLIERS.range)?;
        let noise = noise.map(|value| length("noise", value, &self.machine.spec)).transpose()?;
        let map = self.map(map)?;
        let commands = data.map(|data| Measured::new("data", data, &map)).transpose()?;
        let (report, notes) = run(py, None, None, |notes| {
            let machine = self.machine.clone();
            let at = match &commands {
                Some(commands) => Places::Rows(Data::read_commanded(commands.source(), &map)?),
                None => Places::Samples(samples),
            };
            Simulate { machine, map, at, noise, outliers, random, seed }.run(notes)
        })?;
        let report = Arc::new(report);
        let found = Report::new("simulate", &report, notes, |report, _| report.table.csv())?;
        let found = found.with_rows(report.table.clone());
        let found = found.with_pages(move || Ok(vec![("measurements.csv".into(), report.table.csv())]));
        found.create(py)
    }
}

#[pymethods]
impl Machine {
    /// Plans measurements, and predicts the uncertainty of the tool point after identification.
    ///
    /// `map`: path of the map of the measurements, or a shipped name. `sets`: path of a plan file
    /// with sets of configurations to evaluate; without it, `count` configurations are chosen from
    /// `candidates` samples. `criterion`: "v" for the smallest mean variance of the tool point over
    /// the workspace of `study`, "d" for the largest determinant of the information matrix. `seed`:
    /// of random candidates; without it they are evenly distributed. `model_error`: model error at
    /// the tool point in addition to the noise of the instrument, in the length unit or as text
    /// with a unit.
    ///
    /// `.report(folder)` writes plan.csv. Fields: `abbe.reports.PlanReport`.
    #[pyo3(signature = (map, *, sets=None, count=50, criterion="v", candidates=500, model_error=None, study=None, seed=None, progress=None))]
    fn plan(
        &self,
        py: Python<'_>,
        map: &Bound<'_, PyAny>,
        sets: Option<PathBuf>,
        count: usize,
        criterion: &str,
        candidates: usize,
        model_error: Option<&Bound<'_, PyAny>>,
        study: Option<PathBuf>,
        seed: Option<u64>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let criterion = named("criterion", criterion, CRITERIA)?;
        let count = within("count", count, COUNT.range)?;
        let candidates = within("candidates", candidates, CANDIDATES.range)?;
        let model_error =
            model_error.map(|value| length("model_error", value, &self.machine.spec)).transpose()?;
        let map = self.map(map)?;
        let ((job, report), notes) = run(py, None, progress, |notes| {
            let machine = self.machine.clone();
            let choice = match &sets {
                Some(file) => Choice::Sets(Sets::find(file, &machine.spec)?),
                None => Choice::Optimal { criterion, count, candidates },
            };
            let study = Study::find(study.as_deref(), &machine)?;
            let job = Plan { machine, map, choice, study, model_error: model_error.unwrap_or(0.0), seed };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec, map) = (Arc::new(report), job.machine.spec, job.map.clone());
        let document = move |report: &_| views::plan(&spec, &map, report);
        let found =
            Report::from_document("plan", &report, notes, document)?.with_rows(report.table(&job.map));
        let found = found.with_pages(move || Ok(vec![("plan.csv".into(), report.table(&job.map).csv())]));
        found.create(py)
    }
}

/// File name of the corrected spec.
const CORRECTED: &str = "doctor.spec.toml";

#[pymethods]
impl Machine {
    /// Finds the conventions of measured data: units, signs, order, zeros, Euler angles and more,
    /// from about ten rows of joints and poses.
    ///
    /// `data`: a CSV file or a table with one column per joint, found by the names of the variables
    /// or else taken from the first columns, then x, y, z and, optionally, an orientation.
    /// Alternatively joints alone (m, nq), with `seen`: positions (m, 3), positions and three
    /// angles (m, 6) or a quaternion (m, 7), matrices (m, 12), (m, 16) or (m, 4, 4). `within`:
    /// largest position residual of an interpretation that fits, in the length unit or as text with
    /// a unit.
    ///
    /// `.statements["answer"]` states the result. `.found` lists the interpretations that fit.
    /// `.map` is the text of the map of the first one, or None; `.report(folder)` writes it as
    /// doctor.map.toml.
    /// If the interpretation changes the spec, `.load()` returns the corrected machine, and
    /// doctor.spec.toml is its spec.
    ///
    /// Residuals are in the length unit and rad. Fields: `abbe.reports.DoctorReport`.
    ///
    /// >>> import abbe, numpy as np
    /// >>> ur5 = abbe.load("ur5")
    /// >>> q = np.random.default_rng(0).uniform(-2, 2, (10, 6))
    /// >>> report = ur5.doctor(np.degrees(q), ur5.pose(q)[:, :3, 3] / 1000)
    /// >>> found = report.found[0].interpretation
    /// >>> found.joints_in_degrees, found.lengths_in
    /// (True, 'm')
    #[pyo3(signature = (data, seen=None, *, within=None))]
    fn doctor(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        seen: Option<&Bound<'_, PyAny>>,
        within: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let within = within.map(|value| length("within", value, &self.machine.spec)).transpose()?;
        let rows = match seen {
            None => Measured::all("data", data)?,
            Some(seen) => {
                let read = py.import("abbe._arrays")?.getattr("beside")?;
                Measured::all("data", &read.call1((data, seen, &self.variable_names))?)?
            }
        };
        let (report, notes) = run(py, None, None, |notes| {
            Doctor { machine: self.machine.clone(), data: rows.source(), within }.run(notes)
        })?;
        let mut pages: Pages =
            report.map.iter().map(|map| ("doctor.map.toml".to_owned(), map.clone())).collect();
        let corrected = || report.corrected(&self.unchanged.spec, &self.text()?, CORRECTED);
        let corrected = guarded(|| corrected().map_err(|mistakes| spec_error(py, &mistakes)))?;
        pages.extend(corrected.map(|spec| (CORRECTED.to_owned(), spec)));
        let found = Report::from_document("doctor", &Arc::new(report), notes, views::doctor)?;
        found.with_spec(CORRECTED).with_pages(move || Ok(pages.clone())).create(py)
    }
}

/// Evaluates runs of one axis by ISO 230-2, or of body diagonals by ISO 230-6.
///
/// `data`: a CSV file or a table with columns `position (mm)`, `direction` (`+` or `-`) and
/// `deviation (um)` or `actual (mm)`; or with one column for each pass, `1+ (um)`, `1- (um)`, …
/// A column `diagonal` names the body diagonal of each row. `reading_uncertainty`,
/// `scale_uncertainty`: standard uncertainties of one reading of the instrument, "0.1 um", and of
/// its scale, "1 um/m".
///
/// Positions are in mm or deg, characteristics in um or arcsec. `.table("rows")` has the mean
/// deviations of an axis at its positions. Fields: `abbe.reports.PositioningReport`.
///
/// >>> import abbe
/// >>> runs = {"position (mm)": [0, 100], "1+ (um)": [1.0, 4.0], "1- (um)": [0.0, 2.0]}
/// >>> report = abbe.positioning(runs)
/// >>> report.lines[0].bidirectional.reversal.value
/// 2.0
#[pyfunction]
#[pyo3(signature = (data, *, reading_uncertainty=None, scale_uncertainty=None))]
pub(crate) fn positioning(
    py: Python<'_>,
    data: &Bound<'_, PyAny>,
    reading_uncertainty: Option<String>,
    scale_uncertainty: Option<String>,
) -> PyResult<Py<Report>> {
    let measured = Measured::all("data", data)?;
    let (report, notes) = run(py, None, None, |notes| {
        let (reading, scale) = (reading_uncertainty, scale_uncertainty);
        Positioning { data: measured.source(), reading, scale }.run(notes)
    })?;
    let rows = report.table();
    let found = Report::from_document("positioning", &Arc::new(report), notes, views::positioning)?;
    match rows {
        Some(rows) => found.with_rows(rows),
        None => found,
    }
    .create(py)
}
