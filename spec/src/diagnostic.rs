//! Diagnostics: mistakes in an input file with their location, rendered in the style of rustc.

use std::borrow::Borrow;
use std::ffi::OsStr;
use std::fmt;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet, renderer::DecorStyle};

use crate::visible::{visible, with_placeholders};

/// A range of bytes of the input file.
pub type Span = Range<usize>;

/// Maximum number of diagnostics shown; the rest are counted.
const SHOWN: usize = 20;

/// Maximum number of names listed in a sentence.
const LISTED: usize = 20;

/// Number of diagnostics of a file up to which the nearest name is searched: no more are shown, and
/// there may be thousands of names.
const SOUGHT: usize = 100;

/// Maximum number of files of a folder that are compared with a missing name.
const LOOKED_AT: usize = 10_000;

/// A diagnostic: what is wrong, its location, and a remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Description of the mistake, in one sentence.
    pub message: String,
    /// Location; `None` for the file as a whole.
    pub span: Option<Span>,
    /// Text under the caret.
    pub label: String,
    /// Other relevant locations, such as the first of two equal names.
    pub context: Vec<(Span, String)>,
    /// Suggested remedy.
    pub help: Option<String>,
}

impl Diagnostic {
    /// Creates a diagnostic at `span`.
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { message, span: Some(span), label: String::new(), context: Vec::new(), help: None }
    }

    /// Creates a diagnostic of the file as a whole.
    pub fn whole_file(message: impl Into<String>) -> Self {
        Self { span: None, ..Self::new(0..0, message) }
    }

    /// Sets the text under the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds another location.
    pub fn context(mut self, span: Span, label: impl Into<String>) -> Self {
        self.context.push((span, label.into()));
        self
    }

    /// Sets the suggested remedy.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// Diagnostics of one file. Displayed as plain text, one after the other.
#[derive(Clone, PartialEq, Eq)]
pub struct Diagnostics {
    /// Name of the file as given by the user.
    pub path: String,
    /// Text of the file; empty if it could not be read.
    pub text: Arc<str>,
    /// One or more diagnostics, in the order of the file.
    pub list: Vec<Diagnostic>,
}

impl std::error::Error for Diagnostics {}

/// Shown as displayed, so that `unwrap` prints readable text.
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
    /// Renders the diagnostics, in color if `styled`.
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
        let mut group = Group::with_title(Level::ERROR.primary_title(visible(&diagnostic.message)));
        group = match &diagnostic.span {
            None => group.element(Origin::path(visible(&self.path))),
            Some(span) => {
                let primary = AnnotationKind::Primary.span(self.clip(span)).label(visible(&diagnostic.label));
                let context = diagnostic
                    .context
                    .iter()
                    .map(|(span, label)| AnnotationKind::Context.span(self.clip(span)).label(visible(label)));
                let snippet = Snippet::source(with_placeholders(&self.text)).path(visible(&self.path));
                group.element(snippet.annotation(primary).annotations(context))
            }
        };
        if let Some(help) = &diagnostic.help {
            group = group.element(Level::HELP.message(visible(help)));
        }
        vec![group]
    }

    /// Clips a span to its first line, on character boundaries.
    fn clip(&self, span: &Span) -> Span {
        let start = self.text.floor_char_boundary(span.start.min(self.text.len()));
        let end = self.text.ceil_char_boundary(span.end.clamp(start, self.text.len()));
        let line = self.text[start..end].find(['\n', '\r']).map_or(end, |newline| start + newline);
        start..line
    }
}

/// Returns what to write for a number with a comma, which three digits behind it leave open.
pub(crate) fn decimal(whole: &str, part: &str) -> String {
    match part.len() {
        3 if whole != "0" => format!("write `{whole}{part}`, or a decimal point: `{whole}.{part}`"),
        _ => format!("write a decimal point: `{whole}.{part}`"),
    }
}

/// Words that others use, and the names that they mean.
const MEANT: &str = "gaussian gauss: normal; rectangular rect: uniform; stochastic noise: random;
    systematic deterministic: repeatable; linear slide sliding translational: prismatic; type: kind;
    rotary rotational hinge: revolute; unit units: length; range bounds: limits; link body: frame;
    value: error; robot machine: manipulator; trans transx: Tx; rotx: Rx; roty: Ry; rotz: Rz;
    ex dx: e_x; ey dy: e_y; ez dz: e_z; erx e_rx rx drx ea e_a: e_p; ery e_ry ry dry eb e_b: e_s;
    erz e_rz rz drz ec e_c: e_r";

/// Returns what a table of `words: meaning; …` has for a word.
pub(crate) fn meanings<'t>(table: &'t str, word: &str) -> impl Iterator<Item = &'t str> {
    let entries = table.split(';').filter_map(|entry| entry.split_once(':'));
    let found = entries.filter(move |(words, _)| words.split_whitespace().any(|one| one == word));
    found.map(|(_, meaning)| meaning.trim())
}

/// Returns the known name that a word means or is most similar to, if any is similar enough.
pub fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // A single edit always counts as similar, even in short words.
    let similarity = |candidate: &str| match strsim::damerau_levenshtein(word, candidate) {
        1 if word.chars().count() > 2 => 1.0,
        _ => strsim::jaro_winkler(word, candidate),
    };
    let known: Vec<&str> = known.into_iter().collect();
    let in_other_case = known.iter().find(|candidate| candidate.eq_ignore_ascii_case(word));
    let similar = known
        .iter()
        .map(|candidate| (similarity(candidate), *candidate))
        .filter(|(similarity, _)| *similarity > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let lower = word.to_lowercase();
    let meant = meanings(MEANT, &lower).find_map(|name| known.iter().find(|candidate| **candidate == name));
    in_other_case.or(meant).copied().or(similar.map(|(_, candidate)| candidate))
}

/// Returns the file in the same folder whose name is most similar to that of a missing one.
pub fn nearest_file(missing: &Path) -> Option<PathBuf> {
    let folder = missing.parent().filter(|folder| !folder.as_os_str().is_empty());
    let entries = fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?.take(LOOKED_AT).flatten();
    let files = entries.filter(|entry| entry.file_type().is_ok_and(|kind| !kind.is_dir()));
    let mut names: Vec<String> = files.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let word = missing.file_name()?.to_str()?;
    // Extensions are too short to compare, so the stems must be similar as well.
    let is_near = |name: &&str| nearest(stem(word), [stem(name)]).is_some();
    nearest(word, names.iter().map(String::as_str).filter(is_near)).map(|name| missing.with_file_name(name))
}

/// Returns a file name without its extension.
fn stem(name: &str) -> &str {
    Path::new(name).file_stem().and_then(OsStr::to_str).unwrap_or_default()
}

/// Lists names in a sentence, and the number of names left out.
pub fn listed(names: &[&str]) -> String {
    first(&names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>())
}

/// Returns the most similar name like [`nearest`], unless there are already `found` or more
/// diagnostics than are shown.
pub(crate) fn nearest_after<'a>(
    found: usize,
    word: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    if found < SOUGHT { nearest(word, known) } else { None }
}

/// Returns `did you mean …?`, or else the list of known names, for the diagnostic after `found`
/// others.
pub(crate) fn suggestion(found: usize, word: &str, known: &[&str], what: &str) -> String {
    match nearest_after(found, word, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None if known.is_empty() => format!("there is no {what} here"),
        None => format!("{what}: {}", first(known)),
    }
}

/// Lists the first of some names, and the number of names left out.
pub(crate) fn first(names: &[impl Borrow<str>]) -> String {
    let shown = names[..names.len().min(LISTED)].join(", ");
    match names.len().saturating_sub(LISTED) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
