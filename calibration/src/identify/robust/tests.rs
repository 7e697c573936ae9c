//! Tests of `robust.rs`.

use super::Loss;

#[test]
fn weights_are_slopes_of_costs() {
    for loss in [Loss::Squares, Loss::Huber, Loss::Tukey] {
        for (norm, d) in [(0.3, 1), (1.9, 1), (4.0, 1), (6.0, 1), (3.0, 9), (12.0, 9), (20.0, 9)] {
            let slope = (loss.cost(norm + 1e-5, d) - loss.cost(norm - 1e-5, d)) / 2e-5;
            assert!((slope - 2.0 * norm * loss.weight(norm, d)).abs() < 1e-6, "{loss:?} {norm} {d}");
        }
    }
}
