//! Numbers of the nominal chain: joint variables, structural parameters and Denavit-Hartenberg
//! numbers.

use crate::expr::Motion;

/// A number of the nominal chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChainNumber {
    /// A joint variable, in every transform that depends on it.
    Joint(usize),
    /// A structural parameter, in every transform that depends on it.
    Parameter(usize),
    /// One of the four Denavit-Hartenberg numbers of a frame.
    DenavitHartenberg {
        /// Index of the frame, from 0.
        frame: usize,
        /// The number.
        number: DhNumber,
    },
}

/// One of the four Denavit-Hartenberg numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DhNumber {
    /// Rotation about z.
    Theta,
    /// Translation along z.
    D,
    /// Translation along x.
    A,
    /// Rotation about x.
    Alpha,
}

impl DhNumber {
    /// The four numbers.
    pub const ALL: [Self; 4] = [Self::Theta, Self::D, Self::A, Self::Alpha];

    /// Returns its key in a spec.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theta => "theta",
            Self::D => "d",
            Self::A => "a",
            Self::Alpha => "alpha",
        }
    }

    /// Returns its motion and axis: 0 = x, 1 = y, 2 = z.
    pub const fn motion(self) -> (Motion, usize) {
        match self {
            Self::Theta => (Motion::Rotation, 2),
            Self::D => (Motion::Translation, 2),
            Self::A => (Motion::Translation, 0),
            Self::Alpha => (Motion::Rotation, 0),
        }
    }
}

/// Convention of a Denavit-Hartenberg frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
    Standard,
    /// Craig's: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
    Modified,
}

impl DhConvention {
    /// Returns its name in options and tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Modified => "modified",
        }
    }

    /// Returns the numbers in the order of the frame's factors.
    pub const fn order(self) -> [DhNumber; 4] {
        match self {
            Self::Standard => [DhNumber::Theta, DhNumber::D, DhNumber::A, DhNumber::Alpha],
            Self::Modified => [DhNumber::Alpha, DhNumber::A, DhNumber::Theta, DhNumber::D],
        }
    }
}
