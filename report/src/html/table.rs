//! Tables with a caption, and with header cells for columns and rows.

/// Formats a table of numbers with one or several `<tbody>`. The columns `words` hold text, which
/// is flush left. Names and rows are HTML.
pub(super) fn ledger(caption: &str, columns: &[&str], words: &[usize], bodies: &str) -> String {
    let columns = columns.iter().enumerate().map(|(i, name)| {
        let class = if words.contains(&i) { " class=\"words\"" } else { "" };
        match *name {
            "" => format!("<td{class}></td>"),
            name => format!("<th scope=\"col\"{class}>{name}</th>"),
        }
    });
    let head = match columns.collect::<String>() {
        none if none.is_empty() => none,
        names => format!("<thead><tr>{names}</tr></thead>\n"),
    };
    format!("<table class=\"ledger\">\n<caption>{caption}</caption>\n{head}{bodies}</table>\n")
}

/// Formats the header cell of a row.
pub(super) fn row_header(name: &str) -> String {
    format!("<th scope=\"row\" class=\"words\">{name}</th>")
}

/// Formats a table of named facts. Names and facts are HTML; rows without a fact are left out.
pub(super) fn facts<N: AsRef<str>, F: AsRef<str>>(
    caption: &str,
    facts: impl IntoIterator<Item = (N, F)>,
) -> String {
    let rows = facts.into_iter().filter(|(_, fact)| !fact.as_ref().is_empty()).map(|(name, fact)| {
        format!("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", name.as_ref(), fact.as_ref())
    });
    format!(
        "<table class=\"facts\">\n<caption>{caption}</caption>\n<tbody>{}</tbody></table>\n",
        rows.collect::<String>()
    )
}
