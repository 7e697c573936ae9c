//! Reads the forms of a workspace.
//!
//! Joint variables of a platform on legs, from its pose.

use std::{ops::Range, sync::Arc};

use abbe::analysis::{Axis, BaseBox, Legs, Presentation, ToolOrientation};
use abbe_codegen::{chain::LoopEquations, graph::Graph};
use abbe_spec::expr::{Dimension, Expression, Symbol};
use abbe_spec::{Closure, Diagnostic, Factor, Item, Section, Spec};

use super::axis::{Candidates, constant, count, values, whole};
use super::keys::{self, BESIDE, WORKSPACE};
use super::orientation::orientations;
use super::path;
use super::region::{Form, LARGEST, Region, has_range};

/// Maximum number of combinations of held values at the points of a box, each with a search of its
/// own.
const APPROACHES: usize = 10_000;

/// Reads `[workspace]`: one of the forms, and `inputs` with their own values. Inputs without a name
/// there stay nominal.
pub fn read_region(item: &Item<'_>, spec: &Spec) -> Option<Region> {
    let section = item.table("[workspace]", &[&WORKSPACE, &BESIDE])?;
    let mut forms = section.items().filter(|item| WORKSPACE.contain(&item.key));
    let (Some(form), None) = (forms.next(), forms.next()) else {
        let forms = WORKSPACE.names().map(|form| format!("`{form}`")).collect::<Vec<_>>();
        let help = format!("give one of {}", forms.join(", "));
        let mistake = Diagnostic::new(section.span.clone(), "a workspace needs exactly one form");
        return item.document.fail(mistake.label("none or several are given").help(help));
    };
    let mut region = read_form(&form, spec)?;
    if let Some(item) = section.get("inputs") {
        for axis in Candidates::inputs(spec).axes(&item) {
            if region.moving_inputs().contains(&axis.index) {
                let message = format!("`{}` is moved twice", spec.inputs[axis.index].name);
                let help = format!("remove it from `inputs` or from `{}`", form.key);
                item.document.mistake(Diagnostic::new(item.key_span.clone(), message).help(help));
            }
            region.inputs.push(axis);
        }
    }
    if region.count().is_none() {
        let message = format!("this workspace has more than {LARGEST} configurations");
        return form.refuse_key(
            message,
            "use fewer values per axis, or random samples: `joints = { samples = 100000 \
                    }`",
        );
    }
    Some(region)
}

/// Reads the form with this key.
fn read_form(form: &Item<'_>, spec: &Spec) -> Option<Region> {
    if form.key == "grid" {
        return grid(form, spec);
    }
    let section = form.section()?;
    match form.key.as_str() {
        "presented" => presented(&section, spec).map(Form::Presented).map(Region::new),
        "box" => base_box(&section, spec).map(Form::Box).map(Region::new),
        "path" => path::read(&section, spec).map(Form::Path).map(Region::new),
        "random" => samples(&section, spec, true),
        _ => samples(&section, spec, false),
    }
}

/// Reads `[workspace.grid]`: values of variables, or of passive variables, and inputs.
fn grid(item: &Item<'_>, spec: &Spec) -> Option<Region> {
    let is_passive = |item: &Item<'_>| spec.passive.iter().any(|passive| passive.name == item.key);
    let of_platform = item.section()?.items().any(|item| is_passive(&item));
    let (candidates, count) = match of_platform {
        true => (Candidates::passive_and_inputs(spec), spec.passive.len()),
        false => (Candidates::variables_and_inputs(spec), spec.variables.len()),
    };
    let all = candidates.axes(item);
    let (axes, inputs): (Vec<Axis>, Vec<Axis>) = all.into_iter().partition(|axis| axis.index < count);
    let form = match of_platform {
        false => Form::Grid(axes),
        true => match legs(spec) {
            Ok(legs) => Form::Platform(axes, legs),
            Err(reason) => {
                let message = "poses of a platform need legs that follow from them";
                let help = "name the commanded variables in the grid instead";
                let mistake = Diagnostic::new(item.key_span.clone(), message);
                return item.document.fail(mistake.label(reason).help(help));
            }
        },
    };
    let inputs = inputs.into_iter().map(|axis| Axis { index: axis.index - count, ..axis });
    Some(Region { inputs: inputs.collect(), ..Region::new(form) })
}

/// Reads `[workspace.presented]`: tool points, each moved to one point in space.
fn presented(section: &Section<'_>, spec: &Spec) -> Option<Presentation> {
    section.check_keys(&[&keys::PRESENTED]);
    let point = section.required("point").and_then(|item| point(&item));
    let tool_points = section.get("tool_points").map(|item| Candidates::parameters(spec).axes(&item));
    let variables = Candidates::variables(spec).unlimited();
    let approaches = section.get("approaches").map(|item| (variables.axes(&item), item.span()));
    let (approaches, span) = approaches.unwrap_or_default();
    let solved = section.required("solve").map(|item| variables.list(&item))?;
    if let Some(both) = approaches.iter().find(|axis| solved.contains(&axis.index)) {
        section.document.mistake(held_and_solved(&spec.variables[both.index].name, span));
    }
    Some(Presentation { point: point?, tool_points: tool_points.unwrap_or_default(), approaches, solved })
}

fn point(item: &Item<'_>) -> Option<[f64; 3]> {
    let entries: [Item<'_>; 3] = item.entries("three lengths: x, y and z in F_0")?;
    let [x, y, z] = entries.map(|entry| constant(&entry, Dimension::LENGTH, "a coordinate of the point"));
    Some([x?, y?, z?])
}

/// Reads `[workspace.box]`: a grid of points in `F_0`. All variables are solved for unless `solve`
/// lists some.
fn base_box(section: &Section<'_>, spec: &Spec) -> Option<BaseBox> {
    section.check_keys(&[&keys::BOX]);
    let points = ["x", "y", "z"].map(|axis| values(&section.required(axis)?, Dimension::LENGTH));
    let free = Some(vec![ToolOrientation::Free]);
    let orientations = section.get("orientation").map_or(free, |item| orientations(&item));
    let variables = Candidates::variables(spec);
    let approaches = section.get("approaches");
    let held = approaches.as_ref().map_or_else(Vec::new, |item| variables.axes(item));
    let is_held = |i: &usize| held.iter().any(|axis| axis.index == *i);
    let solved = match section.get("solve") {
        Some(item) => variables.list(&item),
        None => (0..spec.variables.len()).filter(|i| !is_held(i)).collect(),
    };
    if let (Some(both), Some(item)) = (solved.iter().find(|i| is_held(i)), approaches) {
        section.document.mistake(held_and_solved(&spec.variables[*both].name, item.span()));
    }
    let combinations = held.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul);
    if combinations > APPROACHES {
        let message = format!("`approaches` has {combinations} combinations, the maximum is {APPROACHES}");
        return section.refuse(message, "use fewer values, or solve for the variables");
    }
    let [x, y, z] = points;
    Some(BaseBox { points: [x?, y?, z?], orientations: orientations?, approaches: held, solved })
}

fn held_and_solved(name: &str, span: Range<usize>) -> Diagnostic {
    Diagnostic::new(span, format!("`{name}` cannot be both fixed and solved for"))
        .help("remove it from `approaches` or from `solve`")
}

/// Reads `[workspace.joints]` or `[workspace.random]`: samples within the limits. All variables
/// move unless `moved` lists some.
fn samples(section: &Section<'_>, spec: &Spec, random: bool) -> Option<Region> {
    let known: [&abbe_spec::keys::Keys; 2] = [&keys::SAMPLES, &keys::RANDOM];
    section.check_keys(if random { &known } else { &known[..1] });
    let variables = spec.variables.len();
    let moved = match section.get("moved") {
        Some(item) => Candidates::variables_and_inputs(spec).list(&item),
        None => (0..variables).collect(),
    };
    let (moved, inputs): (Vec<usize>, Vec<usize>) = moved.into_iter().partition(|i| *i < variables);
    let sampled_inputs: Vec<usize> = inputs.into_iter().map(|i| i - variables).collect();
    if let Some(input) = sampled_inputs.iter().map(|i| &spec.inputs[*i]).find(|input| !has_range(input)) {
        let help = "add one in the spec: `range = [LOWER, UPPER]`";
        return section.refuse(format!("`{}` has no range", input.name), help);
    }
    let seed = match section.get("seed").filter(|_| random) {
        Some(item) => Some(whole(&item, [0, LARGEST])? as u64),
        None => random.then_some(0),
    };
    let count = count(&section.required("samples")?, LARGEST)?;
    Some(Region { sampled_inputs, ..Region::new(Form::Samples { moved, count, seed }) })
}

/// Returns the joint variables as a function of the passive variables, in closed form: each loop is
/// a leg whose length is `… + q`, so that `q = |p_a − p_b| − …`.
///
/// Returns what is different from that for other machines.
pub(super) fn legs(spec: &Spec) -> Result<Legs, String> {
    let mut variables = Vec::new();
    for closed in &spec.loops {
        let leg = match &closed.closure {
            Closure::Distance(length) => leg(spec, length).filter(|leg| !variables.contains(leg)),
            Closure::Coordinates(_) => None,
        };
        let name = &closed.name;
        variables.push(leg.ok_or_else(|| format!("the loop \"{name}\" is not a leg of the length `… + q`"))?);
    }
    if let Some(free) = (0..spec.variables.len()).find(|i| !variables.contains(i)) {
        return Err(format!("`{}` is not the length of a leg", spec.variables[free].name));
    }
    let factors = spec.frames.iter().flat_map(|frame| &frame.factors).chain(&spec.tool);
    let mut symbols = factors.flat_map(Factor::expressions).flat_map(|expression| expression.symbols());
    if symbols.any(|symbol| matches!(symbol, Symbol::Variable(_))) {
        return Err("frames move with the variables of legs".to_owned());
    }
    let (equations, count) = (LoopEquations::new(spec), spec.variables.len());
    Ok(Legs(Arc::new(move |p, s| {
        let lengths = equations.residual_at(&vec![0.0; count], p, s);
        let mut q = vec![0.0; count];
        for (variable, length) in variables.iter().zip(lengths) {
            q[*variable] = length;
        }
        q
    })))
}

/// Returns the variable of a leg whose length is a constant plus this variable.
fn leg(spec: &Spec, length: &Expression) -> Option<usize> {
    let mut graph = Graph::with_tables(&spec.tables);
    let length = graph.lower(length);
    let mut rate = |variable: usize| {
        let rate = graph.diff(length, Symbol::Variable(variable));
        graph.value(rate)
    };
    let rates: Vec<Option<f64>> = (0..spec.variables.len()).map(&mut rate).collect();
    let mut moved = (0..rates.len()).filter(|i| rates[*i] != Some(0.0));
    let first = moved.next().filter(|i| rates[*i] == Some(1.0));
    first.filter(|_| moved.next().is_none())
}
