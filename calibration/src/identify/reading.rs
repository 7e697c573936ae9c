//! Instruments that tell one number at a time: ballbars, wires, indicators, contacts, autocollimators.
//!
//! A fixture stands still in `F_0`. Where it stands is unknown, so that nothing of the base can be told from it: shifts and
//! turns of `F_0` act as those of the fixture. `p` is a target, seen in `F_0`.

/// Something that stands still in `F_0`, and about where.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// What its unknowns are called by: `bar_x`.
    pub name: String,
    /// What it is, and about where.
    pub place: Place,
}

/// Where a fixture is, in the axes of `F_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A point `c`, in the length unit; its unknowns are shifts along x, y, z.
    Point([f64; 3]),
    /// A direction `n`, not zero; its unknowns are tilts towards [`tangents`], rad.
    Direction([f64; 3]),
}

/// What a number of an instrument is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gauge {
    /// A coordinate of a target in the frame of the instrument; axis 0, 1, 2.
    Coordinate {
        /// The target, by index.
        target: usize,
        /// Which coordinate.
        axis: usize,
    },
    /// `|p − c|`: a ballbar, a wire; a sphere that is touched.
    Distance {
        /// The target, by index.
        target: usize,
        /// The fixture, a point.
        from: usize,
    },
    /// `p − c` along an axis of `F_0`: all three are zero where a target is held at a point.
    Apart {
        /// The target, by index.
        target: usize,
        /// The fixture, a point.
        from: usize,
        /// Which coordinate.
        axis: usize,
    },
    /// `n · (p − a)`: an indicator with a flat tip; a plane that is touched.
    Along {
        /// The target, by index.
        target: usize,
        /// A place `a` near which it is read, so that a tilt of `n` is not confused with the zero; the length unit.
        about: [f64; 3],
        /// The fixture, a direction.
        direction: usize,
    },
    /// `|p_1 − p_2|`: from one target to another.
    Between {
        /// The targets, by index.
        targets: [usize; 2],
    },
    /// `|p − p_0|`: from where a target was in the row before, a laser's or a scale's displacement.
    Moved {
        /// The target, by index.
        target: usize,
    },
    /// `asin(n · R m)`: by how much the normal of a mirror on the tool leans towards a direction; rad.
    Lean {
        /// The normal `m` in the frame of the tool, of length 1.
        mirror: [f64; 3],
        /// The fixture, a direction.
        direction: usize,
    },
}

/// One number of an instrument: its gauge and a zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// What its zero is called by: `bar_zero`.
    pub name: String,
    /// What it is.
    pub gauge: Gauge,
    /// What the instrument adds to that; of a sphere that is touched, minus its radius.
    pub zero: f64,
    /// Whether that is known.
    pub zero_known: bool,
    /// One standard deviation: the length unit, or rad of an angle.
    pub uncertainty: f64,
    /// Whether the machine is moved until it is zero: nothing is read then but the joints.
    pub touched: bool,
    /// Which instrument it belongs to: all of those share what their uncertainty must be multiplied with.
    pub instrument: usize,
}

impl Gauge {
    /// Whether the number is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Lean { .. })
    }

    /// The fixture that it looks at, by index.
    pub fn fixture(&self) -> Option<usize> {
        match self {
            Self::Coordinate { .. } | Self::Between { .. } | Self::Moved { .. } => None,
            Self::Distance { from, .. } | Self::Apart { from, .. } => Some(*from),
            Self::Along { direction, .. } | Self::Lean { direction, .. } => Some(*direction),
        }
    }
}

impl Place {
    /// How many numbers of it are unknown.
    pub fn unknowns(&self) -> usize {
        match self {
            Self::Point(_) => 3,
            Self::Direction(_) => 2,
        }
    }

    /// The same, moved by its unknowns.
    pub fn moved(&self, by: &[f64; 3]) -> Self {
        match self {
            Self::Point(c) => Self::Point(core::array::from_fn(|i| c[i] + by[i])),
            Self::Direction(n) => {
                let ([a, b], n) = (tangents(*n), unit(*n));
                Self::Direction(core::array::from_fn(|i| n[i] + by[0] * a[i] + by[1] * b[i]))
            }
        }
    }

    pub(super) fn vector(&self) -> [f64; 3] {
        match self {
            Self::Point(c) => *c,
            Self::Direction(n) => unit(*n),
        }
    }
}

/// Two directions at right angles to `n` and to each other; the first leans towards the axis that `n` is furthest from.
pub fn tangents(n: [f64; 3]) -> [[f64; 3]; 2] {
    let n = unit(n);
    let least = (0..3).min_by(|i, j| n[*i].abs().total_cmp(&n[*j].abs())).unwrap_or(0);
    let axis: [f64; 3] = core::array::from_fn(|i| f64::from(u8::from(i == least)));
    let first = unit(core::array::from_fn(|i| axis[i] - n[least] * n[i]));
    [first, super::columns::cross(n, first)]
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    // A target on the fixture itself is at no side of it.
    if length > 0.0 { v.map(|x| x / length) } else { [0.0; 3] }
}
