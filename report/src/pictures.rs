//! Files of an analysis: its figures, and the page with all of them.

use abbe_study::{analyze::Report, analyze::figures::Figures, explore, study_file::Content};

use crate::document::Figure;
use crate::figures::{self, NamedFigure};
use crate::html::Provenance;
use crate::scene::Scene;
use crate::{Document, svg, views};

/// Name of the page.
pub const PAGE: &str = "report.html";

/// File of a report.
#[derive(Clone, Debug)]
pub struct File {
    /// Name, without a folder.
    pub name: String,
    /// Content.
    pub text: String,
}

/// Figure of an analysis.
#[derive(Clone, Debug)]
pub struct Picture {
    /// File name without extension.
    pub name: String,
    /// Figure as plain data.
    pub scene: Scene,
    /// Figure as SVG.
    pub svg: String,
}

/// Returns the figures of an analysis, in the order of its page.
///
/// A report without data for figures has none.
pub fn figures(report: &Report) -> Vec<Picture> {
    let picture =
        |(named, scene): (NamedFigure, Scene)| Picture { name: named.name, svg: svg::file(&scene), scene };
    scenes(report).into_iter().map(picture).collect()
}

/// Builds the scenes in the order of the page: the Pareto chart, the cloud, and the others.
fn scenes(report: &Report) -> Vec<(NamedFigure<'_>, Scene)> {
    let gathered = report.figures.as_ref().map_or(&[][..], |figures| &figures.figures);
    let mut named = NamedFigure::all(gathered, report);
    named.sort_by_key(|named| match named.request.content {
        Content::Pareto => 0,
        Content::Cloud => 1,
        _ => 2,
    });
    let scenes = named.iter().map(|named| figures::scene(named, report)).collect::<Vec<_>>();
    named.into_iter().zip(scenes).collect()
}

/// Returns the files of an analysis: its figures as SVG, and `report.html`, which contains them.
///
/// The page of a report without data for figures has none. With the data of a live panel, it has
/// that as well.
pub fn analysis(report: &Report, live: Option<&explore::Report>) -> Vec<File> {
    let none = Figures::default();
    let Figures { left_out, .. } = report.figures.as_ref().unwrap_or(&none);
    let scenes = scenes(report);
    let spec = &report.spec;
    let study = report.study.file.iter().map(|(name, hash)| ("study", name.clone(), hash.clone()));
    let files = std::iter::once(("spec", spec.file.clone(), spec.hash.clone())).chain(study).collect();
    let drawn = scenes.iter().map(|(named, scene)| {
        let (note, file) = (named.workspace_note.clone(), format!("{}.svg", named.name));
        let is_first = matches!(named.request.content, Content::Pareto | Content::Cloud);
        (is_first, Figure { scene: scene.clone(), note, file })
    });
    let (first, others): (Vec<_>, Vec<_>) = drawn.partition(|(is_first, _)| *is_first);
    let figures = [first, others].map(|all| all.into_iter().map(|(_, figure)| figure).collect());
    let page = views::analysis(report, figures, left_out).page(&Provenance { files }, live);
    let file = |(named, scene): &(NamedFigure, Scene)| File {
        name: format!("{}.svg", named.name),
        text: svg::file(scene),
    };
    let mut files = scenes.iter().map(file).collect::<Vec<_>>();
    files.push(File { name: PAGE.to_owned(), text: page });
    files
}

/// Describes an error budget over a workspace, without the figures of its page.
pub fn budget(report: &Report) -> Document {
    views::analysis(report, [Vec::new(), Vec::new()], &[])
}
