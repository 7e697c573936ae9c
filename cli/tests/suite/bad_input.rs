//! Wrong usage and wrong input: exit status 2, empty stdout, and a message with a remedy.

use std::fs;
use std::path::Path;

use tempfile::tempdir;

use crate::running::{abbe, write};

pub(crate) fn refused<S: AsRef<std::ffi::OsStr> + std::fmt::Debug>(arguments: &[S], expected: &[&str]) {
    let run = abbe(arguments);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{arguments:?}\n{}", run.stderr);
    for expected in expected {
        assert!(run.stderr.contains(expected), "{arguments:?}: {expected}\n{}", run.stderr);
    }
    assert!(!run.stderr.contains('\u{1b}'), "no colours where nobody watches");
}

#[test]
fn specs_that_are_not_there() {
    refused(
        &["analyze", "ppps"],
        &["no shipped manipulator `ppps`", "did you mean `pps`?", "`puma560`, `scara`"],
    );
    refused(&["check", ""], &["no shipped manipulator"]);
    refused(&["check", "nowhere/pps.toml"], &["cannot read this file", "nowhere/pps.toml"]);
    refused(&["check", "pps.toml"], &["cannot read this file", "pps.toml"]);
    let folder = tempdir().unwrap();
    refused(&["jacobian", folder.path().to_str().unwrap()], &["this is a directory, not a file"]);
    let binary = folder.path().join("noise.toml");
    fs::write(&binary, [0xff, 0x00, 0xfe]).unwrap();
    refused(&["generate", binary.to_str().unwrap()], &["not UTF-8"]);
}

#[test]
fn values_of_joints() {
    let q = |value: &str, expected: &[&str]| refused(&["jacobian", "pps", "--q", value], expected);
    q("1,2,3,4,5", &["expected 6 joint variables, found 5", "the order is d1,d2,d3,q4,q5,q6"]);
    q("", &["expected 6 joint variables, found 0"]);
    q("1,2,3,4,5,6,7", &["found 7"]);
    q("90deg,0,0,0,0,0", &["the value of `d1` must be a length, not a pure number", "--q:1:1"]);
    q("0,0,0,3mm,0,0", &["the value of `q4` must be a pure number, not a length", "--q:1:7"]);
    q("0,0,0,90degg,0,0", &["`degg` is neither a unit nor a function", "did you mean `deg`?", "--q:1:9"]);
    q("0,0,,0,0,0", &["the value of `d3` is missing"]);
    q("nan,inf,0,0,0,0", &["`nan` is neither", "`inf` is neither"]);
    q("1e999,1e308m,1/0,0,0,0", &["too large for a number", "too large to compute with", "division by zero"]);
    q("d1,((0,0,0,0", &["expected 6 joint variables"]);
    q("0,0,0,0,(0,0)", &["expected 6 joint variables"]);
    q("é,0,0,0,0,0°", &["`é` is neither", "--q:1:12"]);
    q("0,0,0,0,90deg,0", &["Euler angles are singular", "rotation-vector"]);
}

#[test]
fn names_and_values_to_set() {
    let set = |value: &str, expected: &[&str]| refused(&["analyze", "machine3", "--set", value], expected);
    set("tool_lenght=1", &["no parameter or input `tool_lenght`", "did you mean `tool_length`?"]);
    set("tool_length", &["expected NAME=VALUE"]);
    set("tool_length=", &["the value of `tool_length` is missing"]);
    set("tool_length=3K", &["must be a length, not a temperature"]);
    set("temperature_rise=5", &["must be a temperature, not a pure number"]);
    set("temperature_rise=16K", &["outside its range", "-15 … 15 K"]);
    set("x=3", &["`x` is a joint variable"]);
    refused(&["analyze", "pps", "--set", "a=1", "--set", "b=2"], &["--set:1:1", "--set:2:1"]);
    refused(&["analyze", "pps", "--disable", "spin"], &["no source `spin`", "did you mean `spin encoder`?"]);
    refused(&["jacobian", "scara", "--enable", "x\ny"], &["no source `x\\ny`"]);
}

#[test]
fn usage() {
    refused(&["frobnicate"], &["unrecognized subcommand"]);
    refused(&["check"], &["Usage: abbe check"]);
    refused(&["generate", "pps", "--lang", "fortran"], &["invalid value 'fortran'", "rust"]);
    refused(&["generate", "pps", "--lang", "c"], &["c consists of 2 files", "--out DIR"]);
    refused(
        &["generate", "pps", "--real", "float"],
        &["`--real` has no effect on rust", "--lang c --real float"],
    );
    refused(
        &["generate", "pps", "--lang", "js", "--real", "double"],
        &["`--real` has no effect on js", "leave"],
    );
    refused(
        &["generate", "pps", "--lang", "c", "--real", "half"],
        &["invalid value 'half'", "double, float"],
    );
    refused(&["analyze", "pps", "--outt", "x"], &["--out"]);
    // Ways out that are right: no `-- --tolerance`.
    refused(&["check", "pps", "--tolerance", "1mm"], &["--tolerance is an option of `abbe analyze`"]);
    refused(&["allocate", "pps", "--tolerance", "0.4", "mm"], &["in quotes: `0.4mm`"]);
    refused(&["jacobian", "pps", "q4=70"], &["are given by --q"]);
    refused(
        &["measure", "ur5", "rows.csv"],
        &["--map <FILE>", "`abbe doctor SPEC DATA -o map.toml` proposes a map"],
    );
    refused(&["analyze", "pps", "--tolerance", "0,3mm"], &["write a decimal point: `0.3`"]);
    refused(&["analyze", "pps", "--tolerance", "1,000um"], &["write `1000`, or a decimal point: `1.000`"]);
    refused(&["analyze", "pps", "--tolerance", "5mil"], &["1 mil is `0.001 inch`"]);
    refused(&["analyze", "pps", "--tolerance", "5micron"], &["write `um`"]);
    let unknown = abbe(&["generate", "pps", "--zzz"]).stderr;
    assert!(unknown.contains("unexpected argument '--zzz'") && !unknown.contains("-- --zzz"), "{unknown}");
    for lang in ["PYTHON", "JS"] {
        assert_eq!(abbe(&["generate", "pps", "--lang", lang, "--only", "pose"]).status, 0);
    }
}

#[test]
fn places_to_write_to() {
    let folder = tempdir().unwrap();
    let file = write(folder.path(), "file", "in the way");
    let path = |path: &Path| path.to_str().unwrap().to_owned();
    refused(&["analyze", "pps", "--out", &path(&file)], &["this is a file, not a folder"]);
    refused(&["analyze", "pps", "--out", &path(&file.join("under"))], &["cannot write this"]);
    refused(&["generate", "pps", "--out", &path(folder.path())], &["this is a folder, not a file"]);
    refused(&["generate", "pps", "--out", &path(&folder.path().join("no/where.rs"))], &["cannot write this"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "in the way");

    let blocked = folder.path().join("blocked");
    fs::create_dir_all(blocked.join("sources.csv")).unwrap();
    refused(&["analyze", "pps", "--out", &path(&blocked)], &["abbe wrote none of them", "--force"]);
    refused(&["analyze", "pps", "--force", "--out", &path(&blocked)], &["sources.csv"]);
    assert_eq!(fs::read_dir(&blocked).unwrap().count(), 1, "no partial file is left");
}

/// Runs a study of the patient positioning system with `lines` after its head.
fn study(lines: &str, expected: &[&str]) {
    let folder = tempdir().unwrap();
    let path = write(folder.path(), "study.toml", &format!("[study]\ntitle = \"Bad\"\n{lines}\n"));
    refused(&["analyze", "pps", "--study", path.to_str().unwrap()], expected);
}

#[test]
fn studies() {
    study("", &["`workspace` is missing"]);
    study("tolernace = 1", &["no key `tolernace`", "did you mean `tolerance`?", "study.toml:3:1"]);
    study("tolerance = 0\n[workspace.joints]\nsamples = 1", &["must be positive", "study.toml:3:13"]);
    study("tolerance = \"1 deg\"\n[workspace.joints]\nsamples = 1", &["must be a length"]);
    study("[workspace]", &["a workspace needs exactly one form"]);
    study("[workspace]\njoints = 1\ngrid = 2", &["a workspace needs exactly one form"]);
    study("[workspace.joints]\nsamples = 0", &["integer from 1 to"]);
    study("[workspace.joints]\nsamples = 1e99", &["integer from 1 to"]);
    study("[workspace.joints]\nsamples = 5\nmoved = [\"d7\"]", &["no variable or input `d7`"]);
    study("[workspace.grid]\nq7 = [0]", &["no variable or input `q7`", "`q6`"]);
    study("[workspace.grid]\nd1 = []", &["`d1` has no values"]);
    study("[workspace.grid]\nd1 = [\"1 deg\"]", &["a value of `d1` must be a length"]);
    study("[workspace.grid]\nd1 = { from = 0, to = 10 }", &["either `count` or `step`"]);
    study("[workspace.grid]\nd1 = { from = 0, to = 10, step = 3 }", &["does not reach `to`"]);
    study("[workspace.grid]\nd1 = { from = 0, to = 10, step = -1 }", &["a step must be positive"]);
    study("[workspace.grid]\nd1 = { from = 0, to = 1, step = 1e-99 }", &["more than 10000000 values"]);
    let axes =
        ["d1", "d2", "d3"].map(|name| format!("{name} = {{ from = 0, to = 1, count = 10000 }}\n")).concat();
    study(&format!("[workspace.grid]\n{axes}"), &["configurations are more than one run sweeps"]);
    study(
        "[workspace.presented]\npoint = [0, 0]\nsolve = [\"d1\", \"d1\"]\ntool_points = { w = [1] }",
        &["expected 3 entries, found 2", "duplicate name `d1`", "no parameter `w`"],
    );
    study(
        "[workspace.presented]\npoint = [0, 0, 0]\nsolve = [\"d1\"]\napproaches = { d1 = [1] }",
        &["`d1` cannot be both fixed and solved for"],
    );
    let joints = "[workspace.joints]\nsamples = 1\n";
    study(
        &format!("{joints}[[published]]\nsource = \"rail\"\nmetric = \"largest\""),
        &["no source `rail`", "`metric` cannot be `largest`", "`within` is missing"],
    );
    study(&format!("{joints}[[published]]\nx = 1\nwithin = 1"), &["give either `source` and `metric`"]);
    study(&format!("{joints}[compensated]\nresidual = 1"), &["`random` is missing", "`total` is missing"]);
    let folder = tempdir().unwrap();
    refused(&["analyze", "pps", "--study", folder.path().to_str().unwrap()], &["this is a directory"]);
    refused(&["analyze", "pps", "--study", "nowhere.toml"], &["cannot read this file"]);
    // The study of another machine.
    let path = write(folder.path(), "study.toml", include_str!("../../../manipulators/studies/pps.toml"));
    refused(
        &["analyze", "ur5", "--study", path.to_str().unwrap()],
        &["no variable `d1`", "no source `arm deflection`"],
    );
}

/// Messages suggest the nearest option, value, shipped name and file.
#[test]
fn what_is_nearest() {
    let folder = tempdir().unwrap();
    write(folder.path(), "arm.toml", &crate::readme::spec());
    write(folder.path(), "arm.csv", "");
    fs::create_dir(folder.path().join("folder")).unwrap();
    for (words, expected) in [
        (&["analyse", "pps"][..], "a similar subcommand exists: 'analyze'"),
        (&["analyze", "pps", "--monte-carl", "3"], "a similar argument exists: '--monte-carlo'"),
        (&["generate", "pps", "--lang", "rsut"], "a similar value exists: 'rust'"),
        (&["compensate", "pps", "--data", "x.csv"], "unexpected argument '--data'"),
        (&["check", "pumma560"], "did you mean `puma560`?"),
        (&["check", "arm"], "did you mean `arm.toml`?"),
        (&["check", "amr"], "did you mean `arm.toml`?"),
        (&["measure", "ur5", "arm.csv", "--map", "ur6"], "did you mean `ur5`?"),
        (&["measure", "ur5", "arm.csv", "--map", "arn"], "did you mean `arm.toml`?"),
        (&["plan", "pps", "--map", "pps", "--sets", "pss"], "did you mean `pps`?"),
        (&["check", "amr.toml"], "did you mean `arm.toml`?"),
        (&["check", "arms/arm.toml"], "there is no folder `arms`"),
        (&["analyze", "pps", "--study", "arn.toml"], "did you mean `arm.toml`?"),
        (&["measure", "ur5", "arm.csv", "--map", "./arm.tml"], "did you mean `./arm.toml`?"),
        (&["measure", "ur5", "arn.csv", "--map", "ur5"], "did you mean `arm.csv`?"),
        (&["plan", "pps", "--map", "pps", "--sets", "arm.tom1"], "did you mean `arm.toml`?"),
        // A shared file ending alone is no reason for a suggestion.
        (&["check", "quay.toml"], "give the path of a file that can be read"),
        (&["analyze", "pps", "--study", "quay.toml"], "give the path of a file that can be read"),
        (&["import", "quay.urdf"], "give the path of a file that can be read"),
        (&["measure", "ur5", "quay.csv", "--map", "ur5"], "give a CSV file with a heading in its first line"),
        (&["check", "folder"], "this is a folder, not a file"),
    ] {
        let output = crate::running::command(words).current_dir(folder.path()).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        // Windows joins paths by a backslash.
        assert!(stderr.replace('\\', "/").contains(expected), "{words:?}\n{stderr}");
    }
}
