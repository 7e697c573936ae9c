//! Properties of every command under random inputs: it ends; refusals have a place and a help line;
//! inputs stay unchanged; output numbers are finite; the same input gives the same bytes.
//!
//! Seeded. `ABBE_ABUSE=20000` sets the number of inputs; statistics are printed with `--nocapture`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::process::Stdio;

use abbe_tests::abuse::{Choices, damaged, damaged_table};
use abbe_tests::thorough;

use crate::running::{Run, ends, prints};
use crate::workshop::{FILES, WRITING, Workshop, contents};

/// Commands that only print, with their inputs.
const PRINTING: [(&str, &[&str]); 8] = [
    ("check s.toml", &["s.toml", "rail.csv"]),
    ("jacobian s.toml --q 100,0.2 --json", &["s.toml", "rail.csv"]),
    ("generate s.toml --lang js", &["s.toml", "rail.csv"]),
    ("analyze s.toml --study study.toml --monte-carlo 50", &["s.toml", "rail.csv", "study.toml", "path.csv"]),
    ("measure s.toml d.csv --map m.toml --json", &["s.toml", "rail.csv", "m.toml", "d.csv"]),
    ("identify s.toml d.csv --map m.toml --terms auto --folds 3", &["s.toml", "rail.csv", "m.toml", "d.csv"]),
    ("compensate s.toml d.csv --map m.toml --json", &["s.toml", "rail.csv", "m.toml", "d.csv"]),
    ("monitor s.toml d.csv t.csv --map m.toml --json", &["s.toml", "rail.csv", "m.toml", "d.csv", "t.csv"]),
];

/// Replacements for words of a command line.
const WORDS: [&str; 38] = [
    "",
    "-",
    "--",
    "---",
    "-1",
    "0",
    "1e308",
    "1e151",
    "nan",
    "inf",
    "-0",
    "1e-400",
    "18446744073709551616",
    "3.7",
    "q2=1",
    "q2",
    "=",
    "reach=inf",
    "d1=9e99 kg",
    "é",
    "🦾",
    "a b",
    "\u{202e}x",
    "%n",
    "/dev/full",
    "/dev/null",
    "s.toml",
    "rail.csv",
    "m.toml",
    "d.csv",
    "sub",
    "loop",
    "broken",
    "nowhere/x",
    "--json",
    "--force",
    "--out",
    "--help=x",
];

/// Returns the number of inputs: `ABBE_ABUSE`, or `thoroughly`, halved in a normal run.
fn many(thoroughly: u64) -> u64 {
    let usual = if thorough() { thoroughly } else { thoroughly / 2 };
    std::env::var("ABBE_ABUSE").ok().and_then(|many| many.parse().ok()).unwrap_or(usual)
}

/// Runs the command in the workshop. Fails the test if it does not end.
fn run(workshop: &Workshop, words: &[String]) -> (Run, u64) {
    ends(words, Some(workshop.0.path()))
}

/// Checks that a refusal has a place, a help line and no results, and that the exit status matches.
fn check_refusal(run: &Run) -> Result<(), String> {
    if run.stderr.contains("panicked") {
        return Err("it panics".to_owned());
    }
    match run.status {
        0 | 1 => Ok(()),
        2 => {
            // Clap reports command-line errors, with the argument in the message.
            let of_a_file = run.stderr.contains("--> ") && run.stderr.contains("help: ");
            let of_an_argument = run.stderr.contains("try '--help'") && run.stderr.contains(['\'', '<']);
            // Warnings may come first.
            let is_explained = run.stderr.lines().any(|line| line.starts_with("error: "));
            let is_explained = is_explained && (of_a_file || of_an_argument);
            match is_explained && run.stdout.is_empty() {
                true => Ok(()),
                false => Err("it is refused without a place, a way out, or with results".to_owned()),
            }
        }
        other => Err(format!("it ends with {other}")),
    }
}

/// Returns the first word of a text that is a number but not finite.
fn not_finite(text: &str) -> Option<&str> {
    let words = text.split(|c: char| !(c.is_alphanumeric() || c == '∞' || c == '_'));
    words.into_iter().find(|word| {
        let word = word.strip_prefix('-').unwrap_or(word);
        word.contains('∞') || ["nan", "inf", "infinity"].contains(&word.to_ascii_lowercase().as_str())
    })
}

/// Number of runs by outcome.
#[derive(Default)]
struct Figures {
    answered: usize,
    refused: usize,
    /// Longest processor time, in hundredths of a second.
    slowest: u64,
}

impl Figures {
    fn add(&mut self, run: &Run, taken: u64) {
        *(if run.status == 2 { &mut self.refused } else { &mut self.answered }) += 1;
        self.slowest = self.slowest.max(taken);
    }

    fn print(&self, what: &str) {
        let Self { answered, refused, slowest } = self;
        eprintln!("{what}: {answered} answered, {refused} refused, slowest {slowest} hundredths of a second");
    }
}

/// Returns the files that one run changed or created.
fn changes(before: &BTreeMap<PathBuf, Vec<u8>>, after: &BTreeMap<PathBuf, Vec<u8>>) -> BTreeSet<PathBuf> {
    before.keys().chain(after.keys()).filter(|path| before.get(*path) != after.get(*path)).cloned().collect()
}

/// Every command, with any of its input files damaged.
#[test]
fn damaged_files_are_refused_or_answered() {
    let workshop = Workshop::new();
    let whole: BTreeMap<&str, Vec<u8>> =
        FILES.iter().map(|name| (*name, fs::read(workshop.at(name)).unwrap())).collect();
    let all = WRITING.into_iter().chain(PRINTING);
    let commands: Vec<_> = all.filter(|(_, inputs)| !inputs.is_empty()).collect();
    let mut figures = Figures::default();
    for seed in 0..many(70) {
        let mut c = Choices::seeded(seed);
        let (line, inputs) = commands[seed as usize % commands.len()];
        let name = *c.one_of(inputs);
        let spoilt = if name.ends_with(".csv") { damaged_table } else { damaged };
        let spoilt = spoilt(&mut c, &whole[name]);
        fs::write(workshop.at(name), &spoilt).unwrap();
        let before = contents(workshop.0.path());
        let mut words = workshop.words(line);
        let writes = WRITING.iter().any(|(writing, _)| *writing == line);
        if writes {
            words.push(workshop.path("out"));
        }
        let (run, taken) = run(&workshop, &words);
        let input =
            || format!("{seed}: {line}\n{name}:\n{}\n{}", String::from_utf8_lossy(&spoilt), run.stderr);
        check_refusal(&run).unwrap_or_else(|what| panic!("{what}: {}", input()));
        let after = contents(workshop.0.path());
        for path in changes(&before, &after) {
            assert!(!before.contains_key(&path), "{} has changed: {}", path.display(), input());
            assert!(run.status != 2, "{} is there: {}", path.display(), input());
        }
        // Such words are allowed as names and as constants of generated code, but not as numbers.
        let numbers = !line.contains("--report") && !line.starts_with("generate");
        if numbers && run.status != 2 && not_finite(&String::from_utf8_lossy(&spoilt)).is_none() {
            let written = after.iter().filter(|(path, _)| !before.contains_key(*path));
            let tables = written.filter(|(path, _)| path.extension().is_none_or(|kind| kind != "html"));
            let texts = tables.map(|(_, bytes)| String::from_utf8_lossy(bytes));
            for text in texts.chain([run.stdout.as_str().into()]) {
                assert_eq!(not_finite(&text), None, "{}\n{text}", input());
            }
        }
        figures.add(&run, taken);
        // Restores the input.
        fs::write(workshop.at(name), &whole[name]).unwrap();
        for path in changes(&before, &after) {
            fs::remove_file(path).unwrap();
        }
        let _ = fs::remove_dir_all(workshop.at("out"));
    }
    figures.print("damaged files");
    assert!(figures.answered > 0 && figures.refused > 0);
}

/// Every command, with any of its words replaced, removed, doubled or moved.
#[test]
fn damaged_command_lines_are_refused_or_answered() {
    let workshop = Workshop::new();
    fs::create_dir(workshop.at("sub")).unwrap();
    std::os::unix::fs::symlink("loop", workshop.at("loop")).unwrap();
    std::os::unix::fs::symlink("nowhere/at/all", workshop.at("broken")).unwrap();
    let commands: Vec<_> = WRITING.into_iter().chain(PRINTING).collect();
    let mut figures = Figures::default();
    for seed in 0..many(120) {
        let mut c = Choices::seeded(seed);
        let (line, _) = commands[seed as usize % commands.len()];
        let mut words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        if WRITING.iter().any(|(writing, _)| *writing == line) {
            words.push("out".to_owned());
        }
        for _ in 0..1 + c.below(2) {
            // The command itself stays: another word there would be another command.
            let (at, to) = (1 + c.below(words.len().max(2) - 1), 1 + c.below(words.len().max(2) - 1));
            if at >= words.len() {
                continue;
            }
            match c.below(5) {
                0 => _ = words.remove(at),
                1 => words.insert(at, words[at].clone()),
                2 => words.swap(at, to),
                _ => words[at] = (*c.one_of(&WORDS)).to_owned(),
            }
        }
        let before = contents(workshop.0.path());
        let (run, taken) = run(&workshop, &words);
        check_refusal(&run).unwrap_or_else(|what| panic!("{what}: {seed}: {words:?}\n{}", run.stderr));
        let after = contents(workshop.0.path());
        let forced = words.iter().any(|word| word == "--force");
        for path in changes(&before, &after) {
            let read = FILES.iter().any(|name| workshop.at(name) == path);
            assert!(!read || forced, "{}: {seed}: {words:?}", path.display());
            assert!(run.status != 2, "{}: {seed}: {words:?}", path.display());
        }
        figures.add(&run, taken);
        for path in changes(&before, &after) {
            match before.get(&path) {
                Some(content) => fs::write(path, content).unwrap(),
                None => fs::remove_file(path).unwrap(),
            }
        }
        let _ = fs::remove_dir_all(workshop.at("out"));
    }
    figures.print("damaged command lines");
    assert!(figures.answered > 0 && figures.refused > 0);
}

/// A second run, and any number of threads, give the same text and the same files.
#[test]
fn the_same_input_gives_the_same_bytes() {
    let workshop = Workshop::new();
    let mut compared = 0;
    for (line, _) in WRITING.into_iter().chain(PRINTING) {
        let name = line.split(' ').next().unwrap();
        let parallel = prints(&[name, "--help"]).contains("--threads");
        let mut first = None;
        for threads in ["1", "1", "2", "5"].into_iter().take(if parallel { 4 } else { 2 }) {
            let before = contents(workshop.0.path());
            let mut words = workshop.words(line);
            if WRITING.iter().any(|(writing, _)| *writing == line) {
                words.push(workshop.path("out"));
            }
            if parallel {
                words.extend(["--threads".to_owned(), threads.to_owned()]);
            }
            let (run, _) = run(&workshop, &words);
            assert!(run.status <= 1, "{line}: {}", run.stderr);
            let after = contents(workshop.0.path());
            let files: Vec<_> =
                changes(&before, &after).into_iter().map(|path| (after[&path].clone(), path)).collect();
            for (_, path) in &files {
                fs::remove_file(path).unwrap();
            }
            let _ = fs::remove_dir_all(workshop.at("out"));
            let result = (run, files);
            let first = first.get_or_insert_with(|| (result.0.stdout.clone(), result.1.clone()));
            assert!(first.0 == result.0.stdout, "{line} with {threads} threads prints something else");
            assert!(first.1 == result.1, "{line} with {threads} threads writes something else");
            compared += usize::from(parallel);
        }
    }
    assert!(compared > 30, "{compared}");
}

/// Files are either all old or all new if a limit on their size stops the run.
#[test]
fn a_disk_that_fills_up_leaves_all_files_or_none() {
    let workshop = Workshop::new();
    let (mut full, mut done) = (0, 0);
    for seed in 0..many(44).min(2000) {
        let mut c = Choices::seeded(seed);
        let (line, _) = WRITING[seed as usize % WRITING.len()];
        let mut words = workshop.words(line);
        words.push(workshop.path("out"));
        let before = contents(workshop.0.path());
        let limit = c.below(48).to_string();
        let mut limited = std::process::Command::new("sh");
        limited.args(["-c", "trap '' XFSZ; ulimit -f $0; exec \"$@\"", &limit, env!("CARGO_BIN_EXE_abbe")]);
        let output = limited.args(&words).stdin(Stdio::null()).stdout(Stdio::null()).output().unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        let run = Run { status: output.status.code().unwrap(), stdout: String::new(), stderr };
        check_refusal(&run).unwrap_or_else(|what| panic!("{what}: {line}, {limit}: {}", run.stderr));
        let after = contents(workshop.0.path());
        let changed = changes(&before, &after);
        if run.status == 2 {
            full += 1;
            assert!(changed.is_empty(), "{line}, {limit}: {changed:?}");
        } else {
            done += 1;
            // The record may have failed on the full disk.
            words.push("--force".to_owned());
            let (whole, _) = self::run(&workshop, &words);
            assert!(whole.status <= 1 && contents(workshop.0.path()) == after, "{line}, {limit}");
        }
        for path in changed {
            fs::remove_file(path).unwrap();
        }
        let _ = fs::remove_dir_all(workshop.at("out"));
    }
    assert!(full > 0 && done > 0, "{full} {done}");
}

/// Each property detects its violation.
#[test]
fn what_breaks_a_law_is_seen() {
    let run = |status, stdout: &str, stderr: &str| Run {
        status,
        stdout: stdout.to_owned(),
        stderr: stderr.to_owned(),
    };
    let refusal = "error: no\n--> a.toml\n = help: do so";
    assert!(check_refusal(&run(2, "", refusal)).is_ok() && check_refusal(&run(0, "yes", "")).is_ok());
    for (status, stdout, stderr) in [
        (2, "half a result", refusal),
        (2, "", "error: no\n--> a.toml"),
        (2, "", "error: no\n = help: do so"),
        (101, "", ""),
        (0, "", "thread 'main' panicked at"),
    ] {
        assert!(check_refusal(&run(status, stdout, stderr)).is_err(), "{status} {stderr}");
    }
    for text in ["1,NaN", "x = inf mm", "-inf", "[Infinity]", "∞°"] {
        assert!(not_finite(text).is_some(), "{text}");
    }
    assert_eq!(not_finite("information of a nanometre, inf_1"), None);
}
