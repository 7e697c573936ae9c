//! Writes the identified machine as a spec: the nominal text with its comments, and the identified
//! errors as repeatable sources.

use std::path::Path;

use abbe::{Component, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::{Document, Section};
use abbe_spec::expr::{Motion, Symbol};
use abbe_spec::literal::quoted;
use abbe_spec::{Fitted, Spec};

use super::derived::{Derived, with_inputs};
use super::found_model::{FoundError, FoundMagnitude, FoundModel, FoundTerm};
use super::profile_table::table_name;
use super::terms::{Basis, ErrorSite, Term};
use abbe_study::number::digits;

/// Spec of an identified machine.
#[derive(Clone, Debug)]
pub struct IdentifiedSpec {
    /// Complete text.
    pub text: String,
    /// Text that was added to the nominal spec.
    pub added: String,
}

impl FoundModel {
    /// Adds the identified errors to `text`, the nominal spec. `path` is the name of the new file.
    ///
    /// The result is parsed again; the function fails if it is not a valid spec. Table files are
    /// resolved relative to `path`.
    pub fn identified_spec(
        &self,
        spec: &Spec,
        text: &str,
        path: &str,
    ) -> Result<IdentifiedSpec, Diagnostics> {
        let base = free_name(spec, "ground");
        let sources = self.sources(spec, &base) + &self.unexplained_sources(spec) + &self.inputs(spec);
        let (kept, changed) = with_magnitudes(&without_fitted(text), spec, &self.magnitudes);
        let ground = match self.terms.iter().any(|found| matches!(found.term.site, ErrorSite::Base(_))) {
            true => format!("[[frame]]\nname = {}\norigin = {{ xyz = [0, 0, 0] }}\n\n", quoted(&base)),
            false => String::new(),
        };
        let at =
            if kept.starts_with("[[frame]]") { Some(0) } else { kept.find("\n[[frame]]").map(|at| at + 1) };
        let (before, behind) = kept.split_at(at.unwrap_or_default());
        let fitted = self.fitted_table(spec);
        let covariance = self.covariance_table(spec) + &self.undetermined_table(spec);
        let mut new = format!("{before}{ground}{}\n{sources}\n{fitted}{covariance}", behind.trim_end());
        let mut added = format!("{changed}{ground}{}\n{fitted}", sources.trim_start());
        if self.terms.iter().any(|found| found.term.basis.is_elastic()) {
            let [load, gravity] = weight(spec);
            new = format!("{gravity}{}\n{load}", new.trim_end());
            added = format!("{gravity}{added}{load}");
        }
        Spec::parse_in(Path::new(path).parent().unwrap_or(Path::new("")), path, &new)?;
        Ok(IdentifiedSpec { text: new, added })
    }

    fn sources(&self, spec: &Spec, base: &str) -> String {
        let names = spec.frames.iter().map(|frame| frame.name.as_str());
        let constants = names.zip(&self.frames).filter(|(_, errors)| !errors.is_empty());
        let constants = constants.map(|(frame, errors)| self.constant_source(spec, frame, errors));
        let numbers = self.numbers.iter().map(|found| self.term_source(spec, found, base));
        let terms = self.terms.iter().filter(|found| self.is_expressible(spec, found));
        let terms = terms.filter(|found| !self.is_in_full_compliance(found));
        let terms = numbers.chain(constants).chain(terms.map(|found| self.term_source(spec, found, base)));
        terms.chain([self.full_compliances(spec, base)]).chain(self.profile_sources(spec)).collect()
    }

    /// Returns the table and the source of each profile of a joint.
    fn profile_sources(&self, spec: &Spec) -> impl Iterator<Item = String> {
        self.profiles.iter().map(|(_, one)| {
            let (table, joint) = (table_name(spec, &one.joint), &one.joint);
            let name = source_name(spec, &one.source_name());
            let description = quoted(&one.description());
            let reference = quoted(&self.reference);
            format!(
                "{}\n[[source]]\nname = {}\ndescription = {description}\nclass = \"repeatable\"\njoint = {}\nerror \
                 = {}\nreference = {reference}\n",
                one.table.text(&table, &description, &reference),
                quoted(&name),
                quoted(joint),
                quoted(&format!("{table}({joint})")),
            )
        })
    }

    /// Returns the derived input of a term, if it has one.
    fn derived(&self, spec: &Spec, found: &FoundTerm) -> Option<&Derived> {
        let Basis::Input(input) = found.term.basis else { return None };
        self.derived.get(input.checked_sub(spec.inputs.len())?)
    }

    /// Returns true if a spec can contain a term: its input must not depend on the rows of one
    /// file.
    pub fn is_expressible(&self, spec: &Spec, found: &FoundTerm) -> bool {
        self.derived(spec, found).is_none_or(|one| one.from_rows().is_some())
    }

    /// Formats a term as lines of a spec that has the derived inputs.
    pub fn lines(&self, spec: &Spec, found: &FoundTerm) -> String {
        effect_lines(&with_inputs(spec, &self.derived), &found.term, found.magnitude, "F_0")
    }

    /// Returns the derived inputs that the written terms need.
    pub(super) fn needed(&self, spec: &Spec) -> Vec<&Derived> {
        let mut needed: Vec<&Derived> = Vec::new();
        for found in self.terms.iter().filter(|found| self.is_expressible(spec, found)) {
            needed.extend(self.derived(spec, found).filter(|one| !needed.contains(one)));
        }
        needed
    }

    fn inputs(&self, spec: &Spec) -> String {
        let input = |one: &Derived| {
            let description = quoted(&one.description(spec));
            format!("\n[inputs.{}]\nvalue = 0\nrange = [-1, 1]\ndescription = {description}\n", one.name)
        };
        self.needed(spec).into_iter().map(input).collect()
    }

    /// Returns the `[fitted]` table, the fitted ranges of joints and inputs.
    fn fitted_table(&self, spec: &Spec) -> String {
        let line = |fitted: &Fitted| {
            let unit = match fitted.symbol {
                Symbol::Variable(i) if spec.variables[i].kind == VariableKind::Revolute => "rad",
                Symbol::Input(i) => &spec.inputs[i].unit,
                _ => spec.length.symbol(),
            };
            let [lower, upper] =
                fitted.range.map(|end| format!("{} {unit}", format_number(end)).trim_end().to_owned());
            format!("{} = [{}, {}]\n", spec.name_of(fitted.symbol), quoted(&lower), quoted(&upper))
        };
        let lines = self.fitted.iter().map(line).collect::<String>();
        format!("{}[fitted]\n{lines}", ABOVE[0])
    }

    fn constant_source(&self, spec: &Spec, frame: &str, errors: &[FoundError]) -> String {
        let (mut lines, mut deviations) = (String::new(), Vec::new());
        for error in errors {
            let name = error.component.name();
            let unit = if error.component.is_rotation() { "rad" } else { spec.length.symbol() };
            lines += &format!("{name} = \"{} {unit}\"\n", format_number(error.value));
            deviations.push(format!("{name} {} {unit}", digits(error.standard_deviation, 2)));
        }
        format!(
            "\n[[source]]\nname = {}\ndescription = {}\nclass = \"repeatable\"\nframe = {}\n{lines}reference = {}\n",
            quoted(&constant_name(spec, frame)),
            quoted(&format!("Standard deviations: {}", deviations.join(", "))),
            quoted(frame),
            quoted(&self.reference),
        )
    }

    /// Returns the name of a term's source.
    pub(super) fn term_name(&self, spec: &Spec, found: &FoundTerm) -> String {
        let spec = &with_inputs(spec, &self.derived);
        source_name(spec, &format!("identified: {}", found.term.name(spec)))
    }

    fn term_source(&self, spec: &Spec, found: &FoundTerm, base: &str) -> String {
        let FoundTerm { term, magnitude, standard_deviation, .. } = found;
        let name = self.term_name(spec, found);
        let spec = &with_inputs(spec, &self.derived);
        // The spec refuses a negative compliance; the sign goes into the magnitude.
        let is_reversed = term.basis == Basis::Moment && *magnitude < 0.0;
        let (size, reversed, remark) = match is_reversed {
            true => {
                let fitted = magnitude_table(*magnitude, *standard_deviation);
                let remark = ". The value is negative: elasticity alone does not explain it";
                (1.0, format!("magnitude = {fitted}\n"), remark)
            }
            false => (*magnitude, String::new(), ""),
        };
        let deviation = match term.basis {
            Basis::One => format!("{} {}", digits(*standard_deviation, 2), term.site.unit(spec)),
            _ => format!("{} of the value", digits((standard_deviation / magnitude).abs(), 2)),
        };
        let number = term.name(spec);
        let alternatives =
            self.meanings.iter().filter(|one| term.basis == Basis::One && number == one.number);
        let alternatives = alternatives.flat_map(|one| &one.alternatives).map(|one| one.number.as_str());
        let alternatives = match alternatives.collect::<Vec<_>>() {
            names if names.is_empty() => String::new(),
            names => format!(". Explains the data as well: {}", names.join(", ")),
        };
        format!(
            "\n[[source]]\nname = {}\ndescription = {}\nclass = \"repeatable\"\n{reversed}reference = {}\n\n[[source.effect]]\n{}\n",
            quoted(&name),
            quoted(&format!("Standard deviation: {deviation}{remark}{alternatives}")),
            quoted(&self.reference),
            effect_lines(spec, term, size, base),
        )
    }
}

/// Comments above the tables of an identification.
pub(super) const ABOVE: [&str; 3] = [
    "# The ranges of joints and inputs on which the errors were fitted.\n",
    "# The covariance of the errors that were fitted.\n",
    "# The errors that these measurements could not determine: they move other points of the tool.\n",
];

/// Returns the name of the source with the constant errors of a frame.
pub(super) fn constant_name(spec: &Spec, frame: &str) -> String {
    source_name(spec, &format!("identified: {frame}"))
}

impl ErrorSite {
    /// Returns the unit of an error at this site, as a spec writes it.
    fn unit(self, spec: &Spec) -> &str {
        let length = spec.length.symbol();
        let of = |is_angle: bool| if is_angle { "rad" } else { length };
        match self {
            Self::Joint(joint) => of(spec.variables[joint].kind == VariableKind::Revolute),
            Self::Parameter(parameter) => &spec.parameters[parameter].unit,
            Self::DenavitHartenberg(_, number) => of(number.motion().0 == Motion::Rotation),
            Self::Frame(_, component) | Self::Base(component) => of(component.is_rotation()),
        }
    }
}

/// Formats the effect of a term. `base` is the name of the frame at `F_0`.
fn effect_lines(spec: &Spec, term: &Term, magnitude: f64, base: &str) -> String {
    let (factor, basis, unit) = (format_number(magnitude), term.basis.text(spec), term.site.unit(spec));
    let error = match (term.basis, unit) {
        (Basis::One, unit) => format!("\"{factor} {unit}\"").replace(" \"", "\""),
        (_, "" | "rad") => format!("\"{factor} * ({basis})\""),
        (_, unit) => format!("\"{factor} * (1 {unit} * {basis})\""),
    };
    let of_frame = |name: &str, component: Component| {
        let error = match term.basis {
            Basis::Moment => {
                let entry = |rotation: Component| match rotation == component {
                    true => format!("\"{factor} * {basis}\""),
                    false => "0".to_owned(),
                };
                format!("compliance = {{ diagonal = [{}] }}", Component::ALL.map(entry).join(", "))
            }
            Basis::Coupled(other) => {
                let (one, other) = (component.name(), other.name());
                format!(
                    "compliance: {one} and {other} by the moments about each other: \"{factor} * {basis}\""
                )
            }
            _ => format!("{} = {error}", component.name()),
        };
        format!("frame = {}\n{error}", quoted(name))
    };
    match term.site {
        ErrorSite::Joint(joint) => {
            format!("joint = {}\nerror = {error}", quoted(&spec.variables[joint].name))
        }
        ErrorSite::Parameter(parameter) => {
            format!("parameter = {}\nerror = {error}", quoted(&spec.parameters[parameter].name))
        }
        ErrorSite::DenavitHartenberg(frame, number) => {
            format!("frame = {}\ndh = {{ {} = {error} }}", quoted(&spec.frames[frame].name), number.name())
        }
        ErrorSite::Frame(frame, component) => of_frame(&spec.frames[frame].name, component),
        ErrorSite::Base(component) => of_frame(base, component),
    }
}

/// Replaces the magnitudes of a spec's sources. Returns the new text and a summary of the changes.
fn with_magnitudes(text: &str, spec: &Spec, magnitudes: &[FoundMagnitude]) -> (String, String) {
    let mut document = Document::new("", text);
    let tables = document.tables(text);
    let sources = tables.as_ref().and_then(|tables| Section::root(tables).get("source"));
    let sources = sources.and_then(|item| document.array(&item, "sources")).unwrap_or_default();
    let (mut edits, mut changed) = (Vec::new(), String::new());
    for FoundMagnitude { source, magnitude, standard_deviation, .. } in magnitudes {
        let section = sources.get(*source).and_then(|item| document.section(item));
        let Some(item) = section.and_then(|section| section.get("magnitude")) else { continue };
        let table = magnitude_table(*magnitude, *standard_deviation);
        changed += &format!("# {}\nmagnitude = {table}\n\n", spec.sources[*source].name);
        if text[item.span()].starts_with('{') {
            edits.push((item.span(), table));
            continue;
        }
        // The magnitude is a table with its own header, or dotted keys: each number is edited
        // separately.
        let Some(inside) = document.section(&item) else { continue };
        let new =
            [("value", format_number(*magnitude)), ("standard_deviation", digits(*standard_deviation, 3))];
        let present = new.iter().find_map(|(key, _)| inside.get(key));
        for (key, value) in new {
            match (inside.get(key), &present) {
                (Some(entry), _) => edits.push((entry.span(), value)),
                (None, Some(other)) => {
                    let start = text[..other.key_span.start].rfind('\n').map_or(0, |newline| newline + 1);
                    let before = text[start..other.key_span.start].to_owned();
                    edits.push((start..start, format!("{before}{key} = {value}\n")));
                }
                (None, None) => {
                    let end =
                        text[item.key_span.end..].find('\n').map_or(text.len(), |n| item.key_span.end + n);
                    edits.push((end..end, format!("\n{key} = {value}")));
                }
            }
        }
    }
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    edits.into_iter().for_each(|(span, new)| text.replace_range(span, &new));
    (text, changed)
}

fn magnitude_table(magnitude: f64, standard_deviation: f64) -> String {
    format!(
        "{{ value = {}, standard_deviation = {} }}",
        format_number(magnitude),
        digits(standard_deviation, 3)
    )
}

/// Formats a number of a spec with seven digits.
pub(super) fn format_number(value: f64) -> String {
    format!("{:e}", format!("{value:.6e}").parse::<f64>().unwrap_or(value) + 0.0)
}

/// Returns the load and the gravity that compliances need, each empty if the spec has one.
fn weight(spec: &Spec) -> [String; 2] {
    let last = spec.frames.get(spec.tool_frame).map_or("", |frame| frame.name.as_str());
    let load = format!(
        "\n[[load]]\nname = \"weight at the tool point\"\nmass = \"1 kg\"\nframe = {}\npoint = \"tool\"\n",
        quoted(last)
    );
    let gravity = "gravity = [0, 0, \"-9.80665 m/s^2\"]\n".to_owned();
    [
        if spec.loads.is_empty() { load } else { String::new() },
        if spec.gravity.is_none() { gravity } else { String::new() },
    ]
}

/// Removes the ranges, the covariance and the undetermined errors of an earlier identification from
/// a spec.
fn without_fitted(text: &str) -> String {
    let mut inside = false;
    let kept = text.split_inclusive('\n').filter(|line| {
        if line.starts_with('[') {
            inside = ["[fitted]", "[covariance]", "[undetermined]"].contains(&line.trim_end());
        }
        !inside && !ABOVE.iter().any(|above| line.trim_end() == above.trim_end())
    });
    kept.collect()
}

/// Returns a name that no frame has.
fn free_name(spec: &Spec, name: &str) -> String {
    let taken = |name: &str| spec.frames.iter().any(|frame| frame.name == name);
    let names = std::iter::once(name.to_owned()).chain((2..).map(|i| format!("{name} {i}")));
    names.into_iter().find(|name| !taken(name)).unwrap_or_default()
}

/// Returns a name that no source has.
pub(super) fn source_name(spec: &Spec, name: &str) -> String {
    let taken = |name: &str| spec.sources.iter().any(|source| source.name == name);
    let names = std::iter::once(name.to_owned()).chain((2..).map(|i| format!("{name} ({i})")));
    names.into_iter().find(|name| !taken(name)).unwrap_or_default()
}
