//! Sections of a document, and their blocks.

use super::table::Table;
use crate::scene::Scene;

/// Part of a document under one heading.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    pub(crate) depth: Depth,
    /// Heading; empty on the first screen.
    pub(crate) title: &'static str,
    pub(crate) blocks: Vec<Block>,
}

/// Amount of detail with which a section is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depth {
    /// First screen, and everywhere else.
    Answer,
    /// Below the first screen of a full report, and on a page.
    Full,
    /// Pages only.
    Page,
}

/// Part of a section.
#[derive(Clone, Debug)]
pub(crate) enum Block {
    /// Named facts.
    Facts(Vec<(&'static str, String)>),
    Table(Table),
    Statement(Statement),
    /// Short texts of one kind, each in its own line.
    List(Vec<String>),
    /// Lines of a file.
    Code(Vec<String>),
    /// Important numbers, on a page.
    Cards(Vec<Card>),
    /// Figures, on a page.
    Figures(Vec<Figure>),
}

/// Sentence that the numbers imply, with the name by which programs refer to it.
#[derive(Clone, Debug)]
pub(crate) struct Statement {
    pub(crate) name: &'static str,
    pub(crate) text: String,
}

/// Figure with a note below it.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    pub(crate) scene: Scene,
    pub(crate) note: String,
    /// File beside the page that has the figure alone; may be empty.
    pub(crate) file: String,
}

impl From<Scene> for Figure {
    fn from(scene: Scene) -> Self {
        Self { scene, note: String::new(), file: String::new() }
    }
}

/// Important number: its name, the number with its unit, and a note.
#[derive(Clone, Debug)]
pub(crate) struct Card {
    pub(crate) name: &'static str,
    pub(crate) value: String,
    pub(crate) note: String,
}

impl Section {
    fn new(depth: Depth, title: &'static str) -> Self {
        Self { depth, title, blocks: Vec::new() }
    }

    /// Creates a section of the first screen.
    pub(crate) fn answer() -> Self {
        Self::new(Depth::Answer, "")
    }

    /// Creates a section of a full report.
    pub(crate) fn full(title: &'static str) -> Self {
        Self::new(Depth::Full, title)
    }

    /// Creates a section of a page.
    pub(crate) fn page(title: &'static str) -> Self {
        Self::new(Depth::Page, title)
    }

    fn with(mut self, block: Option<Block>) -> Self {
        self.blocks.extend(block);
        self
    }

    /// Adds facts, if there are any.
    pub(crate) fn facts(self, facts: Vec<(&'static str, String)>) -> Self {
        self.with((!facts.is_empty()).then_some(Block::Facts(facts)))
    }

    /// Adds a table, if it has rows.
    pub(crate) fn table(self, table: Table) -> Self {
        self.with((!table.rows.is_empty()).then_some(Block::Table(table)))
    }

    /// Adds a statement, if there is one.
    pub(crate) fn state(self, name: &'static str, text: impl Into<Option<String>>) -> Self {
        let text = text.into().filter(|text| !text.is_empty());
        self.with(text.map(|text| Block::Statement(Statement { name, text })))
    }

    /// Adds a statement that introduces a list, which may have no words, if the list has items.
    pub(crate) fn list(self, name: &'static str, text: &str, items: Vec<String>) -> Self {
        if items.is_empty() { self } else { self.state(name, text.to_owned()).with(Some(Block::List(items))) }
    }

    /// Adds a statement that introduces lines of a file, if there are lines.
    pub(crate) fn code(self, name: &'static str, text: &str, lines: Vec<String>) -> Self {
        if lines.is_empty() { self } else { self.state(name, text.to_owned()).with(Some(Block::Code(lines))) }
    }

    /// Adds important numbers.
    pub(crate) fn cards(self, cards: Vec<Card>) -> Self {
        self.with(Some(Block::Cards(cards)))
    }

    /// Adds figures, if there are any.
    pub(crate) fn figures<F: Into<Figure>>(self, figures: Vec<F>) -> Self {
        let figures: Vec<Figure> = figures.into_iter().map(F::into).collect();
        self.with((!figures.is_empty()).then_some(Block::Figures(figures)))
    }

    pub(crate) fn statements(&self) -> impl Iterator<Item = &Statement> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Statement(statement) => Some(statement),
            _ => None,
        })
    }
}
