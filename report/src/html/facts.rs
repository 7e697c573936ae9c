//! Conventions, values, files: what a reader needs to use the numbers.

use abbe::{Orientation, VariableKind};

use super::escaped;
use abbe_study::analyze::Report;
use abbe_study::number::{self, quantity};

/// What the numbers mean.
pub(super) fn conventions(report: &Report) -> String {
    let spec = &report.spec;
    let unit = spec.length.symbol();
    let rows = match spec.orientation {
        Orientation::RotationVector => "the small rotation in F<sub>0</sub> axes, rad",
        Orientation::EulerYzx => {
            "spin σ, roll ρ, pitch π of R<sub>T</sub> = R<sub>y</sub>(σ) R<sub>z</sub>(ρ) R<sub>x</sub>(π), rad"
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
    let rows = facts.map(|(name, fact)| format!("<tr><th>{name}</th><td>{fact}</td></tr>\n")).concat();
    format!("<table class=\"facts\"><tbody>{rows}</tbody></table>\n")
}

/// The frames, parameters and inputs as they were in this analysis.
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
        format!(
            "<tr><th>F<sub>{}</sub> {}</th><td>{}</td></tr>\n",
            i + 1,
            escaped(&frame.name),
            escaped(&variable)
        )
    });
    let parameters = spec.parameters.iter().map(|p| (p.name.as_str(), quantity(p.value, &p.unit)));
    let list = |values: Vec<(&str, String)>| {
        let values = values.into_iter().map(|(name, value)| format!("{name} = {value}"));
        values.collect::<Vec<_>>().join(", ")
    };
    let mut rows = frames.collect::<String>();
    for (name, values) in [("Parameters", list(parameters.collect())), ("Inputs", report.inputs().join(", "))]
    {
        if !values.is_empty() {
            rows += &format!("<tr><th>{name}</th><td>{}</td></tr>\n", escaped(&values));
        }
    }
    let off = spec.sources.iter().filter(|source| !source.enabled).map(|source| source.name.as_str());
    let off = off.collect::<Vec<_>>().join(", ");
    if !off.is_empty() {
        rows += &format!("<tr><th>Sources switched off</th><td>{}</td></tr>\n", escaped(&off));
    }
    format!("<table class=\"facts\"><tbody>{rows}</tbody></table>\n")
}

/// What was read, so that it can be found again.
pub(super) fn inputs(report: &Report) -> String {
    let spec = (report.spec.file.clone(), report.spec.hash.clone());
    let files = [("spec", Some(&spec)), ("study", report.study.file.as_ref())];
    let rows = files.into_iter().filter_map(|(kind, file)| {
        let (name, hash) = file?;
        Some(format!("<tr><th>{kind}</th><td>{}</td><td><code>{hash}</code></td></tr>\n", escaped(name)))
    });
    let rows = rows.collect::<String>();
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "<table class=\"facts\"><thead><tr><th></th><td>file</td><td>SHA-256</td></tr></thead><tbody>{rows}</tbody></table>\n\
         <p>Written by abbe {version}. Same files, same bytes.</p>\n"
    )
}
