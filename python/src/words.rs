//! Words of Python instead of the options of the command, in everything that Python shows.

use std::borrow::Cow;

use serde_json::Value;

/// Phrases of the command, and what Python has for them.
const PHRASES: [(&str, &str); 13] = [
    ("abbe analyze SPEC --shard I/N --out FILE", "Machine.analyze(shard=(I, N)).save(FILE)"),
    ("--shard I/N", "shard=(I, N)"),
    (" --out FILE", ""),
    ("abbe import FILE.urdf --tip LINK -o SPEC", "abbe.import_urdf(FILE, tip=LINK)"),
    ("abbe measure SPEC DATA --map MAP", "Machine.measure(DATA, MAP)"),
    ("abbe generate SPEC", "Machine.generate()"),
    ("abbe identify --out", "Machine.identify(…).report(folder)"),
    ("abbe measure --station new", "Machine.measure(…, new_station=True)"),
    ("--station new", "new_station=True"),
    ("--set x=250mm", "with_parameters(x=\"250mm\")"),
    ("--disable NAME", "disable(NAME)"),
    ("--dh standard", "convention=\"standard\""),
    ("--dh modified", "convention=\"modified\""),
];

/// Options with another name in Python, and those that are true there.
const OPTIONS: [(&str, &str); 5] = [
    ("set", "with_parameters"),
    ("dh", "convention"),
    ("round-angles", "round_angles=True"),
    ("fold", "fold=True"),
    ("least", "least=True"),
];

/// Replaces the options of the command: `--folds 5` by `folds=5`, `--robust tukey` by
/// `robust="tukey"`, and `--map` alone by `map`.
pub(crate) fn in_python(text: &str) -> Cow<'_, str> {
    if !text.contains("--") {
        return Cow::Borrowed(text);
    }
    let mut text = text.to_owned();
    for (phrase, python) in PHRASES {
        text = text.replace(phrase, python);
    }
    let mut words = String::new();
    let mut rest = text.as_str();
    while let Some(start) = rest.find("--") {
        let (before, option) = (&rest[..start], &rest[start + 2..]);
        let length = option.find(|letter: char| !letter.is_ascii_lowercase() && letter != '-');
        let (name, after) = option.split_at(length.unwrap_or(option.len()));
        words += before;
        rest = after;
        if before.ends_with(|letter: char| letter.is_alphanumeric() || letter == '-')
            || !name.starts_with(|letter: char| letter.is_ascii_lowercase())
        {
            // A line of dashes, or a dash within a word.
            words += "--";
            words += name;
            continue;
        }
        let known = OPTIONS.iter().find(|(option, _)| *option == name);
        words += &known.map_or_else(|| name.replace('-', "_"), |(_, python)| (*python).to_owned());
        // Its value, as far as the code that it is in.
        let line = words.rsplit('\n').next().unwrap_or_default();
        let code = line.matches('`').count() % 2 == 1;
        if let Some(value) = after.strip_prefix(' ').filter(|_| code) {
            let length = value.find(['`', ' ']).unwrap_or(value.len());
            let (value, after) = value.split_at(length);
            let is_name = value.starts_with(|letter: char| letter.is_ascii_lowercase());
            words += &match value.split_once('/') {
                Some((number, count)) => format!("=({number}, {count})"),
                None if is_name => format!("={value:?}"),
                None => format!("={value}"),
            };
            rest = after;
        }
    }
    Cow::Owned(words + rest)
}

/// Replaces the options in every text of a report. Texts of several lines are those of files, and
/// stay as they are.
pub(crate) fn in_texts(value: &mut Value) {
    match value {
        Value::String(text) if !text.contains('\n') => {
            if let Cow::Owned(words) = in_python(text) {
                *text = words;
            }
        }
        Value::Array(list) => list.iter_mut().for_each(in_texts),
        Value::Object(fields) => fields.values_mut().for_each(in_texts),
        _ => {}
    }
}
