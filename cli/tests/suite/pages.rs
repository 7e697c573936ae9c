//! The pages of `identify`, `compensate` and `measure`: self-contained and reproducible.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::tempdir;

use crate::report::is_alone;
use crate::running::{abbe, full, json, narrow, prints};

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

fn simulated(folder: &Path, samples: &str) -> String {
    let data = path(&folder.join("data.csv")).to_owned();
    prints(&["simulate", "pps", "--map", "pps", "--samples", samples, "--seed", "3", "--out", &data]);
    data
}

#[test]
fn pages_say_what_they_rest_on_and_are_the_same_every_time() {
    for samples in ["40", "1500"] {
        let folder = tempdir().unwrap();
        let data = simulated(folder.path(), samples);
        let page = folder.path().join("page.html");
        let identify =
            ["identify", "pps", &data, "--map", "pps", "--report", path(&page), "--date", "2026-11-21"];
        let compensate = ["compensate", "pps", &data, "--map", "pps", "--report", path(&page)];
        for (arguments, expected) in [
            (
                &identify[..],
                &[
                    "<th scope=\"row\">Date</th><td>2026-11-21</td>",
                    "Residuals in space",
                    "By joint",
                    "Fitted ranges",
                    "Indistinguishable errors",
                ][..],
            ),
            (&compensate[..], &["Position error by joint", "Joint corrections", "commands"][..]),
        ] {
            let written = || {
                // Status 1: some commands are at a limit and not corrected.
                assert!(abbe(arguments).status <= 1);
                fs::read_to_string(&page).unwrap()
            };
            let text = written();
            is_alone(&text);
            for expected in expected.iter().chain(&["SHA-256", "data.csv"]) {
                assert!(text.contains(expected), "{expected}");
            }
            assert!(text == written(), "another page the second time");
            if arguments[0] == "identify" {
                assert_eq!(text.contains("One in "), samples == "1500");
            }
        }
    }
}

#[test]
fn a_measuring_report_has_its_instrument_and_files() {
    let folder = tempdir().unwrap();
    let data = simulated(folder.path(), "40");
    let out = folder.path().join("out");
    full(&["measure", "pps", &data, "--map", "pps", "--out", path(&out), "--date", "2026-11-21"]);
    let text = fs::read_to_string(out.join("report.html")).unwrap();
    is_alone(&text);
    for expected in ["Instrument", "By joint", "Accuracy: errors in space", "SHA-256", "<td>2026-11-21</td>"]
    {
        assert!(text.contains(expected), "{expected}");
    }
}

/// Returns the sentences of a printed report, without its titles and tables.
fn sentences(text: &str) -> Vec<String> {
    let mut paragraphs = vec![String::new()];
    for line in text.lines() {
        let is_table = line.starts_with("   ") || line.trim_start().contains("  ");
        let is_title = line.len() < 50 && !line.ends_with('.');
        match paragraphs.last_mut() {
            Some(paragraph) if !is_table && !is_title => *paragraph += &format!("{} ", line.trim_start()),
            _ => paragraphs.push(String::new()),
        }
    }
    let sentences = paragraphs.iter().flat_map(|paragraph| paragraph.trim_end().split_inclusive(". "));
    let sentences = sentences.map(|sentence| sentence.trim().trim_start_matches("- "));
    sentences.filter(|sentence| sentence.ends_with('.')).map(str::to_owned).collect()
}

/// Returns the words of a page as a reader sees them.
fn words(page: &str) -> String {
    let mut words = String::new();
    for part in page.split('<').skip(1) {
        let (tag, text) = part.split_once('>').unwrap_or((part, ""));
        let is_inline = ["sub", "/sub", "i", "/i", "b", "/b"].contains(&tag);
        words += if is_inline { "" } else { " " };
        words += text;
    }
    let words = words.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_sentence_of_a_report_is_on_its_page() {
    let folder = tempdir().unwrap();
    let data = simulated(folder.path(), "40");
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (page, again, moved) = (at("page.html"), at("again.csv"), at("moved.csv"));
    prints(&["simulate", "pps", &data, "--map", "pps", "--seed", "4", "--out", &again]);
    prints(&["simulate", "pps", &data, "--map", "pps", "--disable", "assembly", "--out", &moved]);
    for arguments in [
        &["analyze", "pps", "--monte-carlo", "100", "--out", &at("analysis")][..],
        &["analyze", "scara", "--out", &at("arm")],
        &["measure", "pps", &data, "--map", "pps", "--accept", "mean 9 mm", "--out", &at("measured")],
        &["identify", "pps", &data, "--map", "pps", "--report", &page],
        &["identify", "pps", &data, "--map", "pps", "--terms", "joint", "--report", &page],
        &["compensate", "pps", &data, "--map", "pps", "--report", &page],
        &["monitor", "pps", &data, &again, &data, "--map", "pps", "--report", &page],
        &["monitor", "pps", &data, &again, &moved, "--map", "pps", "--tolerance", "9mm", "--report", &page],
    ] {
        let text = abbe(&[arguments, &["--full"]].concat()).stdout;
        narrow(&text);
        let out = Path::new(arguments[arguments.len() - 1]);
        let page = if out.is_dir() { out.join("report.html") } else { out.to_owned() };
        let shown = words(&fs::read_to_string(page).unwrap());
        let sentences = sentences(&text);
        assert!(sentences.len() > 1, "{text}");
        for sentence in sentences {
            assert!(shown.contains(&sentence), "{arguments:?}: {sentence}");
        }
    }
}

/// Entries of a record, and their titles on a page.
const RECORD: [(&str, &str, &str); 6] = [
    ("date", "Date", "2026-11-21"),
    ("operator", "Operator", "A. Operator"),
    ("machine", "Machine", "Cell 3, left arm"),
    ("serial", "Serial number", "4711 <b>"),
    ("instrument", "Instrument", "Laser tracker T1"),
    ("certificate", "Calibration certificate", "K-2026-0815"),
];

#[test]
fn a_record_is_in_each_view_of_a_report() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (data, map, page) = (simulated(folder.path(), "40"), at("map.toml"), at("page.html"));
    let entries = RECORD.map(|(key, _, text)| format!("{key} = \"{text}\"\n")).concat();
    let shipped = include_str!("../../../manipulators/maps/pps.toml");
    fs::write(&map, format!("{shipped}\n[record]\n{entries}")).unwrap();
    let out = at("out");
    for arguments in [
        &["measure", "pps", &data, "--map", &map, "--accept", "mean 9 mm", "--out", &out][..],
        &["identify", "pps", &data, "--map", &map, "--accept", "mean 9 mm", "--report", &page],
        &["compensate", "pps", &data, "--map", &map, "--report", &page],
        &["monitor", "pps", &data, &data, &data, "--map", &map, "--report", &page],
    ] {
        let text = abbe(&[arguments, &["--full"]].concat()).stdout;
        let report: Value = serde_json::from_str(&abbe(&[arguments, &["--json"]].concat()).stdout).unwrap();
        let page = if arguments[0] == "measure" { at("out/report.html") } else { page.clone() };
        let html = fs::read_to_string(page).unwrap();
        for (key, title, entry) in RECORD {
            assert_eq!(report["record"][key], entry);
            assert!(text.contains(&format!("{title:<25}{entry}\n")), "{key}: {text}");
            let cell = entry.replace('<', "&lt;").replace('>', "&gt;");
            assert!(html.contains(&format!("<th scope=\"row\">{title}</th><td>{cell}</td>")), "{key}");
        }
        // Who signs it can trace it to its source.
        assert_eq!(report["record"]["abbe"], env!("ABBE_VERSION"));
        assert!(html.contains(concat!("<p>Written by abbe ", env!("ABBE_VERSION"), ". ")));
        assert_eq!(html.contains("<p>Signature</p>"), arguments.contains(&"--accept"), "{arguments:?}");
        let later = abbe(&[arguments, &["--date", "2026-11-22 08:30", "--json"]].concat());
        assert!(later.stdout.contains("\"date\":\"2026-11-22 08:30\""), "{}", later.stdout);
    }
}

#[test]
fn dates_are_checked() {
    let data = ["nothing.csv", "--map", "pps"];
    for arguments in [
        &["analyze", "pps"][..],
        &["merge", "1.part"],
        &[&["measure", "pps"], &data[..]].concat(),
        &[&["identify", "pps"], &data[..]].concat(),
        &[&["compensate", "pps"], &data[..]].concat(),
        &[&["monitor", "pps"], &data[..]].concat(),
    ] {
        let refused = abbe(&[arguments, &["--date", "banana"]].concat());
        assert_eq!(refused.status, 2, "{arguments:?}");
        let expected = "expected a date such as 2026-03-14";
        assert!(refused.stderr.contains(expected), "{}", refused.stderr);
    }
    let dated = json(&["analyze", "pps", "--date", "2026-11-21", "--json"]);
    assert_eq!(dated["record"]["date"], "2026-11-21");
}

#[test]
fn pages_name_the_options_of_their_figures() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (data, page, out) = (simulated(folder.path(), "40"), at("page.html"), at("out"));
    let changes = ["--set", "x=10mm", "--disable", "assembly"];
    let named = [("set", "x=10mm"), ("disable", "assembly")];
    for (arguments, options) in [
        (
            &["analyze", "pps", "--monte-carlo", "50", "--seed", "7", "--out", &out][..],
            &[("monte-carlo", "50"), ("seed", "7")][..],
        ),
        (
            &[
                "measure",
                "pps",
                &data,
                "--map",
                "pps",
                "--station",
                "new",
                "--accept",
                "mean 9 mm",
                "--out",
                &out,
            ],
            &[("station", "new"), ("accept", "mean 9 mm")],
        ),
        (
            &[
                "identify",
                "pps",
                &data,
                "--map",
                "pps",
                "--robust",
                "huber",
                "--terms",
                "joint",
                "--harmonics",
                "q4=1,2",
                "--folds",
                "5",
                "--report",
                &page,
            ],
            &[
                ("robust", "huber"),
                ("terms", "joint"),
                ("harmonics", "q4=1,2"),
                ("folds", "5"),
                ("prior", "auto"),
            ],
        ),
        (
            &["compensate", "pps", &data, "--map", "pps", "--tolerance", "0.01mm", "--report", &page],
            &[("tolerance", "0.01 mm")],
        ),
        (
            &[
                "monitor",
                "pps",
                &data,
                &data,
                &data,
                "--map",
                "pps",
                "--since",
                "1",
                "--false-alarm",
                "500",
                "--report",
                &page,
            ],
            &[("since", "1"), ("false-alarm", "500")],
        ),
    ] {
        // Status 1: some commands are at a limit and not corrected.
        let run = abbe(&[arguments, &changes].concat());
        assert!(run.status <= 1, "{}", run.stderr);
        let page = if arguments.contains(&"--out") { at("out/report.html") } else { page.clone() };
        let html = fs::read_to_string(page).unwrap();
        for (name, value) in named.iter().chain(options) {
            let row = format!("<th scope=\"row\">{name}</th><td>{value}</td>");
            assert!(html.contains(&row), "{arguments:?}: {row}");
        }
    }
}

#[test]
fn the_errors_of_rows_have_their_units() {
    let folder = tempdir().unwrap();
    let data = simulated(folder.path(), "40");
    let out = folder.path().join("out");
    prints(&["measure", "pps", &data, "--map", "pps", "--out", path(&out)]);
    let errors = fs::read_to_string(out.join("errors.csv")).unwrap();
    assert!(errors.starts_with("line,x (mm),y (mm),z (mm)"), "{errors}");
}
