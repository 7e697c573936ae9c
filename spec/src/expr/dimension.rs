//! Physical dimensions.

use std::fmt;

/// A physical dimension as exponents of length, mass, time and temperature. Angles are pure
/// numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponents times two, so that square roots stay exact.
    halves: [i8; 4],
}

impl Dimension {
    /// A pure number, an angle or a slope.
    pub const NONE: Self = Self { halves: [0; 4] };
    /// A length.
    pub const LENGTH: Self = Self { halves: [2, 0, 0, 0] };
    /// A mass.
    pub const MASS: Self = Self { halves: [0, 2, 0, 0] };
    /// A time.
    pub const TIME: Self = Self { halves: [0, 0, 2, 0] };
    /// A temperature difference.
    pub const TEMPERATURE: Self = Self { halves: [0, 0, 0, 2] };
    /// A force.
    pub const FORCE: Self = Self { halves: [2, 2, -4, 0] };
    /// A moment.
    pub const MOMENT: Self = Self { halves: [4, 2, -4, 0] };
    /// A bending or torsional stiffness: force times area.
    pub const FORCE_TIMES_AREA: Self = Self { halves: [6, 2, -4, 0] };
    /// An acceleration.
    pub const ACCELERATION: Self = Self { halves: [2, 0, -4, 0] };
    /// A mass per length.
    pub const MASS_PER_LENGTH: Self = Self { halves: [-2, 2, 0, 0] };
    /// A pressure.
    pub const PRESSURE: Self = Self { halves: [-2, 2, -4, 0] };

    /// Returns `true` if a bare number is unambiguous as a whole entry of this dimension.
    ///
    /// Lengths are in the spec's unit and angles in radians. The coherent unit of a force, for
    /// example, is not obvious, so it must be given.
    pub(crate) fn takes_bare(self, number: f64) -> bool {
        number == 0.0 || self == Self::NONE || self == Self::LENGTH
    }

    /// Returns the dimension of a product, or `None` if an exponent overflows.
    pub fn times(self, other: Self) -> Option<Self> {
        self.combine(other, i8::checked_add)
    }

    /// Returns the dimension of a quotient, or `None` if an exponent overflows.
    pub fn over(self, other: Self) -> Option<Self> {
        self.combine(other, i8::checked_sub)
    }

    /// Returns the dimension of a power, or `None` if an exponent is no multiple of 1/2.
    pub fn power(self, exponent: f64) -> Option<Self> {
        let mut halves = [0; 4];
        for (power, half) in halves.iter_mut().zip(self.halves) {
            let exact = f64::from(half) * exponent;
            if exact.fract() != 0.0 || exact.abs() > 100.0 {
                return None;
            }
            *power = exact as i8;
        }
        Some(Self { halves })
    }

    /// Returns the exponent of length.
    pub fn length_exponent(self) -> i32 {
        i32::from(self.halves[0]) / 2
    }

    /// Returns the exponents of length, mass, time and temperature, or `None` if one is not an
    /// integer.
    pub fn whole_exponents(self) -> Option<[i32; 4]> {
        self.halves.iter().all(|half| half % 2 == 0).then(|| self.halves.map(|half| i32::from(half) / 2))
    }

    /// Returns the coherent unit in a system whose length unit is `length`; empty for a pure
    /// number.
    pub fn unit(self, length: &str) -> String {
        let names = [length, "kg", "s", "K"];
        let power = |halves: i8, name: &str| match halves {
            2 => name.to_owned(),
            whole if whole % 2 == 0 => format!("{name}^{}", whole / 2),
            half => format!("{name}^({half}/2)"),
        };
        let part = |sign: i8| -> Vec<String> {
            let exponents = self.halves.iter().zip(names);
            exponents.filter(|(h, _)| **h * sign > 0).map(|(h, name)| power(h * sign, name)).collect()
        };
        match (part(1).join("*"), part(-1)) {
            (above, below) if below.is_empty() => above,
            (above, below) if above.is_empty() => format!("1/{}", below.join("/")),
            (above, below) => format!("{above}/{}", below.join("/")),
        }
    }

    /// Returns units that engineers use for the dimension: the coherent one if there are no others.
    pub fn units(self, length: &str) -> Vec<String> {
        let [metres, mass, time, kelvins] = self.halves;
        let force = [0, mass, time, kelvins] == [0, 2, -4, 0];
        let inverse = [0, mass, time, kelvins] == [0, -2, 4, 0];
        let of_length = |power: i8, unit: &str| match power {
            1 => unit.to_owned(),
            power => format!("{unit}^{power}"),
        };
        match (metres - 2) / 2 {
            _ if metres % 2 != 0 => vec![self.unit(length)],
            0 if force => vec!["N".to_owned()],
            _ if self == Self::PRESSURE => vec!["Pa".to_owned(), "GPa".to_owned()],
            power if force && power > 0 => {
                ["m", "mm"].map(|unit| format!("N*{}", of_length(power, unit))).to_vec()
            }
            power if force => ["m", "mm"].map(|unit| format!("N/{}", of_length(-power, unit))).to_vec(),
            _ if inverse && metres == 0 => ["mm/N", "um/N"].map(str::to_owned).to_vec(),
            _ if inverse && metres == -4 => vec!["rad/(N*m)".to_owned()],
            _ if self == Self::ACCELERATION => vec!["m/s^2".to_owned()],
            _ => vec![self.unit(length)],
        }
    }

    fn combine(self, other: Self, with: fn(i8, i8) -> Option<i8>) -> Option<Self> {
        let mut halves = [0; 4];
        for (i, half) in halves.iter_mut().enumerate() {
            *half = with(self.halves[i], other.halves[i]).filter(|h| h.abs() <= 100)?;
        }
        Some(Self { halves })
    }
}

/// Displays the dimension in words: `a length`, `a pure number`, `mm^2/s`.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match *self {
            Self::NONE => "a pure number",
            Self::LENGTH => "a length",
            Self::MASS => "a mass",
            Self::TIME => "a time",
            Self::TEMPERATURE => "a temperature",
            Self::FORCE => "a force",
            Self::PRESSURE => "a pressure",
            Self::MOMENT => "a moment",
            Self::FORCE_TIMES_AREA => "a bending or torsional stiffness",
            Self::ACCELERATION => "an acceleration",
            Self::MASS_PER_LENGTH => "a mass per length",
            other => return write!(f, "a quantity in {}", other.unit("m")),
        };
        f.write_str(name)
    }
}
