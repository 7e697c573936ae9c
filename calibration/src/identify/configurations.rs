//! Rows by the configuration that they are visits of: what is independent of each other.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use rand::RngExt;

use super::Observation;
use abbe_analysis::sampling::stream;

/// Rows, those of one configuration after those of the other.
pub(super) struct Groups {
    order: Vec<usize>,
    ends: Vec<usize>,
}

impl Groups {
    /// The same, of rows that are `used`, given by their place among these.
    pub(super) fn of(mut self, used: &[usize]) -> Self {
        self.order.iter_mut().for_each(|row| *row = used[*row]);
        self
    }

    /// The rows of every configuration.
    pub(super) fn slices(&self) -> Vec<&[usize]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.order[*start..*end]).collect()
    }
}

/// Which rows belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configurations {
    /// How many there are.
    pub count: usize,
    /// By row: its configuration, from 0 in the order in which they come first.
    pub number: Vec<u32>,
}

/// Numbers what comes again, from 0 in the order in which it comes first: what may be a million takes four bytes each.
pub(super) struct Numbering {
    dense: Vec<u32>,
    sparse: HashMap<u32, u32>,
    count: u32,
}

impl Numbering {
    /// No number given yet.
    const NONE: u32 = u32::MAX;

    /// Of these keys, and no others.
    pub(super) fn of(keys: impl Iterator<Item = u32>) -> Self {
        let (count, largest) = keys.fold((0, 0), |(count, largest), key| (count + 1, key.max(largest)));
        let dense = if largest as usize > 1024 + 4 * count { 0 } else { largest as usize + 1 };
        Self { dense: vec![Self::NONE; dense], sparse: HashMap::new(), count: 0 }
    }

    pub(super) fn number(&mut self, key: u32) -> u32 {
        let known = match self.dense.get_mut(key as usize) {
            Some(known) => known,
            None => self.sparse.entry(key).or_insert(Self::NONE),
        };
        if *known == Self::NONE {
            (*known, self.count) = (self.count, self.count + 1);
        }
        *known
    }

    /// How many are different.
    pub(super) fn count(&self) -> usize {
        self.count as usize
    }
}

impl Configurations {
    /// Those of these rows.
    pub fn new<'o>(rows: impl IntoIterator<Item = &'o Observation>) -> Self {
        Self::from_numbers(rows.into_iter().map(|row| row.configuration).collect())
    }

    /// The rows of as many configurations, drawn with replacement: one repetition of the bootstrap where rows depend on each other
    /// (Davison and Hinkley, 1997, section 3.8). All rows of a configuration come as often as it is drawn, in their order.
    /// Repetition `number` follows from the seed and its number alone.
    pub fn resampled(&self, seed: u64, number: usize) -> Vec<usize> {
        let (mut random, mut times) = (stream(seed, number), vec![0; self.count]);
        for _ in 0..self.count {
            times[random.random_range(0..self.count)] += 1;
        }
        let rows = self.number.iter().enumerate();
        rows.flat_map(|(row, configuration)| core::iter::repeat_n(row, times[*configuration as usize]))
            .collect()
    }

    /// By configuration, how many numbers were measured of it: every one once at every station, however often it was visited.
    /// `rows` are those that they were made of.
    pub(super) fn numbers<'o>(&self, rows: impl Iterator<Item = &'o Observation>) -> Vec<u32> {
        let visits = self.visits();
        let (mut numbers, mut again) = (vec![0; self.count], BTreeMap::new());
        for (row, number) in rows.zip(&self.number) {
            let number = *number as usize;
            if visits[number] == 1 {
                numbers[number] = row.count() as u32;
            } else {
                let places: &mut BTreeSet<_> = again.entry(number).or_default();
                places.extend(row.places().into_iter().map(|place| (row.station, place)));
            }
        }
        again.into_iter().for_each(|(number, places)| numbers[number] = places.len() as u32);
        numbers
    }

    /// How many numbers of rows are independent of each other, and at how many configurations.
    pub(super) fn independent(rows: &[Observation]) -> (usize, usize) {
        let configurations = Self::new(rows);
        let numbers = configurations.numbers(rows.iter());
        (numbers.iter().map(|count| *count as usize).sum(), configurations.count)
    }

    /// By configuration, how many rows there are of it.
    pub(super) fn visits(&self) -> Vec<u32> {
        let mut visits = vec![0; self.count];
        self.number.iter().for_each(|number| visits[*number as usize] += 1);
        visits
    }

    /// Rows by their configuration.
    pub(super) fn rows(&self) -> Groups {
        let mut order: Vec<usize> = (0..self.number.len()).collect();
        order.sort_by_key(|row| self.number[*row]);
        let mut ends = vec![0; self.count];
        order.iter().enumerate().for_each(|(place, row)| ends[self.number[*row] as usize] = place + 1);
        Groups { order, ends }
    }

    /// Rows with the same number belong together.
    fn from_numbers(mut number: Vec<u32>) -> Self {
        let mut numbering = Numbering::of(number.iter().copied());
        number.iter_mut().for_each(|number| *number = numbering.number(*number));
        Self { count: numbering.count(), number }
    }

    /// Rows with the same key belong together.
    pub fn from_keys<K: std::hash::Hash + Eq>(keys: impl IntoIterator<Item = K>) -> Self {
        let mut numbers = HashMap::new();
        let number = keys
            .into_iter()
            .map(|key| {
                let next = numbers.len() as u32;
                *numbers.entry(key).or_insert(next)
            })
            .collect();
        Self { count: numbers.len(), number }
    }
}

#[cfg(test)]
mod tests {
    use super::Configurations;

    /// Of n configurations each is drawn once on average, and with a variance of 1 − 1/n: binomially.
    #[test]
    fn configurations_are_drawn_whole() {
        let count = 50;
        let rows = Configurations::from_keys((0..200).map(|row| row % count));
        let (mut sum, mut squares) = (0, 0);
        let repetitions = 400;
        for number in 0..repetitions {
            let drawn = rows.resampled(1, number);
            assert!(drawn.is_sorted());
            let times = |row: usize| drawn.iter().filter(|drawn| **drawn == row).count();
            for configuration in 0..count {
                let here = times(configuration);
                assert!((1..4).all(|visit| times(configuration + visit * count) == here));
                (sum, squares) = (sum + here, squares + here * here);
            }
        }
        let all = count * repetitions;
        assert_eq!(sum, all);
        let variance = squares as f64 / all as f64 - 1.0;
        assert!((variance - (1.0 - 1.0 / count as f64)).abs() < 0.05, "{variance}");
        assert_eq!(rows.resampled(1, 3), rows.resampled(1, 3));
        assert_ne!(rows.resampled(1, 3), rows.resampled(2, 3));
        assert!(Configurations::from_keys([0; 0]).resampled(1, 0).is_empty());
    }

    #[test]
    fn numbers_are_keys() {
        for numbers in [vec![], vec![3, 0, 3, 2, 9, 0], vec![5, u32::MAX, 5, 7]] {
            let found = Configurations::from_numbers(numbers.clone());
            assert_eq!(found, Configurations::from_keys(numbers));
        }
    }
}
