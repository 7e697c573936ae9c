//! Every mistake in a spec is shown with its location, the line, a caret and a help.
//!
//! `bad-specs/NAME.toml` contains a mistake, `bad-specs/NAME.txt` its diagnostic. To add one, put a
//! spec in the folder; `UPDATE_EXPECT=1 cargo test -p abbe-tests` writes the diagnostic.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use abbe_spec::Spec;
use abbe_spec::diagnostic::Diagnostics;
use expect_test::expect_file;

fn mistakes(name: &str, text: &str) -> Diagnostics {
    match Spec::parse(name, text) {
        Ok(_) => panic!("{name} is read as if nothing were wrong"),
        Err(diagnostics) => diagnostics,
    }
}

/// Checks that every diagnostic has file, line, column, the line, a caret and a help.
fn assert_complete(diagnostics: &Diagnostics) {
    let text = diagnostics.to_string();
    let count = diagnostics.list.len().min(20);
    assert!(count > 0);
    for (part, least) in [("error: ", count), ("--> ", count), ("^", count), ("= help: ", count)] {
        assert!(text.matches(part).count() >= least, "`{part}` is missing in\n{text}");
    }
    assert!(text.lines().all(|line| line.len() < 1000), "a line is too long");
}

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("bad-specs");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}

#[test]
fn every_file_is_told_what_is_wrong_with_it() {
    let files = files();
    assert!(files.len() >= 40);
    for file in files {
        let name = file.file_name().unwrap().to_str().unwrap();
        let diagnostics = mistakes(name, &std::fs::read_to_string(&file).unwrap());
        assert_complete(&diagnostics);
        if name.starts_with("several_") {
            assert!(diagnostics.list.len() > 1, "{name} has several mistakes");
        }
        expect_file![file.with_extension("txt")].assert_eq(&format!("{diagnostics}\n"));
    }
}

const HEAD: &str = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n";

fn with_transform(transform: &str) -> String {
    format!(
        "{HEAD}[[frame]]\nname = \"slide\"\nvariable = {{ name = \"d1\", kind = \"prismatic\" }}\n\
         transform = \"Tx(d1) {transform}\"\n"
    )
}

#[test]
fn ten_thousand_parentheses() {
    let deep = format!("Rz({}1{})", "(".repeat(10_000), ")".repeat(10_000));
    assert_complete(&mistakes("deep.toml", &with_transform(&deep)));
    for inner in ["-", "sin(", "2^", "1 / (", "1 m/("] {
        let deep = format!("Rz({})", inner.repeat(10_000));
        assert_complete(&mistakes("deep.toml", &with_transform(&deep)));
    }
}

#[test]
fn a_long_sum_is_not_deep() {
    let sum = format!("Rz(0{})", " + d1/(1 mm)".repeat(2_400));
    let spec = Spec::parse("long.toml", &with_transform(&sum)).unwrap();
    // It must not exhaust the stack of the generator or the compiler either.
    let text = abbe_codegen::print::rust(&spec);
    assert!(text.lines().all(|line| line.len() < 200));
}

#[test]
fn ten_megabytes_of_brackets() {
    let folder = tempfile::tempdir().unwrap();
    for bracket in ["[", "{", "a=[", "[[a]]\n"] {
        let path = folder.path().join("brackets.toml");
        std::fs::write(&path, bracket.repeat(10_000_000 / bracket.len())).unwrap();
        let refused = Spec::read(&path).unwrap_err().to_string();
        assert!(refused.contains("is larger than 4 MiB") && refused.contains("= help: "), "{refused}");
        // The largest number of brackets that is read.
        std::fs::write(&path, bracket.repeat(1_000_000 / bracket.len())).unwrap();
        assert_complete(&Spec::read(&path).unwrap_err());
    }
}

#[test]
fn files_that_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let message = |path: &Path| Spec::read(path).unwrap_err().to_string();
    let directory = message(folder.path());
    assert!(directory.contains("is a directory") && directory.contains("help"), "{directory}");
    let missing = message(&folder.path().join("missing.toml"));
    assert!(missing.contains("cannot read") && missing.contains("missing.toml"), "{missing}");
    let binary = folder.path().join("binary.toml");
    std::fs::write(&binary, [HEAD.as_bytes(), &[0xff, 0xfe, 0, 1, 2, 0x80]].concat()).unwrap();
    let diagnostics = Spec::read(&binary).unwrap_err();
    assert_complete(&diagnostics);
    assert!(diagnostics.to_string().contains("binary.toml:4:1"), "{diagnostics}");
    std::fs::write(&binary, [0, 159, 146, 150]).unwrap();
    assert_complete(&Spec::read(&binary).unwrap_err());
    std::fs::write(&binary, "\0".repeat(100)).unwrap();
    assert_complete(&Spec::read(&binary).unwrap_err());
}

#[test]
fn a_thousand_mistakes_are_counted() {
    let mut text = with_transform("");
    for i in 0..1000 {
        writeln!(text, "[[source]]\nname = \"s{i}\"\nclass = \"sometimes\"\nframe = \"nowhere\"\ne_x = 1")
            .unwrap();
    }
    let diagnostics = mistakes("many.toml", &text);
    assert_complete(&diagnostics);
    assert!(diagnostics.to_string().ends_with("… and 1980 more"), "{diagnostics}");
}

#[test]
fn a_hundred_frames_are_fine() {
    let mut text = HEAD.to_owned();
    for i in 0..100 {
        writeln!(text, "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"revolute\" }}")
            .unwrap();
        writeln!(text, "dh = {{ theta = \"q{i}\", d = 1, a = 2, alpha = 0.3 }}").unwrap();
    }
    assert_eq!(Spec::parse("long.toml", &text).unwrap().frames.len(), 100);
}

/// Files of old computers, whose lines end by a carriage return alone, have lines.
#[test]
fn mistakes_have_their_lines_whatever_ends_these() {
    let text = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"a\"\nvariable = { name = \"q\", kind = \"hinge\" }\n";
    for end in ["\n", "\r\n", "\r"] {
        let mistakes = Spec::parse("arm.toml", &text.replace('\n', end)).unwrap_err().to_string();
        assert!(mistakes.contains("arm.toml:6:"), "{end:?}: {mistakes}");
    }
}
