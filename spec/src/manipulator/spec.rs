//! What a checked spec holds. Numbers are in its coherent system: its length unit, kg, s, rad, K.

use std::path::PathBuf;
use std::sync::Arc;

use abbe_core::{Class, LengthUnit, Orientation};
use indexmap::IndexSet;

use super::chain_number::ChainNumber;
use super::covariance::Covariance;
use super::declared::{Input, Parameter, Variable};
use super::fitted::Fitted;
use super::frame::{Factor, Frame};
use super::load::Load;
use super::source::{Deviation, Source};
use crate::expr::{Expression, Symbol, Table};

/// A manipulator as its file describes it.
#[derive(Clone, Debug)]
pub struct Spec {
    /// Its name: a lower snake case identifier.
    pub name: String,
    /// Its name for people.
    pub title: String,
    /// What it is.
    pub description: String,
    /// Where its numbers come from.
    pub reference: String,
    /// The unit of every length.
    pub length: LengthUnit,
    /// What rows 4–6 of the Jacobians are.
    pub orientation: Orientation,
    /// The structural parameters `s`.
    pub parameters: Vec<Parameter>,
    /// The inputs `u`.
    pub inputs: Vec<Input>,
    /// The joint variables `q`, in the order of the frames that declare them.
    pub variables: Vec<Variable>,
    /// `A_1 … A_n`, base to tip.
    pub frames: Vec<Frame>,
    /// `T`, from `F_n` to the tool point; no factors if there is none.
    pub tool: Vec<Factor>,
    /// The physical errors, those that are switched off among them.
    pub sources: Vec<Source>,
    /// What weighs on the structure.
    pub loads: Vec<Load>,
    /// The acceleration of gravity in `F_0`.
    pub gravity: Option<[Expression; 3]>,
    /// Where the errors of an identified machine were fitted; nothing if they were not.
    pub fitted: Vec<Fitted>,
    /// How well these errors are known; of nothing if they were not identified.
    pub covariance: Covariance,
    /// Functions that are given by points.
    pub tables: Vec<Arc<Table>>,
    /// The file's name, without its folder.
    pub file: String,
    /// Further files that were read: those of tables.
    pub beside: Vec<PathBuf>,
    /// SHA-256 of the file's text and of what is in the files of its tables, in hexadecimal.
    pub hash: String,
}

impl Spec {
    /// The joint variables on which each of `A_1 … A_n` and `T` depends.
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

    /// Whether any source that is switched on is repeatable.
    pub fn has_repeatable_source(&self) -> bool {
        self.enabled_sources().any(|source| source.class == Class::Repeatable)
    }

    /// The sources that are switched on, in the order of the file.
    pub fn enabled_sources(&self) -> impl Iterator<Item = &Source> {
        self.sources.iter().filter(|source| source.enabled)
    }

    /// The same source by its index among those that take part, if it does.
    pub fn enabled_index(&self, source: usize) -> Option<usize> {
        let before = self.sources.get(..source)?.iter().filter(|source| source.enabled).count();
        self.sources.get(source)?.enabled.then_some(before)
    }

    /// The name of a joint variable, parameter or input; empty for symbols that no spec declares.
    pub fn name_of(&self, symbol: Symbol) -> &str {
        match symbol {
            Symbol::Variable(i) => &self.variables[i].name,
            Symbol::Parameter(i) => &self.parameters[i].name,
            Symbol::Input(i) => &self.inputs[i].name,
            _ => "",
        }
    }

    /// What a source is an error of: `joint q2`, `parameter a2`, `dh of elbow`, `frame elbow`, or several of these.
    pub fn place(&self, source: &Source) -> String {
        let frame = |frame: usize| self.frames[frame].name.clone();
        let of_chain = |deviation: &Deviation| match deviation.number {
            ChainNumber::Joint(joint) => ("joint", self.variables[joint].name.clone()),
            ChainNumber::Parameter(parameter) => ("parameter", self.parameters[parameter].name.clone()),
            ChainNumber::DenavitHartenberg { frame: of, .. } => ("dh of", frame(of)),
        };
        let frames = source.effects.iter().map(|effect| ("frame", frame(effect.frame)));
        let places: IndexSet<(&str, String)> = source.deviations.iter().map(of_chain).chain(frames).collect();
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
}
