//! Short lists of names.

/// Returns the first items of a list, separated by commas, and the number of the others.
pub(crate) fn first<T: AsRef<str>>(items: &[T], shown: usize) -> String {
    let names = joined(items.iter().take(shown));
    match items.len().saturating_sub(shown) {
        0 => names,
        more => format!("{names} and {more} more"),
    }
}

/// Returns items separated by commas.
pub(crate) fn joined<T: AsRef<str>>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<T> = items.into_iter().collect();
    items.iter().map(AsRef::as_ref).collect::<Vec<&str>>().join(", ")
}
