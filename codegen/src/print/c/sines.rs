//! Sine and cosine in C: of one angle, and of several together, which compilers vectorize. The bits
//! are the same.

use abbe_core::sin_cos::{COSINE, EXACT_PARTS, FRAC_2_PI, SINE};

use super::Real;

/// Constants of a precision, those of `abbe`'s `sin_cos` in double precision: a test checks that
/// both return the same bits.
struct Constants {
    /// Range of the polynomials, and their largest error in units in the last place.
    range: [&'static str; 2],
    /// 2/π.
    turns: f64,
    /// Parts of π/2, the largest first.
    quarter: [f64; 4],
    /// Coefficients of the sine after `r`, the lowest first.
    sine: &'static [f64],
    /// Coefficients of the cosine after 1, the lowest first.
    cosine: &'static [f64],
}

const DOUBLE: Constants =
    Constants { range: ["1e5", "1.7"], turns: FRAC_2_PI, quarter: EXACT_PARTS, sine: &SINE, cosine: &COSINE };

/// π/2 is subtracted in four parts of 12, 12, 12 and the remaining bits. Times an n below 2¹² the
/// first three parts are exact, and so are the first two differences. Sine and cosine of degree 2
/// are minimax polynomials (Remez; coefficients rounded from the lowest power on, refitting the
/// rest each time). A test compares them with the best achievable ones.
const SINGLE: Constants = Constants {
    range: ["6e3", "2.4"],
    turns: 0.63661975,
    quarter: [1.5703125, 0.0004837513, 7.5495336e-8, 2.563344e-12],
    sine: &[-0.16666655, 0.008332189, -0.00019518292],
    cosine: &[-0.5, 0.041666646, -0.001388731, 2.4432327e-5],
};

impl Constants {
    fn new(real: Real) -> &'static Self {
        match real {
            Real::Double => &DOUBLE,
            Real::Float => &SINGLE,
        }
    }

    /// Inserts the constants in a template.
    fn text(&self, template: &str, real: Real) -> String {
        let digits = |value: f64| format!("{value:?}");
        let highest_first = |coefficients: &[f64]| coefficients.iter().rev().copied().map(digits).collect();
        let (quarter, turns) = (self.quarter.map(digits), digits(self.turns));
        let sine: Vec<String> = highest_first(self.sine);
        let cosine: Vec<String> = highest_first(&[&[1.0], self.cosine].concat());
        let line = |name: &str, coefficient: &String| format!("INDENT{name} = z * {name} + {coefficient};\n");
        let parts = quarter[1..].iter().map(|part| format!("INDENTr = r - turns * {part};\n"));
        let polynomials = [
            format!("INDENTdouble s = {};\n", sine[0]),
            sine[1..].iter().map(|coefficient| line("s", coefficient)).collect(),
            "INDENTs = (r * z) * s + r;\n".to_owned(),
            format!("INDENTdouble c = z * {} + {};\n", cosine[0], cosine[1]),
            cosine[2..].iter().map(|coefficient| line("c", coefficient)).collect(),
        ];
        let indent = template
            .split_once("REDUCTION")
            .map_or(0, |(before, _)| before.len() - before.rfind('\n').map_or(0, |at| at + 1));
        let inserted = [
            ("REDUCTION", parts.collect::<String>().trim().to_owned()),
            ("POLYNOMIALS", polynomials.concat().trim().to_owned()),
        ];
        let text = inserted.iter().fold(template.to_owned(), |text, (word, lines)| {
            let lines = lines.trim_start_matches("INDENT").replace("INDENT", &" ".repeat(indent));
            text.replace(word, &lines)
        });
        let numbers = [("QUARTER", &quarter[0][..]), ("TURNS", &turns), ("RANGE", self.range[0])];
        let text = numbers.iter().fold(text, |text, (word, number)| text.replace(word, number));
        let text = real.text(&text).replace("ROUND", &real.rounder());
        [("FAR", self.range[0]), ("ERROR", self.range[1])]
            .iter()
            .fold(text, |text, (word, number)| text.replace(word, number))
    }
}

/// Returns the function for one angle.
pub(super) fn one(real: Real) -> String {
    Constants::new(real).text(ONE, real)
}

/// Returns the function for several angles.
pub(super) fn several(real: Real, count: usize) -> String {
    Constants::new(real).text(SEVERAL, real).replace("COUNT", &count.to_string())
}

const ONE: &str = include_str!("sin_cos.c");

const SEVERAL: &str = include_str!("sin_cos_several.c");
