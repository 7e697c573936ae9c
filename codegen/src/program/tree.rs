//! The functions of a tree of frames: they find the passive variables first.

use abbe_core::{Function, function::Count};
use abbe_spec::Symbol;

use super::{Array, ArrayRows, Block, Operand, Program, Repeated, Role, Rounded, Stage};
use crate::chain::{ClosedLoops, Model, Path, RealNodes, STEPS};
use crate::graph::{Graph, Node};

/// Builder of the stages of a function.
pub(super) struct LoopRoutineBuilder<'d> {
    model: &'d Model,
    loops: &'d ClosedLoops,
    arrays: &'d mut Vec<Array>,
    stages: Vec<Stage>,
}

impl<'d> LoopRoutineBuilder<'d> {
    /// Creates a draft without stages of a function with these arguments and results.
    pub(super) fn new(model: &'d Model, loops: &'d ClosedLoops, arrays: &'d mut Vec<Array>) -> Self {
        Self { model, loops, arrays, stages: Vec::new() }
    }

    /// Returns the stages of a function that needs more than a program at the nominal passive
    /// variables; `None` for the others.
    pub(super) fn own_stages(mut self, function: Function) -> Option<Vec<Stage>> {
        let loops = self.loops;
        if loops.passive_home.is_empty() {
            return None;
        }
        let is_pose = |real: &RealNodes| real.pose == self.model.tool && !real.moves_passive(loops);
        match function {
            Function::Passive => self.passive(),
            Function::RealPose if !is_pose(&loops.real) => self.real_pose(&loops.real),
            Function::DrawnPose if !is_pose(&loops.drawn) => self.real_pose(&loops.drawn),
            Function::DisplacedPose => self.real_pose(&loops.displaced),
            _ => return None,
        }
        Some(self.stages)
    }

    /// Returns the stages that write rows by a program at the nominal passive variables.
    pub(super) fn at_once(mut self, program: Program, writes: Vec<ArrayRows>) -> Vec<Stage> {
        let reads = if program.operands().any(|operand| matches!(operand, Operand::Symbol(Symbol::Local(_))))
        {
            vec![ArrayRows::all(self.nominal())]
        } else {
            Vec::new()
        };
        self.stages.push(Stage::Block(Block { reads, program, writes, repeated: None }));
        self.stages
    }

    /// Computes the passive variables of the nominal machine, and returns their array.
    fn nominal(&mut self) -> usize {
        let passive = self.local("passive", Count::Passive);
        let arrays = vec![self.array("q"), self.array("s"), passive];
        self.stages.push(Stage::Call { routine: Function::Passive.name(), arrays });
        passive
    }

    fn array(&self, name: &str) -> usize {
        self.arrays.iter().position(|array| array.name == name).expect("the signature has it")
    }

    fn local(&mut self, name: &'static str, count: Count) -> usize {
        self.arrays.push(Array { name, shape: vec![count], role: Role::Zeros });
        self.arrays.len() - 1
    }

    fn block(&mut self, reads: &[usize], writes: &[usize], program: Program, while_positive: Option<usize>) {
        let rows = |arrays: &[usize]| arrays.iter().copied().map(ArrayRows::all).collect();
        let count = Count::Exactly(STEPS);
        let repeated = while_positive.map(|_| Repeated { count, backwards: false, while_positive });
        let (reads, writes) = (rows(reads), rows(writes));
        self.stages.push(Stage::Block(Block { reads, program, writes, repeated }));
    }

    /// Computes the passive variables on the path from home.
    fn passive(&mut self) {
        let ClosedLoops { passive_home, .. } = self.loops;
        let passive = self.array("passive");
        let mut graph = Graph::new();
        let start: Vec<Node> = passive_home.iter().map(|value| graph.constant(*value)).collect();
        self.block(&[], &[passive], Program::new(&graph, &start), None);
        self.follow(&Path::nominal(&self.model.graph, self.loops), passive, None);
    }

    /// Computes a pose with errors: the passive variables on the path from their nominal values,
    /// and then the pose.
    fn real_pose(&mut self, real: &RealNodes) {
        let graph = &self.model.graph;
        let nominal = self.nominal();
        let errors = (!real.errors.is_empty()).then(|| {
            let errors = self.local("source_errors", Count::Exactly(real.errors.len()));
            self.block(&[nominal], &[errors], Program::new(graph, &real.errors), None);
            errors
        });
        let passive = self.local("real_passive", Count::Passive);
        self.stages.push(Stage::Copy { from: ArrayRows::all(nominal), to: passive });
        self.follow(&Path::with_errors(graph, self.loops, real), passive, errors);
        let reads: Vec<usize> = [passive].into_iter().chain(errors).collect();
        let results = [self.array("pose")];
        self.block(&reads, &results, Program::new(graph, &real.pose.entries()), None);
    }

    /// Follows a path from the passive variables of an array, which is filled with those at its
    /// end.
    fn follow(&mut self, path: &Path, passive: usize, errors: Option<usize>) {
        let reached = self.local("reached", Count::Passive);
        let state = self.local("path", Count::Exactly(path.start.len()));
        self.stages.push(Stage::Copy { from: ArrayRows::all(passive), to: reached });
        self.block(&[passive], &[state], Program::new(&path.graph, &path.start), None);
        let writes = [passive, reached, state];
        let reads: Vec<usize> = [passive].into_iter().chain(errors).chain([reached, state]).collect();
        self.block(&reads, &writes, Program::new(&path.graph, &path.advance), Some(state));
        self.block(&reads, &writes[..1], Program::new(&path.graph, &path.finish), None);
    }
}

/// Returns the local symbols that the outputs of a function read, with bounds of their rounding
/// errors: the passive variables, nominal or with errors, and the errors. Empty for a chain.
pub fn locals(function: Function, model: &Model, symbol: impl Fn(Symbol) -> f64, unit: f64) -> Vec<Rounded> {
    let Some(tree) = model.loops.as_ref().filter(|tree| !tree.passive_home.is_empty()) else {
        return Vec::new();
    };
    let graph = &model.graph;
    let p = Path::nominal(graph, tree).run(&tree.passive_home, &[], &symbol);
    let nominal = rounded_step(graph, &tree.nominal.step, &p, &[], &symbol, unit);
    let real = match function {
        Function::RealPose => &tree.real,
        Function::DrawnPose => &tree.drawn,
        Function::DisplacedPose => &tree.displaced,
        _ => return nominal,
    };
    let errors = Program::new(graph, &real.errors).rounded(
        graph.tables(),
        |given| rounded_symbol(given, &nominal, &symbol, unit),
        unit,
    );
    let values: Vec<f64> = errors.iter().map(|error| error.value).collect();
    let p = Path::with_errors(graph, tree, real).run(&p, &values, &symbol);
    let passive = rounded_step(graph, &real.system.step, &p, &errors, &symbol, unit);
    passive.into_iter().chain(errors).collect()
}

/// Returns passive variables after Newton's step from exact values, with the bound of its rounding
/// errors: what earlier steps leave does not matter.
fn rounded_step(
    graph: &Graph,
    step: &[Node],
    p: &[f64],
    errors: &[Rounded],
    symbol: &dyn Fn(Symbol) -> f64,
    unit: f64,
) -> Vec<Rounded> {
    let exact: Vec<Rounded> = p.iter().map(|value| Rounded::exact(*value, unit)).collect();
    let locals: Vec<Rounded> = exact.iter().chain(errors).copied().collect();
    let mut graph = graph.clone();
    let passive: Vec<Node> = (0..step.len()).map(|i| graph.symbol(Symbol::Local(i))).collect();
    let outputs: Vec<Node> = passive.iter().zip(step).map(|(value, step)| graph.sub(*value, *step)).collect();
    let program = Program::new(&graph, &outputs);
    program.rounded(graph.tables(), |given| rounded_symbol(given, &locals, symbol, unit), unit)
}

fn rounded_symbol(given: Symbol, locals: &[Rounded], symbol: &dyn Fn(Symbol) -> f64, unit: f64) -> Rounded {
    match given {
        Symbol::Local(i) => locals.get(i).copied().unwrap_or(Rounded::exact(f64::NAN, unit)),
        given => Rounded::exact(symbol(given), unit),
    }
}
