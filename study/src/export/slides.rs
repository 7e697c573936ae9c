//! Machine tools of slides: X, Y and Z, each along an axis of `F_0`, one on the other; the workpiece is at rest or on axes that turn it,
//! which are at 0 where a table of slides is made.

use abbe::{Error, Manipulator, Orientation, Pose, VariableKind, deviation};
use abbe_spec::diagnostic::Diagnostics;

use super::found::{Errors, Found};
use crate::mistake;

/// A slide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slide {
    pub(super) variable: usize,
    pub(super) frame: usize,
    /// 0 = X, 1 = Y, 2 = Z.
    pub(super) axis: usize,
    /// Its limits.
    pub(super) range: [f64; 2],
}

impl Slide {
    pub(super) fn letter(&self) -> char {
        ['X', 'Y', 'Z'][self.axis.min(2)]
    }

    /// So many values from one limit to the other.
    pub(super) fn nodes(&self, count: usize) -> Vec<f64> {
        abbe::analysis::sampling::grid(self.range, count)
    }
}

/// The axes of a machine tool.
pub(super) struct Axes {
    /// From the bed on.
    pub(super) slides: Vec<Slide>,
    /// The variables of those that turn the workpiece.
    pub(super) turning: Vec<usize>,
}

/// The axes of a machine; a machine of another kind is a mistake.
pub(super) fn axes(found: &Found) -> Result<Axes, Diagnostics> {
    let spec = &found.spec;
    let refused = |name: &str, reason: &str| {
        let help = "such tables are for slides along X, Y and Z of F_0 that carry the tool, behind axes that turn the workpiece if there are any; every machine has `--to table`";
        Err(mistake::with_help(&found.origin, format!("`{name}` {reason}"), help))
    };
    let evaluated = |error: Error| mistake::whole(&found.origin, &error);
    let zero = vec![0.0; spec.variables.len()];
    let up_to = |q: &[f64], frame: usize| {
        let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
        let done = found.manipulator.transforms(q, &found.s, &mut transforms).map_err(evaluated);
        done.map(|()| transforms[..=frame].iter().fold(Pose::IDENTITY, |pose, next| pose.then(next)))
    };
    let (mut slides, mut turning): (Vec<Slide>, Vec<usize>) = (Vec::new(), Vec::new());
    // A slide is followed by slides alone.
    let first =
        spec.variables.iter().filter(|one| one.kind == VariableKind::Prismatic).map(|one| one.frame).min();
    for (i, variable) in spec.variables.iter().enumerate() {
        let (name, frame) = (variable.name.as_str(), variable.frame);
        match (variable.kind, first) {
            (VariableKind::Prismatic, _) => {}
            (VariableKind::Revolute, None) => return refused(name, "turns, and nothing slides"),
            (VariableKind::Revolute, Some(first)) if frame > first => {
                return refused(name, "turns the tool, which a slide carries");
            }
            (VariableKind::Revolute, Some(_)) => {
                turning.push(i);
                continue;
            }
        }
        if !variable.limits.iter().all(|limit| limit.is_finite()) {
            return refused(name, "has no limits, between which the table would go");
        }
        let mut q = zero.clone();
        q[i] = 1.0;
        let (from, to) = (up_to(&zero, frame)?, up_to(&q, frame)?);
        let moved: [f64; 3] = std::array::from_fn(|k| to.position()[k] - from.position()[k]);
        let along = |axis: usize| (0..3).all(|k| (moved[k] - f64::from(u8::from(k == axis))).abs() < 1e-9);
        let Some(axis) = (0..3).find(|axis| along(*axis)) else {
            return refused(name, "does not slide along X, Y or Z of F_0, in their direction");
        };
        let parallel = (0..3).all(|k| (0..3).all(|l| (from.0[k][l] - Pose::IDENTITY.0[k][l]).abs() < 1e-9));
        if !parallel {
            return refused(name, "moves a frame that is turned against F_0");
        }
        if slides.iter().any(|other| other.axis == axis) {
            return refused(name, "slides along the same axis as another one");
        }
        slides.push(Slide { variable: i, frame, axis, range: variable.limits });
    }
    slides.sort_by_key(|slide| slide.frame);
    Ok(Axes { slides, turning })
}

impl Axes {
    /// A slide at a value, the others at home, what turns at 0, and the inputs as they are.
    pub(super) fn at(&self, found: &Found, k: usize, value: f64) -> (Vec<f64>, Vec<f64>) {
        let (mut q, u) = found.at_home(self.slides[k].variable, value);
        self.turning.iter().for_each(|variable| q[*variable] = 0.0);
        (q, u)
    }

    /// The errors of the slides and of what is behind them.
    pub(super) fn errors(&self, found: &Found, q: &[f64], u: &[f64]) -> Result<Errors, Error> {
        let mut errors = found.errors_at(q, u)?;
        if !self.turning.is_empty() {
            let before = self.slides.first().map_or(0, |slide| slide.frame);
            errors.frames[..before].fill([0.0; 6]);
            errors.numbers[..before].fill([0.0; 4]);
            self.turning.iter().for_each(|variable| errors.joints[*variable] = 0.0);
        }
        Ok(errors)
    }
}

/// Where the tool is with all slides at 0, from the reference point: the origin of the first slide's frame there.
pub(super) struct Reference {
    point: [f64; 3],
    pub(super) tool: [f64; 3],
}

impl Reference {
    pub(super) fn new(found: &Found, axes: &Axes) -> Result<Self, Error> {
        let zero = vec![0.0; found.spec.variables.len()];
        let (links, _) = found.links(&zero, &Errors::none(&found.spec))?;
        let first = axes.slides.first().map_or(0, |slide| slide.frame + 1);
        let point =
            links[..first].iter().fold(Pose::IDENTITY, |pose, link| pose.then(&link.transform)).position();
        let tool = found.manipulator.pose(&zero, &found.s)?.position();
        Ok(Self { point, tool: difference(tool, point) })
    }

    /// The six errors of a carriage as ISO 230-1 has them, actual minus nominal: along X, Y and Z of the reference point that moves with it, then
    /// about X, Y and Z. The other slides are at home, and what turns at 0.
    ///
    /// With the small motion `(t, θ) = A⁻¹ Ã E` of the frame and `r` from its origin to the reference point: `t + θ × r`.
    pub(super) fn errors(&self, found: &Found, axes: &Axes, k: usize, value: f64) -> Result<[f64; 6], Error> {
        let slide = axes.slides[k];
        let (q, u) = axes.at(found, k, value);
        let (nominal, _) = found.links(&q, &Errors::none(&found.spec))?;
        let (real, _) = found.links(&q, &axes.errors(found, &q, &u)?)?;
        let i = slide.frame;
        let moved = nominal[i].transform.inverse().then(&real[i].transform).then(&real[i].error);
        let [x, y, z, a, b, c] = deviation(Orientation::RotationVector, &Pose::IDENTITY, &moved);
        let frame =
            nominal[..=i].iter().fold(Pose::IDENTITY, |pose, link| pose.then(&link.transform)).position();
        let mut point = self.point;
        axes.slides[..=k].iter().for_each(|slide| point[slide.axis] += q[slide.variable]);
        let r = difference(point, frame);
        let swing = [b * r[2] - c * r[1], c * r[0] - a * r[2], a * r[1] - b * r[0]];
        Ok([x + swing[0], y + swing[1], z + swing[2], a, b, c])
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// The value at `x` of a table with rising nodes, straight between them and level beyond.
pub(super) fn interpolated<const N: usize>(nodes: &[f64], rows: &[[f64; N]], x: f64) -> [f64; N] {
    let above = nodes.partition_point(|node| *node <= x);
    match (above.checked_sub(1).map(|i| (nodes[i], rows[i])), nodes.get(above).zip(rows.get(above))) {
        (Some((from, low)), Some((to, high))) => {
            let share = (x - from) / (to - from);
            std::array::from_fn(|i| low[i] + share * (high[i] - low[i]))
        }
        (Some((_, row)), None) => row,
        (None, Some((_, row))) => *row,
        (None, None) => [0.0; N],
    }
}
