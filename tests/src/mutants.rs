//! Mutants of generated source text: in each function, operators and numbers are replaced by wrong
//! ones, one at a time.

pub mod every_site;

use std::collections::BTreeMap;

/// Source text with one wrong operation.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Name of the function.
    pub function: String,
    /// Name of the kind of operation.
    pub kind: &'static str,
    /// The mutated line.
    pub line: String,
    /// The whole source.
    pub text: String,
}

impl Mutant {
    /// Returns whether a run tries the mutant. A thorough run tries all, an ordinary one a tenth:
    /// the same functions and kinds in every source. `prefix` is left out of the function's name.
    #[must_use]
    pub fn is_tried(&self, prefix: &str) -> bool {
        let name = self.function.trim_start_matches(prefix).trim_start_matches('_');
        let bytes = name.bytes().chain(self.kind.bytes());
        let hash = bytes.fold(0_u32, |hash, byte| hash.wrapping_mul(31).wrapping_add(byte.into()));
        crate::thorough() || hash.is_multiple_of(10)
    }
}

/// Replacements in a line: operators between spaces, and names before a bracket.
const KINDS: [(&str, &str, &str); 12] = [
    ("sum", " + ", " - "),
    ("difference", " - ", " + "),
    ("product", " * ", " + "),
    ("quotient", " / ", " * "),
    ("sum in place", " += ", " -= "),
    ("less", " < ", " > "),
    ("greater", " > ", " < "),
    ("negation", "= -", "= "),
    ("sine", "sin(", "cos("),
    ("cosine", "cos(", "sin("),
    ("minimum", "min(", "max("),
    ("maximum", "max(", "min("),
];

/// Mutants of the corrected command that no run tells from the source: procedure and kind. The same
/// in all languages, which print one description.
pub const WITHOUT_EFFECT: [(&str, &str); 5] = [
    // The command is a better start than the last correction only where no step improves it.
    ("compensated", "greater"),
    // Costs are only compared with each other.
    ("cost", "number"),
    // The loop ends before the first value of what is held is read.
    ("departure", "negation"),
    // The rotation vector of an angle below 1e-37, whatever its scale, is as small.
    ("deviation", "number"),
    // Both sides of the equation of a rotation change their sign.
    ("weighted", "sum in place"),
];

/// Returns the mutants of a source in C, JavaScript, Python or Matlab: for each function and kind
/// of operation at most `most`, evenly distributed. `is_mutated` selects functions by name.
pub fn mutants(text: &str, most: usize, is_mutated: impl Fn(&str) -> bool) -> Vec<Mutant> {
    let lines: Vec<&str> = text.lines().collect();
    let mut sites: BTreeMap<(String, &'static str), Vec<(usize, String)>> = BTreeMap::new();
    let mut function = None;
    let mut comment: Option<&str> = None;
    for (index, line) in lines.iter().enumerate() {
        let trimmed = line.trim();
        if let Some(end) = comment {
            comment = (!trimmed.ends_with(end)).then_some(end);
            continue;
        }
        let quotes = "\"\"\"";
        // What is not compiled here is not found to be wrong.
        let small = ("#if defined(__OPTIMIZE_SIZE__)", "#else");
        let block = [("/*", "*/"), ("r\"\"\"", quotes), (quotes, quotes), small];
        if let Some((begin, end)) = block.into_iter().find(|(begin, _)| trimmed.starts_with(begin)) {
            let is_open = trimmed.len() < begin.len() + end.len() || !trimmed.ends_with(end);
            comment = is_open.then_some(end);
            continue;
        }
        if ["//", "#", "%"].iter().any(|mark| trimmed.starts_with(mark)) {
            continue;
        }
        if let Some(name) = begun(line) {
            function = Some(name);
        } else if let Some(name) = function.as_ref().filter(|name| is_mutated(name)) {
            // The number of rounds is no operation.
            // What a configuration keeps for which a branch is not taken is no operation.
            let is_masked = line.contains("np.where(case_");
            let (line, kept) = line.split_at(line.rfind(", ").filter(|_| is_masked).unwrap_or(line.len()));
            for (kind, from, to) in KINDS.into_iter().filter(|_| !line.contains("in range(")) {
                if let Some(wrong) = replaced(line, from, to) {
                    sites.entry((name.clone(), kind)).or_default().push((index, wrong + kept));
                }
            }
            if let Some(wrong) = with_another_number(line) {
                sites.entry((name.clone(), "number")).or_default().push((index, wrong + kept));
            }
        }
    }
    let mutant = |((function, kind), sites): ((String, &'static str), Vec<(usize, String)>)| {
        let chosen = most.min(sites.len());
        let each = (0..chosen).map(move |k| sites[(2 * k + 1) * sites.len() / (2 * chosen)].clone());
        each.map(move |(index, line)| (function.clone(), kind, index, line)).collect::<Vec<_>>()
    };
    let with = |(function, kind, index, line): (String, &'static str, usize, String)| {
        let mut mutated = lines.clone();
        mutated[index] = &line;
        let text = mutated.join("\n") + "\n";
        Mutant { function, kind, line: line.trim().to_owned(), text }
    };
    sites.into_iter().flat_map(mutant).map(with).collect()
}

/// Returns the name of the function that begins in a line.
fn begun(line: &str) -> Option<String> {
    let (head, _) = line.split_once('(')?;
    let name = head.rsplit([' ', '*', '.']).next()?;
    let words: Vec<&str> = head.split_whitespace().collect();
    let is_word = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let begins = match words.first().copied() {
        Some("def") => !line.starts_with(' '),
        Some("function" | "export") => true,
        // A definition in C begins in the first column, and a declaration ends with a semicolon.
        Some("static" | "int" | "void") => !line.starts_with(' ') && !line.ends_with(';'),
        _ => false,
    };
    (begins && is_word).then(|| name.to_owned())
}

/// Replaces the last occurrence of an operator, or of a name that no other name ends with.
fn replaced(line: &str, from: &str, to: &str) -> Option<String> {
    let is_name = from.ends_with('(');
    let is_whole = |at: usize| {
        !is_name || line[..at].chars().next_back().is_none_or(|c| !c.is_ascii_alphanumeric() && c != '_')
    };
    let (at, _) = line.rmatch_indices(from).find(|(at, _)| is_whole(*at))?;
    Some([&line[..at], to, &line[at + from.len()..]].concat())
}

/// Multiplies the last number after an operator by 1.5, or replaces 0 by 0.5. Leaves thresholds and
/// counts.
fn with_another_number(line: &str) -> Option<String> {
    let operators = [" * ", " / ", " + ", " - ", "= "];
    let sites = operators.iter().flat_map(|operator| line.match_indices(operator));
    let mut starts: Vec<usize> = sites.map(|(at, operator)| at + operator.len()).collect();
    starts.sort_unstable();
    let number = |start: &usize| {
        let rest = &line[*start..];
        let part = |c: char| c.is_ascii_digit() || ".e".contains(c);
        let mut end = rest.find(|c| !part(c)).unwrap_or(rest.len());
        if rest[..end].ends_with('e') {
            end += 1 + rest[end + 1..].find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len() - end - 1);
        }
        // An index, or letters behind it, make it a whole number in C.
        let is_number = rest.starts_with(|c: char| c.is_ascii_digit())
            && !rest[end..].starts_with(|c: char| c.is_ascii_alphabetic() || c == ']');
        let value: f64 = rest[..end].parse().ok().filter(|_| is_number)?;
        let wrong = if value == 0.0 { 0.5 } else { 1.5 * value };
        Some(format!("{}{wrong:?}{}", &line[..*start], &rest[end..]))
    };
    // Counts are no operations, and only values next to a threshold can tell it from another.
    if ["for ", "int ", "<", ">", "!=", "=="].iter().any(|mark| line.contains(mark)) {
        return None;
    }
    starts.iter().rev().find_map(number)
}
