//! `documentation/index.html`: what is in it, for people.

use abbe_spec::Spec;

use super::fmi::Fmi;
use super::variables::{CORRECTION, Variables};
use super::xml::escaped;

/// The page.
pub(super) fn page(spec: &Spec, fmi: Fmi, variables: &Variables) -> String {
    let title = escaped(&spec.title);
    let texts = [spec.description.as_str(), spec.reference.as_str()];
    let texts = texts.into_iter().filter(|text| !text.is_empty());
    let texts: String = texts.map(|text| format!("<p>{}</p>\n", escaped(text))).collect();
    let row = |name: &str, unit: &str, what: &str| {
        let cells = [name, unit, what].map(|cell| format!("<td>{}</td>", escaped(cell)));
        format!("<tr>{}</tr>\n", cells.concat())
    };
    let mut rows: String = variables
        .list
        .iter()
        .map(|variable| {
            let unit = variable.unit.as_ref().map_or("", |unit| &unit.name);
            row(&variable.name, unit, &variable.description)
        })
        .collect();
    if variables.corrected {
        rows.push_str(&row(CORRECTION.0, "", CORRECTION.1));
    }
    let (version, name) = (env!("CARGO_PKG_VERSION"), &spec.name);
    let source = fmi.source().0;
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{title}</title></head>\n<body>\n\
         <h1>{title}</h1>\n{texts}\
         <p>Written by abbe {version} from {file} (SHA-256 {hash}). Inputs are the joint variables q and the inputs u; \
         parameters are the structural parameters s and what each repeatable source is multiplied by. Outputs are what they \
         give at that moment: there are no states. In co-simulation inputs are held during a step.</p>\n\
         <p>It is compiled from sources/{name}.c and sources/{source} in C99, with the library of math.h.</p>\n\
         <table>\n<tr><th>variable</th><th>unit</th><th>what it is</th></tr>\n{rows}</table>\n</body>\n</html>\n",
        file = escaped(&spec.file),
        hash = spec.hash,
    )
}
