//! Index of live pages.

use abbe_study::explore::Report;

use super::table::{ledger, row_header};
use super::{document, escaped, heading};

/// Builds the page that links to the pages of several machines, `NAME.html` in the same folder.
pub(crate) fn index(reports: &[Report]) -> String {
    let row = |report: &Report| {
        let name = escaped(&report.name);
        let joints = report.variables.len();
        let sources = report.sources.iter().filter(|source| source.enabled).count();
        format!(
            "<tr>{}<td class=\"words\">{}</td><td>{joints}</td><td>{sources}</td></tr>\n",
            row_header(&format!("<a href=\"{name}.html\">{name}</a>")),
            escaped(&report.title),
        )
    };
    let rows = reports.iter().map(row).collect::<String>();
    let columns = ["name", "machine", "joints", "error sources"];
    let table = ledger("One page for each machine", &columns, &[0, 1], &format!("<tbody>{rows}</tbody>\n"));
    let heading = heading("Live pages", &format!("{} machines", reports.len()), "");
    document("Live pages", &[heading, table].concat(), None)
}
