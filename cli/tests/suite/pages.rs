//! The pages of `identify`, `compensate` and `measure`: complete in themselves, and the same every time.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::report::is_alone;
use crate::running::{abbe, prints};

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
            ["identify", "pps", &data, "--map", "pps", "--report", path(&page), "--date", "21 November"];
        let compensate = ["compensate", "pps", &data, "--map", "pps", "--report", path(&page)];
        for (arguments, expected) in [
            (
                &identify[..],
                &[
                    "Date as given: 21 November",
                    "Errors in space",
                    "Over each joint",
                    "Ranges",
                    "cannot be told apart",
                ][..],
            ),
            (&compensate[..], &["Distance over each joint", "Corrections of the joints", "commands"][..]),
        ] {
            let written = || {
                // 1: some commands are at a limit, and not corrected.
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
    prints(&["measure", "pps", &data, "--map", "pps", "--out", path(&out), "--date", "2026-11-21"]);
    let text = fs::read_to_string(out.join("report.html")).unwrap();
    is_alone(&text);
    for expected in
        ["Instrument", "Over each joint", "Errors in space", "SHA-256", "Date as given: 2026-11-21"]
    {
        assert!(text.contains(expected), "{expected}");
    }
}
