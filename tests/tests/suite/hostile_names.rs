//! Names that have a meaning in a language: what is generated declares no reserved word, no name
//! twice in a block, and no file that hides one of the language.

use std::collections::HashSet;

use abbe_codegen::print::{Language, Real, SourceFile};
use abbe_spec::Spec;
use abbe_tests::hostile;
use abbe_tests::structured_text::Program;

/// Reserved words, and names of the library that generated code calls.
const C: &str = "auto break case char const continue default do double else enum extern float for goto if inline int long \
     register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while \
     and bool catch class delete explicit export false friend mutable namespace new not operator or private protected \
     public template this throw true try typename using virtual xor sqrt fabs atan2 isnan pow HUGE_VAL NAN";
const JAVASCRIPT: &str = "arguments await break case catch class const continue debugger default delete do else enum eval \
     export extends false finally for function if implements import in instanceof interface let new null package \
     private protected public return static super switch this throw true try typeof var void while with yield Math \
     Float64Array Infinity NaN undefined";
const PYTHON: &str = "False None True and as assert async await break class continue def del elif else except finally for \
     from global if import in is lambda nonlocal not or pass raise return try while with yield np range zip";
const MATLAB: &str = "break case catch classdef continue else elseif end for function global if otherwise parfor persistent \
     return spmd switch try while zeros reshape numel sqrt sin cos isnan";

/// Files of the languages.
const FILES: &str =
    "math.h float.h limits.h errno.h string.h time.h signal.h numpy.py random.py types.py ast.py";

/// Returns the name that a line declares, if any.
fn declared(language: Language, line: &str) -> Option<&str> {
    let line = line.trim_start();
    let end = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    let first = |rest: &str| rest.find(end).unwrap_or(rest.len());
    let behind = |words: &[&str]| {
        words.iter().find_map(|word| line.strip_prefix(*word)).map(|rest| &rest[..first(rest)])
    };
    match language {
        Language::C(_) => {
            behind(&["const double ", "const float ", "const int ", "double ", "float ", "int "])
        }
        Language::JavaScript => behind(&["const ", "let ", "export function ", "function "]),
        Language::Python | Language::Matlab => {
            let (name, _) = line.split_once(" = ")?;
            (first(name) == name.len()).then_some(name)
        }
        Language::Rust | Language::StructuredText | Language::Plcopen | Language::Fmu(_) => None,
    }
    .filter(|name| !name.is_empty())
}

/// Checks one file.
fn check(language: Language, SourceFile { name, text }: &SourceFile) {
    assert!(!FILES.split_whitespace().any(|file| file == name), "{name} hides a file of the language");
    let reserved = match language {
        Language::C(_) => C,
        Language::JavaScript => JAVASCRIPT,
        Language::Python => PYTHON,
        Language::Matlab => MATLAB,
        Language::Rust | Language::Plcopen | Language::Fmu(_) => {
            panic!("names of {language:?} are not checked here")
        }
        Language::StructuredText => {
            Program::parse(text).unwrap_or_else(|fault| panic!("{name}: {fault}"));
            return;
        }
    };
    let reserved: HashSet<&str> = reserved.split_whitespace().collect();
    // Names of each block around a line, by indentation.
    let mut blocks: Vec<(usize, HashSet<&str>)> = Vec::new();
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let indent = line.len() - line.trim_start().len();
        let is_end = line.trim_start().starts_with(['}', ')']);
        blocks.retain(|(depth, _)| *depth < indent || *depth == indent && !is_end);
        let Some(found) = declared(language, line) else { continue };
        assert!(!reserved.contains(found), "{name} declares {found}: {line}");
        // Assignments are no declarations.
        if matches!(language, Language::C(_) | Language::JavaScript) && line.trim_end().ends_with(';') {
            if blocks.last().is_none_or(|(depth, _)| *depth < indent) {
                blocks.push((indent, HashSet::new()));
            }
            let block = &mut blocks.last_mut().unwrap().1;
            assert!(block.insert(found), "{name} declares {found} twice: {line}");
        }
    }
}

/// Returns the specs with names that specs may have: units may not be names.
fn specs() -> impl Iterator<Item = Spec> {
    hostile::specs(110).filter_map(|(name, text)| Spec::parse(&format!("{name}.toml"), &text).ok())
}

#[test]
fn generated_names_are_distinct_and_not_reserved() {
    let languages = [
        Language::C(Real::Double),
        Language::C(Real::Float),
        Language::JavaScript,
        Language::Python,
        Language::Matlab,
        Language::StructuredText,
    ];
    let mut count = 0;
    for spec in specs() {
        for language in languages {
            language.files(&spec).iter().for_each(|file| check(language, file));
            count += 1;
        }
    }
    assert!(count > 500, "{count}");
}

/// A file or a class that is named otherwise says so.
#[test]
fn other_names_are_explained() {
    let mut count = 0;
    for spec in specs() {
        for language in [Language::C(Real::Double), Language::Python, Language::Matlab] {
            let SourceFile { name, text } = language.files(&spec).remove(0);
            let is_other = name.split('.').next() != Some(&spec.name);
            let words = text.split_whitespace().filter(|word| !["*", "%"].contains(word));
            let words = words.collect::<Vec<_>>().join(" ");
            assert_eq!(words.contains("is not available as its name"), is_other, "{name}");
            count += usize::from(is_other);
        }
    }
    assert!(count > 10, "{count}");
}

/// A class is not named like a variable of its functions.
#[test]
fn classes_are_no_variables() {
    for spec in specs() {
        let file = Language::Matlab.files(&spec).remove(0);
        let class = file.name.trim_end_matches(".m");
        let is_variable = |line: &str| declared(Language::Matlab, line) == Some(class);
        assert!(!file.text.lines().any(is_variable), "{class}");
        let calls = file.text.lines().filter(|line| line.trim_start().starts_with("function "));
        let mut given = calls.filter_map(|line| line.split_once('(')).map(|(_, arguments)| arguments);
        assert!(
            !given.any(|line| line.trim_end_matches(')').split(", ").any(|name| name == class)),
            "{class}"
        );
    }
}
