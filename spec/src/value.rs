//! Values and names outside of a spec: on a command line or in a study.

use abbe_core::LengthUnit;

use crate::diagnostic::{Diagnostic, Span, listed, nearest};
use crate::document::{Document, Item};
use crate::expr::{
    Allowed, Dimension, Entry, FUNCTION_NAMES, LocatedText, Scope, TextLocation, Token, UNIT_NAMES,
    parse_expression, tokens, unit_help, unit_spelling,
};

/// Returns the value of the number, or of the constant expression, at `span` of the document's
/// text.
///
/// The value is in coherent units with the given length unit, as bare numbers are. `what` describes
/// it in diagnostics, such as `the value of d1`.
///
/// ```
/// # use abbe_spec::document::Document;
/// # use abbe_core::LengthUnit;
/// # use abbe_spec::expr::Dimension;
/// # use abbe_spec::value::parse_value;
/// let document = Document::new("--q", "1.2m,1200");
/// for span in [0..4, 5..9] {
///     let value = parse_value(&document, span, LengthUnit::Millimetre, Dimension::LENGTH, "the value of d1");
///     assert_eq!(value, Some(1200.0));
/// }
/// ```
pub fn parse_value(
    document: &Document,
    span: Span,
    length: LengthUnit,
    dimension: Dimension,
    what: &str,
) -> Option<f64> {
    let whole = document.text.clone();
    let text = whole.get(span.clone()).unwrap_or_default();
    if text.trim().is_empty() {
        return document.refuse(span, format!("{what} is missing"), "write 0 if it is zero");
    }
    let located = LocatedText { text, place: TextLocation::Exact(span.start) };
    let mistakes = document.mistakes();
    match tokens(&located) {
        Ok(tokens) => {
            let words = tokens.into_iter().filter_map(|(token, range)| match token {
                Token::Word(word) => Some((word, located.place.span(range))),
                _ => None,
            });
            document.found.borrow_mut().extend(words.filter_map(|(word, span)| unknown_word(word, span)));
        }
        Err(mistake) => document.mistake(mistake),
    }
    if document.mistakes() > mistakes {
        return None;
    }
    let scope = Scope::new(length);
    let entry = Entry { dimension: Some(dimension), what, names: Allowed::Nothing };
    let value = parse_expression(&located, &scope, entry, &mut document.found.borrow_mut())?.constant()?;
    if !value.is_finite() {
        let help = format!("it is converted to {}", dimension.unit(length.symbol()));
        document.mistake(Diagnostic::new(span, format!("{what} is too large")).help(help));
    }
    Some(value).filter(|value| value.is_finite())
}

/// Returns the diagnostic of a word that is neither a unit nor a function.
fn unknown_word(word: &str, span: Span) -> Option<Diagnostic> {
    if [&UNIT_NAMES[..], &FUNCTION_NAMES, &["pi"]].concat().contains(&word) {
        return None;
    }
    let function = || nearest(word, FUNCTION_NAMES).map(|near| format!("did you mean `{near}`?"));
    let help = unit_spelling(word).or_else(function).unwrap_or_else(|| unit_help(word));
    let message = format!("`{}` is neither a unit nor a function", word.escape_debug());
    Some(Diagnostic::new(span, message).label("unknown here").help(help))
}

/// Reads a name, and returns its index among the known ones; `what` names one of them in the
/// singular.
pub fn read_name<'n>(item: &Item<'_>, known: impl IntoIterator<Item = &'n str>, what: &str) -> Option<usize> {
    let (name, known) = (item.string()?, Vec::from_iter(known));
    find_name(item.document, item.span(), &name, &known, what)
}

/// Returns the index of a name among the known ones, or records a mistake at `span` with
/// suggestions.
///
/// `what` names one of them in the singular: `source`.
pub fn find_name(document: &Document, span: Span, name: &str, known: &[&str], what: &str) -> Option<usize> {
    let found = known.iter().position(|candidate| *candidate == name);
    if found.is_none() {
        let near = nearest(name, known.iter().copied());
        let near = near.map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
        let help = match known {
            [] => format!("this spec has no {what}"),
            known => format!("{near}there are: {}", listed(known)),
        };
        let message = format!("there is no {what} `{}`", name.escape_debug());
        document.mistake(Diagnostic::new(span, message).help(help));
    }
    found
}
