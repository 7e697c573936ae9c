//! What must be positive: lengths and stiffnesses of beams, masses, what a compliance gives.

use abbe_core::Component;

use super::declarations::Declarations;
use crate::diagnostic::Diagnostic;
use crate::document::Document;
use crate::expr::{Dimension, Expression, Symbol};
use crate::manipulator::{Beam, Cause, Compliance, Load, Source};

/// How far below zero rounding may bring the energy of a compliance, as a share of its entries.
const ROUNDING: f64 = 1e-9;

/// Finds what is negative, or zero where it must not be: with the nominal parameters, and with inputs at their values and
/// at the ends of their ranges. What depends on a joint is not looked at.
pub(super) fn check_signs(
    sources: &[Source],
    loads: &[Load],
    declarations: &Declarations,
    document: &mut Document,
) {
    let check = Check { declarations };
    for effect in sources.iter().flat_map(|source| &source.effects) {
        match &effect.cause {
            Cause::Beam(beam) => check.beam(beam, document),
            Cause::Compliance(compliance) => check.compliance(compliance, document),
            Cause::Errors(_) => {}
        }
    }
    for mass in loads.iter().filter_map(|load| load.mass.as_ref()) {
        check.not_negative(mass, "the mass of a load", "a load that pulls upwards is a `force`", document);
    }
}

struct Check<'a> {
    declarations: &'a Declarations,
}

impl Check<'_> {
    fn beam(&self, beam: &Beam, document: &mut Document) {
        let [y, z] = &beam.bending;
        let required = [("length", &beam.length), ("EI_y", y), ("EI_z", z)].into_iter();
        let optional = [("GJ", &beam.torsion), ("EA", &beam.extension)];
        let given = optional.iter().filter_map(|(key, value)| Some((*key, value.as_ref()?)));
        for (key, value) in required.chain(given) {
            if let Some((_, label)) = self.least(value).filter(|(least, _)| *least <= 0.0) {
                document.mistake(
                    Diagnostic::new(value.span(), format!("`{key}` of a beam must be positive"))
                        .label(label)
                        .help(match key {
                            "length" => "it is the distance from where the beam is clamped to its end",
                            "GJ" | "EA" => "leave it out where the beam is rigid",
                            _ => "a beam resists bending; leave the source out where it is rigid",
                        }),
                );
            }
        }
        if let Some(mass) = &beam.mass_per_length {
            self.not_negative(
                mass,
                "`mass_per_length`",
                "leave it out where a beam weighs nothing",
                document,
            );
        }
    }

    /// `wᵀ C w` is twice the energy: no diagonal entry is negative, nor is any pivot of a symmetric elimination.
    fn compliance(&self, compliance: &Compliance, document: &mut Document) {
        for (i, row) in compliance.iter().enumerate() {
            if let Some(entry) = &row[i] {
                let what = format!("the compliance of {}", Component::ALL[i].name());
                let help = "what is pulled gives way in the direction of the pull; write 0 where it is rigid";
                if self.not_negative(entry, &what, help, document) {
                    return;
                }
            }
        }
        let value = |entry: &Option<Expression>| entry.as_ref().map_or(Some(0.0), Expression::constant);
        let mut rest = [[0.0; 6]; 6];
        for (row, entries) in rest.iter_mut().zip(compliance) {
            for (number, entry) in row.iter_mut().zip(entries) {
                let Some(value) = value(entry) else { return };
                *number = value;
            }
        }
        if let Some(i) = first_negative_pivot(rest)
            && let Some(entry) = &compliance[i][i]
        {
            let above =
                Component::ALL[..i].iter().map(|component| component.name()).collect::<Vec<_>>().join(", ");
            document.mistake(
                Diagnostic::new(entry.span(), "some load would gain energy from this compliance")
                    .label(format!("too small for what couples {} with {above}", Component::ALL[i].name()))
                    .help("the square of an entry off the diagonal is at most the product of the two on it: C must be positive semidefinite"),
            );
        }
    }

    /// Whether a mistake was found.
    fn not_negative(&self, value: &Expression, what: &str, help: &str, document: &mut Document) -> bool {
        let Some((_, label)) = self.least(value).filter(|(least, _)| *least < 0.0) else {
            return false;
        };
        document
            .mistake(Diagnostic::new(value.span(), format!("{what} is negative")).label(label).help(help));
        true
    }

    /// The least value, and what makes it so; none of what depends on a joint.
    fn least(&self, expression: &Expression) -> Option<(f64, String)> {
        if let Some(value) = expression.constant() {
            return Some((value, String::new()));
        }
        if expression.symbols().any(|symbol| matches!(symbol, Symbol::Variable(_))) {
            return None;
        }
        let at = |changed: Option<(usize, f64)>| {
            let value = |symbol| match (symbol, changed) {
                (Symbol::Parameter(i), _) => self.declarations.parameters[i].value,
                (Symbol::Input(i), Some((input, end))) if i == input => end,
                (Symbol::Input(i), _) => self.declarations.inputs[i].value,
                _ => f64::NAN,
            };
            expression.value(&self.declarations.scope.tables, value)
        };
        let dimension = expression.whole().dimension.unwrap_or(Dimension::NONE);
        let unit = dimension.unit(self.declarations.scope.length.symbol());
        let label = |value: f64, at: String| format!("{value} {unit} {at}").replace("  ", " ");
        let nominal = at(None);
        let mut least = (nominal, label(nominal, "with the nominal values".to_owned()));
        for symbol in expression.symbols() {
            let Symbol::Input(i) = symbol else { continue };
            let input = &self.declarations.inputs[i];
            for end in input.range.into_iter().filter(|end| end.is_finite()) {
                let value = at(Some((i, end)));
                if value < least.0 {
                    let at = format!("at {} = {end} {}", input.name, input.unit);
                    least = (value, label(value, at.trim_end().to_owned()));
                }
            }
        }
        Some(least)
    }
}

/// The first row whose pivot is negative, by Gaussian elimination of a symmetric matrix.
fn first_negative_pivot(mut rest: [[f64; 6]; 6]) -> Option<usize> {
    let diagonal: [f64; 6] = std::array::from_fn(|i| rest[i][i]);
    for i in 0..6 {
        let small = ROUNDING * diagonal[i];
        if rest[i][i] < -small {
            return Some(i);
        }
        for j in i + 1..6 {
            // Beside a pivot of zero nothing may stand.
            if rest[i][i] <= small {
                if rest[j][i].powi(2) > ROUNDING * diagonal[i] * diagonal[j] {
                    return Some(j);
                }
                continue;
            }
            let factor = rest[j][i] / rest[i][i];
            let pivot_row = rest[i];
            for (entry, above) in rest[j].iter_mut().zip(pivot_row).skip(i + 1) {
                *entry -= factor * above;
            }
        }
    }
    None
}
