//! Tests of `bins.rs`.

use super::{Bins, Merge};

impl Merge for usize {
    fn merge(&mut self, other: Self) {
        *self += other;
    }
}

fn counted(values: &[f64], most: usize) -> Vec<([f64; 2], usize)> {
    let mut bins = Bins::<usize>::new(-20, most);
    values.iter().for_each(|value| *bins.bin_mut(*value) += 1);
    bins.iter().map(|(key, count)| (bins.edges(key), *count)).collect()
}

#[test]
fn few_values_stay_apart() {
    let counts = counted(&[-0.5, 0.0, 1e-12, -1e-12, 1e3, 1e3 + 1e-3], 9);
    assert_eq!(counts.iter().map(|(_, count)| *count).collect::<Vec<_>>(), [1, 3, 1, 1]);
}

#[test]
fn many_values_share_bins_in_any_order() {
    let mut values = (-700..900).map(|i| f64::from(i) * 0.37).collect::<Vec<_>>();
    let forth = counted(&values, 64);
    values.reverse();
    assert_eq!(forth, counted(&values, 64));
    assert!((33..=64).contains(&forth.len()));
    assert_eq!(forth.iter().map(|(_, count)| count).sum::<usize>(), values.len());
    for ([lower, upper], count) in forth {
        let inside = values.iter().filter(|value| (lower..upper).contains(value)).count();
        assert_eq!(inside, count);
    }
}

#[test]
fn merging_equals_counting_together() {
    let values = (0..400).map(|i| f64::from(i * i)).collect::<Vec<_>>();
    let mut parts = [Bins::<usize>::new(-20, 32), Bins::new(-20, 32)];
    for (i, value) in values.iter().enumerate() {
        *parts[i % 2].bin_mut(*value) += 1;
    }
    let [mut bins, other] = parts;
    bins.merge(other);
    let merged = bins.iter().map(|(key, count)| (bins.edges(key), *count)).collect::<Vec<_>>();
    assert_eq!(merged, counted(&values, 32));
}

#[test]
fn enormous_values_are_binned_too() {
    assert_eq!(counted(&[1e300, -1e300, 0.0], 9).len(), 3);
}
