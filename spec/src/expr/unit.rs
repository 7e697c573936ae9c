//! Units and their conversion to the coherent units of a spec.

use abbe_core::LengthUnit;

use super::Dimension;
use crate::diagnostic::{meanings, nearest};

/// Largest magnitude that is accepted: its square is finite.
pub const LARGEST: f64 = 1e150;

/// A product of powers of units.
///
/// The factor to SI is a ratio of integers times powers of ten and of π/180, so that conversions
/// are exact where possible.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Dimension of the unit.
    pub dimension: Dimension,
    /// Integer numerator and denominator.
    ratio: [f64; 2],
    /// Exponent of ten.
    decades: i32,
    /// Exponent of π/180.
    degrees: i32,
}

/// Names of the units; no other name may be one of these.
pub const UNIT_NAMES: [&str; 29] = [
    "m", "cm", "mm", "um", "nm", "inch", "rad", "mrad", "urad", "deg", "arcmin", "arcsec", "%", "ppm", "kg",
    "g", "t", "lb", "N", "kN", "mN", "Pa", "kPa", "MPa", "GPa", "K", "s", "min", "h",
];

/// Spellings that are no units here, and what to write for them.
const SPELLINGS: &str = "Nm newtonmeter: N*m; Nmm: N*mm; kNm: kN*m; cms centimeter centimetre: cm; k kelvin Kelvin: K;
    micron microns micrometer micrometre: um; in inches: inch; mil mils thou: 0.001 inch;
    ft feet: 12 inch; millimeter millimeters millimetre mms MM: mm; meter meters metre metres: m; degree degrees: deg;
    radian radians: rad; arcminute arcminutes amin: arcmin; arcsecond arcseconds asec as: arcsec;
    gon grad: 0.9 deg; newton newtons: N; kgf kp: 9.80665 N; lbf: 4.4482216152605 N;
    bar: 100 kPa; sec second seconds: s; kilogram kilograms kilo kilos kgs Kg KG: kg";

/// Names of temperatures that are no differences.
const CELSIUS: [&str; 4] = ["degC", "C", "celsius", "Celsius"];

/// Returns what to write for a spelling that others use for a unit.
pub(crate) fn unit_spelling(word: &str) -> Option<String> {
    if CELSIUS.contains(&word) {
        return Some(
            "temperatures are in `K`: a difference of 1 °C is `1 K`, and 20 °C are `293.15 K`".to_owned(),
        );
    }
    let unit = meanings(SPELLINGS, word).next()?;
    Some(if unit.contains(' ') { format!("1 {word} is `{unit}`") } else { format!("write `{unit}`") })
}

/// Returns what to write for a word that is no unit: nothing that has another size.
pub(crate) fn unit_help(word: &str) -> String {
    unit_meant(word).unwrap_or_else(|| format!("units: {}", UNIT_NAMES.join(" ")))
}

/// Returns what to write for a word that may mean a unit.
pub(crate) fn unit_meant(word: &str) -> Option<String> {
    let base = word.trim_end_matches(|c: char| c.is_ascii_digit());
    if base.len() < word.len() && Unit::named(base).is_some() {
        return Some(format!("write powers with `^`: `{base}^{}`", &word[base.len()..]));
    }
    let is_one_case = word == word.to_lowercase() || word == word.to_uppercase();
    let is_long = |name: &&str| is_one_case && name.len() > 2 && word.len() > 2;
    let in_capitals = || UNIT_NAMES.into_iter().filter(is_long).find(|name| name.eq_ignore_ascii_case(word));
    // What differs in its first letter only has another prefix.
    let rest = || word.chars().skip(1);
    let is_other = |name: &&str| rest().eq(name.chars()) || rest().eq(name.chars().skip(1));
    let is_name = |name: &&str| (name.len() > 3 || matches!(*name, "deg" | "rad")) && word.len() > 3;
    let near = || nearest(word, UNIT_NAMES.into_iter().filter(|name| is_name(name) && !is_other(name)));
    let similar = || in_capitals().or_else(near).map(|near| format!("did you mean `{near}`?"));
    unit_spelling(word).or_else(similar)
}

impl Unit {
    /// The unit 1.
    pub const NONE: Self = Self { dimension: Dimension::NONE, ratio: [1.0; 2], decades: 0, degrees: 0 };

    /// Returns the unit with this name. `µ` is accepted for `u`, as U+00B5 and as the Greek letter.
    pub fn named(name: &str) -> Option<Self> {
        let degrees = |parts: f64| Some(Self { degrees: 1, ratio: [1.0, parts], ..Self::NONE });
        let times = |number: f64, dimension, decades| {
            Some(Self { dimension, ratio: [number, 1.0], decades, degrees: 0 })
        };
        let (dimension, decades) = match name {
            "m" => (Dimension::LENGTH, 0),
            "cm" => (Dimension::LENGTH, -2),
            "mm" => (Dimension::LENGTH, -3),
            "um" | "µm" | "μm" => (Dimension::LENGTH, -6),
            "nm" => (Dimension::LENGTH, -9),
            "inch" => return times(254.0, Dimension::LENGTH, -4),
            "kg" => (Dimension::MASS, 0),
            "g" => (Dimension::MASS, -3),
            "t" => (Dimension::MASS, 3),
            "lb" => return times(45_359_237.0, Dimension::MASS, -8),
            "s" => (Dimension::TIME, 0),
            "min" => return times(60.0, Dimension::TIME, 0),
            "h" => return times(3600.0, Dimension::TIME, 0),
            "K" => (Dimension::TEMPERATURE, 0),
            "N" => (Dimension::FORCE, 0),
            "kN" => (Dimension::FORCE, 3),
            "mN" => (Dimension::FORCE, -3),
            "Pa" => (Dimension::PRESSURE, 0),
            "kPa" => (Dimension::PRESSURE, 3),
            "MPa" => (Dimension::PRESSURE, 6),
            "GPa" => (Dimension::PRESSURE, 9),
            "rad" => (Dimension::NONE, 0),
            "mrad" => (Dimension::NONE, -3),
            "urad" | "µrad" | "μrad" | "ppm" => (Dimension::NONE, -6),
            "%" => (Dimension::NONE, -2),
            "deg" => return degrees(1.0),
            "arcmin" => return degrees(60.0),
            "arcsec" => return degrees(3600.0),
            _ => return None,
        };
        Some(Self { dimension, decades, ..Self::NONE })
    }

    /// Returns the product of this unit and a power of another, or `None` if an exponent overflows.
    pub fn times(self, other: Self, power: i32) -> Option<Self> {
        let [above, below] = other.ratio.map(|number| number.powi(power.abs()));
        let [above, below] = if power < 0 { [below, above] } else { [above, below] };
        let ratio = [self.ratio[0] * above, self.ratio[1] * below];
        ratio.iter().all(|number| number.is_finite()).then_some(())?;
        Some(Self {
            ratio,
            dimension: self.dimension.times(other.dimension.power(f64::from(power))?)?,
            decades: self.decades.checked_add(other.decades.checked_mul(power)?)?,
            degrees: self.degrees.checked_add(other.degrees.checked_mul(power)?)?,
        })
    }

    /// Converts a number in this unit to coherent units: with its decimals, and exact if nothing
    /// changes.
    pub fn convert(self, number: f64, length: LengthUnit) -> f64 {
        let decades = self.decades + decades_per_metre(length) * self.dimension.length_exponent();
        // Dividing first keeps 90 deg exactly π/2.
        let mut number = number * self.ratio[0] / self.ratio[1];
        for _ in 0..self.degrees.abs() {
            number = if self.degrees > 0 {
                number / 180.0 * std::f64::consts::PI
            } else {
                number / std::f64::consts::PI * 180.0
            };
        }
        shifted(number, decades)
    }
}

/// Moves the decimal point of a number: 0.1133 m are 113.3 mm, not 113.29999999999998.
fn shifted(number: f64, decades: i32) -> f64 {
    let text = format!("{number:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent = exponent.parse::<i32>().unwrap_or(0).saturating_add(decades);
    format!("{digits}e{exponent}").parse().unwrap_or(number)
}

/// Returns the power of ten by which a number in metres is multiplied.
fn decades_per_metre(length: LengthUnit) -> i32 {
    match length {
        LengthUnit::Metre => 0,
        LengthUnit::Millimetre => 3,
    }
}

#[cfg(test)]
mod tests;
