//! CSV files of an analysis: all digits, coherent units of the spec, units in the headings.

use std::{io::Write, path::Path};

use abbe::analysis::{Configuration, Figures, Row};
use abbe_spec::{Spec, csv_writer::harmless};
use abbe_study::analyze::{Analyze, MonteCarloReport, Report, unreachable_reason};
use abbe_study::number::class;
use abbe_study::study_file::{CombinedFigure, Metric};
use csv::{Writer, WriterBuilder};

use crate::Result;
use crate::failure::Failure;
use crate::output::{Outputs, Pending};

/// Files of one output folder. None appears before all are complete.
pub(crate) struct Files {
    /// One row per configuration; none for merged parts, which do not store configurations.
    configurations: Option<Writer<Pending>>,
    sources: Writer<Pending>,
    unreachable: Writer<Pending>,
    /// Monte Carlo results, if there are draws.
    monte_carlo: Option<Writer<Pending>>,
    /// The HTML report.
    page: Pending,
    varying: VaryingColumns,
    /// First error during the sweep.
    failure: Option<csv::Error>,
}

/// Indices of the parameters and inputs that vary over the workspace.
pub(crate) struct VaryingColumns {
    parameters: Vec<usize>,
    inputs: Vec<usize>,
}

impl VaryingColumns {
    pub(crate) fn new(job: &Analyze) -> Self {
        Self { parameters: job.varying(), inputs: job.moving_inputs() }
    }
}

impl Files {
    /// Begins all files. Makes the folder if it does not exist.
    pub(super) fn create(
        folder: &Path,
        outputs: &mut Outputs,
        spec: &Spec,
        varying: VaryingColumns,
        drawn: bool,
    ) -> Result<Self> {
        outputs.folder(folder)?;
        let configurations = writer(outputs.file(&folder.join("configurations.csv"))?);
        let files = Self::begin(folder, outputs, varying, drawn)?;
        let mut files = Self { configurations: Some(configurations), ..files };
        let unit = spec.length.symbol();
        let mut heading = vec!["configuration".to_owned()];
        heading.extend(names(spec, &files.varying));
        let sources = spec.enabled_sources().map(|source| source.name.as_str());
        for what in ["ideal"].into_iter().chain(sources).chain(["repeatable", "random"]) {
            heading.extend(
                ["x", "y", "z"].map(|axis| harmless(&format!("{what} {axis} ({unit})")).into_owned()),
            );
        }
        files.keep(|files| files.each(&heading));
        Ok(files)
    }

    /// Begins the files that need no single configurations, in a folder that exists.
    pub(crate) fn begin(
        folder: &Path,
        outputs: &mut Outputs,
        varying: VaryingColumns,
        drawn: bool,
    ) -> Result<Self> {
        let mut begin = |name: &str| outputs.file(&folder.join(name));
        Ok(Self {
            configurations: None,
            sources: writer(begin("sources.csv")?),
            unreachable: writer(begin("unreachable.csv")?),
            monte_carlo: if drawn { Some(writer(begin("monte_carlo.csv")?)) } else { None },
            page: begin(abbe_report::PAGE)?,
            varying,
            failure: None,
        })
    }

    fn each(&mut self, record: &[String]) -> csv::Result<()> {
        self.configurations.as_mut().map_or(Ok(()), |writer| writer.write_record(record))
    }

    /// Writes one row of the sweep.
    pub(super) fn configuration(&mut self, row: &Row) {
        let values = values(row.configuration, &self.varying);
        let pose = row.pose.position();
        let sources = row.sources.iter().flat_map(|source| &source[..3]);
        let together = row.repeatable[..3].iter().chain(&row.random[..3]);
        let numbers = pose.iter().chain(sources).chain(together).map(format_number);
        let record = std::iter::once(row.index.to_string()).chain(values).chain(numbers).collect::<Vec<_>>();
        self.keep(|files| files.each(&record));
    }

    /// Writes the remaining CSV files. Returns the complete files, and the page, which is still
    /// empty.
    pub(super) fn finish(mut self, report: &Report) -> Result<(Vec<Pending>, Pending)> {
        self.keep(|files| write_sources(&mut files.sources, report));
        self.keep(|files| write_unreachable(&mut files.unreachable, report));
        self.keep(|files| match (&mut files.monte_carlo, &report.monte_carlo) {
            (Some(writer), Some(drawn)) => write_drawn(writer, report, drawn),
            _ => Ok(()),
        });
        if let Some(error) = self.failure {
            return Err(Failure::new("--out", format!("cannot write the files: {error}")));
        }
        let always = self.configurations.into_iter().chain([self.sources, self.unreachable]);
        let all = always.chain(self.monte_carlo).map(Writer::into_inner);
        let all = all.map(|file| file.map_err(|error| Failure::new("--out", error.error())));
        Ok((all.collect::<Result<_, _>>()?, self.page))
    }

    fn keep(&mut self, write: impl FnOnce(&mut Self) -> csv::Result<()>) {
        if self.failure.is_none() {
            self.failure = write(self).err();
        }
    }
}

/// Returns a writer that quotes cells that begin with `#`, so that no reader takes them for
/// comments.
fn writer(file: Pending) -> Writer<Pending> {
    WriterBuilder::new().comment(Some(b'#')).from_writer(file)
}

fn write_sources(writer: &mut Writer<impl Write>, report: &Report) -> csv::Result<()> {
    let unit = report.spec.length.symbol();
    let axes = ["x", "y", "z", "norm"].map(|axis| format!("{axis} ({unit})"));
    let heading = ["source", "class", "metric"].map(str::to_owned).into_iter().chain(axes);
    writer.write_record(heading.chain(["worst configuration".to_owned()]).collect::<Vec<_>>())?;
    let index = |worst: Option<usize>| worst.map(|worst| worst.to_string()).unwrap_or_default();
    for source in &report.sources {
        let (name, class) = (harmless(&source.name), class(source.class).0);
        for (metric_name, metric) in Metric::ALL {
            let Figures { x, y, z, norm } = source.figures(metric);
            let [x, y, z, norm] = [x, y, z, norm].map(|figure| format_number(&figure));
            let worst = index(source.configuration);
            writer.write_record([&name, class, metric_name, &x, &y, &z, &norm, &worst])?;
        }
    }
    let combined = &report.budget.combined;
    for ((name, figure), worst) in CombinedFigure::ALL.into_iter().zip([
        combined.repeatable_radius,
        combined.random_radius,
        combined.radius,
    ]) {
        let (axes, norm) = report.combined_figure(figure);
        let [x, y, z] = axes.map(|axis| axis.as_ref().map(format_number).unwrap_or_default());
        let (norm, worst) = (format_number(&norm), index(worst.configuration));
        writer.write_record(["all together", "", name, &x, &y, &z, &norm, &worst])?;
    }
    for (name, axes, norm) in [
        ("random standard deviation", combined.standard_deviation, combined.standard_radius),
        ("worst case", combined.worst_case, combined.worst_case_radius),
    ] {
        let ([x, y, z], worst) = (axes.map(|axis| format_number(&axis)), index(norm.configuration));
        writer.write_record(["all together", "", name, &x, &y, &z, &format_number(&norm.value), &worst])?;
    }
    Ok(())
}

/// Writes, for the worst configuration and for home, one row per quantile of the norm, and rows of
/// the largest norm, the mean and the standard deviation.
fn write_drawn(table: &mut Writer<impl Write>, report: &Report, drawn: &MonteCarloReport) -> csv::Result<()> {
    let unit = report.spec.length.symbol();
    let figures =
        ["norm", "standard error of the norm", "x", "y", "z"].map(|figure| format!("{figure} ({unit})"));
    let heading = ["at", "draws", "seed", "figure"].map(str::to_owned).into_iter().chain(figures);
    table.write_record(heading.collect::<Vec<_>>())?;
    for (place, found) in drawn.results() {
        let (draws, seed) = (found.draws.to_string(), drawn.seed.to_string());
        let mut row = |figure: &str, cells: [String; 5]| {
            let head = [place, &draws, &seed, figure].map(str::to_owned);
            table.write_record(head.into_iter().chain(cells).collect::<Vec<_>>())
        };
        let none = String::new;
        for quantile in found.quantiles {
            let name = format!("{} % quantile", 100.0 * quantile.probability);
            let error = format_number(&quantile.standard_error);
            row(&name, [format_number(&quantile.value), error, none(), none(), none()])?;
        }
        row("largest", [format_number(&found.largest), none(), none(), none(), none()])?;
        let [x, y, z] = found.mean.map(|mean| format_number(&mean));
        row("mean", [none(), none(), x, y, z])?;
        let [x, y, z] = [0, 1, 2].map(|i| format_number(&found.covariance[i][i].sqrt()));
        row("standard deviation", [none(), none(), x, y, z])?;
    }
    Ok(())
}

fn write_unreachable(writer: &mut Writer<impl Write>, report: &Report) -> csv::Result<()> {
    let Report { spec, budget, .. } = report;
    // All parameters and inputs are listed: those that vary are known only for reached
    // configurations.
    let all = VaryingColumns {
        parameters: (0..spec.parameters.len()).collect(),
        inputs: (0..spec.inputs.len()).collect(),
    };
    let unit = spec.length.symbol();
    let point = ["x", "y", "z"].map(|axis| format!("point {axis} ({unit})"));
    let heading = ["configuration".to_owned()].into_iter().chain(names(spec, &all)).chain(point);
    let heading = heading.chain(["reason".to_owned()]);
    writer.write_record(heading.collect::<Vec<_>>())?;
    for refused in &budget.unreachable.first {
        let reason = unreachable_reason(refused, spec);
        let point =
            [0, 1, 2].map(|i| refused.point.map(|point| format_number(&point[i])).unwrap_or_default());
        let requested = [refused.index.to_string()].into_iter().chain(values(&refused.requested, &all));
        writer.write_record(requested.chain(point).chain([reason]).collect::<Vec<_>>())?;
    }
    Ok(())
}

/// Returns the headings of a configuration, with units.
fn names<'a>(spec: &'a Spec, varying: &'a VaryingColumns) -> impl Iterator<Item = String> + 'a {
    let length = spec.length.symbol();
    let variables = spec.variables.iter();
    let variables = variables.map(move |one| format!("{} ({})", one.name, one.kind.either("rad", length)));
    let heading = |name: &str, unit: &str| match unit {
        "" => name.to_owned(),
        unit => format!("{name} ({unit})"),
    };
    let parameters = varying.parameters.iter().map(|&i| &spec.parameters[i]);
    let parameters = parameters.map(move |parameter| heading(&parameter.name, &parameter.unit));
    let inputs = varying.inputs.iter().map(|&i| &spec.inputs[i]);
    let inputs = inputs.map(move |input| heading(&input.name, &input.unit));
    variables.chain(parameters).chain(inputs)
}

/// Returns the values of a configuration in the order of its headings.
fn values<'a>(
    configuration: &'a Configuration,
    varying: &'a VaryingColumns,
) -> impl Iterator<Item = String> + 'a {
    let parameters = varying.parameters.iter().map(|&i| &configuration.s[i]);
    let inputs = varying.inputs.iter().map(|&i| &configuration.u[i]);
    configuration.q.iter().chain(parameters).chain(inputs).map(format_number)
}

/// Formats a number with all digits, and −0 as 0.
fn format_number(value: &f64) -> String {
    (value + 0.0).to_string()
}
