//! The exact chain with the errors of the spec's own sources: equation (6) with true rotations.
//!
//! Every source has a magnitude m that multiplies its errors: 1 for a repeatable source; for a
//! random source 0 in the pose without random errors, and the drawn number in a Monte Carlo draw.
//! At one frame the order is:
//!
//! ```text
//! Π_i  A_i(q + Σ m δq, s + Σ m δs)  ·  Π L E_M(m e) L⁻¹  ·  E_i(Σ m e)          then  T(s + Σ m δs)
//! ```
//!
//! first the deviating numbers of `A_i`, including those of a `dh` frame; then the errors located
//! elsewhere on the link, in the order of the file; then the sum of all errors at the frame itself.
//! To first order the order does not matter.

use abbe_core::Component;
use abbe_spec::{ChainNumber, Expression, Factor, Motion, Spec, Symbol, motion};

use super::walk::{apply_with, walk};
use super::{Causes, Links, Local, transform};
use crate::graph::{Frame, Graph, Node, Six, Vector, in_programs};

/// The chain with the errors of all sources, each times its magnitude.
pub(super) struct RealChain<'a> {
    spec: &'a Spec,
    causes: &'a Causes,
    magnitudes: Vec<Node>,
    /// Deviation of each number of the chain.
    deviations: Vec<(ChainNumber, Node)>,
}

impl<'a> RealChain<'a> {
    /// Creates the chain; `magnitudes` has one node for each enabled source.
    pub(super) fn new(graph: &mut Graph, spec: &'a Spec, causes: &'a Causes, magnitudes: Vec<Node>) -> Self {
        let mut deviations: Vec<(ChainNumber, Node)> = Vec::new();
        for deviation in &causes.deviations {
            let error = graph.mul(magnitudes[deviation.source], deviation.error);
            match deviations.iter_mut().find(|(number, _)| *number == deviation.number) {
                Some((_, sum)) => *sum = graph.add(*sum, error),
                None => deviations.push((deviation.number, error)),
            }
        }
        deviations.retain(|(_, error)| *error != graph.zero());
        Self { spec, causes, magnitudes, deviations }
    }

    /// Returns the poses of all frames and `A_T` of the real machine, without errors that are
    /// always zero.
    pub(super) fn poses(&self, graph: &mut Graph) -> Vec<Frame> {
        let mut poses = self.poses_below(graph, None);
        poses.push(self.behind(graph, poses[self.spec.tool_frame], self.spec.frames.len()));
        poses
    }

    /// Returns the poses of all frames of the real machine relative to one of them, or to `F_0`;
    /// those of frames that do not hang on it are the identity.
    pub(super) fn poses_below(&self, graph: &mut Graph, root: Option<usize>) -> Vec<Frame> {
        let identity = graph.identity();
        let mut poses = Vec::with_capacity(self.spec.frames.len() + 1);
        for (link, frame) in self.spec.frames.iter().enumerate() {
            let is_below = root.is_none_or(|root| root != link && self.spec.carries(root, link));
            let before = frame.parent.map_or(identity, |parent| poses[parent]);
            poses.push(if is_below { self.behind(graph, before, link) } else { identity });
        }
        poses
    }

    /// Returns a length between two frames with the deviations of its numbers.
    pub(super) fn length(&self, graph: &mut Graph, length: &Expression) -> Node {
        graph.lower_with(length, &|graph, symbol| self.value(graph, symbol))
    }

    /// Returns the value of a symbol with its deviation.
    fn value(&self, graph: &mut Graph, symbol: Symbol) -> Node {
        let node = graph.symbol(in_programs(symbol));
        self.deviation_of(symbol).map_or(node, |error| graph.add(node, error))
    }

    /// Extends a pose by a link of the real machine; the tool is the last link.
    fn behind(&self, graph: &mut Graph, pose: Frame, link: usize) -> Frame {
        let pose = self.nominal(graph, pose, link);
        if link < self.spec.frames.len() { self.displaced(graph, pose, link) } else { pose }
    }

    /// Returns the real machine as local motions.
    pub(super) fn links(&self, graph: &mut Graph) -> Links {
        let identity = graph.identity();
        let links: Vec<Frame> =
            (0..=self.spec.frames.len()).map(|link| self.behind(graph, identity, link)).collect();
        Links::from_frames(graph, &links)
    }

    /// Returns the tool point of the real machine relative to the first frame with an error, in the
    /// nominal axes of that frame, or of the frame before it if a number of its transform deviates.
    /// Returns zero for a chain without errors.
    pub(super) fn tool_point_from_first_error(&self, graph: &mut Graph) -> Vector {
        let (zero, last) = (graph.zero(), self.spec.frames.len());
        let mut point = [zero; 3];
        let is_off =
            |graph: &mut Graph, link| self.is_changed(link) || link < last && self.has_errors(graph, link);
        let Some(first) = (0..=last).find(|&link| is_off(graph, link)) else { return point };
        for link in (first..=last).rev() {
            let mut motions = Vec::new();
            let start = graph.identity();
            if self.is_changed(link) {
                let nominal = self.nominal(graph, start, link);
                motions.extend(Local::from_frame(graph, &nominal));
            } else if link > first {
                motions.extend(Local::motions(graph, self.factors(link)));
            }
            if link < last && self.has_errors(graph, link) {
                let errors = self.displaced(graph, start, link);
                motions.extend(Local::from_frame(graph, &errors));
            }
            point = motions.iter().rev().fold(point, |point, motion| motion.point(graph, point));
        }
        point
    }

    /// Returns `true` if errors follow the `A_i` of a frame.
    fn has_errors(&self, graph: &mut Graph, frame: usize) -> bool {
        let none = [graph.zero(); 6];
        self.plain(graph, frame) != none || !self.located(graph, frame).is_empty()
    }

    /// Returns the six errors of every frame that make the nominal chain the real one. `E_i` is the
    /// product of all motions that follow the nominal `A_i`; the last one includes the tool's part,
    /// `T(s + δs) T⁻¹`.
    pub(super) fn errors(&self, graph: &mut Graph) -> Vec<Six> {
        let last = self.spec.frames.len();
        let errors = |graph: &mut Graph, frame: usize| {
            let of_tool = frame + 1 == last && self.is_changed(last);
            if !self.is_changed(frame) && !of_tool && self.located(graph, frame).is_empty() {
                return self.plain(graph, frame);
            }
            let start = graph.identity();
            let mut real = self.nominal(graph, start, frame);
            real = self.displaced(graph, real, frame);
            if of_tool {
                real = self.nominal(graph, real, last);
                let tool = transform(graph, &self.spec.tool);
                let back = graph.inverse(&tool);
                real = graph.then(&real, &back);
            }
            let nominal = transform(graph, &self.spec.frames[frame].factors);
            let back = graph.inverse(&nominal);
            let motion = graph.then(&back, &real);
            errors_of_motion(graph, &motion)
        };
        (0..last).map(|frame| errors(graph, frame)).collect()
    }

    /// Returns `true` if there are errors other than those at the frames themselves.
    pub(super) fn is_more_than_errors_of_frames(&self, graph: &mut Graph) -> bool {
        !self.deviations.is_empty()
            || (0..self.spec.frames.len()).any(|frame| !self.located(graph, frame).is_empty())
    }

    /// Returns the factors of a frame, or of the tool behind the last frame.
    fn factors(&self, frame: usize) -> &[Factor] {
        self.spec.frames.get(frame).map_or(&self.spec.tool, |frame| &frame.factors)
    }

    fn deviation(&self, number: ChainNumber) -> Option<Node> {
        self.deviations.iter().find(|(known, _)| *known == number).map(|(_, error)| *error)
    }

    fn deviation_of(&self, symbol: Symbol) -> Option<Node> {
        match symbol {
            Symbol::Variable(i) => self.deviation(ChainNumber::Joint(i)),
            Symbol::Parameter(i) => self.deviation(ChainNumber::Parameter(i)),
            _ => None,
        }
    }

    /// Returns the deviation of factor `place` of a Denavit-Hartenberg frame.
    fn deviation_of_factor(&self, frame: usize, place: usize) -> Option<Node> {
        let number = *self.spec.frames.get(frame)?.convention?.order().get(place)?;
        self.deviation(ChainNumber::DenavitHartenberg { frame, number })
    }

    fn is_changed(&self, frame: usize) -> bool {
        let factors = self.factors(frame);
        let mut symbols = factors.iter().flat_map(Factor::expressions).flat_map(Expression::symbols);
        symbols.any(|symbol| self.deviation_of(symbol).is_some())
            || (0..factors.len()).any(|place| self.deviation_of_factor(frame, place).is_some())
    }

    /// Extends a pose by `A_i` with the deviations of its numbers.
    fn nominal(&self, graph: &mut Graph, pose: Frame, frame: usize) -> Frame {
        let factors = self.factors(frame);
        if !self.is_changed(frame) {
            return walk(graph, pose, factors, &mut Vec::new());
        }
        let value = |graph: &mut Graph, symbol: Symbol| self.value(graph, symbol);
        factors.iter().enumerate().fold(pose, |pose, (place, factor)| {
            let more = self.deviation_of_factor(frame, place);
            let lower = |graph: &mut Graph, amount: &Expression| {
                let amount = graph.lower_with(amount, &value);
                more.map_or(amount, |error| graph.add(amount, error))
            };
            apply_with(graph, pose, factor, &lower).0
        })
    }

    /// Extends a pose by all errors that follow `A_i`.
    fn displaced(&self, graph: &mut Graph, mut pose: Frame, frame: usize) -> Frame {
        for (place, errors) in self.located(graph, frame) {
            pose = graph.then(&pose, &place);
            pose = displaced(graph, pose, &errors);
            let back = graph.inverse(&place);
            pose = graph.then(&pose, &back);
        }
        let errors = self.plain(graph, frame);
        displaced(graph, pose, &errors)
    }

    /// Returns the poses on the link of a frame that have errors, with these errors. Those of `F_0`
    /// are the first: they precede `A_1` with the deviations of its numbers.
    fn located(&self, graph: &mut Graph, frame: usize) -> Vec<(Frame, Six)> {
        let zero = graph.zero();
        let at_frame = self.causes.errors.iter().filter(|caused| caused.frame == frame);
        let (of_base, others): (Vec<_>, Vec<_>) = at_frame.partition(|caused| caused.of_base.is_some());
        let located = of_base.into_iter().chain(others).filter_map(|caused| {
            let errors = caused.errors.map(|error| graph.mul(self.magnitudes[caused.source], error));
            let place = caused.place.filter(|_| errors != [zero; 6])?;
            let Some(of_base) = caused.of_base else { return Some((place, errors)) };
            let identity = graph.identity();
            let first = self.nominal(graph, identity, frame);
            let back = graph.inverse(&first);
            Some((graph.then(&back, &of_base), errors))
        });
        located.collect()
    }

    /// Returns the sum of the errors at a frame itself: within each source, then over the sources.
    fn plain(&self, graph: &mut Graph, frame: usize) -> Six {
        let mut sums = [graph.zero(); 6];
        for (source, magnitude) in self.magnitudes.iter().enumerate() {
            let mut of_source = [graph.zero(); 6];
            let here = |frame_of: usize, source_of: usize| frame_of == frame && source_of == source;
            for caused in self.causes.errors.iter().filter(|caused| here(caused.frame, caused.source)) {
                if caused.place.is_none() {
                    of_source = std::array::from_fn(|i| graph.add(of_source[i], caused.errors[i]));
                }
            }
            for (sum, error) in sums.iter_mut().zip(of_source) {
                *sum = graph.add_product(*sum, *magnitude, error);
            }
        }
        sums
    }
}

/// Returns a pose times `E = T(e_x, e_y, e_z) R_y(e_s) R_z(e_r) R_x(e_p)`, with errors in the order
/// of ε.
pub(crate) fn displaced(graph: &mut Graph, mut pose: Frame, errors: &Six) -> Frame {
    for (component, error) in Component::ALL.into_iter().zip(errors) {
        if *error == graph.zero() {
            continue;
        }
        pose = match motion(component) {
            (Motion::Translation, axis) => graph.moved(&pose, axis, *error),
            (Motion::Rotation, axis) => graph.turned(&pose, axis, *error),
        };
    }
    pose
}

/// Returns the six errors whose E is a given motion: position, and `R = R_y(σ) R_z(ρ) R_x(π)`.
fn errors_of_motion(graph: &mut Graph, motion: &Frame) -> Six {
    let ([x, y, z], [e_x, e_y, e_z]) = (motion.axes, motion.position);
    let (squares, minus) = ([x[0], x[2]].map(|entry| graph.mul(entry, entry)), graph.neg(x[2]));
    let sum = graph.add(squares[0], squares[1]);
    let cosine = graph.sqrt(sum);
    let (spin, roll) = (graph.atan2(minus, x[0]), graph.atan2(x[1], cosine));
    let minus = graph.neg(z[1]);
    let pitch = graph.atan2(minus, y[1]);
    [e_x, e_y, e_z, spin, roll, pitch]
}
