//! How far a picture reaches: to all values but a few gross ones, which would make the rest a line. How many those are is said.

/// What lies beyond the middle 80 % by more than four times their width is gross.
const TIMES: f64 = 4.0;
/// Fewer values are all drawn.
const FEWEST: usize = 20;

/// Where a picture begins and ends, and how many values it leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Reach {
    pub(super) ends: [f64; 2],
    pub(super) beyond: usize,
}

impl Reach {
    /// Of values that are all finite.
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

    /// What is said of what is left out, behind the name of an axis.
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
mod tests {
    use super::Reach;

    #[test]
    fn gross_values_are_left_out_and_counted() {
        let mut values: Vec<f64> = (0..100).map(f64::from).collect();
        assert_eq!(Reach::new(values.clone()), Reach { ends: [0.0, 99.0], beyond: 0 });
        values.extend([-700.0, 1000.0, 2000.0]);
        let reach = Reach::new(values);
        assert_eq!(reach, Reach { ends: [0.0, 99.0], beyond: 3 });
        assert_eq!(reach.title("x"), "x; 3 beyond");
    }
}
