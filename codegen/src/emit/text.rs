//! A spec's free text as documentation.

/// How long a line of documentation may be.
const WIDTH: usize = 96;

/// A text in which nothing is a link or a tag.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        if matches!(character, '[' | ']' | '<' | '>' | '|' | '`') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}

/// A text in lines of bounded length, each with its leading space.
pub(super) fn wrapped(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!(" {word}")),
        }
    }
    lines
}
