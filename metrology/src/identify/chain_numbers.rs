//! Numbers of the chain (joint zeros, structural parameters, Denavit-Hartenberg numbers) that are
//! equivalent to constant errors of frames.
//!
//! Zeros of legs, which no constant errors of frames are equal to.

use abbe::{Component, identify::Unknown};
use abbe_codegen::chain::{FrameTwist, frame_twists, transform};
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_spec::expr::{Dimension, Symbol};
use abbe_spec::{ChainNumber, Deviation, DhNumber, Source, Spec};

use super::terms::{Basis, ErrorSite, Term};

/// Number of configurations at which an error must be equal to count as constant.
const SAMPLES: usize = 5;

/// Six generalized errors of some frames, numbered from 0.
pub(crate) type FrameErrors = Vec<(usize, [f64; 6])>;

/// Number of the chain that is equivalent to constant errors of frames.
pub(crate) struct ChainError {
    /// Name: `zero of q2`, `upper_arm`.
    pub(crate) name: String,
    /// Is true for an angle or a pure number, false for a length.
    pub(crate) is_angle: bool,
    /// Errors per unit of the number.
    pub(crate) errors: FrameErrors,
}

/// Returns all such numbers, joints first.
pub(crate) fn chain_errors(spec: &Spec) -> Vec<ChainError> {
    let mut graph = Graph::with_tables(&spec.tables);
    let all = chain_numbers(spec).into_iter().filter_map(|(name, number)| {
        let errors = constant_errors(&mut graph, spec, number)?;
        Some(ChainError { name, is_angle: is_angle(spec, number), errors })
    });
    all.collect()
}

/// Returns an error of a frame as a number: `e_x of wrist`.
pub(super) fn frame_error(spec: &Spec, frame: usize, component: Component) -> ChainError {
    ChainError {
        name: format!("{} of {}", component.name(), spec.frames[frame].name),
        is_angle: component.is_rotation(),
        errors: vec![(frame, Component::ALL.map(|other| f64::from(u8::from(other == component))))],
    }
}

/// Returns every number of the chain with its name: joints, then parameters, then
/// Denavit-Hartenberg numbers.
pub(super) fn chain_numbers(spec: &Spec) -> Vec<(String, ChainNumber)> {
    let joints = spec.variables.iter().enumerate();
    let joints = joints.map(|(i, joint)| (format!("zero of {}", joint.name), ChainNumber::Joint(i)));
    let parameters = spec.parameters.iter().enumerate();
    let parameters = parameters.map(|(i, parameter)| (parameter.name.clone(), ChainNumber::Parameter(i)));
    let frames = spec.frames.iter().enumerate().filter(|(_, frame)| frame.convention.is_some());
    let of_frames = frames.flat_map(|(i, frame)| {
        let name = &frame.name;
        DhNumber::ALL.map(|number| {
            (format!("{} of {name}", number.name()), ChainNumber::DenavitHartenberg { frame: i, number })
        })
    });
    joints.chain(parameters).chain(of_frames).collect()
}

/// Returns the errors of frames per unit of a number, if they are the same in all configurations.
/// The zero of a coupled joint is an error of each frame that it moves.
pub(super) fn constant_errors(graph: &mut Graph, spec: &Spec, number: ChainNumber) -> Option<FrameErrors> {
    let twists = frame_twists(graph, spec, number);
    let all = twists.iter().map(|one| Some((one.frame, constant(graph, spec, one.velocity, one.rotation)?)));
    let is_one_chain = |errors: &FrameErrors| errors.len() == 1 || !errors.is_empty() && spec.is_serial();
    if let Some(errors) = all.collect::<Option<FrameErrors>>().filter(is_one_chain) {
        return Some(errors);
    }
    let [FrameTwist { frame, velocity, rotation }] = twists[..] else { return None };
    // Ad(A): ω' = R ω, v' = R v + p × ω'. In a tree, other frames may hang on that one.
    let before = spec.frames[frame].parent.filter(|_| spec.is_serial())?;
    let Frame { axes, position } = transform(graph, &spec.frames[frame].factors);
    let turned = graph.turn(&axes, rotation);
    let (moved, swing) = (graph.turn(&axes, velocity), graph.cross(position, turned));
    let moved = graph.add_vectors(moved, swing);
    Some(vec![(before, constant(graph, spec, moved, turned)?)])
}

fn constant(graph: &Graph, spec: &Spec, velocity: [Node; 3], rotation: [Node; 3]) -> Option<[f64; 6]> {
    let nodes = Component::ALL.map(|component| match component.is_rotation() {
        true => rotation[component.axis()],
        false => velocity[component.axis()],
    });
    let at = |sample: usize| {
        graph.evaluate(&nodes, |symbol| match symbol {
            Symbol::Variable(i) => spec.variables[i].home + (1.3 * (sample * (i + 2)) as f64).sin(),
            Symbol::Parameter(i) => spec.parameters[i].value,
            Symbol::Passive(_)
            | Symbol::Input(_)
            | Symbol::Error(_)
            | Symbol::Local(_)
            | Symbol::Magnitude(_)
            | Symbol::Target(_) => f64::NAN,
        })
    };
    let first = at(0);
    let largest = first.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let same = |(a, b): (&f64, f64)| (a - b).abs() <= 1e-12 * largest;
    let constant = (1..SAMPLES).all(|sample| first.iter().zip(at(sample)).all(same));
    let errors: [f64; 6] = first.try_into().ok()?;
    constant.then_some(errors.map(|value| if value.abs() > 1e-12 * largest { value } else { 0.0 }))
}

/// Returns the errors that are not zero, as unknowns of a model.
pub(crate) fn unknowns_of(errors: &FrameErrors) -> impl Iterator<Item = (Unknown, f64)> {
    let of_frame = |(frame, errors): &(usize, [f64; 6])| {
        let frame = *frame;
        Component::ALL
            .into_iter()
            .zip(*errors)
            .map(move |(component, error)| (Unknown::Error(frame, component), error))
    };
    errors.iter().flat_map(of_frame).filter(|(_, error)| *error != 0.0)
}

/// Returns whether the error of a number is an angle.
pub(super) fn is_angle(spec: &Spec, number: ChainNumber) -> bool {
    ErrorSite::from_chain_number(number).dimension(spec) == Dimension::NONE
}

/// Returns the unit of the error of a number.
pub(super) fn error_unit(spec: &Spec, is_angle: bool) -> &'static str {
    if is_angle { "rad" } else { spec.length.symbol() }
}

/// Returns the zero of each joint that moves frames differently from configuration to
/// configuration, such as the length of a leg, unless a source of unknown magnitude has it. They
/// are always fitted. Those of other joints are among the errors of the frames.
pub(super) fn leg_terms(spec: &Spec) -> Vec<Term> {
    if spec.loops.is_empty() {
        return Vec::new();
    }
    let mut graph = Graph::with_tables(&spec.tables);
    let is_declared = |number: ChainNumber| {
        let deviates = |deviation: &Deviation| deviation.number == number;
        let has = |source: &Source| source.magnitude.is_some() && source.deviations.iter().any(deviates);
        spec.sources.iter().any(|source| source.enabled && has(source))
    };
    let mut is_free = |joint: &usize| {
        let number = ChainNumber::Joint(*joint);
        !is_declared(number) && constant_errors(&mut graph, spec, number).is_none()
    };
    let joints: Vec<usize> = (0..spec.variables.len()).filter(&mut is_free).collect();
    joints.into_iter().map(|joint| Term { site: ErrorSite::Joint(joint), basis: Basis::One }).collect()
}
