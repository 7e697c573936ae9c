//! `abbe generate`: the same code as from the other interfaces.

use std::fs;

use abbe_codegen::print;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use tempfile::tempdir;

use crate::running::{abbe, prints, write};

#[test]
fn shipped_names_and_files_give_the_same_code() {
    let folder = tempdir().unwrap();
    for shipped in SHIPPED {
        let file = format!("{}.toml", shipped.name);
        let path = write(folder.path(), &file, shipped.spec);
        let code = prints(&["generate", path.to_str().unwrap(), "--lang", "rust"]);
        assert_eq!(code, print::rust(&Spec::read(&path).unwrap()));
        assert_eq!(code, prints(&["generate", shipped.name]));
    }
}

#[test]
fn a_file_is_written_whole() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("arm.rs");
    fs::write(&path, "what was there before").unwrap();
    let run = abbe(&["generate", "puma560", "--force", "--out", path.to_str().unwrap()]);
    assert_eq!((run.status, run.stdout.as_str()), (0, ""));
    assert!(run.stderr.starts_with("wrote "));
    assert_eq!(fs::read_to_string(&path).unwrap(), prints(&["generate", "puma560"]));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "nothing else is left there but the record");
}

#[test]
fn nothing_is_written_if_the_spec_is_wrong() {
    let folder = tempdir().unwrap();
    let spec = write(folder.path(), "bad.toml", "[manipulator]\nname = 5\n");
    let out = folder.path().join("arm.rs");
    let run = abbe(&["generate", spec.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("bad.toml:2:8"), "{}", run.stderr);
    assert!(!out.exists());
}

/// C has a header and a source, and therefore needs a folder.
#[test]
fn c_is_two_files() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("controller");
    let refused = abbe(&["generate", "pps", "--lang", "c"]);
    assert!(refused.status == 2 && refused.stderr.contains("--out DIR"), "{}", refused.stderr);
    prints(&["generate", "pps", "--lang", "c", "--out", out.to_str().unwrap()]);
    for (file, what) in [("pps.h", "int pps_pose("), ("pps.c", "#include \"pps.h\"")] {
        assert!(fs::read_to_string(out.join(file)).unwrap().contains(what), "{file}");
    }
}

/// Only the selected functions are public, under the name that was given; what is wrong is refused
/// with its place.
#[test]
fn functions_are_selected_by_name() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("controller");
    let out = out.to_str().unwrap();
    prints(&[
        "generate",
        "ur5",
        "--lang",
        "c",
        "--only",
        "pose, compensated",
        "--name",
        "left_arm",
        "--out",
        out,
    ]);
    let header = fs::read_to_string(folder.path().join("controller/left_arm.h")).unwrap();
    let functions: Vec<&str> =
        header.lines().filter_map(|line| line.strip_prefix("int left_arm_")?.split('(').next()).collect();
    assert_eq!(functions, ["pose", "compensated", "self_test"]);
    assert!(!header.contains("real_pose"));
    for (language, exported, other) in [
        ("js", "export function pose(", "export function real_pose("),
        ("python", "def pose(", "def real_pose("),
        ("matlab", "= pose(", "effects"),
        ("st", "FUNCTION_BLOCK ur5_pose", "effects"),
        ("plcopen", "<pou name=\"ur5_pose\" pouType=\"functionBlock\">", "effects"),
    ] {
        let code = prints(&["generate", "ur5", "--lang", language, "--only", "pose,compensated"]);
        assert!(code.contains(exported) && !code.contains(other), "{language}");
        assert!(!code.contains("error_jacobian"), "{language}");
    }
    let wrong = |arguments: &[&str], expected: &[&str]| {
        let run = abbe(&[&["generate", "ur5"], arguments].concat());
        assert_eq!(run.status, 2);
        assert!(expected.iter().all(|part| run.stderr.contains(part)), "{}", run.stderr);
    };
    let unknown = ["--only:1:6", "no function `pse`", "did you mean `pose`", "`compensated`"];
    wrong(&["--lang", "js", "--only", "pose,pse"], &unknown);
    wrong(&["--lang", "js", "--only", "parameter_jacobian"], &["no function `parameter_jacobian`"]);
    wrong(&["--only", "pose"], &["--only", "rust"]);
    wrong(&["--lang", "fmu", "--only", "pose", "--out", "ur5.fmu"], &["--only", "fmu"]);
    wrong(&["--lang", "js", "--name", "Left"], &["--name", "lower case"]);
}

/// An FMU has the same bytes wherever it is written, is not printed to a terminal, and follows the
/// chosen version.
#[test]
fn a_functional_mock_up_unit_is_an_archive() {
    let folder = tempdir().unwrap();
    let write = |name: &str, more: &[&str]| {
        let out = folder.path().join(name);
        prints(&[&["generate", "pps", "--lang", "fmu", "--out", out.to_str().unwrap()], more].concat());
        fs::read(out).unwrap()
    };
    let [first, second, same] = [("a.fmu", &[][..]), ("b.fmu", &["--fmi", "2"]), ("c.fmu", &["--fmi", "3"])]
        .map(|(name, more)| write(name, more));
    assert!(first.starts_with(b"PK") && first == same && first != second);
    let refused = abbe(&["generate", "pps", "--lang", "fmu"]);
    assert!(refused.status == 2 && refused.stderr.contains("--out pps.fmu"), "{}", refused.stderr);
    let refused = abbe(&["generate", "pps", "--lang", "c", "--fmi", "2", "--out", "pps"]);
    assert!(refused.status == 2 && refused.stderr.contains("`--lang fmu`"), "{}", refused.stderr);
}

/// Single-precision code contains no double-precision operation; languages without single precision
/// refuse it.
#[test]
fn c_in_single_precision() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("controller");
    let asked = ["--lang", "c", "--real", "float", "--out", out.to_str().unwrap()];
    prints(&[&["generate", "pps"][..], &asked].concat());
    for file in ["pps.h", "pps.c"] {
        let text = fs::read_to_string(out.join(file)).unwrap();
        let double = ["double q", "const double ", "    double "].iter().any(|what| text.contains(what));
        assert!(text.contains("const float q[") && !double, "{file}");
    }
    let spec =
        prints(&["generate", "pps", "--lang", "c", "--real", "double", "--out", out.to_str().unwrap()]);
    assert_eq!(spec, "");
    assert!(fs::read_to_string(out.join("pps.h")).unwrap().contains("const double q["));
    for (number, told) in [("1e39", "1e39"), ("2e-50", "2e-50")] {
        let text = format!(
            "[manipulator]\nname = \"tiny\"\nlength = \"m\"\n[[frame]]\nname = \"a\"\n\
             variable = {{ name = \"q\", kind = \"revolute\", limits = [-1, 1] }}\n\
             transform = \"Rz(q) Tx({number})\"\n"
        );
        let spec = write(folder.path(), "tiny.toml", &text);
        let run = abbe(&[&["generate", spec.to_str().unwrap()][..], &asked].concat());
        assert!(run.status == 2 && run.stderr.contains(told), "{}", run.stderr);
        assert!(run.stderr.contains("single precision"), "{}", run.stderr);
    }
    assert!(!out.join("tiny.c").exists());
}
