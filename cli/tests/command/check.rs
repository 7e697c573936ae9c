//! `abbe check`: what it shows, and its verdict.

use abbe_manipulators::SHIPPED;
use tempfile::tempdir;

use crate::running::{abbe, json, narrow, prints, write};

#[test]
fn every_shipped_manipulator_passes() {
    for shipped in SHIPPED {
        let text = prints(&["check", shipped.name]);
        assert!(!text.contains("FAILS"), "{text}");
        narrow(&text);
    }
}

#[test]
fn it_shows_what_follows_from_a_spec() {
    let text = prints(&["check", "pps"]);
    for word in [
        "Lengths in mm, orientation euler-yzx",
        "0 … 2256 mm",
        "-90 … 90 deg",
        "base rail curvature, signs as printed   repeatable                2   off",
        "22 of 36 can be known from poses",
        "24 of 42 and 21 of 42",
        "sincos",
        "slope of what first order neglects",
    ] {
        let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(squeezed(&text).contains(&squeezed(word)), "{word}\n{text}");
    }
    let report = json(&["check", "pps", "--json"]);
    let ranks =
        report["identifiable"].as_array().unwrap().iter().map(|found| found["rank"].as_u64().unwrap());
    assert_eq!(ranks.collect::<Vec<_>>(), [22, 24, 19, 21]);
    let laws = report["laws"].as_array().unwrap();
    assert_eq!(laws.len(), 7);
    assert!(laws.iter().all(|law| law["holds"] == true));
    assert_eq!(json(&["check", "puma560", "--json"])["identifiable"][0]["rank"], 26);
    assert_eq!(json(&["check", "ur5", "--json"])["identifiable"][1]["rank"], 30);
}

#[test]
fn a_law_that_fails_is_exit_status_1() {
    // Within half of its limits this source has no value.
    let spec = r#"
        [manipulator]
        name = "slide"
        length = "mm"
        [[frame]]
        name = "carriage"
        variable = { name = "d", kind = "prismatic", limits = [-1, 1] }
        transform = "Tx(d)"
        [[source]]
        name = "wear"
        class = "repeatable"
        frame = "carriage"
        e_x = "1 mm * sqrt(d/(1 mm))"
    "#;
    let folder = tempdir().unwrap();
    let path = write(folder.path(), "slide.toml", spec);
    let run = abbe(&["check", path.to_str().unwrap()]);
    assert_eq!(run.status, 1, "{}", run.stderr);
    assert!(run.stdout.contains("FAILS") && run.stdout.contains("not a finite number"), "{}", run.stdout);
    let run = abbe(&["check", path.to_str().unwrap(), "--json"]);
    assert_eq!(run.status, 1);
    assert!(run.stdout.contains("\"holds\":false"));
    // What cannot be evaluated cannot be analyzed, and says where.
    let run = abbe(&["analyze", path.to_str().unwrap()]);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("at d = -0.5 mm: the source \"wear\" has no finite value"), "{}", run.stderr);
}

/// What can be known does not depend on how orientations are written, nor on samples where Euler rows do not exist.
#[test]
fn euler_rows_hide_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let spec = |orientation: &str| {
        let text = format!(
            "[manipulator]\nname = \"arm\"\nlength = \"m\"\norientation = \"{orientation}\"\n\
             [[frame]]\nname = \"roll\"\nvariable = {{ name = \"q1\", kind = \"revolute\", limits = [\"-180 deg\", \"180 deg\"] }}\n\
             transform = \"Rz(q1) Tx(1)\"\n\
             [[frame]]\nname = \"slide\"\nvariable = {{ name = \"d2\", kind = \"prismatic\", limits = [0, 1] }}\ntransform = \"Tx(d2)\"\n"
        );
        let path = crate::running::write(folder.path(), &format!("{orientation}.toml"), &text);
        json(&["check", path.to_str().unwrap(), "--json"])["identifiable"].clone()
    };
    let found = spec("euler-yzx");
    assert_eq!(found, spec("rotation-vector"));
    // With poses and a base frame 4 of the revolute and 2 of the prismatic joint, and 6.
    assert_eq!(found[1]["rank"], 12);
}
