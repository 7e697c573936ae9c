//! Numbers and angles as a spec has them.

use std::f64::consts::FRAC_PI_4;

use abbe_spec::edit::write::quoted;

/// Returns a bare number as it is, and an expression in quotes.
pub(super) fn quoted_if_expression(text: &str) -> String {
    if text.parse::<f64>().is_ok() { text.to_owned() } else { quoted(text) }
}

/// Returns an array of three numbers.
pub(super) fn three(numbers: &[f64; 3]) -> String {
    let [x, y, z] = numbers.map(number);
    format!("[{x}, {y}, {z}]")
}

/// Writes an angle in rad.
///
/// The nearest number to a multiple of 45° becomes that multiple of pi, whose sine and cosine are
/// exact. With `degrees` set, other angles are in degrees where a number of at most nine decimals
/// gives the same angle.
pub(super) fn angle(value: f64, degrees: bool) -> String {
    let eighths = (value / FRAC_PI_4).round();
    if value == 0.0 {
        return "0".to_owned();
    }
    if eighths.abs() > 8.0 || eighths * FRAC_PI_4 != value {
        let short = (value.to_degrees() * 1e9).round() / 1e9;
        return match degrees && short.to_radians() == value {
            true => format!("{} deg", number(short)),
            false => number(value),
        };
    }
    let sign = if value < 0.0 { "-" } else { "" };
    let (count, parts) = match eighths.abs() as u32 {
        8 => (2, 1),
        4 => (1, 1),
        2 => (1, 2),
        6 => (3, 2),
        odd => (odd, 4),
    };
    let count = if count == 1 { String::new() } else { format!("{count}*") };
    let parts = if parts == 1 { String::new() } else { format!("/{parts}") };
    format!("{sign}{count}pi{parts}")
}

/// Writes the shortest number that reads back as the same `f64`.
pub(super) fn number(value: f64) -> String {
    let value = value + 0.0;
    if value == 0.0 || (1e-4..1e15).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}
