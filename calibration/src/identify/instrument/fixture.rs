//! Fixtures: points and directions that stand still in `F_0`.

use abbe_analysis::sampling::vectors::{tangents, unit};

/// An object that stands still in `F_0`, at an approximately known position or direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Fixture {
    /// Prefix of the names of its unknowns: `bar_x`.
    pub name: String,
    /// Nominal position or direction.
    pub geometry: FixtureGeometry,
}

/// Known distance of two fixtures that are points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownDistance {
    /// Indices of the fixtures.
    pub fixtures: [usize; 2],
    /// The distance; the length unit.
    pub length: f64,
    /// Its standard deviation; the length unit.
    pub uncertainty: f64,
}

/// Position or direction of a fixture, in the axes of `F_0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FixtureGeometry {
    /// A point `c`, in the length unit. Its unknowns are translations along x, y and z.
    Point([f64; 3]),
    /// A direction `n`, not zero. Its unknowns are tilts towards [`tangents`], in rad.
    Direction([f64; 3]),
}

impl FixtureGeometry {
    /// Returns the number of unknowns: 3 for a point, 2 for a direction.
    pub fn unknowns(&self) -> usize {
        match self {
            Self::Point(_) => 3,
            Self::Direction(_) => 2,
        }
    }

    /// Returns the geometry displaced by the values of its unknowns.
    pub fn displaced(&self, by: &[f64; 3]) -> Self {
        match self {
            Self::Point(c) => Self::Point(core::array::from_fn(|i| c[i] + by[i])),
            Self::Direction(n) => {
                let ([a, b], n) = (tangents(*n), unit(*n));
                Self::Direction(core::array::from_fn(|i| n[i] + by[0] * a[i] + by[1] * b[i]))
            }
        }
    }

    /// Returns the point, or the unit direction.
    pub(in super::super) fn vector(&self) -> [f64; 3] {
        match self {
            Self::Point(c) => *c,
            Self::Direction(n) => unit(*n),
        }
    }
}
