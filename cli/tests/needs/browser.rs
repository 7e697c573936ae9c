//! A page of every report, live pages, and headless Chromium to open it.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Writes a page of every report.
pub(crate) fn pages(folder: &Path) -> Vec<PathBuf> {
    let run = |line: &str| command(folder, line);
    run("analyze pps --monte-carlo 100 --out analysis");
    run("analyze ur5 --out arm");
    run("simulate pps --map pps --samples 40 --out data.csv");
    run("simulate pps --map pps --samples 40 --seed 1 --out test.csv");
    run("measure pps data.csv --map pps --accept 'mean 9 mm' --out measured");
    run("identify pps data.csv --map pps --test test.csv --report identification.html");
    run("compensate pps data.csv --map pps --report compensation.html");
    run("plan ur5 --map ur5 --optimal 20 --out plan.csv");
    for (seed, day) in (1..).zip(["monday", "tuesday", "wednesday"]) {
        run(&format!("simulate ur5 plan.csv --map ur5 --seed {seed} --out {day}.csv"));
    }
    run("monitor ur5 monday.csv tuesday.csv wednesday.csv --map ur5 --report monitoring.html");
    let pages =
        ["analysis/report", "arm/report", "measured/report", "identification", "compensation", "monitoring"];
    pages.map(|page| folder.join(page).with_extension("html")).to_vec()
}

/// Writes live pages, of one machine and of two.
pub(crate) fn live_pages(folder: &Path) -> Vec<PathBuf> {
    command(folder, "explore pps --out one.html");
    command(folder, "explore ur5 puma560 --out two.html");
    ["one.html", "two.html"].map(|page| folder.join(page)).to_vec()
}

/// Runs a command line of `abbe` in a folder.
pub(crate) fn command(folder: &Path, line: &str) {
    let words = shell_words::split(line).expect("words");
    let run = Command::new(env!("CARGO_BIN_EXE_abbe")).args(words).current_dir(folder).output();
    let run = run.expect("abbe runs");
    assert!(run.status.success(), "{line}: {}", String::from_utf8_lossy(&run.stderr));
}

/// Opens a page and returns what Chromium prints.
pub(crate) fn chromium(folder: &Path, options: &[&str], page: &Path) -> String {
    let output = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu"])
        .args(options)
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg(page)
        .output()
        .expect("chromium runs");
    String::from_utf8_lossy(&output.stdout).into_owned()
}
