//! The files of an analysis: every figure, and the page that holds them all.

use abbe_codegen::diagnostic::Diagnostics;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Figures;
use abbe_study::mistake;

use super::figure::Named;
use super::html;
use super::svg;

/// The page that holds everything.
pub const PAGE: &str = "report.html";

/// A file of a report.
#[derive(Clone, Debug)]
pub struct File {
    /// Its name, without a folder.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// The figures of an analysis as SVG, and `report.html`, which shows them and says everything else.
///
/// Only what was gathered is drawn: a report without figures is a page without pictures.
pub fn analysis(report: &Report) -> Result<Vec<File>, Diagnostics> {
    let none = Figures::default();
    let Figures { figures, left_out } = report.figures.as_ref().unwrap_or(&none);
    let figures = Named::all(figures, report);
    let draw = |figure: &Named| {
        svg::draw(figure, report)
            .map_err(|error| mistake::with_help(&figure.name, error, "leave this figure out of the study"))
    };
    let drawings = figures.iter().map(draw).collect::<Result<Vec<_>, _>>()?;
    let page = html::page(&figures, &drawings, left_out, report);
    let names = figures.iter().map(|figure| format!("{}.svg", figure.name));
    let mut files = names.zip(drawings).map(|(name, text)| File { name, text }).collect::<Vec<_>>();
    files.push(File { name: PAGE.to_owned(), text: page });
    Ok(files)
}
