//! Identification job, from data to report.

use abbe_spec::option::{MEASURE_NEW_STATION, TEST};
use std::borrow::Cow;
use std::collections::HashSet;

use abbe::identify::{
    Comparison, Configurations, Distances, Failure, Figures, Fit, Independent, Model, Selection,
    deviation_beyond, drift, student_factor,
};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;

use super::alternatives::{Explanations, target_on_axis};
use super::as_joint_errors::AsJointErrors;
use super::between_stations::include_between_stations;
use super::candidates::competing;
use super::choose::{Chosen, choose};
use super::compare::compare;
use super::complete_fit::FitInput;
use super::counts::Counts;
use super::derived::{Derived, derived, has_one_station, with_columns, with_inputs};
use super::drift::ResidualDrift;
use super::extrapolation::TestExtrapolation;
use super::families::{Family, Harmonics};
use super::found_model::FoundModel;
use super::indistinguishable::indistinguishable;
use super::instruments::{coordinate_fits, instrument_fits, unequal_note};
use super::known_distances::known_distance_fits;
use super::leg_terms::leg_terms;
use super::options::{LOSSES, Settings, TERMS};
use super::parameters::{magnitudes, parameters};
use super::plausibility::{check_lengths, tool_note};
use super::point_residuals::{EvaluatedModel, PointResidual};
use super::profiles::find_profiles;
use super::read_back::{ReadBack, not_read_back, read_back};
use super::report::{
    Certainty, Compared, CrossValidation, Indices, LeftOut, Pair, Redundant, Report, TermGain,
};
use super::scale::scale_note;
use super::setup::Setup;
use super::solve::Solved;
use super::terms::Term;
use super::train_test_overlap::{overlap_warning, train_test_overlap};
use super::undetermined::UndeterminedDirections;
use super::unexplained::unexplained;
use super::unread::without_unread;
use super::weakly_determined::WeaklyDetermined;
use crate::Acceptance;
use crate::data::{Data, Map, Summary};
use abbe_study::{Machine, Notes, finite, mistake, number};

/// Identification of the errors of a machine from measurements.
pub struct Identify {
    /// Nominal machine.
    pub machine: Machine,
    /// Meaning of the columns of the data.
    pub map: Map,
    /// Measurements to fit.
    pub data: Data,
    /// Test data, used for the assessment only.
    pub test: Option<Data>,
    /// Families of richer terms to try beside constant errors. Terms are accepted by
    /// cross-validation.
    pub terms: Vec<Family>,
    /// Gear ratios: additional numbers of periods per turn.
    pub harmonics: Vec<Harmonics>,
    /// Settings of the fit.
    pub settings: Settings,
    /// Limits on the position errors of rows that were not fitted.
    pub accept: Acceptance,
}

impl Identify {
    /// Returns the options that the figures depend on.
    fn options(&self) -> Vec<(&'static str, String)> {
        let Self { machine, map: _, data: _, test: _, terms, harmonics, settings, accept } = self;
        let Settings { loss, prior, folds, time, points: _ } = settings;
        let spec = &machine.spec;
        let named = |family: &Family| TERMS.0.iter().find(|(families, ..)| *families == [*family]);
        let terms = terms.iter().filter_map(named).map(|(_, name, _)| *name);
        let harmonics = harmonics.iter().map(|Harmonics { variable, times }| {
            let times = times.iter().map(u16::to_string).collect::<Vec<_>>().join(",");
            format!("{}={times}", spec.variables[*variable].name)
        });
        machine.options_with([
            ("terms", terms.collect::<Vec<_>>().join(", ")),
            ("harmonics", harmonics.collect::<Vec<_>>().join(", ")),
            ("robust", LOSSES.name(*loss).to_owned()),
            ("prior", prior.to_string()),
            ("folds", folds.to_string()),
            ("time", time.map_or_else(String::new, |time| format!("{} s", time.as_secs_f64()))),
            ("accept", accept.text(spec.length)),
        ])
    }

    /// Fits the data and selects terms on them alone, then assesses the result on the test data, if
    /// there are any.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        self.run_on(Cow::Borrowed(&self.data), self.test.as_ref().map(Cow::Borrowed), notes)
    }

    /// Runs the identification and consumes the data, so that they are never in memory twice.
    pub fn run_once(&mut self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let (data, test) = (std::mem::take(&mut self.data), self.test.take());
        self.run_on(Cow::Owned(data), test.map(Cow::Owned), notes)
    }

    fn run_on(
        &self,
        data: Cow<'_, Data>,
        test: Option<Cow<'_, Data>>,
        notes: &mut dyn Notes,
    ) -> Result<Report, Diagnostics> {
        let Self { machine, map, settings, .. } = self;
        let overlap = test.as_deref().map_or(0, |test| train_test_overlap(&data, test));
        if let Some(warning) =
            test.as_deref().and_then(|test| overlap_warning(overlap, test.observations.len()))
        {
            notes.warn(&format!(
                "{warning}; measure separate test data, or omit {TEST} and rely on \
                 cross-validation"
            ));
        }
        if !self.terms.is_empty() || !self.harmonics.is_empty() {
            machine.require_chain(
                "no richer terms can be selected",
                "leave `terms` and `harmonics` out, or declare the terms as sources with a `magnitude` in the spec",
            )?;
        }
        map.carried_targets(machine).iter().for_each(|warning| notes.warn(warning));
        let derived = derived(&machine.spec, map, &self.terms, &data);
        let spec = with_inputs(&machine.spec, &derived);
        let nominal = Interpreter::new(spec.clone());
        let completed = |data, fitted| {
            with_columns(&nominal, &spec, &derived, Data::complete(data, map, &nominal, &spec), fitted)
        };
        let data = completed(data, true);

        let sets = competing(&spec, &derived, &self.terms, &self.harmonics);
        let input = FitInput { spec: &spec, map, data: &data, settings };
        let chosen = if sets.is_empty() { Chosen::default() } else { choose(&input, &sets, notes)? };
        let terms = [leg_terms(&spec), chosen.terms()].concat();
        let interpreter = input.interpreter(&terms);
        let (setup, solved) = input.complete_fit(&interpreter, &terms, sets.is_empty(), notes)?;
        let profiles = find_profiles(&self.terms, &spec, (&setup, &solved), &data, settings, notes)?;
        let profiled = profiles
            .found
            .as_ref()
            .map(|found| FitInput { spec: &found.added_to(&spec), ..input }.interpreter(&terms));
        let (setup, mut solved) = match (profiles.found, &profiled) {
            (Some(found), Some(profiled)) => {
                found.refit(profiled, (setup, solved), (&spec, map, &data), settings, notes)?
            }
            _ => (setup, solved),
        };
        solved.notes.extend(profiles.note);
        let plain = input.interpreter(&[]);
        let constant = match terms.is_empty() && profiled.is_none() {
            true => None,
            false => Some(input.complete_fit(&plain, &[], false, &mut ())?.1),
        };
        check_lengths(&setup, &solved.model, &solved.fit, settings.prior, &data, notes)?;
        include_between_stations(&mut solved, &setup, &data)?;
        solved.notes.extend(data.note_on_time().map(|note| format!("note: {note}")));
        let cross_validated =
            CrossValidated::new(std::mem::take(&mut solved.cross_validated), &solved, &chosen, &data);
        let test = test.map(|test| completed(test, false));
        let identified = Identified {
            setup: &setup,
            solved: &solved,
            constant: constant.as_ref(),
            cross_validated,
            chosen: &chosen,
            derived: &derived,
            overlap,
        };
        finite(&data.file, report(self, &identified, &data, test.as_deref())?)
    }
}

/// Result of the fit and of the selection.
struct Identified<'a> {
    setup: &'a Setup<'a>,
    solved: &'a Solved<'a>,
    /// Fit of constant errors alone, if the model has richer terms or profiles.
    constant: Option<&'a Solved<'a>>,
    cross_validated: CrossValidated,
    chosen: &'a Chosen,
    derived: &'a [Derived],
    /// Number of test rows that are also rows of the fit.
    overlap: usize,
}

/// Position errors of the cross-validation, and the improvement over constant errors alone if
/// richer terms were tried.
#[derive(Clone, Copy)]
struct CrossValidated {
    figures: Figures,
    gain: Option<Comparison>,
}

impl CrossValidated {
    fn new(cross_validated: Distances, solved: &Solved, chosen: &Chosen, data: &Data) -> Self {
        // A comparison needs the same rows, hence the same outliers.
        let rejected: Vec<u64> = solved.fit.rejected(&data.observations).map(|row| row.line).collect();
        let constant = chosen.constant.as_ref().filter(|constant| constant.rejected == rejected);
        let gain = constant.map(|constant| cross_validated.compared_with(&constant.cross_validated));
        Self { figures: cross_validated.into_figures(), gain }
    }
}

/// Largest change of the machine by first-order conversion to numbers of the chain, as a share of
/// the residual.
const CONVERSION_TOLERANCE: f64 = 0.01;

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
        constant,
        cross_validated: CrossValidated { figures: cross_validated, gain: gain_of_terms },
        chosen,
        derived,
        overlap,
    } = *identified;
    let spec = &machine.spec;
    let Solved { model, fit, .. } = solved;
    let identifiable = &fit.identifiable;
    let name = |k: usize| model.name(model.unknowns[k]);
    let rows = &data.observations;
    let fail = |failure: Failure| mistake::whole(&data.file, &failure);
    let scale = scale_note(&setup.real, rows, &setup.moved(rows)).map_err(fail)?;
    let groups = indistinguishable(model, &rows[0].q, &setup.moved(rows), setup.pose)
        .map_err(|error| mistake::whole(&data.file, &error))?;
    let compared_fit = compare(solved, constant, &setup.delivered, data, |i| fit.is_kept(i))?;
    refuse_worse(&compared_fit, data, setup)?;
    let instruments = instrument_fits(model, map, data, fit).map_err(fail)?;
    let coordinates = coordinate_fits(model, map, data, fit).map_err(fail)?;
    let unequal = unequal_note(&coordinates);
    let o = identifiable.observability;
    let length = setup.real.uncertainty.length;
    let test = test.map(|test| comparable(test, data, model)).transpose()?;
    let test = test.as_deref();
    let assess = |test: &Data| compare(solved, constant, &setup.delivered, test, |_| true);
    let test_sizes = test.map(assess).transpose()?;
    let accepted = match &test_sizes {
        Some(test) => job.accept.verdict("the test rows", &test.after),
        None => job.accept.verdict("cross-validation", &cross_validated.into()),
    };
    let files: Vec<Summary> = std::iter::once(data).chain(test).map(Data::summary).collect();
    let parameters = parameters(setup, solved, spec);
    let joint_errors = AsJointErrors::new(spec, model, fit);
    let left = compared_fit.after.rms;
    let difference = joint_errors.difference(spec, setup, solved, rows);
    let difference = difference.map_err(|failure| mistake::whole(&data.file, &failure))?;
    let converted = Some(&joint_errors).filter(|_| difference <= CONVERSION_TOLERANCE * left);
    let explanations = Explanations::new(spec, setup, model, fit);
    let joint_errors = joint_errors.joint_errors(&explanations, model, fit);
    let found = FoundModel {
        derived: derived.to_vec(),
        joint_errors: joint_errors.clone(),
        undetermined: UndeterminedDirections::new(setup, solved, converted, rows).map_err(fail)?,
        estimated: instruments.iter().chain(&coordinates).filter(|one| one.estimated).cloned().collect(),
        unexplained: unexplained(setup, solved, rows, left).map_err(fail)?,
        ..FoundModel::new(spec, solved, converted, data, setup.pose, [left, cross_validated.rms])
    };
    let note = |written: &ReadBack| found.read_back_note(spec, [written.figures.rms, left], length);
    let (read_back_note, written) = match read_back(&found, machine, map, data, |i| fit.is_kept(i)) {
        Ok(written) => (written.as_ref().and_then(note), written),
        // The fit is not lost.
        Err(mistake) => (Some(not_read_back(&mistake)), None),
    };
    let drift = drift(model, &fit.kept(rows).collect::<Vec<_>>(), &fit.x).map_err(fail)?;
    let extrapolation = |test: &Data| match &written {
        Some(written) => {
            TestExtrapolation::new(&found.fitted, &found.as_written(spec, test), Some(&written.machine))
        }
        None => TestExtrapolation::new(&found.fitted, test, None),
    };
    let rejected: Vec<u64> = fit.rejected(rows).map(|row| row.line).collect();
    let no_drift = (job.terms.contains(&Family::Drift) && !has_one_station(data)).then(|| {
        "note: drift terms were not tried, because along these rows time cannot be distinguished \
         from the station"
            .to_owned()
    });
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
            .saturating_sub(groups.len() + identifiable.weak.len()),
        weakly_determined: WeaklyDetermined::all(model, identifiable, spec.length),
        groups,
        joint_errors,
        target_on_axis: target_on_axis(setup, rows).map_err(fail)?,
        magnitudes: magnitudes(spec, solved),
        parameters,
        redundant: identifiable
            .redundant
            .iter()
            .map(|(k, acts_as)| Redundant {
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
        instruments,
        known_distances: known_distance_fits(model, fit),
        coordinates,
        base: setup.ideal.stations[0].pose.rows().map(|row| row.map(|entry| entry + 0.0)),
        fit: compared_fit,
        test: test_sizes,
        test_rows_of_the_fit: overlap,
        accepted,
        extrapolated: test.and_then(extrapolation),
        cross_validation: CrossValidation {
            folds: settings.folds.clamp(2, Configurations::new(rows).count.max(2)),
            configurations: cross_validated.configurations,
            constant: chosen.constant.as_ref().map(|constant| constant.cross_validated.figures().into()),
            after: cross_validated.into(),
            gain: gain_of_terms.map(Into::into),
        },
        terms: chosen
            .groups
            .iter()
            .map(|(terms, selection)| gain(spec, &found, terms, selection, length))
            .collect(),
        tried: chosen.tried,
        profiles: solved.profiles.clone(),
        drift: drift.map(ResidualDrift::new),
        unusable: files.iter().flat_map(LeftOut::of_file).collect(),
        rejected,
        notes: solved
            .notes
            .iter()
            .chain(&chosen.notes[..])
            .cloned()
            .chain(scale)
            .chain(unequal)
            .chain(tool_note(setup, model, fit))
            .chain(no_drift)
            .chain(read_back_note)
            .chain(test_sizes.and_then(|test| test.note_on_terms(spec.length)))
            .collect(),
        record: map.record.with_options(job.options()),
        points,
        files,
        placed: found.placed.clone(),
        found,
    })
}

/// Returns an error if the fit ends worse than it began: the model then does not describe these
/// data.
fn refuse_worse(compared: &Compared, data: &Data, setup: &Setup) -> Result<(), Diagnostics> {
    let (before, after) = (compared.before.rms, compared.after.rms);
    if after <= 1.5 * before || after <= 10.0 * setup.real.uncertainty.length {
        return Ok(());
    }
    let length = |value| number::length(value, setup.description.length);
    let message = format!(
        "the fit increases the errors: the root mean square is {} with the nominal machine and {} \
         with the fitted one",
        length(before),
        length(after)
    );
    let help = match setup.pose {
        true => {
            "check the orientation convention and `angle_uncertainty`: positions and orientations \
             contradict each other"
        }
        false => "check `uncertainty`, and check that these are measurements of this machine",
    };
    Err(mistake::with_help(&data.file, message, help))
}

/// Describes the improvement by a group of terms. `length` is the uncertainty of the instrument in
/// the length unit.
fn gain(spec: &Spec, found: &FoundModel, terms: &[Term], selection: &Selection, length: f64) -> TermGain {
    let whole = with_inputs(spec, &found.derived);
    let of_group = || found.terms.iter().filter(|one| terms.contains(&one.term));
    TermGain {
        name: terms.first().map_or(String::new(), |term| term.group(&whole)),
        lines: of_group().map(|one| found.lines(spec, one)).collect(),
        written: of_group().all(|one| found.is_expressible(spec, one)),
        // Root mean square of a coordinate; that of a point is √3 times as large.
        before: selection.before * length,
        after: selection.after * length,
        f: selection.test.f,
        p: selection.test.p,
    }
}

/// Returns the residuals of every point, for plots.
fn points(solved: &Solved, data: &Data, test: Option<&Data>) -> Result<Vec<PointResidual>, Diagnostics> {
    let Solved { simple, simple_x, model, fit, .. } = solved;
    let (mut before, mut after) = (EvaluatedModel::new(simple, simple_x), EvaluatedModel::new(model, &fit.x));
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

fn unknown_station(test: &Data, name: &str) -> Diagnostics {
    let message = format!("there is no station `{}` in the fitted data", name.escape_debug());
    let help = format!("fit a station of the identified machine by `{MEASURE_NEW_STATION}`");
    mistake::with_help(&test.file, message, help)
}

/// Returns the test rows at the stations of the fit, with the readings whose instruments it
/// located.
fn comparable<'d>(test: &'d Data, data: &Data, model: &Model) -> Result<Cow<'d, Data>, Diagnostics> {
    let placed = test.at_stations(data).map_err(|name| unknown_station(test, &name))?;
    without_unread(model, &data.observations, placed).ok_or_else(|| nothing_placed(&test.file))
}

/// Returns the error that the test rows read only instruments that the fitted rows do not read.
fn nothing_placed(file: &str) -> Diagnostics {
    let message = "the fitted rows read none of the instruments of these rows, whose places are unknown";
    let help =
        format!("fit rows that read the same instruments, or omit {TEST} and rely on cross-validation");
    mistake::with_help(file, message, help)
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
