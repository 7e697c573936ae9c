//! Candidates for richer models: sources of one unit each, whose magnitudes are unknown.
//!
//! A candidate is written as a spec has it, so that what is fitted, what is written back and what `analyze` then
//! computes are one and the same.

use abbe_codegen::spec::{Component, Spec, VariableKind};

use crate::arguments::Terms;
use crate::failure::Failure;

/// A source whose magnitude is to be found.
#[derive(Clone, Debug)]
pub(super) struct Source {
    pub(super) name: String,
    pub(super) frame: String,
    /// `e_x`, and its value for magnitude 1; without it the effect is a compliance.
    pub(super) key: &'static str,
    pub(super) value: String,
    /// The candidates of a group come together.
    pub(super) group: String,
}

impl Source {
    /// As a spec has it, `factor` times.
    pub(super) fn effect(&self, factor: Option<f64>) -> String {
        match (self.key, factor) {
            ("compliance", factor) => {
                let entry = format!("\"{} * {}\"", number(factor.unwrap_or(1.0)), self.value);
                let place = |component: &str| {
                    if self.group.ends_with(component) { entry.clone() } else { "0".to_owned() }
                };
                format!(
                    "compliance = {{ diagonal = [0, 0, 0, {}, {}, {}] }}",
                    place("e_s"),
                    place("e_r"),
                    place("e_p")
                )
            }
            (key, None) => format!("{key} = \"{}\"", self.value),
            (key, Some(factor)) => format!("{key} = \"{} * ({})\"", number(factor), self.value),
        }
    }
}

/// A number that a spec understands, to seven digits.
pub(super) fn number(value: f64) -> String {
    format!("{:e}", format!("{value:.6e}").parse::<f64>().unwrap_or(value) + 0.0)
}

/// The candidates of the families that are asked for.
pub(super) fn candidates(spec: &Spec, terms: &[Terms]) -> Vec<Source> {
    let has = |family| terms.contains(&family) || terms.contains(&Terms::Auto);
    let mut all = Vec::new();
    if has(Terms::Joint) {
        joint(spec, &mut all);
    }
    if has(Terms::Load) {
        load(spec, &mut all);
    }
    if has(Terms::Elastic) {
        elastic(spec, &mut all);
    }
    all
}

/// Errors that change with a frame's own joint: once and twice per turn, or in proportion to its travel and its square.
fn joint(spec: &Spec, all: &mut Vec<Source>) {
    let unit = spec.length.symbol();
    for (frame, variable) in
        spec.frames.iter().filter_map(|frame| Some((frame, &spec.variables[frame.variable?])))
    {
        let q = &variable.name;
        for component in Component::ALL {
            let key = component.name();
            let size = if is_rotation(component) { String::new() } else { format!("1 {unit} * ") };
            let mut groups: Vec<(String, Vec<(String, String)>)> = Vec::new();
            match variable.kind {
                VariableKind::Revolute => {
                    for (times, argument) in [("once", q.clone()), ("twice", format!("2*{q}"))] {
                        let both = ["sin", "cos"]
                            .map(|f| (format!("{f}({argument})"), format!("{size}{f}({argument})")));
                        groups.push((format!("{times} per turn of {q}"), both.to_vec()));
                    }
                }
                VariableKind::Prismatic => {
                    for (power, what) in [(1, "in proportion to"), (2, "with the square of")] {
                        let value = format!("{size}({q}/(1000 {unit}))^{power}");
                        groups.push((format!("{what} {q}"), vec![(format!("{q}^{power}"), value)]));
                    }
                }
            }
            for (words, terms) in groups {
                let group = format!("{}: {words}, {key}", frame.name);
                all.extend(terms.into_iter().map(|(term, value)| Source {
                    name: format!("{}: {key} with {term}", frame.name),
                    frame: frame.name.clone(),
                    key,
                    value,
                    group: group.clone(),
                }));
            }
        }
    }
}

/// Errors in proportion to an input: to a load, a temperature.
fn load(spec: &Spec, all: &mut Vec<Source>) {
    let unit = spec.length.symbol();
    for input in &spec.inputs {
        let one = if input.unit.is_empty() { "1".to_owned() } else { format!("(1 {})", input.unit) };
        for frame in &spec.frames {
            for component in Component::ALL {
                let key = component.name();
                let size = if is_rotation(component) { String::new() } else { format!("1 {unit} * ") };
                let name = format!("{}: {key} with {}", frame.name, input.name);
                let value = format!("{size}{}/{one}", input.name);
                all.push(Source { group: name.clone(), name, frame: frame.name.clone(), key, value });
            }
        }
    }
}

/// Turns of a frame in proportion to the moment that the loads of the spec, or the weight of 1 kg at the tool point,
/// have about it.
fn elastic(spec: &Spec, all: &mut Vec<Source>) {
    let unit = spec.length.symbol();
    for frame in spec.frames.iter().filter(|frame| frame.variable.is_some()) {
        for component in Component::ALL.into_iter().filter(|component| is_rotation(*component)) {
            let name = format!("{}: gives way under weight, {}", frame.name, component.name());
            let value = format!("1e-6/(N*{unit})");
            all.push(Source {
                group: name.clone(),
                name,
                frame: frame.name.clone(),
                key: "compliance",
                value,
            });
        }
    }
}

fn is_rotation(component: Component) -> bool {
    component.is_rotation()
}

/// What elastic terms need beside their sources: a load and gravity, if the spec has none.
pub(super) fn weight(spec: &Spec) -> [String; 2] {
    let last = spec.frames.last().map_or("", |frame| frame.name.as_str());
    let load = format!("\n[[load]]\nname = \"weight at the tip\"\nmass = \"1 kg\"\nframe = {last:?}\n");
    let gravity = "gravity = [0, 0, \"-9.80665 m/s^2\"]\n".to_owned();
    [
        if spec.loads.is_empty() { load } else { String::new() },
        if spec.gravity.is_none() { gravity } else { String::new() },
    ]
}

/// The spec with all candidates as sources, its own sources first.
pub(super) fn with(spec: &Spec, text: &str, candidates: &[Source]) -> Result<Spec, Failure> {
    if candidates.is_empty() {
        return Ok(spec.clone());
    }
    let mut text = text.trim_end().to_owned() + "\n";
    if candidates.iter().any(|candidate| candidate.key == "compliance") {
        let [load, gravity] = weight(spec);
        text = gravity + &text + &load;
    }
    for candidate in candidates {
        let (name, frame) = (&candidate.name, &candidate.frame);
        text += &format!(
            "\n[[source]]\nname = {name:?}\nclass = \"repeatable\"\n\n[[source.effect]]\nframe = {frame:?}\n{}\n",
            candidate.effect(None)
        );
    }
    Ok(Spec::parse(&spec.file, &text)?)
}
