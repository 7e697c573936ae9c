//! Checks sources that act on loops: an error of a length acts as a displacement of one end of the
//! leg.

use super::declarations::Declarations;
use crate::diagnostic::Diagnostic;
use crate::document::Document;
use crate::expr::Symbol;
use crate::manipulator::{ChainNumber, Deviation, Factor, Loop, Source, Tree};

/// Records errors of lengths whose leg has no end of its own, and errors of the tool's transform on
/// a frame of a loop.
pub(super) fn check_sources_in_loops(
    tree: Tree<'_>,
    tool: &[Factor],
    sources: &[Source],
    declarations: &Declarations,
    document: &Document,
) {
    if tree.loops.is_empty() {
        return;
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
