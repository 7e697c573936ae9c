//! Configurations beside their borders.

use super::{Fact, ROUNDING};

/// A fact that held for the commanded joints holds exactly for the corrected ones, and whole turns
/// are counted as before.
#[test]
fn a_restated_fact_holds() {
    let near = [-0.5, -0.03, -5e-4, -1e-4, 0.0, 1e-4, 5e-4, 0.03, 0.5];
    for border in [-270.0, -180.0, -90.0, 0.0, 90.0, 180.0, 360.0] {
        for (from, to) in near.iter().flat_map(|from| near.iter().map(move |to| (border + from, border + to)))
        {
            for quarters in -6..=6 {
                let fact = Fact::Quadrant(3, quarters);
                let Fact::Quadrant(_, new) = fact.beyond(|_| Some(from), |_| Some(to)) else { panic!() };
                if fact.holds(from, super::BORDER) {
                    assert!(Fact::Quadrant(3, new).holds(to, ROUNDING), "{quarters} {from} {to}: {new}");
                    assert!((new - quarters).abs() <= 1, "{quarters} {from} {to}: {new}");
                } else {
                    assert_eq!(new, quarters);
                }
            }
            for is in [false, true] {
                let fact = Fact::Negative(3, is);
                let new = fact.beyond(|_| Some(from), |_| Some(to));
                assert!(!fact.holds(from, super::BORDER) || new.holds(to, ROUNDING), "{is} {from} {to}");
            }
        }
    }
}
