//! One competitor and how it is run.

use std::hint::black_box;
use std::ops::Range;

/// What is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Pose and `J_e`: 12 and 36 n doubles, column-major.
    Dense,
    /// Pose and the 18 n numbers that are not zero or repeated: of every frame the axes x, y, z and the moments about y, z, x.
    Distinct,
    /// ΔX = `J_e` ε for any ε: 6 doubles.
    Displacement,
    /// `J_e` diag(σ²) `J_e`ᵀ for any σ²: 36 doubles.
    Covariance,
}

impl Kind {
    pub const ALL: [Self; 4] = [Self::Dense, Self::Distinct, Self::Displacement, Self::Covariance];

    /// The end of the names of generated functions.
    pub fn name(self) -> &'static str {
        ["dense", "distinct", "displacement", "covariance"][self as usize]
    }

    /// As the tables have it.
    pub fn title(self) -> &'static str {
        ["J_e dense", "J_e distinct", "ΔX = J_e ε", "covariance"][self as usize]
    }

    /// Whether the pose is a result too.
    pub fn has_pose(self) -> bool {
        matches!(self, Self::Dense | Self::Distinct)
    }
}

/// For whom it runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Our generated code.
    Ours,
    /// The same in C.
    OurC,
    /// The same programs without a compiler.
    Interpreter,
    /// Code that a peer generated.
    Generator,
    /// A peer's own code.
    Library,
    /// What one would write by hand; in no ratio.
    Baseline,
}

impl Side {
    pub fn is_peer(self) -> bool {
        matches!(self, Self::Generator | Self::Library)
    }
}

/// Configurations, one after the other, an ε for each and a σ².
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

    /// What is given besides q.
    pub fn given(&self, kind: Kind, index: usize) -> &[f64] {
        match kind {
            Kind::Dense | Kind::Distinct => &[],
            Kind::Displacement => self.errors(index),
            Kind::Covariance => self.variances(index),
        }
    }
}

/// How many frames a robot may have.
pub const MOST: usize = 8;

/// Where results go: the same memory for everyone, aligned as Eigen likes it.
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

/// How a competitor is run.
pub trait Run {
    /// Computes the configurations of a range. Who takes them one by one leaves the last one's results in the output.
    fn run(&mut self, inputs: &Inputs, range: Range<usize>, output: &mut Output);

    /// Writes the results of a configuration of the last block to the output, unless they are there.
    fn show(&self, _index: usize, _output: &mut Output) {}
}

impl<F: FnMut(&Inputs, Range<usize>, &mut Output)> Run for F {
    fn run(&mut self, inputs: &Inputs, range: Range<usize>, output: &mut Output) {
        self(inputs, range, output);
    }
}

/// A competitor.
pub struct Row {
    pub name: String,
    pub side: Side,
    pub kind: Kind,
    /// How many configurations it takes at once.
    pub block: usize,
    pub run: Box<dyn Run>,
}

impl Row {
    /// One that takes the configurations one by one: `(q, pose, result)`.
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

    /// One that takes them one by one, and ε or σ² with them: `(q, ε, ΔX)`, `(q, σ², covariance)`.
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
