//! `abbe allocate`: the first screen, the file that it writes, and what it refuses.

use std::path::Path;

use serde_json::Value;
use tempfile::tempdir;

use crate::bad_input::refused;
use crate::running::{abbe, full, json, write};

#[test]
fn the_written_spec_is_met() {
    let folder = tempdir().unwrap();
    let study = Path::new(env!("CARGO_MANIFEST_DIR")).join("../manipulators/studies/pps.toml");
    let study = study.to_str().unwrap();
    let worst_case = std::fs::read_to_string(study).unwrap().replace("criterion = \"rss\"", "");
    let worst_case = write(folder.path(), "worst.toml", &worst_case);
    for study in [study, worst_case.to_str().unwrap()] {
        let spec = folder.path().join("improved.toml");
        let spec = spec.to_str().unwrap();
        let outcome = abbe(&["allocate", "pps", "--study", study, "--out", spec, "--force"]);
        assert!(outcome.stdout.contains("kept"), "{}", outcome.stdout);
        let judged = abbe(&["analyze", spec, "--study", study, "--check"]);
        assert_eq!(judged.status, 0, "{}", judged.stdout);
        assert!(judged.stdout.contains(": MET"), "{}", judged.stdout);
        let again = json(&["allocate", spec, "--study", study, "--json"]);
        assert!(again["sources"].as_array().unwrap().iter().all(|source| source["factor"] == 1.0));
    }
}

#[test]
fn the_options_keep_the_tolerance() {
    let text = full(&["allocate", "pps"]);
    let options = text.lines().filter_map(|line| line.trim().strip_prefix("--scale "));
    let options = options.map(|option| format!("--scale={}", option.trim_matches('"')));
    let options: Vec<String> = options.collect();
    assert_eq!(options.len(), 4, "{text}");
    let arguments: Vec<&str> =
        ["analyze", "pps", "--check"].into_iter().chain(options.iter().map(String::as_str)).collect();
    assert_eq!(abbe(&arguments).status, 0);
}

#[test]
fn it_refuses_what_it_cannot_do() {
    refused(&["allocate", "machine3"], &["there is no tolerance to keep"]);
    refused(&["allocate", "pps", "--tolerance", "1 nm", "--disable", "nothing"], &["nothing"]);
    let folder = tempdir().unwrap();
    let study = "[study]\ntitle = \"Corrected\"\ntolerance = \"0.5 mm\"\n[workspace.joints]\nsamples = 9\n[compensation]\ndefault = 0.1\n";
    let study = write(folder.path(), "corrected.toml", study);
    refused(&["allocate", "pps", "--study", study.to_str().unwrap()], &["judges the compensated machine"]);
    let one: Value = json(&["allocate", "pps", "--tolerance", "20 mm", "--json"]);
    assert!(one["active"].as_object().unwrap().is_empty() && one["one_factor"] == 1.0);
}
