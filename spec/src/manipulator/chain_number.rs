//! The numbers of the nominal chain: joints, structural parameters, and those of Denavit and Hartenberg.

use crate::expr::Motion;

/// A number of the nominal chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChainNumber {
    /// A joint variable, wherever a transform depends on it.
    Joint(usize),
    /// A structural parameter, wherever a transform depends on it.
    Parameter(usize),
    /// One of the four numbers of a frame that is given by them.
    DenavitHartenberg {
        /// The frame, from 0.
        frame: usize,
        /// Which of the four.
        number: DhNumber,
    },
}

/// One of the four Denavit-Hartenberg numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DhNumber {
    /// The turn about z.
    Theta,
    /// The shift along z.
    D,
    /// The shift along x.
    A,
    /// The turn about x.
    Alpha,
}

impl DhNumber {
    /// All four.
    pub const ALL: [Self; 4] = [Self::Theta, Self::D, Self::A, Self::Alpha];

    /// Its key in a spec.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Theta => "theta",
            Self::D => "d",
            Self::A => "a",
            Self::Alpha => "alpha",
        }
    }

    /// What it does, and along or about which axis: 0 = x, 1 = y, 2 = z.
    pub const fn motion(self) -> (Motion, usize) {
        match self {
            Self::Theta => (Motion::Rotation, 2),
            Self::D => (Motion::Translation, 2),
            Self::A => (Motion::Translation, 0),
            Self::Alpha => (Motion::Rotation, 0),
        }
    }
}

/// Which product of its four numbers a Denavit-Hartenberg frame is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// `Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
    Standard,
    /// Craig's: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`.
    Modified,
}

impl DhConvention {
    /// Returns its name, as options and tables have it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Modified => "modified",
        }
    }

    /// The numbers in the order of the frame's factors, one factor each.
    pub const fn order(self) -> [DhNumber; 4] {
        match self {
            Self::Standard => [DhNumber::Theta, DhNumber::D, DhNumber::A, DhNumber::Alpha],
            Self::Modified => [DhNumber::Alpha, DhNumber::A, DhNumber::Theta, DhNumber::D],
        }
    }
}
