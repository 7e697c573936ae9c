//! Tokens of Structured Text.

/// A token and its line.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) line: usize,
}

/// Kind of a token.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// Identifier or keyword in capitals: case has no meaning.
    Word(String),
    /// Whole number.
    Whole(i64),
    /// Number with a point, and `true` if its type is stated.
    Real(f64, bool),
    /// Operator or separator.
    Sign(&'static str),
    End,
}

const SIGNS: [&str; 19] =
    [":=", "<>", "<=", ">=", "..", "=>", "(", ")", "[", "]", ";", ":", ",", "+", "-", "*", "/", "<", ">"];

/// Splits a text into tokens.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, String> {
    let (mut rest, mut line, mut tokens) = (text, 1, Vec::new());
    loop {
        let blank = rest.len() - rest.trim_start().len();
        line += rest[..blank].matches('\n').count();
        rest = &rest[blank..];
        let fault = |what: &str| format!("line {line}: {what}");
        let (kind, length) = if rest.is_empty() {
            tokens.push(Token { kind: Kind::End, line });
            return Ok(tokens);
        } else if let Some(inner) = rest.strip_prefix("(*") {
            let end = inner.find("*)").ok_or_else(|| fault("a comment does not end"))?;
            if inner[..end].contains("(*") {
                return Err(fault("a comment in a comment"));
            }
            line += inner[..end].matches('\n').count();
            rest = &inner[end + 2..];
            continue;
        } else if rest.starts_with(|c: char| c.is_ascii_alphabetic()) {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
            let word = rest[..end].to_ascii_uppercase();
            match rest[end..].strip_prefix('#') {
                Some(digits) if word == "LREAL" => match number(digits) {
                    Some((Kind::Real(value, _), length)) => (Kind::Real(value, true), end + 1 + length),
                    _ => return Err(fault("not a number of LREAL")),
                },
                Some(_) => return Err(fault("a type that no generated file uses")),
                None if word.contains("__") || word.ends_with('_') => {
                    return Err(fault(&format!("{word} is no identifier: underscores")));
                }
                None => (Kind::Word(word), end),
            }
        } else if rest.starts_with(|c: char| c.is_ascii_digit()) {
            number(rest).ok_or_else(|| fault("not a number"))?
        } else if let Some(sign) = SIGNS.iter().chain(&["=", "."]).find(|sign| rest.starts_with(**sign)) {
            (Kind::Sign(sign), sign.len())
        } else {
            return Err(fault(&format!("unexpected `{}`", rest.chars().next().unwrap_or(' '))));
        };
        tokens.push(Token { kind, line });
        rest = &rest[length..];
    }
}

/// Returns the number at the start of a text, and its length: digits on both sides of a point, and
/// a capital E.
fn number(text: &str) -> Option<(Kind, usize)> {
    let digits = |text: &str| text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let whole = digits(text);
    let has_point = text[whole..].starts_with('.') && !text[whole..].starts_with("..");
    if !has_point {
        let ends = !text[whole..].starts_with(|c: char| c.is_ascii_alphabetic());
        return (whole > 0 && ends).then(|| Some((Kind::Whole(text[..whole].parse().ok()?), whole)))?;
    }
    let fraction = digits(&text[whole + 1..]);
    let mut end = whole + 1 + fraction;
    if let Some(exponent) = text[end..].strip_prefix('E') {
        let sign = usize::from(exponent.starts_with(['-', '+']));
        let length = digits(&exponent[sign..]);
        end += 1 + sign + length;
        if length == 0 {
            return None;
        }
    }
    let ends = !text[end..].starts_with(|c: char| c.is_ascii_alphabetic());
    // Some compilers read every number as a REAL to see whether it is one.
    let size = text[..end].parse::<f32>().ok().filter(|size| size.is_normal() || *size == 0.0)?;
    let is_zero = text[..end].parse() == Ok(0.0);
    let is_valid = whole > 0 && fraction > 0 && ends && (size != 0.0 || is_zero);
    is_valid.then(|| Some((Kind::Real(text[..end].parse().ok()?, false), end)))?
}
