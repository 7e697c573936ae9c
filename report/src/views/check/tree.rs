//! Freedoms of a machine with closed loops, and how these close at home.
//!
//! Kind, limits and home of a joint.

use std::f64::consts::PI;

use abbe::LengthUnit;
use abbe_spec::{Spec, Variable};
use abbe_study::check::{Free, Loop, LoopModes, Mode, State, Tree};
use abbe_study::number::{self, counted, digits, quantity, short};

use crate::document::{Section, Table, first, joined};
use crate::views::shared::dead_point;

/// Number of loops and of variables named in a sentence.
const NAMED: usize = 6;

/// Returns the freedoms, the loops and the passive variables.
pub(super) fn sections(tree: &Tree, spec: &Spec) -> Vec<Section> {
    let freedoms = format!(
        "{}, {}, {}; the tool is on {}.",
        counted(tree.commanded, "commanded variable", "commanded variables"),
        counted(tree.passive.len(), "passive variable", "passive variables"),
        counted(tree.equations, "equation of loops", "equations of loops"),
        tree.tool
    );
    let freedoms = Section::full("Freedoms").state("freedoms", freedoms);
    if tree.home.is_none() {
        return vec![freedoms];
    }
    let rows = tree.loops.iter().map(|closed| {
        let [first, second] = &closed.frames;
        let (frames, equations) = (format!("{first}, {second}"), closed.equations.to_string());
        [closed.name.clone(), frames, equations, closed.passive.join(" "), gaps(closed, spec)]
    });
    let columns = ["loop", "frames", ">equations", "passive", "open at home"];
    let loops = Table::new("", columns).rows(rows);
    let rows = tree.passive.iter().zip(&spec.passive).map(|(passive, variable)| {
        let [kind, limits, start] = joint(variable, spec.length);
        let closed = Variable { home: passive.value, ..variable.clone() };
        let [_, _, value] = joint(&closed, spec.length);
        [passive.name.clone(), passive.frame.clone(), kind, limits, start, value]
    });
    let passive = Table::new("", ["passive", "frame", "kind", "limits", "start", "at home"]).rows(rows);
    vec![
        freedoms,
        Section::full("Loops").table(loops),
        Section::full("Passive variables").table(passive).state(
            "condition",
            "The condition number is that of the derivatives of the equations by the passive variables at \
             home, with lengths relative to those of the loops."
                .to_owned(),
        ),
        modes(tree, spec),
    ]
}

/// Lists the assembly modes, each as values that choose it in the spec.
fn modes(tree: &Tree, spec: &Spec) -> Section {
    let found: &[LoopModes] = tree.home.as_ref().map_or(&[], |home| &home.modes);
    let line = |LoopModes { loops, starts, .. }: &LoopModes, mode: &Mode| {
        let values = mode.home.0.iter().map(|(name, value)| {
            let same = spec.passive.iter().find(|variable| variable.name == *name);
            let home =
                same.map(|variable| Variable { home: (value * 1e9).round() / 1e9 + 0.0, ..variable.clone() });
            let home = home.map_or(String::new(), |variable| joint(&variable, spec.length)[2].clone());
            format!("{name} = \"{home}\"")
        });
        let own = if mode.is_chosen { ", of the spec" } else { "" };
        let of = if found.len() > 1 { format!(" of {}", first(loops, NAMED)) } else { String::new() };
        format!("{}  # {} of {starts} starts{of}{own}", joined(values), mode.starts)
    };
    let lines = found.iter().flat_map(|group| group.found.iter().map(move |mode| line(group, mode)));
    Section::full("Assembly modes").code(
        "modes",
        "Positions in which the loops close with the commanded joints at home, within the limits: what Newton's \
         method found from random positions of the passive joints; there may be more. Values written as `home` of \
         these joints choose a mode.",
        lines.collect(),
    )
}

/// Returns the equations, the passive variables and their values in one sentence each.
pub(super) fn facts(tree: &Tree, spec: &Spec) -> Vec<(&'static str, String)> {
    let Some(home) = &tree.home else { return Vec::new() };
    let loops: Vec<String> =
        tree.loops.iter().map(|closed| format!("{} {}", closed.name, closed.equations)).collect();
    let values: Vec<String> = tree
        .passive
        .iter()
        .zip(&spec.passive)
        .map(|(passive, variable)| number::variable_is(variable, passive.value, spec))
        .collect();
    let largest = |gap: fn(&Loop) -> Option<f64>| tree.loops.iter().filter_map(gap).reduce(f64::max);
    let condition = home.condition.map_or("infinite".to_owned(), |condition| digits(condition, 3));
    vec![
        (
            "Loops",
            format!(
                "{} for {}: {}",
                counted(tree.equations, "equation", "equations"),
                counted(tree.passive.len(), "passive variable", "passive variables"),
                first(&loops, NAMED)
            ),
        ),
        (
            "Closure",
            format!(
                "residual {} at home, {}; condition number {condition}",
                open(largest(|closed| closed.gap), largest(|closed| closed.angular_gap), spec),
                first(&values, NAMED)
            ),
        ),
        ("", format!("nearest dead point: {}", dead_point(home.dead_point.as_ref(), spec))),
    ]
}

/// Returns the reason why the loops are not closed at home, and a way out.
pub(super) fn failure(tree: &Tree, spec: &Spec) -> Option<String> {
    let home = tree.home.as_ref()?;
    let values = || {
        let values = tree.passive.iter().zip(&spec.passive);
        let values = values.map(|(passive, variable)| number::variable_is(variable, passive.value, spec));
        joined(values)
    };
    match home.state {
        State::Closed => None,
        State::Open => {
            let mut loops: Vec<&Loop> = tree.loops.iter().filter(|closed| size(closed) > 1e-9).collect();
            loops.sort_by(|a, b| size(b).total_cmp(&size(a)));
            let loops: Vec<String> =
                loops.iter().map(|closed| format!("\"{}\" by {}", closed.name, gaps(closed, spec))).collect();
            Some(format!(
                "Open at home: {}. No values of the passive variables near {} close them: correct the lengths of \
                 the loops or the home of the commanded joints, or give the passive joints a `home` near the closed \
                 position.",
                first(&loops, NAMED),
                values()
            ))
        }
        State::Far => Some(format!(
            "The loops close at home at {}, which Newton's method does not reach from the given values: write these \
             as `home` of the passive joints.",
            values()
        )),
        State::Singular => {
            let free: Vec<String> = home.free.iter().map(direction).collect();
            Some(format!(
                "Singular at home, at {}: {}. Give the commanded joints a home where the links are not in line; if \
                 the machine moves so everywhere, close fewer coordinates and declare fewer joints `passive`.",
                values(),
                free.join("; ")
            ))
        }
    }
}

/// Returns a direction in which passive variables can move: `p1 and p2 can move by themselves, 1 :
/// −0.5 (loop "knee")`.
fn direction(free: &Free) -> String {
    let rates: Vec<String> = free.motion.iter().map(|rate| short(number::steady(round(*rate)))).collect();
    let verb = if free.passive.len() == 1 { "can move by itself" } else { "can move together" };
    let rates = if rates.len() > 1 { format!(", {}", rates.join(" : ")) } else { String::new() };
    format!("{} {verb}{rates} (loop {})", first(&free.passive, NAMED), first(&free.loops, NAMED))
}

fn round(rate: f64) -> f64 {
    (rate * 1e3).round() / 1e3
}

/// Largest gap in the length unit or rad.
fn size(closed: &Loop) -> f64 {
    closed.gap.into_iter().chain(closed.angular_gap).fold(0.0, f64::max)
}

fn gaps(closed: &Loop, spec: &Spec) -> String {
    open(closed.gap, closed.angular_gap, spec)
}

/// Formats a distance and an angle, of which one may be missing.
fn open(gap: Option<f64>, angular_gap: Option<f64>, spec: &Spec) -> String {
    let length = gap.map(|gap| format!("{} {}", digits(gap, 2), spec.length.symbol()));
    let angle = angular_gap.map(|gap| format!("{} rad", digits(gap, 2)));
    length.into_iter().chain(angle).collect::<Vec<_>>().join(" and ")
}

/// Returns the kind, the limits and the home of a joint, in deg or in the length unit.
pub(super) fn joint(variable: &Variable, length: LengthUnit) -> [String; 3] {
    let (kind, scale, unit) =
        variable.kind.either(("revolute", 180.0 / PI, "deg"), ("prismatic", 1.0, length.symbol()));
    let [lower, upper] = variable.limits.map(|limit| short(limit * scale));
    let limits = match variable.limits.map(f64::is_finite) {
        [false, false] => "no limits".to_owned(),
        _ if lower == upper => format!("{lower} {unit}"),
        _ => format!("{lower} … {upper} {unit}"),
    };
    [kind.to_owned(), limits, quantity(variable.home * scale, unit)]
}
