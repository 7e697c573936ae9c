//! Pages of several machines, with an index.

use abbe_study::{analyze, explore::Report};

use crate::{File, explore, html::index, pictures};

/// Name of the page that lists the others.
pub const INDEX: &str = "index.html";

/// Returns one live page for each machine, `NAME.html`, and `index.html`, which lists them with the
/// verdicts and pictures of their analyses.
pub fn gallery(machines: &[(Report, analyze::Report)]) -> Vec<File> {
    let page = |(live, _): &(Report, analyze::Report)| File {
        name: format!("{}.html", live.name),
        text: explore(std::slice::from_ref(live)),
    };
    let entries = machines.iter().map(|(live, analysis)| {
        let drawn = pictures::figures(analysis).into_iter().find(|picture| picture.name == "manipulator");
        (live, pictures::budget(analysis), drawn.map(|picture| picture.scene))
    });
    let index = File { name: INDEX.to_owned(), text: index(entries) };
    [index].into_iter().chain(machines.iter().map(page)).collect()
}
