//! Range of a figure without outliers, which would compress the rest to a line. The figure states
//! their number.

/// Distance from the middle 80 % of the values, in multiples of their width, beyond which a value
/// is an outlier.
const TIMES: f64 = 4.0;
/// Number of values below which all are shown.
const FEWEST: usize = 20;

/// Range of a figure, and number of values outside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FigureRange {
    pub(super) ends: [f64; 2],
    pub(super) beyond: usize,
}

impl FigureRange {
    /// Computes the range of finite values.
    pub(super) fn new(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let (Some(least), Some(most)) = (values.first().copied(), values.last().copied()) else {
            return Self { ends: [0.0, 0.0], beyond: 0 };
        };
        let [low, high] = [values[values.len() / 10], values[values.len() * 9 / 10]];
        let far = TIMES * (high - low);
        if values.len() < FEWEST || far == 0.0 {
            return Self { ends: [least, most], beyond: 0 };
        }
        let inside = |value: &&f64| (low - far..=high + far).contains(*value);
        let kept: Vec<f64> = values.iter().filter(inside).copied().collect();
        let ends = [kept.first().copied().unwrap_or(least), kept.last().copied().unwrap_or(most)];
        Self { ends, beyond: values.len() - kept.len() }
    }

    /// Appends the number of values outside the range to the name of an axis.
    pub(super) fn title(self, name: &str) -> String {
        match self.beyond {
            0 => name.to_owned(),
            beyond => format!("{name}; {beyond} beyond"),
        }
    }

    pub(super) fn contains(self, value: f64) -> bool {
        (self.ends[0]..=self.ends[1]).contains(&value)
    }
}

#[cfg(test)]
mod tests;
