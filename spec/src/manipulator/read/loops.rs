//! `[[loop]]`: conditions that close loops of frames, and the count of freedoms.

use super::choices::CLOSURES;
use super::declarations::Declarations;
use super::keys;
use super::spec::frame_or_base;
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Symbol};
use crate::manipulator::names::title_of;
use crate::manipulator::{Closure, Factor, Frame, Loop};

/// A loop whose length has not been read yet, because it may use names declared later.
pub(super) struct RawLoop<'d> {
    section: Section<'d>,
    name: String,
    frames: Option<[Option<usize>; 2]>,
}

/// Reads all loops of a spec except their lengths, and declares the variables of legs; `names` are
/// those of the frames.
pub(super) fn read_loops<'d>(
    root: &Section<'d>,
    names: &[&str],
    declarations: &mut Declarations,
    document: &mut Document,
) -> Vec<RawLoop<'d>> {
    let items = root.get("loop").and_then(|item| document.array_of_tables(&item, "loop"));
    let mut loops: Vec<RawLoop<'d>> = Vec::new();
    for (index, item) in items.unwrap_or_default().iter().enumerate() {
        let Some(mut section) = document.section(item) else { continue };
        section.span = item.span();
        section.name = format!("loop {}", index + 1);
        let name_item = section.required("name", document);
        let name = name_item.as_ref().and_then(|item| title_of(item, document)).unwrap_or_default();
        if let Some(item) = &name_item {
            section.name = format!("the loop \"{name}\"");
            section.span = item.span();
        }
        if !name.is_empty()
            && let Some(first) = loops.iter().find(|other| other.name == name)
        {
            document.mistake(
                Diagnostic::new(section.span.clone(), format!("duplicate loop name \"{name}\""))
                    .label("second use")
                    .context(first.section.span.clone(), "first use")
                    .help("rename one"),
            );
        }
        section.check_keys(&[&keys::LOOP], document);
        let frames = section.required("frames", document).and_then(|item| {
            let pair: [Item<'_>; 2] = document.entries(&item, "two names of frames")?;
            let [first, second] = pair.map(|item| frame_or_base(&item, names, document));
            same_frame(&item, [first?, second?], document)
        });
        if let Some(item) = section.get("variable") {
            let end = frames.and_then(|[first, second]| first.or(second)).unwrap_or(0);
            declarations.read_variable(end, &[&keys::VARIABLE], &item, document);
        }
        loops.push(RawLoop { section, name, frames });
    }
    loops
}

/// Returns the two frames unless they are the same.
fn same_frame(
    item: &Item<'_>,
    frames: [Option<usize>; 2],
    document: &mut Document,
) -> Option<[Option<usize>; 2]> {
    if frames[0] != frames[1] {
        return Some(frames);
    }
    document.mistake(
        Diagnostic::new(item.span(), "a loop closes between two frames")
            .label("the same frame twice")
            .help("name the last frames of the two branches that meet"),
    );
    None
}

impl RawLoop<'_> {
    /// Reads the condition.
    pub(super) fn read(&self, declarations: &Declarations, document: &mut Document) -> Option<Loop> {
        let closes = self.section.required("closes", document)?;
        let coordinates = match closes.is_text() {
            true => document.choice(&closes, &CLOSURES)?.to_vec(),
            false => read_coordinates(&closes, document)?,
        };
        let length = match coordinates.is_empty() {
            true => self.section.required("length", document),
            false => self.section.get("length"),
        };
        let closure = match length {
            None => {
                if coordinates.is_empty() {
                    return None;
                }
                Closure::Coordinates(coordinates)
            }
            Some(item) if !coordinates.is_empty() => {
                document.mistake(
                    Diagnostic::new(item.key_span, "`length` belongs to `closes = \"distance\"`")
                        .context(closes.key_span, "this closes at coordinates")
                        .help("remove one of them"),
                );
                return None;
            }
            Some(item) => {
                let what = "the length between two frames";
                let entry = Entry { dimension: Some(Dimension::LENGTH), what, names: Allowed::Geometry };
                Closure::Distance(document.expression(&item, &declarations.scope, entry)?)
            }
        };
        Some(Loop { name: self.name.clone(), frames: self.frames?, closure, span: self.section.span.clone() })
    }
}

/// Reads a list of coordinates, in ascending order.
fn read_coordinates(item: &Item<'_>, document: &mut Document) -> Option<Vec<usize>> {
    let names: Vec<(&str, usize)> = Closure::COORDINATES.into_iter().zip(0..).collect();
    let entries = document.array(item, "a list of coordinates, or \"point\", \"pose\" or \"distance\"")?;
    let mut coordinates = Vec::new();
    for entry in &entries {
        let coordinate = document.choice(entry, &names)?;
        if coordinates.contains(&coordinate) {
            document.mistake(
                Diagnostic::new(entry.span(), "this coordinate is listed twice").help("remove one of them"),
            );
            return None;
        }
        coordinates.push(coordinate);
    }
    if coordinates.is_empty() {
        document.mistake(
            Diagnostic::new(item.span(), "`closes` is empty")
                .label("nothing closes here")
                .help("list coordinates such as [\"x\", \"y\"], or write \"point\", \"pose\" or \"distance\""),
        );
        return None;
    }
    coordinates.sort_unstable();
    Some(coordinates)
}

/// Checks that the loops determine the passive variables: that each belongs to a loop, and that
/// there are as many equations.
pub(super) fn check_freedoms(
    frames: &[Frame],
    loops: &[Loop],
    declarations: &Declarations,
    document: &mut Document,
) {
    let before = document.found.len();
    for (index, variable) in declarations.passive.iter().enumerate() {
        let moves = |end: &Option<usize>| {
            let mut path = std::iter::successors(*end, |frame| frames[*frame].parent);
            path.any(|frame| uses(&frames[frame], Symbol::Passive(index)))
        };
        let is_in = |closed: &Loop| {
            let [first, second] = closed.frames.each_ref().map(moves);
            let length = match &closed.closure {
                Closure::Distance(length) => length.symbols().any(|symbol| symbol == Symbol::Passive(index)),
                Closure::Coordinates(_) => false,
            };
            first || second || length
        };
        if !loops.iter().any(is_in) {
            let span = declarations.scope.names.get(&variable.name).map_or(0..0, |name| name.span.clone());
            document.mistake(
                Diagnostic::new(span, format!("no loop determines the passive variable `{}`", variable.name))
                    .label("it moves neither frame of any [[loop]]")
                    .help("add the [[loop]] that it belongs to, or remove `passive`"),
            );
        }
    }
    let equations: usize = loops.iter().map(|closed| closed.closure.equations()).sum();
    let passive = declarations.passive.len();
    if equations == passive || document.found.len() > before {
        return;
    }
    let Some(last) = loops.last() else { return };
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (freedoms, help) = match equations < passive {
        true => (
            format!("the machine can move by itself in {}", counted(passive - equations, "direction")),
            "close more coordinates, add a [[loop]], or remove `passive` where a joint is driven",
        ),
        false => (
            format!("{} too many", counted(equations - passive, "equation")),
            "a planar loop closes at [\"x\", \"y\"]; declare a joint `passive`, or close fewer coordinates",
        ),
    };
    let each: Vec<String> = loops
        .iter()
        .map(|closed| format!("\"{}\" {}", closed.name, closed.closure.equations()))
        .collect();
    let message = format!(
        "{} of the loops for {}: {freedoms}",
        counted(equations, "equation"),
        counted(passive, "passive variable"),
    );
    document.mistake(
        Diagnostic::new(last.span.clone(), message).label(format!("equations: {}", each.join(", "))).help(help),
    );
}

/// Returns `true` if the transform of a frame depends on a symbol.
fn uses(frame: &Frame, symbol: Symbol) -> bool {
    frame.factors.iter().flat_map(Factor::expressions).any(|e| e.symbols().any(|used| used == symbol))
}
