//! Multiples of 45° that a file has with too few digits.

use abbe_spec::option::ROUND_ANGLES;
use std::f64::consts::FRAC_PI_4;

use abbe_spec::notes::Notes;

/// Largest distance from a multiple of 45°, in rad, that counts as rounding in the file.
const TOLERANCE: f64 = 1e-5;

/// Counts the angles of a file that are multiples of 45° but for rounding, and restores them on
/// request.
#[derive(Debug)]
pub struct AngleRounding {
    /// Replaces such an angle by the multiple.
    round: bool,
    count: usize,
    /// Largest distance from a multiple, in rad.
    farthest: f64,
}

impl AngleRounding {
    /// Starts to count; with `round` set, `angle` restores the multiples.
    pub fn new(round: bool) -> Self {
        Self { round, count: 0, farthest: 0.0 }
    }

    /// Counts an angle in rad and returns it, rounded to the multiple if that is requested.
    pub(crate) fn angle(&mut self, angle: f64) -> f64 {
        let multiple = (angle / FRAC_PI_4).round() * FRAC_PI_4;
        let off = (multiple - angle).abs();
        if off == 0.0 || off > TOLERANCE {
            return angle;
        }
        self.count += 1;
        self.farthest = self.farthest.max(off);
        if self.round { multiple } else { angle }
    }

    /// Notes the number of such angles, and the largest change.
    pub fn note(&self, notes: &mut dyn Notes) {
        let Self { round, count, farthest } = self;
        if *count == 0 {
            return;
        }
        let one = *count == 1;
        notes.note(&match round {
            true => {
                let angles =
                    if one { "angle was rounded to a multiple" } else { "angles were rounded to multiples" };
                format!("{count} {angles} of 45°, by {farthest:.0e} rad at most")
            }
            false => {
                let angles = if one { "angle is a multiple" } else { "angles are multiples" };
                let them = if one { "it" } else { "them" };
                format!(
                    "{count} {angles} of 45° within {farthest:.0e} rad; `{ROUND_ANGLES}` rounds \
                     {them}, which makes generated code shorter"
                )
            }
        });
    }
}
