//! `[[loop]]`: conditions that close loops of frames.

use super::{CLOSURES, Declarations, Named, frame_or_base, keys, rigid::depends};
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Expression, Symbol};
use crate::manipulator::{Closure, Loop, read_title};

/// Maximum number of loops. The code that closes them grows with the cube of their equations.
const MOST_LOOPS: usize = 100;

/// A loop whose length has not been read yet, because it may use names declared later.
pub(super) struct RawLoop<'d> {
    section: Section<'d>,
    name: String,
    frames: Option<[Option<usize>; 2]>,
    /// Variable of a leg.
    own: Option<Symbol>,
}

/// Reads all loops of a spec except their lengths, and declares the variables of legs; `named` are
/// the frames.
pub(super) fn read_loops<'d>(
    root: &Section<'d>,
    named: &[Named<'_>],
    declarations: &mut Declarations,
) -> Vec<RawLoop<'d>> {
    let mut loops: Vec<RawLoop<'d>> = Vec::new();
    let help = "replace parts that move as one body by a single frame";
    let mut known = Vec::new();
    for (index, item) in root.tables("loop", MOST_LOOPS, help).iter().enumerate() {
        let Some(mut section) = item.named(format!("loop {}", index + 1)) else { continue };
        let name = read_title(&mut section, "loop", &mut known, "rename one").unwrap_or_default();
        section.check_keys(&[&keys::LOOP]);
        let frames = section.required("frames").and_then(|item| {
            let pair: [Item<'_>; 2] = item.entries("two names of frames")?;
            let [first, second] = pair.map(|item| frame_or_base(&item, named));
            same_frame(&item, [first?, second?])
        });
        let end = frames.and_then(|[first, second]| first.or(second)).unwrap_or(0);
        let own = section.get("variable").and_then(|item| {
            check_driven(&item);
            declarations.read_variable(end, &item)
        });
        loops.push(RawLoop { section, name, frames, own });
    }
    loops
}

/// Returns the two frames unless they are the same.
fn same_frame(item: &Item<'_>, frames: [Option<usize>; 2]) -> Option<[Option<usize>; 2]> {
    if frames[0] != frames[1] {
        return Some(frames);
    }
    let help = "name the last frames of the two branches that meet";
    let mistake = Diagnostic::new(item.span(), "a loop closes between two frames");
    item.document.fail(mistake.label("the same frame twice").help(help))
}

/// Records `passive` in the variable of a leg: the loop itself determines a length without a drive.
fn check_driven(variable: &Item<'_>) {
    let Some(passive) = variable.key_of_table("passive") else { return };
    let help = "remove `passive` if the leg has a drive, or remove this [[loop]] if it has none";
    let mistake = Diagnostic::new(passive.key_span, "the variable of a leg cannot be `passive`");
    variable.document.mistake(mistake.label("a length without a drive closes nothing").help(help));
}

impl RawLoop<'_> {
    /// Reads the condition.
    pub(super) fn read(&self, declarations: &Declarations, document: &Document) -> Option<Loop> {
        let closes = self.section.required("closes")?;
        let coordinates = match closes.is_text() {
            true => closes.choice(&CLOSURES)?.to_vec(),
            false => read_coordinates(&closes)?,
        };
        let closure = if coordinates.is_empty() {
            Closure::Distance(self.read_length(declarations, document)?)
        } else {
            self.check_without_length(&closes)?;
            Closure::Coordinates(coordinates)
        };
        Some(Loop { name: self.name.clone(), frames: self.frames?, closure, span: self.section.span.clone() })
    }

    /// Reads the length of a leg, which depends on its own variable, or of a strut.
    fn read_length(&self, declarations: &Declarations, document: &Document) -> Option<Expression> {
        let item = self.section.required("length")?;
        let what = "the length between two frames";
        let entry = Entry { dimension: Some(Dimension::LENGTH), what, names: Allowed::Geometry };
        let length = item.expression(&declarations.scope, entry)?;
        if let Some(own) = self.own
            && let Some(variable) = declarations.variable(own)
            && declarations.scope.names.get(&variable.name).is_some_and(|name| name.symbol == own)
            && !depends(&length, own, declarations)
        {
            let name = &variable.name;
            let message = format!("`{name}` does not change the length of its leg");
            let help = format!("write `l0 + {name}`, or declare `{name}` in the frame that it moves");
            let mistake = Diagnostic::new(item.span(), message);
            return document.fail(mistake.label("this does not depend on it").help(help));
        }
        Some(length)
    }

    /// Records the keys of a leg in a loop that closes at coordinates.
    fn check_without_length(&self, closes: &Item<'_>) -> Option<()> {
        let (item, help) = match (self.section.get("length"), self.section.get("variable")) {
            (None, None) => return Some(()),
            (Some(length), _) => (length, "remove it, or write closes = \"distance\""),
            (None, Some(variable)) => (variable, "declare the variable in the [[frame]] that it moves"),
        };
        let message = format!("`{}` belongs to `closes = \"distance\"`", item.key);
        let mistake = Diagnostic::new(item.key_span, message).label("only a leg has one");
        let mistake = mistake.context(closes.key_span.clone(), "this closes at coordinates");
        closes.document.fail(mistake.help(help))
    }
}

/// Reads a list of coordinates, in ascending order.
fn read_coordinates(item: &Item<'_>) -> Option<Vec<usize>> {
    let names: Vec<(&str, usize)> = Closure::COORDINATES.into_iter().zip(0..).collect();
    let entries = item.array("a list of coordinates, or \"point\", \"pose\" or \"distance\"")?;
    let mut coordinates = Vec::new();
    for entry in &entries {
        let coordinate = entry.choice(&names)?;
        if coordinates.contains(&coordinate) {
            let mistake = Diagnostic::new(entry.span(), "this coordinate is listed twice");
            return item.document.fail(mistake.label("second use").help("remove one of them"));
        }
        coordinates.push(coordinate);
    }
    if coordinates.is_empty() {
        let help = "list coordinates such as [\"x\", \"y\"], or write \"point\", \"pose\" or \"distance\"";
        let mistake = Diagnostic::new(item.span(), "`closes` is empty");
        return item.document.fail(mistake.label("nothing closes here").help(help));
    }
    coordinates.sort_unstable();
    Some(coordinates)
}
