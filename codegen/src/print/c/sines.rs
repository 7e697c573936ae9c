//! Sine and cosine in C: of one angle, and of several together, which compilers vectorize. The bits
//! are the same.

use super::real::Real;

/// Constants of a precision, those of `abbe`'s `sin_cos` in double precision: a test checks that
/// both return the same bits.
struct Constants {
    /// Range of the polynomials, and their largest error in units in the last place.
    range: [&'static str; 2],
    /// 2/π.
    turns: &'static str,
    /// Parts of π/2, the largest first.
    quarter: [&'static str; 4],
    /// Coefficients of the sine after `r`, the highest first.
    sine: &'static [&'static str],
    /// Coefficients of the cosine, the highest first.
    cosine: &'static [&'static str],
}

const DOUBLE: Constants = Constants {
    range: ["1e5", "1.7"],
    turns: "0.6366197723675814",
    quarter: [
        "1.5707963267923333",
        "2.5632829192545614e-12",
        "6.123233995707727e-17",
        "2.9038559739793605e-28",
    ],
    sine: &[
        "1.58969099521155e-10",
        "-2.5050760253406863e-8",
        "2.7557313707070068e-6",
        "-0.0001984126982985795",
        "0.00833333333332249",
        "-0.16666666666666632",
    ],
    cosine: &[
        "-1.1359647557788195e-11",
        "2.087572321298175e-9",
        "-2.7557314351390663e-7",
        "2.480158728947673e-5",
        "-0.001388888888887411",
        "0.0416666666666666",
        "-0.5",
        "1.0",
    ],
};

/// π/2 is subtracted in four parts of 12, 12, 12 and the remaining bits. Times an n below 2¹² the
/// first three parts are exact, and so are the first two differences. Sine and cosine of degree 2
/// are minimax polynomials (Remez; coefficients rounded from the lowest power on, refitting the
/// rest each time). A test compares them with the best achievable ones.
const SINGLE: Constants = Constants {
    range: ["6e3", "2.4"],
    turns: "0.63661975",
    quarter: ["1.5703125", "0.0004837513", "7.5495336e-8", "2.563344e-12"],
    sine: &["-0.00019518292", "0.008332189", "-0.16666655"],
    cosine: &["2.4432327e-5", "-0.001388731", "0.041666646", "-0.5", "1.0"],
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
        let line = |name: &str, coefficient: &&str| format!("INDENT{name} = z * {name} + {coefficient};\n");
        let parts = self.quarter[1..].iter().map(|part| format!("INDENTr = r - turns * {part};\n"));
        let (first, second) = (self.cosine[0], self.cosine[1]);
        let polynomials = [
            format!("INDENTdouble s = {};\n", self.sine[0]),
            self.sine[1..].iter().map(|coefficient| line("s", coefficient)).collect(),
            "INDENTs = (r * z) * s + r;\n".to_owned(),
            format!("INDENTdouble c = z * {first} + {second};\n"),
            self.cosine[2..].iter().map(|coefficient| line("c", coefficient)).collect(),
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
        let numbers = [("QUARTER", self.quarter[0]), ("TURNS", self.turns), ("RANGE", self.range[0])];
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
