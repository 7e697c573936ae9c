//! Writes the identified machine as a spec: the nominal text with its comments, and the identified
//! errors as repeatable sources.

use std::path::Path;

use abbe::{Component, VariableKind};
use abbe_spec::edit::write::{free_name, list, number, quantity, quoted};
use abbe_spec::edit::{Edits, TableText};
use abbe_spec::expr::{Dimension, Symbol};
use abbe_spec::{Fitted, Section, Spec};

use super::derived::{Derived, with_inputs};
use super::profile_table::table_name;
use super::{Basis, ErrorSite, FoundError, FoundMagnitude, FoundModel, FoundTerm, Term};
use abbe_study::{Result, number::digits};

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
    /// Without errors of the machine the text remains as it is.
    ///
    /// The result is parsed again; the function fails if it is not a valid spec. Table files are
    /// resolved relative to `path`.
    pub fn identified_spec(&self, spec: &Spec, text: &str, path: &str) -> Result<IdentifiedSpec> {
        if self.is_placement {
            return Ok(IdentifiedSpec { text: text.to_owned(), added: String::new() });
        }
        let is_frame = |name: &str| spec.frames.iter().any(|frame| frame.name == name);
        let base = free_name("ground", |i| format!("ground {i}"), is_frame);
        let sources = self.sources(spec, &base) + &self.unexplained_sources(spec) + &self.inputs(spec);
        let mut head = TableText::default();
        if self.terms.iter().any(|found| matches!(found.term.site, ErrorSite::Base(_))) {
            head = TableText::with_header("[[frame]]")
                .text("name", &base)
                .key("origin", "{ xyz = [0, 0, 0] }\n");
        }
        let is_elastic = self.terms.iter().any(|found| found.term.basis.is_elastic());
        let [load, gravity] = if is_elastic { weight(spec) } else { Default::default() };
        let mut changed = String::new();
        let kept = Edits::apply(text, |root, edits| {
            edits.insert(0, &gravity);
            edits.insert(root.get("frame")?.span().start, &head);
            edits.remove_tables(root, &["fitted", "covariance"]);
            changed = set_magnitudes(root, edits, spec, &self.magnitudes);
            Some(())
        });
        let kept = kept.as_deref().unwrap_or(text).trim_end();
        let fitted = self.fitted_table(spec);
        let covariance = self.covariance_table(spec);
        let new = format!("{kept}\n{sources}\n{fitted}{covariance}{load}");
        let added = format!("{gravity}{changed}{head}{}\n{fitted}{load}", sources.trim_start());
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

    /// Returns the source of an error, with its class and the keys after it.
    pub(super) fn source(&self, spec: &Spec, name: &str, description: &str, keys: TableText) -> TableText {
        let name = source_name(spec, name);
        let head =
            TableText::with_header("\n[[source]]").text("name", &name).text("description", description);
        head.then(keys).text("reference", &self.reference)
    }

    /// Returns the table and the source of each profile of a joint.
    fn profile_sources(&self, spec: &Spec) -> impl Iterator<Item = String> {
        self.profiles.iter().map(|one| {
            let (table, joint, description) = (table_name(spec, &one.joint), &one.joint, one.description());
            let keys = repeatable().text("joint", joint).text("error", &format!("{table}({joint})"));
            let source = self.source(spec, &one.source_name(), &description, keys);
            format!("{}{source}", one.table.text(&table, &description, &self.reference))
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
        effect(&with_inputs(spec, &self.derived), &found.term, found.magnitude, "F_0").to_string()
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
            let keys = TableText::with_header(&format!("\n[inputs.{}]", one.name)).key("value", 0);
            keys.key("range", "[-1, 1]").text("description", &one.description(spec)).to_string()
        };
        self.needed(spec).into_iter().map(input).collect()
    }

    /// Returns the `[fitted]` table, the fitted ranges of joints and inputs.
    fn fitted_table(&self, spec: &Spec) -> String {
        let line = |keys: TableText, fitted: &Fitted| {
            let unit = match fitted.symbol {
                Symbol::Variable(i) if spec.variables[i].kind == VariableKind::Revolute => "rad",
                Symbol::Input(i) => &spec.inputs[i].unit,
                _ => spec.length.symbol(),
            };
            let ends = fitted.range.map(|end| quoted(format!("{} {unit}", number(end, DIGITS)).trim_end()));
            keys.key(spec.name_of(fitted.symbol), list(ends))
        };
        self.fitted.iter().fold(TableText::with_header(&format!("{}[fitted]", ABOVE[0])), line).to_string()
    }

    fn constant_source(&self, spec: &Spec, frame: &str, errors: &[FoundError]) -> String {
        let (mut keys, mut deviations) = (repeatable().text("frame", frame), Vec::new());
        for error in errors {
            let name = error.component.name();
            let unit = if error.component.is_rotation() { "rad" } else { spec.length.symbol() };
            keys = keys.key(name, quantity(number(error.value, DIGITS), unit));
            deviations.push(format!("{name} {} {unit}", digits(error.standard_deviation, 2)));
        }
        let description = format!("Standard deviations: {}", deviations.join(", "));
        self.source(spec, &constant_name(frame), &description, keys).to_string()
    }

    /// Returns the name of a term's source, unless one of the spec has it.
    pub(super) fn term_name(&self, spec: &Spec, found: &FoundTerm) -> String {
        let spec = &with_inputs(spec, &self.derived);
        format!("identified: {}", found.term.name(spec))
    }

    fn term_source(&self, spec: &Spec, found: &FoundTerm, base: &str) -> String {
        let FoundTerm { term, magnitude, standard_deviation, .. } = found;
        let name = self.term_name(spec, found);
        let (nominal, spec) = (spec, &with_inputs(spec, &self.derived));
        // The spec refuses a negative compliance; the sign goes into the magnitude.
        let is_reversed = term.basis == Basis::Moment && *magnitude < 0.0;
        let (size, keys, remark) = if is_reversed {
            let fitted = magnitude_table(*magnitude, *standard_deviation);
            let remark = ". The value is negative: elasticity alone does not explain it";
            (1.0, repeatable().key("magnitude", fitted), remark)
        } else {
            (*magnitude, repeatable(), "")
        };
        let deviation = match term.basis {
            Basis::One => format!("{} {}", digits(*standard_deviation, 2), term.site.unit(spec)),
            _ => format!("{} of the value", digits((standard_deviation / magnitude).abs(), 2)),
        };
        let own = term.name(spec);
        let alternatives =
            self.joint_errors.iter().filter(|one| term.basis == Basis::One && own == one.number);
        let alternatives = alternatives.flat_map(|one| &one.alternatives).map(|one| one.number.as_str());
        let alternatives = match alternatives.collect::<Vec<_>>() {
            names if names.is_empty() => String::new(),
            names => format!(". Explains the data as well: {}", names.join(", ")),
        };
        let description = format!("Standard deviation: {deviation}{remark}{alternatives}");
        let source = self.source(nominal, &name, &description, keys);
        source
            .then(TableText::with_header("\n[[source.effect]]"))
            .then(effect(spec, term, size, base))
            .to_string()
    }
}

/// Digits of the numbers of a written spec.
pub(super) const DIGITS: usize = 7;

/// Comments above the tables of an identification.
pub(super) const ABOVE: [&str; 2] = [
    "# The ranges of joints and inputs on which the errors were fitted.\n",
    "# The covariance of what remains of the errors, relative to a base and a target that are set up anew.\n",
];

/// Returns the name of the source with the constant errors of a frame, unless one of the spec has
/// it.
pub(super) fn constant_name(frame: &str) -> String {
    format!("identified: {frame}")
}

pub(super) fn repeatable() -> TableText {
    TableText::default().text("class", "repeatable")
}

impl ErrorSite {
    /// Returns the unit of an error at this site, as a spec writes it.
    fn unit(self, spec: &Spec) -> &str {
        match self {
            Self::Parameter(parameter) => &spec.parameters[parameter].unit,
            _ if self.dimension(spec) == Dimension::NONE => "rad",
            _ => spec.length.symbol(),
        }
    }
}

/// Writes the keys of the effect of a term. `base` is the name of the frame at `F_0`.
fn effect(spec: &Spec, term: &Term, magnitude: f64, base: &str) -> TableText {
    let (factor, basis, unit) = (number(magnitude, DIGITS), term.basis.text(spec), term.site.unit(spec));
    let error = match (term.basis, unit) {
        (Basis::One, unit) => quoted(format!("{factor} {unit}").trim_end()),
        (_, "" | "rad") => quoted(&format!("{factor} * ({basis})")),
        (_, unit) => quoted(&format!("{factor} * (1 {unit} * {basis})")),
    };
    let of = |owner: &str, name: &str| TableText::default().text(owner, name);
    let of_frame = |name: &str, component: Component| match term.basis {
        Basis::Moment => {
            let entry = |rotation: Component| match rotation == component {
                true => quoted(&format!("{factor} * {basis}")),
                false => "0".to_owned(),
            };
            let diagonal = list(Component::ALL.map(entry));
            of("frame", name).key("compliance", format!("{{ diagonal = {diagonal} }}"))
        }
        Basis::Coupled(other) => {
            let (one, other) = (component.name(), other.name());
            let error = quoted(&format!("{factor} * {basis}"));
            of("frame", name)
                .then(format!("compliance: {one} and {other} by the moments about each other: {error}\n"))
        }
        _ => of("frame", name).key(component.name(), &error),
    };
    match term.site {
        ErrorSite::Joint(joint) => of("joint", &spec.variables[joint].name).key("error", error),
        ErrorSite::Parameter(parameter) => {
            of("parameter", &spec.parameters[parameter].name).key("error", error)
        }
        ErrorSite::DenavitHartenberg(frame, number) => {
            of("frame", &spec.frames[frame].name).key("dh", format!("{{ {} = {error} }}", number.name()))
        }
        ErrorSite::Frame(frame, component) => of_frame(&spec.frames[frame].name, component),
        ErrorSite::Base(component) => of_frame(base, component),
    }
}

/// Sets the magnitudes of a spec's sources. Returns a summary of the changes.
fn set_magnitudes(
    root: &Section<'_>,
    edits: &mut Edits<'_>,
    spec: &Spec,
    magnitudes: &[FoundMagnitude],
) -> String {
    let sources = root.get("source").map(|item| item.list()).unwrap_or_default();
    let mut changed = String::new();
    for FoundMagnitude { source, magnitude, standard_deviation, .. } in magnitudes {
        let section = sources.get(*source).and_then(|item| item.as_table());
        let Some(item) = section.and_then(|section| section.get("magnitude")) else { continue };
        let table = magnitude_table(*magnitude, *standard_deviation);
        changed += &format!("# {}\nmagnitude = {table}\n\n", spec.sources[*source].name);
        edits.set(&item, "value", number(*magnitude, DIGITS));
        edits.set(&item, "standard_deviation", digits(*standard_deviation, 3));
    }
    changed
}

fn magnitude_table(magnitude: f64, standard_deviation: f64) -> String {
    let (value, deviation) = (number(magnitude, DIGITS), digits(standard_deviation, 3));
    format!("{{ value = {value}, standard_deviation = {deviation} }}")
}

/// Returns the load and the gravity that compliances need, each empty if the spec has one.
fn weight(spec: &Spec) -> [TableText; 2] {
    let last = spec.frames.get(spec.tool_frame).map_or("", |frame| frame.name.as_str());
    let load =
        TableText::with_header("\n[[load]]").text("name", "weight at the tool point").text("mass", "1 kg");
    let load = load.text("frame", last).text("point", "tool");
    let gravity = TableText::default().key("gravity", "[0, 0, \"-9.80665 m/s^2\"]");
    let unless = |has: bool, table: TableText| if has { TableText::default() } else { table };
    [unless(!spec.loads.is_empty(), load), unless(spec.gravity.is_some(), gravity)]
}

/// Returns a name that no source has.
pub(super) fn source_name(spec: &Spec, name: &str) -> String {
    let is_taken = |name: &str| spec.sources.iter().any(|source| source.name == name);
    free_name(name, |i| format!("{name} ({i})"), is_taken)
}
