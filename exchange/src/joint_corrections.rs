//! Corrections of the joints on a grid over their limits (CSV), for controllers that interpolate
//! between the nodes.

use std::io;

use abbe::analysis::{Goal, compensated, sampling};
use abbe::{Error, Manipulator, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::csv_writer::{Csv, Heading};
use abbe_spec::number::{digits, variables};
use abbe_spec::option::{NODES, SET};
use abbe_spec::{Notes, mistake};

use crate::Result;
use crate::export::report::unreadable;
use crate::export::{ExportReport, ExportedFile, PoseDifference, RealMachine};

/// Largest number of nodes in all.
const MOST_NODES: usize = 1_000_000;

/// Largest correction beyond a limit, relative to the range.
const MARGIN: f64 = 0.01;

/// Approximate number of nodes in all by default.
const DEFAULT_NODES: f64 = 10_000.0;

/// Writes the table, with `nodes` values of each joint; by default about 10,000 nodes in all.
///
/// # Errors
///
/// A joint has no limits, there are too many nodes, a configuration cannot be evaluated, or `notes`
/// stop the job.
pub fn write(machine: &RealMachine, nodes: Option<usize>, notes: &mut dyn Notes) -> Result<ExportReport> {
    let spec = &machine.spec;
    let joints = spec.variables.len();
    let endless =
        spec.variables.iter().find(|variable| !variable.limits.iter().all(|limit| limit.is_finite()));
    if let Some(variable) = endless {
        let message = format!("`{}` has no limits, so its table has no ends", variable.name);
        return Err(mistake::with_help(&machine.origin, message, "add `limits` to the variable"));
    }
    let dimensions = i32::try_from(joints).unwrap_or(i32::MAX);
    let count = nodes
        .unwrap_or_else(|| (DEFAULT_NODES.powf(1.0 / f64::from(dimensions.max(1))) as usize).clamp(2, 101));
    let total =
        count.checked_pow(u32::try_from(joints).unwrap_or(u32::MAX)).filter(|total| *total <= MOST_NODES);
    let Some(total) = total else {
        let message =
            format!("{count} nodes for each of {joints} joints exceed the maximum of {MOST_NODES} in all");
        return Err(mistake::with_help(NODES, message, "choose fewer nodes"));
    };
    let axes: Vec<Vec<f64>> =
        spec.variables.iter().map(|variable| sampling::grid(variable.limits, count)).collect();
    // A correction at a limit may exceed it; otherwise interpolation next to the limit would be
    // wrong.
    let mut wide = (**spec).clone();
    for variable in &mut wide.variables {
        let [lower, upper] = variable.limits;
        let margin = MARGIN * (upper - lower);
        variable.limits = [lower - margin, upper + margin];
    }
    let wide = Interpreter::new(wide);
    let u = sampling::nominal_inputs(machine.manipulator.description());
    let failed = |q: &[f64], error: &Error| {
        mistake::not_evaluated(&machine.origin, &variables(q, spec), error, machine.manipulator.description())
    };
    let (mut rows, mut at_nodes, mut largest) =
        (Vec::with_capacity(total), Vec::with_capacity(total), (0.0, String::new()));
    for node in 0..total {
        notes.progress(node, total);
        notes.go_on()?;
        let q = node_position(&axes, node, count);
        let done =
            compensated(&wide, Goal::default(), &q, &machine.s, &u).map_err(|error| failed(&q, &error))?;
        let pair = machine
            .manipulator
            .pose(&q, &machine.s)
            .and_then(|ideal| Ok([ideal, machine.real_tool(&done.q, &u)?]));
        at_nodes.push(pair.map_err(|error| failed(&q, &error))?);
        let corrections: Vec<f64> = done.q.iter().zip(&q).map(|(corrected, q)| corrected - q).collect();
        for (i, correction) in corrections.iter().enumerate() {
            let weight =
                if spec.variables[i].kind == VariableKind::Revolute { 1.0 } else { spec.length.in_metres() };
            if correction.abs() * weight > largest.0 {
                largest = (correction.abs() * weight, sentence(machine, &q, i, *correction));
            }
        }
        rows.push(q.into_iter().chain(corrections).map(Some).collect::<Vec<_>>());
    }
    notes.progress(total, total);
    let names = spec.variables.iter().map(|variable| variable.name.clone());
    let heading = names.clone().chain(names.map(|name| format!("add to {name}"))).collect();
    let text = text(heading, &rows).unwrap_or_default();
    let corrections =
        read(&text, joints, total).ok_or_else(|| unreadable("the exported file cannot be read back"))?;
    let corrected = |q: &[f64], _: &[f64]| {
        let added = interpolated(&axes, &corrections, count, q);
        q.iter().zip(added).map(|(q, added)| q + added).collect()
    };
    let mut left_out = Vec::new();
    if !spec.inputs.is_empty() {
        let inputs: Vec<String> = spec.inputs.iter().map(|input| format!("`{}`", input.name)).collect();
        left_out.push(format!(
            "The table holds for the current values of the inputs ({}); `{SET}` changes them.",
            inputs.join(", ")
        ));
    }
    left_out.push(format!(
        "Between the nodes the corrections are interpolated linearly along each joint. \
         \"corrected\": residual error at random configurations; \"at the nodes\": residual error \
         at the {total} nodes. `{NODES}` sets the number of nodes per joint, here {count}."
    ));
    left_out.push(
        "Near joint limits, corrected commands may exceed the limits by the size of the \
         correction."
            .to_owned(),
    );
    let format = format!("joint corrections, {count} nodes for each of {joints} joints");
    let files = vec![ExportedFile { name: format!("{}.corrections.csv", spec.name), text }];
    let sign = if largest.1.is_empty() { "All corrections are 0.".to_owned() } else { largest.1 };
    let at_nodes = Some(PoseDifference::new(at_nodes));
    let report = ExportReport::for_commands(machine, format, files, corrected, sign)?;
    Ok(ExportReport { left_out, at_nodes, ..report })
}

/// Writes the rows as CSV.
fn text(names: Vec<String>, rows: &[Vec<Option<f64>>]) -> io::Result<String> {
    let mut csv = Csv::new(Vec::new(), &Heading { names, labels: Vec::new() })?;
    rows.iter().try_for_each(|row| csv.row(None, row))?;
    String::from_utf8(csv.finish()?).map_err(io::Error::other)
}

/// Returns the joint values of a node; the last joint varies fastest.
fn node_position(axes: &[Vec<f64>], mut node: usize, count: usize) -> Vec<f64> {
    let mut q = vec![0.0; axes.len()];
    for (value, axis) in q.iter_mut().zip(axes).rev() {
        *value = axis[node % count];
        node /= count;
    }
    q
}

/// Returns the sentence about the sign: the correction of one joint at a configuration.
fn sentence(machine: &RealMachine, q: &[f64], joint: usize, correction: f64) -> String {
    let variable = &machine.spec.variables[joint];
    let unit = if variable.kind == VariableKind::Revolute { "rad" } else { machine.spec.length.symbol() };
    format!(
        "The table holds corrections that are added to the commands: for the command {} the \
         controller sends {} by {} {unit} {}.",
        variables(q, &machine.spec),
        variable.name,
        digits(correction.abs(), 4),
        if correction < 0.0 { "less" } else { "more" }
    )
}

/// Reads the corrections of a text of [`text`], node by node.
fn read(text: &str, joints: usize, total: usize) -> Option<Vec<Vec<f64>>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let row = |record: csv::StringRecord| {
        let numbers: Option<Vec<f64>> = record.iter().skip(joints).map(|cell| cell.parse().ok()).collect();
        numbers.filter(|numbers| numbers.len() == joints)
    };
    let rows: Option<Vec<Vec<f64>>> = reader.records().map(|record| row(record.ok()?)).collect();
    rows.filter(|rows| rows.len() == total)
}

/// Interpolates the corrections at `q` multilinearly between the nodes of its cell.
fn interpolated(axes: &[Vec<f64>], corrections: &[Vec<f64>], count: usize, q: &[f64]) -> Vec<f64> {
    let below = |(axis, value): (&Vec<f64>, &f64)| {
        let i = axis.partition_point(|node| node <= value).clamp(1, axis.len() - 1) - 1;
        (i, ((value - axis[i]) / (axis[i + 1] - axis[i])).clamp(0.0, 1.0))
    };
    let cell: Vec<(usize, f64)> = axes.iter().zip(q).map(below).collect();
    let mut sum = vec![0.0; q.len()];
    for corner in 0..1_usize << cell.len() {
        let (mut node, mut weight) = (0, 1.0);
        for (k, (i, share)) in cell.iter().enumerate() {
            let is_above = corner >> k & 1;
            node = node * count + i + is_above;
            weight *= if is_above == 1 { *share } else { 1.0 - share };
        }
        if weight > 0.0 {
            sum.iter_mut().zip(&corrections[node]).for_each(|(sum, correction)| *sum += weight * correction);
        }
    }
    sum
}
