//! Checks the signs of masses, of compliances, of the stiffnesses of joints, and of the lengths and
//! stiffnesses of beams.

use std::iter;

use abbe_core::Component;

use super::Declarations;
use crate::diagnostic::Diagnostic;
use crate::document::Document;
use crate::expr::{Dimension, Expression, Symbol};
use crate::manipulator::{Beam, Cause, Compliance, DeviationCause, Load, Source};

/// Rounding tolerance for a negative energy of a compliance, relative to its entries.
const ROUNDING: f64 = 1e-9;

/// Records quantities that are negative, or zero where that is not allowed. They are evaluated at
/// the nominal parameters, and at the values and the ends of the ranges of inputs. A quantity that
/// depends on a joint is not checked.
pub(super) fn check_signs(
    sources: &[Source],
    loads: &[Load],
    declarations: &Declarations,
    document: &Document,
) {
    for effect in sources.iter().flat_map(|source| &source.effects) {
        match &effect.cause {
            Cause::Beam(beam) => declarations.check_beam(beam, document),
            Cause::Compliance(compliance) => declarations.check_compliance(compliance, document),
            Cause::Errors(_) => {}
        }
    }
    for deviation in sources.iter().flat_map(|source| &source.deviations) {
        if let DeviationCause::Stiffness(stiffness) = &deviation.cause
            && let Some((_, label)) = declarations.least(stiffness).filter(|(least, _)| *least <= 0.0)
        {
            let help = "a stiff joint has a large stiffness; leave the source out if the joint is rigid";
            let mistake = Diagnostic::new(stiffness.span(), "`stiffness` of a joint must be positive");
            document.mistake(mistake.label(label).help(help));
        }
    }
    for mass in loads.iter().filter_map(|load| load.mass.as_ref()) {
        declarations.check_not_negative(
            mass,
            "the mass of a load",
            "write an upward load as a `force`",
            document,
        );
    }
}

impl Declarations {
    fn check_beam(&self, beam: &Beam, document: &Document) {
        let bending = Beam::bending_keys(beam.axis).into_iter().zip(&beam.bending);
        let required = iter::once(("length", &beam.length)).chain(bending);
        let optional = [("GJ", &beam.torsion), ("EA", &beam.extension)];
        let given = optional.iter().filter_map(|(key, value)| Some((*key, value.as_ref()?)));
        for (key, value) in required.chain(given) {
            if let Some((_, label)) = self.least(value).filter(|(least, _)| *least <= 0.0) {
                document.mistake(
                    Diagnostic::new(value.span(), format!("`{key}` of a beam must be positive"))
                        .label(label)
                        .help(match key {
                            "length" => "it is the distance from the clamped end to the tip",
                            "GJ" | "EA" => "leave it out if the beam is rigid",
                            _ => "a bending stiffness is positive; leave the source out if the beam is rigid",
                        }),
                );
            }
        }
        if let Some(mass) = &beam.mass_per_length {
            self.check_not_negative(
                mass,
                "`mass_per_length`",
                "leave it out if the weight of the beam does not matter",
                document,
            );
        }
    }

    /// Checks that a compliance is positive semidefinite, because `wᵀ C w` is twice the energy: no
    /// diagonal entry and no pivot of a symmetric elimination is negative.
    fn check_compliance(&self, compliance: &Compliance, document: &Document) {
        for (i, row) in compliance.iter().enumerate() {
            if let Some(entry) = &row[i] {
                let what = format!("the compliance of {}", Component::ALL[i].name());
                let help = "the displacement under a load has the direction of the load; write 0 for a rigid direction";
                if self.check_not_negative(entry, &what, help, document) {
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
                Diagnostic::new(entry.span(), "this compliance matrix is not positive semidefinite")
                    .label(format!("too small for the entries that couple {} with {above}", Component::ALL[i].name()))
                    .help("the square of an off-diagonal entry is at most the product of the two diagonal entries"),
            );
        }
    }

    /// Records a negative value; returns `true` if it is negative.
    fn check_not_negative(&self, value: &Expression, what: &str, help: &str, document: &Document) -> bool {
        let Some((_, label)) = self.least(value).filter(|(least, _)| *least < 0.0) else { return false };
        document
            .mistake(Diagnostic::new(value.span(), format!("{what} is negative")).label(label).help(help));
        true
    }

    /// Returns the least value and the input that causes it; `None` if the value depends on a
    /// joint.
    fn least(&self, expression: &Expression) -> Option<(f64, String)> {
        if let Some(value) = expression.constant() {
            return Some((value, String::new()));
        }
        if expression.symbols().any(Symbol::is_joint) {
            return None;
        }
        let at = |changed: Option<(usize, f64)>| {
            let value = |symbol| match (symbol, changed) {
                (Symbol::Parameter(i), _) => self.parameters[i].value,
                (Symbol::Input(i), Some((input, end))) if i == input => end,
                (Symbol::Input(i), _) => self.inputs[i].value,
                _ => f64::NAN,
            };
            expression.value(&self.scope.tables, value)
        };
        let dimension = expression.whole().dimension.unwrap_or(Dimension::NONE);
        let unit = dimension.unit(self.scope.length.symbol());
        let label = |value: f64, at: String| format!("{value} {unit} {at}").replace("  ", " ");
        let nominal = at(None);
        let mut least = (nominal, label(nominal, "with the nominal values".to_owned()));
        for symbol in expression.symbols() {
            let Symbol::Input(i) = symbol else { continue };
            let input = &self.inputs[i];
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

/// Returns the first row with a negative pivot, by symmetric Gaussian elimination.
fn first_negative_pivot(mut rest: [[f64; 6]; 6]) -> Option<usize> {
    let diagonal: [f64; 6] = std::array::from_fn(|i| rest[i][i]);
    for i in 0..6 {
        let small = ROUNDING * diagonal[i];
        if rest[i][i] < -small {
            return Some(i);
        }
        for j in i + 1..6 {
            // The rest of a row with a zero pivot must be zero.
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
