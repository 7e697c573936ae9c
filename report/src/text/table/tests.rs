//! Tests of `table.rs`.

use super::*;

#[test]
fn text_takes_the_width_within_limits() {
    let longest = |text: &str| text.lines().map(|line| line.chars().count()).max();
    let cells = ["a word ".repeat(60), "12.5".to_owned()];
    for (columns, width) in [(20, 60), (80, 80), (100, 100), (500, 160)] {
        let text = at_width(columns, || wrapped(&"ab ".repeat(200), 4));
        assert!(longest(&text).is_some_and(|longest| longest <= width && longest > width - 4), "{text}");
        let table = at_width(columns, || {
            let mut table = Table::new(&["name", "value"]);
            table.row(cells.clone());
            table.right(&[1]).to_string()
        });
        assert!(longest(&table).is_some_and(|longest| longest <= width && longest > width - 10), "{table}");
    }
    assert_eq!(COLUMNS.get(), WIDTH);
}

#[test]
fn words_of_headings_are_whole() {
    let header = ["error", "indistinguishable from", "value", "distribution of it", "degrees of freedom", ""];
    let text = at_width(80, || {
        let mut table = Table::new(&header);
        let long = "several words that need much room".to_owned();
        table.row(["a name".to_owned(), long.clone(), "1.0".to_owned(), long.clone(), "2".to_owned(), long]);
        table.right(&[2, 4]).to_string()
    });
    let head: Vec<&str> = text.split('─').next().unwrap().split_whitespace().collect();
    let words = header.iter().flat_map(|name| name.split_whitespace());
    words.for_each(|word| assert!(head.contains(&word), "{word}\n{text}"));
}

#[test]
fn of_long_words_stands_the_beginning() {
    let long = "ä".repeat(1_000_000);
    let mut table = Table::new(&["name", "of"]);
    table.row([format!("an {long}\n{long} end"), "it".to_owned()]);
    let text = table.to_string();
    assert_eq!(text.matches('ä').count(), 2 * LONGEST);
    assert!(text.contains('…') && text.contains(" end") && text.contains(" it"), "{text}");
    let whole = "a b".repeat(LONGEST);
    assert_eq!(cut(whole.clone()), whole);
}
