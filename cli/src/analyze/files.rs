//! The results of every configuration as CSV: all digits, units in the heading, the coherent ones of the spec.

use std::io::Write;
use std::path::Path;

use abbe::VariableKind;
use abbe::analysis::{Configuration, Figures, Row};
use abbe_spec::Spec;
use abbe_spec::cell::harmless;
use abbe_study::analyze::{Analyze, Drawn, Report, reason};
use abbe_study::number::class;
use abbe_study::study_file::{CombinedFigure, Metric};
use csv::{Writer, WriterBuilder};

use crate::failure::Failure;
use crate::output::{Outputs, Pending};

/// The files of a folder; none appears before all are complete.
pub(crate) struct Files {
    /// Every configuration; parts hold none.
    configurations: Option<Writer<Pending>>,
    sources: Writer<Pending>,
    unreachable: Writer<Pending>,
    /// What was drawn, if anything is to be.
    monte_carlo: Option<Writer<Pending>>,
    /// The page that holds everything.
    page: Pending,
    moved: Moved,
    /// The first thing that went wrong during the sweep.
    failure: Option<csv::Error>,
}

/// Which parameters and inputs a workspace moves.
pub(crate) struct Moved {
    parameters: Vec<usize>,
    inputs: Vec<usize>,
}

impl Moved {
    pub(crate) fn new(job: &Analyze) -> Self {
        Self { parameters: job.varying(), inputs: job.moving_inputs() }
    }
}

impl Files {
    /// Begins the files; makes the folder if there is none.
    pub(super) fn create(
        folder: &Path,
        outputs: &mut Outputs,
        spec: &Spec,
        moved: Moved,
        drawn: bool,
    ) -> Result<Self, Failure> {
        outputs.folder(folder)?;
        let configurations = writer(outputs.file(&folder.join("configurations.csv"))?);
        let files = Self::begin(folder, outputs, moved, drawn)?;
        let mut files = Self { configurations: Some(configurations), ..files };
        let unit = spec.length.symbol();
        let mut heading = vec!["configuration".to_owned()];
        heading.extend(names(spec, &files.moved));
        let sources = spec.enabled_sources().map(|source| source.name.as_str());
        for what in ["ideal"].into_iter().chain(sources).chain(["repeatable", "random"]) {
            heading.extend(
                ["x", "y", "z"].map(|axis| harmless(&format!("{what} {axis} ({unit})")).into_owned()),
            );
        }
        files.keep(|files| files.each(&heading));
        Ok(files)
    }

    /// Begins those that need no single configurations; makes the folder if there is none.
    pub(crate) fn of_parts(
        folder: &Path,
        outputs: &mut Outputs,
        moved: Moved,
        drawn: bool,
    ) -> Result<Self, Failure> {
        outputs.folder(folder)?;
        Self::begin(folder, outputs, moved, drawn)
    }

    fn begin(folder: &Path, outputs: &mut Outputs, moved: Moved, drawn: bool) -> Result<Self, Failure> {
        let mut begin = |name: &str| outputs.file(&folder.join(name));
        Ok(Self {
            configurations: None,
            sources: writer(begin("sources.csv")?),
            unreachable: writer(begin("unreachable.csv")?),
            monte_carlo: if drawn { Some(writer(begin("monte_carlo.csv")?)) } else { None },
            page: begin(abbe_report::PAGE)?,
            moved,
            failure: None,
        })
    }

    fn each(&mut self, record: &[String]) -> csv::Result<()> {
        self.configurations.as_mut().map_or(Ok(()), |writer| writer.write_record(record))
    }

    /// Writes what the sweep sees.
    pub(super) fn configuration(&mut self, row: &Row) {
        let values = values(row.configuration, &self.moved);
        let pose = row.pose.position();
        let sources = row.sources.iter().flat_map(|source| &source[..3]);
        let together = row.repeatable[..3].iter().chain(&row.random[..3]);
        let numbers = pose.iter().chain(sources).chain(together).map(number);
        let record = std::iter::once(row.index.to_string()).chain(values).chain(numbers).collect::<Vec<_>>();
        self.keep(|files| files.each(&record));
    }

    /// Writes the other files. All are complete but for the page.
    pub(super) fn finish(mut self, report: &Report) -> Result<(Vec<Pending>, Pending), Failure> {
        self.keep(|files| write_sources(&mut files.sources, report));
        self.keep(|files| write_unreachable(&mut files.unreachable, report));
        self.keep(|files| match (&mut files.monte_carlo, &report.monte_carlo) {
            (Some(writer), Some(drawn)) => write_drawn(writer, report, drawn),
            _ => Ok(()),
        });
        if let Some(error) = self.failure {
            return Err(Failure::of("--out", format!("cannot write the files: {error}")));
        }
        let always = self.configurations.into_iter().chain([self.sources, self.unreachable]);
        let all = always.chain(self.monte_carlo).map(Writer::into_inner);
        let all = all.map(|file| file.map_err(|error| Failure::of("--out", error.error())));
        Ok((all.collect::<Result<_, _>>()?, self.page))
    }

    fn keep(&mut self, write: impl FnOnce(&mut Self) -> csv::Result<()>) {
        if self.failure.is_none() {
            self.failure = write(self).err();
        }
    }
}

/// A name that begins with # is no comment.
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
            let [x, y, z, norm] = [x, y, z, norm].map(|figure| number(&figure));
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
        let [x, y, z] = axes.map(|axis| axis.as_ref().map(number).unwrap_or_default());
        let (norm, worst) = (number(&norm), index(worst.configuration));
        writer.write_record(["all together", "", name, &x, &y, &z, &norm, &worst])?;
    }
    for (name, axes, norm) in [
        ("random standard deviation", combined.standard_deviation, combined.standard_radius),
        ("worst case", combined.worst_case, combined.worst_case_radius),
    ] {
        let ([x, y, z], worst) = (axes.map(|axis| number(&axis)), index(norm.configuration));
        writer.write_record(["all together", "", name, &x, &y, &z, &number(&norm.value), &worst])?;
    }
    Ok(())
}

/// A row for each quantile of the norm, the largest, the mean and the standard deviation, at both places.
fn write_drawn(writer: &mut Writer<impl Write>, report: &Report, drawn: &Drawn) -> csv::Result<()> {
    let unit = report.spec.length.symbol();
    let figures =
        ["norm", "standard error of the norm", "x", "y", "z"].map(|figure| format!("{figure} ({unit})"));
    let heading = ["at", "draws", "seed", "figure"].map(str::to_owned).into_iter().chain(figures);
    writer.write_record(heading.collect::<Vec<_>>())?;
    for (place, found) in drawn.places() {
        let (draws, seed) = (found.draws.to_string(), drawn.seed.to_string());
        let mut row = |figure: &str, cells: [String; 5]| {
            let head = [place, &draws, &seed, figure].map(str::to_owned);
            writer.write_record(head.into_iter().chain(cells).collect::<Vec<_>>())
        };
        let none = String::new;
        for quantile in found.quantiles {
            let name = format!("{} % quantile", 100.0 * quantile.probability);
            let error = number(&quantile.standard_error);
            row(&name, [number(&quantile.value), error, none(), none(), none()])?;
        }
        row("largest", [number(&found.largest), none(), none(), none(), none()])?;
        let [x, y, z] = found.mean.map(|mean| number(&mean));
        row("mean", [none(), none(), x, y, z])?;
        let [x, y, z] = [0, 1, 2].map(|i| number(&found.covariance[i][i].sqrt()));
        row("standard deviation", [none(), none(), x, y, z])?;
    }
    Ok(())
}

fn write_unreachable(writer: &mut Writer<impl Write>, report: &Report) -> csv::Result<()> {
    let Report { spec, budget, .. } = report;
    // Here everything may matter: nothing is known of what varies among those that were reached.
    let all =
        Moved { parameters: (0..spec.parameters.len()).collect(), inputs: (0..spec.inputs.len()).collect() };
    let unit = spec.length.symbol();
    let point = ["x", "y", "z"].map(|axis| format!("point {axis} ({unit})"));
    let heading = ["configuration".to_owned()].into_iter().chain(names(spec, &all)).chain(point);
    let heading = heading.chain(["reason".to_owned()]);
    writer.write_record(heading.collect::<Vec<_>>())?;
    for refused in &budget.unreachable.first {
        let reason = reason(refused, spec);
        let point = [0, 1, 2].map(|i| refused.point.map(|point| number(&point[i])).unwrap_or_default());
        let asked = [refused.index.to_string()].into_iter().chain(values(&refused.asked, &all));
        writer.write_record(asked.chain(point).chain([reason]).collect::<Vec<_>>())?;
    }
    Ok(())
}

/// The headings of a configuration.
fn names<'a>(spec: &'a Spec, moved: &'a Moved) -> impl Iterator<Item = String> + 'a {
    let length = spec.length.symbol();
    let variables = spec.variables.iter().map(move |variable| match variable.kind {
        VariableKind::Revolute => format!("{} (rad)", variable.name),
        VariableKind::Prismatic => format!("{} ({length})", variable.name),
    });
    let heading = |name: &str, unit: &str| match unit {
        "" => name.to_owned(),
        unit => format!("{name} ({unit})"),
    };
    let parameters = moved.parameters.iter().map(|&i| &spec.parameters[i]);
    let parameters = parameters.map(move |parameter| heading(&parameter.name, &parameter.unit));
    let inputs = moved.inputs.iter().map(|&i| &spec.inputs[i]);
    let inputs = inputs.map(move |input| heading(&input.name, &input.unit));
    variables.chain(parameters).chain(inputs)
}

/// The values of a configuration.
fn values<'a>(configuration: &'a Configuration, moved: &'a Moved) -> impl Iterator<Item = String> + 'a {
    let parameters = moved.parameters.iter().map(|&i| &configuration.s[i]);
    let inputs = moved.inputs.iter().map(|&i| &configuration.u[i]);
    configuration.q.iter().chain(parameters).chain(inputs).map(number)
}

/// All digits; −0 is a plain 0.
fn number(value: &f64) -> String {
    (value + 0.0).to_string()
}
