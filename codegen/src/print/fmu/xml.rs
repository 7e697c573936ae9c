//! XML elements with attributes and child elements.

use std::fmt::Display;

use abbe_spec::visible::alters_text;

/// An XML element.
#[derive(Clone, Debug)]
pub(super) struct Element {
    name: &'static str,
    /// The attributes as text.
    attributes: String,
    inside: Vec<Self>,
}

impl Element {
    pub(super) fn new(name: &'static str) -> Self {
        Self { name, attributes: String::new(), inside: Vec::new() }
    }

    /// Adds an attribute.
    pub(super) fn with(mut self, name: &str, value: impl Display) -> Self {
        self.attributes.push_str(&format!(" {name}=\"{}\"", escaped(&value.to_string())));
        self
    }

    /// Adds an attribute if there is a value.
    pub(super) fn with_some(self, name: &str, value: Option<impl Display>) -> Self {
        match value {
            Some(value) => self.with(name, value),
            None => self,
        }
    }

    /// Adds child elements.
    pub(super) fn containing(mut self, elements: impl IntoIterator<Item = Self>) -> Self {
        self.inside.extend(elements);
        self
    }

    /// Returns a document with this element as its root.
    pub(super) fn document(&self) -> String {
        let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        self.write(0, &mut text);
        text
    }

    fn write(&self, depth: usize, text: &mut String) {
        let Self { name, attributes, inside } = self;
        let indent = "  ".repeat(depth);
        if inside.is_empty() {
            text.push_str(&format!("{indent}<{name}{attributes}/>\n"));
        } else {
            text.push_str(&format!("{indent}<{name}{attributes}>\n"));
            inside.iter().for_each(|element| element.write(depth + 1, text));
            text.push_str(&format!("{indent}</{name}>\n"));
        }
    }
}

/// Escapes markup. Characters that XML cannot contain or that alter the text around them become
/// `�`; line breaks and tabs become spaces.
pub(in crate::print) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\r' | '\t' => escaped.push(' '),
            other if alters_text(other) => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}
