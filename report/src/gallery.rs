//! Pages of several machines, with an index.

use abbe_study::explore::Report;

use crate::{File, explore, html::index};

/// Name of the page that lists the others.
pub const INDEX: &str = "index.html";

/// Returns one live page for each machine, `NAME.html`, and `index.html`, which lists them.
pub fn gallery(reports: &[Report]) -> Vec<File> {
    let page = |report: &Report| File {
        name: format!("{}.html", report.name),
        text: explore(std::slice::from_ref(report)),
    };
    let index = File { name: INDEX.to_owned(), text: index(reports) };
    [index].into_iter().chain(reports.iter().map(page)).collect()
}
