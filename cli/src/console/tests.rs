//! Tests of `console.rs`.

use super::*;

#[test]
fn the_rest_takes_as_long_as_what_is_done() {
    let after = |seconds: f64, done, total| left(Duration::from_secs_f64(seconds), done, total).as_secs();
    assert_eq!(after(1.2, 12, 72), 6);
    assert_eq!(after(100.0, 50, 100), 100);
    assert_eq!(after(1.0, 999, 1000), 1);
    assert_eq!(after(2.0, 0, 10), 20);
}
