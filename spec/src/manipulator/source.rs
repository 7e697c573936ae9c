//! Sources: physical errors and their effects on the chain.
//!
//! Covariance of the errors of an identified machine.
//!
//! Loads on beams and compliances.

use abbe_core::{Class, Component, Distribution};

use super::{ChainNumber, Factor};
use crate::{diagnostic::Span, expr::Expression};

/// A physical error.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name of the source.
    pub name: String,
    /// Repeatable, a tolerance, or random.
    pub class: Class,
    /// Degrees of freedom of the standard deviation of a normal error; infinite if it is known
    /// exactly.
    pub degrees_of_freedom: f64,
    /// `false` for a named alternative that is not used.
    pub enabled: bool,
    /// Description.
    pub description: String,
    /// Reference for its numbers.
    pub reference: String,
    /// Factor of its errors, if that can be identified.
    pub magnitude: Option<Magnitude>,
    /// Factor of all its errors in addition to its magnitude.
    pub scale: f64,
    /// Input that multiplies its errors instead of both, if the factor is given at run time.
    pub tuned_by: Option<usize>,
    /// Effects on frames, in the order of the file.
    pub effects: Vec<Effect>,
    /// Deviations of numbers of the chain, in the order of the file; not empty if there are no
    /// effects.
    pub deviations: Vec<Deviation>,
    /// Uncertain quantities with their factors. The source adds the derivatives of the repeatable
    /// errors by each, times its factor, to its other effects. Empty for a source of a file.
    pub propagated: Vec<(Uncertain, f64)>,
}

/// Uncertain quantity on which the repeatable errors depend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uncertain {
    /// An input, by index. The factor is in its unit.
    Input(usize),
    /// An identified error, in the length unit or rad; or the magnitude of a source, relative to
    /// its value.
    Identified(Identified),
}

impl Source {
    /// Returns the factor of its errors: its magnitude, or 1, times its scale.
    pub fn factor(&self) -> f64 {
        self.scale * self.magnitude.map_or(1.0, |magnitude| magnitude.value)
    }

    /// Returns `true` if the loads cause any of its errors.
    pub fn is_elastic(&self) -> bool {
        self.effects.iter().any(|effect| effect.cause.is_elastic())
            || self.deviations.iter().any(Deviation::is_elastic)
    }

    /// Returns `true` if it has a beam whose weight loads the structure.
    pub fn has_weight(&self) -> bool {
        self.effects
            .iter()
            .any(|effect| matches!(&effect.cause, Cause::Beam(beam) if beam.mass_per_length.is_some()))
    }

    /// Removes the weights of its beams.
    pub fn remove_weight(&mut self) {
        for effect in &mut self.effects {
            if let Cause::Beam(beam) = &mut effect.cause {
                beam.mass_per_length = None;
            }
        }
    }

    /// Returns an enabled repeatable source without errors.
    pub fn repeatable(name: String) -> Self {
        Self {
            name,
            class: Class::Repeatable,
            degrees_of_freedom: f64::INFINITY,
            enabled: true,
            description: String::new(),
            reference: String::new(),
            magnitude: None,
            scale: 1.0,
            tuned_by: None,
            effects: Vec::new(),
            deviations: Vec::new(),
            propagated: Vec::new(),
        }
    }

    /// Returns whether the source is a part of the uncertainty of identified errors. No source of a
    /// file is one.
    pub fn is_calibration_error(&self) -> bool {
        self.propagated.iter().any(|(uncertain, _)| matches!(uncertain, Uncertain::Identified(_)))
    }

    /// Returns the normal random source that adds the effects of uncertain quantities, each times
    /// its factor, to no others.
    pub fn propagating(name: String, description: String, propagated: Vec<(Uncertain, f64)>) -> Self {
        let class = Class::Random(Distribution::Normal);
        Self { class, description, propagated, ..Self::repeatable(name) }
    }
}

/// Effect of a source on a frame, or on a place on its link.
#[derive(Clone, Debug)]
pub struct Effect {
    /// Index of the frame, from 0: the first one for an error of `F_0`.
    pub frame: usize,
    /// Indicates an error of `F_0`, `E_0 A_1 = A_1 (A_1⁻¹ E_0 A_1)`.
    pub is_of_base: bool,
    /// Pose `L` of the place relative to the frame; empty for the frame itself.
    pub at: Vec<Factor>,
    /// Cause of the error there.
    pub cause: Cause,
    /// Location in the file.
    pub span: Span,
}

/// Cause of the displacement of a place on a link.
#[derive(Clone, Debug)]
pub enum Cause {
    /// Given errors: some of the six, lengths or rad.
    Errors(Vec<(Component, Expression)>),
    /// Deflection of the tip of a beam under the loads beyond it.
    Beam(Beam),
    /// A compliance times the wrench of the loads beyond it.
    Compliance(Box<Compliance>),
}

impl Cause {
    /// Returns `true` if the displacement is caused by loads.
    pub fn is_elastic(&self) -> bool {
        !matches!(self, Self::Errors(_))
    }
}

/// A straight beam whose tip is at the place of its effect; the other end is clamped.
#[derive(Clone, Debug)]
pub struct Beam {
    /// Axis of the beam: 0 = x, 1 = y, 2 = z.
    pub axis: usize,
    /// Length of the beam.
    pub length: Expression,
    /// Bending stiffnesses about the two axes that follow its own in cyclic order.
    pub bending: [Expression; 2],
    /// Torsional stiffness; rigid if `None`.
    pub torsion: Option<Expression>,
    /// Axial stiffness; rigid if `None`.
    pub extension: Option<Expression>,
    /// Mass per length; weightless if `None`.
    pub mass_per_length: Option<Expression>,
}

impl Beam {
    /// Keys of the bending stiffnesses of a beam along `axis`, in the order of
    /// [`bending`](Self::bending): each is named by the axis about which it resists bending.
    pub const fn bending_keys(axis: usize) -> [&'static str; 2] {
        const KEYS: [&str; 3] = ["EI_x", "EI_y", "EI_z"];
        [KEYS[(axis + 1) % 3], KEYS[(axis + 2) % 3]]
    }
}

/// Six errors per unit of six forces and moments, both in the order of ε; `None` for 0.
pub type Compliance = [[Option<Expression>; 6]; 6];

/// Deviation of a number of the nominal chain: `A_i(q + δq)` instead of `A_i(q)`.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// The number.
    pub number: ChainNumber,
    /// Cause of the deviation.
    pub cause: DeviationCause,
    /// Location in the file.
    pub span: Span,
}

impl Deviation {
    /// Returns the given error; `None` for an elastic joint.
    pub fn error(&self) -> Option<&Expression> {
        match &self.cause {
            DeviationCause::Error(error) => Some(error),
            DeviationCause::Stiffness(_) => None,
        }
    }

    /// Returns `true` if the deviation is caused by loads.
    pub fn is_elastic(&self) -> bool {
        matches!(self.cause, DeviationCause::Stiffness(_))
    }
}

/// Cause of the deviation of a number of the chain.
#[derive(Clone, Debug)]
pub enum DeviationCause {
    /// Actual minus nominal value, in the number's own dimension.
    Error(Expression),
    /// Stiffness of a joint: it deviates by the moment, or force, of the loads along its motion,
    /// divided by the stiffness.
    Stiffness(Expression),
}

/// Factor of a source's errors, which measurements may determine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnitude {
    /// Best known value.
    pub value: f64,
    /// Standard deviation of the value; `None` if unknown.
    pub standard_deviation: Option<f64>,
    /// Degrees of freedom of the standard deviation; infinite if it is known exactly.
    pub degrees_of_freedom: f64,
}

/// Covariance of identified quantities.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Covariance {
    /// Identified quantities, in the order of the rows.
    pub of: Vec<Identified>,
    /// Symmetric matrix by rows, in the units of the quantities: the length unit, rad, or 1.
    pub rows: Vec<Vec<f64>>,
}

/// An identified quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Identified {
    /// Magnitude of a source, 1 = as in the spec; by index among all sources.
    Magnitude(usize),
    /// One of the six errors of a frame (from 0), in the length unit or rad.
    Error(usize, Component),
    /// One of the six errors of `F_0`, the placement of the machine, in the length unit or rad.
    Base(Component),
    /// Error of a joint, by its index among the variables, in rad or the length unit.
    Joint(usize),
}

/// A load on the structure: the weight of a mass, a force, a moment.
#[derive(Clone, Debug)]
pub struct Load {
    /// Mass, whose weight acts under gravity.
    pub mass: Option<Expression>,
    /// Force along x, y and z.
    pub force: Option<[Expression; 3]>,
    /// Moment about x, y and z.
    pub moment: Option<[Expression; 3]>,
    /// Axes in which force and moment are given.
    pub axes: Axes,
    /// Index of the frame that the load is fixed to, from 0.
    pub frame: usize,
    /// Point of application.
    pub point: Point,
}

/// The axes of a force or moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Axes of the load's frame: the force rotates with it.
    Frame,
    /// Axes of `F_0`.
    Base,
}

/// Point of application of a load.
#[derive(Clone, Debug)]
pub enum Point {
    /// Position relative to the frame.
    Here([Expression; 3]),
    /// The tool point; the frame is the one that carries the tool.
    Tool,
}
