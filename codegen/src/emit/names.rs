//! What symbols and steps are called in generated code.

use std::collections::HashSet;

use crate::expr::Symbol;
use crate::program::{Action, Operand, Program};
use crate::spec::{Component, Spec};

/// Names that arguments and constants have, or that are no names in a pattern.
const TAKEN: [&str; 27] = [
    "q",
    "s",
    "u",
    "zero",
    "one",
    "pose",
    "transforms",
    "columns",
    "effects",
    "errors",
    "variances",
    "distinct",
    "displacement",
    "displacements",
    "covariance",
    "FRAMES",
    "ERRORS",
    "VARIABLES",
    "PARAMETERS",
    "INPUTS",
    "EFFECTS",
    "DISTINCT",
    "SOURCES",
    "None",
    "Some",
    "Ok",
    "Err",
];

/// The names of one function.
pub(super) struct Names<'s> {
    spec: &'s Spec,
    used: HashSet<String>,
    counter: usize,
    variables: Vec<String>,
    parameters: Vec<String>,
    inputs: Vec<String>,
    /// Six per frame.
    errors: Vec<String>,
}

impl<'s> Names<'s> {
    pub(super) fn new(spec: &'s Spec) -> Self {
        let used = TAKEN.iter().map(|name| (*name).to_owned()).collect();
        let (variables, parameters, inputs, errors) = (vec![], vec![], vec![], vec![]);
        let mut names = Self { spec, used, counter: 0, variables, parameters, inputs, errors };
        names.variables = spec.variables.iter().map(|variable| names.free(&variable.name)).collect();
        names.parameters = spec.parameters.iter().map(|parameter| names.free(&parameter.name)).collect();
        names.inputs = spec.inputs.iter().map(|input| names.free(&input.name)).collect();
        names
    }

    /// Names what is given for each generalized error by its first letter: of `variances`, `v2_s` is that of `e_s` of
    /// frame 2.
    pub(super) fn name_errors(&mut self, given: &str) {
        let letter = &given[..1];
        for frame in 1..=self.spec.frames.len() {
            for component in Component::ALL {
                let suffix = component.name().trim_start_matches("e_");
                let name = self.free(&format!("{letter}{frame}_{suffix}"));
                self.errors.push(name);
            }
        }
    }

    /// A variable, parameter, input or generalized error.
    pub(super) fn symbol(&self, symbol: Symbol) -> &str {
        match symbol {
            Symbol::Variable(i) => &self.variables[i],
            Symbol::Parameter(i) => &self.parameters[i],
            Symbol::Input(i) => &self.inputs[i],
            // Named before the body is written, in the functions that have them.
            Symbol::Error(i) => &self.errors[i],
        }
    }

    /// The result of a step: its own name, or else the next `t…`.
    pub(super) fn step(&mut self, proposed: Option<&str>) -> String {
        match proposed {
            Some(name) => self.free(name),
            None => {
                self.counter += 1;
                self.free(&format!("t{}", self.counter))
            }
        }
    }

    /// Sine and cosine: `s2` and `c2` of the variable of frame 2, with an offset or without, `sin_x` and `cos_x`
    /// of a parameter x.
    pub(super) fn sine_and_cosine(&mut self, angle: Operand, program: &Program) -> (String, String) {
        let of = |name: &str| (format!("sin_{name}"), format!("cos_{name}"));
        let (sine, cosine) = match without_offset(angle, program) {
            Operand::Symbol(Symbol::Variable(i)) => {
                let frame = self.spec.variables[i].frame + 1;
                (format!("s{frame}"), format!("c{frame}"))
            }
            Operand::Symbol(Symbol::Parameter(i)) => of(&self.spec.parameters[i].name),
            Operand::Symbol(Symbol::Input(i)) => of(&self.spec.inputs[i].name),
            _ => {
                self.counter += 1;
                of(&self.counter.to_string())
            }
        };
        (self.free(&sine), self.free(&cosine))
    }

    fn free(&mut self, name: &str) -> String {
        let mut name = name.to_owned();
        while !self.used.insert(name.clone()) {
            name.push('_');
        }
        name
    }
}

/// The variable of `variable ± something else`.
fn without_offset(angle: Operand, program: &Program) -> Operand {
    let is_variable = |operand: &Operand| matches!(operand, Operand::Symbol(Symbol::Variable(_)));
    let step = program.steps.iter().find(|step| Operand::Register(step.register) == angle);
    match step.map(|step| step.action) {
        Some(action @ (Action::Add(..) | Action::Sub(..))) => {
            let mut variables = action.operands().filter(is_variable);
            variables.next().filter(|_| variables.next().is_none()).unwrap_or(angle)
        }
        _ => angle,
    }
}
