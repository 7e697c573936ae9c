//! Reads `[[figure]]`: the figures of a study.
//!
//! ```toml
//! [[figure]]
//! kind = "travel"                          # error over a variable, parameter or input
//! source = "base rail curvature"           # default: all repeatable sources together
//! over = "d1"
//! paper = "Figure 8"                       # the figure of the paper that this one reproduces
//! caption = "Error over the base rail"
//! # kind = "surface", over = ["z", "q4"]   the largest error over two of them
//! # rows = "orientation"                  orientation errors, in mrad, instead of position errors
//! # kind = "cloud"                         the errors in space
//! # kind = "histogram"                     frequency of errors by size
//! # kind = "pareto"                        the share of each source
//! # kind = "manipulator", up = "y"         the frames at home
//!
//! [figure.workspace.grid]                  # its own workspace; default: that of the study
//! d1 = { from = "0 mm", to = "2256 mm", count = 200 }
//! ```

use abbe::analysis::Measurand;
use abbe_spec::expr::Symbol;
use abbe_spec::value::{find_name, read_name};
use abbe_spec::{Diagnostic, Item, Section, Spec};
use serde::{Serialize, Serializer};

use super::choices::{KINDS, Kind, MEASURANDS, UP_AXES};
use super::keys;
use crate::workspace::{Form, Region, read_region};

/// Figure to draw.
#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    /// Content of the figure.
    pub content: Content,
    /// Source that the figure shows; none for all sources together.
    pub source: Option<String>,
    /// Shows position or orientation errors.
    #[serde(serialize_with = "rows")]
    pub measurand: Measurand,
    /// Caption in the study.
    pub caption: String,
    /// Figure of the paper that this one reproduces; empty if none.
    pub paper: String,
    /// Workspace of the figure; none for that of the study.
    #[serde(skip)]
    pub region: Option<Region>,
}

/// Content of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// Error against the travel of one symbol.
    Travel(Over),
    /// Largest error over the travel of two symbols.
    Surface([Over; 2]),
    /// Errors in space.
    Cloud,
    /// Frequency of errors by size.
    Histogram,
    /// Share of each source.
    Pareto,
    /// Frames at home, with the index of the axis of `F_0` that points up.
    Manipulator(usize),
}

/// Symbol that errors are plotted against.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Over {
    /// Variable, by its index.
    Variable(usize),
    /// Parameter, by its index.
    Parameter(usize),
    /// Input, by its index.
    Input(usize),
}

/// Index of the upward axis of most machines, z.
pub(crate) const UP: usize = 2;

impl Figure {
    fn new(content: Content) -> Self {
        let measurand = Measurand::Position;
        Self { content, source: None, measurand, caption: String::new(), paper: String::new(), region: None }
    }

    /// Returns true if the figure is plotted over one of these inputs.
    pub(super) fn is_over(&self, inputs: &[usize]) -> bool {
        let over = match &self.content {
            Content::Travel(over) => std::slice::from_ref(over),
            Content::Surface(both) => both,
            _ => &[],
        };
        over.iter().any(|over| matches!(over, Over::Input(i) if inputs.contains(i)))
    }

    /// Returns the figures of a study that defines none: all content of the whole machine, and the
    /// error over each moving variable and input.
    pub(super) fn defaults(region: &Region) -> Vec<Self> {
        let moved = match &region.form {
            Form::Presented(presentation) => {
                let approaches = presentation.approaches.iter().map(|axis| axis.index);
                presentation.solved.iter().copied().chain(approaches).collect()
            }
            Form::Grid(axes) => axes.iter().map(|axis| axis.index).collect(),
            // A leg has no grid of its own.
            Form::Platform(..) => Vec::new(),
            Form::Samples { moved, .. } => moved.clone(),
            Form::Box(region) => region.solved.clone(),
            Form::Path(path) => path.variables().collect(),
            Form::One(_) => Vec::new(),
        };
        let moved: Vec<usize> = moved;
        let over = moved.into_iter().map(Over::Variable);
        let over = over.chain(region.moving_inputs().into_iter().map(Over::Input));
        let travels = over.map(Content::Travel);
        let whole = [Content::Manipulator(UP), Content::Pareto, Content::Cloud, Content::Histogram];
        whole.into_iter().chain(travels).map(Self::new).collect()
    }
}

/// Reads every `[[figure]]`; returns the defaults if there is none.
pub(super) fn read_figures(root: &Section<'_>, spec: &Spec, region: Option<&Region>) -> Vec<Figure> {
    let Some(item) = root.get("figure") else { return region.map(Figure::defaults).unwrap_or_default() };
    let items = item.array("an array of tables [[figure]]").unwrap_or_default();
    let mut figures: Vec<Figure> = Vec::new();
    for item in items {
        let Some(section) = item.named("a [[figure]]") else { continue };
        let Some(figure) = read_one(&section, spec) else { continue };
        let same = |other: &Figure| {
            (other.content, &other.source, other.measurand)
                == (figure.content, &figure.source, figure.measurand)
        };
        if figures.iter().any(same) {
            let message = "duplicate figure";
            root.document.mistake(Diagnostic::new(item.span(), message).help("remove one of them"));
        }
        figures.push(figure);
    }
    figures
}

fn read_one(section: &Section<'_>, spec: &Spec) -> Option<Figure> {
    let kind = section.required("kind").and_then(|item| item.choice(&KINDS))?;
    section.check_keys(&keys::accepted(kind));
    let content = match kind {
        Kind::Travel => Content::Travel(over(&section.required("over")?, spec)?),
        Kind::Surface => {
            let entries: [Item<'_>; 2] =
                section.required("over")?.entries("two names: variables, parameters or inputs")?;
            let [first, second] = entries.map(|entry| over(&entry, spec));
            Content::Surface([first?, second?])
        }
        Kind::Cloud => Content::Cloud,
        Kind::Histogram => Content::Histogram,
        Kind::Pareto => Content::Pareto,
        Kind::Manipulator => {
            Content::Manipulator(section.get("up").map(|item| item.choice(&UP_AXES)).unwrap_or(Some(UP))?)
        }
    };
    let mut figure = Figure::new(content);
    if let Some(item) = section.get("source") {
        let names = spec.sources.iter().map(|source| source.name.as_str());
        let source = read_name(&item, names, "source")?;
        figure.source = Some(spec.sources[source].name.clone());
    }
    if let Some(item) = section.get("rows") {
        figure.measurand = item.choice(&MEASURANDS)?;
    }
    if let Some(item) = section.get("workspace") {
        let mut region = read_region(&item, spec)?;
        region.over_ranges(spec);
        figure.region = Some(region);
    }
    figure.caption = section.optional_text("caption");
    figure.paper = section.optional_text("paper");
    Some(figure)
}

fn rows<S: Serializer>(measurand: &Measurand, serializer: S) -> Result<S::Ok, S::Error> {
    let name = MEASURANDS.iter().find(|(_, known)| known == measurand).map(|(name, _)| *name);
    serializer.serialize_str(name.unwrap_or_default())
}

fn over(item: &Item<'_>, spec: &Spec) -> Option<Over> {
    let name = item.string()?;
    let (names, symbols): (Vec<&str>, Vec<Symbol>) =
        spec.symbols().map(|(name, symbol, _)| (name, symbol)).unzip();
    let index = find_name(item.document, item.span(), &name, &names, "variable, parameter or input")?;
    match symbols[index] {
        Symbol::Variable(i) => Some(Over::Variable(i)),
        Symbol::Parameter(i) => Some(Over::Parameter(i)),
        Symbol::Input(i) => Some(Over::Input(i)),
        _ => None,
    }
}
