//! Characteristics against examples computed by hand.

use super::{MeanAndMax, Visit, repeated};

/// Returns a visit of a configuration commanded to `at`.
fn visit(configuration: u32, at: [f64; 3], error: [f64; 6]) -> Visit {
    let point = std::array::from_fn(|k| at[k] + error[k]);
    Visit { configuration, direction: 0, time: 0.0, error, point }
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found}, not {expected}");
}

/// Errors x = 1, 3; y = 2, 2; turns about x 0.1 and 0.3: the barycentre is (2, 2, 0), both are 1
/// from it.
#[test]
fn accuracy_and_repeatability() {
    let rows = [
        visit(0, [0.0; 3], [1.0, 2.0, 0.0, 0.1, -0.2, 0.0]),
        visit(0, [0.0; 3], [3.0, 2.0, 0.0, 0.3, -0.2, 0.0]),
        visit(1, [9.0; 3], [5.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ];
    let found = repeated(&rows, true);
    assert_eq!((found.configurations, found.visits, found.fewest), (1, 2, 2));
    near(found.ap.unwrap().max, 8.0_f64.sqrt());
    near(found.rp.unwrap().max, 1.0);
    let [a, b, c] = found.ap_turns.unwrap();
    for (found, expected) in [(a, 0.2), (b, 0.2), (c, 0.0)] {
        near(found.max, expected);
    }
    // S_a = √(2 · 0.1²/1) = 0.1 √2.
    let [a, b, _] = found.rp_turns.unwrap();
    near(a.max, 0.3 * 2.0_f64.sqrt());
    near(b.max, 0.0);
    near(found.three_sigma.unwrap()[0], 3.0 * 2.0_f64.sqrt());
    assert!(found.directions.is_none() && found.distances.is_none() && found.drift.is_none());
    assert!(repeated(&rows, false).ap_turns.is_none());
}

/// Distances from the barycentre 0, 1, 2 …: RP = l̄ + 3 S_l of 2, 1, 0, 1, 2 is 1.2 + 3 √0.7.
#[test]
fn repeatability_counts_the_spread_of_distances() {
    let rows = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|x| visit(0, [0.0; 3], [x, 0.0, 0.0, 0.0, 0.0, 0.0]));
    near(repeated(&rows, false).rp.unwrap().mean, 1.2 + 3.0 * 0.7_f64.sqrt());
}

/// Barycentres (0, 0, 0), (3, 4, 0) and (0, 1, 0) from three directions: 5 apart at most.
#[test]
fn variation_by_direction() {
    let from = |direction: u32, x: f64, y: f64, a: f64| {
        let mut row = visit(7, [0.0; 3], [x, y, 0.0, a, 0.0, 0.0]);
        row.direction = direction;
        row
    };
    let rows = [
        from(0, -1.0, 0.0, 0.0),
        from(0, 1.0, 0.0, 0.2),
        from(1, 3.0, 4.0, 0.4),
        from(1, 3.0, 4.0, 0.4),
        from(2, 0.0, 1.0, -0.1),
    ];
    let found = repeated(&rows, true).directions.unwrap();
    assert_eq!((found.configurations, found.fewest, found.fewest_visits), (1, 3, 1));
    near(found.vap.max, 5.0);
    near(found.vap_turns.unwrap()[0].max, 0.5);
}

/// Commanded 10 apart; real distances 10.2, 10.4, 10.6: AD = 0.4, RD = 3 · 0.2.
#[test]
fn distances_between_two_configurations() {
    let pair =
        |x: f64| [visit(0, [0.0; 3], [0.0; 6]), visit(1, [10.0, 0.0, 0.0], [x, 0.0, 0.0, 0.01, 0.0, 0.0])];
    let rows = [0.2, 0.4, 0.6].map(pair).concat();
    let found = repeated(&rows, true).distances.unwrap();
    assert_eq!(found.pairs, 1);
    near(found.ad.max, 0.4);
    near(found.rd.max, 0.6);
    near(found.ad_turns.unwrap()[0].max, 0.01);
    near(found.rd_turns.unwrap()[0].max, 0.0);
}

/// Ten visits at 1 ± 0.5, ten at 4 ± 0.5, in the order of time: dAP = 3, dRP = 0. RP = 0.5 both
/// times.
#[test]
fn drift_in_the_order_of_time() {
    let at = |i: usize| {
        let (block, side) = (i / 10, if i.is_multiple_of(2) { 0.5 } else { -0.5 });
        let mut row = visit(0, [0.0; 3], [1.0 + 3.0 * block as f64 + side, 0.0, 0.0, 0.0, 0.0, 0.0]);
        row.time = i as f64;
        row
    };
    // The file has another order.
    let rows: Vec<Visit> = (0..20).rev().map(at).collect();
    let found = repeated(&rows, false).drift.unwrap();
    assert_eq!((found.configurations, found.most, found.dap_turns), (1, 2, None));
    near(found.dap.max, 3.0);
    near(found.drp.max, 0.0);
    assert_eq!(found.dap, MeanAndMax { mean: found.dap.max, max: found.dap.max });
}
