//! The functions of a manipulator as routines.

use std::sync::Arc;

use abbe_core::function::{COMMANDS, COMPENSATED, Count, Signature};
use abbe_core::{Description, Function, Orientation};
use abbe_spec::{Spec, Table as LookupTable};

use super::description::description;
use super::loops::FrameLoops;
use super::outputs::{Outputs, alternatives, fewest};
use super::select::Selections;
use super::tree::LoopRoutineBuilder;
use super::{Action, Array, ArrayRows, Block, Operations, Program, Role, Routine, Row, Stage, Sums, Table};
use crate::chain::{EffectNode, Model, is_long};

/// The functions of a manipulator and their shared data.
#[derive(Clone, Debug, PartialEq)]
pub struct Routines {
    /// Description of the manipulator, which also gives the sizes of arrays.
    pub description: Description,
    /// The functions in the order of [`Function::all`], then the helpers.
    pub list: Vec<Routine>,
    /// Names of the functions that users call, those of corrected commands among them. Others are
    /// there because these call them.
    pub exported: Vec<&'static str>,
    /// Tables that loops use.
    pub tables: Vec<Table>,
    /// Sums that loops use.
    pub sums: Vec<Sums>,
    /// Lookup tables of the spec.
    pub lookup_tables: Vec<Arc<LookupTable>>,
}

impl Routines {
    /// Builds the routines of all functions. A function that gives the same results as an earlier
    /// one calls it; functions of long chains are loops; the others are straight-line programs.
    pub fn new(spec: &Spec, model: &Model) -> Self {
        Self::with(spec, model, is_long(spec).then(|| FrameLoops::new(spec, model)))
    }

    /// Builds the routines without loops for any length of the chain, for checks of the loops.
    pub fn without_loops(spec: &Spec, model: &Model) -> Self {
        Self::with(spec, model, None)
    }

    fn with(spec: &Spec, model: &Model, mut loops: Option<FrameLoops<'_>>) -> Self {
        let description = description(spec, model.effects.iter().map(EffectNode::effect), model.solutions());
        let mut list: Vec<Routine> = Vec::new();
        let mut selections = Selections::default();
        let mut known: Vec<(Function, Outputs)> = Vec::new();
        for function in Function::all(&description) {
            let signature = function.signature();
            let mut arrays = arguments_and_results(signature, spec.orientation);
            let own = model
                .loops
                .as_ref()
                .and_then(|tree| LoopRoutineBuilder::new(model, tree, &mut arrays).own_stages(function));
            let same = |outputs: &Outputs| {
                // The distinct entries of a tree are all entries, in an array of another shape.
                if function == Function::ErrorJacobianDistinct {
                    return None;
                }
                let (other, _) =
                    known.iter().find(|(other, its)| is_same(*other, its, signature, outputs))?;
                Some(as_other(*other, &arrays, &description))
            };
            let alternatives = alternatives(function, model);
            // A function with a single form that equals another function needs no program of its
            // own. Errors that move passive variables change the pose, not its nodes.
            let is_moved = function == Function::CompensatorStep
                && model.loops.as_ref().is_some_and(|tree| tree.real.moves_passive(tree));
            let only = if let [only] = &alternatives[..] { same(only).filter(|_| !is_moved) } else { None };
            let stages = if let Some(stages) = own {
                stages
            } else if let (Function::CompensatorStep, Some(_), None) = (function, &only, &loops) {
                // If no errors are to be corrected, the pose has the same bits as `pose`, and the
                // correction is 0.
                let Outputs { results, .. } = &alternatives[0];
                let (graph, all) = (&model.graph, results.concat());
                let selection = selections.after(graph, &results[0], &all);
                let program = Program::from_selection(graph, &all, selection);
                at_once(model, &mut arrays, program)
            } else if let Some(call) = only {
                vec![call]
            } else if loops.is_none() && function == Function::CompensatorStep {
                compensator_step(model, &mut arrays, &description)
            } else {
                let (outputs, program) = fewest(alternatives, model, &mut selections);
                let stages = if let Some(call) = same(&outputs) {
                    vec![call]
                } else {
                    let looped = loops.as_mut().filter(|_| program.steps.len() > spec.frames.len());
                    let looped = looped.and_then(|loops| loops.stages(function, &mut arrays));
                    looped.unwrap_or_else(|| at_once(model, &mut arrays, program))
                };
                known.push((function, outputs));
                stages
            };
            let operations = Operations::default();
            let Signature { name, documentation, .. } = *signature;
            list.push(Routine { function: Some(function), name, documentation, arrays, stages, operations });
        }
        let (helpers, tables, sums) = loops.map_or_else(Default::default, FrameLoops::finish);
        list.extend(helpers);
        let lookup_tables = spec.tables.clone();
        let commands = COMMANDS.into_iter().filter(|_| !description.variables.is_empty());
        let exported = Function::all(&description).map(Function::signature).chain(commands);
        let exported = exported.map(|signature| signature.name).collect();
        let mut routines = Self { description, list, exported, tables, sums, lookup_tables };
        for index in 0..routines.list.len() {
            routines.list[index].operations = routines.operations(&routines.list[index]);
        }
        routines
    }

    /// Keeps the functions with these names and what they call.
    #[must_use]
    pub fn only(mut self, exported: &[&'static str]) -> Self {
        let mut needed = exported.to_vec();
        if COMMANDS.iter().any(|signature| exported.contains(&signature.name)) {
            needed.extend([Function::Pose, Function::CompensatorStep].map(Function::name));
        }
        let mut next = 0;
        while let Some(name) = needed.get(next).copied() {
            next += 1;
            let stages = self.list.iter().filter(|routine| routine.name == name).flat_map(|r| &r.stages);
            needed.extend(stages.filter_map(|stage| match stage {
                Stage::Call { routine, .. } => Some(*routine),
                _ => None,
            }));
        }
        self.list.retain(|routine| needed.contains(&routine.name));
        self.exported.retain(|name| exported.contains(name));
        self
    }

    /// Returns the names of the exported functions that have results.
    pub fn selectable(&self) -> Vec<&'static str> {
        let has_results = |signature: &&Signature| {
            let mut results = signature.results.iter();
            results.all(|array| !array.is_empty(&self.description))
        };
        self.signatures().filter(has_results).map(|signature| signature.name).collect()
    }

    /// Returns the names of the selectable functions that depend on what the manipulator has:
    /// without sources, none that take inputs.
    pub fn meaningful(&self) -> Vec<&'static str> {
        let takes_inputs = |signature: &&Signature| signature.arguments.iter().any(|array| array.name == "u");
        let without = self.signatures().filter(takes_inputs).map(|signature| signature.name);
        let without: Vec<_> = without.filter(|_| self.description.sources.is_empty()).collect();
        self.selectable().into_iter().filter(|name| !without.contains(name)).collect()
    }

    /// Iterates over the signatures of the exported functions, in their order.
    pub fn signatures(&self) -> impl Iterator<Item = &'static Signature> {
        let all = Function::all(&self.description).map(Function::signature).chain(COMMANDS);
        all.filter(|signature| self.exported.contains(&signature.name))
    }

    /// Returns `true` if users call the routine.
    pub fn exports(&self, routine: &Routine) -> bool {
        self.exported.contains(&routine.name)
    }

    /// Returns `true` if there are corrected commands.
    pub fn has_compensated(&self) -> bool {
        self.exported.contains(&COMPENSATED.name)
    }

    /// Returns `true` if there are corrected commands, or the function that begins with them.
    pub fn has_commands(&self) -> bool {
        COMMANDS.iter().any(|signature| self.exported.contains(&signature.name))
    }

    /// Returns the routine with this name.
    pub fn named(&self, name: &str) -> &Routine {
        self.list.iter().find(|routine| routine.name == name).expect("what is called is there")
    }

    /// Returns the routine of a function.
    pub fn function(&self, function: Function) -> &Routine {
        self.named(function.name())
    }

    /// Iterates over the tables that loops use.
    pub fn used_tables(&self) -> impl Iterator<Item = &Table> {
        let lists = |stage: &Stage, index: usize| match stage {
            Stage::Block(block) => block
                .reads
                .iter()
                .chain(&block.writes)
                .any(|place| matches!(place.row, Row::Listed { table, .. } if table == index)),
            _ => false,
        };
        let is_used = move |index| self.stages().any(|stage| lists(stage, index));
        self.tables.iter().enumerate().filter(move |(index, _)| is_used(*index)).map(|(_, table)| table)
    }

    /// Iterates over the sums that routines use.
    pub fn used_sums(&self) -> impl Iterator<Item = &Sums> {
        let is_used =
            |index| self.stages().any(|stage| matches!(stage, Stage::Sums { sums, .. } if *sums == index));
        self.sums.iter().enumerate().filter(move |(index, _)| is_used(*index)).map(|(_, sums)| sums)
    }

    /// Iterates over the lookup tables that routines use.
    pub fn used_lookup_tables(&self) -> impl Iterator<Item = &Arc<LookupTable>> {
        let is_used = |index| {
            let actions = self.programs().flat_map(|program| program.steps.iter().map(|step| step.action));
            actions.into_iter().any(
                |action| matches!(action, Action::Lookup(lookup, _) if usize::from(lookup.table) == index),
            )
        };
        self.lookup_tables.iter().enumerate().filter(move |(k, _)| is_used(*k)).map(|(_, table)| table)
    }

    /// Iterates over the programs of all routines.
    pub fn programs(&self) -> impl Iterator<Item = &Program> {
        self.list.iter().flat_map(Routine::programs)
    }

    fn stages(&self) -> impl Iterator<Item = &Stage> {
        self.list.iter().flat_map(|routine| &routine.stages)
    }

    /// Returns the operations of one call of a routine, including the routines it calls.
    fn operations(&self, routine: &Routine) -> Operations {
        let stage = |stage: &Stage| match stage {
            Stage::Block(Block { program, repeated, .. }) => program
                .operations()
                .times(repeated.map_or(1, |repeated| repeated.count.value(&self.description))),
            Stage::Call { routine, .. } => self.operations(self.named(routine)),
            Stage::Sums { sums, .. } => {
                let count = self.sums[*sums].factors.len();
                Operations { mul: count, add: count, ..Operations::default() }
            }
            Stage::Clear(_) | Stage::Copy { .. } => Operations::default(),
        };
        routine.stages.iter().map(stage).fold(Operations::default(), Operations::plus)
    }
}

/// Returns the arrays of a signature, in its order, and the margin.
fn arguments_and_results(signature: &Signature, orientation: Orientation) -> Vec<Array> {
    let array = |role| {
        move |array: &abbe_core::function::Array| Array {
            name: array.name,
            shape: array.shape.to_vec(),
            role,
        }
    };
    let arguments = signature.arguments.iter().map(array(Role::Argument));
    let results = signature.results.iter().map(array(Role::Result));
    let margin = Array { name: "margin", shape: vec![Count::Exactly(1)], role: Role::Margin };
    arguments.chain(results).chain(signature.has_margin(orientation).then_some(margin)).collect()
}

/// Returns the stages with a program that fills all results.
pub(super) fn at_once(model: &Model, arrays: &mut Vec<Array>, program: Program) -> Vec<Stage> {
    let results = (0..arrays.len()).filter(|array| arrays[*array].role != Role::Argument).collect();
    filled(model, arrays, program, results)
}

/// Returns the stages with a program that fills some results.
fn filled(model: &Model, arrays: &mut Vec<Array>, program: Program, results: Vec<usize>) -> Vec<Stage> {
    let writes = results.into_iter().map(ArrayRows::all).collect();
    match &model.loops {
        Some(tree) => LoopRoutineBuilder::new(model, tree, arrays).at_once(program, writes),
        None => vec![Stage::Block(Block { reads: vec![], program, writes, repeated: None })],
    }
}

/// Returns the stages for the real pose and for the nominal twists of the joints, which share
/// almost no operations.
fn compensator_step(model: &Model, arrays: &mut Vec<Array>, description: &Description) -> Vec<Stage> {
    let is_columns = |array: &Array| array.name == "columns";
    let (columns, others): (Vec<_>, Vec<_>) =
        (0..arrays.len()).partition(|index| is_columns(&arrays[*index]));
    let mut stages = vec![Stage::Call { routine: Function::RealPose.name(), arrays: others }];
    let columns: Vec<usize> =
        columns.into_iter().filter(|array| !arrays[*array].is_empty(description)).collect();
    for array in columns {
        let program = Program::new(&model.graph, &model.joint_twists.concat());
        stages.extend(filled(model, arrays, program, vec![array]));
    }
    stages
}

/// Returns `true` if an earlier function takes no other arguments and returns the same nonempty
/// results.
fn is_same(other: Function, found: &Outputs, signature: &Signature, outputs: &Outputs) -> bool {
    let some = |signature: &Signature, outputs: &Outputs| -> Vec<_> {
        let results = signature.results.iter().zip(&outputs.results);
        let some = results.filter(|(_, nodes)| !nodes.is_empty());
        some.map(|(array, nodes)| (array.quantity, nodes.clone())).collect()
    };
    let takes = other.signature().arguments;
    found.margin == outputs.margin
        && some(other.signature(), found) == some(signature, outputs)
        && found.results.iter().all(|result| !result.is_empty())
        && takes.iter().all(|array| signature.arguments.contains(array))
}

/// Returns a call of the other function.
fn as_other(other: Function, arrays: &[Array], description: &Description) -> Stage {
    let signature = other.signature();
    let given = signature.arguments.iter().map(|wanted| {
        arrays.iter().position(|array| array.name == wanted.name).expect("it takes no more than this one")
    });
    let filled = arrays.iter().enumerate().filter(|(_, array)| array.role != Role::Argument);
    let filled = filled.filter(|(_, array)| array.len(description) > 0).map(|(index, _)| index);
    Stage::Call { routine: signature.name, arrays: given.chain(filled).collect() }
}
