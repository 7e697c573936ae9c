//! The identified machine as a spec: the nominal one, comments and all, with the errors found as repeatable sources.

use std::path::Path;

use abbe_codegen::diagnostic::Diagnostics;
use abbe_codegen::expr::Symbol;
use abbe_codegen::spec::{Fitted, Spec, VariableKind};

use super::found::{FoundError, FoundModel, FoundTerm};
use super::terms::{Basis, Place, Term};
use crate::number::digits;

/// A spec to be written.
#[derive(Clone, Debug)]
pub struct WrittenSpec {
    /// All of it.
    pub text: String,
    /// What was added to the nominal one.
    pub added: String,
}

impl FoundModel {
    /// The nominal spec, whose text this is, with what was found; `path` is the name of its file.
    ///
    /// What is written is a spec, or it is not written: files of tables must be where they are looked for from there.
    pub fn written(&self, spec: &Spec, text: &str, path: &str) -> Result<WrittenSpec, Diagnostics> {
        let sources = self.sources(spec);
        let kept = without_fitted(text);
        let text = kept.as_str();
        let fitted = self.fitted_table(spec);
        let mut new = format!("{}\n{sources}\n{fitted}", text.trim_end());
        let mut added = format!("{}\n{fitted}", sources.trim_start());
        if self.terms.iter().any(|found| found.term.basis == Basis::Moment) {
            let [load, gravity] = weight(spec);
            new = format!("{gravity}{}\n{load}", new.trim_end());
            added = format!("{gravity}{added}{load}");
        }
        Spec::parse_in(Path::new(path).parent().unwrap_or(Path::new("")), path, &new)?;
        Ok(WrittenSpec { text: new, added })
    }

    fn sources(&self, spec: &Spec) -> String {
        let names = spec.frames.iter().map(|frame| frame.name.as_str());
        let constants = names.zip(&self.frames).filter(|(_, errors)| !errors.is_empty());
        let constants = constants.map(|(frame, errors)| self.constant(spec, frame, errors));
        constants.chain(self.terms.iter().map(|found| self.term(spec, found))).collect()
    }

    /// Where all this was fitted.
    fn fitted_table(&self, spec: &Spec) -> String {
        let line = |fitted: &Fitted| {
            let unit = match fitted.symbol {
                Symbol::Variable(i) if spec.variables[i].kind == VariableKind::Revolute => "rad",
                Symbol::Input(i) => &spec.inputs[i].unit,
                _ => spec.length.symbol(),
            };
            let [lower, upper] =
                fitted.range.map(|end| format!("{} {unit}", number(end)).trim_end().to_owned());
            format!("{} = [{lower:?}, {upper:?}]\n", fitted.name(spec))
        };
        let lines = self.fitted.iter().map(line).collect::<String>();
        format!("# The ranges of joints and inputs on which the errors were fitted.\n[fitted]\n{lines}")
    }

    fn constant(&self, spec: &Spec, frame: &str, errors: &[FoundError]) -> String {
        let (mut lines, mut deviations) = (String::new(), Vec::new());
        for error in errors {
            let name = error.component.name();
            let unit = if error.component.is_rotation() { "rad" } else { spec.length.symbol() };
            lines += &format!("{name} = \"{} {unit}\"\n", number(error.value));
            deviations.push(format!("{name} {} {unit}", digits(error.standard_deviation, 2)));
        }
        format!(
            "\n[[source]]\nname = {:?}\ndescription = {:?}\nclass = \"repeatable\"\nframe = {frame:?}\n{lines}reference = {:?}\n",
            source_name(spec, &format!("identified: {frame}")),
            format!("Standard deviations: {}", deviations.join(", ")),
            self.reference,
        )
    }

    fn term(&self, spec: &Spec, found: &FoundTerm) -> String {
        let FoundTerm { term, magnitude, standard_deviation } = found;
        // No body has a negative compliance: as one it would be refused.
        let is_reversed = term.basis == Basis::Moment && *magnitude < 0.0;
        let (size, reversed, remark) = match is_reversed {
            true => (
                -magnitude,
                "magnitude = { value = -1 }\n",
                ". Negative: it stands for something else than elasticity",
            ),
            false => (*magnitude, "", ""),
        };
        let deviation = digits((standard_deviation / magnitude).abs(), 2);
        format!(
            "\n[[source]]\nname = {:?}\ndescription = {:?}\nclass = \"repeatable\"\n{reversed}reference = {:?}\n\n[[source.effect]]\n{}\n",
            source_name(spec, &format!("identified: {}", term.name(spec))),
            format!("Standard deviation: {deviation} of it{remark}"),
            self.reference,
            effect(spec, term, size),
        )
    }
}

/// What a term is an error of, and which.
fn effect(spec: &Spec, term: &Term, magnitude: f64) -> String {
    let (factor, basis) = (number(magnitude), term.basis.text(spec));
    let error = |unit: &str| match unit {
        "" => format!("\"{factor} * ({basis})\""),
        unit => format!("\"{factor} * (1 {unit} * {basis})\""),
    };
    let length = spec.length.symbol();
    match term.place {
        Place::Joint(joint) => {
            let unit = match spec.variables[joint].kind {
                VariableKind::Revolute => "",
                VariableKind::Prismatic => length,
            };
            format!("joint = {:?}\nerror = {}", spec.variables[joint].name, error(unit))
        }
        Place::Parameter(parameter) => {
            let parameter = &spec.parameters[parameter];
            format!("parameter = {:?}\nerror = {}", parameter.name, error(&parameter.unit))
        }
        Place::Frame(frame, component) => {
            let name = component.name();
            let error = match (term.basis, component.is_rotation()) {
                (Basis::Moment, _) => {
                    let entry = |rotation: &str| match rotation == name {
                        true => format!("\"{factor} * {basis}\""),
                        false => "0".to_owned(),
                    };
                    let turns = ["e_s", "e_r", "e_p"].map(entry).join(", ");
                    format!("compliance = {{ diagonal = [0, 0, 0, {turns}] }}")
                }
                (_, true) => format!("{name} = {}", error("")),
                (_, false) => format!("{name} = {}", error(length)),
            };
            format!("frame = {:?}\n{error}", spec.frames[frame].name)
        }
    }
}

/// A number that a spec understands, to seven digits.
fn number(value: f64) -> String {
    format!("{:e}", format!("{value:.6e}").parse::<f64>().unwrap_or(value) + 0.0)
}

/// What compliances need beside their sources: a load and gravity, if the spec has none.
fn weight(spec: &Spec) -> [String; 2] {
    let last = spec.frames.last().map_or("", |frame| frame.name.as_str());
    let load = format!(
        "\n[[load]]\nname = \"weight at the tool point\"\nmass = \"1 kg\"\nframe = {last:?}\npoint = \"tool\"\n"
    );
    let gravity = "gravity = [0, 0, \"-9.80665 m/s^2\"]\n".to_owned();
    [
        if spec.loads.is_empty() { load } else { String::new() },
        if spec.gravity.is_none() { gravity } else { String::new() },
    ]
}

/// A spec without what an earlier identification says of its ranges.
fn without_fitted(text: &str) -> String {
    let mut inside = false;
    let kept = text.split_inclusive('\n').filter(|line| {
        if line.starts_with('[') {
            inside = line.trim_end() == "[fitted]";
        }
        !inside && !line.starts_with("# The ranges of joints and inputs on which the errors were fitted.")
    });
    kept.collect()
}

/// A name that no source has.
fn source_name(spec: &Spec, name: &str) -> String {
    let taken = |name: &str| spec.sources.iter().any(|source| source.name == name);
    let names = std::iter::once(name.to_owned()).chain((2..).map(|i| format!("{name} ({i})")));
    names.into_iter().find(|name| !taken(name)).unwrap_or_default()
}
