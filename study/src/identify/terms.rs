//! Candidates for richer models: errors of one unit each, whose magnitudes are unknown.

use abbe::{Component, VariableKind};
use abbe_codegen::chain::frame_twists;
use abbe_codegen::graph::Graph;
use abbe_codegen::spec::{ChainNumber, Spec};

/// An error in proportion to a basis; its magnitude is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// What it is an error of.
    pub place: Place,
    /// What it is in proportion to.
    pub basis: Basis,
}

/// What a term is an error of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A joint, wherever transforms depend on it.
    Joint(usize),
    /// A structural parameter, likewise.
    Parameter(usize),
    /// One of the six errors of a frame, from 0.
    Frame(usize, Component),
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
    /// Errors of joints, and of frames with their own joint: once and twice per turn, or in proportion to its travel and its square.
    Joint,
    /// Errors of joints, parameters and frames in proportion to an input: to a load, a temperature.
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
    let all: Vec<Vec<Term>> = asked.flat_map(terms).collect();
    // What an error of a frame has in common with that of its joint everywhere is offered as the joint's.
    let joints: Vec<Option<(usize, Component)>> =
        (0..spec.variables.len()).map(|joint| error_of_joint(spec, joint)).collect();
    let as_joint = |term: &Term| match term.place {
        Place::Frame(frame, component) => {
            let joint = joints.iter().position(|same| *same == Some((frame, component)));
            joint.map(|joint| Term { place: Place::Joint(joint), ..*term })
        }
        _ => None,
    };
    let twice = |group: &Vec<Term>| {
        group
            .iter()
            .any(|term| as_joint(term).is_some_and(|same| all.iter().flatten().any(|other| *other == same)))
    };
    all.iter().filter(|group| !twice(group)).cloned().collect()
}

/// The one error of a frame that is, in every configuration, the error of a joint, if there is one.
fn error_of_joint(spec: &Spec, joint: usize) -> Option<(usize, Component)> {
    let mut graph = Graph::with_tables(&spec.tables);
    let twists = frame_twists(&mut graph, spec, ChainNumber::Joint(joint));
    let [twist] = &twists[..] else { return None };
    let zero = graph.zero();
    let node = |component: Component| match component.is_rotation() {
        true => twist.rotation[component.axis()],
        false => twist.velocity[component.axis()],
    };
    let mut moved = Component::ALL.into_iter().filter(|component| node(*component) != zero);
    let component = moved.next()?;
    (moved.next().is_none() && graph.value(node(component)).is_some()).then_some((twist.frame, component))
}

fn joint(spec: &Spec) -> Vec<Vec<Term>> {
    let moved = spec.frames.iter().enumerate().filter_map(|(frame, has)| Some((frame, has.variable?)));
    let groups = moved.flat_map(|(frame, variable)| {
        let places = Component::ALL.map(|component| Place::Frame(frame, component));
        let bases = match spec.variables[variable].kind {
            VariableKind::Revolute => {
                [1, 2].map(|times| vec![Basis::Sine { variable, times }, Basis::Cosine { variable, times }])
            }
            VariableKind::Prismatic => [1, 2].map(|exponent| vec![Basis::Power { variable, exponent }]),
        };
        [Place::Joint(variable)].into_iter().chain(places).flat_map(move |place| {
            let term = move |basis| Term { place, basis };
            bases.clone().map(|group| group.into_iter().map(term).collect())
        })
    });
    groups.collect()
}

fn load(spec: &Spec) -> Vec<Vec<Term>> {
    let used = |parameter: &usize| {
        !frame_twists(&mut Graph::with_tables(&spec.tables), spec, ChainNumber::Parameter(*parameter))
            .is_empty()
    };
    let joints = (0..spec.variables.len()).map(Place::Joint);
    let parameters = (0..spec.parameters.len()).filter(used).map(Place::Parameter);
    let frames = (0..spec.frames.len())
        .flat_map(|frame| Component::ALL.map(|component| Place::Frame(frame, component)));
    let places: Vec<Place> = joints.chain(parameters).chain(frames).collect();
    let term = |input, place| vec![Term { place, basis: Basis::Input(input) }];
    (0..spec.inputs.len()).flat_map(|input| places.iter().map(move |place| term(input, *place))).collect()
}

fn elastic(spec: &Spec) -> Vec<Vec<Term>> {
    let moved = (0..spec.frames.len()).filter(|frame| spec.frames[*frame].variable.is_some());
    let basis = Basis::Moment;
    let groups = moved.flat_map(|frame| {
        let turns = Component::ALL.into_iter().filter(|component| component.is_rotation());
        turns.map(move |component| vec![Term { place: Place::Frame(frame, component), basis }])
    });
    groups.collect()
}

impl Term {
    /// What it is called: a name that no other term has.
    pub fn name(&self, spec: &Spec) -> String {
        let (owner, error) = self.place.names(spec);
        match self.basis {
            Basis::Moment => format!("{owner}: gives way under weight, {error}"),
            Basis::Input(input) => format!("{owner}: {error} with {}", spec.inputs[input].name),
            Basis::Power { variable, exponent } => {
                format!("{owner}: {error} with {}^{exponent}", spec.variables[variable].name)
            }
            Basis::Sine { .. } | Basis::Cosine { .. } => {
                format!("{owner}: {error} with {}", self.basis.text(spec))
            }
        }
    }

    /// What the group is called that it comes in.
    pub fn group(&self, spec: &Spec) -> String {
        let joint = |what: &str, variable: usize| {
            let ((owner, error), variable) = (self.place.names(spec), &spec.variables[variable].name);
            format!("{owner}: {what} {variable}, {error}")
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

impl Place {
    /// What the term belongs to, and which of its errors it is.
    fn names(self, spec: &Spec) -> (&str, &'static str) {
        match self {
            Self::Joint(joint) => (&spec.variables[joint].name, "joint error"),
            Self::Parameter(parameter) => (&spec.parameters[parameter].name, "error"),
            Self::Frame(frame, component) => (&spec.frames[frame].name, component.name()),
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
