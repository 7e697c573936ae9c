//! `abbe compensate`: from the identified spec to corrected commands.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::tempdir;

use crate::running::{abbe, command, full, json, narrow, prints, shipped, write};

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

/// Returns the numbers of these columns, row by row.
fn columns(file: &Path, names: [&str; 3]) -> Vec<[f64; 3]> {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let heading = lines.next().unwrap();
    let places = names.map(|name| heading.iter().position(|found| *found == name).unwrap());
    lines.map(|line| places.map(|place| line[place].parse().unwrap())).collect()
}

fn mean_distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    a.iter().zip(b).map(distance).sum::<f64>() / a.len() as f64
}

/// The arm of the chapter is measured, identified and compensated; then its real tool point is
/// simulated for commands that were not measured.
#[test]
fn what_is_left_is_what_measuring_did_not_tell() {
    let chapter = include_str!("../../../docs/from-measurements-to-a-spec.md");
    let folder = tempdir().unwrap();
    for block in chapter.split("```toml\n# ").skip(1) {
        let (name, text) = block.split_once('\n').unwrap();
        write(folder.path(), name, text.split("```").next().unwrap());
    }
    let run = |line: &str| {
        let output = command(&shell_words::split(line).unwrap()).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    };
    run("plan arm.toml --map tracker.toml --optimal 60 --out plan.csv");
    let real = "simulate arm.toml --map tracker.toml --enable 'what nobody knows yet'";
    run(&format!("{real} plan.csv --seed 1 --out measured.csv"));
    run("identify arm.toml measured.csv --map tracker.toml --terms joint --out found.toml");
    run("simulate arm.toml --map tracker.toml --samples 40 --seed 2 --noise 0 --out wanted.csv");
    run("compensate found.toml wanted.csv --map tracker.toml --out commands.csv");
    run(&format!("{real} wanted.csv --noise 0 --out before.csv"));
    run(&format!("{real} commands.csv --noise 0 --out after.csv"));
    let points = |name: &str| columns(&folder.path().join(name), ["x", "y", "z"]);
    let wanted = points("wanted.csv");
    let (before, after) =
        (mean_distance(&points("before.csv"), &wanted), mean_distance(&points("after.csv"), &wanted));
    println!("{before} mm down to {after} mm");
    // `abbe plan` predicts a standard deviation of 0.0104 mm on average.
    assert!((before - 0.631).abs() < 5e-4 && (after - 0.0071).abs() < 2e-4, "{before} down to {after}");
}

#[test]
fn commands_are_in_the_columns_and_units_of_the_data() {
    let folder = tempdir().unwrap();
    // Columns named as in the spec, in mm and rad.
    let data =
        write(folder.path(), "data.csv", "d1,d2,d3,q4,q5,q6\n1128,280,300,0.5,0,0\n600,280,300,-0.5,0,0\n");
    let out = folder.path().join("out.csv");
    let text = full(&["compensate", "pps", path(&data), "--out", path(&out)]);
    narrow(&text);
    assert!(text.contains("2 of 2 commands corrected"), "{text}");
    let report = json(&["compensate", "pps", path(&data), "--json"]);
    let number = |value: &Value| value.as_f64().unwrap();
    assert!(number(&report["before"]["max"]) > 0.5 && number(&report["after"]["max"]) < 1e-6);
    let written = columns(&out, ["d1", "q4", "q6"]);
    let q = &report["rows"][0]["q"];
    for (found, name) in written[0].iter().zip(["d1", "q4", "q6"]) {
        assert!((found - number(&q[name])).abs() < 1e-9 * found.abs().max(1.0));
    }
    let heading = fs::read_to_string(&out).unwrap();
    assert!(heading.starts_with("d1,d2,d3,q4,q5,q6,line,error_before,error_after,angle_before,"));
}

#[test]
fn what_cannot_be_had_within_limits_is_said() {
    let folder = tempdir().unwrap();
    let rows: String = ["90", "-90", "0"].iter().map(|q4| format!("1128,280,300,{q4},0,0\n")).collect();
    let data = write(
        folder.path(),
        "data.csv",
        &format!("d1,d2,d3,q4,q5,q6\n{rows}-5,280,300,0,0,0\nx,1,1,1,1,1\n"),
    );
    let map = "[data]\nuncertainty = \"0.1 mm\"\n\n[joints]\nd1 = { column = \"d1\", unit = \"mm\" }\nd2 = { column = \"d2\", unit = \"mm\" }\nd3 = { column = \"d3\", unit = \"mm\" }\nq4 = { column = \"q4\", unit = \"deg\" }\nq5 = { column = \"q5\", unit = \"deg\" }\nq6 = { column = \"q6\", unit = \"deg\" }\n\n[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";
    let map = write(folder.path(), "map.toml", map);
    let run = abbe(&["compensate", "pps", path(&data), "--map", path(&map)]);
    assert_eq!(run.status, 1, "{}", run.stderr);
    narrow(&run.stdout);
    for expected in [
        "q4 is at its limit",
        "d1 is commanded to -5 mm, beyond its limits 0 mm … 2256 mm",
        "`d1` is `x`, not a number",
    ] {
        assert!(run.stdout.contains(expected), "{expected}\n{}", run.stdout);
    }
}

/// Poses of the ideal arm as input give the same commands as its joints.
#[test]
fn poses_are_as_good_as_joints() {
    let folder = tempdir().unwrap();
    let errors = "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_x = \"0.6 mm\"\ne_s = \"0.8 mrad\"\n";
    let spec = write(folder.path(), "real.toml", &format!("{}{errors}", shipped("ur5")));
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
    let map = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.1 mrad\"\n\n[joints]\n{joints}\n[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\nquaternion = {{ columns = [\"a\", \"b\", \"c\", \"d\"], order = \"wxyz\" }}\n"
    );
    let map = write(folder.path(), "map.toml", &map);
    let plan =
        write(folder.path(), "plan.csv", "j1,j2,j3,j4,j5,j6\n10,-80,70,-60,50,20\n-40,-60,90,-100,80,0\n");
    let poses = folder.path().join("poses.csv");
    prints(&["simulate", "ur5", path(&plan), "--map", path(&map), "--noise", "0", "--out", path(&poses)]);
    let compensate = ["compensate", path(&spec), path(&poses), "--map", path(&map), "--json"];
    let (from_joints, from_poses) = (json(&compensate), json(&[&compensate[..], &["--poses"]].concat()));
    for row in 0..2 {
        for i in 1..=6 {
            let q = |report: &Value| report["rows"][row]["q"][format!("q{i}")].as_f64().unwrap();
            assert!((q(&from_joints) - q(&from_poses)).abs() < 1e-6);
        }
    }
    let point = [&compensate[..3], &["--map", "ur5", "--poses"]].concat();
    let run = abbe(&point);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("needs a map with `[pose]`"), "{}", run.stderr);
}

#[test]
fn bad_input_writes_nothing() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("out.csv");
    let refused = |data: &str, more: &[&str], expected: &[&str]| {
        let data = write(folder.path(), "data.csv", data);
        let run = abbe(&[&["compensate", "pps", path(&data), "--out", path(&out)], more].concat());
        assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{}", run.stderr);
        expected
            .iter()
            .for_each(|expected| assert!(run.stderr.contains(expected), "{expected}\n{}", run.stderr));
        assert!(!out.exists());
    };
    refused("d1,d2,d3,q4,q5,Q6\n1,2,3,4,5,6\n", &[], &["there is no column `q6`", "did you mean `Q6`?"]);
    refused("", &[], &["6 columns of the map are missing in"]);
    let heading = "d1,d2,d3,q4,q5,q6\n";
    refused(heading, &[], &["no row can be used"]);
    refused(&format!("{heading}1,2,3,0,0,0\n"), &["--tolerance", "-1mm"], &["must not be negative"]);
    refused(&format!("{heading}1,2,3,0,0,0\n"), &["--tolerance", "1deg"], &["length"]);
    let hot = write(folder.path(), "hot.csv", "x,y,z,temperature_rise\n1,2,3,50\n");
    let run = abbe(&["compensate", "machine3", path(&hot), "--out", path(&out)]);
    assert_eq!(run.status, 2);
    let expected =
        "no row can be compensated: line 2: `temperature_rise` is 50 K, outside its range -15 … 15";
    assert!(run.stderr.contains(expected) && !out.exists(), "{}", run.stderr);
}

/// A table that ends at the limits, as measured from end to end: corrections that stay within the
/// limits are found, and others name the limit.
#[test]
fn tables_that_end_at_a_limit_are_compensated_there() {
    let folder = tempdir().unwrap();
    let spec = write(
        folder.path(),
        "screw.toml",
        "[manipulator]\nname = \"screw\"\nlength = \"mm\"\n[tables.exx]\n\
         x = { values = [0, 200, 400], unit = \"mm\" }\ny = { values = [5, -3, 8], unit = \"um\" }\n\
         interpolation = \"linear\"\n[[frame]]\nname = \"X\"\n\
         variable = { name = \"x\", kind = \"prismatic\", limits = [0, 400] }\ntransform = \"Tx(x)\"\n\
         [[source]]\nname = \"EXX\"\nclass = \"repeatable\"\nframe = \"X\"\ne_x = \"exx(x)\"\n",
    );
    let commands = write(folder.path(), "commands.csv", "x\n400\n200\n0\n");
    let run = abbe(&["compensate", path(&spec), path(&commands)]);
    let text = run.stdout;
    assert!(run.status == 1 && text.contains("2 of 3 commands corrected to within 0.001 mm"), "{text}");
    assert!(
        text.contains("Failed    line 4: x is at its limit 0 mm and would have to exceed it; 0.005 mm left"),
        "{text}"
    );
}
