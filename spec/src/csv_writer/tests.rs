//! Tests of `csv_writer.rs`.

use super::*;

#[test]
fn every_text_comes_back_and_none_is_run() {
    let letters = ["'", "=", "+", "-", "@", "|", "＝", "＠", "\t", "\r", " ", "1", ".", "e", ",", "\""];
    let mut texts = vec![String::new()];
    for _ in 0..4 {
        let longer = texts.iter().flat_map(|text| letters.map(|letter| text.clone() + letter));
        texts = longer.chain([String::new()]).collect();
    }
    for text in texts {
        let cell = harmless(&text);
        assert_eq!(meant(&cell), text);
        let runs = cell.trim_start_matches(' ').starts_with(STARTS);
        assert!(!runs || text.parse::<f64>().is_ok(), "{text:?}");
    }
}
