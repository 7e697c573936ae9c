//! Import of robots from other formats, and export of machines to files of other programs.

use std::{path::PathBuf, sync::Arc};

use abbe_report::{text, views};
use abbe_spec::Document;
use abbe_study::export::{Ends, Export, Format as Exported, FormatMismatch, SAMPLES_RANGE};
use abbe_study::import::{Format, Import, Units};
use abbe_study::options::CONVENTIONS;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

use crate::job::{SEEDS, Whole, named, one_of, run, within};
use crate::{Machine, Report};

/// Converts a URDF robot to a spec, from a `file` or its `text`.
///
/// `base`, `tip`: links whose frames are F_0 and the tool point; by default the root link and the
/// last link, if there is only one. `fold`: merge fixed joints into the frames that follow them; by
/// default each is a frame with errors of its own. `round_angles`: round angles within 1e-5 rad of
/// a multiple of 45° to that multiple. Lengths of the spec are in m.
///
/// `.load()` of the report returns the machine, `.spec` is the text of its spec, `.messages` lists
/// what was left out, and `.report(folder)` writes the spec. Raises SpecError, with a place, if the
/// file is wrong. Fields: `abbe.reports.ImportReport`.
///
/// >>> import abbe
/// >>> urdf = '''<robot name="arm"> <link name="base"/> <link name="hand"/>
/// ...   <joint name="Elbow" type="revolute"> <parent link="base"/> <child link="hand"/>
/// ...     <axis xyz="0 0 1"/> <limit lower="-1" upper="1" effort="1" velocity="1"/>
/// ...   </joint> </robot>'''
/// >>> abbe.import_urdf(text=urdf).load()
/// Machine('arm': 1 frame, 1 joint variable, m)
#[pyfunction]
#[pyo3(signature = (file=None, *, text=None, base=None, tip=None, fold=false, round_angles=false))]
pub(crate) fn import_urdf(
    py: Python<'_>,
    file: Option<PathBuf>,
    text: Option<String>,
    base: Option<String>,
    tip: Option<String>,
    fold: bool,
    round_angles: bool,
) -> PyResult<Py<Report>> {
    if file.is_some() == text.is_some() {
        return Err(PyTypeError::new_err("give the path of a URDF file, or else text=…"));
    }
    let file = file.unwrap_or_else(|| "text".into());
    imported(py, Import { file, format: Format::Urdf { base, tip, fold }, round_angles }, text)
}

/// Converts a table of Denavit-Hartenberg parameters to a spec. `table` is a CSV file or a table
/// with the columns theta, d, a and alpha; `text` is such a file, or the output of the Robotics
/// Toolbox.
///
/// `convention`: "standard", Rz(theta) Tz(d) Tx(a) Rx(alpha), or "modified" (Craig), Rx(alpha)
/// Tx(a) Rz(theta) Tz(d). `units`: units of columns whose header names none, such as "mm,deg";
/// there is no default. The length unit of the spec is that of the table. Otherwise as
/// `import_urdf`.
///
/// >>> import abbe
/// >>> rows = {"theta": ["q1", "q2 + 90"], "d": [0, 120], "a": [400, 0], "alpha": [0, -90],
/// ...         "lower": [-170, -90], "upper": [170, 90]}
/// >>> abbe.import_dh(rows, convention="standard", units="mm,deg").load().pose([0, 0])[:3, 3]
/// array([400.,   0., 120.])
#[pyfunction]
#[pyo3(signature = (table=None, *, convention, text=None, units=None, round_angles=false))]
pub(crate) fn import_dh(
    py: Python<'_>,
    table: Option<&Bound<'_, PyAny>>,
    convention: &str,
    text: Option<String>,
    units: Option<&str>,
    round_angles: bool,
) -> PyResult<Py<Report>> {
    let convention = named("convention", convention, CONVENTIONS)?;
    let units: Units = units
        .map_or(Ok(Units::default()), str::parse)
        .map_err(|message| PyValueError::new_err(format!("`units`: {message}")))?;
    let (file, text) = match (table, text) {
        (None, Some(text)) => ("text".into(), Some(text)),
        (Some(table), None) => match table.extract::<PathBuf>() {
            Ok(file) => (file, None),
            Err(_) => {
                let written = py.import("abbe._arrays")?.getattr("csv")?.call1((table, "table"))?;
                ("table".into(), Some(written.extract()?))
            }
        },
        _ => return Err(PyTypeError::new_err("give a CSV file or a table, or else text=…")),
    };
    imported(py, Import { file, format: Format::Table { convention, units }, round_angles }, text)
}

fn imported(py: Python<'_>, job: Import, text: Option<String>) -> PyResult<Py<Report>> {
    let (report, notes) = run(py, None, None, |notes| match text {
        None => job.run(notes),
        Some(text) => job.read(Document::new(job.file.display().to_string(), text), notes),
    })?;
    let (name, spec) = (format!("{}.toml", report.manipulator), report.spec.clone());
    let found = Report::new("import", &Arc::new(report), notes, |report, _| text::imported(report))?;
    found.with_spec(&name).with_pages(move || Ok(vec![(name.clone(), spec.clone())])).create(py)
}

#[pymethods]
impl Machine {
    /// Exports the repeatable sources of the machine to files that controllers and other programs
    /// load, and evaluates the errors that remain.
    ///
    /// `to`: "dh", "urdf" (a corrected copy of the file `urdf` of the nominal robot, from its link
    /// `base` to `tip`; without `urdf` one of the frames, and a file of the loops),
    /// "ur-calibration", "isg-csv", "kinematics-comp", "linuxcnc", "linuxcnc-matrixkins",
    /// "linuxcnc-genhexkins" or "table". `nodes`: number of table nodes per
    /// axis or joint. `samples`, `seed`: number and seed of the random configurations at which the
    /// remaining errors are evaluated, in the length unit and rad.
    ///
    /// `.files` have `.name` and `.text`; `.report(folder)` writes them. `.left_out` lists what
    /// the format cannot hold. Raises SpecError if the machine cannot be written in the format.
    /// Fields: `abbe.reports.ExportReport`.
    ///
    /// >>> import abbe
    /// >>> machine = abbe.load("machine3").with_parameters(temperature_rise="3 K")
    /// >>> report = machine.export("isg-csv", nodes=21)
    /// >>> report.files[0].name, report.remains.position.largest < report.before.position.largest
    /// ('machine3.volcomp.csv', True)
    #[pyo3(signature = (to, *, urdf=None, base=None, tip=None, nodes=None, samples=1000, seed=0))]
    #[allow(clippy::too_many_arguments, reason = "keywords of Python")]
    fn export(
        &self,
        py: Python<'_>,
        to: &str,
        urdf: Option<PathBuf>,
        base: Option<String>,
        tip: Option<String>,
        nodes: Option<Whole>,
        samples: Whole,
        seed: Whole,
    ) -> PyResult<Py<Report>> {
        let (samples, seed) = (within("samples", samples, SAMPLES_RANGE)?, within("seed", seed, SEEDS)?);
        let nodes = nodes.map(|nodes| within("nodes", nodes, Exported::NODES_RANGE)).transpose()?;
        let given = [("urdf", urdf.is_some()), ("base", base.is_some()), ("tip", tip.is_some())];
        let format = Exported::choose(to, urdf, Ends { base, tip }, nodes).map_err(|unfit| {
            let needless = |name: &str| format!("`{name}` is not for to={to:?}: leave it out");
            PyValueError::new_err(match unfit {
                FormatMismatch::Unknown => format!("to={to:?}: {}", one_of(Exported::names())),
                FormatMismatch::NeedlessNodes => needless("nodes"),
                FormatMismatch::NeedlessRobot => {
                    needless(given.iter().find(|(_, given)| *given).map_or("urdf", |(name, _)| *name))
                }
            })
        })?;
        let job = Export { machine: self.machine.clone(), format, samples, seed };
        let (report, notes) = run(py, None, None, |notes| job.run(notes))?;
        let files: Vec<_> = report.files.iter().map(|file| (file.name.clone(), file.text.clone())).collect();
        let found = Report::from_document("export", &Arc::new(report), notes, views::exported)?;
        found.with_pages(move || Ok(files.clone())).create(py)
    }
}
