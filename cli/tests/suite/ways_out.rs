//! Messages for plausible mistakes: the cause, with unit and number, and a remedy.

use std::path::Path;

use tempfile::tempdir;

use crate::running::{Run, abbe, json, narrow, prints, write};

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

const JOINTS: &str = r#"
[joints]
q1 = { column = "q1", unit = "deg" }
q2 = { column = "q2", unit = "deg" }
q3 = { column = "q3", unit = "deg" }
q4 = { column = "q4", unit = "deg" }
q5 = { column = "q5", unit = "deg" }
q6 = { column = "q6", unit = "deg" }
"#;

const POINT: &str = "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";

/// Returns a map of the UR5.
fn map(measured: &str) -> String {
    let head = "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.1 mrad\"\n";
    format!("{head}{JOINTS}{measured}")
}

/// Joins the lines of a text.
fn joined(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Makes a folder read-only. Root first gives up its privilege.
#[cfg(unix)]
#[test]
fn a_folder_that_may_only_be_read() {
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt;
    use std::os::unix::process::CommandExt;

    let folder = tempdir().unwrap();
    fs::set_permissions(folder.path(), Permissions::from_mode(0o555)).unwrap();
    let others = tempdir().unwrap();
    let binary = others.path().join("abbe");
    fs::copy(env!("CARGO_BIN_EXE_abbe"), &binary).unwrap();
    fs::set_permissions(others.path(), Permissions::from_mode(0o755)).unwrap();
    let is_root = std::process::Command::new("id").arg("-u").output().unwrap().stdout.starts_with(b"0\n");
    for (command, out) in [
        (&["generate", "scara", "--out"][..], "scara.rs"),
        (&["analyze", "scara", "--out"], ""),
        (&["analyze", "scara", "--out"], "new"),
        (&["simulate", "ur5", "--map", "ur5", "--out"], "rows.csv"),
        (&["man", "--out"], ""),
    ] {
        let mut run = std::process::Command::new(&binary);
        run.args(command).arg(folder.path().join(out)).env_remove("NO_COLOR").current_dir("/");
        if is_root {
            run.uid(65534).gid(65534);
        }
        let output = run.output().unwrap();
        let said = joined(&String::from_utf8_lossy(&output.stderr));
        assert_eq!(output.status.code(), Some(2), "{command:?}: {said}");
        assert!(said.contains("cannot write this: Permission denied"), "{command:?}: {said}");
        assert!(
            said.contains("help: choose another folder, or make this one writable"),
            "{command:?}: {said}"
        );
    }
}

/// An unreachable pose: the message gives its distance with a unit, and it counts among the rows.
#[test]
fn poses_out_of_reach_are_counted_and_have_a_unit() {
    let folder = tempdir().unwrap();
    let pose = "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\neuler = { columns = [\"a\", \"b\", \"c\"], order = \"zyx\", unit = \"deg\" }\n";
    let map = write(folder.path(), "map.toml", &map(pose));
    let simulate = ["simulate", "ur5", "--map", path(&map), "--samples", "3", "--noise", "0"];
    let poses = prints(&simulate) + "10,-80,70,-60,50,20,5000,0,400,0,0,0\n";
    let poses = write(folder.path(), "poses.csv", &poses);
    let page = folder.path().join("page.html");
    let asked = ["compensate", "ur5", path(&poses), "--map", path(&map), "--poses", "--report", path(&page)];
    let Run { status, stdout, stderr } = abbe(&asked);
    assert_eq!(status, 1, "{stderr}");
    narrow(&stdout);
    let said = joined(&stdout);
    assert!(said.contains("3 of 4 commands corrected"), "{stdout}");
    let away = said.split("out of reach by ").nth(1).unwrap_or_else(|| panic!("{stdout}"));
    let mut words = away.split(' ');
    let distance: f64 = words.next().unwrap().parse().unwrap();
    // The arm is 0.9 m long, and the pose more than 4 m away.
    assert!((3800.0..4300.0).contains(&distance) && words.next() == Some("mm"), "{stdout}");
    assert!(std::fs::read_to_string(&page).unwrap().contains("3 of 4 commands corrected"));
}

/// A test file that is the fitted file, or shares rows with it.
#[test]
fn test_rows_that_were_fitted_judge_nothing() {
    let folder = tempdir().unwrap();
    let map = write(folder.path(), "map.toml", &map(POINT));
    let rows = |samples: &str, seed: &str| {
        prints(&["simulate", "ur5", "--map", path(&map), "--samples", samples, "--seed", seed])
    };
    let (fitted, other) = (rows("60", "3"), rows("20", "4"));
    let mixed: String =
        other.lines().chain(fitted.lines().skip(41).take(1)).map(|line| format!("{line}\n")).collect();
    let data = write(folder.path(), "data.csv", &fitted);
    for (test, known) in [(&fitted, 60), (&mixed, 1), (&other, 0)] {
        let test = write(folder.path(), "test.csv", test);
        let page = folder.path().join("page.html");
        let identify = ["identify", "ur5", path(&data), "--map", path(&map), "--test", path(&test)];
        assert_eq!(json(&[&identify[..], &["--json"]].concat())["test_rows_of_the_fit"], known);
        for more in [&[][..], &["--full"]] {
            let run = abbe(&[&identify[..], &["--report", path(&page), "--force"], more].concat());
            assert_eq!(run.status, 0, "{}", run.stderr);
            narrow(&run.stdout);
            let expected = match known {
                60 => "60 of the 60 test rows are rows of the fit: they cannot validate the model",
                _ => "1 of the 21 test rows is a row of the fit: it cannot validate the model",
            };
            for said in [joined(&run.stdout), joined(&run.stderr)] {
                assert_eq!(said.contains(expected), known > 0, "{said}");
            }
            let claims = ["for validation only", "used for validation only"];
            let page = std::fs::read_to_string(&page).unwrap();
            assert_eq!(page.contains(claims[1]), known == 0);
            assert_eq!(run.stdout.contains(claims[0]), known == 0 && more == ["--full"]);
        }
    }
}

/// A title above the header is reported; `sep=;` is supported.
#[test]
fn what_stands_above_a_heading() {
    let folder = tempdir().unwrap();
    let map = write(folder.path(), "map.toml", &map(POINT));
    let rows = prints(&["simulate", "ur5", "--map", path(&map), "--samples", "30"]).replace(',', ";");
    let measured = |text: &str| {
        let data = write(folder.path(), "data.csv", text);
        abbe(&["measure", "ur5", path(&data), "--map", path(&map)])
    };
    let plain = measured(&rows);
    assert_eq!(plain.status, 0, "{}", plain.stderr);
    assert_eq!(measured(&format!("sep=;\r\n{rows}")), plain);
    for title in ["Monday", "Monday, hall 2", "Monday;hall 2"] {
        let run = measured(&format!("{title}\n{rows}"));
        assert_eq!(run.status, 2);
        assert!(run.stderr.contains("line 1 is not the heading: it has "), "{}", run.stderr);
        assert!(run.stderr.contains("remove the lines above the heading"), "{}", run.stderr);
    }
}

/// Suggestions are applicable: none to leave out `--fold` if it is not given, and no plural for one
/// thing.
#[test]
fn robots_in_the_words_of_their_numbers() {
    let folder = tempdir().unwrap();
    let robot = "<robot name=\"arm\">\n<link name=\"base\"/>\n<link name=\"hand\"/>\n<joint name=\"q\" type=\"revolute\"><origin rpy=\"0 0 1.5708\"/>\
                 <parent link=\"base\"/><child link=\"hand\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\"/></joint>\n</robot>\n";
    let robot = write(folder.path(), "robot.urdf", robot);
    for fold in [&[][..], &["--fold"]] {
        let run = abbe(&[&["import", path(&robot), "--tip", "base"][..], fold].concat());
        assert_eq!(run.status, 2);
        assert!(run.stderr.contains("help: choose a tip after a moving joint\n"), "{}", run.stderr);
    }
    let said = joined(&abbe(&["import", path(&robot)]).stderr);
    assert!(
        said.contains("note: 1 angle is a multiple of 45° within") && said.contains("rounds it"),
        "{said}"
    );
    let said = joined(&abbe(&["import", path(&robot), "--round-angles"]).stderr);
    assert!(said.contains("note: 1 angle was rounded to a multiple of 45°"), "{said}");
}
