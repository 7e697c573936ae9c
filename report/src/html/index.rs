//! Index of live pages.

use abbe_study::explore::Report;

use super::table::{ledger, row_header};
use super::{document, escaped, heading};
use crate::document::{Block, Document};
use crate::{scene::Scene, svg};

/// Builds the page that links to the pages of several machines, `NAME.html` in the same folder,
/// with the verdicts of their error budgets and their pictures.
pub(crate) fn index<'m>(machines: impl Iterator<Item = (&'m Report, Document, Option<Scene>)>) -> String {
    let row = |(live, budget, picture): (&Report, Document, Option<Scene>)| {
        let (name, joints) = (escaped(&live.name), live.variables.len());
        let sources = live.sources.iter().filter(|source| source.enabled).count();
        let largest =
            budget.sections.iter().flat_map(|section| &section.blocks).find_map(|block| match block {
                Block::Cards(numbers) => numbers.first().map(|card| format!("<b>{}</b>", card.value)),
                _ => None,
            });
        format!(
            "<tr>{}<td class=\"thumbnail picture\">{}</td><td class=\"words\">{}<br>{}</td>\
             <td>{}</td><td>{joints}</td><td>{sources}</td></tr>\n",
            row_header(&format!("<a href=\"{name}.html\">{name}</a>")),
            picture.map_or_else(String::new, |scene| svg::embedded(&scene)),
            escaped(&live.title),
            escaped(&budget.headline),
            largest.unwrap_or_default(),
        )
    };
    let rows = machines.map(row).collect::<Vec<_>>();
    let columns = ["name", "", "machine and verdict", "largest error", "joints", "error sources"];
    let body = format!("<tbody>{}</tbody>\n", rows.concat());
    let table = ledger("One page for each machine", &columns, &[0, 2], &body);
    let heading = heading("Live pages", &format!("{} machines", rows.len()), "");
    document("Live pages", &[heading, table].concat(), None)
}
