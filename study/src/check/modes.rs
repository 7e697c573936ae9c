//! Assembly modes: the ways in which the loops close at the home of the commanded joints.

use std::f64::consts::{PI, TAU};

use abbe::analysis::sampling::{draw, stream};
use abbe::{Distribution, Pose, VariableKind};
use abbe_codegen::chain::{LoopEquations, transform};
use abbe_codegen::graph::Node;
use abbe_spec::{Spec, Variable};
use serde::Serialize;

use crate::closing::{CLOSED, Closing};
use crate::number::Named;

/// Number of starts per passive variable of the largest group.
const STARTS: usize = 40;

/// Largest number of Newton's steps from a start.
const STEPS: usize = 40;

/// Step, without a unit, that changes nothing.
const SMALLEST: f64 = 1e-12;

/// Largest relative difference of the places of the frames in one mode.
const SAME: f64 = 1e-6;

/// Condition number from which φ_p is called singular.
pub(super) const SINGULAR: f64 = 1e6;

/// Loops that do not depend on the passive variables of others, and their assembly modes.
#[derive(Clone, Debug, Serialize)]
pub struct LoopModes {
    /// Names of the loops.
    pub loops: Vec<String>,
    /// Number of random starts of the search.
    pub starts: usize,
    /// Modes that it found within the limits of the passive variables: that of the spec, then the
    /// others in the order of their values.
    pub found: Vec<Mode>,
}

/// Assembly mode at the home of the commanded joints.
#[derive(Clone, Debug, Serialize)]
pub struct Mode {
    /// Passive variables, in the length unit or rad.
    pub home: Named,
    /// Number of starts that led to it.
    pub starts: usize,
    /// `true` for the mode of the spec.
    pub is_chosen: bool,
}

/// Closed position of some loops.
struct Closed {
    passive: Vec<f64>,
    /// Places of the frames.
    place: Vec<f64>,
    starts: usize,
    is_mode: bool,
}

/// Searches the modes by Newton's method from random passive variables; `home` are those of the
/// spec's mode.
pub(super) fn search(spec: &Spec, closing: &mut Closing<'_>, home: &[f64]) -> Vec<LoopModes> {
    let graph = &mut closing.equations.graph;
    let poses = spec.frames.iter().map(|frame| transform(graph, &frame.factors));
    let poses: Vec<Node> =
        poses.flat_map(|pose| [pose.axes.concat(), pose.position.to_vec()].concat()).collect();
    let LoopEquations { blocks, column_units: units, .. } = &closing.equations;
    let ranges: Vec<_> =
        spec.passive.iter().zip(units).map(|(variable, unit)| range(variable, *unit)).collect();
    let starts = STARTS * blocks.iter().map(|[_, columns]| columns.len()).max().unwrap_or(0);
    let place = |passive: &[f64]| place(spec, &closing.evaluate(&poses, passive));
    let of_spec = || vec![Closed { passive: home.to_vec(), place: place(home), starts: 0, is_mode: true }];
    let mut found: Vec<Vec<Closed>> = blocks.iter().map(|_| of_spec()).collect();
    for start in 0..starts {
        let mut random = stream(1, start);
        let begin =
            ranges.iter().map(|[middle, half]| middle + half * draw(Distribution::Uniform, &mut random));
        let passive = newton(closing, begin.collect());
        let residual = closing.scaled(&passive);
        let closed = |[rows, _]: &[Vec<usize>; 2]| rows.iter().all(|row| residual[*row].abs() <= CLOSED);
        for ([_, columns], found) in blocks.iter().zip(&mut found).filter(|(block, _)| closed(block)) {
            let mut here = home.to_vec();
            for i in columns {
                let turns = match spec.passive[*i].kind {
                    VariableKind::Revolute => ((passive[*i] - ranges[*i][0]) / TAU).round(),
                    VariableKind::Prismatic => 0.0,
                };
                here[*i] = passive[*i] - TAU * turns;
            }
            let known =
                found.iter().position(|closed| near(&closed.passive, &here)).ok_or_else(|| place(&here));
            match known
                .or_else(|place| found.iter().position(|closed| near(&closed.place, &place)).ok_or(place))
            {
                Ok(known) => found[known].starts += 1,
                Err(place) => {
                    let is_inside =
                        spec.passive.iter().zip(&here).all(|(variable, value)| {
                            (variable.limits[0]..=variable.limits[1]).contains(value)
                        });
                    let values = closing.singular_values(&here);
                    let is_regular = values.is_some_and(|[largest, least]| largest < SINGULAR * least);
                    let is_mode = is_inside && is_regular && closing.closes(&here);
                    found.push(Closed { passive: here, place, starts: 1, is_mode });
                }
            }
        }
    }
    let modes = |([rows, columns], mut found): (&[Vec<usize>; 2], Vec<Closed>)| {
        found.retain(|closed| closed.is_mode);
        let rounded = |i: &usize, closed: &Closed| (closed.passive[*i] / units[*i] / SAME).round() as i64;
        found[1..].sort_by_key(|closed| columns.iter().map(|i| rounded(i, closed)).collect::<Vec<_>>());
        let value = |i: &usize, closed: &Closed| (spec.passive[*i].name.clone(), closed.passive[*i]);
        let found = found.iter().enumerate().map(|(index, closed)| Mode {
            home: Named(columns.iter().map(|i| value(i, closed)).collect()),
            starts: closed.starts,
            is_chosen: index == 0,
        });
        let owners = spec.loops.iter().flat_map(|closed| vec![&closed.name; closed.closure.equations()]);
        let own = owners.enumerate().filter(|(row, _)| rows.contains(row));
        let mut loops: Vec<String> = own.map(|(_, name)| name.clone()).collect();
        loops.dedup();
        LoopModes { loops, starts, found: found.collect() }
    };
    blocks.iter().zip(found).map(modes).collect()
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * a.abs().max(1.0))
}

/// Returns the origins of all frames, and the axes of those that loops or the tool hold: frames
/// that turn one after the other about one point may lead to the same pose in two ways.
fn place(spec: &Spec, transforms: &[f64]) -> Vec<f64> {
    let mut poses: Vec<Pose> = Vec::new();
    for (frame, entries) in spec.frames.iter().zip(transforms.chunks_exact(12)) {
        let own = Pose(std::array::from_fn(|column| std::array::from_fn(|row| entries[3 * column + row])));
        poses.push(frame.parent.map_or(own, |parent| poses[parent].then(&own)));
    }
    let held = spec.loops.iter().flat_map(|closed| closed.frames).flatten().chain([spec.tool_frame]);
    let axes = held.flat_map(|frame| poses[frame].0.as_flattened()[..9].to_vec());
    poses.iter().flat_map(Pose::position).chain(axes).collect()
}

/// Returns the passive variables after Newton's steps, of at most one unit, in each block.
fn newton(closing: &Closing<'_>, mut passive: Vec<f64>) -> Vec<f64> {
    for _ in 0..STEPS {
        let (residual, derivatives) = (closing.scaled(&passive), closing.derivatives(&passive));
        let mut largest: f64 = 0.0;
        for [rows, columns] in &closing.equations.blocks {
            let block = derivatives.select_rows(rows).select_columns(columns);
            let Some(step) = block.lu().solve(&residual.select_rows(rows)) else { continue };
            let size = step.amax();
            largest = largest.max(size);
            for (column, step) in columns.iter().zip(&step) {
                passive[*column] -= step / size.max(1.0) * closing.equations.column_units[*column];
            }
        }
        if largest <= SMALLEST {
            break;
        }
    }
    passive
}

/// Returns the middle of the values of a passive variable at the starts, and their largest distance
/// from it: those of the limits, or home and half a turn, or a length of the loops.
fn range(Variable { kind, limits: [lower, upper], home, .. }: &Variable, unit: f64) -> [f64; 2] {
    match kind {
        _ if (upper - lower).is_finite() => [0.5 * (lower + upper), 0.5 * (upper - lower)],
        VariableKind::Revolute => [*home, PI],
        VariableKind::Prismatic => [*home, unit],
    }
}
