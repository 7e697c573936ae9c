//! Units of the numbers of a table.

use std::str::FromStr;

use abbe::LengthUnit;

/// Units of numbers for which neither heading nor cell states one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Unit of lengths, and of the spec.
    pub length: Option<LengthUnit>,
    /// Angles are in degrees if set to `true`, in rad if `false`.
    pub degrees: Option<bool>,
}

/// Parses `mm,deg` in either order, or one of the two.
impl FromStr for Units {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut units = Self::default();
        for unit in text.split(',').map(str::trim) {
            match unit {
                "m" if units.length.is_none() => units.length = Some(LengthUnit::Metre),
                "mm" if units.length.is_none() => units.length = Some(LengthUnit::Millimetre),
                "deg" if units.degrees.is_none() => units.degrees = Some(true),
                "rad" if units.degrees.is_none() => units.degrees = Some(false),
                _ => return Err("give one of m and mm, and one of deg and rad, as in `mm,deg`"),
            }
        }
        Ok(units)
    }
}
