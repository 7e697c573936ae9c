//! Tick positions of an axis.

use abbe_study::{date::Calendar, number};

use crate::scene::{Axis, Scale};

/// Tick with its position and label.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) at: f64,
    pub(super) label: String,
}

/// Returns round values within the range of an axis, at most about `about`.
pub(super) fn ticks(axis: &Axis, about: usize) -> Vec<Tick> {
    match &axis.scale {
        Scale::Linear => linear(axis.range, &axis.unit, about),
        Scale::Logarithmic => decades(axis.range, about),
        Scale::Dates => dates(axis.range, about),
        Scale::Names(names) => {
            names.iter().enumerate().map(|(i, name)| Tick { at: i as f64, label: name.clone() }).collect()
        }
    }
}

fn linear([least, largest]: [f64; 2], unit: &str, about: usize) -> Vec<Tick> {
    let span = (largest - least) / about.max(1) as f64;
    let step = if unit == "deg" && (1.0..180.0).contains(&span) {
        let steps = [2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0];
        steps.into_iter().find(|step| *step >= span).unwrap_or(180.0)
    } else {
        let power = 10f64.powf(span.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
        steps.into_iter().find(|step| *step >= span * 0.98).unwrap_or(span)
    };
    if !(step > 0.0 && step.is_finite()) {
        return vec![Tick { at: least, label: number::short(least) }];
    }
    let decimals = (-(step * 1.0001).log10().floor()).max(0.0) as usize;
    let label = |value| if decimals > 6 { number::short(value) } else { number::fixed(value, decimals) };
    let (first, last) = ((least / step - 1e-9).ceil() as i64, (largest / step + 1e-9).floor() as i64);
    let values = (first..=last).map(|i| i as f64 * step);
    values.map(|at| Tick { at, label: label(at) }).collect()
}

/// Returns powers of ten.
fn decades([least, largest]: [f64; 2], about: usize) -> Vec<Tick> {
    let (first, last) = ((least.log10() - 1e-9).ceil() as i32, (largest.log10() + 1e-9).floor() as i32);
    let every = usize::try_from(last - first).unwrap_or(0) / about.max(1) + 1;
    let powers = (first..=last).step_by(every).map(|power| 10f64.powi(power));
    powers.map(|at| Tick { at, label: number::short(at) }).collect()
}

/// Returns days, or the first days of months or years.
fn dates([first, last]: [f64; 2], about: usize) -> Vec<Tick> {
    let days = (last - first) / about.max(1) as f64;
    let all = (first.ceil() as i64..=last.floor() as i64).map(|day| {
        let at = day as f64;
        Tick { at, label: Calendar::Dates.show(at) }
    });
    if let Some(step) = [1, 2, 5, 10].into_iter().find(|step| f64::from(*step) >= days) {
        return all.step_by(step as usize).collect();
    }
    let months = [1, 3, 6].into_iter().find(|months| 30.5 * f64::from(*months) >= days);
    let years = (days / 365.25).ceil() as i64;
    let is_round = |tick: &Tick| {
        let mut parts = tick.label.rsplit('-').map(|part| part.parse::<i64>().unwrap_or_default());
        let [day, month, year] = [(); 3].map(|()| parts.next().unwrap_or_default());
        day == 1
            && match months {
                Some(months) => (month - 1) % i64::from(months) == 0,
                None => month == 1 && year % years == 0,
            }
    };
    all.filter(is_round).collect()
}

#[cfg(test)]
mod tests;
