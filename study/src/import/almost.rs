//! Angles that were right ones before a file rounded them.

use std::f64::consts::FRAC_PI_4;

use crate::notes::Notes;

/// An angle this close to a multiple of 45°, in rad, is one that was rounded when the file was written.
const ALMOST: f64 = 1e-5;

/// Angles that are almost multiples of 45°.
#[derive(Debug)]
pub(super) struct Almost {
    /// Whether they become such.
    round: bool,
    count: usize,
    /// How far the farthest is from one, in rad.
    farthest: f64,
}

impl Almost {
    pub(super) fn new(round: bool) -> Self {
        Self { round, count: 0, farthest: 0.0 }
    }

    /// An angle, as the multiple that it almost is if that is asked for.
    pub(super) fn angle(&mut self, angle: f64) -> f64 {
        let multiple = (angle / FRAC_PI_4).round() * FRAC_PI_4;
        let off = (multiple - angle).abs();
        if off == 0.0 || off > ALMOST {
            return angle;
        }
        self.count += 1;
        self.farthest = self.farthest.max(off);
        if self.round { multiple } else { angle }
    }

    /// Says how many there were.
    pub(super) fn note(&self, notes: &mut dyn Notes) {
        let Self { round, count, farthest } = self;
        if *count == 0 {
            return;
        }
        let one = *count == 1;
        notes.note(&match round {
            true => {
                let angles = if one { "angle was rounded to a multiple" } else { "angles were rounded to multiples" };
                format!("{count} {angles} of 45°, by {farthest:.0e} rad at most")
            }
            false => {
                let angles = if one { "angle is a multiple" } else { "angles are multiples" };
                let them = if one { "it" } else { "them" };
                format!(
                    "{count} {angles} of 45° but for {farthest:.0e} rad at most; `--round-angles` writes {them} as such, which makes \
                     generated code shorter"
                )
            }
        });
    }
}
