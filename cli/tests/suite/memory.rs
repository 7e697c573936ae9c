//! Memory per row of measurements: the difference between a long and a short file. Unlike time,
//! memory does not depend on the computer.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use abbe_tests::thorough;
use nix::sys::resource::{UsageWho, getrusage};
use tempfile::tempdir;

use crate::running::{UR5_MAP, command, prints, shipped, write};

/// Rows of the two files.
const ROWS: [usize; 2] = [5_000, 45_000];

/// Environment variable with the words of a command, one a line, whose peak memory is measured.
const MEASURED: &str = "ABBE_TEST_MEASURED";

/// Runs a command in a process that has no other children, so that the system reports its peak
/// memory, and prints it in kilobytes.
#[test]
fn one_command_is_measured() {
    let Ok(words) = std::env::var(MEASURED) else { return };
    let words: Vec<&str> = words.lines().collect();
    let status = command(&words).stdout(Stdio::null()).stderr(Stdio::null()).status().unwrap();
    assert!(status.code().is_some_and(|code| code < 2), "{words:?}: {status}");
    let peak = getrusage(UsageWho::RUSAGE_CHILDREN).unwrap().max_rss();
    // The memory of this process counts until it is replaced by the command.
    let text = fs::read_to_string("/proc/self/status").unwrap();
    let own = text.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
    assert!(peak > own.unwrap().trim().parse().unwrap(), "{words:?}: {peak} kB, this process {own:?}");
    println!("\npeak {peak} kB");
}

/// Words of a command for a number of rows.
type Words<'w> = &'w dyn Fn(usize) -> Vec<String>;

/// Returns the peak memory of a command in bytes.
fn peak(words: &[&str]) -> f64 {
    let mut measured = Command::new(std::env::current_exe().unwrap());
    measured.args(["memory::one_command_is_measured", "--exact", "--nocapture"]);
    let output = measured.env(MEASURED, words.join("\n")).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let peak = text.lines().find_map(|line| line.strip_prefix("peak ")?.strip_suffix(" kB"));
    let peak = peak.unwrap_or_else(|| panic!("{text}\n{}", String::from_utf8_lossy(&output.stderr)));
    1024.0 * peak.parse::<f64>().unwrap()
}

/// Returns the bytes per additional row.
fn bytes_per_row(words: impl Fn(usize) -> Vec<String>) -> f64 {
    let [few, many] = ROWS.map(|rows| {
        let mut words = words(rows);
        // With more threads, what is stored depends on their lead over the writer.
        words.extend(["--threads".to_owned(), "1".to_owned()]);
        peak(&words.iter().map(String::as_str).collect::<Vec<_>>())
    });
    (many - few) / (ROWS[1] - ROWS[0]) as f64
}

fn data(folder: &Path, rows: usize) -> String {
    folder.join(format!("{rows}.csv")).to_str().unwrap().to_owned()
}

/// Writes the first twenty rows of a file repeatedly, twenty-five times per day, each slightly
/// higher.
fn visited_again(folder: &Path, rows: usize) -> String {
    let text = fs::read_to_string(data(folder, rows)).unwrap();
    let mut lines = text.lines();
    let mut checks = format!("day,{}\n", lines.next().unwrap());
    let places: Vec<(&str, f64)> = lines
        .take(20)
        .map(|line| line.rsplit_once(',').unwrap())
        .map(|(q, z)| (q, z.parse().unwrap()))
        .collect();
    for i in 0..rows {
        let (first, z) = places[i % places.len()];
        checks += &format!("{},{first},{}\n", i / 500, z + 1e-3 * (i as f64).sin());
    }
    write(folder, &format!("again-{rows}.csv"), &checks).to_str().unwrap().to_owned()
}

/// The limits hold for a million rows, too, where freed memory is reused. An ordinary run has a
/// command that stores nothing and one that stores its rows.
#[test]
fn rows_are_small() {
    let folder = tempdir().unwrap();
    let map = write(folder.path(), "map.toml", UR5_MAP);
    let spec = write(folder.path(), "arm.toml", shipped("ur5"));
    let [map, spec] = [&map, &spec].map(|path| path.to_str().unwrap());
    let out = folder.path().join("out.csv");
    let out = out.to_str().unwrap();
    for rows in ROWS {
        let count = rows.to_string();
        let file = data(folder.path(), rows);
        prints(&["simulate", spec, "--map", map, "--samples", &count, "--out", &file]);
    }
    let own = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect::<Vec<String>>();
    let on = |command: &str, rows, more: &[&str]| {
        own(&[&[command, spec, &data(folder.path(), rows), "--map", map], more].concat())
    };
    let samples = |rows: usize| {
        own(&["simulate", spec, "--map", map, "--samples", &rows.to_string(), "--out", out, "--force"])
    };
    let days = UR5_MAP.replace("[data]\n", "[data]\ntime = \"day\"\n");
    let days = write(folder.path(), "days.toml", &days).to_str().unwrap().to_owned();
    let monitored = |rows| own(&["monitor", spec, &visited_again(folder.path(), rows), "--map", &days]);
    let tested = |rows| on("identify", rows, &["--test", &data(folder.path(), rows)]);
    let written = ["--out", out, "--force"];
    let commands: [(&str, Words<'_>, f64); 8] = [
        // Nothing is stored: a row that were would need more than 100.
        ("simulate --samples", &samples, 60.0),
        ("measure", &|rows| on("measure", rows, &[]), 270.0),
        ("simulate", &|rows| on("simulate", rows, &written), 180.0),
        ("compensate", &|rows| on("compensate", rows, &written), 260.0),
        ("identify", &|rows| on("identify", rows, &[]), 240.0),
        ("identify --robust", &|rows| on("identify", rows, &["--robust", "tukey"]), 280.0),
        ("identify --test", &tested, 390.0),
        ("monitor", &monitored, 270.0),
    ];
    let found = commands
        .into_iter()
        .take(if thorough() { 8 } else { 2 })
        .map(|(name, words, most)| (name, bytes_per_row(words), most))
        .collect::<Vec<_>>();
    for (name, bytes, _) in &found {
        println!("{name}: {bytes:.0} bytes a row");
    }
    for (name, bytes, most) in found {
        assert!(bytes < most, "{name}: {bytes} bytes a row, not {most}");
    }
}
