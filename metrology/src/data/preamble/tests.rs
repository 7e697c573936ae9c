//! Tests of `preamble.rs`.

use super::*;

fn found(text: &str) -> Option<String> {
    let mut text = text.as_bytes().to_vec();
    let stated = stated_separator(&mut text);
    above_heading(&text, Dialect::detect(&text, stated)).map(|found| found.message)
}

#[test]
fn titles_are_told_from_headings() {
    let title = |line: u64, cells: &str, heading: u64| {
        Some(format!(
            "line {line} is not the heading: it has {cells}, but line {heading} and the rows below have 3"
        ))
    };
    for (text, expected) in [
        ("Run of Monday\nq1,x,y\n1,2,3\n4,5,6\n", title(1, "1 cell", 2)),
        ("Run of Monday;;\r\nq1;x;y\r\n1,5;2,5;3\r\n", title(1, "1 cell", 2)),
        // The title has a comma, which is not the separator.
        ("Monday, hall 2\nq1;x;y\n1,5;2;3\n", title(1, "1 cell", 2)),
        ("\n# by hand\nMonday\nHall;2\n\nq1;x;y\n1;2;3\n4;;6\n7;8;\n", title(3, "1 cell", 6)),
        ("sep=;\nMonday\nq1;x;y\n1;2;3\n", title(2, "1 cell", 3)),
        // The first line is a heading, whatever follows.
        ("q1,x,y\n1,2,3\n", None),
        ("q1,x,y\ndeg,mm,mm\n1,2,3\n", None),
        ("q1,x\n1,2,3\n4,5,6\n", None),
        ("q1,x\n1,2\nof,no,use\n4,5\n", None),
        ("q1\n1,5\n2,5\n", None),
        ("name\nfirst; good\nsecond; bad\n", None),
        ("q1,x\n", None),
        ("", None),
    ] {
        assert_eq!(found(text), expected, "{text:?}");
    }
}

#[test]
fn separators_are_stated() {
    for (text, expected) in [
        ("sep=;\na,b\n", Some(b';')),
        ("\u{feff}SEP=,\r\na;b;c\r\n", Some(b',')),
        ("\"sep=\t\"\na;b\n", Some(b'\t')),
        ("sep=;", Some(b';')),
        ("sep=|\na|b\n", None),
        ("sep=\n", None),
        ("sep=;;\n", None),
        ("a,b\nsep=;\n", None),
    ] {
        let mut bytes = text.as_bytes().to_vec();
        assert_eq!(stated_separator(&mut bytes), expected, "{text:?}");
        assert_eq!(bytes == text.as_bytes(), expected.is_none());
    }
}
