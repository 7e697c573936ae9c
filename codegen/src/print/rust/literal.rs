//! Number literals of Rust.

use std::f64::consts;

/// Constants with a name in Rust's standard library.
const NAMED: [(f64, &str); 10] = [
    (consts::PI, "PI"),
    (consts::TAU, "TAU"),
    (consts::FRAC_PI_2, "FRAC_PI_2"),
    (consts::FRAC_PI_3, "FRAC_PI_3"),
    (consts::FRAC_PI_4, "FRAC_PI_4"),
    (consts::FRAC_PI_6, "FRAC_PI_6"),
    (consts::FRAC_PI_8, "FRAC_PI_8"),
    (consts::SQRT_2, "SQRT_2"),
    (consts::FRAC_1_SQRT_2, "FRAC_1_SQRT_2"),
    (consts::E, "E"),
];

/// Returns a named constant, or the shortest literal that represents the number exactly.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        return "f64::NAN".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned();
    }
    match NAMED.iter().find(|(named, _)| *named == value.abs()) {
        Some((_, name)) if value < 0.0 => format!("-::core::f64::consts::{name}"),
        Some((_, name)) => format!("::core::f64::consts::{name}"),
        None => format!("{value:?}"),
    }
}

/// Returns `true` if clippy would report the number as an approximate constant such as π or √2.
pub(super) fn looks_like_named(value: f64) -> bool {
    NAMED.iter().any(|(named, _)| {
        let difference = (value.abs() - named).abs() / named;
        difference > 0.0 && difference < 5e-3
    })
}
