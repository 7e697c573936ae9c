//! Unit names and their conversion into the coherent system of a spec.

use abbe::LengthUnit;

use super::Dimension;

/// A product of unit names: all are powers of ten of SI units, but for the degree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// What it measures.
    pub dimension: Dimension,
    /// Powers of ten against SI.
    decades: i32,
    /// Powers of π/180.
    degrees: i32,
}

/// Every unit name, which no other name may be.
pub const UNIT_NAMES: [&str; 15] =
    ["m", "mm", "um", "rad", "mrad", "deg", "kg", "g", "N", "kN", "Pa", "MPa", "GPa", "K", "s"];

impl Unit {
    /// No unit.
    pub const NONE: Self = Self { dimension: Dimension::NONE, decades: 0, degrees: 0 };

    /// The unit of that name.
    pub fn named(name: &str) -> Option<Self> {
        let (dimension, decades) = match name {
            "m" => (Dimension::LENGTH, 0),
            "mm" => (Dimension::LENGTH, -3),
            "um" => (Dimension::LENGTH, -6),
            "kg" => (Dimension::MASS, 0),
            "g" => (Dimension::MASS, -3),
            "s" => (Dimension::TIME, 0),
            "K" => (Dimension::TEMPERATURE, 0),
            "N" => (Dimension::FORCE, 0),
            "kN" => (Dimension::FORCE, 3),
            "Pa" => (Dimension::PRESSURE, 0),
            "MPa" => (Dimension::PRESSURE, 6),
            "GPa" => (Dimension::PRESSURE, 9),
            "rad" => (Dimension::NONE, 0),
            "mrad" => (Dimension::NONE, -3),
            "deg" => return Some(Self { degrees: 1, ..Self::NONE }),
            _ => return None,
        };
        Some(Self { dimension, decades, degrees: 0 })
    }

    /// The product of this unit and a power of another; none if an exponent is absurd.
    pub fn times(self, other: Self, power: i32) -> Option<Self> {
        Some(Self {
            dimension: self.dimension.times(other.dimension.power(f64::from(power))?)?,
            decades: self.decades.checked_add(other.decades.checked_mul(power)?)?,
            degrees: self.degrees.checked_add(other.degrees.checked_mul(power)?)?,
        })
    }

    /// A number in this unit, in the coherent system of a spec: rounded once, and exact where nothing changes.
    pub fn convert(self, number: f64, length: LengthUnit) -> f64 {
        let decades = self.decades + decades_per_metre(length) * self.dimension.length_exponent();
        // Dividing first keeps 90 deg exactly π/2.
        let mut number = number;
        for _ in 0..self.degrees.abs() {
            number = if self.degrees > 0 {
                number / 180.0 * std::f64::consts::PI
            } else {
                number / std::f64::consts::PI * 180.0
            };
        }
        if decades >= 0 { number * 10_f64.powi(decades) } else { number / 10_f64.powi(-decades) }
    }
}

/// How many powers of ten a number grows by when a metre is written in this unit.
fn decades_per_metre(length: LengthUnit) -> i32 {
    match length {
        LengthUnit::Metre => 0,
        LengthUnit::Millimetre => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conversions_are_exact_where_they_can_be() {
        let convert = |number, name, length| Unit::named(name).unwrap().convert(number, length);
        assert_eq!(convert(718.0, "mm", LengthUnit::Millimetre), 718.0);
        assert_eq!(convert(718.0, "mm", LengthUnit::Metre), 0.718);
        assert_eq!(convert(90.0, "deg", LengthUnit::Metre), std::f64::consts::FRAC_PI_2);
        assert_eq!(convert(1.0, "N", LengthUnit::Millimetre), 1000.0);
        assert_eq!(convert(210.0, "GPa", LengthUnit::Millimetre), 210e6);
    }

    #[test]
    fn every_name_has_a_unit() {
        for name in UNIT_NAMES {
            assert!(Unit::named(name).is_some(), "{name}");
        }
    }
}
