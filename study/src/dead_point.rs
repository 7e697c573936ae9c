//! Dead points: where the path from home ends, because `φ_p` becomes singular.

use std::f64::consts::TAU;

use abbe::{Error, Manipulator, VariableKind};
use abbe_spec::{Spec, Variable};
use serde::Serialize;

use crate::open_loops::path_end;

/// Configuration beyond which the loops do not close in the mode of home: passive joints lose their
/// drive there. One commanded joint has moved from home.
#[derive(Clone, Debug, Serialize)]
pub struct DeadPoint {
    /// Name of the joint that reaches it.
    pub joint: String,
    /// Value of the joint there, in the length unit or rad.
    pub value: f64,
    /// Distance of the joint from home, in the length unit or rad.
    pub distance: f64,
}

impl DeadPoint {
    /// Returns the dead point that is the fewest units of its joint from home, the joint moving
    /// alone; `None` if there is none within the limits. A joint without a limit moves by a full
    /// turn, or by two units.
    pub(crate) fn nearest(
        spec: &Spec,
        manipulator: &dyn Manipulator,
        [home, s]: [&[f64]; 2],
        units: &[f64],
    ) -> Option<Self> {
        let mut nearest: Option<(f64, Self)> = None;
        let mut passive = vec![0.0; spec.passive.len()];
        for (i, Variable { name, kind, limits, .. }) in spec.variables.iter().enumerate() {
            let unit = units[i];
            let farthest = if *kind == VariableKind::Revolute { TAU } else { 2.0 * unit };
            for (limit, sign) in limits.iter().zip([-1.0, 1.0]) {
                // Others farther away do not matter.
                let least = nearest.as_ref().map_or(f64::INFINITY, |(least, _)| least * unit);
                let range = farthest.min(sign * (limit - home[i])).min(least);
                let mut after = |share: f64| {
                    let mut q = home.to_vec();
                    q[i] += sign * share * range;
                    manipulator.passive(&q, s, &mut passive)
                };
                let Some(share) = path_end(|share| !matches!(after(share), Err(Error::NotClosed))) else {
                    continue;
                };
                // Limits of passive joints may come first.
                if after(share).is_ok() {
                    let distance = share * range;
                    let found = Self { joint: name.clone(), value: home[i] + sign * distance, distance };
                    nearest = Some((distance / unit, found));
                }
            }
        }
        Some(nearest?.1)
    }
}
