//! Text of a spec with the changes of a machine.

use abbe_spec::Spec;
use abbe_spec::diagnostic::Span;
use abbe_spec::document::{Document, Section};
use abbe_spec::literal::quoted;

use crate::number::exact_quantity;

/// Returns the text of a spec with the values of parameters and inputs, and the enabled sources, of
/// a changed one. Everything else stays as it is. `None` if the text has no place for a change,
/// such as the scale of a source.
pub fn changed_text(text: &str, unchanged: &Spec, changed: &Spec) -> Option<String> {
    let mut document = Document::new("spec", text);
    let table = document.tables(text)?;
    let root = Section::root(&table);
    let mut edits: Vec<(Span, String)> = Vec::new();
    for (old, new) in unchanged.parameters.iter().zip(&changed.parameters) {
        if old.value != new.value {
            let span = value(&root, "parameters", &old.name, &mut document)?;
            edits.push((span, quantity(new.value, &new.unit)));
        }
    }
    for (old, new) in unchanged.inputs.iter().zip(&changed.inputs) {
        if old.value != new.value {
            let span = value(&root, "inputs", &old.name, &mut document)?;
            edits.push((span, quantity(new.value, &new.unit)));
        }
    }
    let scales = |spec: &Spec| spec.sources.iter().map(|source| source.scale).collect::<Vec<_>>();
    if scales(unchanged) != scales(changed) {
        return None;
    }
    for (i, (old, new)) in unchanged.sources.iter().zip(&changed.sources).enumerate() {
        if old.enabled != new.enabled {
            let sources = document.array_of_tables(&root.get("source")?, "source")?;
            let source = document.section(sources.get(i)?)?;
            edits.push(match source.get("enabled") {
                Some(item) => (item.span(), new.enabled.to_string()),
                None => {
                    let end = source.get("name")?.span().end;
                    (end..end, format!("\nenabled = {}", new.enabled))
                }
            });
        }
    }
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut text = text.to_owned();
    edits.into_iter().for_each(|(span, new)| text.replace_range(span, &new));
    Some(text)
}

/// Returns the place of the value of a parameter or input.
fn value(root: &Section<'_>, table: &str, name: &str, document: &mut Document) -> Option<Span> {
    let item = document.section(&root.get(table)?)?.get(name)?;
    match item.is_table() {
        true => Some(document.section(&item)?.get("value")?.span()),
        false => Some(item.span()),
    }
}

/// Formats a value in its coherent unit as the spec reads it.
fn quantity(value: f64, unit: &str) -> String {
    let text = exact_quantity(value, unit);
    if unit.is_empty() { text } else { quoted(&text) }
}
