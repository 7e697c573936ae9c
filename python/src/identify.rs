//! Identification of the errors of a machine from measurements.
#![allow(clippy::too_many_arguments, reason = "keywords of Python")]

use std::sync::Arc;

use abbe_metrology::data::Data;
use abbe_metrology::identify::options::{FOLDS, LOSSES, ONLY, TERMS};
use abbe_metrology::identify::{Family, Identify, Prior, Settings};
use abbe_report::views;
use abbe_study::options::share;
use pyo3::{exceptions::PyTypeError, prelude::*, types::PyString};

use crate::job::{Whole, named, run, seconds, within};
use crate::machine::Machine;
use crate::measured::{Measured, unusable};
use crate::report::Report;

#[pymethods]
impl Machine {
    /// Identifies the errors of the real machine from measurements, with their uncertainties, and
    /// validates the result on data that were not fitted.
    ///
    /// `data`, `test`: measurements to fit and to test, CSV files or tables as for `measure`.
    /// `map`: path of the map of their columns, or a shipped name. `only="placement"`: fit no error
    /// of the machine, only where machine, instruments and targets are. `terms`: families of
    /// additional error terms to try: "auto" for all, or one or several of joint, load, elastic,
    /// backlash, product, drift, profile. `robust`: robust loss, "none", "huber" or "tukey".
    /// `prior`: prior standard deviation of the errors, relative to the length of the arm and in
    /// rad: "auto" for 0.001 times a scale that the data choose, a number (0 holds them at zero),
    /// or "spec"; additional terms have 0.001 at most. `folds`: number of folds of the
    /// cross-validation. `time`: time limit in seconds for the search for additional terms.
    /// `resample=b`: repetition b of a bootstrap over configurations (`abbe.fleet.bootstrap` runs
    /// many). `accept`: limits such as "mean 0.15 mm, max 0.3 mm".
    ///
    /// `.table("rows")` has the residuals of every point in the frame of the instrument, with only
    /// base and tool fitted ("x before" …) and with the identified model ("x" …). `.covariance` is
    /// that of the identified errors. `.report(folder)` writes report.html, found.toml and
    /// found.map.toml; `.load()` returns the identified machine, with the changes of this one.
    /// Fields: `abbe.reports.IdentifyReport`.
    #[pyo3(signature = (data, map, *, test=None, only=None, terms=None, robust=None, prior=None, folds=10, time=None, resample=None, accept=None, threads=None, progress=None))]
    fn identify(
        &self,
        py: Python<'_>,
        data: &Bound<'_, PyAny>,
        map: &Bound<'_, PyAny>,
        test: Option<&Bound<'_, PyAny>>,
        only: Option<&str>,
        terms: Option<&Bound<'_, PyAny>>,
        robust: Option<&str>,
        prior: Option<&Bound<'_, PyAny>>,
        folds: Whole,
        time: Option<f64>,
        resample: Option<Whole>,
        accept: Option<&str>,
        threads: Option<Whole>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Report>> {
        let (terms, spec_text) = (families(terms)?, self.spec_text(py)?);
        let settings = Settings {
            only_placement: only.map(|name| named("only", name, ONLY)).transpose()?.unwrap_or_default(),
            loss: robust.map(|name| named("robust", name, LOSSES)).transpose()?.unwrap_or_default(),
            prior: expected(prior)?,
            folds: within("folds", folds, FOLDS.range)?,
            time: seconds("time", time)?,
            points: true,
        };
        let resample = resample.map(|number| within("resample", number, 0..=usize::MAX)).transpose()?;
        let map = self.map(map)?;
        let measured = Measured::new("data", data, &map)?;
        let unseen = test.map(|test| Measured::new("test", test, &map)).transpose()?;
        let ((job, report), notes) = run(py, threads, progress, |notes| {
            let machine = self.machine.clone();
            let test = unseen.as_ref().map(|test| Data::read(test.source(), &map)).transpose()?;
            let accept = map.limits("accept", accept, &machine.spec)?;
            let data = Data::read(measured.source(), &map)?;
            test.iter().chain([&data]).for_each(|data| unusable(data, notes));
            let data = resample.map_or_else(|| data.clone(), |number| data.resampled(0, number));
            let job = Identify { machine, map, data, test, terms, harmonics: Vec::new(), settings, accept };
            let report = job.run(notes)?;
            Ok((job, report))
        })?;
        let (report, spec, map) = (Arc::new(report), job.machine.spec.clone(), job.map.clone());
        let document = move |report: &_| views::identification(&spec, &map, report);
        let found = Report::from_document("identify", &report, notes, document)?.with_spec("found.toml");
        let found = found.with_rows(report.residual_rows());
        let found = found.with_pages(move || {
            let Identify { machine, map, .. } = &job;
            let test = unseen.iter().map(|test| ("test", test.source()));
            let files = [("measurements", measured.source())].into_iter().chain(test);
            let document = views::identification(&machine.spec, map, &report);
            let page = document.measured_page(machine, Some(map), files, report.residuals(), &mut ())?;
            let spec = report.found.identified_spec(&machine.spec, &spec_text, "found.toml")?;
            let map = report.found.identified_map(map, &machine.spec, "found.map.toml")?;
            let files = [("report.html", page), ("found.toml", spec.text), ("found.map.toml", map)];
            Ok(files.map(|(name, text)| (name.into(), text)).to_vec())
        });
        found.create(py)
    }
}

/// Parses one or several names of families of terms.
fn families(terms: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Family>> {
    let names: Vec<String> = match terms {
        None => Vec::new(),
        Some(one) if one.is_instance_of::<PyString>() => vec![one.extract()?],
        Some(several) => several.extract()?,
    };
    let families = names.iter().map(|name| named("terms", name, TERMS));
    Ok(families.collect::<PyResult<Vec<_>>>()?.concat())
}

/// Parses a prior: a number, "spec" or "auto".
fn expected(prior: Option<&Bound<'_, PyAny>>) -> PyResult<Prior> {
    let Some(prior) = prior else { return Ok(Prior::default()) };
    let read = match prior.extract::<String>() {
        Ok(text) => text.parse().ok(),
        Err(_) => prior.extract().ok().and_then(|value| share(value).ok()).map(Prior::Share),
    };
    read.ok_or_else(|| PyTypeError::new_err("`prior` is a share from 0 to 1, \"spec\" or \"auto\""))
}
