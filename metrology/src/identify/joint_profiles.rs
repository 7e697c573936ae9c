//! Profiles of joints as results: for the report, and by name for the spec.

use serde::Serialize;

use super::{gain::Gain, profile_table::ProfileTable};
use crate::sizes::Sizes;
use abbe_study::number::digits;

/// Profiles of joints, and the accuracy with and without them.
#[derive(Clone, Debug, Serialize)]
pub struct JointProfiles {
    /// Position errors of the cross-validation without profiles.
    pub before: Sizes,
    /// Position errors of the cross-validation with them.
    pub after: Sizes,
    /// Improvement by the profiles at the same held-out rows.
    pub gain: Gain,
    /// Number of coefficients that the data determine, of all profiles together, without a unit.
    pub effective: f64,
    /// Standard deviation of the tool point by the profiles alone, root mean square over the fitted
    /// rows, in the length unit.
    pub standard_deviation: f64,
    /// Profile of each joint that has one.
    pub joints: Vec<JointProfile>,
}

/// Profile of a joint.
#[derive(Clone, Debug, Serialize)]
pub struct JointProfile {
    /// Name of the joint.
    pub joint: String,
    /// Unit of the error: rad, or the length unit.
    pub unit: &'static str,
    /// Range of the joint that the profile covers, in `unit`; beyond it the value at the end holds.
    pub range: [f64; 2],
    /// Error by the profile, root mean square over the fitted rows, in `unit`.
    pub rms: f64,
    /// Standard deviation of that error, root mean square over the fitted rows, in `unit`.
    pub standard_deviation: f64,
    /// Factor of the root mean square of the cross-validation without this profile.
    pub without: f64,
    /// Index among the variables.
    #[serde(skip)]
    pub variable: usize,
    #[serde(skip)]
    pub(super) table: ProfileTable,
}

impl JointProfile {
    /// Returns the name of its source in a spec.
    pub(super) fn source_name(&self) -> String {
        format!("identified: profile of {}", self.joint)
    }

    /// Returns a description for the spec.
    pub(super) fn description(&self) -> String {
        let (factor, unit) = if self.unit == "rad" { (1e3, "mrad") } else { (1.0, self.unit) };
        let [rms, deviation] = [self.rms, self.standard_deviation].map(|value| digits(factor * value, 2));
        format!(
            "Error of {} as a function of it: rms {rms}, standard deviation {deviation} {unit}",
            self.joint
        )
    }
}
