//! What is asked, and the way to what comes out.

use abbe::identify::{Model, Observation, Place, Unknown, groups};
use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::expr::LengthUnit;
use abbe_interpreter::Interpreter;

use super::alike::Alike;
use super::counts::Counts;
use super::extended::extended;
use super::found::FoundModel;
use super::meaning::meanings;
use super::not_known::NotKnown;
use super::readings::check_readings;
use super::report::{
    Compared, CrossValidation, Held, Indices, Kind, LeftOut, Pair, Parameter, Report, Sizes, TermGain,
};
use super::setup::Setup;
use super::solve::{Settings, Solved, solve};
use super::terms::{Family, candidates};
use crate::data::{Data, Map, Summary};
use crate::{Acceptance, Machine, Notes, mistake, number};

/// Which errors has this machine?
pub struct Identify {
    /// The nominal machine.
    pub machine: Machine,
    /// What the columns of the data are.
    pub map: Map,
    /// The measurements.
    pub data: Data,
    /// Measurements to judge by: nothing is chosen after them.
    pub test: Option<Data>,
    /// Richer terms to try beside constant errors; those stay that help on rows left out in turn.
    pub terms: Vec<Family>,
    /// How it is done.
    pub settings: Settings,
    /// Limits for rows that nothing was fitted to.
    pub accept: Acceptance,
}

impl Identify {
    /// Fits, judges and chooses on the data alone; then judges by the test data, if there are any.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine, map, data, .. } = self;
        let candidates = candidates(&machine.spec, &self.terms);
        let terms = candidates.concat();
        let spec = extended(&machine.spec, &terms);
        let interpreter = Interpreter::new(spec);
        let mut setup = Setup::new(&interpreter, map, data, terms.len())?;
        check_readings(&setup, map, data)?;
        setup.come_near(data).map_err(|failure| mistake::whole(&data.file, failure))?;
        let solved = solve(&setup, data, &candidates, &self.settings, notes)?;
        report(self, &setup, &solved)
    }
}

fn report(job: &Identify, setup: &Setup, solved: &Solved) -> Result<Report, Diagnostics> {
    let Identify { machine, map, data, test, settings: Settings { folds, .. }, .. } = job;
    let spec = &machine.spec;
    let Solved { model, fit, .. } = solved;
    let identifiable = &fit.identifiable;
    let name = |k: usize| model.name(model.unknowns[k]);
    let rows = &data.observations;
    let alike = groups(model, &rows[0].q, &setup.moved(rows), setup.pose)
        .map_err(|error| mistake::whole(&data.file, error))?;
    let compared_fit = compared(solved, &setup.delivered, data, &fit.kept(rows).collect::<Vec<_>>())?;
    refuse_worse(&compared_fit, data, setup, map)?;
    let judged = |test: &Data| {
        let test = test.at_stations(data).map_err(|name| elsewhere(test, &name))?;
        compared(solved, &setup.delivered, &test, &test.observations.iter().collect::<Vec<_>>())
    };
    let o = identifiable.observability;
    let length = map.uncertainty.length;
    let test_sizes = test.as_ref().map(judged).transpose()?;
    let accepted = match &test_sizes {
        Some(test) => job.accept.judge("the test rows", &test.after),
        None => job.accept.judge("rows left out in turn", &solved.crossed.into()),
    };
    let files: Vec<Summary> = std::iter::once(data).chain(test).map(Data::summary).collect();
    let parameters = parameters(setup, solved, spec.length);
    let found = FoundModel::new(spec, solved, data, setup.pose, compared_fit.after.rms);
    Ok(Report {
        name: spec.name.clone(),
        length: spec.length.symbol(),
        title: map.title.clone(),
        rank: identifiable.rank,
        unknowns: model.unknowns.len(),
        machine: Counts::new(model, identifiable),
        gap: Some(identifiable.gap).filter(|gap| gap.is_finite()),
        condition: o.condition,
        observability: Indices { o1: o.o1, o2: o.o2, o3: o.o3, o4: o.o4, o5: o.o5 },
        unexplained: (model.unknowns.len() - identifiable.rank)
            .saturating_sub(alike.len() + identifiable.weak.len()),
        not_known: NotKnown::all(model, identifiable, spec.length),
        groups: alike.iter().map(|group| Alike::new(group, model, setup.description)).collect(),
        meanings: meanings(spec, model, fit),
        parameters,
        held: identifiable
            .held
            .iter()
            .map(|(k, acts_as)| Held {
                name: name(*k),
                acts_as: acts_as.iter().map(|(j, factor)| (name(*j), *factor)).collect(),
            })
            .collect(),
        correlations: fit
            .correlations(0.9)
            .into_iter()
            .map(|(a, b, correlation)| Pair { of: [name(a), name(b)], correlation })
            .collect(),
        uncertainty_factor: fit.sigma,
        base: setup.ideal.stations[0].pose.rows().map(|row| row.map(|entry| entry + 0.0)),
        fit: compared_fit,
        test: test_sizes,
        accepted,
        cross_validation: CrossValidation {
            folds: (*folds).min(rows.len()),
            constant: solved.constant.map(Sizes::from),
            after: solved.crossed.into(),
        },
        terms: solved
            .chosen
            .iter()
            .map(|(terms, selection)| TermGain {
                name: terms.first().map_or(String::new(), |term| term.group(spec)),
                // Of a coordinate; of a point it is √3 as much.
                before: selection.before * length,
                after: selection.after * length,
                f: selection.test.f,
                p: selection.test.p,
            })
            .collect(),
        unusable: files.iter().flat_map(LeftOut::of_file).collect(),
        rejected: fit.rejected(rows).map(|row| row.line).collect(),
        notes: solved.notes.clone(),
        files,
        placed: found.placed.clone(),
        found,
    })
}

/// A fit that ends worse than it began has nothing to say: the model cannot be that of these data.
fn refuse_worse(compared: &Compared, data: &Data, setup: &Setup, map: &Map) -> Result<(), Diagnostics> {
    let (before, after) = (compared.before.rms, compared.after.rms);
    if after <= 1.5 * before || after <= 10.0 * map.uncertainty.length {
        return Ok(());
    }
    let length = |value| number::length(value, setup.description.length);
    let message = format!(
        "the fit ends worse than it began: the machine as its spec has it misses the positions by {} (root mean square), \
         the fitted one by {}",
        length(before),
        length(after)
    );
    let help = match setup.pose {
        true => {
            "positions and orientations contradict each other: is the orientation read as it was written, and `angle_uncertainty` right?"
        }
        false => "is `uncertainty` right, and are these measurements of this machine?",
    };
    Err(mistake::with_help(&data.file, message, help))
}

fn parameters(setup: &Setup, solved: &Solved, length: LengthUnit) -> Vec<Parameter> {
    let Solved { model, fit, .. } = solved;
    let (deviations, hardly) = (fit.standard_deviations(), fit.hardly_known());
    let parameter = |k: &usize| {
        let unknown = model.unknowns[*k];
        let (frame, rotation) = match unknown {
            Unknown::Base(_, component) => (Some(0), component.is_rotation()),
            Unknown::Error(frame, component) => (Some(frame + 1), component.is_rotation()),
            Unknown::Tool(component) => (None, component.is_rotation()),
            Unknown::Fixture(fixture, _) => {
                (None, matches!(model.fixtures[fixture].place, Place::Direction(_)))
            }
            Unknown::Zero(reading) => (None, model.readings[reading].gauge.is_angle()),
            Unknown::Target(..) | Unknown::Magnitude(_) => (None, false),
        };
        let frame_name =
            |frame: usize| frame.checked_sub(1).map_or("base", |i| &setup.description.frames[i].name);
        let kind = match unknown {
            Unknown::Base(..) => Kind::Station,
            unknown if unknown.is_placement() => Kind::Placement,
            _ => Kind::Machine,
        };
        Parameter {
            kind,
            name: model.name(unknown),
            frame,
            frame_name: frame.map(|frame| frame_name(frame).to_owned()),
            value: fit.x[*k] + 0.0,
            standard_deviation: deviations[*k].unwrap_or_default(),
            unit: match unknown {
                Unknown::Magnitude(_) => "",
                _ if rotation => "rad",
                _ => length.symbol(),
            },
            hardly_known: hardly.contains(k),
        }
    };
    fit.identifiable.kept.iter().map(parameter).collect()
}

fn elsewhere(test: &Data, name: &str) -> Diagnostics {
    let message = format!("rows of station `{}`, where none of the data was measured", name.escape_debug());
    let help = "`abbe measure --station new` finds a station for the machine that is identified";
    mistake::with_help(&test.file, message, help)
}

fn compared(
    solved: &Solved,
    delivered: &Model,
    data: &Data,
    rows: &[&Observation],
) -> Result<Compared, Diagnostics> {
    let sizes = |model: &Model, x: &[f64]| {
        let figures = model.figures(rows.iter().copied(), x);
        figures.map(Sizes::from).map_err(|failure| mistake::whole(&data.file, failure))
    };
    Ok(Compared {
        rows: rows.len(),
        before: sizes(delivered, &[])?,
        base_and_tool: sizes(&solved.simple, &solved.simple_fit.x)?,
        after: sizes(&solved.model, &solved.fit.x)?,
    })
}
