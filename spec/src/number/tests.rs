//! Tests of `number.rs`.

use super::{fixed, steady, visible};

#[test]
fn last_bits_do_not_round_a_half() {
    let (half, more) = (0.005665, 0.005665_f64.next_up().next_up());
    assert_ne!(fixed(half, 5), fixed(more, 5));
    assert_eq!(steady(more), half);
    assert_eq!([0.0, -2.5, f64::INFINITY].map(steady), [0.0, -2.5, f64::INFINITY]);
}

#[test]
fn what_is_not_zero_is_not_shown_as_zero() {
    let shown = [0.0, 3e-8, 5.6e-6, 0.0269].map(|value| visible(value, 4));
    assert_eq!(shown, ["0", "<1e-6", "5.6e-6", "0.0269"]);
}
