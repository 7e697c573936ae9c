//! Text of a spec with the changes of a machine.

use abbe_spec::Spec;
use abbe_spec::edit::{Edits, write};

use crate::number::exact_quantity;

/// Returns the text of a spec with the values of parameters and inputs, and the switches and scales
/// of the sources, of a changed one. Everything else stays as it is. `None` if the text has no
/// place for a change.
pub fn changed_text(text: &str, unchanged: &Spec, changed: &Spec) -> Option<String> {
    let values = |spec: &Spec| {
        let parameters =
            spec.parameters.iter().map(|p| ("parameters", p.name.clone(), p.value, p.unit.clone()));
        let inputs =
            spec.inputs.iter().map(|input| ("inputs", input.name.clone(), input.value, input.unit.clone()));
        parameters.chain(inputs).collect::<Vec<_>>()
    };
    Edits::apply(text, |root, edits| {
        let both = values(unchanged).into_iter().zip(values(changed));
        for (_, (table, name, value, unit)) in both.filter(|(old, new)| old.2 != new.2) {
            let item = root.get(table)?.as_table()?.get(&name)?;
            let span = item.as_table().map_or(Some(item.span()), |table| Some(table.get("value")?.span()))?;
            let text = exact_quantity(value, &unit);
            edits.replace(span, if unit.is_empty() { text } else { write::quoted(&text) });
        }
        let sources = unchanged.sources.iter().zip(&changed.sources).enumerate();
        for (i, (old, new)) in sources.filter(|(i, _)| unchanged.whole(*i) == *i) {
            let changes = [
                (old.enabled != new.enabled, "enabled", new.enabled.to_string()),
                (old.scale != new.scale, "scale", new.scale.to_string()),
            ];
            for (_, key, value) in changes.into_iter().filter(|(is_changed, ..)| *is_changed) {
                edits.set(root.get("source")?.list().get(i)?, key, value);
            }
        }
        Some(())
    })
}
