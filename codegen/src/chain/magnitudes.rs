//! Magnitudes of the tool point's errors, as nodes to be maximized.
//!
//! A norm is the same in the axes of any frame. The norm of a sum is taken in the axes of the first
//! frame that its sources affect, so that the joints before that frame drop out.

use std::f64::consts::{FRAC_PI_2, PI};

use abbe_core::Orientation;
use abbe_spec::{Function, Spec, Symbol};

use super::{
    Displacement, Implicit, Links, Rows, by_source::errors_by_source, sources, tree::Parts, vectors,
};
use crate::graph::{Graph, Node, Six, Vector};

/// Magnitude of an error of the tool point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Magnitude {
    /// The magnitude or its square.
    pub node: Node,
    /// `true` if the node is the square of the magnitude.
    pub squared: bool,
    /// Numbers of which the magnitude is a norm, and in which it is therefore convex; empty if none
    /// are known.
    pub parts: Vec<Node>,
    /// Nodes whose largest is the node; empty if it is not the largest of several.
    pub largest_of: Vec<Node>,
}

impl Magnitude {
    /// Returns the length of a vector.
    pub(super) fn length(graph: &mut Graph, vector: Vector) -> Self {
        let node = graph.dot(vector, vector);
        Self { node, squared: true, parts: vector.to_vec(), largest_of: Vec::new() }
    }

    /// Adds a radius, which is not negative.
    fn and_radius(mut self, graph: &mut Graph, radius: Node) -> Self {
        if radius == graph.zero() {
            return self;
        }
        let norm = if self.squared { graph.sqrt(self.node) } else { self.node };
        self.parts.push(radius);
        Self { node: graph.add(norm, radius), squared: false, parts: self.parts, largest_of: Vec::new() }
    }
}

/// Magnitudes of the errors of the tool point in the worst case: the largest sizes of sums in which
/// each random source has any value within its bound (3σ for a normal distribution). The five
/// entries are the norm of the position error, its components along x, y and z of `F_0`, and the
/// norm of rows 4–6.
///
/// The largest norm of a sum `Σ t_i v_i` with every `t_i` from −1 to 1 is the largest value of `Σ
/// |u·v_i|` over all unit vectors u. A ball or disc with the parts `B = [b_1 b_2 …]` adds `‖Bᵀu‖`,
/// which is its radius for a displacement that is as large in all directions. Norms of several
/// sources are therefore nodes of the two angles of u, too, the [`DIRECTION`], and are to be
/// maximized over these.
#[derive(Clone, Debug)]
pub struct Magnitudes {
    /// The graph of the nodes.
    pub graph: Graph,
    /// Signed sum of the enabled repeatable sources.
    pub repeatable: [Magnitude; 5],
    /// Sum of the enabled random sources with any signs.
    pub random: [Magnitude; 5],
    /// Sum of all sources, the random ones with any signs.
    pub total: [Magnitude; 5],
    /// Upper bounds of the errors along x and along y, for each kind: the norm of both. They do not
    /// depend on leading rotations about z.
    pub across_z: [Magnitude; 3],
    /// Parts of all magnitudes; `None` unless the frames are a chain.
    pub apart: Option<PerFrameMagnitudes>,
    /// Unknowns that the loops determine; the nodes read them as symbols.
    pub implicit: Vec<Implicit>,
}

/// Azimuth and elevation of the direction along which errors are added, and their ranges: half a
/// sphere, for errors have either sign.
pub const DIRECTION: [(Symbol, [f64; 2]); 2] =
    [(Symbol::Target(0), [0.0, PI]), (Symbol::Target(1), [-FRAC_PI_2, FRAC_PI_2])];

/// Parts of the errors of the tool point: norms that each depend on few joints.
#[derive(Clone, Debug)]
pub struct PerFrameMagnitudes {
    /// ‖t_k‖ from the origin of each frame to that of the next, and from the last one to the tool
    /// point.
    pub links: Vec<Magnitude>,
    /// ‖d_i‖ and ‖θ_i‖ of the errors of each frame: sum of all repeatable sources.
    pub repeatable: Vec<[Magnitude; 2]>,
    /// ‖d_i‖ and ‖θ_i‖ of each random source at its bound.
    pub random: Vec<Vec<[Magnitude; 2]>>,
}

/// Returns the radius of a ball with these parts, if they are displacements of one frame along x, y
/// and z, as large in all directions.
fn radius_of<'a>(zero: Node, parts: impl Iterator<Item = &'a Vec<Six>>) -> Option<Node> {
    let entries = |errors: &Vec<Six>| {
        let all = errors.as_flattened().iter().copied().enumerate();
        all.filter(|(_, error)| *error != zero).collect::<Vec<_>>()
    };
    let mut all: Vec<(usize, Node)> = parts.flat_map(entries).collect();
    all.sort_by_key(|(at, _)| *at);
    match all[..] {
        [(first, radius), (second, same), (third, too)]
            if first % 6 == 0
                && second == first + 1
                && third == first + 2
                && radius == same
                && radius == too =>
        {
            Some(radius)
        }
        _ => None,
    }
}

/// Returns ‖d‖ and ‖θ‖ of the errors of each frame.
fn sizes_apart(graph: &mut Graph, errors: &[Six]) -> Vec<[Magnitude; 2]> {
    let sizes = |errors: &Six| {
        let (shift, turn) = vectors(*errors);
        [shift, turn].map(|vector| Magnitude::length(graph, vector))
    };
    errors.iter().map(sizes).collect()
}

/// Displacement of the tool point caused by errors of frames.
struct ToolDisplacement {
    /// δ in the axes of the first frame with an error of the kind.
    shift: Vector,
    /// δ in `F_0`.
    along: Vector,
    /// x and y of δ behind the leading rotations about z.
    across_z: [Node; 2],
    /// Numbers with the same norm as rows 4–6.
    turn: Vector,
}

impl Magnitudes {
    /// Builds the magnitudes of a checked spec, as functions of the joint variables, or of the
    /// passive ones that are `given`.
    pub fn new(spec: &Spec, given: &[usize]) -> Self {
        let (mut graph, effects) = sources::effects(spec);
        let g = &mut graph;
        let zero = g.zero();
        let links = Links::new(g, spec);
        let tree = (!spec.is_serial()).then(|| Parts::implicit(g, spec, given));
        let last_axis = match &tree {
            Some((parts, ..)) => parts.tool_axis(spec.orientation.last_axis().unwrap_or(0)),
            None => links.last_axis(g, spec.orientation),
        };
        let rows = Rows::new(g, spec.orientation, last_axis);

        let errors = sources::generalized_errors(g, spec, &effects);
        let axes = g.identity().axes;
        let shifts: Vec<Vector> = (1..=spec.frames.len()).map(|link| links.shift(g, link, &axes)).collect();
        let mut apart = PerFrameMagnitudes {
            links: shifts.into_iter().map(|shift| Magnitude::length(g, shift)).collect(),
            repeatable: sizes_apart(g, &errors),
            random: Vec::new(),
        };
        // All parts of a ball or disc have the place of its first one, other sources their own.
        let (mut random, mut places) = (Vec::new(), Vec::new());
        let by_source = errors_by_source(zero, spec, &effects);
        let enabled = spec.sources.iter().enumerate().filter(|(_, source)| source.enabled);
        for ((k, source), errors) in enabled.zip(&by_source) {
            if let Some(distribution) = source.class.distribution() {
                places.push(if source.is_calibration_error() { k } else { spec.whole(k) });
                let bound = g.constant(distribution.bound());
                let at_bound = errors.iter().map(|errors| errors.map(|error| g.mul(bound, error)));
                let at_bound: Vec<Six> = at_bound.collect();
                apart.random.push(sizes_apart(g, &at_bound));
                random.push(at_bound);
            }
        }
        let mut radius = zero;
        let balls: Vec<usize> =
            (0..spec.sources.len()).filter(|k| places.iter().filter(|at| *at == k).count() == 3).collect();
        for place in balls {
            let parts =
                || places.iter().zip(&random).filter(|(at, _)| **at == place).map(|(_, errors)| errors);
            if let Some(own) = radius_of(zero, parts()) {
                let size = g.call(Function::Abs, own);
                radius = g.add(radius, size);
                let is_left: Vec<bool> = places.iter().map(|at| *at != place).collect();
                let mut left = is_left.iter();
                random.retain(|_| left.next().copied().unwrap_or_default());
                places.retain(|at| *at != place);
            }
        }
        let repeatable = vec![errors];
        let all = [&repeatable[..], &random].concat();
        let with_sum: Vec<usize> = [usize::MAX].into_iter().chain(places.iter().copied()).collect();
        let kinds = [(repeatable, vec![usize::MAX], zero), (random, places, radius), (all, with_sum, radius)];
        let moves = |errors: &Six| *errors != [zero; 6];
        let [repeatable, random, total] = kinds.map(|(kind, places, radius)| {
            let first = kind.iter().filter_map(|errors| errors.iter().position(moves)).min();
            let first = first.unwrap_or(spec.frames.len());
            let moved = kind.iter().map(|errors| match &tree {
                Some((parts, ..)) => ToolDisplacement::of_tree(g, spec, parts, &rows, errors),
                None => ToolDisplacement::by(g, spec, &links, &rows, errors, first),
            });
            let moved: Vec<ToolDisplacement> = moved.collect();
            let symbols = g.symbols(kind.concat().as_flattened());
            let is_constant = symbols.iter().all(|symbol| matches!(symbol, Symbol::Parameter(_)));
            let most_signed = if is_constant || tree.is_some() { MOST_SIGNED } else { 0 };
            let has_parts = |place: &usize| places.iter().filter(|other| *other == place).count() > 1;
            let most_signed = if places.iter().any(has_parts) { 0 } else { most_signed };
            let [norm, x, y, z, turn] = largest_of(g, &moved, &places, most_signed);
            // Behind the leading rotations about z.
            let across_z: Vec<Vec<Node>> = moved.iter().map(|moved| moved.across_z.to_vec()).collect();
            let across_z = largest_sum(g, &across_z, &places, most_signed);
            let [norm, x, y, z, across_z] = [norm, x, y, z, across_z].map(|sum| sum.and_radius(g, radius));
            ([norm, x, y, z, turn], across_z)
        });
        let across_z = [repeatable.1, random.1, total.1];
        let (apart, implicit) = tree.map_or((Some(apart), Vec::new()), |(_, implicit, _)| (None, implicit));
        let (repeatable, random, total) = (repeatable.0, random.0, total.0);
        Self { graph, repeatable, random, total, across_z, apart, implicit }
    }
}

/// Returns the largest magnitudes of the sum of displacements with any signs.
fn largest_of(
    graph: &mut Graph,
    moved: &[ToolDisplacement],
    places: &[usize],
    most_signed: usize,
) -> [Magnitude; 5] {
    let along = |axis: usize| moved.iter().map(|moved| vec![moved.along[axis]]).collect::<Vec<_>>();
    let norm = |of: fn(&ToolDisplacement) -> Vector| moved.iter().map(|moved| of(moved).to_vec()).collect();
    let vectors = [norm(|moved| moved.shift), along(0), along(1), along(2), norm(|moved| moved.turn)];
    vectors.map(|vectors| largest_sum(graph, &vectors, places, most_signed))
}

/// Returns the largest norm of the sum of vectors of one, two or three entries with any signs: over
/// all patterns of signs of at most `most_signed` vectors, or over all directions. Vectors with the
/// same place are parts of one error.
fn largest_sum(graph: &mut Graph, vectors: &[Vec<Node>], places: &[usize], most_signed: usize) -> Magnitude {
    let zero = graph.zero();
    let (vectors, places): (Vec<&Vec<Node>>, Vec<usize>) =
        vectors.iter().zip(places).filter(|(vector, _)| vector.iter().any(|entry| *entry != zero)).unzip();
    if let [vector] = vectors[..] {
        let node = graph.products(vector, vector);
        return Magnitude { node, squared: true, parts: vector.clone(), largest_of: Vec::new() };
    }
    if vectors.len() <= most_signed && vectors.iter().all(|vector| vector.len() > 1) {
        return largest_pattern(graph, &vectors);
    }
    let unit = direction(graph, vectors.first().map_or(1, |vector| vector.len()));
    let parts: Vec<Node> = vectors.into_iter().map(|vector| graph.products(vector, &unit)).collect();
    let mut node = zero;
    for (first, place) in places.iter().enumerate().filter(|(k, place)| !places[..*k].contains(place)) {
        let own: Vec<Node> =
            places.iter().zip(&parts).filter(|(other, _)| *other == place).map(|(_, part)| *part).collect();
        let size = match own.len() {
            1 => graph.call(Function::Abs, parts[first]),
            _ => {
                let square = graph.products(&own, &own);
                graph.sqrt(square)
            }
        };
        node = graph.add(node, size);
    }
    Magnitude { node, squared: false, parts, largest_of: Vec::new() }
}

/// Largest number of errors whose patterns of signs are all written down, which is faster for
/// constant ones: the corners of a box are control points, and there are as many more for
/// directions. For trees each pattern has a bound of its own.
const MOST_SIGNED: usize = 7;

/// Returns the largest norm of the sum of vectors over all patterns of signs but that of the first.
fn largest_pattern(graph: &mut Graph, vectors: &[&Vec<Node>]) -> Magnitude {
    let parts = vectors.iter().copied().flatten().copied().collect();
    let Some((first, others)) = vectors.split_first() else {
        return Magnitude { node: graph.zero(), squared: true, parts, largest_of: Vec::new() };
    };
    let mut sums = vec![(*first).clone()];
    for vector in others {
        let with = |graph: &mut Graph, sum: &Vec<Node>, is_added: bool| {
            let entries = sum.iter().zip(*vector);
            let entry = |(a, b): (&Node, &Node)| if is_added { graph.add(*a, *b) } else { graph.sub(*a, *b) };
            entries.map(entry).collect::<Vec<Node>>()
        };
        sums = sums.iter().flat_map(|sum| [true, false].map(|is_added| with(graph, sum, is_added))).collect();
    }
    let squares: Vec<Node> = sums.iter().map(|sum| graph.products(sum, sum)).collect();
    let node = squares.iter().copied().reduce(|a, b| graph.max(a, b)).unwrap_or(graph.zero());
    Magnitude { node, squared: true, parts, largest_of: squares }
}

/// Returns a unit vector of one, two or three entries.
fn direction(graph: &mut Graph, entries: usize) -> Vec<Node> {
    if entries == 1 {
        return vec![graph.constant(1.0)];
    }
    let [azimuth, elevation] = DIRECTION.map(|(symbol, _)| {
        let angle = graph.symbol(symbol);
        [Function::Cos, Function::Sin].map(|function| graph.call(function, angle))
    });
    match entries {
        2 => azimuth.to_vec(),
        _ => {
            let [x, y] = azimuth.map(|part| graph.mul(elevation[0], part));
            vec![x, y, elevation[1]]
        }
    }
}

impl ToolDisplacement {
    /// Computes the displacement by errors; `shift` is in the axes of frame `first`, before which
    /// there are none.
    fn by(graph: &mut Graph, spec: &Spec, links: &Links, rows: &Rows, errors: &[Six], first: usize) -> Self {
        let none = Displacement::none(graph);
        let (Displacement { shift, mut turn }, _) = links.behind(graph, errors, first, none);
        let none = Displacement::none(graph);
        let [x, y, z, four, five, six] = links.accumulate(graph, errors, 0, none).column(graph, rows);
        let none = Displacement::none(graph);
        let [across_x, across_y, _] = links.accumulate(graph, errors, links.leading_turns(), none).shift;
        if spec.orientation != Orientation::RotationVector {
            turn = [four, five, six];
        }
        Self { shift, along: [x, y, z], across_z: [across_x, across_y], turn }
    }

    /// Computes the displacement of a tree of frames.
    fn of_tree(graph: &mut Graph, spec: &Spec, parts: &Parts, rows: &Rows, errors: &[Six]) -> Self {
        let [shift, turn] = parts.by_errors(graph, errors);
        let [x, y, z, four, five, six] = rows.column(graph, shift, turn);
        let turn = if spec.orientation == Orientation::RotationVector { turn } else { [four, five, six] };
        Self { shift, along: [x, y, z], across_z: [x, y], turn }
    }
}
