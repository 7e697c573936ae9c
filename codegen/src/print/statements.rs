//! Converts a routine to language-independent statements, and finds which of its arrays it uses.

use std::collections::HashSet;

use abbe_core::{Description, function::Count};
use abbe_spec::{Spec, Symbol};

use super::{Flat, Names, Statement, Syntax, Value, body::body};
use crate::program::{ArrayRows, Block, Operand, Program, Role, Routine, Routines, Row, Stage};

/// The statements of a routine.
pub(super) struct Statements {
    pub(super) list: Vec<Statement>,
    /// Arrays that the routine uses.
    pub(super) used: Vec<bool>,
    /// `true` if 0 and 1 are results.
    pub(super) constants: [bool; 2],
}

impl Statements {
    pub(super) fn new(spec: &Spec, flat: Flat<'_>, syntax: &dyn Syntax) -> Self {
        Self::with(spec, flat, syntax, false)
    }

    /// Converts a routine, and prints the columns of `J_e` part by part for a consumer that takes
    /// them one by one.
    pub(super) fn by_columns(spec: &Spec, flat: Flat<'_>, syntax: &dyn Syntax) -> Self {
        Self::with(spec, flat, syntax, true)
    }

    fn with(spec: &Spec, flat: Flat<'_>, syntax: &dyn Syntax, by_columns: bool) -> Self {
        let Flat { routines: Routines { description, .. }, routine } = flat;
        let names = Names::new(spec, routine, &syntax.reserved(), syntax.identifiers());
        let mut writer = Writer {
            routine,
            description,
            syntax,
            names,
            outermost: None,
            begun: routine.arrays.iter().map(|array| array.role == Role::Argument).collect(),
            whole: Vec::new(),
            constants: [false; 2],
            margin: None,
            by_columns,
        };
        let symbols = routine.programs().flat_map(used_symbols).collect();
        let mut list = writer.arguments(&symbols);
        let is_loop = |stage: &Stage| matches!(stage, Stage::Block(Block { repeated: Some(_), .. }));
        if routine.stages.iter().any(is_loop) {
            writer.outermost = Some(writer.names.clone());
        }
        for stage in &routine.stages {
            writer.stage(stage, &mut list);
        }
        if let Some(margin) = writer.margin.take() {
            // A name that would only be returned is replaced by its value.
            let named = |last: &mut Statement| matches!(last, Statement::Let { name, .. } if *name == margin);
            let value = match list.pop_if(named) {
                Some(Statement::Let { value, .. }) => value,
                _ => margin,
            };
            list.push(Statement::Return(value));
        }
        let used =
            (0..routine.arrays.len()).map(|array| uses(routine, &symbols, description, array)).collect();
        Self { list, used, constants: writer.constants }
    }
}

struct Writer<'w> {
    routine: &'w Routine,
    description: &'w Description,
    syntax: &'w dyn Syntax,
    names: Names<'w>,
    /// Names of the arguments only, with which every loop starts.
    outermost: Option<Names<'w>>,
    /// Arrays that have been declared.
    begun: Vec<bool>,
    /// Arrays that the current block fills completely at their declaration.
    whole: Vec<usize>,
    constants: [bool; 2],
    margin: Option<String>,
    by_columns: bool,
}

impl Writer<'_> {
    /// Binds names to the elements of the arguments that programs use as symbols.
    fn arguments(&mut self, used: &HashSet<Symbol>) -> Vec<Statement> {
        let mut statements = Vec::new();
        for (array, argument) in self.routine.arrays.iter().enumerate() {
            let Some(symbol) = symbol_of(argument.name).filter(|_| argument.role == Role::Argument) else {
                continue;
            };
            let symbols: Vec<Symbol> = (0..argument.len(self.description)).map(symbol).collect();
            let is_used = symbols.iter().any(|symbol| used.contains(symbol));
            if is_used || !matches!(symbols[..], [Symbol::Error(_), ..]) {
                self.names.name_entries(argument.name, &symbols);
            }
            if is_used {
                let name = |symbol| used.contains(symbol).then(|| self.names.symbol(*symbol).to_owned());
                let names = symbols.iter().map(name).collect();
                statements.push(Statement::Unpack { names, from: ArrayRows { array, row: Row::All } });
            }
        }
        statements
    }

    /// Returns the arrays that have not been declared, and marks them as declared.
    fn begin(&mut self, arrays: impl Iterator<Item = usize>) -> Vec<usize> {
        let margin = |array: usize| self.routine.arrays[array].role == Role::Margin;
        let empty = |array: usize| self.routine.arrays[array].len(self.description) == 0;
        let mut fresh: Vec<usize> = Vec::new();
        for array in arrays.filter(|array| !margin(*array) && !empty(*array)) {
            if !std::mem::replace(&mut self.begun[array], true) {
                fresh.push(array);
            }
        }
        fresh
    }

    fn declare(&mut self, arrays: Vec<usize>, statements: &mut Vec<Statement>) {
        self.take_zeros(&arrays);
        statements.extend(arrays.into_iter().map(Statement::Declare));
    }

    /// Marks 0 as used if a local array is initialized with zeros.
    fn take_zeros(&mut self, arrays: &[usize]) {
        self.constants[0] |= arrays.iter().any(|array| self.routine.arrays[*array].role == Role::Zeros);
    }

    fn stage(&mut self, stage: &Stage, statements: &mut Vec<Statement>) {
        match stage {
            Stage::Block(block) => {
                let fresh = self.begin(block.reads.iter().chain(&block.writes).map(|place| place.array));
                let (whole, others): (Vec<_>, Vec<_>) =
                    fresh.into_iter().partition(|array| self.is_filled_at_once(block, *array));
                self.whole = whole;
                self.declare(others, statements);
                match block.repeated {
                    None => self.block(block, statements),
                    Some(repeated) => {
                        // A loop is a scope of its own and may reuse names.
                        let mut names = self.outermost.clone().unwrap_or_else(|| self.names.clone());
                        self.read_before(block, &mut names, statements);
                        let names = std::mem::replace(&mut self.names, names);
                        let mut body = Vec::new();
                        self.block(block, &mut body);
                        self.names = names;
                        statements.push(Statement::For { repeated, body });
                    }
                }
            }
            Stage::Call { routine, arrays } => {
                let fresh = self.begin(arrays.iter().copied());
                self.take_zeros(&fresh);
                let margin = arrays.iter().find(|array| self.routine.arrays[**array].role == Role::Margin);
                self.margin = margin.map(|_| "margin".to_owned()).or(self.margin.take());
                statements.push(Statement::Call { routine, arrays: arrays.clone(), fresh });
            }
            Stage::Sums { sums, terms, entries } => {
                let fresh = self.begin([*entries].into_iter());
                self.declare(fresh, statements);
                statements.push(Statement::Sums { sums: *sums, terms: *terms, entries: *entries });
            }
            Stage::Copy { from, to } => {
                let fresh = self.begin([*to].into_iter()).into_iter();
                let (local, others): (Vec<_>, _) =
                    fresh.partition(|array| self.routine.arrays[*array].role == Role::Zeros);
                self.declare(others, statements);
                statements.push(Statement::Copy { from: *from, to: *to, fresh: !local.is_empty() });
            }
            // An empty array needs no clearing.
            Stage::Clear(array) if self.routine.arrays[*array].is_empty(self.description) => {}
            Stage::Clear(array) => {
                let fresh = self.begin([*array].into_iter());
                self.declare(fresh, statements);
                self.constants[0] = true;
                statements.push(Statement::Clear(*array));
            }
        }
    }

    /// Returns `true` if a block writes a local array completely, so that the array needs no
    /// initial zeros.
    fn is_filled_at_once(&self, block: &Block, array: usize) -> bool {
        let place = ArrayRows { array, row: Row::All };
        let declared = &self.routine.arrays[array];
        declared.role == Role::Zeros
            && declared.shape.len() == declared.row_rank()
            && block.repeated.is_none()
            && block.writes.contains(&place)
    }

    /// Returns the frame that a row of a result belongs to.
    fn frame_of(&self, place: &ArrayRows, index: usize, rows: usize) -> Option<usize> {
        let array = &self.routine.arrays[place.array];
        let by_frames = matches!(array.shape[0], Count::Frames | Count::Errors) && array.shape.len() > 1;
        (by_frames && place.row == Row::All).then(|| index / (rows / self.description.frames.len()))
    }

    fn comment(&self, frame: usize) -> Statement {
        let name = self.description.frames[frame].name.trim();
        Statement::Comment(format!("Frame {}: {name}", frame + 1))
    }

    /// Returns the places that a block reads, the first local symbol of each, and which of its
    /// elements are used.
    fn reads<'b>(&self, block: &'b Block) -> Vec<(&'b ArrayRows, usize, Vec<bool>)> {
        // A block without reads has no local symbols.
        let used = if block.reads.is_empty() { HashSet::new() } else { used_symbols(&block.program) };
        let mut first = 0;
        let mut read = |place: &'b ArrayRows| {
            let next = first + self.routine.arrays[place.array].place_len(place.row, self.description);
            let taken = (first..next).map(|local| used.contains(&Symbol::Local(local))).collect();
            (place, std::mem::replace(&mut first, next), taken)
        };
        block.reads.iter().map(&mut read).collect()
    }

    /// Reads loop invariants before the loop, with names that are free inside and outside of it.
    fn read_before(&mut self, block: &Block, names: &mut Names<'_>, statements: &mut Vec<Statement>) {
        names.forget_locals();
        for (place, first, taken) in
            self.reads(block).into_iter().filter(|(place, ..)| block.is_constant(place))
        {
            let free = self.names.name_locals(&self.routine.arrays[place.array], first, &taken);
            names.take_locals(first, &free);
            if taken.contains(&true) {
                statements.push(Statement::Unpack { names: free, from: *place });
            }
        }
    }

    fn block(&mut self, block: &Block, statements: &mut Vec<Statement>) {
        if block.repeated.is_none() {
            self.names.forget_locals();
        }
        for (place, first, taken) in
            self.reads(block).into_iter().filter(|(place, ..)| !block.is_constant(place))
        {
            let names = self.names.name_locals(&self.routine.arrays[place.array], first, &taken);
            if taken.contains(&true) {
                statements.push(Statement::Unpack { names, from: *place });
            }
        }
        for (constant, value) in self.constants.iter_mut().zip([0.0, 1.0]) {
            *constant |= block.program.outputs.contains(&Operand::Constant(value));
        }
        let (body, values) = body(&block.program, &mut self.names, self.syntax);
        let mut values = values.into_iter();
        let mut assignments: Vec<Assignment> = Vec::new();
        for place in &block.writes {
            let array = &self.routine.arrays[place.array];
            if array.role == Role::Margin {
                self.margin = values.next().map(|value| value.text);
                continue;
            }
            let row = array.row_len(self.description);
            let rows = match place.row {
                // A one-row array has one row even if it is empty.
                Row::All if array.shape.len() == array.row_rank() => 1,
                Row::All => array.len(self.description) / row,
                _ => 1,
            };
            let fresh = self.whole.contains(&place.array);
            for index in 0..rows {
                let values: Vec<Value> = values.by_ref().take(row).collect();
                let frame = self.frame_of(place, index, rows);
                let mut assign = |values: Vec<Value>, statement: &dyn Fn(Vec<Value>) -> Statement| {
                    let ready = values.iter().map(|value| value.ready).max().unwrap_or(0);
                    assignments.push(Assignment { ready, frame, statement: statement(values) });
                };
                if self.by_columns && array.name == "columns" {
                    for (part, values) in parts(index, values) {
                        assign(values, &|values| Statement::Column { index, part, values });
                    }
                } else {
                    assign(values, &|values| Statement::Assign { to: *place, index, values, fresh });
                }
            }
        }
        // Outside loops, assign values as soon as they are known so that they need not be kept; in
        // a loop, after all computations.
        if block.repeated.is_some() {
            assignments.iter_mut().for_each(|assignment| assignment.ready = body.len());
        }
        assignments.sort_by_key(|assignment| assignment.ready);
        let mut assignments = assignments.into_iter().peekable();
        let mut frame = None;
        let mut body = body.into_iter();
        for count in 0..=body.len() {
            statements.extend(count.checked_sub(1).and_then(|_| body.next()));
            while let Some(assignment) = assignments.next_if(|assignment| assignment.ready == count) {
                if assignment.frame.is_some() && assignment.frame != frame {
                    statements.extend(assignment.frame.map(|frame| self.comment(frame)));
                    frame = assignment.frame;
                }
                statements.push(assignment.statement);
            }
        }
    }
}

/// Splits a column of `J_e` into parts that become known at different times.
fn parts(index: usize, mut column: Vec<Value>) -> Vec<(&'static str, Vec<Value>)> {
    let rows = column.split_off(3);
    match index % 6 {
        // Translations cause no rotation.
        0..3 => vec![("along", column)],
        _ => vec![("moment", column), ("turn", rows)],
    }
}

/// A statement that writes a row.
struct Assignment {
    /// Number of statements after which its values are known.
    ready: usize,
    /// The frame that the row belongs to.
    frame: Option<usize>,
    statement: Statement,
}

fn used_symbols(program: &Program) -> HashSet<Symbol> {
    let symbol = |operand| match operand {
        Operand::Symbol(symbol) => Some(symbol),
        _ => None,
    };
    program.operands().filter_map(symbol).collect()
}

/// Returns the symbol of each entry of an array, if programs use the entries as symbols.
fn symbol_of(array: &str) -> Option<fn(usize) -> Symbol> {
    Some(match array {
        "q" => Symbol::Variable,
        "s" => Symbol::Parameter,
        "u" => Symbol::Input,
        "errors" | "variances" => Symbol::Error,
        "magnitudes" => Symbol::Magnitude,
        "target" => Symbol::Target,
        _ => return None,
    })
}

/// Returns `true` if the routine reads or writes an array; `symbols` are those of the routine.
fn uses(routine: &Routine, symbols: &HashSet<Symbol>, description: &Description, array: usize) -> bool {
    let declared = &routine.arrays[array];
    let is_used = |symbol: fn(usize) -> Symbol| {
        (0..declared.len(description)).any(|entry| symbols.contains(&symbol(entry)))
    };
    let as_symbols = symbol_of(declared.name).is_some_and(is_used);
    let some = declared.len(description) > 0 || declared.shape.len() == declared.row_rank();
    let in_stage = |stage: &Stage| match stage {
        Stage::Block(block) => block.reads.iter().chain(&block.writes).any(|place| place.array == array),
        Stage::Call { arrays, .. } => arrays.contains(&array),
        Stage::Sums { terms, entries, .. } => [*terms, *entries].contains(&array),
        Stage::Clear(cleared) => *cleared == array,
        Stage::Copy { from, to } => [from.array, *to].contains(&array),
    };
    as_symbols || some && routine.stages.iter().any(in_stage)
}
