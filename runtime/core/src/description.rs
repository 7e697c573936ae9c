//! Description of a manipulator: names, units, limits and error sources.

use crate::{Component, List, Pose, Text};

/// Length unit of a manipulator's poses, Jacobians, variables and errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// Metres.
    Metre,
    /// Millimetres.
    Millimetre,
}

impl LengthUnit {
    /// Returns `m` or `mm`.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Millimetre => "mm",
        }
    }

    /// Returns the length of the unit in metres.
    pub const fn in_metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Millimetre => 1e-3,
        }
    }
}

/// Meaning of rows 4–6 of a Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    /// Small rotation in `F_0` axes. Has no singularity.
    RotationVector,
    /// Spin σ, roll ρ, pitch π of `R_T = R_y(σ) R_z(ρ) R_x(π)`. Singular at cos ρ = 0.
    EulerYzx,
    /// Table angles of IEC 61217: yaw ψ, pitch θ, roll φ of `R_T = R_z(ψ) R_x(θ) R_y(φ)`, in axes
    /// with z up and y towards the gantry. Singular at cos θ = 0.
    Iec61217,
}

impl Orientation {
    /// Returns the name in a spec file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RotationVector => "rotation-vector",
            Self::EulerYzx => "euler-yzx",
            Self::Iec61217 => "iec-61217",
        }
    }

    /// Returns the names of the six rows of a Jacobian.
    pub const fn rows(self) -> [&'static str; 6] {
        match self {
            Self::RotationVector => ["x", "y", "z", "rotation_x", "rotation_y", "rotation_z"],
            Self::EulerYzx => ["x", "y", "z", "spin", "roll", "pitch"],
            Self::Iec61217 => ["x", "y", "z", "yaw", "pitch", "roll"],
        }
    }

    /// Returns the axis of the last of the three rotations of Euler angles: 0 = x, 1 = y; `None`
    /// for a rotation vector.
    ///
    /// With the axes renamed in cyclic order so that this one is x, all Euler angles are those of
    /// `R_y R_z R_x`.
    pub const fn last_axis(self) -> Option<usize> {
        match self {
            Self::RotationVector => None,
            Self::EulerYzx => Some(0),
            Self::Iec61217 => Some(1),
        }
    }
}

/// Kind of a joint variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableKind {
    /// Angle in rad.
    Revolute,
    /// Length in the manipulator's unit.
    Prismatic,
}

/// Joint variable. Lengths are in the manipulator's unit, angles in rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name in the spec.
    pub name: Text,
    /// Revolute or prismatic.
    pub kind: VariableKind,
    /// Lower and upper limit, infinite where the spec has none.
    pub limits: [f64; 2],
    /// Value at the home configuration.
    pub home: f64,
}

impl Variable {
    /// Creates a variable from its fields.
    pub const fn new(name: &'static str, kind: VariableKind, limits: [f64; 2], home: f64) -> Self {
        Self { name: Text::Constant(name), kind, limits, home }
    }
}

/// Limits of a weighted sum of joint variables, `Σ wᵢ qᵢ`.
#[derive(Clone, Debug, PartialEq)]
pub struct SumLimit {
    /// Sum, as the spec writes it.
    pub sum: Text,
    /// Revolute if the sum is an angle, prismatic if it is a length.
    pub kind: VariableKind,
    /// Indices of the variables in ascending order, with their weights.
    pub terms: List<(usize, f64)>,
    /// Smallest and largest sum, in the length unit or rad; equal where joints move together.
    pub range: [f64; 2],
}

impl SumLimit {
    /// Creates a limit from its fields.
    pub const fn new(
        sum: &'static str,
        kind: VariableKind,
        terms: &'static [(usize, f64)],
        range: [f64; 2],
    ) -> Self {
        Self { sum: Text::Constant(sum), kind, terms: List::Constant(terms), range }
    }

    /// Returns the sum at joint variables `q`.
    pub fn value(&self, q: &[f64]) -> f64 {
        self.terms.iter().map(|(i, weight)| weight * q[*i]).sum()
    }

    /// Returns `true` if the sum is within its limits, up to rounding.
    pub fn permits(&self, q: &[f64]) -> bool {
        let size: f64 = self.terms.iter().map(|(i, weight)| (weight * q[*i]).abs()).sum();
        let rounding = 1e-9 * (1.0 + size);
        let value = self.value(q);
        value >= self.range[0] - rounding && value <= self.range[1] + rounding
    }
}

/// Frame `F_i` of the chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Name in the spec.
    pub name: Text,
    /// Index of the variable that the frame declares. `None` for a fixed frame.
    pub variable: Option<usize>,
    /// `true` if the frame is known to be a lower pair, or fixed: `A_i` depends at most on its own
    /// variable, which rotates it about or translates it along an axis fixed in `F_{i-1}`, one to
    /// one. For the last frame, `T` is constant too.
    ///
    /// If all frames are lower pairs, unreachable poses are recognized without a search.
    pub lower_pair: bool,
    /// Place in a tree of frames. `None` for a frame of a chain, which hangs on the one before it;
    /// the last one carries the tool.
    pub branch: Option<Branch>,
}

/// Place of a frame in a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Index of the frame that it hangs on, before its own; `None` for `F_0`.
    pub parent: Option<usize>,
    /// Passive variable that the frame declares: the loops of the manipulator determine its value.
    pub passive: Option<Variable>,
    /// `true` for the frame that carries the tool.
    pub carries_tool: bool,
}

impl Frame {
    /// Creates a frame without assumptions about its motion.
    pub const fn new(name: &'static str, variable: Option<usize>) -> Self {
        Self { name: Text::Constant(name), variable, lower_pair: false, branch: None }
    }

    /// Creates a frame that is a lower pair, or fixed.
    pub const fn lower_pair(name: &'static str, variable: Option<usize>) -> Self {
        Self { name: Text::Constant(name), variable, lower_pair: true, branch: None }
    }

    /// Creates a frame of a tree from its fields and those of its [`Branch`].
    pub const fn in_tree(
        name: &'static str,
        variable: Option<usize>,
        parent: Option<usize>,
        passive: Option<Variable>,
        carries_tool: bool,
    ) -> Self {
        let branch = Some(Branch { parent, passive, carries_tool });
        Self { name: Text::Constant(name), variable, lower_pair: false, branch }
    }
}

/// Structural parameter, in coherent units (the length unit, kg, s, rad, K).
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name in the spec.
    pub name: Text,
    /// Nominal value.
    pub nominal: f64,
    /// Coherent unit. Empty for a pure number or an angle.
    pub unit: Text,
}

impl Parameter {
    /// Creates a parameter from its fields.
    pub const fn new(name: &'static str, nominal: f64, unit: &'static str) -> Self {
        Self { name: Text::Constant(name), nominal, unit: Text::Constant(unit) }
    }
}

/// Input: a quantity that varies from use to use, in coherent units.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Name in the spec.
    pub name: Text,
    /// Default value.
    pub nominal: f64,
    /// Accepted range, infinite where the spec has none.
    pub range: [f64; 2],
    /// Values that are used, in ascending order; empty if it may have any in its range.
    pub levels: List<f64>,
    /// Coherent unit. Empty for a pure number or an angle.
    pub unit: Text,
}

impl Input {
    /// Creates an input that may have any value in its range from its fields.
    pub const fn new(name: &'static str, nominal: f64, range: [f64; 2], unit: &'static str) -> Self {
        Self::at_levels(name, nominal, range, &[], unit)
    }

    /// Creates an input from its fields.
    pub const fn at_levels(
        name: &'static str,
        nominal: f64,
        range: [f64; 2],
        levels: &'static [f64],
        unit: &'static str,
    ) -> Self {
        let (name, levels, unit) = (Text::Constant(name), List::Constant(levels), Text::Constant(unit));
        Self { name, nominal, range, levels, unit }
    }
}

/// Class of an error: whether its value is known, and the same at each visit of a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Has a known value and sign: adds with sign, and can be compensated.
    Repeatable,
    /// Has one fixed value in each machine, which is unknown: as built it adds as a random one, but
    /// it can be compensated. Machines vary by the distribution.
    Tolerance(Distribution),
    /// Varies unpredictably: adds as root sum of squares, and cannot be compensated.
    Random(Distribution),
}

impl Class {
    /// Returns the distribution of an error whose value is unknown; `None` for a repeatable one.
    pub const fn distribution(self) -> Option<Distribution> {
        match self {
            Self::Repeatable => None,
            Self::Tolerance(distribution) | Self::Random(distribution) => Some(distribution),
        }
    }

    /// Returns whether the error has a bound. A repeatable error always has: its value.
    pub const fn is_bounded(self) -> bool {
        match self.distribution() {
            None => true,
            Some(distribution) => distribution.is_bounded(),
        }
    }

    /// Returns the bound of the error in multiples of its magnitude.
    pub const fn bound(self) -> f64 {
        match self.distribution() {
            None => 1.0,
            Some(distribution) => distribution.bound(),
        }
    }

    /// Returns whether the error stays the same, so that a calibration can find it and a controller
    /// can compensate it.
    pub const fn can_be_compensated(self) -> bool {
        !matches!(self, Self::Random(_))
    }
}

/// Distribution of an error whose value is unknown, which defines the meaning of its magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// The magnitude is the half-width.
    Uniform,
    /// The magnitude is the standard deviation.
    Normal,
    /// The magnitude is the half-width; the center is most likely.
    Triangular,
    /// The magnitude is the amplitude of a sine of unknown phase, such as an eccentricity; the ends
    /// are most likely.
    Arcsine,
    /// The magnitude is the semi-axis of an ellipsoid, or of an ellipse, in which the errors of all
    /// parts together are evenly distributed. One error has two or three parts, each a source: the
    /// first part is in its place, the others follow all errors of the file.
    Ball {
        /// Number of this part, from 0.
        part: u8,
        /// Number of parts, 2 or 3.
        parts: u8,
    },
}

impl Distribution {
    /// All distributions; the last is the first part of an error with two or three parts.
    pub const ALL: [Self; 6] = [
        Self::Uniform,
        Self::Normal,
        Self::Triangular,
        Self::Arcsine,
        Self::Ball { part: 0, parts: 2 },
        Self::Ball { part: 0, parts: 3 },
    ];

    /// Returns the name in a spec file.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Normal => "normal",
            Self::Triangular => "triangular",
            Self::Arcsine => "arcsine",
            Self::Ball { parts: 2, .. } => "disc",
            Self::Ball { .. } => "ball",
        }
    }

    /// Returns whether no error exceeds [`bound`](Self::bound).
    pub const fn is_bounded(self) -> bool {
        !matches!(self, Self::Normal)
    }

    /// Returns the bound of an error in multiples of its magnitude: 3 for a normal error (3σ, which
    /// 0.27 % of the errors exceed), 1 for all others.
    pub const fn bound(self) -> f64 {
        if self.is_bounded() { 1.0 } else { 3.0 }
    }

    /// Returns the square of the [`divisor`](Self::divisor).
    pub const fn divisor_squared(self) -> f64 {
        match self {
            Self::Uniform => 3.0,
            Self::Normal => 1.0,
            Self::Triangular => 6.0,
            Self::Arcsine => 2.0,
            Self::Ball { parts, .. } => parts as f64 + 2.0,
        }
    }

    /// Returns the divisor of the magnitude that yields the standard uncertainty (GUM, 4.3.7 and
    /// 4.3.9): √3 for a uniform error, 1 for a normal, √6 for a triangular and √2 for an arcsine
    /// one, 2 and √5 along each semi-axis of a disc and of a ball.
    pub const fn divisor(self) -> f64 {
        match self {
            Self::Uniform => 1.732_050_807_568_877_2,
            Self::Normal => 1.0,
            Self::Triangular => 2.449_489_742_783_178,
            Self::Arcsine => core::f64::consts::SQRT_2,
            Self::Ball { parts: 2, .. } => 2.0,
            Self::Ball { .. } => 2.236_067_977_499_79,
        }
    }
}

/// Physical error source.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name in the spec.
    pub name: Text,
    /// Repeatable, or a tolerance or random with a distribution.
    pub class: Class,
    /// Degrees of freedom of the standard deviation of a normal error estimated from few
    /// measurements (GUM, G.3). Infinite if the standard deviation is known.
    pub degrees_of_freedom: f64,
    /// Location of the error: `joint q2`, `parameter a2`, `dh of elbow`, `frame elbow`.
    pub at: Text,
    /// Reference for its values, such as a data sheet.
    pub reference: Text,
}

impl Source {
    /// Place of the independent parts of a calibration's uncertainty, which are one error.
    pub const CALIBRATION: &'static str = "calibration";

    /// Returns whether the source is a part of a calibration's uncertainty. Such sources are the
    /// last ones.
    pub fn is_calibration(&self) -> bool {
        &*self.at == Self::CALIBRATION
    }

    /// Creates a source with infinite degrees of freedom.
    pub const fn new(name: &'static str, class: Class, at: &'static str, reference: &'static str) -> Self {
        Self::estimated(name, class, f64::INFINITY, at, reference)
    }

    /// Creates a source from its fields.
    pub const fn estimated(
        name: &'static str,
        class: Class,
        degrees_of_freedom: f64,
        at: &'static str,
        reference: &'static str,
    ) -> Self {
        Self {
            name: Text::Constant(name),
            class,
            degrees_of_freedom,
            at: Text::Constant(at),
            reference: Text::Constant(reference),
        }
    }
}

/// Returns the index of the source of whose error source k is a part, given the class of each
/// source and whether it belongs to a calibration: the first part of the same ball or disc, or of
/// the calibration; all other sources are whole. Balls have their other parts in the order of the
/// first ones.
pub fn whole(k: usize, class: impl Fn(usize) -> Class, is_calibration: impl Fn(usize) -> bool) -> usize {
    let part = |i: usize| match class(i).distribution() {
        Some(Distribution::Ball { part, parts }) => Some((part, parts)),
        _ => None,
    };
    let first = if is_calibration(k) {
        (0..k).find(|i| is_calibration(*i))
    } else if part(k).is_some_and(|(part, _)| part > 0) {
        let is_last = |i: &usize| part(*i).is_some_and(|(part, parts)| part > 0 && part + 1 == parts);
        let is_first = |i: &usize| part(*i).is_some_and(|(part, _)| part == 0);
        (0..k).filter(is_first).nth((0..k).filter(is_last).count())
    } else {
        None
    };
    first.unwrap_or(k)
}

/// Generalized error that a source causes. The effects of one random source share one magnitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effect {
    /// Index of the source.
    pub source: usize,
    /// Index of the frame, 0 for `F_1`.
    pub frame: usize,
    /// Component among the frame's six errors.
    pub component: Component,
}

impl Effect {
    /// Creates an effect from its fields.
    pub const fn new(source: usize, frame: usize, component: Component) -> Self {
        Self { source, frame, component }
    }
}

/// Description of a manipulator.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Name of the module and file.
    pub name: Text,
    /// Title for display.
    pub title: Text,
    /// Unit of every length.
    pub length: LengthUnit,
    /// Meaning of rows 4–6 of the Jacobians.
    pub orientation: Orientation,
    /// Frames `F_1 … F_n`.
    pub frames: List<Frame>,
    /// Joint variables `q`, in the order of the frames that declare them.
    pub variables: List<Variable>,
    /// Limits of sums of joint variables.
    pub sum_limits: List<SumLimit>,
    /// Structural parameters `s`.
    pub parameters: List<Parameter>,
    /// Inputs `u`.
    pub inputs: List<Input>,
    /// Enabled error sources.
    pub sources: List<Source>,
    /// Effects of the sources, source by source.
    pub effects: List<Effect>,
    /// Number of solutions that inverse kinematics in closed form has at most; 0 if there is none.
    pub solutions: usize,
}

impl Description {
    /// Returns `true` if the frames are a chain from the base to the tool, without branches.
    pub fn is_chain(&self) -> bool {
        self.frames.iter().all(|frame| frame.branch.is_none())
    }

    /// Returns `true` if loops determine passive variables.
    pub fn has_loops(&self) -> bool {
        self.passive().next().is_some()
    }

    /// Iterates over the passive variables, which loops determine.
    pub fn passive(&self) -> impl Iterator<Item = &Variable> {
        self.frames.iter().filter_map(|frame| frame.branch.as_ref()?.passive.as_ref())
    }

    /// Returns the index of the source of whose error source k is a part: usually its own.
    pub fn whole(&self, k: usize) -> usize {
        whole(k, |i| self.sources[i].class, |i| self.sources[i].is_calibration())
    }

    /// Returns the index of the frame that a frame hangs on; `None` for `F_0`.
    pub fn parent(&self, frame: usize) -> Option<usize> {
        match &self.frames[frame].branch {
            Some(branch) => branch.parent,
            None => frame.checked_sub(1),
        }
    }

    /// Returns the index of the frame that carries the tool; `None` without frames.
    pub fn tool_frame(&self) -> Option<usize> {
        let carries = |frame: &Frame| frame.branch.as_ref().is_some_and(|branch| branch.carries_tool);
        self.frames.iter().position(carries).or(self.frames.len().checked_sub(1))
    }

    /// Returns the pose of a frame in `F_0` from `A_1 … A_n`; `None` is `F_0` itself.
    pub fn frame_pose(&self, transforms: &[Pose], frame: Option<usize>) -> Pose {
        let mut pose = Pose::IDENTITY;
        let mut frame = frame;
        while let Some(at) = frame {
            pose = transforms[at].then(&pose);
            frame = self.parent(at);
        }
        pose
    }

    /// Returns `true` if the tool hangs on a frame, or is on it.
    pub fn carries_tool(&self, frame: usize) -> bool {
        let mut at = self.tool_frame();
        while at.is_some_and(|at| at > frame) {
            at = at.and_then(|at| self.parent(at));
        }
        at == Some(frame)
    }

    /// Computes ε, six errors per frame, from the values of the effects of the repeatable sources.
    ///
    /// Ignores effects without a value, and frames beyond the end of `errors`.
    pub fn generalized_errors(&self, effects: &[f64], errors: &mut [[f64; 6]]) {
        errors.fill([0.0; 6]);
        for (effect, value) in self.effects.iter().zip(effects) {
            let repeatable = self.sources[effect.source].class == Class::Repeatable;
            if let Some(error) = errors.get_mut(effect.frame).filter(|_| repeatable) {
                error[effect.component.index()] += value;
            }
        }
    }
}
