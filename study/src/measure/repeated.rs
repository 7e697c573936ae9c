//! Pose accuracy and repeatability, as ISO 9283 has them.
//!
//! Of n visits of a configuration at `x_j`, with barycentre `G`: `AP = |G − commanded|`; `RP = l̄ + 3 S_l` with
//! `l_j = |x_j − G|`, their mean `l̄` and standard deviation `S_l`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::errors::{RowError, norm};

/// Configurations that were visited more than once.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Repeated {
    /// How many there are.
    pub configurations: usize,
    /// How many visits they had.
    pub visits: usize,
    /// The fewest visits of a configuration that counts; the standard asks for 30.
    pub fewest: usize,
    /// Pose accuracy; none without repeated configurations.
    pub ap: Option<MeanAndMax>,
    /// Pose repeatability.
    pub rp: Option<MeanAndMax>,
    /// Three standard deviations about the barycentres, along x, y, z.
    pub three_sigma: Option<[f64; 3]>,
}

/// Over all configurations.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct MeanAndMax {
    /// The mean.
    pub mean: f64,
    /// The largest.
    pub max: f64,
}

/// Rows by configuration: joints and inputs the same, digit by digit.
fn visits(rows: &[RowError]) -> Vec<Vec<&RowError>> {
    let mut groups: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
    for (i, RowError { observation, .. }) in rows.iter().enumerate() {
        let values = observation.q.iter().chain(&observation.u);
        groups.entry(values.map(|value| (value + 0.0).to_bits()).collect()).or_default().push(i);
    }
    let mut groups: Vec<Vec<usize>> = groups.into_values().filter(|group| group.len() > 1).collect();
    groups.sort();
    groups.into_iter().map(|group| group.into_iter().map(|i| &rows[i]).collect()).collect()
}

/// The errors of every visit about the barycentre of its configuration.
pub(super) fn about_barycentres(rows: &[RowError]) -> Vec<[f64; 3]> {
    visits(rows).iter().flat_map(|group| about(group)).collect()
}

fn about(group: &[&RowError]) -> Vec<[f64; 3]> {
    let centre = mean(group, |row| row.point);
    group.iter().map(|row| std::array::from_fn(|k| row.point[k] - centre[k])).collect()
}

fn mean(group: &[&RowError], value: impl Fn(&RowError) -> [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| group.iter().map(|row| value(row)[k]).sum::<f64>() / group.len() as f64)
}

pub(super) fn repeated(rows: &[RowError]) -> Repeated {
    let groups = visits(rows);
    let (mut ap, mut rp) = (Vec::new(), Vec::new());
    for group in &groups {
        let n = group.len() as f64;
        ap.push(norm(mean(group, |row| [row.error[0], row.error[1], row.error[2]])));
        let lengths: Vec<f64> = about(group).into_iter().map(norm).collect();
        let mean = lengths.iter().sum::<f64>() / n;
        let deviation = (lengths.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        rp.push(mean + 3.0 * deviation);
    }
    let mean_and_max = |values: &[f64]| {
        let max = values.iter().copied().reduce(f64::max)?;
        Some(MeanAndMax { mean: values.iter().sum::<f64>() / values.len() as f64, max })
    };
    let visits: usize = groups.iter().map(Vec::len).sum();
    // One degree of freedom of each configuration goes into its barycentre.
    let freedom = visits.saturating_sub(groups.len()) as f64;
    let about = about_barycentres(rows);
    let three_sigma =
        std::array::from_fn(|k| 3.0 * (about.iter().map(|e| e[k] * e[k]).sum::<f64>() / freedom).sqrt());
    Repeated {
        configurations: groups.len(),
        visits,
        fewest: groups.iter().map(Vec::len).min().unwrap_or_default(),
        ap: mean_and_max(&ap),
        rp: mean_and_max(&rp),
        three_sigma: (freedom > 0.0).then_some(three_sigma),
    }
}
