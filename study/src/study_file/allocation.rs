//! Reads `[allocation]`: costs of the factors of the sources.

use abbe_spec::Spec;
use abbe_spec::document::Item;
use abbe_spec::expr::Dimension;
use abbe_spec::value::find_name;

use super::keys;
use crate::workspace::positive;

/// Reads the costs: the index of a source, the cost c of its factor 1, infinite if it is fixed, and
/// the exponent p. The factor x costs `c x^(−p)`.
pub(super) fn read(item: &Item<'_>, spec: &Spec) -> Vec<(usize, [f64; 2])> {
    let names = spec.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>();
    let items = item.section().into_iter().flat_map(|section| section.items().collect::<Vec<_>>());
    let cost = |item: Item<'_>| {
        let source = find_name(item.document, item.key_span.clone(), &item.key, &names, "source")?;
        let table = item.table(format!("\"{}\"", item.key), &[&keys::ALLOCATION])?;
        let [cost, exponent] = ["cost", "exponent"]
            .map(|key| table.get(key).map_or(Some(1.0), |item| positive(&item, Dimension::NONE)));
        let is_fixed = table.get("fixed").map_or(Some(false), |item| item.boolean())?;
        Some((source, [if is_fixed { f64::INFINITY } else { cost? }, exponent?]))
    };
    items.filter_map(cost).collect()
}
