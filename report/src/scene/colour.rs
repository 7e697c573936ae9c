//! Colours of figures.

use serde::{Serialize, Serializer};

/// Colour as red, green and blue. Serialized in CSS notation, `#d55e00`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

/// Nine colours of the viridis map, from dark to light with uniform steps of lightness, also in
/// print.
const VIRIDIS: [Colour; 9] = [
    Colour(68, 1, 84),
    Colour(71, 44, 122),
    Colour(59, 81, 139),
    Colour(44, 113, 142),
    Colour(33, 144, 141),
    Colour(39, 173, 129),
    Colour(92, 200, 99),
    Colour(170, 220, 50),
    Colour(253, 231, 37),
];

impl Colour {
    /// Colours of x, y and z, distinguishable with red-green colour blindness (Okabe and Ito).
    pub(crate) const XYZ: [Self; 3] = [Self(213, 94, 0), Self(0, 158, 115), Self(0, 114, 178)];
    /// Text, norms, and all sources together.
    pub(crate) const INK: Self = Self(40, 44, 52);
    /// Published figures.
    pub(crate) const PUBLISHED: Self = Self(160, 70, 130);
    /// Bars, and errors after a correction.
    pub(crate) const BAR: Self = Self(66, 122, 178);
    /// Axes, tick labels, and errors before a correction.
    pub(crate) const GREY: Self = Self(110, 114, 122);
    /// Grid lines.
    pub(crate) const FAINT: Self = Self(226, 228, 232);
    /// Links of a manipulator.
    pub(crate) const LINK: Self = Self(176, 182, 192);
    /// Tolerances and limits.
    pub(crate) const TOLERANCE: Self = Self(120, 120, 120);

    /// Returns the colour at `share` of the viridis map, from 0 to 1, in 32 steps.
    pub(crate) fn graded(share: f64) -> Self {
        let share = (share.clamp(0.0, 1.0) * 31.0).round() / 31.0;
        let at = share * (VIRIDIS.len() - 1) as f64;
        let i = (at as usize).min(VIRIDIS.len() - 2);
        let between = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * (at - i as f64)) as u8;
        let (low, high) = (VIRIDIS[i], VIRIDIS[i + 1]);
        Self(between(low.0, high.0), between(low.1, high.1), between(low.2, high.2))
    }

    /// Formats the colour in CSS notation.
    pub(crate) fn css(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.css())
    }
}
