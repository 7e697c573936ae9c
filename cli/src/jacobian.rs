//! `abbe jacobian`: pose, error Jacobian and generalized errors at one configuration.

use std::fmt::Write;

use abbe::analysis::sampling;
use abbe::{Component, Description, Manipulator, Pose, Variable};
use abbe_codegen::diagnostic::{Diagnostic, Diagnostics, Span};
use abbe_codegen::document::Document;
use abbe_codegen::expr::{Dimension, parse_value};
use abbe_codegen::spec::{Spec, VariableKind};
use abbe_interpreter::Interpreter;
use serde::Serialize;

use crate::arguments::Jacobian;
use crate::failure::Failure;
use crate::output::{Outcome, json, note};
use crate::table::{Table, unbroken, wrapped};
use abbe_study::Machine;
use abbe_study::number;

/// What is printed, in the order of design section 4.
#[derive(Serialize)]
struct Report<'a> {
    name: &'a str,
    length: &'static str,
    orientation: &'static str,
    q: Vec<f64>,
    pose: [[f64; 4]; 4],
    rows: [&'static str; 6],
    columns: Vec<String>,
    error_jacobian: [Vec<f64>; 6],
    generalized_errors: Vec<f64>,
}

pub(crate) fn run(arguments: &Jacobian) -> Result<Outcome, Failure> {
    let mut found = Machine::find(&arguments.spec)?;
    found.change(&arguments.changes.read(&found.spec)?);
    let interpreter = Interpreter::new(found.spec.clone());
    let description = interpreter.description();
    let q = match &arguments.q {
        Some(text) => joint_variables(text, &found.spec)?,
        None => sampling::home(description),
    };
    for (variable, value) in description.variables.iter().zip(&q) {
        beyond_limits(variable, *value, description);
    }

    let s = sampling::nominal_parameters(description);
    let u = sampling::nominal_inputs(description);
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    let mut errors = vec![[0.0; 6]; description.frames.len()];
    let pose = interpreter
        .error_jacobian(&q, &s, &mut columns)
        .and_then(|pose| interpreter.generalized_errors(&q, &s, &u, &mut errors).map(|()| pose))
        .map_err(|error| Failure::evaluation(&found.origin, "this configuration", &error, description))?;
    let report = Report::new(description, q, &pose, &columns, &errors);
    let text = if arguments.json { json(&report)? } else { report.text(description) };
    Ok(Outcome::passed(text))
}

/// The values of `--q`, as many as there are variables.
fn joint_variables(text: &str, spec: &Spec) -> Result<Vec<f64>, Diagnostics> {
    let mut document = Document::new("--q", text);
    let spans = values(text);
    if spans.len() != spec.variables.len() {
        let names = spec.variables.iter().map(|variable| variable.name.as_str()).collect::<Vec<_>>();
        let message = format!("{} joint variables are needed, {} are given", names.len(), spans.len());
        let help = if names.is_empty() {
            "leave --q out".into()
        } else {
            format!("in this order: {}", names.join(","))
        };
        document.mistake(Diagnostic::new(0..text.len(), message).help(help));
        return document.finish(None);
    }
    let mut q = Vec::new();
    for (variable, span) in spec.variables.iter().zip(spans) {
        let dimension = match variable.kind {
            VariableKind::Revolute => Dimension::NONE,
            VariableKind::Prismatic => Dimension::LENGTH,
        };
        let what = format!("the value of `{}`", variable.name);
        q.extend(parse_value(&mut document, span, spec.length, dimension, &what));
    }
    document.finish(Some(q))
}

/// What stands between the commas; those in parentheses do not count.
fn values(text: &str) -> Vec<Span> {
    if text.trim().is_empty() {
        return Vec::new();
    }
    let (mut spans, mut start, mut depth) = (Vec::new(), 0, 0_usize);
    for (i, character) in text.char_indices() {
        match character {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                spans.push(start..i);
                start = i + 1;
            }
            _ => {}
        }
    }
    spans.push(start..text.len());
    spans
}

fn beyond_limits(variable: &Variable, value: f64, description: &Description) {
    let [lower, upper] = variable.limits;
    if !(lower..=upper).contains(&value) {
        let show = |value| number::of_variable(value, variable.kind, description.length);
        let Variable { name, .. } = variable;
        note(&format!(
            "note: {name} = {} is outside its limits {} … {}",
            show(value),
            show(lower),
            show(upper)
        ));
    }
}

impl<'a> Report<'a> {
    fn new(
        description: &'a Description,
        q: Vec<f64>,
        pose: &Pose,
        columns: &[[f64; 6]],
        errors: &[[f64; 6]],
    ) -> Self {
        // Adding 0 makes −0 a plain 0.
        let row = |i: usize| columns.iter().map(|column| column[i] + 0.0).collect();
        let names = (1..=description.frames.len())
            .flat_map(|frame| Component::ALL.map(|component| format!("{}{frame}", component.name())));
        Self {
            name: &description.name,
            length: description.length.symbol(),
            orientation: description.orientation.name(),
            q,
            pose: pose.rows().map(|row| row.map(|entry| entry + 0.0)),
            rows: description.orientation.rows(),
            columns: names.collect(),
            error_jacobian: std::array::from_fn(row),
            generalized_errors: errors.as_flattened().iter().map(|error| error + 0.0).collect(),
        }
    }

    fn text(&self, description: &Description) -> String {
        let mut text = String::new();
        let values = number::variables(&self.q, description);
        let unit = self.length;
        let _ = write!(
            text,
            "{} ({}) at {}\n\n\
             Units      {unit} and rad, in F_0\n\
             Rows       {} of the tool point ({unit}); {} (rad, {})\n\
             Columns    e_x e_y e_z ({unit}), e_s e_r e_p (rad) of each frame: turns about y, z, x\n\n\
             Pose of the tool\n",
            description.title,
            self.name,
            wrapped(&unbroken(&values), 0),
            self.rows[..3].join(", "),
            self.rows[3..].join(", "),
            self.orientation,
        );
        for row in &self.pose {
            let cells = row.map(|entry| format!("{:>14}", number::fixed(entry, 6)));
            let _ = writeln!(text, "{}", cells.concat());
        }
        for (i, frame) in description.frames.iter().enumerate() {
            let _ = writeln!(text, "\nFrame {}: {}", i + 1, frame.name);
            let six = 6 * i..6 * (i + 1);
            let mut header = vec![""];
            header.extend(self.columns[six.clone()].iter().map(String::as_str));
            let mut table = Table::new(&header);
            for (name, row) in self.rows.iter().zip(&self.error_jacobian) {
                table.row(cells(name, &row[six.clone()]));
            }
            table.row(cells("ε of the sources", &self.generalized_errors[six]));
            text += &table.right(&[1, 2, 3, 4, 5, 6]).to_string();
        }
        text
    }
}

fn cells(name: &str, values: &[f64]) -> Vec<String> {
    let values = values.iter().map(|value| number::fixed(*value, 6));
    std::iter::once(name.to_owned()).chain(values).collect()
}
