//! Splits the text of an expression into tokens.

use crate::diagnostic::{Diagnostic, Span};

/// Maximum number of tokens: enough for a sum of as many names as a spec may declare.
pub(super) const LONGEST: usize = 20_000;

/// A text and its location in its file.
#[derive(Clone, Debug)]
pub(crate) struct LocatedText<'t> {
    pub(crate) text: &'t str,
    pub(crate) place: TextLocation,
}

/// Location of a text in its file.
#[derive(Clone, Debug)]
pub(crate) enum TextLocation {
    /// Byte for byte from this offset on.
    Exact(usize),
    /// Somewhere within this span, because the text has escapes.
    Within(Span),
}

impl TextLocation {
    /// Converts a range of the text to a span of the file.
    pub(crate) fn span(&self, range: Span) -> Span {
        match self {
            Self::Exact(start) => start + range.start..start + range.end,
            Self::Within(span) => span.clone(),
        }
    }
}

/// A token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Token<'t> {
    Number(f64),
    Word(&'t str),
    Sign(char),
    End,
}

/// Returns the tokens of a text with their ranges in it; the last is [`Token::End`].
pub(crate) fn tokens<'t>(located: &LocatedText<'t>) -> Result<Vec<(Token<'t>, Span)>, Diagnostic> {
    let LocatedText { text, place } = located;
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(character) = text[at..].chars().next() {
        let length = match character {
            c if c.is_whitespace() => {
                at += c.len_utf8();
                continue;
            }
            '0'..='9' | '.' => number_length(&text[at..]),
            c if c.is_alphabetic() || c == '_' => {
                text[at..].find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len() - at)
            }
            c => c.len_utf8(),
        };
        let range = at..at + length;
        let piece = &text[range.clone()];
        let token = match character {
            '0'..='9' | '.' => Token::Number(number(piece, || place.span(range.clone()))?),
            c if c.is_alphabetic() || c == '_' => Token::Word(piece),
            '%' => Token::Word(piece),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => Token::Sign(character),
            other => {
                let help = match other {
                    '−' | '–' => "write minus as `-`",
                    '·' | '×' => "write a product as `*`",
                    '°' => "write degrees as `deg`",
                    '²' | '³' => "write a power as `^2`",
                    '=' => "write an expression, not an equation",
                    _ => "expressions consist of names, numbers, + - * / ^ , and parentheses",
                };
                let message = format!("unexpected `{}` in an expression", other.escape_debug());
                return Err(Diagnostic::new(place.span(range), message).help(help));
            }
        };
        if tokens.len() == LONGEST {
            let message = format!("this expression has more than {LONGEST} names, numbers and operators");
            let help =
                "write a measured function as a table, `[tables.NAME]`, and split a sum into several sources";
            return Err(Diagnostic::new(place.span(range), message)
                .label("first one beyond the maximum")
                .help(help));
        }
        tokens.push((token, range.clone()));
        at = range.end;
    }
    tokens.push((Token::End, text.len()..text.len()));
    Ok(tokens)
}

/// Returns the length of the number at the beginning of `text`: digits, a point, an exponent.
fn number_length(text: &str) -> usize {
    let digits = |from: usize| text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut end = digits(0);
    if text[end..].starts_with('.') {
        end += 1;
        end += digits(end);
    }
    if text[end..].starts_with(['e', 'E']) {
        let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
        let exponent = digits(end + 1 + sign);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    end
}

fn number(text: &str, span: impl Fn() -> Span) -> Result<f64, Diagnostic> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(Diagnostic::new(span(), format!("`{text}` is too large for a number"))
            .help("the largest number is about 1.8e308")),
        Err(_) => Err(Diagnostic::new(span(), format!("`{text}` is not a number"))
            .help("write a number as `12`, `0.5` or `2.354e13`")),
    }
}
