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
}

impl Kind {
    pub const ALL: [Self; 3] = [Self::Dense, Self::Distinct, Self::Displacement];

    /// The end of the names of generated functions.
    pub fn name(self) -> &'static str {
        ["dense", "distinct", "displacement"][self as usize]
    }
}

/// For whom it runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Ours,
    Peer,
    /// What one would write by hand; in no ratio.
    Baseline,
}

/// Configurations, one after the other, and an ε for each.
pub struct Inputs {
    pub variables: usize,
    pub frames: usize,
    pub q: Vec<f64>,
    pub errors: Vec<f64>,
}

impl Inputs {
    pub fn q(&self, index: usize) -> &[f64] {
        &self.q[index * self.variables..(index + 1) * self.variables]
    }

    pub fn errors(&self, index: usize) -> &[f64] {
        &self.errors[index * 6 * self.frames..(index + 1) * 6 * self.frames]
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

/// Computes the configurations of a range; the last one's results are left in the output.
pub type Run = Box<dyn FnMut(&Inputs, Range<usize>, &mut Output)>;

/// A competitor.
pub struct Row {
    pub name: &'static str,
    pub side: Side,
    pub kind: Kind,
    pub run: Run,
}

impl Row {
    /// One that takes the configurations one by one: `(q, pose, result)`.
    pub fn jacobian(
        name: &'static str,
        side: Side,
        kind: Kind,
        mut function: impl FnMut(&[f64], &mut [f64], &mut [f64]) + 'static,
    ) -> Self {
        let run: Run = Box::new(move |inputs, range, output| {
            for index in range {
                function(black_box(inputs.q(index)), &mut output.pose, &mut output.result);
                black_box(&mut *output);
            }
        });
        Self { name, side, kind, run }
    }

    /// One that takes them one by one: `(q, ε, ΔX)`.
    pub fn displacement(
        name: &'static str,
        side: Side,
        mut function: impl FnMut(&[f64], &[f64], &mut [f64]) + 'static,
    ) -> Self {
        let run: Run = Box::new(move |inputs, range, output| {
            for index in range {
                function(black_box(inputs.q(index)), inputs.errors(index), &mut output.result);
                black_box(&mut *output);
            }
        });
        Self { name, side, kind: Kind::Displacement, run }
    }

    /// One that takes many configurations at once; `run` as for [`Run`].
    #[allow(dead_code)]
    pub fn batch(name: &'static str, side: Side, kind: Kind, run: Run) -> Self {
        Self { name, side, kind, run }
    }
}
