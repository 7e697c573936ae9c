//! Conventions, values and input files of an analysis.

use abbe::{Orientation, VariableKind};

use super::escaped;
use super::provenance::sections;
use super::table;
use abbe_study::analyze::Report;
use abbe_study::number::{self, quantity};

/// Formats the conventions.
pub(super) fn conventions(report: &Report) -> String {
    let spec = &report.spec;
    let unit = spec.length.symbol();
    let rows = match spec.orientation {
        Orientation::RotationVector => "the small rotation in F<sub>0</sub> axes, rad",
        Orientation::EulerYzx => {
            "spin σ, roll ρ, pitch π of R<sub>T</sub> = R<sub>y</sub>(σ) R<sub>z</sub>(ρ) R<sub>x</sub>(π), rad"
        }
        Orientation::Iec61217 => {
            "yaw ψ, pitch θ, roll φ of R<sub>T</sub> = R<sub>z</sub>(ψ) R<sub>x</sub>(θ) R<sub>y</sub>(φ), rad"
        }
    };
    let last = spec.frames.len();
    let facts = [
        ("Chain", "A<sub>T</sub> = A<sub>1</sub> A<sub>2</sub> … A<sub>n</sub> T, real: A<sub>1</sub> E<sub>1</sub> … A<sub>n</sub> E<sub>n</sub> T. A<sub>i</sub> takes F<sub>i</sub> coordinates to F<sub>i−1</sub>; the tool T comes after E<sub>n</sub>".to_owned()),
        ("Errors of a frame", "e<sub>x</sub> e<sub>y</sub> e<sub>z</sub> e<sub>s</sub> e<sub>r</sub> e<sub>p</sub>, in this order: translations along x, y, z; then <b>spin about Y, roll about Z, pitch about X</b>, R = R<sub>y</sub>(e<sub>s</sub>) R<sub>z</sub>(e<sub>r</sub>) R<sub>x</sub>(e<sub>p</sub>)".to_owned()),
        ("ΔX", "real minus ideal, ΔX ≈ J<sub>e</sub> ε".to_owned()),
        ("Columns of J<sub>e</sub>", format!("{}: six per frame, frame 1 first, e_x1 … e_p{last}", 6 * last)),
        ("Rows 1–3", format!("the tool point in F<sub>0</sub>, {unit}")),
        ("Rows 4–6", rows.to_owned()),
        ("Units", format!("{unit}, rad, kg, s, K; in figures errors in mm or mrad, and joints in degrees")),
        ("Sources", "repeatable: summed with sign. Random: root sum of squares of bounds (normal: 3σ, all others: the value)".to_owned()),
    ];
    table::facts("Meaning of the numbers", facts)
}

/// Formats the frames, parameters and inputs of the analysis.
pub(super) fn values(report: &Report) -> String {
    let spec = &report.spec;
    let unit = spec.length;
    let frames = spec.frames.iter().enumerate().map(|(i, frame)| {
        let variable = frame.variable.map(|variable| {
            let variable = &spec.variables[variable];
            let show = |value| number::of_variable(value, variable.kind, unit);
            let kind = match variable.kind {
                VariableKind::Revolute => "revolute",
                VariableKind::Prismatic => "prismatic",
            };
            let [lower, upper] = variable.limits.map(show);
            format!("{} {kind}, {lower} … {upper}, home {}", variable.name, show(variable.home))
        });
        let variable = variable.unwrap_or_else(|| "fixed".to_owned());
        (format!("F<sub>{}</sub> {}", i + 1, escaped(&frame.name)), escaped(&variable))
    });
    let parameters = spec.parameters.iter().map(|p| (p.name.as_str(), quantity(p.value, &p.unit)));
    let list = |values: Vec<(&str, String)>| {
        let values = values.into_iter().map(|(name, value)| format!("{name} = {value}"));
        values.collect::<Vec<_>>().join(", ")
    };
    let off = spec.sources.iter().filter(|source| !source.enabled).map(|source| source.name.as_str());
    let others = [
        ("Parameters", list(parameters.collect())),
        ("Inputs", report.inputs().join(", ")),
        ("Disabled sources", off.collect::<Vec<_>>().join(", ")),
    ];
    let others = others.map(|(name, values)| (name.to_owned(), escaped(&values)));
    table::facts("Frames, parameters and inputs", frames.chain(others))
}

/// Formats the record, and the names and SHA-256 of the input files.
pub(super) fn inputs(report: &Report) -> String {
    let spec = Some(("spec", &report.spec.file, &report.spec.hash));
    let study = report.study.file.as_ref().map(|(name, hash)| ("study", name, hash));
    sections(&report.record, false, spec.into_iter().chain(study))
}
