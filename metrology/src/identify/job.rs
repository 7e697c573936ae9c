//! Identification job, from data to report.
//!
//! Detects test rows that were also fitted and therefore cannot assess the fit.

use std::{borrow::Cow, collections::HashSet};

use abbe::identify::{Configurations, Distances, Failure, Selection, drift};
use abbe_interpreter::Interpreter;
use abbe_spec::{Spec, option::TEST};
use abbe_study::{About, Machine, Notes, Result, finite};

use super::alternatives::{Explanations, target_on_axis};
use super::between_blocks::include_between_blocks;
use super::between_stations::include_between_stations;
use super::candidates::competing;
use super::chain_numbers::leg_terms;
use super::choose::{Chosen, choose};
use super::compare::{compare, refuse_worse};
use super::derived::{Derived, derived, has_one_station, with_columns, with_inputs};
use super::found_covariance::FoundCovariance;
use super::instruments::{InstrumentFit, instrument_and_coordinate_fits, unequal_note};
use super::known_distances::known_distance_fits;
use super::options::{LOSSES, ONLY, Settings, family_name};
use super::parameters::{correlated, magnitudes, parameters, redundant};
use super::plausibility::{check_lengths, sum_note, tool_note};
use super::point_residuals::points;
use super::profiles::{FoundProfiles, find_profiles};
use super::read_back::{ReadBack, not_read_back, read_back};
use super::unexplained::unexplained;
use super::unread::comparable;
use super::{
    AsJointErrors, Certainty, Counts, CrossValidation, Family, FitInput, FoundModel, Harmonics, LeftOut,
    Parameter, Report, ResidualDrift, RowNotes, Setup, Solved, Term, TermGain, TestExtrapolation,
    WeaklyDetermined, indistinguishable, scale_note,
};
use crate::data::{Data, Map, Summary, hash};
use crate::{Acceptance, Judged};

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
        let Settings { loss, only_placement, prior, folds, time, points: _ } = settings;
        let spec = &machine.spec;
        let terms = terms.iter().map(|family| family_name(*family));
        let harmonics = harmonics.iter().map(|Harmonics { variable, times }| {
            let times = times.iter().map(u16::to_string).collect::<Vec<_>>().join(",");
            format!("{}={times}", spec.variables[*variable].name)
        });
        machine.options_with([
            ("terms", terms.collect::<Vec<_>>().join(", ")),
            ("harmonics", harmonics.collect::<Vec<_>>().join(", ")),
            ("robust", LOSSES.name(*loss).to_owned()),
            ("only", ONLY.name(*only_placement).to_owned()),
            ("prior", prior.to_string()),
            ("folds", folds.to_string()),
            ("time", time.map_or_else(String::new, |time| format!("{} s", time.as_secs_f64()))),
            ("accept", accept.text(spec.length)),
        ])
    }

    /// Fits the data and selects terms on them alone, then assesses the result on the test data, if
    /// there are any.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        self.run_on(Cow::Borrowed(&self.data), self.test.as_ref().map(Cow::Borrowed), notes)
    }

    /// Runs the identification and consumes the data, so that they are never in memory twice.
    pub fn run_once(&mut self, notes: &mut dyn Notes) -> Result<Report> {
        let (data, test) = (std::mem::take(&mut self.data), self.test.take());
        self.run_on(Cow::Owned(data), test.map(Cow::Owned), notes)
    }

    fn run_on(
        &self,
        data: Cow<'_, Data>,
        test: Option<Cow<'_, Data>>,
        notes: &mut dyn Notes,
    ) -> Result<Report> {
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
        map.carried_targets(machine).iter().for_each(|warning| notes.warn(warning));
        let derived = derived(&machine.spec, map, &self.terms, &data);
        let spec = with_inputs(&machine.spec, &derived);
        let nominal = Interpreter::new(spec.clone());
        let completed = |data, fitted| {
            let data = Data::closed(Data::complete(data, map, &nominal, &spec), &nominal)?;
            Ok(with_columns(&nominal, &spec, &derived, data, fitted))
        };
        let data = completed(data, true)?;

        let sets = competing(&spec, &derived, &self.terms, &self.harmonics, &data.observations);
        let input = FitInput { spec: &spec, map, data: &data, settings };
        let mut chosen = if sets.is_empty() { Chosen::default() } else { choose(&input, &sets, notes)? };
        let of_legs = leg_terms(&spec);
        let mut terms = [of_legs.clone(), chosen.terms()].concat();
        let [interpreter, without] = [&terms, &of_legs].map(|terms| input.interpreter(terms));
        let mut modelled = self.modelled(&input, &interpreter, &terms, sets.is_empty(), notes)?;
        if !chosen.groups.is_empty() && self.terms.contains(&Family::Profile) {
            // Profiles can explain alone what terms explain in part. That terms were chosen by
            // these rows does not count in the cross-validation of both.
            let alone = self.modelled(&input, &without, &of_legs, false, notes)?;
            let gain = modelled.cross_validated().compared_with(alone.cross_validated());
            if alone.profiles.is_some() && (gain.gain <= 0.0 || gain.p > CHANCE) {
                (modelled, terms) = (alone, of_legs);
                chosen.groups.clear();
            }
        }
        let Modelled { setup, solved, profiles: found, notes: notes_on_profiles } = modelled;
        let profiled = found
            .as_ref()
            .map(|found| FitInput { spec: &found.added_to(&spec), ..input }.interpreter(&terms));
        let (setup, mut solved) = match (found, &profiled) {
            (Some(found), Some(profiled)) => found.refit(profiled, (setup, solved), &input, notes)?,
            _ => (setup, solved),
        };
        solved.notes.extend(notes_on_profiles);
        let plain = input.interpreter(&[]);
        let constant = match terms.is_empty() && profiled.is_none() {
            true => None,
            false => Some(input.complete_fit(&plain, &[], false, &mut ())?.1),
        };
        check_lengths(&setup, &solved.model, &solved.fit, settings.prior, &data, notes)?;
        include_between_stations(&mut solved, &setup, &data)?;
        include_between_blocks(&mut solved, &data)?;
        solved.notes.extend(data.note_on_time().map(|note| format!("note: {note}")));
        let cross_validated = std::mem::take(&mut solved.cross_validated);
        let cross_validation = CrossValidation::new(cross_validated, &solved, &chosen, &data, settings);
        let test = test.map(|test| completed(test, false)).transpose()?;
        let identified = Identified {
            setup: &setup,
            solved: &solved,
            constant: constant.as_ref(),
            cross_validation,
            chosen: &chosen,
            derived: &derived,
            overlap,
        };
        finite(&data.file, report(self, &identified, &data, test.as_deref())?)
    }

    /// Fits constants and terms, and finds profiles beside them. The interpreter is that of the
    /// terms.
    fn modelled<'a>(
        &self,
        input: &FitInput,
        interpreter: &'a Interpreter,
        terms: &[Term],
        is_checked: bool,
        notes: &mut dyn Notes,
    ) -> Result<Modelled<'a>> {
        let (setup, solved) = input.complete_fit(interpreter, terms, is_checked, notes)?;
        let families = if solved.is_placement() { &[][..] } else { &self.terms };
        let (profiles, of_profiles) = find_profiles(families, input, (&setup, &solved), notes)?;
        Ok(Modelled { setup, solved, profiles, notes: of_profiles })
    }
}

/// Probability by chance up to which terms count as better beside profiles.
const CHANCE: f64 = 0.01;

/// Fit of a model, and the profiles found beside it.
struct Modelled<'a> {
    setup: Setup<'a>,
    solved: Solved<'a>,
    profiles: Option<FoundProfiles>,
    /// Notes on the profiles.
    notes: Vec<String>,
}

impl Modelled<'_> {
    /// Returns the position errors of rows that are left out, with the profiles.
    fn cross_validated(&self) -> &Distances {
        self.profiles.as_ref().map(FoundProfiles::cross_validated).unwrap_or(&self.solved.cross_validated)
    }
}

/// Result of the fit and of the selection.
struct Identified<'a> {
    setup: &'a Setup<'a>,
    solved: &'a Solved<'a>,
    /// Fit of constant errors alone, if the model has richer terms or profiles.
    constant: Option<&'a Solved<'a>>,
    cross_validation: CrossValidation,
    chosen: &'a Chosen,
    derived: &'a [Derived],
    /// Number of test rows that are also rows of the fit.
    overlap: usize,
}

impl CrossValidation {
    fn new(after: Distances, solved: &Solved, chosen: &Chosen, data: &Data, settings: &Settings) -> Self {
        let rows = &data.observations;
        // A comparison needs the same rows, hence the same outliers.
        let rejected: Vec<u64> = solved.fit.rejected(rows).map(|row| row.line).collect();
        let alone = chosen.constant.as_ref();
        let same_rows = alone.filter(|constant| constant.rejected == rejected);
        Self {
            folds: settings.folds.clamp(2, Configurations::new(rows).count.max(2)),
            configurations: after.figures().configurations,
            constant: alone.map(|constant| constant.cross_validated.figures().into()),
            gain: same_rows.map(|constant| after.compared_with(&constant.cross_validated).into()),
            after: after.into_figures().into(),
        }
    }
}

/// Returns the identified machine and the numbers that were fitted, as numbers of the chain where
/// that is possible if they are `converted`. `left` is the root mean square error of the fitted
/// rows, `estimated` are the instruments whose uncertainty was estimated.
fn found_model(
    identified: &Identified,
    spec: &Spec,
    data: &Data,
    left: f64,
    estimated: &[InstrumentFit],
    converted: bool,
) -> Result<(FoundModel, Vec<Parameter>), Failure> {
    let Identified { setup, solved, .. } = *identified;
    let (Solved { model, fit, .. }, rows) = (solved, &data.observations);
    let joint_errors = AsJointErrors::new(spec, model, fit);
    let converted = converted.then_some(&joint_errors);
    let explanations = Explanations::new(spec, setup, model, fit);
    let (unexplained, is_random) = unexplained(setup, solved, rows, left)?;
    let left_of_both = [left, identified.cross_validation.after.rms];
    let found = FoundModel {
        derived: identified.derived.to_vec(),
        joint_errors: joint_errors.joint_errors(&explanations),
        is_placement: solved.is_placement(),
        covariance: match solved.is_placement() {
            true => FoundCovariance::default(),
            false => FoundCovariance::new(setup, solved, converted, rows)?,
        },
        estimated: estimated.to_vec(),
        unexplained,
        is_random,
        ..FoundModel::new(spec, solved, converted, data, setup.pose, left_of_both)
    };
    Ok((found, parameters(setup, solved, spec, converted)))
}

fn report(job: &Identify, identified: &Identified, data: &Data, test: Option<&Data>) -> Result<Report> {
    let Identify { machine, map, settings, .. } = job;
    let Identified { setup, solved, constant, cross_validation, chosen, overlap, .. } = *identified;
    let (spec, rows) = (&machine.spec, &data.observations);
    let Solved { model, fit, .. } = solved;
    let identifiable = &fit.identifiable;
    let groups = indistinguishable(model, &rows[0].q, &setup.moved(rows), setup.pose).about(&data.file)?;
    let compared_fit = compare(solved, constant, &setup.delivered, data, |i| fit.is_kept(i))?;
    refuse_worse(&compared_fit, data, setup)?;
    let [instruments, coordinates] =
        instrument_and_coordinate_fits(model, map, data, fit).about(&data.file)?;
    let test = test.map(|test| comparable(test, data, model)).transpose()?;
    let test = test.as_deref();
    let assess = |test: &Data| compare(solved, constant, &setup.delivered, test, |_| true);
    let test_sizes = test.map(assess).transpose()?;
    let accepted = match &test_sizes {
        Some(test) => job.accept.verdict((Judged::Model, "the test rows"), &test.after, (0.0, 1)),
        None => {
            job.accept.verdict((Judged::Model, "rows left out in turn"), &cross_validation.after, (0.0, 1))
        }
    };
    let files: Vec<Summary> = std::iter::once(data).chain(test).map(Data::summary).collect();
    let (left, length) = (compared_fit.after.rms, setup.real.uncertainty.length);
    let estimated: Vec<InstrumentFit> =
        instruments.iter().chain(&coordinates).filter(|one| one.estimated).cloned().collect();
    let found_model = |converted| found_model(identified, spec, data, left, &estimated, converted);
    let back = |found: &FoundModel| read_back(found, machine, map, data, |i| fit.is_kept(i));
    let (mut found, mut parameters) = found_model(true).about(&data.file)?;
    let mut read = back(&found);
    if let Ok(Some(written)) = &read
        && written.differs([left, length])
    {
        // Numbers of the chain are errors of frames to first order only.
        (found, parameters) = found_model(false).about(&data.file)?;
        read = back(&found);
    }
    let note = |written: &ReadBack| found.read_back_note(spec, written, [left, length]);
    let (read_back_note, written) = match read {
        Ok(written) => (written.as_ref().and_then(note), written),
        // The fit is not lost.
        Err(mistake) => (Some(not_read_back(&mistake)), None),
    };
    let written = written.as_ref().map(|written| &written.machine);
    let no_drift = (job.terms.contains(&Family::Drift) && !has_one_station(data)).then(|| {
        "note: drift terms were not tried, because along these rows time cannot be distinguished \
         from the station"
            .to_owned()
    });
    let notes = solved.notes.iter().chain(&chosen.notes[..]).cloned();
    let kept: Vec<_> = fit.kept(rows).collect();
    let RowNotes { notes: of_rows, has_moved } =
        RowNotes::new(setup, model, &fit.x, (data, &kept)).about(&data.file)?;
    let notes = notes
        .chain(of_rows)
        .chain(scale_note(&setup.real, rows, &setup.moved(rows)).about(&data.file)?)
        .chain(unequal_note(&coordinates))
        .chain(tool_note(setup, model, fit))
        .chain(sum_note(setup, model, fit))
        .chain(no_drift)
        .chain(read_back_note)
        .chain(test_sizes.and_then(|test| test.note_on_terms(spec.length)));
    let gains = chosen.groups.iter();
    let gains = gains.map(|(terms, selection)| gain(spec, &found, terms, selection, length));
    let drift = drift(model, &kept, &fit.x).about(&data.file)?;
    Ok(Report {
        name: spec.name.clone(),
        length: spec.length.symbol(),
        title: map.title.clone(),
        rank: identifiable.rank,
        unknowns: model.unknowns.len(),
        machine: Counts::new(model, identifiable),
        gap: Some(identifiable.gap).filter(|gap| gap.is_finite()),
        condition: identifiable.condition,
        unexplained: (model.unknowns.len() - identifiable.rank)
            .saturating_sub(groups.len() + identifiable.weak.len()),
        weakly_determined: WeaklyDetermined::all(model, identifiable, spec.length),
        groups,
        joint_errors: found.joint_errors.clone(),
        target_on_axis: target_on_axis(setup, rows).about(&data.file)?,
        magnitudes: magnitudes(spec, solved),
        parameters,
        prior: solved.prior.filter(|_| !solved.is_placement()),
        redundant: redundant(model, identifiable),
        correlations: correlated(model, fit),
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
        extrapolated: test
            .and_then(|test| TestExtrapolation::new(&found, spec, test, written, &setup.delivered_points())),
        cross_validation,
        terms: gains.collect(),
        tried: chosen.tried,
        families: chosen.families.clone(),
        profiles: solved.profiles.clone(),
        drift: drift.map(ResidualDrift::new).filter(|_| !has_moved),
        unusable: files.iter().flat_map(LeftOut::of_file).collect(),
        rejected: fit.rejected(rows).map(|row| row.line).collect(),
        notes: notes.collect(),
        record: map.record.with_options(job.options()),
        points: if settings.points { points(solved, data, test)? } else { Vec::new() },
        files,
        placed: found.placed.clone(),
        written: written.map(|written| written.spec().clone()),
        found,
    })
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

/// Counts the test rows whose values are identical to those of a fitted row.
pub(super) fn train_test_overlap(fit: &Data, test: &Data) -> usize {
    let tested: HashSet<u64> = test.observations.iter().map(hash).collect();
    let common: HashSet<u64> = fit.observations.iter().map(hash).filter(|row| tested.contains(row)).collect();
    test.observations.iter().filter(|row| common.contains(&hash(row))).count()
}

/// Returns a warning about `overlap` of `rows` test rows that were fitted, if there are any.
pub fn overlap_warning(overlap: usize, rows: usize) -> Option<String> {
    let (are, they) = if overlap == 1 { ("is a row", "it") } else { ("are rows", "they") };
    (overlap > 0).then(|| {
        format!("{overlap} of the {rows} test rows {are} of the fit: {they} cannot validate the model")
    })
}
