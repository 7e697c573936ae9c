//! Tests of `aligned_sums.rs`.

use super::AlignedSums;

fn over(range: core::ops::Range<usize>) -> AlignedSums {
    let mut sums = AlignedSums::default();
    for chunk in range {
        sums.append(AlignedSums::from_chunk(chunk, vec![1.0 / (chunk + 1) as f64, chunk as f64]));
    }
    sums
}

#[test]
fn any_division_gives_the_same_to_the_last_bit() {
    let count = 1000;
    let all = over(0..count);
    let [harmonic, whole] = all.clone().total()[..] else { panic!("two sums") };
    assert_eq!(whole, 499_500.0);
    assert!((harmonic - 7.485_470_860_550_345).abs() < 1e-14);
    for parts in [2, 3, 7, 64, 1000] {
        let mut divided = AlignedSums::default();
        for i in 0..parts {
            divided.append(over(i * count / parts..(i + 1) * count / parts));
        }
        assert_eq!(divided, all, "{parts}");
    }
    // The order of merging does not matter as long as the parts are consecutive.
    let mut last = over(300..600);
    last.append(over(600..count));
    let mut first = over(0..300);
    first.append(last);
    assert_eq!(first, all);
    assert!(AlignedSums::default().total().is_empty());
}
