//! Conventions and values of an analysis, for its page.

use abbe::Orientation;
use abbe_study::analyze::Report;
use abbe_study::number::{self, quantity};

use crate::document::Section;

/// Formats the conventions.
pub(super) fn conventions(report: &Report) -> Section {
    let spec = &report.spec;
    let unit = spec.length.symbol();
    let rows = match spec.orientation {
        Orientation::RotationVector => "the small rotation in F_0 axes, rad",
        Orientation::EulerYzx => "spin σ, roll ρ, pitch π of R_T = R_y(σ) R_z(ρ) R_x(π), rad",
        Orientation::Iec61217 => "yaw ψ, pitch θ, roll φ of R_T = R_z(ψ) R_x(θ) R_y(φ), rad",
    };
    let last = spec.frames.len();
    let facts = [
        ("Chain", "A_T = A_1 A_2 … A_n T, real: A_1 E_1 … A_n E_n T. A_i takes F_i coordinates to F_i−1; the tool T comes after E_n".to_owned()),
        ("Errors of a frame", "e_x e_y e_z e_s e_r e_p, in this order: translations along x, y, z; then spin about Y, roll about Z, pitch about X, R = R_y(e_s) R_z(e_r) R_x(e_p)".to_owned()),
        ("ΔX", "real minus ideal, ΔX ≈ J_e ε".to_owned()),
        ("Columns of J_e", format!("{}: six per frame, frame 1 first, e_x1 … e_p{last}", 6 * last)),
        ("Rows 1–3", format!("the tool point in F_0, {unit}")),
        ("Rows 4–6", rows.to_owned()),
        ("Units", format!("{unit}, rad, kg, s, K; in figures errors in mm or mrad, and joints in degrees")),
        ("Sources", "repeatable: summed with sign. Tolerances and random ones at their bounds (normal: 3σ, all others: the value), with the signs that make the worst case, or as a root sum of squares".to_owned()),
    ];
    Section::page("Conventions").facts(facts.into())
}

/// Formats the frames, parameters and inputs of the analysis.
pub(super) fn values(report: &Report) -> Section {
    let spec = &report.spec;
    let unit = spec.length;
    let frames = spec.frames.iter().enumerate().map(|(i, frame)| {
        let variable = frame.variable.map(|variable| {
            let variable = &spec.variables[variable];
            let show = |value| number::of_variable(value, variable.kind, unit);
            let kind = variable.kind.either("revolute", "prismatic");
            let [lower, upper] = variable.limits.map(show);
            format!("{} {kind}, {lower} … {upper}, home {}", variable.name, show(variable.home))
        });
        let variable = variable.unwrap_or_else(|| "fixed".to_owned());
        ("", format!("F_{} {}: {variable}", i + 1, frame.name))
    });
    let parameters = spec.parameters.iter().map(|p| (p.name.as_str(), quantity(p.value, &p.unit)));
    let list = |values: Vec<(&str, String)>| {
        values.into_iter().map(|(name, value)| format!("{name} = {value}")).collect::<Vec<_>>().join(", ")
    };
    let off = spec.sources.iter().filter(|source| !source.enabled).map(|source| source.name.as_str());
    let others = [
        ("Parameters", list(parameters.collect())),
        ("Inputs", report.inputs().join(", ")),
        ("Disabled sources", off.collect::<Vec<_>>().join(", ")),
    ];
    let others = others.into_iter().filter(|(_, values)| !values.is_empty());
    let mut facts: Vec<(&str, String)> = frames.chain(others).collect();
    if let Some((name, _)) = facts.first_mut().filter(|(name, _)| name.is_empty()) {
        *name = "Frames";
    }
    Section::page("Values").facts(facts)
}
