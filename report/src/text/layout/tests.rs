//! Tests of `layout.rs`.

use super::super::table::at_width;
use super::aligned;

#[test]
fn what_has_no_room_stands_below() {
    let row = |cells: [&str; 4]| cells.map(str::to_owned).to_vec();
    let long = "a sentence of forty letters and no more";
    let rows = [row(["one", "1.0", long, long]), row(["two", "12.0", "", "short"])];
    let text = at_width(100, || aligned(&rows, &[false, true, false, false]));
    assert!(text.lines().count() == 2 && text.lines().all(|line| line.len() <= 100), "{text}");
    let text = at_width(60, || aligned(&rows, &[false, true, false, false]));
    let expected = ["  one    1.0   ", long, "\n        ", long, "\n  two   12.0\n        short\n"].concat();
    assert_eq!(text, expected);
}

/// Cells of all lengths: no line is too long, and each cell stands once, in order.
#[test]
fn every_table_fits() {
    for seed in 0..500_usize {
        let cell = |i: usize, j: usize| "x".repeat((seed * 7 + i * 31 + j * j * 17) % 29 % (5 + seed % 25));
        let rows: Vec<Vec<String>> = (0..4).map(|i| (0..6).map(|j| cell(i, j)).collect()).collect();
        let text = at_width(60, || aligned(&rows, &[false, true, false, true, false, false]));
        assert!(text.lines().all(|line| line.chars().count() <= 60), "{text}");
        let cells = rows.iter().flatten().filter(|cell| !cell.is_empty());
        assert!(text.split_whitespace().eq(cells), "{text}");
    }
}
