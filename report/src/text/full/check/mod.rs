//! Full text of a check.

mod chain;
mod joint;
mod tree;

use abbe_spec::Spec;
use abbe_study::check::{Identifiable, Law, Report};
use abbe_study::number::{quantity, short};

use super::{table, wrapped};

pub(in crate::text) use joint::joint;
pub(in crate::text) use tree::{facts as loops, failure as not_closed};

/// Returns what `abbe check` prints.
pub(in crate::text) fn check(report: &Report) -> String {
    let spec = &report.spec;
    let length = spec.length.symbol();
    let mut parts = vec![format!("{} ({})\n", spec.title, report.facts.spec)];
    if !spec.description.is_empty() {
        parts[0] += &format!("{}\n", wrapped(&spec.description, 0));
    }
    parts[0] += &format!("{}\n", verdict(report));
    parts[0] += &format!("\nLengths in {length}, orientation {}\n", report.facts.orientation);
    parts.push(format!("Frames\n{}", frames(spec)));
    if !report.iso_axes.is_empty() {
        parts.push(iso_axes(report));
    }
    if let Some(tree) = &report.tree {
        parts.push(tree::text(tree, spec));
    }
    if let Some(home) = &report.home {
        parts.push(chain::text(home, spec));
    }
    if !spec.parameters.is_empty() {
        let rows = spec
            .parameters
            .iter()
            .map(|p| [p.name.clone(), quantity(p.value, &p.unit), p.description.clone()]);
        parts.push(format!("Parameters\n{}", table(&["name", "nominal", "what"], rows)));
    }
    if !spec.inputs.is_empty() {
        let rows = spec.inputs.iter().map(|u| {
            let [lower, upper] = u.range.map(short);
            let range = format!("{lower} … {upper} {}", u.unit);
            [u.name.clone(), quantity(u.value, &u.unit), range, u.description.clone()]
        });
        parts.push(format!("Inputs\n{}", table(&["name", "nominal", "range", "what"], rows)));
    }
    if !report.facts.sources.is_empty() {
        let rows = report.facts.sources.iter().map(|source| {
            let state = if source.enabled { "on" } else { "off" };
            [source.name.clone(), source.class.to_owned(), source.at.clone(), state.to_owned()]
        });
        parts.push(format!("Sources\n{}", table(&["name", "class", "at", ""], rows)));
    }
    if !report.notes.is_empty() {
        let notes: String = report.notes.iter().map(|note| wrapped(note, 0) + "\n").collect();
        parts.push(format!("Notes\n{notes}"));
    }
    if !report.laws.is_empty() {
        parts.push(format!(
            "Identifiability\n{}",
            identifiable(&report.identifiable, report.identifiability_configurations)
        ));
        parts.push(format!("Laws, at {} configurations\n{}", report.configurations, laws(&report.laws)));
    }
    let rows = report.facts.operations.iter().map(|f| [f.function.to_owned(), f.operations.to_string()]);
    parts.push(format!("Operations of the generated code\n{}", table(&["function", "operations"], rows)));
    parts.join("\n")
}

/// Summarizes the check in one line.
fn verdict(report: &Report) -> String {
    let failed: Vec<&str> = report.laws.iter().filter(|law| !law.holds).map(|law| law.law).collect();
    let warnings = match report.warnings.len() + report.notes.len() {
        0 => String::new(),
        1 => ", with one remark".to_owned(),
        some => format!(", with {some} remarks"),
    };
    if let Some(failure) = report.tree.as_ref().and_then(|tree| tree::failure(tree, &report.spec)) {
        return wrapped(&format!("FAILED: the loops are not closed at home{warnings}. {failure}"), 0);
    }
    match failed.as_slice() {
        [] => format!("OK: spec valid, {} self-checks passed{warnings}", report.laws.len()),
        failed => format!("FAILED: {} of {} self-checks{warnings}", failed.len(), report.laws.len()),
    }
}

fn frames(spec: &Spec) -> String {
    let rows = spec.frames.iter().enumerate().map(|(i, frame)| {
        let number = (i + 1).to_string();
        let driven = frame.variable.map(|variable| &spec.variables[variable]);
        let Some(variable) = driven.or(frame.passive.map(|passive| &spec.passive[passive])) else {
            return [number, frame.name.clone(), String::new(), "fixed".into(), String::new(), String::new()];
        };
        let [kind, limits, home] = joint(variable, spec.length);
        let kind = if driven.is_some() { kind } else { format!("{kind}, passive") };
        [number, frame.name.clone(), variable.name.clone(), kind, limits, home]
    });
    let header = ["", "frame", "variable", "kind", "limits", "home"];
    if spec.is_serial() {
        return table(&header, rows);
    }
    let parents = spec.frames.iter().map(|frame| match frame.parent {
        Some(parent) => spec.frames[parent].name.clone(),
        None => "base".to_owned(),
    });
    let rows = rows.zip(parents).map(|([number, frame, variable, kind, limits, home], parent)| {
        [number, frame, parent, variable, kind, limits, home]
    });
    let legs = spec.variables.iter().enumerate().filter_map(|(i, variable)| {
        let leg = spec.leg(i)?;
        let [kind, limits, home] = joint(variable, spec.length);
        Some([
            String::new(),
            format!("loop {}", leg.name),
            String::new(),
            variable.name.clone(),
            kind,
            limits,
            home,
        ])
    });
    let header = ["", "frame", "hangs on", "variable", "kind", "limits", "home"];
    table(&header, rows.chain(legs))
}

/// Lists the names of ISO 230-1.
fn iso_axes(report: &Report) -> String {
    let rows = report.iso_axes.iter().map(|axis| {
        let [x, y, z, s, r, p] = axis.errors.clone();
        let carried = if axis.carries_workpiece { "workpiece" } else { "tool" };
        [axis.name.clone(), carried.to_owned(), x, y, z, s, r, p]
    });
    let header = ["frame", "carries", "e_x", "e_y", "e_z", "e_s", "e_r", "e_p"];
    let mut text = format!("Errors of the axes by ISO 230-1\n{}", table(&header, rows));
    let slides = "Slides are taken to carry the tool, which a spec does not say: the errors of a slide that carries \
        the workpiece have the opposite signs.";
    text += &(wrapped(slides, 0) + "\n");
    if report.iso_axes.iter().any(|axis| axis.carries_workpiece) {
        let sign = "ISO 230-1 states the error of an axis that carries the workpiece as seen from the part \
            that carries it: the error of the frame has the opposite sign.";
        text += &(wrapped(sign, 0) + "\n");
    }
    text
}

fn identifiable(counted: &[Identifiable], configurations: usize) -> String {
    let find = |measurement: &str, base: bool| {
        let counted = counted.iter().find(|way| way.measurement == measurement && way.base == base);
        match counted.map(|way| (way.rank, way.unknowns, &way.reason)) {
            Some((Some(rank), unknowns, _)) => format!("{rank} of {unknowns}"),
            Some((None, unknowns, reason)) => format!("an unknown number ({reason}) of {unknowns}"),
            None => String::new(),
        }
    };
    let (pose, pose_base) = (find("pose", false), find("pose", true));
    let (point, point_base) = (find("point", false), find("point", true));
    let text = format!(
        "Identifiable generalized errors of the frames: {pose} from poses (or three targets), \
         {point} from tool points alone; with an unknown base frame {pose_base} and {point_base}. \
         The others are linear combinations of these. Rank of the identification Jacobian over \
         {configurations} configurations with all joints moved.",
    );
    wrapped(&text, 0) + "\n"
}

fn laws(laws: &[Law]) -> String {
    let rows = laws.iter().map(|law| {
        let slope = law.expected != 0.0;
        let value = match law.value {
            Some(0.0) => "0".to_owned(),
            Some(value) if slope => format!("{value:.4}"),
            Some(value) => format!("{value:.1e}"),
            None => String::new(),
        };
        let bound = if slope {
            format!("{} ± {}", law.expected, law.tolerance)
        } else {
            format!("at most {:.0e}", law.tolerance)
        };
        let verdict = if law.holds { "holds" } else { "FAILS" };
        [law.law.to_owned(), value, bound, verdict.to_owned()]
    });
    let mut text = table(&["law", "found", "expected", ""], rows);
    for failure in laws.iter().filter_map(|law| law.failure.as_ref()) {
        text += &format!("{}\n", wrapped(failure, 0));
    }
    text
}
