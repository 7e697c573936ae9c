//! Contents of a valid spec, in coherent units: its length unit, kg, s, rad, K.
//!
//! Magnitudes of sources as inputs at run time.
//!
//! Names that a spec declares: parameters, inputs and joint variables.
//!
//! Ranges of joints and inputs over which the errors of an identified machine were fitted.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

use abbe_core::{Class, LengthUnit, Orientation, SumLimit, VariableKind};
use indexmap::IndexSet;

use super::{
    ChainNumber, Covariance, Deviation, Factor, Frame, Load, Loop, Source, Tree, Uncertain, as_identifier,
};
use crate::expr::{Dimension, Expression, Symbol, Table};

/// A manipulator as described by its file.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Name: an identifier in lower snake case.
    pub name: String,
    /// Title for readers.
    pub title: String,
    /// Description.
    pub description: String,
    /// Reference for its numbers.
    pub reference: String,
    /// Unit of every length.
    pub length: LengthUnit,
    /// Representation of rows 4–6 of the Jacobians.
    pub orientation: Orientation,
    /// Structural parameters `s`.
    pub parameters: Vec<Parameter>,
    /// Inputs `u`.
    pub inputs: Vec<Input>,
    /// Joint variables `q`, in the order of the frames that declare them; those of legs follow.
    pub variables: Vec<Variable>,
    /// Passive joint variables `p`, which the loops determine.
    pub passive: Vec<Variable>,
    /// Limits of sums of joint variables.
    pub sum_limits: Vec<SumLimit>,
    /// `A_1 … A_n`, from base to tip; each after the frame that it hangs on.
    pub frames: Vec<Frame>,
    /// Loops of frames.
    pub loops: Vec<Loop>,
    /// Index of the frame that carries the tool.
    pub tool_frame: usize,
    /// `T`, from the frame of the tool to the tool point; empty without a tool.
    pub tool: Vec<Factor>,
    /// Physical errors, including disabled ones.
    pub sources: Vec<Source>,
    /// Loads on the structure.
    pub loads: Vec<Load>,
    /// Acceleration of gravity in `F_0`.
    pub gravity: Option<[Expression; 3]>,
    /// Ranges over which the errors of an identified machine were fitted; empty for others.
    pub fitted: Vec<Fitted>,
    /// Covariance of these errors; empty if they were not identified.
    pub covariance: Covariance,
    /// Functions defined by points.
    pub tables: Vec<Arc<Table>>,
    /// File name without its folder.
    pub file: String,
    /// Files of tables that were read.
    pub beside: Vec<PathBuf>,
    /// SHA-256 of the text of the file and of the files of its tables, in hexadecimal.
    pub hash: String,
}

/// Prefix of the input that is the magnitude of a source.
pub const MAGNITUDE: &str = "magnitude_";

impl Spec {
    /// Returns the joint variables on which each of `A_1 … A_n` and `T` depends.
    pub fn variables_of_transforms(&self) -> Vec<Vec<usize>> {
        let variables = |factors: &Vec<Factor>| {
            let symbols = factors.iter().flat_map(Factor::expressions).flat_map(Expression::symbols);
            let variable = |symbol| match symbol {
                Symbol::Variable(variable) => Some(variable),
                _ => None,
            };
            symbols.filter_map(variable).collect()
        };
        self.frames.iter().map(|frame| &frame.factors).chain([&self.tool]).map(variables).collect()
    }

    /// Returns the frames and loops as a tree.
    pub fn tree(&self) -> Tree<'_> {
        Tree { frames: &self.frames, loops: &self.loops, tool_frame: self.tool_frame }
    }

    /// Returns `true` if the frames are a chain from the base to the tool, without loops.
    pub fn is_serial(&self) -> bool {
        self.tree().is_serial()
    }

    /// Returns the frames from `F_0` to a frame, this one last; none for `F_0` itself.
    pub fn path(&self, frame: Option<usize>) -> Vec<usize> {
        self.tree().path(frame)
    }

    /// Returns `true` if `other` moves with `frame`: that frame itself, or one that hangs on it.
    pub fn carries(&self, frame: usize, other: usize) -> bool {
        self.tree().carries(frame, other)
    }

    /// Returns the end of a loop that belongs to it alone, see [`Tree::own_end`].
    pub fn own_end(&self, closed: &Loop) -> Option<(usize, f64)> {
        self.tree().own_end(closed)
    }

    /// Returns the leg that declares a variable; `None` if a frame does.
    pub fn leg(&self, variable: usize) -> Option<&Loop> {
        if self.frames.iter().any(|frame| frame.variable == Some(variable)) {
            return None;
        }
        let depends = |length: &Expression| length.symbols().any(|used| used == Symbol::Variable(variable));
        self.loops.iter().find(|closed| closed.closure.length().is_some_and(depends))
    }

    /// Returns the number of equations of all loops.
    pub fn equations(&self) -> usize {
        self.loops.iter().map(|closed| closed.closure.equations()).sum()
    }

    /// Returns the lengths of the loops that close by a distance.
    pub fn lengths(&self) -> impl Iterator<Item = &Expression> {
        self.loops.iter().filter_map(|closed| closed.closure.length())
    }

    /// Returns the same manipulator with all tables held at their ends: where corrected commands
    /// exceed the limit of a joint by a micrometre, its errors are those at the limit.
    #[must_use]
    pub fn with_held_tables(&self) -> Self {
        let tables = self.tables.iter().map(|table| Arc::new(table.held())).collect();
        Self { tables, ..self.clone() }
    }

    /// Iterates over the enabled sources, in the order of the file.
    pub fn enabled_sources(&self) -> impl Iterator<Item = &Source> {
        self.sources.iter().filter(|source| source.enabled)
    }

    /// Returns the index of the source of whose error a source is a part: usually its own; that of
    /// the first component of a ball, or of the first part of a calibration.
    pub fn whole(&self, source: usize) -> usize {
        let of = |i: usize| &self.sources[i];
        abbe_core::whole(source, |i| of(i).class, |i| of(i).is_calibration_error())
    }

    /// Iterates over the enabled sources that are no part of the error of an earlier one.
    pub fn whole_sources(&self) -> impl Iterator<Item = &Source> {
        let all = self.sources.iter().enumerate();
        all.filter(|(k, source)| source.enabled && self.whole(*k) == *k).map(|(_, source)| source)
    }

    /// Converts the index of a source to its index among the enabled ones; `None` if it is
    /// disabled.
    pub fn enabled_index(&self, source: usize) -> Option<usize> {
        let before = self.sources.get(..source)?.iter().filter(|source| source.enabled).count();
        self.sources.get(source)?.enabled.then_some(before)
    }

    /// Iterates over the names of the joint variables, the parameters and the inputs, with the
    /// symbol and the dimension of each.
    pub fn symbols(&self) -> impl Iterator<Item = (&str, Symbol, Dimension)> {
        let dimension = |one: &Variable| one.kind.either(Dimension::NONE, Dimension::LENGTH);
        let variables = self.variables.iter().map(move |one| (&one.name, dimension(one)));
        let parameters = self.parameters.iter().map(|one| (&one.name, one.dimension));
        let inputs = self.inputs.iter().map(|one| (&one.name, one.dimension));
        let variables = (0..).map(Symbol::Variable).zip(variables);
        let others = (0..).map(Symbol::Parameter).zip(parameters).chain((0..).map(Symbol::Input).zip(inputs));
        variables.chain(others).map(|(symbol, (name, dimension))| (&name[..], symbol, dimension))
    }

    /// Returns the name of a joint variable, parameter or input; empty for symbols that no spec
    /// declares.
    pub fn name_of(&self, symbol: Symbol) -> &str {
        match symbol {
            Symbol::Variable(i) => &self.variables[i].name,
            Symbol::Passive(i) => &self.passive[i].name,
            Symbol::Parameter(i) => &self.parameters[i].name,
            Symbol::Input(i) => &self.inputs[i].name,
            _ => "",
        }
    }

    /// Returns the location of a source's errors: `joint q2`, `parameter a2`, `dh of elbow`, `frame
    /// elbow`, `input payload`, or several of these; `calibration` for a part of its uncertainty.
    pub fn place(&self, source: &Source) -> String {
        if source.is_calibration_error() {
            return abbe_core::Source::CALIBRATION.to_owned();
        }
        let frame = |frame: usize| self.frames[frame].name.clone();
        let of_chain = |deviation: &Deviation| match deviation.number {
            ChainNumber::Joint(joint) => ("joint", self.variables[joint].name.clone()),
            ChainNumber::Parameter(parameter) => ("parameter", self.parameters[parameter].name.clone()),
            ChainNumber::DenavitHartenberg { frame: of, .. } => ("dh of", frame(of)),
        };
        let frames = source.effects.iter().map(|effect| match effect.is_of_base {
            true => ("frame", "base".to_owned()),
            false => ("frame", frame(effect.frame)),
        });
        let inputs = source.propagated.iter().filter_map(|(uncertain, _)| match uncertain {
            Uncertain::Input(input) => Some(("input", self.inputs[*input].name.clone())),
            Uncertain::Identified(_) => None,
        });
        let places: IndexSet<(&str, String)> =
            source.deviations.iter().map(of_chain).chain(frames).chain(inputs).collect();
        let kinds: IndexSet<&str> = places.iter().map(|(kind, _)| *kind).collect();
        let listed = kinds.into_iter().map(|kind| {
            let names: Vec<&str> =
                places.iter().filter(|place| place.0 == kind).map(|place| place.1.as_str()).collect();
            match (&names[..], kind) {
                ([name], _) => format!("{kind} {name}"),
                ([first, second], "dh of") => format!("dh of {first}, {second}"),
                ([first, second], _) => format!("{kind}s {first}, {second}"),
                (_, "dh of") => format!("dh of {} frames", names.len()),
                _ => format!("{} {kind}s", names.len()),
            }
        });
        listed.collect::<Vec<_>>().join(", ")
    }

    /// Adds an input for each enabled repeatable source, in their order, which multiplies the
    /// errors of the source. Its default is the source's factor. Its name is [`MAGNITUDE`]
    /// followed by the source's name as an identifier, and a number if that is taken.
    #[must_use]
    pub fn with_magnitudes_as_inputs(&self) -> Self {
        let mut spec = self.clone();
        let mut taken: HashSet<String> = self.symbols().map(|(name, ..)| name.to_owned()).collect();
        let mut numbers: HashMap<String, usize> = HashMap::new();
        let tunable = |source: &Source| source.enabled && source.class == Class::Repeatable;
        for source in spec.sources.iter_mut().filter(|source| tunable(source)) {
            let plain = format!("{MAGNITUDE}{}", as_identifier(&source.name));
            let mut name = plain.clone();
            while !taken.insert(name.clone()) {
                let number = numbers.entry(plain.clone()).or_insert(1);
                *number += 1;
                name = format!("{plain}_{number}");
            }
            source.tuned_by = Some(spec.inputs.len());
            spec.inputs.push(Input {
                name,
                value: source.factor(),
                dimension: Dimension::NONE,
                unit: String::new(),
                range: [f64::NEG_INFINITY, f64::INFINITY],
                levels: Vec::new(),
                uncertainty: 0.0,
                description: format!("{}: factor of this source", source.name),
                line: 0,
            });
        }
        spec
    }
}

/// A structural parameter.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Name of the parameter.
    pub name: String,
    /// Nominal value in coherent units.
    pub value: f64,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Description.
    pub description: String,
    /// Line of the spec that declares it.
    pub line: usize,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Name of the input.
    pub name: String,
    /// Default value in coherent units.
    pub value: f64,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// Coherent unit; empty for a pure number or an angle.
    pub unit: String,
    /// Lower and upper end of the range; infinite without one.
    pub range: [f64; 2],
    /// Values that are used, in ascending order; empty for any in the range.
    pub levels: Vec<f64>,
    /// Standard uncertainty of its value in use, in coherent units; 0 if it is exact.
    pub uncertainty: f64,
    /// Description.
    pub description: String,
    /// Line of the spec that declares it; 0 if it is derived.
    pub line: usize,
}

/// A joint variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name of the variable.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit; infinite without one.
    pub limits: [f64; 2],
    /// Value at home.
    pub home: f64,
    /// Description.
    pub description: String,
    /// Index of the frame that declares the variable, from 0.
    pub frame: usize,
}

/// A joint variable or an input, and the range over which errors were fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The variable or input.
    pub symbol: Symbol,
    /// Lower and upper end.
    pub range: [f64; 2],
}

impl Fitted {
    /// Returns `true` if the value in `q` or `u` is outside the range.
    pub fn is_outside(&self, q: &[f64], u: &[f64]) -> bool {
        let value = match self.symbol {
            Symbol::Variable(i) => q.get(i),
            Symbol::Input(i) => u.get(i),
            _ => None,
        };
        value.is_some_and(|value| !self.contains(*value))
    }

    /// Returns `true` if a value is within the range, up to the rounding of written numbers.
    pub fn contains(&self, value: f64) -> bool {
        let [lower, upper] = self.range;
        let digit = 1e-6 * lower.abs().max(upper.abs());
        (lower - digit..=upper + digit).contains(&value)
    }
}
