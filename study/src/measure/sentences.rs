//! Repeatability and prediction in words.

use super::Report;
use crate::number::{fixed, percent};

impl Report {
    /// Repeatability and prediction in words.
    pub fn sentences(&self) -> Vec<String> {
        let unit = self.length;
        let show = |value: f64| format!("{} {unit}", fixed(value, self.decimals()));
        let mut all = Vec::new();
        let repeated = &self.repeated;
        match (&repeated.ap, &repeated.rp, repeated.three_sigma) {
            (Some(ap), Some(rp), Some([x, y, z])) => {
                let few = if repeated.fewest < 30 {
                    format!(" The standard asks for 30 visits; some have {}.", repeated.fewest)
                } else {
                    String::new()
                };
                all.push(format!(
                    "{} configurations were visited again, {} visits in all. Pose accuracy AP (from the commanded point to the \
                     barycentre of the visits, ISO 9283): {} on average, {} at most. Pose repeatability RP (mean distance from \
                     the barycentre and three standard deviations of that distance): {} on average, {} at most. Three standard \
                     deviations about the barycentres: x {}, y {}, z {}.{few}",
                    repeated.configurations,
                    repeated.visits,
                    show(ap.mean),
                    show(ap.max),
                    show(rp.mean),
                    show(rp.max),
                    show(x),
                    show(y),
                    show(z),
                ));
            }
            _ => all.push(
                "No configuration was visited twice: accuracy and repeatability of ISO 9283 need visits of the same one."
                    .to_owned(),
            ),
        }
        let explained = &self.explained;
        if explained.repeatable > 0 {
            all.push(format!(
                "The {} repeatable sources of the spec explain {} of the sum of squares; {} remain on average, {} at most.",
                explained.repeatable,
                percent(explained.share, 1.0),
                show(explained.left_mean),
                show(explained.left_max)
            ));
        } else {
            all.push(
                "The spec has no repeatable source that could explain them: `abbe identify` finds some."
                    .to_owned(),
            );
        }
        let verdict =
            if explained.inside >= 0.95 { "at least 95 %, as it should be" } else { "fewer than 95 %" };
        let allow = match explained.random {
            0 => "what the instrument allows".to_owned(),
            random => format!("what its {random} random sources and the instrument allow"),
        };
        let inside = percent(explained.inside, 1.0);
        all.push(format!("{inside} of the rows are within {allow} about that: {verdict}."));
        all.extend(self.accepted.iter().map(|accepted| accepted.sentence(self.unit)));
        all
    }

    /// How many decimals a length has.
    pub fn decimals(&self) -> usize {
        if self.length == "m" { 7 } else { 4 }
    }
}
