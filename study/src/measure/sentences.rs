//! Repeatability and prediction in words.

use super::{InstrumentErrors, MeanAndMax, Report};
use crate::number::{fixed, percent};

impl Report {
    /// Repeatability and prediction in words.
    pub fn sentences(&self) -> Vec<String> {
        let mut all = vec![self.behind()];
        if self.instruments.is_empty() {
            all.extend(self.repeatability());
            all.extend(self.variation());
        }
        all.extend(self.order.iter().map(|order| order.sentence.clone()));
        all.extend(self.prediction());
        all.extend(self.accepted.iter().map(|accepted| accepted.sentence(self.unit)));
        all
    }

    fn behind(&self) -> String {
        let configurations = match self.configurations {
            1 => "one configuration: how far other ones differ is not known".to_owned(),
            count => format!(
                "{count} independent configurations; the standard error of the mean norm is {}",
                self.standard_error.map_or("not known".to_owned(), |error| self.show(error))
            ),
        };
        format!("Behind these figures stand {configurations}.")
    }

    fn show(&self, value: f64) -> String {
        format!("{} {}", fixed(value, self.decimals()), self.length)
    }

    fn mean_and_max(&self, value: &MeanAndMax) -> String {
        format!("{} on average, {} at most", self.show(value.mean), self.show(value.max))
    }

    fn repeatability(&self) -> Vec<String> {
        let repeated = &self.repeated;
        let (Some(ap), Some(rp), Some([x, y, z])) = (&repeated.ap, &repeated.rp, repeated.three_sigma) else {
            let none = "No configuration was visited twice: accuracy and repeatability of ISO 9283 need visits of the same one.";
            return vec![none.to_owned()];
        };
        let few = if repeated.fewest < 30 {
            format!(" The standard asks for 30 visits; some have {}.", repeated.fewest)
        } else {
            String::new()
        };
        let mut all = vec![format!(
            "{} configurations were visited again, {} visits in all. Pose accuracy AP (from the commanded point to the \
             barycentre of the visits, ISO 9283, 7.2.1): {}. Pose repeatability RP (mean distance from the barycentre and three \
             standard deviations of that distance, 7.2.2): {}. Three standard deviations about the barycentres: x {}, y {}, z {}.{few}",
            repeated.configurations,
            repeated.visits,
            self.mean_and_max(ap),
            self.mean_and_max(rp),
            self.show(x),
            self.show(y),
            self.show(z),
        )];
        if let (Some(ap), Some(rp)) = (&repeated.ap_turns, &repeated.rp_turns) {
            all.push(format!(
                "Of the turns about x, y, z (7.2.1, 7.2.2), at most: AP {}; RP (three standard deviations) {}.",
                turns(ap),
                turns(rp)
            ));
        }
        all
    }

    /// By direction, of distances, and in time.
    fn variation(&self) -> Vec<String> {
        let turned = |turns_of: &Option<[MeanAndMax; 3]>| {
            turns_of
                .as_ref()
                .map_or(String::new(), |values| format!("; of the turns {} at most", turns(values)))
        };
        let mut all = Vec::new();
        if let Some(directions) = &self.repeated.directions {
            let few = if directions.fewest < 3 || directions.fewest_visits < 30 {
                format!(
                    " The standard asks for three directions with 30 visits each; some have {} and {}.",
                    directions.fewest, directions.fewest_visits
                )
            } else {
                String::new()
            };
            all.push(format!(
                "Multi-directional pose accuracy variation vAP (largest distance between the barycentres of two directions, 7.2.3), \
                 {} configurations: {}{}.{few}",
                directions.configurations,
                self.mean_and_max(&directions.vap),
                turned(&directions.vap_turns)
            ));
        }
        if let Some(distances) = &self.repeated.distances {
            all.push(format!(
                "Between two configurations, {} pairs: distance accuracy AD (mean less commanded distance, 7.3.2): {}{}. Distance \
                 repeatability RD (three standard deviations, 7.3.3): {}{}.",
                distances.pairs,
                self.mean_and_max(&distances.ad),
                turned(&distances.ad_turns),
                self.mean_and_max(&distances.rd),
                turned(&distances.rd_turns)
            ));
        }
        if let Some(drift) = &self.repeated.drift {
            all.push(format!(
                "Drift of pose characteristics (7.6: AP and RP of ten visits after ten, against the first ten), {} configurations, \
                 up to {} times: dAP {}{}; dRP {}{}.",
                drift.configurations,
                drift.most,
                self.mean_and_max(&drift.dap),
                turned(&drift.dap_turns),
                self.mean_and_max(&drift.drp),
                turned(&drift.drp_turns)
            ));
        }
        all
    }

    fn prediction(&self) -> Vec<String> {
        let explained = &self.explained;
        let left = match explained.repeatable {
            0 => "The spec has no repeatable source that could explain them: `abbe identify` finds some."
                .to_owned(),
            repeatable => {
                let lengths = match self.instruments.iter().all(InstrumentErrors::is_angle) {
                    true if !self.instruments.is_empty() => String::new(),
                    _ => format!(
                        "; {} remain on average, {} at most",
                        self.show(explained.left_mean),
                        self.show(explained.left_max)
                    ),
                };
                let of = if self.instruments.is_empty() { "" } else { " in units of the uncertainty" };
                let share = percent(explained.share, 1.0);
                format!(
                    "The {repeatable} repeatable sources of the spec explain {share} of the sum of squares{of}{lengths}."
                )
            }
        };
        let (Some(seen), Some([low, high])) = (explained.inside, explained.likely) else { return vec![left] };
        let chance = match explained.random {
            0 => "the noise of the instrument fills".to_owned(),
            random => format!(
                "its {random} random sources, drawn anew in every row, and the noise of the instrument fill"
            ),
        };
        let verdict = match seen {
            inside if inside < low => {
                "so there are errors that the spec does not have, or the instrument is worse than stated"
            }
            inside if inside > high => "so the random sources or the noise are smaller than stated",
            _ => "as it should be",
        };
        let [low, high] = [low, high].map(|share| percent(share.min(1.0), 1.0));
        let inside = format!(
            "About that, {chance} a region that holds 95 % of the rows of a machine as the spec says; {} of these rows are within \
             it: {verdict} (of so many rows {low} to {high}, in 99 of 100 such machines).",
            percent(seen, 1.0)
        );
        vec![left, inside]
    }

    /// How many decimals a length has.
    pub fn decimals(&self) -> usize {
        if self.length == "m" { 7 } else { 4 }
    }
}

/// The largest of three turns.
fn turns(values: &[MeanAndMax; 3]) -> String {
    let [a, b, c] = values.map(|value| fixed(value.max * 1e3, 4));
    format!("{a}, {b}, {c} mrad")
}
