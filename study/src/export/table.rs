//! Corrections of the joints on a grid over their limits, for controllers that interpolate between its nodes.

use abbe::analysis::{compensated, sampling};
use abbe::{Error, Manipulator, VariableKind};
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;

use super::difference::Difference;
use super::found::Found;
use super::{COMMANDS, ExportedFile, Report};
use crate::notes::Notes;
use crate::number::digits;
use crate::{data, mistake};

/// A table has no more nodes than this.
const MOST_NODES: usize = 1_000_000;

/// How far beyond a limit a correction may go, as a part of the range.
const MARGIN: f64 = 0.01;

/// About as many it has if nobody says.
const NODES: f64 = 10_000.0;

/// The table, and what remains of the errors with it: at its nodes, and between them.
pub(super) fn report(
    found: &Found,
    nodes: Option<usize>,
    notes: &mut dyn Notes,
) -> Result<Report, Diagnostics> {
    let spec = &found.spec;
    let joints = spec.variables.len();
    let endless =
        spec.variables.iter().find(|variable| !variable.limits.iter().all(|limit| limit.is_finite()));
    if let Some(variable) = endless {
        let message = format!("`{}` has no limits, between which the table would go", variable.name);
        return Err(mistake::with_help(&found.origin, message, "give it `limits`"));
    }
    let dimensions = i32::try_from(joints).unwrap_or(i32::MAX);
    let count =
        nodes.unwrap_or_else(|| (NODES.powf(1.0 / f64::from(dimensions.max(1))) as usize).clamp(2, 101));
    let total =
        count.checked_pow(u32::try_from(joints).unwrap_or(u32::MAX)).filter(|total| *total <= MOST_NODES);
    let Some(total) = total else {
        let message = format!("{count} nodes for each of {joints} joints are more than {MOST_NODES} in all");
        return Err(mistake::with_help("--nodes", message, "ask for fewer"));
    };
    let axes: Vec<Vec<f64>> =
        spec.variables.iter().map(|variable| sampling::grid(variable.limits, count)).collect();
    // A correction at a limit may go beyond it, or all that is interpolated next to it is wrong.
    let mut wide = (**spec).clone();
    for variable in &mut wide.variables {
        let [lower, upper] = variable.limits;
        let margin = MARGIN * (upper - lower);
        variable.limits = [lower - margin, upper + margin];
    }
    let wide = Interpreter::new(wide);
    let u = sampling::nominal_inputs(found.manipulator.description());
    let failed = |q: &[f64], error: &Error| {
        let at = crate::number::variables(q, spec);
        mistake::not_evaluated(&found.origin, &at, error, found.manipulator.description())
    };
    let (mut rows, mut at_nodes, mut largest) =
        (Vec::with_capacity(total), Vec::with_capacity(total), (0.0, String::new()));
    for node in 0..total {
        notes.progress(node, total);
        notes.go_on()?;
        let q = place(&axes, node, count);
        let done = compensated(&wide, None, &q, &found.s, &u).map_err(|error| failed(&q, &error))?;
        let pair =
            found.manipulator.pose(&q, &found.s).and_then(|ideal| Ok([ideal, found.real_tool(&done.q, &u)?]));
        at_nodes.push(pair.map_err(|error| failed(&q, &error))?);
        let corrections: Vec<f64> = done.q.iter().zip(&q).map(|(corrected, q)| corrected - q).collect();
        for (i, correction) in corrections.iter().enumerate() {
            let weight =
                if spec.variables[i].kind == VariableKind::Revolute { 1.0 } else { spec.length.in_metres() };
            if correction.abs() * weight > largest.0 {
                largest = (correction.abs() * weight, sentence(found, &q, i, *correction));
            }
        }
        rows.push(q.into_iter().chain(corrections).map(Some).collect());
    }
    notes.progress(total, total);
    let names = spec.variables.iter().map(|variable| variable.name.clone());
    let heading = names.clone().chain(names.map(|name| format!("add to {name}"))).collect();
    let text = data::Table { heading, rows, labels: Vec::new() }.csv();
    let corrections = read(&text, joints, total).ok_or_else(|| {
        let help = "this is a mistake of abbe: please report the spec";
        mistake::with_help("abbe export", "what was written cannot be read", help)
    })?;
    let corrected = |q: &[f64]| {
        let added = interpolated(&axes, &corrections, count, q);
        Ok(q.iter().zip(added).map(|(q, added)| q + added).collect())
    };
    let evaluated = |error: Error| mistake::whole(&found.origin, &error);
    let mut left_out = Vec::new();
    if !spec.inputs.is_empty() {
        let inputs: Vec<String> = spec.inputs.iter().map(|input| format!("`{}`", input.name)).collect();
        left_out.push(format!(
            "The table is that of the inputs as they are ({}); `--set` gives another value.",
            inputs.join(", ")
        ));
    }
    left_out.push(format!(
        "Between the nodes the corrections are interpolated, linearly along each joint: \"corrected\" is at random places between them, \"at the \
         nodes\" what is left at the {total} nodes. More nodes: `--nodes`, here {count} for each joint."
    ));
    left_out.push(
        "At the limits of the joints corrected commands go beyond them, by what is to be corrected there."
            .to_owned(),
    );
    let format = format!("corrections of the joints, {count} nodes for each of {joints}");
    let files = vec![ExportedFile { name: format!("{}.corrections.csv", spec.name), text }];
    let remains = found.of_commands(corrected).map_err(evaluated)?;
    let sign = if largest.1.is_empty() { "All corrections are 0.".to_owned() } else { largest.1 };
    let at_nodes = Some(Difference::new(at_nodes));
    Ok(Report { left_out, at_nodes, ..found.report(format, files, COMMANDS, remains, sign) })
}

/// The node of a number: the last joint goes fastest.
fn place(axes: &[Vec<f64>], mut node: usize, count: usize) -> Vec<f64> {
    let mut q = vec![0.0; axes.len()];
    for (value, axis) in q.iter_mut().zip(axes).rev() {
        *value = axis[node % count];
        node /= count;
    }
    q
}

fn sentence(found: &Found, q: &[f64], joint: usize, correction: f64) -> String {
    let variable = &found.spec.variables[joint];
    let unit = if variable.kind == VariableKind::Revolute { "rad" } else { found.spec.length.symbol() };
    format!(
        "The table holds corrections, to be added to the commands: where {} is commanded, the controller sends {} by {} {unit} {}.",
        crate::number::variables(q, &found.spec),
        variable.name,
        digits(correction.abs(), 4),
        if correction < 0.0 { "less" } else { "more" }
    )
}

/// The corrections of a table that was written so, node by node.
fn read(text: &str, joints: usize, total: usize) -> Option<Vec<Vec<f64>>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let row = |record: csv::StringRecord| {
        let numbers: Option<Vec<f64>> = record.iter().skip(joints).map(|cell| cell.parse().ok()).collect();
        numbers.filter(|numbers| numbers.len() == joints)
    };
    let rows: Option<Vec<Vec<f64>>> = reader.records().map(|record| row(record.ok()?)).collect();
    rows.filter(|rows| rows.len() == total)
}

/// Between the nodes around a place, each weighed by its share of the box between them.
fn interpolated(axes: &[Vec<f64>], corrections: &[Vec<f64>], count: usize, q: &[f64]) -> Vec<f64> {
    let below = |(axis, value): (&Vec<f64>, &f64)| {
        let i = axis.partition_point(|node| node <= value).clamp(1, axis.len() - 1) - 1;
        (i, ((value - axis[i]) / (axis[i + 1] - axis[i])).clamp(0.0, 1.0))
    };
    let places: Vec<(usize, f64)> = axes.iter().zip(q).map(below).collect();
    let mut sum = vec![0.0; q.len()];
    for corner in 0..1_usize << places.len() {
        let (mut node, mut weight) = (0, 1.0);
        for (k, (i, share)) in places.iter().enumerate() {
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
