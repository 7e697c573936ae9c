//! Candidate terms and the order in which they are tried.

use abbe::{Component, VariableKind, identify::Observation};
use abbe_codegen::{chain::frame_twists, graph::Graph};
use abbe_spec::{ChainNumber, Factor, Frame, Spec};

use super::options::family_name;
use super::terms::{Angle, Basis, ErrorSite, HeldJoint, Term, Wave, held_ranges};
use super::{Derived, DerivedKind, Family, Harmonics};

/// Groups of terms by stage, the likelier ones first. A group is accepted or rejected as a whole,
/// such as the sine and cosine of a joint. Each stage is tried beside the terms accepted in earlier
/// stages.
pub type Stages = Vec<Vec<Vec<Term>>>;

/// Returns the candidate terms of several families together, then those of each family alone that
/// has any; only the former for a single family. Each set has the name of its families. Functions
/// of joints are held outside of what the rows cover.
pub(super) fn competing(
    spec: &Spec,
    derived: &[Derived],
    families: &[Family],
    harmonics: &[Harmonics],
    rows: &[Observation],
) -> Vec<(String, Stages)> {
    let ranges = held_ranges(spec, rows);
    let together = candidates(spec, derived, families, harmonics);
    let alone = |family: &Family| {
        let harmonics = if *family == Family::Joint { harmonics } else { &[] };
        (family_name(*family).to_owned(), candidates(spec, derived, &[*family], harmonics))
    };
    let mut sets: Vec<_> = families.iter().map(alone).filter(|(_, stages)| !stages.is_empty()).collect();
    let names = match &sets[..] {
        [] => "harmonics".to_owned(),
        sets => sets.iter().map(|(name, _)| &name[..]).collect::<Vec<_>>().join(", "),
    };
    if sets.len() < 2 {
        sets.clear();
    }
    sets.insert(0, (names, together));
    sets.retain(|(_, stages)| !stages.is_empty());
    let is_told = |group: &Vec<Term>| group.iter().all(|term| !term.is_hidden());
    for stage in sets.iter_mut().flat_map(|(_, stages)| stages) {
        stage.iter_mut().flatten().for_each(|term| *term = term.within(&ranges));
        stage.retain(is_told);
    }
    sets
}

/// Returns the candidate terms of these families. `spec` must have the derived inputs after its
/// own.
pub fn candidates(spec: &Spec, derived: &[Derived], families: &[Family], harmonics: &[Harmonics]) -> Stages {
    let has = |family: Family| families.contains(&family);
    let with = |family: Family, groups: fn(&Spec) -> Vec<Vec<Term>>| match has(family) {
        true => groups(spec),
        false => Vec::new(),
    };
    let own = spec.inputs.len() - derived.len();
    let load = if has(Family::Load) { load(spec, own) } else { Vec::new() };
    let of_kind = |family: Family, kind: fn(&DerivedKind) -> bool| {
        let is_asked = has(family);
        let inputs = derived.iter().enumerate().filter(move |(_, one)| is_asked && kind(&one.kind));
        inputs.flat_map(|(i, one)| one.groups(spec, own + i)).collect::<Vec<_>>()
    };
    let of_joint = |times: &[u16], exponents: &[u8]| match has(Family::Joint) {
        true => joint(spec, times, exponents),
        false => Vec::new(),
    };
    let gears = harmonics.iter().flat_map(|one| {
        let group = |times: &u16| {
            let site = ErrorSite::Joint(one.variable);
            let bases = Basis::waves(Angle::times(one.variable, *times));
            bases.into_iter().map(|basis| Term { site, basis }).collect::<Vec<_>>()
        };
        one.times.iter().map(group).collect::<Vec<_>>()
    });
    let stages = [
        [
            of_joint(&[1, 2], &[1, 2]),
            load,
            with(Family::Elastic, elastic),
            of_kind(Family::Backlash, |kind| matches!(kind, DerivedKind::FromRows(_))),
        ]
        .concat(),
        [of_joint(&[3, 4], &[3]), gears.collect(), with(Family::Elastic, coupled)].concat(),
        with(Family::Product, product),
        of_kind(Family::Drift, |kind| matches!(kind, DerivedKind::Settling(_) | DerivedKind::Drift)),
    ];
    // An error of a frame that equals an error of its joint in all configurations is offered as the
    // joint's.
    let joints: Vec<Option<(usize, Component)>> =
        (0..spec.variables.len()).map(|joint| error_of_joint(spec, joint)).collect();
    let as_joint = |term: &Term| match term.site {
        ErrorSite::Frame(frame, component) => {
            let joint = joints.iter().position(|same| *same == Some((frame, component)));
            joint.map(|joint| Term { site: ErrorSite::Joint(joint), ..*term })
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

/// Returns the only error of a frame that equals the error of a joint in all configurations, if
/// there is one.
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
    let groups = (0..spec.variables.len()).flat_map(|variable| {
        // The variable of a leg has no frame.
        let frame = spec.frames.iter().position(|frame| frame.variable == Some(variable));
        let errors = |frame| Component::ALL.map(|component| ErrorSite::Frame(frame, component));
        let sites = frame.into_iter().flat_map(errors);
        let bases: Vec<Vec<Basis>> = match spec.variables[variable].kind {
            VariableKind::Revolute => {
                times.iter().map(|times| Basis::waves(Angle::times(variable, *times))).collect()
            }
            VariableKind::Prismatic => {
                let power = |exponent: &u8| {
                    vec![Basis::Wave(Wave::Power { joint: HeldJoint::free(variable), exponent: *exponent })]
                };
                exponents.iter().map(power).collect()
            }
        };
        [ErrorSite::Joint(variable)].into_iter().chain(sites).flat_map(move |site| {
            let term = move |basis: &Basis| Term { site, basis: *basis };
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
    let sites: Vec<ErrorSite> = joints.chain(parameters).chain(frames).collect();
    let term = |input, site| vec![Term { site, basis: Basis::Input(input) }];
    (0..inputs).flat_map(|input| sites.iter().map(move |site| term(input, *site))).collect()
}

/// Returns the rotational errors of the base, if they can be located at a first frame on which all
/// others hang, and of every frame.
fn turns(spec: &Spec) -> Vec<[ErrorSite; 3]> {
    let turns = [Component::Spin, Component::Roll, Component::Pitch];
    let has_inverse = |frame: &Frame| !frame.factors.iter().any(|factor| matches!(factor, Factor::Matrix(_)));
    let is_alone = spec.frames.iter().skip(1).all(|frame| frame.parent.is_some())
        && spec.loops.iter().all(|closed| closed.frames.iter().all(Option::is_some));
    let base = (is_alone && spec.frames.first().is_some_and(has_inverse)).then(|| turns.map(ErrorSite::Base));
    let frames = (0..spec.frames.len()).map(|frame| turns.map(|turn| ErrorSite::Frame(frame, turn)));
    base.into_iter().chain(frames).collect()
}

fn elastic(spec: &Spec) -> Vec<Vec<Term>> {
    turns(spec).into_iter().flatten().map(|site| vec![Term { site, basis: Basis::Moment }]).collect()
}

/// Returns the off-diagonal entries of the compliances of base and frames: each pair alone, and all
/// three of a site together.
fn coupled(spec: &Spec) -> Vec<Vec<Term>> {
    let of_site = |[spin, roll, _]: [ErrorSite; 3]| {
        let pair = |site: ErrorSite, other| Term { site, basis: Basis::Coupled(other) };
        let three = [pair(spin, Component::Roll), pair(spin, Component::Pitch), pair(roll, Component::Pitch)];
        three.map(|term| vec![term]).into_iter().chain([three.to_vec()])
    };
    turns(spec).into_iter().flat_map(of_site).collect()
}

fn product(spec: &Spec) -> Vec<Vec<Term>> {
    let count = spec.variables.len();
    let is_revolute = |joint: usize| spec.variables[joint].kind == VariableKind::Revolute;
    let alone = |joint: usize| match is_revolute(joint) {
        true => [1, 2].map(|times| Basis::waves(Angle::times(joint, times))).to_vec(),
        false => [1, 2]
            .map(|exponent| vec![Basis::Wave(Wave::Power { joint: HeldJoint::free(joint), exponent })])
            .to_vec(),
    };
    let travel = |joint: usize| Wave::Power { joint: HeldJoint::free(joint), exponent: 1 };
    let both = |one: usize, other: usize| match (is_revolute(one), is_revolute(other)) {
        (true, true) => {
            let with = |plus| {
                let joint = HeldJoint::free(one);
                Basis::waves(Angle { joint, times: 1, other: Some((HeldJoint::free(other), plus)) })
            };
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
        let site = ErrorSite::Joint(joint);
        let group = |bases: Vec<Basis>| bases.into_iter().map(|basis| Term { site, basis }).collect();
        others.chain(pairs).map(group).collect::<Vec<_>>()
    };
    (0..count).flat_map(of_joint).collect()
}
