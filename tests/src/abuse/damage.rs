//! Damage to files: of bytes, tokens, lines and values.

use super::Choices;

/// Replacements of numbers.
const NUMBERS: [&str; 40] = [
    "0",
    "-0",
    "-1",
    "1e-300",
    "5e-324",
    "1e149",
    "-1e149",
    "1e151",
    "1e200",
    "1e308",
    "1.8e308",
    "1e999",
    "-1e999",
    "nan",
    "inf",
    "-inf",
    "9007199254740993",
    "18446744073709551616",
    "999999999999999999999999",
    "0x10",
    "1_000",
    "0.1e-1",
    "1e",
    "1.",
    ".5",
    "1,5",
    "--1",
    "+1",
    "1e75",
    "1e-75",
    "1e-160",
    "1000000",
    "3.14159265358979",
    "90",
    "1/0",
    "0/0",
    "NaN",
    "∞",
    "''",
    "[1]",
];

/// Replacements of words.
const WORDS: [&str; 36] = [
    "",
    "\"",
    "'",
    "\"\"\"",
    "[",
    "]",
    "[[",
    "{",
    "}",
    "=",
    "#",
    "true",
    "false",
    "1979-05-27",
    "mm",
    "deg",
    "kg",
    "min",
    "pi",
    "sin(",
    "sqrt(-1)",
    "log(0)",
    "1/(d1-d1)",
    "q1",
    "name",
    "value",
    "\u{0}",
    "\u{feff}",
    "\u{202e}",
    "é",
    "🦾",
    "\r",
    "\n\n",
    "\t",
    "self",
    "((((((((((",
];

/// Returns a file with one to three random damages.
pub fn damaged(c: &mut Choices<'_>, file: &[u8]) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for _ in 0..1 + c.below(3) {
        bytes = match c.below(10) {
            0 => by_byte(c, bytes),
            1 | 2 => by_line(c, &bytes),
            3..=5 => by_token(c, &bytes, &WORDS, |byte| byte.is_ascii_alphabetic() || *byte == b'_'),
            _ => by_token(c, &bytes, &NUMBERS, |byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-')),
        };
    }
    bytes
}

/// Returns a table with random damages, mostly of its cells.
pub fn damaged_table(c: &mut Choices<'_>, file: &[u8]) -> Vec<u8> {
    if c.once_in(3) {
        return damaged(c, file);
    }
    let text = String::from_utf8_lossy(file);
    let mut rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    for _ in 0..1 + c.below(4) {
        let row = c.below(rows.len());
        let Some(row) = rows.get_mut(row) else { break };
        let cell = c.below(row.len());
        match c.below(6) {
            0 => _ = row.remove(cell),
            1 => row.insert(cell, "7"),
            2 => row[cell] = *c.one_of(&WORDS),
            _ => row[cell] = *c.one_of(&NUMBERS),
        }
    }
    rows.iter().map(|row| row.join(",") + "\n").collect::<String>().into_bytes()
}

fn by_byte(c: &mut Choices<'_>, mut bytes: Vec<u8>) -> Vec<u8> {
    let at = c.below(bytes.len());
    let end = (at + c.below(60)).min(bytes.len());
    match c.below(5) {
        0 if at < bytes.len() => bytes[at] = c.below(256) as u8,
        1 => bytes.insert(at, c.below(256) as u8),
        2 => _ = bytes.drain(at..end),
        3 => {
            let piece = bytes[at..end].to_vec();
            let to = c.below(bytes.len());
            bytes.splice(to..to, piece);
        }
        _ => bytes.truncate(at),
    }
    bytes
}

fn by_line(c: &mut Choices<'_>, bytes: &[u8]) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    if lines.is_empty() {
        return Vec::new();
    }
    let (at, to) = (c.below(lines.len()), c.below(lines.len()));
    match c.below(4) {
        0 => _ = lines.remove(at),
        1 => lines.insert(to, lines[at]),
        2 => lines.swap(at, to),
        _ => {
            let end = (at + 1 + c.below(12)).min(lines.len());
            lines.drain(at..end);
        }
    }
    lines.concat()
}

/// Replaces a token by one of `others`, or by one of the same kind from elsewhere in the file.
fn by_token(c: &mut Choices<'_>, bytes: &[u8], others: &[&str], part: impl Fn(&u8) -> bool) -> Vec<u8> {
    let mut tokens = Vec::new();
    let mut at = 0;
    for run in bytes.chunk_by(|a, b| part(a) == part(b)) {
        if part(&run[0]) {
            tokens.push(at..at + run.len());
        }
        at += run.len();
    }
    if tokens.is_empty() {
        return bytes.to_vec();
    }
    let token = c.one_of(&tokens).clone();
    let other = match c.once_in(3) {
        true => bytes[c.one_of(&tokens).clone()].to_vec(),
        false => c.one_of(others).as_bytes().to_vec(),
    };
    [&bytes[..token.start], &other, &bytes[token.end..]].concat()
}
