//! The files of an analysis: every figure, and the page that holds them all.

use abbe_spec::diagnostic::Diagnostics;
use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Figures;
use abbe_study::mistake;
use plotly::Plot;

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

/// A figure of an analysis.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The name of its file, without the ending.
    pub name: String,
    /// What it is called.
    pub title: String,
    /// As SVG.
    pub svg: String,
    /// To rotate, to zoom and to point at: what Plotly draws, as JSON; several stand side by side.
    pub plots: Vec<String>,
}

/// The figures of an analysis, in the order of its page.
///
/// Only what was gathered is drawn: a report without figures has none.
pub fn figures(report: &Report) -> Result<Vec<Picture>, Diagnostics> {
    let gathered = report.figures.as_ref().map_or(&[][..], |figures| &figures.figures);
    let picture = |figure: Named| {
        let svg = drawn(&figure, report)?;
        let plots = html::interactive(&figure, report).iter().map(Plot::to_json).collect();
        Ok(Picture { name: figure.name, title: figure.title, svg, plots })
    };
    Named::all(gathered, report).into_iter().map(picture).collect()
}

fn drawn(figure: &Named, report: &Report) -> Result<String, Diagnostics> {
    svg::draw(figure, report)
        .map_err(|error| mistake::with_help(&figure.name, error, "leave this figure out of the study"))
}

/// The figures of an analysis as SVG, and `report.html`, which shows them and says everything else.
///
/// Only what was gathered is drawn: a report without figures is a page without pictures.
pub fn analysis(report: &Report) -> Result<Vec<File>, Diagnostics> {
    let none = Figures::default();
    let Figures { figures, left_out } = report.figures.as_ref().unwrap_or(&none);
    let figures = Named::all(figures, report);
    let drawings = figures.iter().map(|figure| drawn(figure, report)).collect::<Result<Vec<_>, _>>()?;
    let at_most = svg::at_most(report)
        .map_err(|error| mistake::with_help(PAGE, error, "ask for the analysis without a page"))?;
    let page = html::page(&figures, &drawings, at_most.as_deref(), left_out, report);
    let names = figures.iter().map(|figure| format!("{}.svg", figure.name));
    let mut files = names.zip(drawings).map(|(name, text)| File { name, text }).collect::<Vec<_>>();
    files.push(File { name: PAGE.to_owned(), text: page });
    Ok(files)
}
