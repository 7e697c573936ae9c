//! `abbe monitor`, on the machine of its chapter.

use std::fs;
use std::path::Path;

use tempfile::{TempDir, tempdir};

use crate::documents::blocks;
use crate::explore::panel;
use crate::report::is_alone;
use crate::running::{abbe, command, full, json, narrow, prints, write};

/// Writes the files of the chapter, and checks of the machine for some days.
fn chapter() -> TempDir {
    let folder = tempdir().unwrap();
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/watch-a-machine.md");
    for (language, block) in blocks(&fs::read_to_string(page).unwrap()) {
        if let (Some(name), "toml") =
            (block.lines().next().and_then(|line| line.strip_prefix("# ")), language)
        {
            fs::write(folder.path().join(name), block).unwrap();
        }
    }
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (spec, map) = (at("worn.toml"), at("floor.toml"));
    full(&["plan", &spec, "--map", &map, "--sets", &at("mornings.toml"), "--out", &at("mornings.csv")]);
    prints(&[
        "simulate",
        &spec,
        "--map",
        &map,
        &at("mornings.csv"),
        "--seed",
        "4",
        "--out",
        &at("checks.csv"),
    ]);
    folder
}

/// Returns the rows of some days, with the header.
fn days(folder: &Path, days: std::ops::Range<usize>) -> String {
    let text = fs::read_to_string(folder.join("checks.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let rows = &lines[1 + 6 * days.start..1 + 6 * days.end];
    format!("{}\n{}\n", lines[0], rows.join("\n"))
}

#[test]
fn the_elbow_of_the_chapter_is_found() {
    let folder = chapter();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (spec, map, checks, page) = (at("worn.toml"), at("floor.toml"), at("checks.csv"), at("page.html"));
    let arguments = ["monitor", &spec, &checks, "--map", &map, "--disable", "wear", "--tolerance", "0.1mm"];
    narrow(&prints(&arguments));
    let with =
        |more: &[&str]| [&arguments[..], more].concat().iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
    let call = |more: &[&str]| {
        let all = with(more);
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        abbe(&all)
    };
    let all = with(&["--json"]);
    let report = json(&all.iter().map(String::as_str).collect::<Vec<_>>());
    let finding = &report["finding"];
    let names = [&[finding["name"].clone()][..], finding["as_well"].as_array().unwrap()].concat();
    assert!(names.contains(&"zero of q3".into()), "{names:?}");
    assert_eq!(finding["kind"], "drift");
    let [first, last] = [0, 1].map(|i| finding["between"][i].as_f64().unwrap());
    assert!(first <= 60.0 && 60.0 <= last, "{first} {last}");
    let alarm = report["alarm"]["check"].as_u64().unwrap();
    // 0.002 mrad at about 560 mm is about 1 µm per day.
    assert!((60..80).contains(&alarm), "{alarm}");

    // The map may give the tolerance as the limit of the largest error.
    let limits = fs::read_to_string(&map).unwrap() + "\n[accept]\nmean = \"0.01 mm\"\nmax = \"0.1 mm\"\n";
    let limited = write(folder.path(), "limited.toml", &limits);
    let limited = limited.to_str().unwrap();
    let of_map = json(&["monitor", &spec, &checks, "--map", limited, "--disable", "wear", "--json"]);
    assert_eq!((&of_map["tolerance"], &of_map["finding"]), (&0.1.into(), &report["finding"]));

    let used_up =
        full(&["monitor", &spec, &checks, "--map", &map, "--disable", "wear", "--tolerance", "0.01mm"]);
    assert!(used_up.contains("exceeds the tolerance of 0.01 mm"), "{used_up}");

    assert_eq!(call(&["--check"]).status, 1);
    assert_eq!(call(&[]).status, 0);
    assert!(call(&["--since", "88"]).stdout.contains("no alarm"));
    let wrong = call(&["--since", "soon"]);
    assert_eq!(wrong.status, 2);
    assert!(wrong.stderr.contains("`soon` is not a date"), "{}", wrong.stderr);

    prints(
        &with(&["--report", &page, "--date", "2026-11-21"]).iter().map(String::as_str).collect::<Vec<_>>(),
    );
    let text = fs::read_to_string(&page).unwrap();
    is_alone(&text);
    // The panel has the mean residuals of the six configurations at the first and the last check.
    let residuals = &panel(&text)["residuals"];
    assert_eq!((&residuals["before"], &residuals["after"]), (&"day 0".into(), &"day 89".into()));
    let rows = residuals["rows"].as_array().unwrap();
    let lines: Vec<&serde_json::Value> = rows.iter().map(|row| &row["line"]).collect();
    assert_eq!(lines, (6 * 89 + 2..).take(6).collect::<Vec<_>>());
    // The elbow drifts from the 60th day on by 0.002 mrad a day, beyond the noise of 0.01 mm.
    let rms = |key: &str| {
        let squares =
            rows.iter().flat_map(|row| row[key].as_array().unwrap()).map(|v| v.as_f64().unwrap().powi(2));
        (squares.sum::<f64>() / 18.0).sqrt()
    };
    assert!(rms("after") > 1.5 * rms("before"), "{} {}", rms("after"), rms("before"));
    for expected in [
        "<th scope=\"row\">Date</th><td>2026-11-21</td>",
        "Detected change",
        "All charts",
        "Residual change",
        "Laser tracker, bolted to the floor",
    ] {
        assert!(text.contains(expected), "{expected}");
    }
}

#[test]
fn files_are_checks_by_the_dates_in_their_names() {
    let folder = chapter();
    let map = fs::read_to_string(folder.path().join("floor.toml")).unwrap().replace("time = \"day\"\n", "");
    fs::write(folder.path().join("files.toml"), map).unwrap();
    let names: Vec<String> = (1..=20).map(|day| format!("check-2026-03-{day:02}.csv")).collect();
    for (day, name) in names.iter().enumerate() {
        fs::write(folder.path().join(name), days(folder.path(), day..day + 1)).unwrap();
    }
    let run = |files: &[&str]| {
        let arguments = [
            &["monitor", "worn.toml"][..],
            files,
            &["--map", "files.toml", "--disable", "wear", "--check", "--full"],
        ]
        .concat();
        let output = command(&arguments).current_dir(folder.path()).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (status, stdout, stderr) = run(&names);
    assert_eq!((status, &*stderr), (Some(0), ""));
    assert!(stdout.contains("20 checks from 2026-03-01 to 2026-03-20; 6 configurations in each"), "{stdout}");
    let (status, _, stderr) = run(&[names[3], names[2]]);
    assert_eq!(status, Some(2));
    assert!(stderr.contains("not in chronological order: 2026-03-03 comes after 2026-03-04"), "{stderr}");
    // Other configurations.
    let other = days(folder.path(), 4..5).replace("\n", "\n1").trim_end_matches('1').to_owned();
    fs::write(folder.path().join("check-2026-03-21.csv"), other).unwrap();
    let (status, _, stderr) = run(&[names[0], "check-2026-03-21.csv"]);
    assert_eq!(status, Some(2));
    assert!(stderr.contains("no configuration is common to all checks"), "{stderr}");
}
