//! Pose accuracy and repeatability, as ISO 9283 has them.
//!
//! Of n visits of a configuration at `x_j`, with barycentre `G`: `AP = |G − commanded|`; `RP = l̄ + 3 S_l` with
//! `l_j = |x_j − G|`, their mean `l̄` and standard deviation `S_l`.

use serde::Serialize;

use super::errors::{Errors, norm};
use crate::data::Data;

/// Configurations that were visited more than once.
#[derive(Serialize)]
pub(super) struct Repeated {
    pub(super) configurations: usize,
    pub(super) visits: usize,
    /// The fewest visits of a configuration that counts; the standard asks for 30.
    pub(super) fewest: usize,
    /// Largest and mean pose accuracy; none without repeated configurations.
    pub(super) ap: Option<Both>,
    pub(super) rp: Option<Both>,
    /// Three standard deviations about the barycentres, along x, y, z.
    pub(super) three_sigma: Option<[f64; 3]>,
}

#[derive(Serialize)]
pub(super) struct Both {
    pub(super) mean: f64,
    pub(super) max: f64,
}

/// Rows by configuration: joints and inputs the same, digit by digit.
fn visits(data: &Data) -> Vec<Vec<usize>> {
    let mut groups: std::collections::BTreeMap<Vec<u64>, Vec<usize>> = Default::default();
    for (i, row) in data.observations.iter().enumerate() {
        let key = row.q.iter().chain(&row.u).map(|value| (value + 0.0).to_bits()).collect();
        groups.entry(key).or_default().push(i);
    }
    let mut groups: Vec<Vec<usize>> = groups.into_values().filter(|rows| rows.len() > 1).collect();
    groups.sort();
    groups
}

/// The errors of every visit about the barycentre of its configuration.
pub(super) fn about_barycentres(data: &Data, errors: &Errors) -> Vec<[f64; 3]> {
    let about = |rows: Vec<usize>| {
        let centre = barycentre(&rows, errors);
        rows.into_iter().map(|i| std::array::from_fn(|k| errors.points[i][k] - centre[k])).collect::<Vec<_>>()
    };
    visits(data).into_iter().flat_map(about).collect()
}

fn barycentre(rows: &[usize], errors: &Errors) -> [f64; 3] {
    std::array::from_fn(|k| rows.iter().map(|i| errors.points[*i][k]).sum::<f64>() / rows.len() as f64)
}

pub(super) fn of(data: &Data, errors: &Errors) -> Repeated {
    let groups = visits(data);
    let (mut ap, mut rp) = (Vec::new(), Vec::new());
    for rows in &groups {
        let n = rows.len() as f64;
        let error = std::array::from_fn(|k| rows.iter().map(|i| errors.rows[*i][k]).sum::<f64>() / n);
        ap.push(norm(error));
        let centre = barycentre(rows, errors);
        let lengths: Vec<f64> =
            rows.iter().map(|i| norm(std::array::from_fn(|k| errors.points[*i][k] - centre[k]))).collect();
        let mean = lengths.iter().sum::<f64>() / n;
        let deviation = (lengths.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        rp.push(mean + 3.0 * deviation);
    }
    let both = |values: &[f64]| {
        let max = values.iter().copied().reduce(f64::max)?;
        Some(Both { mean: values.iter().sum::<f64>() / values.len() as f64, max })
    };
    let visits: usize = groups.iter().map(Vec::len).sum();
    // One degree of freedom of each configuration goes into its barycentre.
    let freedom = visits.saturating_sub(groups.len()) as f64;
    let about = about_barycentres(data, errors);
    let three_sigma =
        std::array::from_fn(|k| 3.0 * (about.iter().map(|e| e[k] * e[k]).sum::<f64>() / freedom).sqrt());
    Repeated {
        configurations: groups.len(),
        visits,
        fewest: groups.iter().map(Vec::len).min().unwrap_or_default(),
        ap: both(&ap),
        rp: both(&rp),
        three_sigma: (freedom > 0.0).then_some(three_sigma),
    }
}
