//! Which terms are tried, and in which order.

use abbe::{Component, VariableKind};
use abbe_codegen::chain::frame_twists;
use abbe_codegen::graph::Graph;
use abbe_spec::{ChainNumber, Factor, Spec};

use super::derived::{Derived, DerivedKind};
use super::families::{Family, Harmonics};
use super::terms::{Angle, Basis, ErrorSite, Term, Wave};

/// Groups of terms that come together, the sine and cosine of a joint, say: stage by stage, the likelier ones first.
///
/// Each stage is tried beside what those before it took in. `spec` has the derived inputs behind its own.
pub fn candidates(
    spec: &Spec,
    derived: &[Derived],
    families: &[Family],
    harmonics: &[Harmonics],
) -> Vec<Vec<Vec<Term>>> {
    let has = |family: Family| families.contains(&family);
    let with = |family: Family, groups: fn(&Spec) -> Vec<Vec<Term>>| match has(family) {
        true => groups(spec),
        false => Vec::new(),
    };
    let own = spec.inputs.len() - derived.len();
    let load = if has(Family::Load) { load(spec, own) } else { Vec::new() };
    let of_kind = |kind: fn(&DerivedKind) -> bool| {
        let inputs = derived.iter().enumerate().filter(move |(_, one)| kind(&one.kind));
        inputs.flat_map(|(i, one)| one.groups(spec, own + i)).collect::<Vec<_>>()
    };
    let of_joint = |times: &[u16], exponents: &[u8]| match has(Family::Joint) {
        true => joint(spec, times, exponents),
        false => Vec::new(),
    };
    let gears = harmonics.iter().flat_map(|one| {
        let group = |times: &u16| {
            let place = ErrorSite::Joint(one.variable);
            let bases = Basis::waves(Angle::times(one.variable, *times));
            bases.into_iter().map(|basis| Term { place, basis }).collect::<Vec<_>>()
        };
        one.times.iter().map(group).collect::<Vec<_>>()
    });
    let stages = [
        [
            of_joint(&[1, 2], &[1, 2]),
            load,
            with(Family::Elastic, elastic),
            of_kind(|kind| matches!(kind, DerivedKind::FromRows(_))),
        ]
        .concat(),
        [of_joint(&[3, 4], &[3]), gears.collect(), with(Family::Elastic, coupled)].concat(),
        with(Family::Product, product),
        of_kind(|kind| matches!(kind, DerivedKind::Settling(_) | DerivedKind::Drift)),
    ];
    // What an error of a frame has in common with that of its joint everywhere is offered as the joint's.
    let joints: Vec<Option<(usize, Component)>> =
        (0..spec.variables.len()).map(|joint| error_of_joint(spec, joint)).collect();
    let as_joint = |term: &Term| match term.place {
        ErrorSite::Frame(frame, component) => {
            let joint = joints.iter().position(|same| *same == Some((frame, component)));
            joint.map(|joint| Term { place: ErrorSite::Joint(joint), ..*term })
        }
        _ => None,
    };
    let once = |stage: Vec<Vec<Term>>| {
        let all: Vec<Term> = stage.concat();
        let twice = |term: &Term| as_joint(term).is_some_and(|same| all.contains(&same));
        stage.into_iter().filter(|group| !group.iter().any(twice)).collect::<Vec<_>>()
    };
    stages.into_iter().map(once).filter(|stage| !stage.is_empty()).collect()
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

fn joint(spec: &Spec, times: &[u16], exponents: &[u8]) -> Vec<Vec<Term>> {
    let moved = spec.frames.iter().enumerate().filter_map(|(frame, has)| Some((frame, has.variable?)));
    let groups = moved.flat_map(|(frame, variable)| {
        let places = Component::ALL.map(|component| ErrorSite::Frame(frame, component));
        let bases: Vec<Vec<Basis>> = match spec.variables[variable].kind {
            VariableKind::Revolute => {
                times.iter().map(|times| Basis::waves(Angle::times(variable, *times))).collect()
            }
            VariableKind::Prismatic => {
                let power = |exponent: &u8| vec![Basis::Wave(Wave::Power { variable, exponent: *exponent })];
                exponents.iter().map(power).collect()
            }
        };
        [ErrorSite::Joint(variable)].into_iter().chain(places).flat_map(move |place| {
            let term = move |basis: &Basis| Term { place, basis: *basis };
            bases.iter().map(|group| group.iter().map(term).collect()).collect::<Vec<_>>()
        })
    });
    groups.collect()
}

fn load(spec: &Spec, inputs: usize) -> Vec<Vec<Term>> {
    let used = |parameter: &usize| {
        !frame_twists(&mut Graph::with_tables(&spec.tables), spec, ChainNumber::Parameter(*parameter))
            .is_empty()
    };
    let joints = (0..spec.variables.len()).map(ErrorSite::Joint);
    let parameters = (0..spec.parameters.len()).filter(used).map(ErrorSite::Parameter);
    let frames = (0..spec.frames.len())
        .flat_map(|frame| Component::ALL.map(|component| ErrorSite::Frame(frame, component)));
    let places: Vec<ErrorSite> = joints.chain(parameters).chain(frames).collect();
    let term = |input, place| vec![Term { place, basis: Basis::Input(input) }];
    (0..inputs).flat_map(|input| places.iter().map(move |place| term(input, *place))).collect()
}

/// The turns of the base, if its errors can be said at the first frame, and of every frame.
fn turns(spec: &Spec) -> Vec<[ErrorSite; 3]> {
    let turns = [Component::Spin, Component::Roll, Component::Pitch];
    let inverse =
        |frame: &abbe_spec::Frame| !frame.factors.iter().any(|factor| matches!(factor, Factor::Matrix(_)));
    let base = spec.frames.first().is_some_and(inverse).then(|| turns.map(ErrorSite::Base));
    let frames = (0..spec.frames.len()).map(|frame| turns.map(|turn| ErrorSite::Frame(frame, turn)));
    base.into_iter().chain(frames).collect()
}

fn elastic(spec: &Spec) -> Vec<Vec<Term>> {
    let places = turns(spec).into_iter().flatten();
    places.map(|place| vec![Term { place, basis: Basis::Moment }]).collect()
}

/// What full compliances have off their diagonals, of base and frames: pair by pair, and all three of a place at once.
fn coupled(spec: &Spec) -> Vec<Vec<Term>> {
    let of_place = |[spin, roll, _]: [ErrorSite; 3]| {
        let pair = |place: ErrorSite, other| Term { place, basis: Basis::Coupled(other) };
        let three = [pair(spin, Component::Roll), pair(spin, Component::Pitch), pair(roll, Component::Pitch)];
        three.map(|term| vec![term]).into_iter().chain([three.to_vec()])
    };
    turns(spec).into_iter().flat_map(of_place).collect()
}

fn product(spec: &Spec) -> Vec<Vec<Term>> {
    let count = spec.variables.len();
    let is_revolute = |joint: usize| spec.variables[joint].kind == VariableKind::Revolute;
    let alone = |joint: usize| match is_revolute(joint) {
        true => [1, 2].map(|times| Basis::waves(Angle::times(joint, times))).to_vec(),
        false => [1, 2].map(|exponent| vec![Basis::Wave(Wave::Power { variable: joint, exponent })]).to_vec(),
    };
    let travel = |joint: usize| Wave::Power { variable: joint, exponent: 1 };
    let both = |one: usize, other: usize| match (is_revolute(one), is_revolute(other)) {
        (true, true) => {
            let with = |plus| Basis::waves(Angle { variable: one, times: 1, other: Some((other, plus)) });
            vec![with(true), with(false)]
        }
        (false, false) => vec![vec![Basis::Product(travel(one), travel(other))]],
        (turning, _) => {
            let (turn, slide) = if turning { (one, other) } else { (other, one) };
            let angle = Angle::times(turn, 1);
            let product = |wave| Basis::Product(travel(slide), wave);
            vec![vec![product(Wave::Sine(angle)), product(Wave::Cosine(angle))]]
        }
    };
    let of_joint = |joint: usize| {
        let others = (0..count).filter(|other| *other != joint).flat_map(alone);
        let pairs = (0..count).flat_map(|one| (one + 1..count).flat_map(move |other| both(one, other)));
        let place = ErrorSite::Joint(joint);
        let group = |bases: Vec<Basis>| bases.into_iter().map(|basis| Term { place, basis }).collect();
        others.chain(pairs).map(group).collect::<Vec<_>>()
    };
    (0..count).flat_map(of_joint).collect()
}
