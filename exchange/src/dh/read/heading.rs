//! Names of columns and the units in them.

use abbe::LengthUnit;

/// Quantity in a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Name of the joint.
    Name,
    /// Kind of the joint: revolute, prismatic or fixed.
    Kind,
    Theta,
    D,
    A,
    Alpha,
    /// Constant that is added to the variable.
    Offset,
    /// Lower limit of the variable.
    Lower,
    /// Upper limit of the variable.
    Upper,
    /// Sense of the variable about the axis: 1 or −1.
    Sign,
    /// Position of base or tool.
    X,
    Y,
    Z,
    /// Orientation of base or tool.
    Roll,
    Pitch,
    Yaw,
}

/// Unit in a heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Length(LengthUnit),
    Degree,
    Radian,
}

/// Interpretation of the name of a column.
pub(super) struct Heading {
    pub(super) quantity: Quantity,
    pub(super) unit: Option<Unit>,
    /// The name has the index of the previous link, `a_{i-1}`, which only the modified convention
    /// has.
    pub(super) is_of_previous_link: bool,
}

/// Names of columns, in lower case without blanks, braces and signs of TeX.
const NAMES: [(Quantity, &[&str]); 16] = [
    (Quantity::Name, &["joint", "name", "jointname", "link", "axis", "j", "i", "no", "#"]),
    (Quantity::Kind, &["kind", "type", "jointtype", "sigma"]),
    (Quantity::Theta, &["theta", "θ"]),
    (Quantity::D, &["d"]),
    (Quantity::A, &["a", "r"]),
    (Quantity::Alpha, &["alpha", "α", "⍺"]),
    (Quantity::Offset, &["offset", "thetaoffset", "zero"]),
    (Quantity::Lower, &["lower", "min", "qmin", "q⁻", "lowerlimit"]),
    (Quantity::Upper, &["upper", "max", "qmax", "q⁺", "upperlimit"]),
    (Quantity::Sign, &["sign", "sense", "direction"]),
    (Quantity::X, &["x"]),
    (Quantity::Y, &["y"]),
    (Quantity::Z, &["z"]),
    (Quantity::Roll, &["roll"]),
    (Quantity::Pitch, &["pitch"]),
    (Quantity::Yaw, &["yaw"]),
];

impl Heading {
    /// Interprets the name of a column; `None` if it is unknown.
    pub(super) fn parse(name: &str) -> Option<Self> {
        let (name, unit) = match name.trim_end_matches([')', ']']).rsplit_once(['(', '[']) {
            Some((before, inner)) if unit(inner).is_some() => (before, unit(inner)),
            _ => (name, None),
        };
        let letters = name.to_lowercase();
        let letters: String =
            letters.chars().filter(|c| !(c.is_whitespace() || "_{}()$\\^*".contains(*c))).collect();
        let find = |letters: &str| {
            NAMES.iter().find(|(_, names)| names.contains(&letters)).map(|(quantity, _)| *quantity)
        };
        if let Some(quantity) = find(&letters) {
            return Some(Self { quantity, unit, is_of_previous_link: false });
        }
        let indices = [
            ("i-1", true),
            ("j-1", true),
            ("ⱼ₋₁", true),
            ("ᵢ₋₁", true),
            ("i", false),
            ("j", false),
            ("ⱼ", false),
            ("ᵢ", false),
        ];
        let (base, is_of_previous_link) =
            indices.iter().find_map(|(index, previous)| Some((letters.strip_suffix(index)?, *previous)))?;
        Some(Self { quantity: find(base)?, unit, is_of_previous_link })
    }
}

/// Parses the name of a unit.
fn unit(text: &str) -> Option<Unit> {
    Some(match text.trim() {
        "m" => Unit::Length(LengthUnit::Metre),
        "mm" => Unit::Length(LengthUnit::Millimetre),
        "deg" | "°" | "degree" | "degrees" => Unit::Degree,
        "rad" | "radian" | "radians" => Unit::Radian,
        _ => return None,
    })
}
