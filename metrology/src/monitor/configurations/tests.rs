//! Tests of `configurations.rs`.

use std::collections::HashMap;

use super::{Configurations, MOST, SAME};

fn empty() -> Configurations {
    Configurations { list: Vec::new(), units: vec![1.0, 500.0], bins: HashMap::new() }
}

/// The bins give the same result as a comparison with every known configuration.
#[test]
fn configurations_are_distinguished() {
    let (mut found, mut existing): (_, Vec<[f64; 2]>) = (empty(), Vec::new());
    for i in 0..4000 {
        let q = [(f64::from(i) * 0.7).sin() * 0.02, (f64::from(i) * 1.3).cos() * 10.0 - 4.0];
        let same = |k: &[f64; 2]| (k[0] - q[0]).abs() <= SAME && (k[1] - q[1]).abs() <= 500.0 * SAME;
        let expected = existing.iter().position(same).unwrap_or(existing.len());
        if expected == existing.len() {
            existing.push(q);
        }
        assert_eq!(found.find_or_insert(&q).unwrap(), expected as u32);
    }
    assert!((100..2000).contains(&found.len()), "{}", found.len());
}

#[test]
fn the_number_of_configurations_is_limited() {
    let mut all = empty();
    assert!((0..MOST).all(|i| all.find_or_insert(&[0.01 * i as f64, 0.0]).is_ok()));
    assert!(all.find_or_insert(&[-1.0, 0.0]).is_err());
    assert_eq!(all.find_or_insert(&[0.01, 0.0]).unwrap(), 1);
}
