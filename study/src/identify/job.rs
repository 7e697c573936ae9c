//! What is asked, and the way to what comes out.

use std::borrow::Cow;
use std::collections::HashSet;

use abbe::LengthUnit;
use abbe::identify::{
    Comparison, Configurations, Distances, Failure, Figures, Fit, Independent, Model, Place, Selection,
    Unknown, deviation_beyond, drift, student_factor,
};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;

use super::as_joint_errors::{AsJointErrors, number_terms};
use super::candidates::candidates;
use super::choose::{Chosen, choose};
use super::counts::Counts;
use super::derived::{Derived, derived, with_columns, with_inputs};
use super::drift::ResidualDrift;
use super::extended::extended;
use super::extrapolation::Extrapolation;
use super::families::{Family, Harmonics};
use super::found::FoundModel;
use super::indistinguishable::indistinguishable;
use super::instruments::{estimate, instrument_fits};
use super::magnitude::{OwnMagnitude, own_magnitudes};
use super::misread::check_interpretation;
use super::options::Settings;
use super::plausibility::check_plausibility;
use super::point_residuals::{PointResidual, Valued};
use super::report::{
    Certainty, Compared, CrossValidation, Held, Indices, Kind, LeftOut, Magnitude, Pair, Parameter, Report,
    TermGain,
};
use super::scale::scale_note;
use super::setup::Setup;
use super::solve::{Solved, solve};
use super::terms::Term;
use super::train_test_overlap::{sentence, train_test_overlap};
use super::weakly_determined::WeaklyDetermined;
use crate::data::{Data, Map, Summary};
use crate::number::digits;
use crate::{Acceptance, Machine, Notes, finite, mistake, number};

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
    /// Gear ratios: how often per turn of a joint errors are looked for as well.
    pub harmonics: Vec<Harmonics>,
    /// How it is done.
    pub settings: Settings,
    /// Limits for rows that nothing was fitted to.
    pub accept: Acceptance,
}

impl Identify {
    /// Fits, judges and chooses on the data alone; then judges by the test data, if there are any.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        self.on(Cow::Borrowed(&self.data), self.test.as_ref().map(Cow::Borrowed), notes)
    }

    /// The same for data that nobody needs afterwards: they are used up, and never there twice.
    pub fn run_once(&mut self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let (data, test) = (std::mem::take(&mut self.data), self.test.take());
        self.on(Cow::Owned(data), test.map(Cow::Owned), notes)
    }

    fn on(
        &self,
        data: Cow<'_, Data>,
        test: Option<Cow<'_, Data>>,
        notes: &mut dyn Notes,
    ) -> Result<Report, Diagnostics> {
        let Self { machine, map, settings, .. } = self;
        let known = test.as_deref().map_or(0, |test| train_test_overlap(&data, test));
        if let Some(said) = test.as_deref().and_then(|test| sentence(known, test.observations.len())) {
            notes.warn(&format!(
                "{said}; measure others, or give no test: rows of the fit are left out in turn"
            ));
        }
        let derived = derived(&machine.spec, map, &self.terms, data.observations.len());
        let spec = with_inputs(&machine.spec, &derived);
        let nominal = Interpreter::new(spec.clone());
        let completed = |data, fitted| {
            with_columns(&nominal, &spec, &derived, Data::complete(data, map, &nominal, &spec), fitted)
        };
        let data = completed(data, true);

        let stages = candidates(&spec, &derived, &self.terms, &self.harmonics);
        let chosen = match stages.is_empty() {
            true => Chosen::default(),
            false => choose(&spec, map, &data, &stages, settings, notes)?,
        };
        let (own, terms, numbers) = (own_magnitudes(&spec), chosen.terms(), number_terms(&spec));
        let interpreter = Interpreter::new(extended(&spec, &[&terms[..], &numbers].concat()));
        let mut setup = Setup::new(&interpreter, map, &data, own.len() + terms.len() + numbers.len())?;
        if stages.is_empty() {
            check_interpretation(&setup, map, &data)?;
        }
        setup.come_near(&data).map_err(|failure| mistake::whole(&data.file, &failure))?;
        if stages.is_empty() {
            check_plausibility(&setup, map, &data, notes)
                .map_err(|failure| mistake::whole(&data.file, &failure))?;
        }
        estimate(&mut setup, map, &data, settings.prior)
            .map_err(|failure| mistake::whole(&data.file, &failure))?;
        let mut solved = solve(&setup, &data, &own, &terms, settings, notes)?;
        let crossed = Crossed::new(std::mem::take(&mut solved.crossed), &solved, &chosen, &data);
        let test = test.map(|test| completed(test, false));
        let identified =
            Identified { setup: &setup, solved: &solved, crossed, chosen: &chosen, derived: &derived, known };
        finite(&data.file, report(self, &identified, &data, test.as_deref())?)
    }
}

/// What was found, and on what.
struct Identified<'a> {
    setup: &'a Setup<'a>,
    solved: &'a Solved<'a>,
    crossed: Crossed,
    chosen: &'a Chosen,
    derived: &'a [Derived],
    /// How many rows of the test are rows of the fit.
    known: usize,
}

/// How good it is on rows left out in turn, and how much better than constants alone, if richer terms were tried.
#[derive(Clone, Copy)]
struct Crossed {
    figures: Figures,
    gain: Option<Comparison>,
}

impl Crossed {
    fn new(crossed: Distances, solved: &Solved, chosen: &Chosen, data: &Data) -> Self {
        let rejected = || solved.fit.rejected(&data.observations).map(|row| row.line);
        // Other gross errors make other rows.
        let constant =
            chosen.constant.as_ref().filter(|constant| rejected().eq(constant.rejected.iter().copied()));
        let gain = constant.map(|constant| crossed.compared_with(&constant.crossed));
        Self { figures: crossed.into_figures(), gain }
    }
}

/// By how much of what is left the machine may be another one when it is said in numbers of the chain.
const SAME: f64 = 0.01;

fn report(
    job: &Identify,
    identified: &Identified,
    data: &Data,
    test: Option<&Data>,
) -> Result<Report, Diagnostics> {
    let Identify { machine, map, settings, .. } = job;
    let Identified {
        setup,
        solved,
        crossed: Crossed { figures: crossed, gain: of_terms },
        chosen,
        derived,
        known,
    } = *identified;
    let spec = &machine.spec;
    let Solved { model, fit, .. } = solved;
    let identifiable = &fit.identifiable;
    let name = |k: usize| model.name(model.unknowns[k]);
    let rows = &data.observations;
    let fail = |failure: Failure| mistake::whole(&data.file, &failure);
    let scale = scale_note(&setup.ideal, rows, &setup.moved(rows)).map_err(fail)?;
    let alike = indistinguishable(model, &rows[0].q, &setup.moved(rows), setup.pose)
        .map_err(|error| mistake::whole(&data.file, &error))?;
    let compared_fit = compared(solved, &setup.delivered, data, |i| fit.is_kept(i))?;
    refuse_worse(&compared_fit, data, setup, map)?;
    let o = identifiable.observability;
    let length = map.uncertainty.length;
    let at_stations = |test| Data::at_stations(test, data).map_err(|name| elsewhere(test, &name));
    let test = test.map(at_stations).transpose()?;
    let test = test.as_deref();
    let judged = |test: &Data| compared(solved, &setup.delivered, test, |_| true);
    let test_sizes = test.map(judged).transpose()?;
    let accepted = match &test_sizes {
        Some(test) => job.accept.judge("the test rows", &test.after),
        None => job.accept.judge("rows left out in turn", &crossed.into()),
    };
    let files: Vec<Summary> = std::iter::once(data).chain(test).map(Data::summary).collect();
    let parameters = parameters(setup, solved, spec.length);
    let joint_errors = AsJointErrors::new(spec, model, fit);
    let left = compared_fit.after.rms;
    let apart = joint_errors.difference(spec, setup, solved, rows);
    let apart = apart.map_err(|failure| mistake::whole(&data.file, &failure))?;
    let same = Some(&joint_errors).filter(|_| apart <= SAME * left);
    let found = FoundModel {
        derived: derived.to_vec(),
        ..FoundModel::new(spec, solved, same, data, setup.pose, [left, crossed.rms])
    };
    let order = drift(model, &fit.kept(rows).collect::<Vec<_>>(), &fit.x);
    let order = order.map_err(|failure| mistake::whole(&data.file, &failure))?;
    let outside = |test: &Data| {
        let outside = Extrapolation::new(solved, &found.fitted, rows, &test.observations);
        outside.map_err(|failure| mistake::whole(&test.file, &failure))
    };
    let rejected: Vec<u64> = fit.rejected(rows).map(|row| row.line).collect();
    let outside = test.map(outside).transpose()?.flatten();
    let points = if settings.points { points(solved, data, test)? } else { Vec::new() };
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
        not_known: WeaklyDetermined::all(model, identifiable, spec.length),
        groups: alike,
        meanings: joint_errors.joint_errors(spec, model, fit),
        magnitudes: magnitudes(spec, solved),
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
        certainty: Certainty::new(fit),
        instruments: instrument_fits(model, map, data, fit).map_err(fail)?,
        base: setup.ideal.stations[0].pose.rows().map(|row| row.map(|entry| entry + 0.0)),
        fit: compared_fit,
        test: test_sizes,
        test_rows_of_the_fit: known,
        accepted,
        outside,
        cross_validation: CrossValidation {
            folds: settings.folds.clamp(2, Configurations::new(rows).count.max(2)),
            configurations: crossed.configurations,
            constant: chosen.constant.as_ref().map(|constant| constant.crossed.figures().into()),
            after: crossed.into(),
            gain: of_terms.map(Into::into),
        },
        terms: chosen
            .groups
            .iter()
            .map(|(terms, selection)| gain(spec, &found, terms, selection, length))
            .collect(),
        tried: chosen.tried,
        order: order.map(|drift| ResidualDrift::new(drift, setup.description.length)),
        unusable: files.iter().flat_map(LeftOut::of_file).collect(),
        rejected,
        notes: solved.notes.iter().chain(&chosen.notes[..]).cloned().chain(scale).collect(),
        points,
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

/// `length` is the instrument's uncertainty.
fn gain(spec: &Spec, found: &FoundModel, terms: &[Term], selection: &Selection, length: f64) -> TermGain {
    let whole = with_inputs(spec, &found.derived);
    let of_group = || found.terms.iter().filter(|one| terms.contains(&one.term));
    TermGain {
        name: terms.first().map_or(String::new(), |term| term.group(&whole)),
        lines: of_group().map(|one| found.lines(spec, one)).collect(),
        written: of_group().all(|one| found.is_written(spec, one)),
        // Of a coordinate; of a point it is √3 as much.
        before: selection.before * length,
        after: selection.after * length,
        f: selection.test.f,
        p: selection.test.p,
    }
}

/// Of the sources of the spec: what was found of their magnitudes.
fn magnitudes(spec: &Spec, solved: &Solved) -> Vec<Magnitude> {
    let Solved { model, fit, own, .. } = solved;
    let deviations = fit.standard_deviations();
    let one = |own: &OwnMagnitude| {
        let of_this = |k: &usize| solved.own_magnitude(*k).is_some_and(|one| one.source == own.source);
        let k = (0..model.unknowns.len()).find(of_this);
        let (source, declared) = (spec.sources[own.source].name.clone(), own.declared.value);
        let declared_deviation = own.declared.standard_deviation;
        let standard_deviation = k.and_then(|k| deviations[k]);
        let value = declared + k.map_or(0.0, |k| fit.x[k]);
        let before = match declared_deviation {
            Some(deviation) => format!("{} ± {}", digits(declared, 3), digits(deviation, 2)),
            None => digits(declared, 3),
        };
        let sentence = match standard_deviation {
            Some(deviation) if k.is_some_and(|k| fit.hardly_known().contains(&k)) => format!(
                "the magnitude of {source} is {} ± {}, of which these data say less than the spec: {before}",
                digits(value, 3),
                digits(deviation, 2)
            ),
            Some(deviation) => format!(
                "the magnitude of {source} is {} ± {} (in the spec: {before})",
                digits(value, 4),
                digits(deviation, 2)
            ),
            None => format!(
                "the magnitude of {source} cannot be told from other errors by these data; in the spec: {before}"
            ),
        };
        Magnitude { source, declared, declared_deviation, value, standard_deviation, sentence }
    };
    own.iter().map(one).collect()
}

/// What is left of every point, for pictures.
fn points(solved: &Solved, data: &Data, test: Option<&Data>) -> Result<Vec<PointResidual>, Diagnostics> {
    let Solved { simple, simple_x, model, fit, .. } = solved;
    let (mut before, mut after) = (Valued::new(simple, simple_x), Valued::new(model, &fit.x));
    let rejected: HashSet<u64> = fit.rejected(&data.observations).map(|row| row.line).collect();
    let mut points = Vec::new();
    for (data, is_test) in [(data, false)].into_iter().chain(test.map(|test| (test, true))) {
        for row in &data.observations {
            let is_rejected = !is_test && rejected.contains(&row.line);
            let here = after.residuals(&mut before, row, is_test, is_rejected);
            points.extend(here.map_err(|failure| mistake::whole(&data.file, &failure))?);
        }
    }
    Ok(points)
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
            value: fit.x[*k] + solved.own_magnitude(*k).map_or(0.0, |own| own.declared.value) + 0.0,
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
    used: impl Fn(usize) -> bool + Sync,
) -> Result<Compared, Diagnostics> {
    let rows = &data.observations;
    let distances = |model: &Model, x: &[f64]| {
        let distances = model.distances_of(rows, |i| used(i).then_some(x));
        distances.map_err(|failure| mistake::whole(&data.file, &failure))
    };
    // One after the other: of a million rows no more are there at a time than must be.
    let before = distances(delivered, &[])?.into_figures();
    let simple = distances(&solved.simple, &solved.simple_x)?;
    let after = distances(&solved.model, &solved.fit.x)?;
    let gain = after.compared_with(&simple);
    let base_and_tool = simple.into_figures();
    let left = after.into_figures();
    Ok(Compared {
        rows: (0..rows.len()).filter(|i| used(*i)).count(),
        configurations: left.configurations,
        before: before.into(),
        base_and_tool: base_and_tool.into(),
        after: left.into(),
        gain: gain.into(),
    })
}

impl Certainty {
    fn new(fit: &Fit) -> Self {
        Self {
            configurations: fit.configurations,
            counted: match fit.independent {
                Independent::Numbers => "numbers",
                Independent::Points => "points",
                Independent::Configurations => "configurations",
            },
            freedom: fit.freedom,
            factor_95: student_factor(0.95, fit.freedom),
            p_of_factor: deviation_beyond(fit.sigma, fit.freedom),
        }
    }
}
