//! The files of an analysis: every figure, and the page that holds them all.

use abbe_study::analyze::Report;
use abbe_study::analyze::figures::Figures;

use crate::figures::{self, Named};
use crate::scene::Scene;
use crate::{html, svg};

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
    /// The figure as plain data.
    pub scene: Scene,
    /// The figure as SVG.
    pub svg: String,
}

/// Returns the figures of an analysis, in the order of its page.
///
/// Only what was gathered is drawn: a report without figures has none.
pub fn figures(report: &Report) -> Vec<Picture> {
    let picture =
        |(named, scene): (Named, Scene)| Picture { name: named.name, svg: svg::file(&scene), scene };
    scenes(report).into_iter().map(picture).collect()
}

fn scenes(report: &Report) -> Vec<(Named<'_>, Scene)> {
    let gathered = report.figures.as_ref().map_or(&[][..], |figures| &figures.figures);
    let named = Named::all(gathered, report);
    let scenes = named.iter().map(|named| figures::scene(named, report)).collect::<Vec<_>>();
    named.into_iter().zip(scenes).collect()
}

/// Returns the figures of an analysis as SVG, and `report.html`, which shows them and says everything else.
///
/// Only what was gathered is drawn: a report without figures is a page without pictures.
pub fn analysis(report: &Report) -> Vec<File> {
    let none = Figures::default();
    let Figures { left_out, .. } = report.figures.as_ref().unwrap_or(&none);
    let scenes = scenes(report);
    let page = html::page(&scenes, figures::sampled(report).as_ref(), left_out, report);
    let file = |(named, scene): &(Named, Scene)| File {
        name: format!("{}.svg", named.name),
        text: svg::file(scene),
    };
    let mut files = scenes.iter().map(file).collect::<Vec<_>>();
    files.push(File { name: PAGE.to_owned(), text: page });
    files
}
