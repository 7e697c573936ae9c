//! Text of others that is shown: no command obeys control characters of a file, and none lets them,
//! bidirectional controls or characters that XML excludes through to its results.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::running::{Run, abbe, prints, write};
use crate::workshop::Workshop;

/// Characters that alter the text around them: escape, C1 control, line separator, right-to-left
/// override, isolate, and a noncharacter.
const HOSTILE: &str = "\u{1b}[31m\u{9b}2J\u{2028}\u{202e}\u{2066}\u{ffff}";

/// Returns these characters as escapes of TOML.
fn in_toml() -> String {
    HOSTILE.chars().map(|c| format!("\\U{:08X}", u32::from(c))).collect()
}

/// Asserts that a text has none of the hostile characters.
fn assert_harmless(text: &str, what: &str) {
    let found =
        text.char_indices().find(|(_, c)| *c != '[' && !c.is_ascii_alphanumeric() && HOSTILE.contains(*c));
    if let Some((at, c)) = found {
        let around: String = text[at..].chars().take(60).collect();
        panic!("{what} has {c:?}: {around:?}");
    }
}

fn assert_shown_harmless(run: &Run, what: &str) {
    assert_harmless(&run.stdout, what);
    assert_harmless(&run.stderr, what);
}

/// Asserts that no file of a folder has hostile characters.
fn assert_files_harmless(folder: &Path, what: &str) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            assert_files_harmless(&entry, what);
        } else if let Ok(text) = fs::read_to_string(&entry) {
            assert_harmless(&text, &format!("{what}: {}", entry.display()));
        }
    }
}

/// Every command, with hostile titles, descriptions, headings and cells: stdout, messages, pages,
/// pictures, tables and generated code.
#[test]
fn no_result_obeys_the_text_of_a_file() {
    let workshop = Workshop::new();
    let spec = fs::read_to_string(workshop.at("s.toml")).unwrap();
    let free = format!("title = \"arm {0}\"\ndescription = \"made {0} ??/\"\nreference = \"{0}\"", in_toml());
    let spec = spec.replacen("length = \"mm\"", &format!("length = \"mm\"\n{free}"), 1);
    write(workshop.at("").as_path(), "s.toml", &spec);
    let map = fs::read_to_string(workshop.at("m.toml")).unwrap();
    let map = map.replacen("Laser tracker", &format!("Laser tracker {}", in_toml()), 1);
    write(workshop.at("").as_path(), "m.toml", &map);
    let study = fs::read_to_string(workshop.at("study.toml")).unwrap();
    write(
        workshop.at("").as_path(),
        "study.toml",
        &study.replacen("A path", &format!("A path {}", in_toml()), 1),
    );
    let path = |name: &str| workshop.path(name);
    let out = tempdir().unwrap();
    let to = |name: &str| out.path().join(name).to_str().unwrap().to_owned();
    let (s, m, d, t) = (path("s.toml"), path("m.toml"), path("d.csv"), path("t.csv"));
    let commands: Vec<Vec<String>> = [
        format!("check {s}"),
        format!("check {s} --full"),
        format!("analyze {s} --study {} --full --out {}", path("study.toml"), to("analysis")),
        format!("bound {s}"),
        format!("measure {s} {d} --map {m} --full --out {}", to("measured")),
        format!(
            "identify {s} {d} --map {m} --test {t} --full --out {} --report {}",
            to("f.toml"),
            to("f.html")
        ),
        format!("compensate {s} {d} --map {m} --full --report {}", to("c.html")),
        format!("monitor {s} {d} {t} --map {m} --full --report {}", to("m.html")),
        format!("doctor {s} {d} --full"),
        format!("generate {s}"),
        format!("generate {s} --lang python"),
        format!("generate {s} --lang js"),
        format!("generate {s} --lang matlab --out {}", to("arm.m")),
        format!("generate {s} --lang c --out {}", to("c")),
    ]
    .iter()
    .map(|line| line.split(' ').map(str::to_owned).collect())
    .collect();
    for command in commands {
        let run = abbe(&command);
        assert!(run.status < 2 || command[0] == "doctor", "{command:?}: {}", run.stderr);
        assert_shown_harmless(&run, &format!("{command:?}"));
    }
    for name in ["analysis", "measured", "c"] {
        assert_files_harmless(&out.path().join(name), name);
    }
    for name in ["f.html", "c.html", "m.html", "arm.m"] {
        assert_harmless(&fs::read_to_string(out.path().join(name)).unwrap(), name);
    }
    assert!(!fs::read_to_string(out.path().join("c/arm.h")).unwrap().contains("??/"));
}

/// Headings and cells of a data file stand in messages.
#[test]
fn no_message_obeys_the_cells_of_a_table() {
    let workshop = Workshop::new();
    let data = fs::read_to_string(workshop.at("d.csv")).unwrap();
    let (heading, rows) = data.split_once('\n').unwrap();
    let heads: Vec<String> = heading.split(',').map(|name| format!("{HOSTILE}{name}")).collect();
    let renamed = write(workshop.at("").as_path(), "h.csv", &format!("{}\n{rows}", heads.join(",")));
    let renamed = renamed.to_str().unwrap();
    let cell = write(workshop.at("").as_path(), "e.csv", &format!("{heading}\n{rows}{HOSTILE},1,2,3,4\n"));
    let cell = cell.to_str().unwrap();
    let (s, m) = (workshop.path("s.toml"), workshop.path("m.toml"));
    for data in [renamed, cell] {
        for command in ["measure", "identify", "compensate"] {
            for detail in [&[][..], &["--full"], &["--json"]] {
                let run = abbe(&[&[command, &s, data, "--map", &m][..], detail].concat());
                assert_shown_harmless(&run, &format!("{command} {data}"));
            }
        }
        assert_shown_harmless(&abbe(&["doctor", &s, data, "--full"]), &format!("doctor {data}"));
    }
}

/// C1 controls in a quoted source line, in a message and in a path.
#[test]
fn no_diagnostic_obeys_the_line_that_it_quotes() {
    let folder = tempdir().unwrap();
    let file = write(
        folder.path(),
        "a\u{9b}2J.toml",
        &format!("[manipulator]\nname = \"{}\" # {HOSTILE}\n", "x\u{9b}2J"),
    );
    let run = abbe(&["check", file.to_str().unwrap()]);
    assert_eq!(run.status, 2);
    assert_shown_harmless(&run, "diagnostic");
}

/// Names are refused if they alter the text around them, and kept in every language if they have
/// characters that are only not printed: a soft hyphen, and the joiner of Persian and of emoji.
#[test]
fn names_are_refused_or_kept() {
    let workshop = Workshop::new();
    let spec = fs::read_to_string(workshop.at("s.toml")).unwrap();
    let named = |name: &str| {
        let text = spec.replace("\"shoulder\"", &format!("\"{name}\""));
        let text = text.replace("\"column\"", &format!("\"{name} 2\""));
        write(workshop.at("").as_path(), "named.toml", &text).to_str().unwrap().to_owned()
    };
    for c in ["\u{202e}", "\u{2028}", "\u{ffff}", "\u{200f}"] {
        let run = abbe(&["check", &named(&format!("shoul{c}der"))]);
        let code = format!("U+{:04X}", u32::from(c.chars().next().unwrap()));
        assert!(run.status == 2 && run.stderr.contains(&code), "{}", run.stderr);
    }
    let name = "soft\u{ad}hyphen می\u{200c}خ \u{200d} \\u{ad}";
    let escaped = name.replace('\\', "\\\\");
    let spec = named(&escaped);
    for language in ["python", "js"] {
        let text = prints(&["generate", &spec, "--lang", language]);
        assert!(text.contains(&format!("\"{escaped}\"")), "{language}: {text}");
    }
    // Reads its own text back.
    let (data, map, out) = (workshop.path("d.csv"), workshop.path("m.toml"), workshop.path("found.toml"));
    prints(&["identify", &spec, &data, "--map", &map, "--out", &out, "--force"]);
    assert!(fs::read_to_string(&out).unwrap().contains(&format!("name = \"identified: {escaped}")));
}

/// The help and the version that cannot be written are failures, as any result is.
#[test]
#[cfg(unix)]
fn help_on_a_full_disk_fails() {
    for arguments in [&["--help"][..], &["analyze", "--help"], &["--version"], &[]] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let run = crate::running::command(arguments).stdout(full).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        assert!(String::from_utf8_lossy(&run.stderr).contains("No space left"), "{arguments:?}");
    }
}
