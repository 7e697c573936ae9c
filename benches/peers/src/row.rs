//! A competitor and its interface.

use std::hint::black_box;
use std::ops::Range;

/// Quantity that is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Pose and `J_e`: 12 and 36 n doubles, column-major.
    Dense,
    /// Pose and the 18 distinct numbers of each frame: its axes x, y, z and their moments, in the
    /// order y, z, x.
    Distinct,
    /// ΔX = `J_e` ε for any ε: 6 doubles.
    Displacement,
    /// `J_e` diag(σ²) `J_e`ᵀ for any σ²: 36 doubles.
    Covariance,
}

impl Kind {
    pub const ALL: [Self; 4] = [Self::Dense, Self::Distinct, Self::Displacement, Self::Covariance];

    /// Returns the suffix of the names of generated functions.
    pub fn name(self) -> &'static str {
        ["dense", "distinct", "displacement", "covariance"][self as usize]
    }

    /// Returns the title in the tables.
    pub fn title(self) -> &'static str {
        ["J_e dense", "J_e distinct", "ΔX = J_e ε", "covariance"][self as usize]
    }

    /// Returns whether the pose is also a result.
    pub fn has_pose(self) -> bool {
        matches!(self, Self::Dense | Self::Distinct)
    }
}

/// Origin of the code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Our generated code.
    Ours,
    /// Our generated code in C.
    OurC,
    /// Our programs, interpreted.
    Interpreter,
    /// Code that a peer generated.
    Generator,
    /// A peer's own code.
    Library,
    /// Handwritten code; in no ratio.
    Baseline,
}

impl Side {
    pub fn is_peer(self) -> bool {
        matches!(self, Self::Generator | Self::Library)
    }
}

/// Configurations, with an ε and a σ² for each.
pub struct Inputs {
    pub variables: usize,
    pub frames: usize,
    pub q: Vec<f64>,
    pub errors: Vec<f64>,
    pub variances: Vec<f64>,
}

impl Inputs {
    pub fn q(&self, index: usize) -> &[f64] {
        &self.q[index * self.variables..(index + 1) * self.variables]
    }

    pub fn errors(&self, index: usize) -> &[f64] {
        &self.errors[index * 6 * self.frames..(index + 1) * 6 * self.frames]
    }

    pub fn variances(&self, index: usize) -> &[f64] {
        &self.variances[index * 6 * self.frames..(index + 1) * 6 * self.frames]
    }

    /// Returns the argument besides q.
    pub fn given(&self, kind: Kind, index: usize) -> &[f64] {
        match kind {
            Kind::Dense | Kind::Distinct => &[],
            Kind::Displacement => self.errors(index),
            Kind::Covariance => self.variances(index),
        }
    }
}

/// Largest number of frames of a robot.
pub const MOST: usize = 8;

/// Memory of the results, the same for all competitors, aligned for Eigen.
#[repr(C, align(64))]
pub struct Output {
    pub pose: [f64; 16],
    pub result: [f64; 36 * MOST],
}

impl Output {
    pub fn new() -> Self {
        Self { pose: [f64::NAN; 16], result: [f64::NAN; 36 * MOST] }
    }
}

/// Interface of a competitor.
pub trait Run {
    /// Computes the configurations of a range. Competitors without batches leave the results of the
    /// last configuration in the output.
    fn run(&mut self, inputs: &Inputs, range: Range<usize>, output: &mut Output);

    /// Writes the results of a configuration of the last block to the output, unless they are
    /// there.
    fn show(&self, _index: usize, _output: &mut Output) {}
}

impl<F: FnMut(&Inputs, Range<usize>, &mut Output)> Run for F {
    fn run(&mut self, inputs: &Inputs, range: Range<usize>, output: &mut Output) {
        self(inputs, range, output);
    }
}

/// Competitor.
pub struct Row {
    pub name: String,
    pub side: Side,
    pub kind: Kind,
    /// Number of configurations per call.
    pub block: usize,
    pub run: Box<dyn Run>,
}

impl Row {
    /// Creates a competitor without batches: `(q, pose, result)`.
    pub fn jacobian(
        name: &str,
        side: Side,
        kind: Kind,
        mut function: impl FnMut(&[f64], &mut [f64], &mut [f64]) + 'static,
    ) -> Self {
        let run = move |inputs: &Inputs, range: Range<usize>, output: &mut Output| {
            for index in range {
                function(black_box(inputs.q(index)), &mut output.pose, &mut output.result);
                black_box(&mut *output);
            }
        };
        Self { name: name.to_owned(), side, kind, block: 1, run: Box::new(run) }
    }

    /// Creates a competitor without batches that takes ε or σ²: `(q, ε, ΔX)`,
    /// `(q, σ², covariance)`.
    pub fn given(
        name: &str,
        side: Side,
        kind: Kind,
        mut function: impl FnMut(&[f64], &[f64], &mut [f64]) + 'static,
    ) -> Self {
        let run = move |inputs: &Inputs, range: Range<usize>, output: &mut Output| {
            for index in range {
                function(black_box(inputs.q(index)), inputs.given(kind, index), &mut output.result);
                black_box(&mut *output);
            }
        };
        Self { name: name.to_owned(), side, kind, block: 1, run: Box::new(run) }
    }
}
