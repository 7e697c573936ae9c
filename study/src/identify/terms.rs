//! Candidates for richer models: errors of one unit each, whose magnitudes are unknown.

use abbe::{Component, VariableKind};
use abbe_codegen::spec::Spec;

/// An error of a frame in proportion to a basis; its magnitude is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The frame, from 0.
    pub frame: usize,
    /// Which of its six errors.
    pub component: Component,
    /// What it is in proportion to.
    pub basis: Basis,
}

/// What an error is in proportion to. Of magnitude 1 it is one length unit or 1 rad, times this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Basis {
    /// The sine of so many times a joint angle.
    Sine {
        /// The revolute joint.
        variable: usize,
        /// How many periods a turn has.
        times: u8,
    },
    /// The cosine.
    Cosine {
        /// The revolute joint.
        variable: usize,
        /// How many periods a turn has.
        times: u8,
    },
    /// A power of a joint's travel, in 1000 length units.
    Power {
        /// The prismatic joint.
        variable: usize,
        /// The exponent.
        exponent: u8,
    },
    /// An input, in its unit.
    Input(usize),
    /// The moment that weights have about the frame, in 10⁶ N times the length unit: a compliance.
    Moment,
}

/// A family of terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Errors that change with a frame's own joint: once and twice per turn, or in proportion to its travel and its square.
    Joint,
    /// Errors in proportion to an input: to a load, a temperature.
    Load,
    /// Turns of a frame in proportion to the moment that the loads of the spec, or the weight of 1 kg at the tool point,
    /// have about it.
    Elastic,
}

/// The terms of some families, in groups that come together: the sine and cosine of a joint, say.
pub fn candidates(spec: &Spec, families: &[Family]) -> Vec<Vec<Term>> {
    let asked =
        [Family::Joint, Family::Load, Family::Elastic].into_iter().filter(|one| families.contains(one));
    let terms = |family| match family {
        Family::Joint => joint(spec),
        Family::Load => load(spec),
        Family::Elastic => elastic(spec),
    };
    asked.flat_map(terms).collect()
}

fn joint(spec: &Spec) -> Vec<Vec<Term>> {
    let moved = spec.frames.iter().enumerate().filter_map(|(frame, has)| Some((frame, has.variable?)));
    let groups = moved.flat_map(|(frame, variable)| {
        let bases = match spec.variables[variable].kind {
            VariableKind::Revolute => {
                [1, 2].map(|times| vec![Basis::Sine { variable, times }, Basis::Cosine { variable, times }])
            }
            VariableKind::Prismatic => [1, 2].map(|exponent| vec![Basis::Power { variable, exponent }]),
        };
        Component::ALL.into_iter().flat_map(move |component| {
            let term = move |basis| Term { frame, component, basis };
            bases.clone().map(|group| group.into_iter().map(term).collect())
        })
    });
    groups.collect()
}

fn load(spec: &Spec) -> Vec<Vec<Term>> {
    let frames = 0..spec.frames.len();
    let all = (0..spec.inputs.len()).flat_map(|input| frames.clone().map(move |frame| (input, frame)));
    let groups = all.flat_map(|(input, frame)| {
        let basis = Basis::Input(input);
        Component::ALL.map(|component| vec![Term { frame, component, basis }])
    });
    groups.collect()
}

fn elastic(spec: &Spec) -> Vec<Vec<Term>> {
    let moved = (0..spec.frames.len()).filter(|frame| spec.frames[*frame].variable.is_some());
    let basis = Basis::Moment;
    let groups = moved.flat_map(|frame| {
        let turns = Component::ALL.into_iter().filter(|component| component.is_rotation());
        turns.map(move |component| vec![Term { frame, component, basis }])
    });
    groups.collect()
}

impl Term {
    /// What it is called: a name that no other term has.
    pub fn name(&self, spec: &Spec) -> String {
        let (frame, component) = (&spec.frames[self.frame].name, self.component.name());
        match self.basis {
            Basis::Moment => format!("{frame}: gives way under weight, {component}"),
            Basis::Input(input) => format!("{frame}: {component} with {}", spec.inputs[input].name),
            Basis::Power { variable, exponent } => {
                format!("{frame}: {component} with {}^{exponent}", spec.variables[variable].name)
            }
            Basis::Sine { .. } | Basis::Cosine { .. } => {
                format!("{frame}: {component} with {}", self.basis.text(spec))
            }
        }
    }

    /// What the group is called that it comes in.
    pub fn group(&self, spec: &Spec) -> String {
        let joint = |what: &str, variable: usize| {
            let (frame, variable) = (&spec.frames[self.frame].name, &spec.variables[variable].name);
            format!("{frame}: {what} {variable}, {}", self.component.name())
        };
        match self.basis {
            Basis::Sine { variable, times: 1 } | Basis::Cosine { variable, times: 1 } => {
                joint("once per turn of", variable)
            }
            Basis::Sine { variable, .. } | Basis::Cosine { variable, .. } => {
                joint("twice per turn of", variable)
            }
            Basis::Power { variable, exponent: 1 } => joint("in proportion to", variable),
            Basis::Power { variable, .. } => joint("with the square of", variable),
            Basis::Input(_) | Basis::Moment => self.name(spec),
        }
    }
}

impl Basis {
    /// As an expression of a spec; a compliance is none.
    pub(super) fn text(self, spec: &Spec) -> String {
        let angle = |variable: usize, times: u8| match times {
            1 => spec.variables[variable].name.clone(),
            times => format!("{times}*{}", spec.variables[variable].name),
        };
        match self {
            Self::Sine { variable, times } => format!("sin({})", angle(variable, times)),
            Self::Cosine { variable, times } => format!("cos({})", angle(variable, times)),
            Self::Power { variable, exponent } => {
                let (name, unit) = (&spec.variables[variable].name, spec.length.symbol());
                format!("({name}/(1000 {unit}))^{exponent}")
            }
            Self::Input(input) => {
                let input = &spec.inputs[input];
                let one = if input.unit.is_empty() { "1".to_owned() } else { format!("(1 {})", input.unit) };
                format!("{}/{one}", input.name)
            }
            Self::Moment => format!("1e-6/(N*{})", spec.length.symbol()),
        }
    }
}
