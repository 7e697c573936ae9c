//! Output files: inputs and files of others stay unchanged, and files are written completely or not
//! at all.

use std::fs;
#[cfg(unix)]
use std::path::Path;

#[cfg(unix)]
use rand::{RngExt, SeedableRng};
#[cfg(unix)]
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::running::{Run, abbe, command, prints};
#[cfg(unix)]
use crate::workshop::PATH;
use crate::workshop::{FILES, WRITING, Workshop, contents, in_folder};

fn run(workshop: &Workshop, line: &str, out: &str, more: &[&str]) -> Run {
    let mut words = workshop.words(line);
    words.push(out.to_owned());
    words.extend(more.iter().map(|word| (*word).to_owned()));
    abbe(&words)
}

fn refused(run: &Run, why: &str) {
    assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    assert!(run.stderr.contains(why) && run.stderr.contains("help: "), "{}", run.stderr);
}

#[cfg(unix)]
fn link(to: &Path, from: &Path, hard: bool) {
    let _ = fs::remove_file(from);
    if hard { fs::hard_link(to, from).unwrap() } else { std::os::unix::fs::symlink(to, from).unwrap() }
}

#[test]
#[cfg(unix)]
fn no_command_writes_over_what_it_reads() {
    let workshop = Workshop::new();
    let before = FILES.map(|name| fs::read(workshop.at(name)).unwrap());
    fs::create_dir(workshop.at("sub")).unwrap();
    fs::create_dir(workshop.at("folder")).unwrap();
    for (line, inputs) in WRITING {
        for input in inputs {
            let (direct, around) = (workshop.path(input), workshop.path(&format!("sub/../{input}")));
            let linked = in_folder(line).map_or("link".to_owned(), |file| format!("folder/{file}"));
            let linked = workshop.path(&linked);
            for (how, out) in [&direct, &around, &linked, &linked].into_iter().enumerate() {
                if how >= 2 {
                    link(&workshop.at(input), Path::new(&linked), how == 2);
                } else if in_folder(line).is_some() {
                    continue;
                }
                let out = if in_folder(line).is_some() { workshop.path("folder") } else { out.clone() };
                refused(&run(&workshop, line, &out, &["--force"]), "an input of the command");
            }
            let _ = fs::remove_file(&linked);
        }
    }
    assert!(FILES.map(|name| fs::read(workshop.at(name)).unwrap()) == before);
    assert_eq!(contents(workshop.0.path()).len(), FILES.len(), "nothing else is there");
}

#[test]
fn the_map_beside_a_found_spec_is_not_that_of_the_run() {
    let workshop = Workshop::new();
    fs::copy(workshop.at("m.toml"), workshop.at("x.map.toml")).unwrap();
    let before = contents(workshop.0.path());
    for out in ["x", "x.toml"] {
        let run = run(&workshop, "identify s.toml d.csv --map x.map.toml --out", &workshop.path(out), &[]);
        refused(&run, "this file is an input of the command");
        assert!(run.stderr.contains("x.map.toml"), "{}", run.stderr);
    }
    // A map of the user is not replaced, and the spec is not written without its map.
    refused(
        &run(&workshop, "identify s.toml d.csv --map m.toml --out", &workshop.path("x.toml"), &[]),
        "abbe did not write this file",
    );
    assert!(contents(workshop.0.path()) == before);
    refused(
        &run(
            &workshop,
            "compensate s.toml d.csv --map m.toml --out x.html --report",
            &workshop.path("x.html"),
            &[],
        ),
        "two outputs",
    );
    assert!(contents(workshop.0.path()) == before);
}

#[test]
fn what_abbe_did_not_write_needs_force() {
    let workshop = Workshop::new();
    for (line, _) in WRITING {
        let (out, file) = match in_folder(line) {
            Some(name) => (workshop.path("out"), workshop.at("out").join(name)),
            None => (workshop.path("out.x"), workshop.at("out.x")),
        };
        let done = |run: Run| assert!(run.status <= 1, "{line}: {}", run.stderr);
        // Repeated runs replace their own files without asking.
        done(run(&workshop, line, &out, &[]));
        done(run(&workshop, line, &out, &[]));
        let written = fs::read(&file).unwrap();
        // Changed by hand: a plan with measured values, a corrected spec.
        fs::write(&file, [&written[..], b"\nby hand\n"].concat()).unwrap();
        let before = contents(workshop.0.path());
        refused(&run(&workshop, line, &out, &[]), "was changed since");
        assert!(contents(workshop.0.path()) == before, "{line}");
        done(run(&workshop, line, &out, &["--force"]));
        assert!(fs::read(&file).unwrap() == written, "{line}");
        done(run(&workshop, line, &out, &[]));
        // An empty file may be replaced: `mktemp` creates one.
        fs::write(&file, "").unwrap();
        done(run(&workshop, line, &out, &[]));
        for name in ["out.x", "out.map.toml", "out"] {
            let _ = fs::remove_file(workshop.at(name));
            let _ = fs::remove_dir_all(workshop.at(name));
        }
    }
}

#[test]
fn a_folder_of_somebodys_is_left_alone() {
    let workshop = Workshop::new();
    for line in ["measure s.toml d.csv --map m.toml --out", "analyze s.toml --study study.toml --out"] {
        fs::create_dir(workshop.at("mine")).unwrap();
        fs::write(workshop.at("mine/thesis.tex"), "ten years").unwrap();
        let before = contents(workshop.0.path());
        refused(&run(&workshop, line, &workshop.path("mine"), &[]), "abbe wrote none of them");
        assert!(contents(workshop.0.path()) == before);
        refused(&run(&workshop, line, &workshop.path("d.csv"), &["--force"]), "not a folder");
        refused(&run(&workshop, line, "-", &["--force"]), "not a folder");
        assert!(contents(workshop.0.path()) == before);
        assert_eq!(run(&workshop, line, &workshop.path("mine"), &["--force"]).status, 0);
        assert_eq!(fs::read_to_string(workshop.at("mine/thesis.tex")).unwrap(), "ten years");
        fs::remove_dir_all(workshop.at("mine")).unwrap();
        // An empty folder may be used, and a failed job creates none.
        fs::create_dir(workshop.at("mine")).unwrap();
        assert_eq!(run(&workshop, line, &workshop.path("mine"), &[]).status, 0);
        fs::remove_dir_all(workshop.at("mine")).unwrap();
    }
}

#[test]
#[cfg(unix)]
fn links_are_followed_and_modes_kept() {
    use std::os::unix::fs::PermissionsExt;
    let workshop = Workshop::new();
    let code = prints(&workshop.words("generate s.toml"));
    let mode = |name: &str| fs::metadata(workshop.at(name)).unwrap().permissions().mode() & 0o7777;
    let set = |name: &str, mode: u32| {
        fs::set_permissions(workshop.at(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    let generate = |out: &str, more: &[&str]| run(&workshop, "generate s.toml --out", out, more);
    fs::create_dir(workshop.at("elsewhere")).unwrap();
    link(Path::new("elsewhere/arm.rs"), &workshop.at("link.rs"), false);
    link(Path::new("link.rs"), &workshop.at("again.rs"), false);
    // A new file, and existing files of different modes.
    for expected in [None, Some(0o600), Some(0o664), Some(0o755)] {
        if let Some(mode) = expected {
            set("elsewhere/arm.rs", mode);
        }
        assert_eq!(generate(&workshop.path("again.rs"), &[]).status, 0);
        assert!(workshop.at("again.rs").is_symlink() && workshop.at("link.rs").is_symlink());
        assert_eq!(fs::read_to_string(workshop.at("elsewhere/arm.rs")).unwrap(), code);
        assert!(expected.is_none_or(|expected| mode("elsewhere/arm.rs") == expected));
    }
    set("elsewhere/arm.rs", 0o444);
    refused(&generate(&workshop.path("link.rs"), &[]), "this file is read-only");
    assert_eq!(generate(&workshop.path("link.rs"), &["--force"]).status, 0);
    assert_eq!(mode("elsewhere/arm.rs"), 0o444);
    let around = workshop.path("circle");
    link(Path::new("circle"), &workshop.at("circle"), false);
    assert_eq!(generate(&around, &["--force"]).status, 2);
    refused(&generate(&workshop.path("elsewhere"), &["--force"]), "this is a folder");
    refused(&generate(&workshop.path("nowhere/"), &["--force"]), "this is a folder");
    refused(&generate(&workshop.path("nowhere/arm.rs"), &["--force"]), "create the folder first");
}

#[test]
#[cfg(unix)]
fn what_is_no_file_is_written_through() {
    use std::os::unix::fs::FileTypeExt;
    use std::process::{Command, Stdio};
    let workshop = Workshop::new();
    let data = prints(&workshop.words("plan s.toml --map m.toml --sets plan.toml --json"));
    let plan = |out: &str| {
        let mut words = workshop.words("plan s.toml --map m.toml --sets plan.toml --json --out");
        words.push(out.to_owned());
        words
    };
    // Stdout under all its names; the text goes to stderr instead.
    for out in ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"] {
        let run = abbe(&plan(out));
        assert_eq!((run.status, &run.stdout[..], &run.stderr), (0, PATH, &data), "{out}");
        let file = fs::File::create(workshop.at("redirected")).unwrap();
        assert!(command(&plan(out)).stdout(file).stderr(Stdio::null()).status().unwrap().success());
        assert_eq!(fs::read_to_string(workshop.at("redirected")).unwrap(), PATH, "{out}");
    }
    assert_eq!(abbe(&plan("/dev/null")).stdout, data);
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    if Path::new("/dev/full").exists() {
        let full = abbe(&plan("/dev/full"));
        assert_eq!((full.status, &full.stdout[..]), (2, ""));
        assert!(
            full.stderr.contains("/dev/full") && full.stderr.contains("No space left"),
            "{}",
            full.stderr
        );
    }
    // A pipe with a reader, and one whose reader has gone.
    let pipe = workshop.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for reader in ["cat", "true"] {
        let reading = Command::new("sh")
            .args(["-c", "exec \"$0\" < \"$1\"", reader, &pipe])
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let run = abbe(&plan(&pipe));
        let read = reading.wait_with_output().unwrap();
        if reader == "cat" {
            assert_eq!((run.status, String::from_utf8(read.stdout).unwrap()), (0, PATH.to_owned()));
        } else {
            // The reader may be gone before or after the write; a broken pipe is reported.
            assert!(run.status == 0 || run.stderr.contains("Broken pipe"), "{}", run.stderr);
        }
        assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
    }
    // No map can be written beside a device.
    refused(
        &run(&workshop, "identify s.toml d.csv --map m.toml --out", "/dev/null", &[]),
        "not a regular file",
    );
}

#[test]
fn the_null_device_is_written_to() {
    let workshop = Workshop::new();
    let names: &[&str] = if cfg!(windows) { &["NUL", "nul"] } else { &["/dev/null"] };
    for out in names {
        let run = run(&workshop, "simulate s.toml --map m.toml --samples 3 --out", out, &[]);
        assert_eq!(run.status, 0, "{}", run.stderr);
    }
    assert_eq!(contents(workshop.0.path()).len(), FILES.len(), "nothing else is there");
}

/// Simulates a full disk by a limit on the size of files.
#[test]
#[cfg(unix)]
fn a_full_disk_leaves_the_old_file() {
    let workshop = Workshop::new();
    let out = workshop.path("out.csv");
    let line = "simulate s.toml --map m.toml --samples 3 --out";
    assert_eq!(run(&workshop, line, &out, &[]).status, 0);
    let before = contents(workshop.0.path());
    let words = workshop.words("simulate s.toml --map m.toml --samples 9000 --out out.csv");
    let limited = std::process::Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 16; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_abbe")])
        .args(words)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&limited.stderr);
    assert_eq!(limited.status.code(), Some(2), "{said}");
    assert!(said.contains("out.csv") && said.contains("cannot write this"), "{said}");
    assert!(contents(workshop.0.path()) == before);
}

#[test]
fn runs_at_once_do_not_disturb_each_other() {
    let workshop = Workshop::new();
    let start = |i: usize| {
        let line = format!(
            "simulate s.toml --map m.toml --samples 50 --seed {i} --out {}",
            ["a.csv", "b.csv"][i % 2]
        );
        command(&workshop.words(&line)).stdout(std::process::Stdio::null()).spawn().unwrap()
    };
    for mut child in (0..12).map(start).collect::<Vec<_>>() {
        assert!(child.wait().unwrap().success());
    }
    assert_eq!(contents(workshop.0.path()).len(), FILES.len() + 2);
    // The file is in the record, whichever run wrote last.
    for i in 0..2 {
        assert!(start(i).wait().unwrap().success());
    }
}

/// Opens an output as a spreadsheet does: it shares reading, or nothing.
#[test]
#[cfg(windows)]
fn what_another_program_has_open_is_named() {
    use std::os::windows::fs::OpenOptionsExt;
    let workshop = Workshop::new();
    let out = workshop.path("out.csv");
    let line = "simulate s.toml --map m.toml --samples 3 --out";
    assert_eq!(run(&workshop, line, &out, &[]).status, 0);
    for (shared, more) in [(1, &[][..]), (1, &["--force"]), (0, &[]), (0, &["--force"])] {
        let open = fs::File::options().read(true).write(true).share_mode(shared).open(&out).unwrap();
        refused(&run(&workshop, line, &out, more), "close the program that has it open");
        drop(open);
    }
    assert_eq!(run(&workshop, line, &out, &[]).status, 0);
}

#[test]
fn names_of_columns_come_back_whatever_they_are() {
    let workshop = Workshop::new();
    let names =
        ["x, measured", "say \"y\"", "z\nbelow", "=cmd|' /C calc'!A0", "#hash", "'=quoted", "+1 a;b;c;d;e;f"];
    let columns = |list: &[&str]| list.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>();
    for start in 0..names.len() {
        let five: Vec<&str> = names.iter().cycle().skip(start).take(5).copied().collect();
        let quoted = columns(&five);
        let map = format!(
            "[data]\ntitle = \"t\"\nuncertainty = \"0.01 mm\"\nbase = \"exact\"\n[joints]\n\
             d1 = {{ column = {}, unit = \"mm\" }}\nq2 = {{ column = {}, unit = \"deg\" }}\n\
             [point]\ncolumns = [{}]\nunit = \"mm\"\n",
            quoted[0],
            quoted[1],
            quoted[2..].join(", ")
        );
        fs::write(workshop.at("odd.toml"), map).unwrap();
        let data = workshop.words("simulate s.toml --map odd.toml --samples 20 --out odd.csv");
        prints(&data);
        let text = fs::read_to_string(workshop.at("odd.csv")).unwrap();
        let heading = csv::Reader::from_reader(text.as_bytes()).headers().unwrap().clone();
        let runs = |cell: &str| cell.starts_with(['=', '+', '-', '@', '\t']);
        assert!(!heading.iter().any(runs), "{text}");
        prints(&workshop.words("measure s.toml odd.csv --map odd.toml"));
        let compensated = abbe(&workshop.words("compensate s.toml odd.csv --map odd.toml --out back.csv"));
        assert!(compensated.status <= 1, "{}", compensated.stderr);
    }
}

/// Random sequences of runs over random files: inputs stay unchanged; without `--force`, so do
/// files of others; a failed run changes nothing.
#[test]
#[cfg(unix)]
fn inputs_are_untouched_and_files_whole_or_not_there() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(12);
    let workshop = Workshop::new();
    fs::create_dir(workshop.at("folder")).unwrap();
    fs::write(workshop.at("mine.txt"), "mine").unwrap();
    link(&workshop.at("d.csv"), &workshop.at("to-data"), false);
    link(&workshop.at("mine.txt"), &workshop.at("to-mine"), false);
    link(&workshop.at("d.csv"), &workshop.at("folder/report.html"), true);
    let outs = [
        "new.x",
        "other.x",
        "mine.txt",
        "to-data",
        "to-mine",
        "folder",
        "d.csv",
        "m.toml",
        "nowhere/x",
        "fresh",
    ];
    let (mut refusals, mut written) = (0, 0);
    for _ in 0..50 {
        let (line, inputs) = WRITING[random.random_range(0..WRITING.len())];
        let out = outs[random.random_range(0..outs.len())];
        let forced = random.random_bool(0.3);
        let read = |name: &&str| fs::read(workshop.at(name)).unwrap();
        let (all, before) = (contents(workshop.0.path()), inputs.iter().map(read).collect::<Vec<_>>());
        // Files of others that were not forced.
        let theirs = FILES.iter().filter(|_| !forced).chain(["mine.txt"].iter().filter(|_| !forced));
        let theirs: Vec<_> = theirs.map(|name| (name, read(name))).collect();
        let run = run(&workshop, line, &workshop.path(out), if forced { &["--force"] } else { &[] });
        assert!(inputs.iter().map(read).eq(before), "{line} {out}");
        theirs.iter().for_each(|(name, content)| assert!(read(name) == *content, "{line} {out}: {name}"));
        if run.status == 2 {
            refusals += 1;
            assert!(contents(workshop.0.path()) == all, "{line} {out}: {}", run.stderr);
        } else {
            written += 1;
            assert!(run.status <= 1, "{line} {out}: {}", run.stderr);
        }
        // Restores files replaced by force; they no longer match the record.
        for (path, content) in &all {
            if FILES.iter().chain(&["mine.txt"]).any(|name| workshop.at(name) == *path) {
                fs::write(path, content).unwrap();
            }
        }
    }
    assert!(refusals >= 10 && written >= 10, "{refusals} {written}");
}
