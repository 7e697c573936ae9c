//! Description of a manipulator: names, units, limits and error sources.

use crate::{Class, Effect, List, Pose, Source, Text, whole};

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

impl VariableKind {
    /// Returns the first value for a revolute joint, the second for a prismatic one.
    ///
    /// ```
    /// use abbe::VariableKind;
    /// assert_eq!(VariableKind::Revolute.either("rad", "mm"), "rad");
    /// ```
    pub fn either<T>(self, revolute: T, prismatic: T) -> T {
        match self {
            Self::Revolute => revolute,
            Self::Prismatic => prismatic,
        }
    }
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
        self.frames[frame].branch.as_ref().map_or(frame.checked_sub(1), |branch| branch.parent)
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
