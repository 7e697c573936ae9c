//! Mistakes in an input file, with their places, shown as rustc would show them.

use std::ffi::OsStr;
use std::fmt;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

/// A range of bytes of the input file.
pub type Span = Range<usize>;

/// The most mistakes shown at once; what lies beyond is counted.
const SHOWN: usize = 20;

/// The most names in a sentence.
const LISTED: usize = 20;

/// For so many mistakes of a file the nearest name is looked for: fewer are shown, and names may be thousands.
const SOUGHT: usize = 100;

/// The most files of a folder among which the nearest is looked for.
const LOOKED_AT: usize = 10_000;

/// One mistake: what is wrong, where, and a way out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, in one sentence.
    pub message: String,
    /// Where; none if the file could not be read at all.
    pub span: Option<Span>,
    /// What stands under the caret.
    pub label: String,
    /// Other places that matter, such as the first of two equal names.
    pub context: Vec<(Span, String)>,
    /// The way out.
    pub help: Option<String>,
}

impl Diagnostic {
    /// A mistake at `span`.
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            span: Some(span),
            label: String::new(),
            context: Vec::new(),
            help: None,
        }
    }

    /// A mistake of the file as a whole.
    pub fn whole_file(message: impl Into<String>) -> Self {
        Self { span: None, ..Self::new(0..0, message) }
    }

    /// Says under the caret what is wrong there.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Shows another place.
    pub fn context(mut self, span: Span, label: impl Into<String>) -> Self {
        self.context.push((span, label.into()));
        self
    }

    /// Says a way out.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// All mistakes that one stage found in one file. Displays as plain text, one mistake after the other.
#[derive(Clone, PartialEq, Eq)]
pub struct Diagnostics {
    /// The file's name as the user gave it.
    pub path: String,
    /// The file's text, empty if it could not be read.
    pub text: Arc<str>,
    /// At least one mistake, in the order of the file.
    pub list: Vec<Diagnostic>,
}

impl std::error::Error for Diagnostics {}

/// As displayed, so that an `unwrap` shows it as it is meant to be read.
impl fmt::Debug for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}\n")
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl Diagnostics {
    /// The text for people, with colours if `styled`.
    pub fn render(&self, styled: bool) -> String {
        let renderer = if styled { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.decor_style(DecorStyle::Ascii);
        let mut shown: Vec<String> = self.list[..self.list.len().min(SHOWN)]
            .iter()
            .map(|diagnostic| renderer.render(&self.report(diagnostic)))
            .collect();
        if self.list.len() > SHOWN {
            shown.push(format!("… and {} more", self.list.len() - SHOWN));
        }
        shown.join("\n\n")
    }

    fn report<'a>(&'a self, diagnostic: &'a Diagnostic) -> Vec<Group<'a>> {
        let mut group = Group::with_title(Level::ERROR.primary_title(&*diagnostic.message));
        group = match &diagnostic.span {
            None => group.element(Origin::path(&*self.path)),
            Some(span) => {
                let primary = AnnotationKind::Primary.span(self.clip(span)).label(&*diagnostic.label);
                let context = diagnostic
                    .context
                    .iter()
                    .map(|(span, label)| AnnotationKind::Context.span(self.clip(span)).label(&**label));
                let snippet =
                    Snippet::source(&*self.text).path(&*self.path).annotation(primary).annotations(context);
                group.element(snippet)
            }
        };
        if let Some(help) = &diagnostic.help {
            group = group.element(Level::HELP.message(&**help));
        }
        vec![group]
    }

    /// The part of a span that is worth a caret: its first line, on character boundaries.
    fn clip(&self, span: &Span) -> Span {
        let start = self.text.floor_char_boundary(span.start.min(self.text.len()));
        let end = self.text.ceil_char_boundary(span.end.clamp(start, self.text.len()));
        let line = self.text[start..end].find(['\n', '\r']).map_or(end, |newline| start + newline);
        start..line
    }
}

/// The nearest of `known` to a word that is not among them, as the second half of a help text.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // One slip of the finger is always near, also in words too short to be alike otherwise.
    let similarity = |candidate: &str| match strsim::damerau_levenshtein(word, candidate) {
        1 if word.chars().count() > 2 => 1.0,
        _ => strsim::jaro_winkler(word, candidate),
    };
    known
        .into_iter()
        .map(|candidate| (similarity(candidate), candidate))
        .filter(|(similarity, _)| *similarity > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// The file in the same folder whose name is nearest to that of one that is not there.
pub fn nearest_file(missing: &Path) -> Option<PathBuf> {
    let folder = missing.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?.take(LOOKED_AT).flatten();
    let files = entries.filter(|entry| entry.file_type().is_ok_and(|kind| !kind.is_dir()));
    let mut names: Vec<String> = files.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let word = missing.file_name()?.to_str()?;
    // One ending is like another: the names before it must be alike as well.
    let alike = |name: &&str| nearest(stem(word), [stem(name)]).is_some();
    let names = names.iter().map(String::as_str).filter(alike);
    nearest(word, names).map(|name| missing.with_file_name(name))
}

/// A file's name without its ending.
fn stem(name: &str) -> &str {
    Path::new(name).file_stem().and_then(OsStr::to_str).unwrap_or_default()
}

/// Names in a sentence, and how many more there are.
pub fn listed(names: &[&str]) -> String {
    let shown: Vec<String> = names.iter().take(LISTED).map(|name| format!("`{name}`")).collect();
    match names.len().saturating_sub(LISTED) {
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

/// As [`nearest`], for the mistake of a file that comes after `found` others.
pub(crate) fn nearest_after<'a>(
    found: usize,
    word: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    if found < SOUGHT { nearest(word, known) } else { None }
}

/// `did you mean …?`, or else what is known, for the mistake that comes after `found` others.
pub(crate) fn suggestion(found: usize, word: &str, known: &[&str], what: &str) -> String {
    match nearest_after(found, word, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None if known.is_empty() => format!("there is no {what} here"),
        None => format!("{what}: {}", first(known)),
    }
}

/// The first of some names, and how many more there are.
pub(crate) fn first(names: &[&str]) -> String {
    let shown = names[..names.len().min(LISTED)].join(", ");
    match names.len().saturating_sub(LISTED) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
