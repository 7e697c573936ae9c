//! What comes out, for machines.

use abbe::identify::{Figures, Observation, Unknown, groups};
use abbe_codegen::spec::Spec;
use serde::Serialize;

use super::setup::{Counts, Setup, figures};
use super::solved::Solved;
use super::words;
use crate::data::{Data, Map};
use crate::failure::Failure;

/// What is printed.
#[derive(Serialize)]
pub(super) struct Report {
    name: String,
    length: &'static str,
    title: String,
    /// How many combinations of the unknowns these data determine.
    pub(super) rank: usize,
    pub(super) unknowns: usize,
    /// Of base and frames alone, without the targets on the tool.
    pub(super) machine: Counts,
    /// The smallest singular value that counts over the largest that does not; none if all count.
    gap: Option<f64>,
    pub(super) condition: f64,
    observability: Indices,
    pub(super) groups: Vec<Alike>,
    /// What stays unknown for other reasons than the groups say: 0 if they explain it all.
    pub(super) unexplained: usize,
    pub(super) parameters: Vec<Parameter>,
    held: Vec<Held>,
    pub(super) correlations: Vec<Pair>,
    /// What the stated uncertainty must be multiplied with to explain what is left.
    pub(super) uncertainty_factor: f64,
    /// Where `F_0` stands as the instrument sees it, errors of the base aside.
    base: [[f64; 4]; 4],
    pub(super) fit: Compared,
    pub(super) test: Option<Compared>,
    pub(super) cross_validation: Crossed,
    pub(super) terms: Vec<Term>,
    unusable: Vec<Left>,
    /// Lines that a robust loss left out.
    pub(super) rejected: Vec<u64>,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct Indices {
    o1: f64,
    o2: f64,
    o3: f64,
    o4: f64,
    o5: f64,
}

/// Unknowns that cannot be told apart.
#[derive(Serialize)]
pub(super) struct Alike {
    these: Vec<(String, f64)>,
    act_as: Vec<(String, f64)>,
    reason: String,
}

/// An unknown that stands for a combination that is known.
#[derive(Serialize)]
pub(super) struct Parameter {
    pub(super) name: String,
    /// The frame of an error, from 1; 0 is the base.
    frame: Option<usize>,
    pub(super) frame_name: Option<String>,
    pub(super) value: f64,
    pub(super) standard_deviation: f64,
    /// The length unit, rad, or nothing.
    pub(super) unit: &'static str,
    /// Whether the data say less of it than was known before.
    pub(super) hardly_known: bool,
}

/// An unknown that is held at zero, and what it acts as.
#[derive(Serialize)]
struct Held {
    name: String,
    acts_as: Vec<(String, f64)>,
}

#[derive(Serialize)]
pub(super) struct Pair {
    pub(super) of: [String; 2],
    pub(super) correlation: f64,
}

/// Position errors.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Sizes {
    pub(super) mean: f64,
    pub(super) rms: f64,
    pub(super) max: f64,
    pub(super) p95: f64,
}

/// Position errors as delivered, with base and tool fitted, and with everything.
#[derive(Serialize)]
pub(super) struct Compared {
    pub(super) rows: usize,
    pub(super) before: Sizes,
    pub(super) base_and_tool: Sizes,
    pub(super) after: Sizes,
}

#[derive(Serialize)]
pub(super) struct Crossed {
    pub(super) folds: usize,
    /// With constants alone, if richer terms were tried.
    pub(super) constant: Option<Sizes>,
    pub(super) after: Sizes,
}

/// A group of terms that earned its place.
#[derive(Serialize)]
pub(super) struct Term {
    pub(super) name: String,
    /// Root mean square on rows left out, the length unit.
    pub(super) before: f64,
    pub(super) after: f64,
    f: f64,
    pub(super) p: f64,
}

#[derive(Serialize)]
struct Left {
    file: String,
    line: u64,
    reason: String,
}

impl From<Figures> for Sizes {
    fn from(Figures { mean, rms, max, p95, .. }: Figures) -> Self {
        Self { mean, rms, max, p95 }
    }
}

pub(super) fn report(
    spec: &Spec,
    setup: &Setup,
    data: &Data,
    test: Option<&Data>,
    solved: &Solved,
    map: &Map,
) -> Result<Report, Failure> {
    let Solved { model, fit, .. } = solved;
    let known = &fit.known;
    let name = |unknown: Unknown| model.name(unknown);
    let named =
        |list: &[(Unknown, f64)]| list.iter().map(|(u, factor)| (name(*u), *factor)).collect::<Vec<_>>();
    let by_index = |list: &[(usize, f64)]| list.iter().map(|(k, f)| (name(model.unknowns[*k]), *f)).collect();
    let first: &Observation = &data.observations[0];
    let moved = setup.moved(&data.observations);
    let alike =
        groups(model, &first.q, &moved, setup.pose).map_err(|error| Failure::of(&data.file, error))?;
    let (deviations, hardly) = (fit.standard_deviations(), fit.hardly_known());
    let parameter = |k: &usize| {
        let unknown = model.unknowns[*k];
        let (frame, unit) = match unknown {
            Unknown::Base(component) => (Some(0), unit(spec, component.is_rotation())),
            Unknown::Error(frame, component) => (Some(frame + 1), unit(spec, component.is_rotation())),
            Unknown::Tool(component) => (None, unit(spec, component.is_rotation())),
            Unknown::Target(..) => (None, spec.length.symbol()),
            Unknown::Magnitude(_) => (None, ""),
        };
        let of = |frame: usize| frame.checked_sub(1).map_or("base", |i| &setup.description.frames[i].name);
        Parameter {
            name: name(unknown),
            frame,
            frame_name: frame.map(|frame| of(frame).to_owned()),
            value: fit.x[*k] + 0.0,
            standard_deviation: deviations[*k].unwrap_or_default(),
            unit,
            hardly_known: hardly.contains(k),
        }
    };
    let compared = |rows: &Data| -> Result<Compared, Failure> {
        Ok(Compared {
            rows: rows.observations.len(),
            before: figures(&setup.ideal, rows, &[])?.into(),
            base_and_tool: figures(&solved.simple, rows, &solved.simple_fit.x)?.into(),
            after: figures(model, rows, &fit.x)?.into(),
        })
    };
    let unusable = |data: &Data| {
        let file = data.file.clone();
        data.unusable
            .iter()
            .map(move |row| Left { file: file.clone(), line: row.line, reason: row.reason.clone() })
            .collect::<Vec<_>>()
    };
    let o = known.observability;
    let group_count = alike.len();
    let length = map.uncertainty.length;
    Ok(Report {
        name: spec.name.clone(),
        length: spec.length.symbol(),
        title: map.title.clone(),
        rank: known.rank,
        unknowns: model.unknowns.len(),
        machine: Counts::of(model, known),
        gap: Some(known.gap).filter(|gap| gap.is_finite()),
        condition: o.condition,
        observability: Indices { o1: o.o1, o2: o.o2, o3: o.o3, o4: o.o4, o5: o.o5 },
        groups: alike
            .iter()
            .map(|group| Alike {
                these: named(&group.these),
                act_as: named(&group.act_as),
                reason: words::reason(group.reason, setup.description),
            })
            .collect(),
        unexplained: (model.unknowns.len() - known.rank).saturating_sub(group_count),
        parameters: known.kept.iter().map(parameter).collect(),
        held: known
            .held
            .iter()
            .map(|(k, acts_as)| Held { name: name(model.unknowns[*k]), acts_as: by_index(acts_as) })
            .collect(),
        correlations: fit
            .correlations(0.9)
            .into_iter()
            .map(|(a, b, correlation)| Pair {
                of: [name(model.unknowns[a]), name(model.unknowns[b])],
                correlation,
            })
            .collect(),
        uncertainty_factor: fit.sigma,
        base: setup.ideal.base.rows().map(|row| row.map(|entry| entry + 0.0)),
        // What was left out does not count.
        fit: compared(&data.without(|row| fit.rejects(row)))?,
        test: test.map(compared).transpose()?,
        cross_validation: Crossed {
            folds: solved.folds,
            constant: solved.constant.map(Sizes::from),
            after: solved.crossed.into(),
        },
        terms: solved
            .chosen
            .iter()
            .map(|(name, selection)| Term {
                name: name.clone(),
                // Of a coordinate; of a point it is √3 as much.
                before: selection.before * length,
                after: selection.after * length,
                f: selection.test.f,
                p: selection.test.p,
            })
            .collect(),
        unusable: unusable(data).into_iter().chain(test.map(unusable).into_iter().flatten()).collect(),
        rejected: fit.rejected().into_iter().map(|i| data.lines[i]).collect(),
        notes: solved.notes.clone(),
    })
}

fn unit(spec: &Spec, rotation: bool) -> &'static str {
    if rotation { "rad" } else { spec.length.symbol() }
}
