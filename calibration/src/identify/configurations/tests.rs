//! Tests of `configurations.rs`.

use super::Configurations;

/// Each of n configurations is drawn once on average, with a binomial variance of 1 − 1/n.
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
