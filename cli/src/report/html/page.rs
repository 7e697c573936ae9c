//! The whole page.

use abbe::{Orientation, VariableKind};
use plotly::Plot;

use super::{escaped, ledger, plots};
use crate::number::{self, percent, quantity, trimmed};
use crate::report::figure::Figure;
use crate::report::subject::Subject;

const STYLE: &str = include_str!("style.css");

/// The report, with its figures in their order; `left_out` are sources that are switched off and had one.
pub(in crate::report) fn page(figures: &[Figure], left_out: &[&str], subject: &Subject) -> String {
    let title = escaped(subject.description.title);
    let parts = [
        heading(subject),
        summary(subject),
        section("Every source alone", &format!("{METRICS}\n{}", ledger::sources(subject))),
        section("All together", &(ledger::combined(subject) + &conclusions(subject))),
        drawn(figures, left_out, subject),
        section("Conventions", &conventions(subject)),
        section("Values", &values(subject)),
        notes(subject),
        section("Input files", &inputs(subject)),
    ];
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}: error analysis</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n{}\n\
         </head>\n<body>\n<main>\n{}</main>\n</body>\n</html>\n",
        script(),
        parts.concat()
    )
}

const METRICS: &str = "<p>Largest errors of the tool point over the workspace, along the axes of F<sub>0</sub>. \
    <i>Plain maximum</i>: the largest |ΔX|. <i>Half peak-to-peak</i>: half of what it varies by. \
    <i>Relative to home</i>: the largest difference from the error at home. Of a random source the bound, plus or \
    minus. Sources in order of their largest norm.</p>";

/// The script that draws the figures: the first of two, the second sets formulas, of which there are none.
fn script() -> String {
    let scripts = Plot::offline_js_sources();
    let end = "</script>";
    scripts.find(end).map_or_else(String::new, |at| scripts[..at + end.len()].to_owned())
}

fn section(title: &str, body: &str) -> String {
    format!("<section>\n<h2>{title}</h2>\n{body}</section>\n")
}

fn heading(subject: &Subject) -> String {
    let description = subject.spec.description.trim();
    let text = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    format!(
        "<header>\n<p class=\"kind\">Error analysis</p>\n<h1>{}</h1>\n<p class=\"study\">{}</p>\n<p>{}</p>\n</header>\n",
        escaped(subject.description.title),
        escaped(&subject.study.title),
        escaped(&text(description)),
    )
}

/// The few figures that matter most.
fn summary(subject: &Subject) -> String {
    let unit = subject.description.length.symbol();
    let combined = &subject.budget.combined;
    let decimals = subject.decimals.min(4);
    let show = |value| format!("{} {unit}", trimmed(value, decimals));
    let of = |value| {
        subject.study.tolerance.map(|tolerance| format!("{} of the tolerance", percent(value, tolerance)))
    };
    let mut cards = vec![
        ("Radius of all errors".to_owned(), show(combined.radius.value), of(combined.radius.value)),
        (
            "Random errors alone".to_owned(),
            format!("± {}", show(combined.random_radius.value)),
            of(combined.random_radius.value),
        ),
    ];
    if let Some(compensated) = &subject.study.compensated {
        let total = compensated.residual + combined.random_radius.value;
        cards.push(("After compensation".to_owned(), format!("± {}", show(total)), of(total)));
    }
    if let Some(tolerance) = subject.study.tolerance {
        cards.push(("Tolerance".to_owned(), format!("± {}", show(tolerance)), None));
    }
    let (unreached, reasons) = &subject.unreachable;
    let unreached = if *unreached == 0 {
        "all reached".to_owned()
    } else {
        format!("{unreached} unreachable: {reasons}")
    };
    cards.push(("Configurations".to_owned(), subject.configurations.to_string(), Some(unreached)));
    let cards = cards.into_iter().map(|(name, value, note)| {
        let note = escaped(&note.unwrap_or_default());
        format!("<div class=\"card\"><span>{name}</span><b>{value}</b><small>{note}</small></div>\n")
    });
    let region = escaped(subject.region);
    format!(
        "<div class=\"cards\">\n{}</div>\n<p><b>Workspace.</b> {region}.</p>\n",
        cards.collect::<String>()
    )
}

/// What compensation leaves, and what first order neglects.
fn conclusions(subject: &Subject) -> String {
    let unit = subject.description.length.symbol();
    let show = |value| format!("{} {unit}", trimmed(value, subject.decimals));
    let combined = &subject.budget.combined;
    let mut text = String::new();
    if let Some(radius) = combined.radius.configuration.filter(|_| combined.radius.value > 0.0) {
        text += &format!("<p>The radius is reached at configuration {radius} of configurations.csv.</p>\n");
    }
    if let Some(compensated) = &subject.study.compensated {
        let random = combined.random_radius.value;
        text += &format!(
            "<p>After compensation: {} repeatable residual + {} random = {}; {} prints {} + {} = {} ({}).</p>\n",
            show(compensated.residual),
            show(random),
            show(compensated.residual + random),
            escaped(subject.publisher()),
            number::short(compensated.residual),
            number::short(compensated.random),
            show(compensated.total),
            escaped(&compensated.reference),
        );
    }
    let (difference, checked) = subject.first_order;
    if combined.repeatable_radius.value > 0.0 {
        text += &format!(
            "<p>First order: J<sub>e</sub> ε of the repeatable sources differs from the exact chain by at most {}, \
             at {checked} configurations.</p>\n",
            show(difference)
        );
    }
    text
}

fn drawn(figures: &[Figure], left_out: &[&str], subject: &Subject) -> String {
    let mut text = String::new();
    for (i, figure) in figures.iter().enumerate() {
        let plots::Plots { plots, height, note } = plots::of(figure, subject);
        let columns = plots.len();
        let panels = plots.iter().enumerate().map(|(j, plot)| {
            let id = format!("figure-{}-{}", i + 1, j + 1);
            format!(
                "<div class=\"plot\" style=\"height:{height}px\">{}</div>\n",
                plot.to_inline_html(Some(&id))
            )
        });
        let panels = panels.collect::<String>();
        let paper = &figure.asked.paper;
        let paper = if paper.is_empty() {
            String::new()
        } else {
            format!(
                " <span class=\"paper\">cf. {} of {}</span>",
                escaped(paper),
                escaped(subject.publisher())
            )
        };
        let words = [&figure.asked.caption, &note].map(|words| escaped(words)).join(" ");
        text += &format!(
            "<figure>\n<h3>{}. {}{paper}</h3>\n<div class=\"plots of-{columns}\">\n{panels}</div>\n\
             <figcaption>{} <a href=\"{file}\">{file}</a></figcaption>\n</figure>\n",
            i + 1,
            escaped(&figure.title),
            words.trim(),
            file = format_args!("{}.svg", figure.name),
        );
    }
    for source in left_out {
        text += &format!("<p>Not drawn: the source “{}” is switched off.</p>\n", escaped(source));
    }
    section(
        "Figures",
        &format!(
            "<p>Drag to turn or to zoom, point at a curve or a dot to see its configuration, double-click to go back. Errors are in mm.</p>\n{text}"
        ),
    )
}

fn conventions(subject: &Subject) -> String {
    let description = &subject.description;
    let unit = description.length.symbol();
    let rows = match description.orientation {
        Orientation::RotationVector => "the small rotation in F<sub>0</sub> axes, rad",
        Orientation::EulerYzx => {
            "spin σ, roll ρ, pitch π of R<sub>T</sub> = R<sub>y</sub>(σ) R<sub>z</sub>(ρ) R<sub>x</sub>(π), rad"
        }
    };
    let last = description.frames.len();
    let facts = [
        ("Chain", "A<sub>T</sub> = A<sub>1</sub> A<sub>2</sub> … A<sub>n</sub> T, real: A<sub>1</sub> E<sub>1</sub> … A<sub>n</sub> E<sub>n</sub> T. A<sub>i</sub> takes F<sub>i</sub> coordinates to F<sub>i−1</sub>; the tool T comes after E<sub>n</sub>".to_owned()),
        ("Errors of a frame", "e<sub>x</sub> e<sub>y</sub> e<sub>z</sub> e<sub>s</sub> e<sub>r</sub> e<sub>p</sub>, in this order: translations along x, y, z; then <b>spin about Y, roll about Z, pitch about X</b>, R = R<sub>y</sub>(e<sub>s</sub>) R<sub>z</sub>(e<sub>r</sub>) R<sub>x</sub>(e<sub>p</sub>)".to_owned()),
        ("ΔX", "real minus ideal, ΔX ≈ J<sub>e</sub> ε".to_owned()),
        ("Columns of J<sub>e</sub>", format!("{}: six per frame, frame 1 first, e_x1 … e_p{last}", 6 * last)),
        ("Rows 1–3", format!("the tool point in F<sub>0</sub>, {unit}")),
        ("Rows 4–6", rows.to_owned()),
        ("Units", format!("{unit}, rad, kg, s, K; in figures errors in mm and angles in degrees")),
        ("Sources", "repeatable: summed with sign. Random: root sum of squares of bounds (uniform: half-width, normal: 3σ)".to_owned()),
    ];
    let rows = facts.map(|(name, fact)| format!("<tr><th>{name}</th><td>{fact}</td></tr>\n")).concat();
    format!("<table class=\"facts\"><tbody>{rows}</tbody></table>\n")
}

/// The frames, parameters and inputs as they were in this analysis.
fn values(subject: &Subject) -> String {
    let description = &subject.description;
    let unit = description.length;
    let frames = description.frames.iter().enumerate().map(|(i, frame)| {
        let variable = frame.variable.map(|variable| {
            let variable = &description.variables[variable];
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
            escaped(frame.name),
            escaped(&variable)
        )
    });
    let parameters = description
        .parameters
        .iter()
        .map(|parameter| (parameter.name, quantity(parameter.nominal, parameter.unit)));
    let inputs = description.inputs.iter().map(|input| (input.name, quantity(input.nominal, input.unit)));
    let list = |values: Vec<(&str, String)>| {
        let values = values.into_iter().map(|(name, value)| format!("{name} = {value}"));
        values.collect::<Vec<_>>().join(", ")
    };
    let mut rows = frames.collect::<String>();
    for (name, values) in [("Parameters", list(parameters.collect())), ("Inputs", list(inputs.collect()))] {
        if !values.is_empty() {
            rows += &format!("<tr><th>{name}</th><td>{}</td></tr>\n", escaped(&values));
        }
    }
    let off = subject.spec.sources.iter().filter(|source| !source.enabled).map(|source| source.name.as_str());
    let off = off.collect::<Vec<_>>().join(", ");
    if !off.is_empty() {
        rows += &format!("<tr><th>Sources switched off</th><td>{}</td></tr>\n", escaped(&off));
    }
    format!("<table class=\"facts\"><tbody>{rows}</tbody></table>\n")
}

fn notes(subject: &Subject) -> String {
    let notes = &subject.study.not_reproducible;
    if notes.is_empty() {
        return String::new();
    }
    let items = notes.iter().map(|note| format!("<li>{}</li>\n", escaped(note)));
    let title = format!("Not reproducible from {}", escaped(subject.publisher()));
    section(&title, &format!("<ul>\n{}</ul>\n", items.collect::<String>()))
}

fn inputs(subject: &Subject) -> String {
    let spec = (subject.spec.file.clone(), subject.spec.hash.clone());
    let files = [("spec", Some(&spec)), ("study", subject.study.file.as_ref())];
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
