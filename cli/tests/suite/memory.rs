//! Memory per row of measurements: the difference between a long and a short file. Unlike time,
//! memory does not depend on the computer.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use tempfile::tempdir;

use crate::running::{UR5_MAP, command, prints, shipped, write};

/// Rows of the two files.
const ROWS: [usize; 2] = [5_000, 45_000];

/// Returns the peak memory of a command in bytes, polled until shortly before its end.
fn peak(words: &[&str]) -> f64 {
    let mut child = command(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut most = 0.0_f64;
    loop {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok());
        most = most.max(1024.0 * kilobytes.unwrap_or_default());
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.code().is_some_and(|code| code < 2), "{words:?}: {status}");
            return most;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Returns the bytes per additional row.
fn bytes_per_row(words: impl Fn(usize) -> Vec<String>) -> f64 {
    let [few, many] = ROWS.map(|rows| {
        let words = words(rows);
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

/// The limits hold for a million rows, too, where freed memory is reused. About 2 MB, or 50 bytes
/// per row, vary with the lead of the threads over the writer.
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
    let on = |command: &str, more: &[&str]| {
        bytes_per_row(
            |rows| own(&[&[command, spec, &data(folder.path(), rows), "--map", map], more].concat()),
        )
    };
    let samples = bytes_per_row(|rows| {
        own(&["simulate", spec, "--map", map, "--samples", &rows.to_string(), "--out", out, "--force"])
    });
    let days = UR5_MAP.replace("[data]\n", "[data]\ntime = \"day\"\n");
    let days = write(folder.path(), "days.toml", &days).to_str().unwrap().to_owned();
    let checked =
        bytes_per_row(|rows| own(&["monitor", spec, &visited_again(folder.path(), rows), "--map", &days]));
    let judged = bytes_per_row(|rows| {
        let file = data(folder.path(), rows);
        own(&["identify", spec, &file, "--map", map, "--test", &file])
    });
    let found = [
        // Nothing is stored: a row that were would need more than 100.
        ("simulate --samples", samples, 60.0),
        ("simulate", on("simulate", &["--out", out, "--force"]), 180.0),
        ("compensate", on("compensate", &["--out", out, "--force"]), 260.0),
        ("measure", on("measure", &[]), 270.0),
        ("identify", on("identify", &[]), 240.0),
        ("identify --robust", on("identify", &["--robust", "tukey"]), 280.0),
        ("identify --test", judged, 390.0),
        ("monitor", checked, 270.0),
    ];
    for (name, bytes, _) in found {
        println!("{name}: {bytes:.0} bytes a row");
    }
    for (name, bytes, most) in found {
        assert!(bytes < most, "{name}: {bytes} bytes a row, not {most}");
    }
}
