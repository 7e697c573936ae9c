//! Random expressions with valid dimensions.

use super::Choices;

/// Returns a random expression, a length if `length`, otherwise a pure number. `names` are those of
/// pure numbers, and of lengths.
///
/// Arguments of functions are within their domains.
pub fn expression(c: &mut Choices<'_>, length: bool, names: [&[String]; 2], depth: usize) -> String {
    let pure = |c: &mut Choices<'_>| expression(c, false, names, depth.saturating_sub(1));
    let [numbers, lengths] = names;
    if length {
        return match c.below(if depth == 0 { 2 } else { 8 }) {
            0 if !lengths.is_empty() => c.one_of(lengths).clone(),
            0 | 1 => format!("{} {}", c.decimal(1, 400), c.one_of(&["mm", "mm", "cm", "m/10", "inch"])),
            2 => {
                let (a, b) = (pure(c), expression(c, true, names, depth - 1));
                format!("({a})*({b})")
            }
            3 => format!("{} mm * ({})", c.decimal(1, 90), pure(c)),
            4 => format!("sqrt(({0})^2 + (3 mm)^2)", expression(c, true, names, depth - 1)),
            5 => {
                let [a, b] = [0, 1].map(|_| expression(c, true, names, depth - 1));
                format!("{}({a}, {b})", c.one_of(&["min", "max"]))
            }
            6 => format!("abs({})", expression(c, true, names, depth - 1)),
            _ => {
                let [a, b] = [0, 1].map(|_| expression(c, true, names, depth - 1));
                format!("({a} {} {b})", c.one_of(&["+", "-"]))
            }
        };
    }
    match c.below(if depth == 0 { 2 } else { 13 }) {
        0 if !numbers.is_empty() => c.one_of(numbers).clone(),
        0 | 1 => c
            .one_of(&["0.3", "-1.7", "2", "pi/2", "0", "1", "-1", "12.5 deg", "1e-3", "40 arcmin"])
            .to_string(),
        2 => format!("sin({})", pure(c)),
        3 => format!("cos({})", pure(c)),
        4 => format!("{}({})", c.one_of(&["sin", "cos"]), pure(c)),
        5 => format!("({} {} {})", pure(c), c.one_of(&["+", "-", "*"]), pure(c)),
        6 => format!("-({})", pure(c)),
        7 => format!("atan2({}, 2 + cos({}))", pure(c), pure(c)),
        8 => {
            format!(
                "{}(0.9*sin({}))",
                c.one_of(&["asin", "acos", "tan", "atan", "exp", "sign", "abs"]),
                pure(c)
            )
        }
        9 => format!("({})/(3 + sin({}))", pure(c), pure(c)),
        10 => format!("log(2 + cos({}))", pure(c)),
        11 => format!("(2 + sin({}))^{}", pure(c), c.one_of(&["2", "3", "-1", "0.5", "1.7"])),
        _ => format!("({})/(1 m)", expression(c, true, names, depth - 1)),
    }
}
