//! Live page: the machine's generated JavaScript and the modules that show it, in one HTML file
//! that loads nothing.
//!
//! `modules` joins the modules in `page/` to one script, `scripts` writes scripts and data so that
//! no text of a spec ends them, and `policy` is the content security policy, which allows these
//! scripts alone. `panels` are the elements that the scripts fill: of a page of their own, which is
//! here, or of the page of an analysis.

mod modules;
mod panels;
mod policy;
mod scripts;

use abbe_study::explore::Report;

use crate::markup::escaped;
pub(crate) use panels::Panels;

/// Returns the live page of one machine, or of several side by side.
pub fn explore(reports: &[Report]) -> String {
    let titles: Vec<String> = reports.iter().map(|report| escaped(&report.title)).collect();
    let title = titles.join(" and ");
    let Panels { style, scripts, elements, policy } = Panels::new(reports, &[]);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{policy}\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<link rel=\"icon\" href=\"data:,\">\n{style}</head>\n<body>\n\
         <main class=\"abbe-explore\">\n<h1>{title}</h1>\n{elements}</main>\n{scripts}</body>\n</html>\n",
    )
}
