//! Visits grouped by configuration.

use std::collections::BTreeMap;

use super::Visit;

/// Visits of one configuration, in order of time.
pub(super) type Visits<'r> = Vec<&'r Visit>;

impl Visit {
    pub(super) fn position(&self) -> [f64; 3] {
        [self.error[0], self.error[1], self.error[2]]
    }

    pub(super) fn turn(&self) -> [f64; 3] {
        [self.error[3], self.error[4], self.error[5]]
    }
}

/// Returns configurations with more than one visit, in order of first occurrence.
pub(super) fn visits(rows: &[Visit]) -> Vec<Visits<'_>> {
    let mut order: Vec<&Visit> = rows.iter().collect();
    // A stable sort keeps the order of rows without a time.
    let time = |row: &Visit| row.time;
    order.sort_by(|a, b| time(a).total_cmp(&time(b)));
    let mut groups: BTreeMap<u32, Visits<'_>> = BTreeMap::new();
    for row in order {
        groups.entry(row.configuration).or_default().push(row);
    }
    groups.into_values().filter(|group| group.len() > 1).collect()
}

pub(super) fn mean(visits: &[&Visit], value: impl Fn(&Visit) -> [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| visits.iter().map(|row| value(row)[k]).sum::<f64>() / visits.len() as f64)
}

/// Returns `√(Σ (v − v̄)² / (n − 1))`.
pub(super) fn deviation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt()
}
