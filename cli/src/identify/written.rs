//! The identified machine as a spec: the nominal one, comments and all, with the errors found as repeatable sources.

use std::io::Write;
use std::path::Path;

use abbe::identify::Unknown;
use abbe_codegen::document::{Document, Section};
use abbe_codegen::spec::Spec;

use super::setup::Setup;
use super::solved::Solved;
use super::terms::{Source, number, weight};
use crate::data::Data;
use crate::failure::Failure;
use crate::output::{Pending, cannot_write};
use abbe_study::number::digits;

/// Writes the spec; what was added to it comes back, line by line.
pub(super) fn write(
    file: &Path,
    nominal: &Spec,
    text: &str,
    setup: &Setup,
    solved: &Solved,
    candidates: &[Source],
    data: &Data,
) -> Result<String, Failure> {
    let base = free_name(nominal, "measured from");
    let frame = format!(
        "# Where the machine stands, as the instrument sees it: no error of the machine itself.\n[[frame]]\nname = {base:?}\n\
         origin = {{ xyz = [0, 0, 0] }}\n\n"
    );
    let sources = sources(nominal, &base, setup, solved, candidates, data);
    let at = before_frames(text);
    let mut new = format!("{}{frame}{}\n{sources}", &text[..at], text[at..].trim_end());
    let mut added = format!("{frame}{}", sources.trim_start());
    if solved.magnitudes.iter().any(|i| candidates[*i].key == "compliance") {
        let [load, gravity] = weight(nominal);
        new = format!("{gravity}{}\n{load}", new.trim_end());
        added = format!("{gravity}{added}{load}");
    }
    // What was written is a spec, or it is not written.
    Spec::parse(&file.display().to_string(), &new)?;
    let mut pending = Pending::create(file)?;
    pending.write_all(new.as_bytes()).map_err(|error| cannot_write(file, &error))?;
    pending.finish()?;
    let lines = added.trim_end().lines().map(|line| format!("+ {line}").trim_end().to_owned() + "\n");
    Ok(format!(
        "Written to {}: the nominal spec and these lines\n{}",
        file.display(),
        lines.collect::<String>()
    ))
}

/// Where the first frame begins, the comments above it included.
fn before_frames(text: &str) -> usize {
    let mut document = Document::new("", text);
    let tables = document.tables(text);
    let first = tables.as_ref().and_then(|tables| {
        let item = Section::root(tables).get("frame")?;
        let items = document.array(&item, "frames")?;
        items.first().map(|item| item.span().start.min(item.key_span.start))
    });
    let mut at = first.map_or(text.len(), |at| text[..at].rfind('\n').map_or(0, |newline| newline + 1));
    while at > 0 {
        let line = text[..at - 1].rfind('\n').map_or(0, |newline| newline + 1);
        if !text[line..at].starts_with('#') {
            break;
        }
        at = line;
    }
    at
}

fn free_name(spec: &Spec, name: &str) -> String {
    let taken = |name: &str| spec.frames.iter().any(|frame| frame.name == name);
    let names = std::iter::once(name.to_owned()).chain((2..).map(|i| format!("{name} {i}")));
    names.into_iter().find(|name| !taken(name)).unwrap_or_default()
}

fn sources(
    spec: &Spec,
    base: &str,
    setup: &Setup,
    solved: &Solved,
    candidates: &[Source],
    data: &Data,
) -> String {
    let Solved { model, fit, .. } = solved;
    let deviations = fit.standard_deviations();
    let unit = spec.length.symbol();
    let file = Path::new(&data.file).file_name().unwrap_or_default().to_string_lossy().into_owned();
    let reference = format!(
        "Identified from {} rows of {file} by abbe {}: rms {} {unit} left, {} {unit} on rows left out in turn",
        data.observations.len(),
        env!("CARGO_PKG_VERSION"),
        digits((fit.cost / (fit.numbers as f64 / 3.0)).sqrt() * model.uncertainty.length, 4),
        digits(solved.crossed.rms, 4),
    );
    let mut text = String::new();
    let names = std::iter::once(base).chain(setup.description.frames.iter().map(|frame| &*frame.name));
    for (i, frame) in names.enumerate() {
        let of = |k: &&usize| match model.unknowns[**k] {
            Unknown::Base(_) => i == 0,
            Unknown::Error(frame, _) => i == frame + 1,
            _ => false,
        };
        let kept: Vec<usize> = fit.known.kept.iter().filter(of).copied().collect();
        if kept.is_empty() {
            continue;
        }
        let component = |k: &usize| match model.unknowns[*k] {
            Unknown::Base(component) | Unknown::Error(_, component) => Some(component),
            _ => None,
        };
        let own = kept.iter().filter_map(|k| Some((*k, component(k)?)));
        let (mut lines, mut known) = (String::new(), Vec::new());
        for (k, component) in own {
            let (value, name) = (number(fit.x[k]), component.name());
            let unit = if component.is_rotation() { "rad" } else { unit };
            lines += &format!("{name} = \"{value} {unit}\"\n");
            known.push(format!("{name} {} {unit}", digits(deviations[k].unwrap_or_default(), 2)));
        }
        text += &format!(
            "\n[[source]]\nname = {:?}\ndescription = {:?}\nclass = \"repeatable\"\nframe = {frame:?}\n{lines}reference = {reference:?}\n",
            source_name(spec, &format!("identified: {frame}")),
            format!("Standard deviations: {}", known.join(", ")),
        );
    }
    for (k, i) in solved.magnitudes.iter().enumerate() {
        let candidate = &candidates[*i];
        let k = model.unknowns.len() - solved.magnitudes.len() + k;
        if deviations[k].is_none() {
            continue;
        }
        text += &format!(
            "\n[[source]]\nname = {:?}\ndescription = {:?}\nclass = \"repeatable\"\nreference = {reference:?}\n\n[[source.effect]]\nframe = {:?}\n{}\n",
            source_name(spec, &format!("identified: {}", candidate.name)),
            format!(
                "Standard deviation: {} of it",
                digits((deviations[k].unwrap_or_default() / fit.x[k]).abs(), 2)
            ),
            candidate.frame,
            candidate.effect(Some(fit.x[k])),
        );
    }
    text
}

/// A name that no source has.
fn source_name(spec: &Spec, name: &str) -> String {
    let taken = |name: &str| spec.sources.iter().any(|source| source.name == name);
    let names = std::iter::once(name.to_owned()).chain((2..).map(|i| format!("{name} ({i})")));
    names.into_iter().find(|name| !taken(name)).unwrap_or_default()
}
