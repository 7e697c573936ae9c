//! Axes of joints as lines in `F_0`, with all joints at zero.

use std::cell::RefCell;

use abbe_core::VariableKind;
use abbe_spec::{Expression, Factor, Spec, Symbol};

use crate::chain::lower_pairs::couplings;
use crate::chain::symbol_jacobian::{Steps, twist};
use crate::chain::walk::apply_with;
use crate::graph::{Frame, Graph, Node, Vector};

/// Distance, relative to the size of the manipulator, and sine below which axes intersect or are
/// parallel: angles of many specs have that many digits.
const STRUCTURE: f64 = 1e-9;
/// Angle of two axes in rad below which they are parallel.
const PARALLEL: f64 = 1e-8;
/// Distance of the point where two axes intersect, compared with the size, beyond which they do not
/// count as intersecting: it would have few digits.
const FAR: f64 = 1e4;
/// Largest relative difference of numbers that count as equal.
const SAME: f64 = 1e-12;
/// Number of sets of parameters at which a structure is verified.
const PROBES: usize = 4;

/// Axis of a joint: a unit vector, and a point on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) kind: VariableKind,
    pub(super) along: Vector,
    pub(super) at: Vector,
}

/// Axes of a chain, and the pose of the tool point, with all joints at zero.
#[derive(Clone, Debug)]
pub(super) struct Lines {
    pub(super) lines: Vec<Line>,
    pub(super) tool: Frame,
    pub(super) probes: Probes,
    /// Earlier joints that move the frame of each, with their shares.
    pub(super) couplings: Vec<Vec<(usize, f64)>>,
}

/// Values of the parameters at which nodes are compared: the nominal ones, and others around them.
/// A structure must hold for all, as it does if the parameters have no influence on it.
#[derive(Clone, Debug)]
pub(super) struct Probes {
    parameters: [Vec<f64>; PROBES],
    /// Values of the first nodes of the graph, for each set.
    values: RefCell<[Vec<f64>; PROBES]>,
    /// Size of the manipulator, in its unit.
    pub(super) size: f64,
}

impl Lines {
    /// Returns `None` if the frames of a chain are not all lower pairs.
    pub(super) fn new(g: &mut Graph, spec: &Spec) -> Option<Self> {
        if !spec.is_serial() {
            return None;
        }
        let couplings = couplings(spec).into_iter().collect::<Option<Vec<_>>>()?;
        let joints = couplings.into_iter().zip(&spec.frames);
        let couplings = joints.filter_map(|(others, frame)| frame.variable.map(|_| others)).collect();
        let mut probes = Probes::new(spec);
        let mut lines: Vec<Option<Line>> = vec![None; spec.variables.len()];
        let mut at = g.identity();
        for frame in &spec.frames {
            for factor in &frame.factors {
                if let Some(own) = frame.variable
                    && depends(factor, own)
                {
                    lines[own] = Some(line(g, &at, factor, own, spec.variables[own].kind));
                }
                at = at_zero(g, at, factor);
            }
        }
        let tool = spec.tool.iter().fold(at, |at, factor| at_zero(g, at, factor));
        let mut lines: Vec<Line> = lines.into_iter().collect::<Option<_>>()?;
        let places = lines.iter().flat_map(|line| line.at).chain(tool.position);
        let places: Vec<Node> = places.collect();
        probes.measure(g, &places);
        for line in &mut lines {
            line.along = line.along.map(|part| probes.cleaned(g, part, 1.0));
            line.at = line.at.map(|part| probes.cleaned(g, part, probes.size));
        }
        let axes = tool.axes.map(|axis| axis.map(|part| probes.cleaned(g, part, 1.0)));
        let position = tool.position.map(|part| probes.cleaned(g, part, probes.size));
        Some(Self { lines, tool: Frame { axes, position }, probes, couplings })
    }
}

/// Returns the axis of a factor behind a frame.
pub(super) fn line(g: &mut Graph, before: &Frame, factor: &Factor, own: usize, kind: VariableKind) -> Line {
    let symbol = Symbol::Variable(own);
    let (after, step) = apply_with(g, *before, factor, &|g, amount| g.lower(amount));
    let place = if matches!(factor, Factor::Matrix(_)) { after.position } else { before.position };
    let steps = Steps::new(g, vec![step]);
    let [velocity, turn] = twist(g, &steps, symbol, place);
    let along = if kind == VariableKind::Revolute { turn } else { velocity };
    let offset = g.cross(turn, velocity);
    let at = if kind == VariableKind::Revolute { g.add_vectors(place, offset) } else { before.position };
    let zero = g.zero();
    let nodes = [along, at].concat();
    let nodes = g.substitute(&nodes, |given| matches!(given, Symbol::Variable(_)).then_some(zero));
    Line { kind, along: [nodes[0], nodes[1], nodes[2]], at: [nodes[3], nodes[4], nodes[5]] }
}

fn depends(factor: &Factor, own: usize) -> bool {
    factor.expressions().iter().any(|amount| amount.symbols().any(|symbol| symbol == Symbol::Variable(own)))
}

/// Extends a pose by a factor with all joints at zero.
pub(super) fn at_zero(g: &mut Graph, at: Frame, factor: &Factor) -> Frame {
    let lower = |g: &mut Graph, amount: &Expression| {
        let (amount, zero) = (g.lower(amount), g.zero());
        g.substitute(&[amount], |symbol| {
            matches!(symbol, Symbol::Variable(_) | Symbol::Local(_)).then_some(zero)
        })[0]
    };
    apply_with(g, at, factor, &lower).0
}

impl Probes {
    /// Returns the parameters of a spec, with a size of 1 until places are measured.
    pub(super) fn new(spec: &Spec) -> Self {
        let nominal: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
        let around = |probe: usize| {
            let change = |i: usize| 0.1 * ((1 + i + 7 * probe) as f64 * 0.618_033_988_749_894_9).fract();
            let scale = |value: f64| if value == 0.0 { 1.0 } else { value };
            let other = |(i, value): (usize, &f64)| value + scale(*value) * change(i);
            if probe == 0 { nominal.clone() } else { nominal.iter().enumerate().map(other).collect() }
        };
        Self { parameters: std::array::from_fn(around), values: RefCell::default(), size: 1.0 }
    }

    /// Takes the largest coordinate of some places that no joint moves as the size.
    pub(super) fn measure(&mut self, g: &Graph, places: &[Node]) {
        let values = self.values(g, places, 0);
        self.size = values.iter().fold(f64::MIN_POSITIVE, |largest, value| value.abs().max(largest));
    }

    fn values(&self, g: &Graph, nodes: &[Node], probe: usize) -> Vec<f64> {
        let values = &mut self.values.borrow_mut()[probe];
        let count = nodes.iter().map(|node| node.index() + 1).max().unwrap_or(0);
        g.extend_values(values, count, |symbol| match symbol {
            Symbol::Parameter(i) => self.parameters[probe][i],
            // Nothing else may be asked for.
            _ => f64::NAN,
        });
        nodes.iter().map(|node| values[node.index()]).collect()
    }

    /// Returns the value of a node that no joint moves, with nominal parameters.
    pub(super) fn nominal(&self, g: &Graph, node: Node) -> f64 {
        self.values(g, &[node], 0)[0]
    }

    /// Returns `true` if nodes of a size are 0 with any parameters.
    pub(super) fn are_zero(&self, g: &Graph, nodes: &[Node], size: f64) -> bool {
        let is_zero =
            |probe| self.values(g, nodes, probe).iter().all(|value| value.abs() <= STRUCTURE * size);
        (0..PROBES).all(is_zero)
    }

    /// Replaces a node that does not depend on parameters by its value, free of rounding errors
    /// around 0 and ±1 of its size.
    pub(super) fn cleaned(&self, g: &mut Graph, node: Node, size: f64) -> Node {
        let values: Vec<f64> = (0..PROBES).map(|probe| self.values(g, &[node], probe)[0]).collect();
        if values.iter().any(|value| (value - values[0]).abs() > SAME * size) {
            return node;
        }
        let near = [0.0, size, -size].into_iter().find(|near| (near - values[0]).abs() < 1e-3 * SAME * size);
        g.constant(near.unwrap_or(values[0]))
    }

    pub(super) fn cleaned_vector(&self, g: &mut Graph, v: Vector, size: f64) -> Vector {
        v.map(|part| self.cleaned(g, part, size))
    }

    pub(super) fn are_parallel(&self, g: &mut Graph, a: Vector, b: Vector) -> bool {
        let cross = g.cross(a, b);
        self.are_zero(g, &cross, PARALLEL / STRUCTURE)
    }

    /// Returns the point where two lines intersect.
    pub(super) fn common_point(&self, g: &mut Graph, a: &Line, b: &Line) -> Option<Vector> {
        if self.are_parallel(g, a.along, b.along) {
            return None;
        }
        let normal = g.cross(a.along, b.along);
        let between = g.sub_vectors(b.at, a.at);
        let (apart, length) = (g.dot(normal, between), g.norm(normal));
        let apart = g.div(apart, length);
        let across = g.cross(between, b.along);
        let (way, square) = (g.dot(across, normal), g.dot(normal, normal));
        let way = g.div(way, square);
        let is_far = self.nominal(g, way).abs() > FAR * self.size;
        if is_far || !self.are_zero(g, &[apart], self.size) {
            return None;
        }
        let point = g.add_scaled(a.at, way, a.along);
        Some(self.cleaned_vector(g, point, self.size))
    }

    /// Returns `a − b` of two points that no joint moves.
    pub(super) fn between(&self, g: &mut Graph, a: Vector, b: Vector) -> Vector {
        let way = g.sub_vectors(a, b);
        self.cleaned_vector(g, way, self.size)
    }

    /// Returns the vector from a line to a point, perpendicular to the line.
    pub(super) fn offset(&self, g: &mut Graph, line: &Line, point: Vector) -> Vector {
        let from = g.sub_vectors(point, line.at);
        let flat = reject(g, line.along, from);
        self.cleaned_vector(g, flat, self.size)
    }
}

/// Returns the part of a vector perpendicular to a unit vector.
pub(super) fn reject(g: &mut Graph, along: Vector, v: Vector) -> Vector {
    let height = g.dot(along, v);
    let parallel = g.scale(height, along);
    g.sub_vectors(v, parallel)
}
