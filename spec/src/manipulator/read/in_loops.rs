//! Checks sources that act on loops: their effect must follow from the frames.
//!
//! The forces of a loop load all elastic elements between its ends, and statics of the tree does
//! not know them. An error of a length acts as a displacement of one end of the leg.

use super::declarations::Declarations;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::Document;
use crate::expr::Symbol;
use crate::manipulator::{ChainNumber, Deviation, Factor, Loop, Source, Tree};

/// Records elastic elements within a loop, errors of lengths whose leg has no end of its own, and
/// errors of the tool's transform on a frame of a loop.
pub(super) fn check_sources_in_loops(
    tree: Tree<'_>,
    tool: &[Factor],
    sources: &[Source],
    declarations: &Declarations,
    document: &mut Document,
) {
    if tree.loops.is_empty() {
        return;
    }
    for effect in sources.iter().flat_map(|source| &source.effects).filter(|e| e.cause.is_elastic()) {
        if let Some(closed) = loading(tree, effect.frame) {
            document.mistake(loaded(closed, effect.span.clone()));
        }
    }
    for deviation in sources.iter().flat_map(|source| &source.deviations) {
        let symbol = match deviation.number {
            ChainNumber::Joint(joint) => Symbol::Variable(joint),
            ChainNumber::Parameter(parameter) => Symbol::Parameter(parameter),
            ChainNumber::DenavitHartenberg { .. } => continue,
        };
        let lengths = tree.loops.iter().filter(|closed| {
            closed.closure.length().is_some_and(|length| length.symbols().any(|used| used == symbol))
        });
        if deviation.is_elastic() {
            let moved = (0..tree.frames.len())
                .filter(|frame| tree.frames[*frame].symbols().any(|used| used == symbol));
            let within = lengths
                .into_iter()
                .next()
                .or_else(|| moved.into_iter().find_map(|frame| loading(tree, frame)));
            if let Some(closed) = within {
                document.mistake(loaded(closed, deviation.span.clone()));
            }
            continue;
        }
        for closed in lengths.filter(|closed| tree.own_end(closed).is_none()) {
            document.mistake(without_end(tree, closed, deviation, declarations));
        }
        // An error of the tool acts as one of the frame that carries it, which would move the loop.
        let carried = |end: Option<usize>| end.is_some_and(|end| tree.carries(tree.tool_frame, end));
        let in_tool = tool.iter().flat_map(Factor::expressions).any(|e| e.symbols().any(|s| s == symbol));
        let ending = tree.loops.iter().find(|closed| closed.frames.into_iter().any(carried));
        if let Some(closed) = ending.filter(|_| in_tool) {
            document.mistake(in_tool_of_loop(tree, closed, deviation, declarations));
        }
    }
}

/// Returns a loop whose forces load a frame: one of its ends moves with the frame, the other does
/// not.
fn loading<'s>(tree: Tree<'s>, frame: usize) -> Option<&'s Loop> {
    tree.loops.iter().find(|closed| {
        let [first, second] = closed.frames.map(|end| end.is_some_and(|end| tree.carries(frame, end)));
        first != second
    })
}

fn loaded(closed: &Loop, span: Span) -> Diagnostic {
    Diagnostic::new(span, format!("the forces of the loop \"{}\" on this element are not known", closed.name))
        .label("elastic, inside the loop")
        .context(closed.span.clone(), "one end moves with it, the other one does not")
        .help("give the deflection as errors e_x … e_p of the frame; an elastic element can carry a loop as a whole")
}

fn in_tool_of_loop(
    tree: Tree<'_>,
    closed: &Loop,
    deviation: &Deviation,
    declarations: &Declarations,
) -> Diagnostic {
    let (name, carrier) = (name(tree, deviation, declarations), &tree.frames[tree.tool_frame].name);
    Diagnostic::new(deviation.span.clone(), format!("the error of `{name}` needs a frame for the tool alone"))
        .label("an error of the tool's transform")
        .context(closed.span.clone(), format!("\"{carrier}\", which carries the tool, carries this loop too"))
        .help(format!(
            "add a [[frame]] for the tool, parent = \"{carrier}\", transform = \"Tx(0)\", and name it in [tool] frame"
        ))
}

fn name<'n>(tree: Tree<'n>, deviation: &Deviation, declarations: &'n Declarations) -> &'n str {
    match deviation.number {
        ChainNumber::Joint(joint) => &declarations.variables[joint].name,
        ChainNumber::Parameter(parameter) => &declarations.parameters[parameter].name,
        ChainNumber::DenavitHartenberg { frame, .. } => &tree.frames[frame].name,
    }
}

fn without_end(
    tree: Tree<'_>,
    closed: &Loop,
    deviation: &Deviation,
    declarations: &Declarations,
) -> Diagnostic {
    let name = name(tree, deviation, declarations);
    let end = closed.frames.into_iter().flatten().next().map_or("base", |frame| &tree.frames[frame].name);
    Diagnostic::new(
        deviation.span.clone(),
        format!("the error of `{name}` needs an end of the leg \"{}\" that moves alone", closed.name),
    )
    .label("an error of its length")
    .context(closed.span.clone(), "its ends carry other frames, loops or the tool")
    .help(format!(
        "add a [[frame]] for its end, parent = \"{end}\", transform = \"Tx(0)\", and name it in `frames` instead of \"{end}\""
    ))
}
