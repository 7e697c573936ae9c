//! Checks that the loops determine the passive variables: each belongs to a loop, and no part of
//! the machine has more or fewer equations than passive variables.
//!
//! Checks sources that act on loops: an error of a length acts as a displacement of one end of the
//! leg.

use super::Declarations;
use crate::diagnostic::{Diagnostic, Span, first};
use crate::document::Document;
use crate::expr::Symbol;
use crate::manipulator::{ChainNumber, Factor, Loop, Source, Tree, Variable};

/// Records loops without passive variables, passive variables without a loop, and the parts with
/// too many or too few equations.
pub(super) fn check_freedoms(tree: Tree<'_>, declarations: &Declarations, document: &Document) {
    let before = document.mistakes();
    let moved: Vec<Vec<usize>> = tree
        .loops
        .iter()
        .map(|closed| {
            let symbols = tree.symbols(closed);
            let passive = (0..declarations.passive.len()).filter(|i| symbols.contains(&Symbol::Passive(*i)));
            let passive: Vec<usize> = passive.collect();
            if passive.is_empty() {
                document.mistake(without_passive(closed, &symbols, declarations));
            }
            passive
        })
        .collect();
    for (index, variable) in declarations.passive.iter().enumerate() {
        if !moved.iter().any(|passive| passive.contains(&index)) {
            document.mistake(without_loop(variable, declarations));
        }
    }
    if document.mistakes() == before {
        for part in Assignment::new(tree.loops, moved, declarations.passive.len()).unbalanced() {
            document.mistake(part.mistake(tree.loops, &declarations.passive));
        }
    }
}

fn without_passive(closed: &Loop, symbols: &[Symbol], declarations: &Declarations) -> Diagnostic {
    let commanded = |symbol: &Symbol| matches!(symbol, Symbol::Variable(_));
    let driven = symbols.iter().find(|symbol| commanded(symbol)).and_then(|one| declarations.variable(*one));
    let mistake = Diagnostic::new(
        closed.span.clone(),
        format!("no passive joint lets the loop \"{}\" close", closed.name),
    );
    match driven {
        Some(variable) => {
            mistake.label(format!("only commanded joints move its frames, such as `{}`", variable.name)).help(
                "write `passive = true` in the variables of joints without a drive, or remove this [[loop]]",
            )
        }
        None => mistake
            .label("no joint moves one of its frames relative to the other")
            .help("name frames on the two sides of a joint, or remove this [[loop]]"),
    }
}

fn without_loop(variable: &Variable, declarations: &Declarations) -> Diagnostic {
    let name = &variable.name;
    let span = declarations.scope.names.get(name).map_or(0..0, |name| name.span.clone());
    Diagnostic::new(span, format!("no loop determines the passive variable `{name}`"))
        .label("it does not move the frames of any [[loop]] relative to each other")
        .help("add the [[loop]] that it belongs to, or remove `passive`")
}

/// Assignment of as many equations as possible to passive variables of their own loops.
struct Assignment {
    /// Number of equations of each loop.
    equations: Vec<usize>,
    /// Passive variables that move each loop.
    moved: Vec<Vec<usize>>,
    /// Loop whose equation determines each passive variable.
    determined_by: Vec<Option<usize>>,
}

/// Loops that share passive variables.
struct Part {
    loops: Vec<usize>,
    passive: Vec<usize>,
    equations: usize,
}

impl Assignment {
    /// Finds the assignment by augmenting paths (Kuhn 1955).
    fn new(loops: &[Loop], moved: Vec<Vec<usize>>, passive: usize) -> Self {
        let equations = loops.iter().map(|closed| closed.closure.equations()).collect();
        let mut assignment = Self { equations, moved, determined_by: vec![None; passive] };
        for index in 0..loops.len() {
            for _ in 0..assignment.equations[index] {
                assignment.assign(index, &mut vec![false; passive]);
            }
        }
        assignment
    }

    /// Assigns a further equation of a loop; returns `false` if there is no variable for it.
    fn assign(&mut self, index: usize, tried: &mut [bool]) -> bool {
        for passive in self.moved[index].clone() {
            if std::mem::replace(&mut tried[passive], true) {
                continue;
            }
            if self.determined_by[passive].is_none_or(|other| self.assign(other, tried)) {
                self.determined_by[passive] = Some(index);
                return true;
            }
        }
        false
    }

    /// Returns the part with too many equations, and the part with too few, if there are any
    /// (Dulmage and Mendelsohn 1958).
    fn unbalanced(&self) -> Vec<Part> {
        let assigned = |index: usize| self.determined_by.iter().filter(|by| **by == Some(index)).count();
        let mut over: Vec<usize> =
            (0..self.moved.len()).filter(|index| assigned(*index) < self.equations[*index]).collect();
        let mut next = 0;
        while let Some(index) = over.get(next).copied() {
            next += 1;
            for by in self.moved[index].iter().filter_map(|passive| self.determined_by[*passive]) {
                if !over.contains(&by) {
                    over.push(by);
                }
            }
        }
        let mut free: Vec<usize> =
            (0..self.determined_by.len()).filter(|passive| self.determined_by[*passive].is_none()).collect();
        let mut next = 0;
        while let Some(passive) = free.get(next).copied() {
            next += 1;
            for index in (0..self.moved.len()).filter(|index| self.moved[*index].contains(&passive)) {
                for other in 0..self.determined_by.len() {
                    if self.determined_by[other] == Some(index) && !free.contains(&other) {
                        free.push(other);
                    }
                }
            }
        }
        let is_moved = |passive: &usize| over.iter().any(|index| self.moved[*index].contains(passive));
        let of_over = (0..self.determined_by.len()).filter(is_moved).collect();
        let moves = |index: &usize| self.moved[*index].iter().any(|passive| free.contains(passive));
        let parts = [(over, of_over), ((0..self.moved.len()).filter(moves).collect(), free)].into_iter();
        let parts = parts.filter(|(loops, _): &(Vec<usize>, Vec<usize>)| !loops.is_empty());
        parts.map(|(loops, passive)| self.part(loops, passive)).collect()
    }

    fn part(&self, mut loops: Vec<usize>, mut passive: Vec<usize>) -> Part {
        loops.sort_unstable();
        passive.sort_unstable();
        let equations = loops.iter().map(|index| self.equations[*index]).sum();
        Part { loops, passive, equations }
    }
}

impl Part {
    fn mistake(&self, loops: &[Loop], passive: &[Variable]) -> Diagnostic {
        let counted =
            |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        let (given, needed) = (self.equations, self.passive.len());
        let (verdict, help) = match given < needed {
            true => (
                format!("the machine can move by itself in {}", counted(needed - given, "direction")),
                "close more coordinates, add a [[loop]], or remove `passive` where a joint is driven",
            ),
            false => (
                format!("{} too many", counted(given - needed, "equation")),
                "a planar loop closes at two coordinates such as [\"x\", \"y\"]; declare a further joint `passive`, or close fewer",
            ),
        };
        let equations = counted(given, "equation");
        let of = match self.loops.as_slice() {
            [one] => format!("the loop \"{}\" has {equations}", loops[*one].name),
            several => format!("{} loops have {equations}", several.len()),
        };
        let names: Vec<&str> = self.passive.iter().map(|index| passive[*index].name.as_str()).collect();
        let mut spans = self.loops.iter().map(|index| {
            let closed = &loops[*index];
            (closed.span.clone(), counted(closed.closure.equations(), "equation"))
        });
        let (span, label) = spans.next().unwrap_or_default();
        let message = format!("{of} for {}: {verdict}", counted(needed, "passive variable"));
        let mistake = Diagnostic::new(span, message).label(format!("{label}; passive: {}", first(&names)));
        spans.fold(mistake, |mistake, (span, label)| mistake.context(span, label)).help(help)
    }
}

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
        let (symbol, name) = match deviation.number {
            ChainNumber::Joint(joint) => (Symbol::Variable(joint), &declarations.variables[joint].name),
            ChainNumber::Parameter(parameter) => {
                (Symbol::Parameter(parameter), &declarations.parameters[parameter].name)
            }
            ChainNumber::DenavitHartenberg { .. } => continue,
        };
        let lengths = tree.loops.iter().filter(|closed| {
            closed.closure.length().is_some_and(|length| length.symbols().any(|used| used == symbol))
        });
        for closed in lengths.filter(|closed| tree.own_end(closed).is_none()) {
            document.mistake(without_end(tree, closed, name, deviation.span.clone()));
        }
        // An error of the tool acts as one of the frame that carries it, which would move the loop.
        let carried = |end: Option<usize>| end.is_some_and(|end| tree.carries(tree.tool_frame, end));
        let in_tool = tool.iter().flat_map(Factor::expressions).any(|e| e.symbols().any(|s| s == symbol));
        let ending = tree.loops.iter().find(|closed| closed.frames.into_iter().any(carried));
        if let Some(closed) = ending.filter(|_| in_tool) {
            document.mistake(in_tool_of_loop(tree, closed, name, deviation.span.clone()));
        }
    }
}

fn in_tool_of_loop(tree: Tree<'_>, closed: &Loop, name: &str, span: Span) -> Diagnostic {
    let carrier = &tree.frames[tree.tool_frame].name;
    Diagnostic::new(span, format!("the error of `{name}` needs a frame for the tool alone"))
        .label("an error of the tool's transform")
        .context(closed.span.clone(), format!("\"{carrier}\", which carries the tool, carries this loop too"))
        .help(format!(
            "add a [[frame]] for the tool, parent = \"{carrier}\", transform = \"Tx(0)\", and name it in [tool] frame"
        ))
}

fn without_end(tree: Tree<'_>, closed: &Loop, name: &str, span: Span) -> Diagnostic {
    let end = closed.frames.into_iter().flatten().next().map_or("base", |frame| &tree.frames[frame].name);
    Diagnostic::new(
        span,
        format!("the error of `{name}` needs an end of the leg \"{}\" that moves alone", closed.name),
    )
    .label("an error of its length")
    .context(closed.span.clone(), "its ends carry other frames, loops or the tool")
    .help(format!(
        "add a [[frame]] for its end, parent = \"{end}\", transform = \"Tx(0)\", and name it in `frames` instead of \"{end}\""
    ))
}
