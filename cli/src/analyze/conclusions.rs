//! The results in sentences: tolerance, spheres, compensation, first order.

use abbe::analysis::RemainingErrors;

use super::Analysis;
use crate::table::wrapped;
use abbe_study::number::{self, percent, short};

/// One paragraph for each, for a terminal.
pub(super) fn of(analysis: &Analysis) -> String {
    sentences(analysis).iter().map(|sentence| format!("{}\n", wrapped(sentence, 0))).collect()
}

pub(super) fn sentences(analysis: &Analysis) -> Vec<String> {
    let sentences = [
        tolerance(analysis),
        allowed(analysis),
        Some(spheres(analysis)),
        ellipsoid(analysis),
        published_residual(analysis),
        analysis.budget.compensation.as_ref().map(|compensation| residual(analysis, compensation)),
        Some(first_order(analysis)),
    ];
    sentences.into_iter().flatten().collect()
}

impl Analysis<'_> {
    fn show(&self, value: f64) -> String {
        format!("{} {}", number::trimmed(value, self.decimals()), self.description.length.symbol())
    }

    fn of_tolerance(&self, value: f64) -> String {
        let share = self.study.tolerance.map(|tolerance| percent(value, tolerance));
        share.map(|share| format!(", {share} of the tolerance")).unwrap_or_default()
    }
}

fn tolerance(analysis: &Analysis) -> Option<String> {
    let tolerance = analysis.study.tolerance?;
    let share = percent(analysis.budget.combined.radius.value, tolerance);
    Some(format!("Tolerance: {}; the radius is {share} of it.", analysis.show(tolerance)))
}

fn allowed(analysis: &Analysis) -> Option<String> {
    let admissible = analysis.admissible.as_ref()?;
    Some(format!(
        "It is met with all sources × {}, or for certain with each at an equal share of {}.",
        number::digits(admissible.together?, 3),
        analysis.show(admissible.share?)
    ))
}

fn spheres(analysis: &Analysis) -> String {
    let combined = &analysis.budget.combined;
    let sphere = &combined.enclosing;
    let [x, y, z] = sphere.centre.map(|value| number::trimmed(value, analysis.decimals()));
    let mut text = format!(
        "Repeatable errors lie within {} of zero; the smallest sphere around them has the radius {} and the centre \
         ({x}, {y}, {z})",
        analysis.show(combined.repeatable_radius.value),
        analysis.show(sphere.radius),
    );
    // What cannot be seen in print is rounding.
    if sphere.excess > 1e-9 * sphere.radius {
        text += &format!(", or is smaller by {} at most", analysis.show(sphere.excess));
    }
    text + "."
}

fn ellipsoid(analysis: &Analysis) -> Option<String> {
    let ellipsoid = &analysis.budget.combined.ellipsoid;
    ellipsoid.configuration?;
    let [a, b, c] = ellipsoid.semi_axes.map(|value| number::trimmed(value, analysis.decimals()));
    let unit = analysis.description.length.symbol();
    Some(format!(
        "Random errors, if normal, lie with 95 % probability in an ellipsoid with the semi-axes {a}, {b}, {c} {unit} \
         where it is longest."
    ))
}

fn published_residual(analysis: &Analysis) -> Option<String> {
    let published = analysis.study.compensated.as_ref()?;
    let random = analysis.budget.combined.random_radius.value;
    let total = published.residual + random;
    Some(format!(
        "After compensation: {} repeatable residual + {} random = {}{}; {} prints {} + {} = {} ({}).",
        analysis.show(published.residual),
        analysis.show(random),
        analysis.show(total),
        analysis.of_tolerance(total),
        analysis.publisher(),
        short(published.residual),
        short(published.random),
        analysis.show(published.total),
        published.reference,
    ))
}

fn residual(analysis: &Analysis, compensation: &RemainingErrors) -> String {
    format!(
        "Compensated as the study says: {} remain of the repeatable sources (root sum of squares; {} if all added), \
         and with the random ones the total absolute accuracy is {}{}.",
        analysis.show(compensation.residual.value),
        analysis.show(compensation.residual_sum.value),
        analysis.show(compensation.total.value),
        analysis.of_tolerance(compensation.total.value),
    )
}

fn first_order(analysis: &Analysis) -> String {
    let first_order = &analysis.first_order;
    let which =
        match analysis.description.sources.iter().any(|source| source.class == abbe::Class::Repeatable) {
            true => "repeatable sources",
            false => "random sources at their bounds",
        };
    let spread = match first_order.checked < analysis.budget.configurations {
        true => ", spread evenly over all",
        false => "",
    };
    format!(
        "First order: J_e ε of the {which} differs from the exact chain A_1 E_1 … A_n E_n T by at most {}, at {} \
         configurations{spread}.",
        analysis.show(first_order.largest),
        first_order.checked,
    )
}
