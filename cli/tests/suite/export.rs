//! `abbe export`: output paths, refusals, and agreement of text and JSON.

use std::fs;

use tempfile::tempdir;

use crate::running::{abbe, full, json, prints, write};

const CELL: &str = "<robot name=\"cell\"><!-- one joint --><link name=\"base\"/><link name=\"arm\"/><link name=\"tool\"/>
<joint name=\"turn\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/><origin xyz=\"0.3 0 0\"/><axis xyz=\"0 0 1\"/>
<limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint>
<joint name=\"flange\" type=\"fixed\"><parent link=\"arm\"/><child link=\"tool\"/><origin xyz=\"0.2 0 0\"/></joint></robot>
";

const ERROR: &str = "\n[[source]]\nname = \"found\"\nclass = \"repeatable\"\nframe = \"turn\"\ne_x = \"1 mm\"\ne_s = \"1 mrad\"\n";

#[test]
fn the_file_that_it_is_made_from_is_never_written_over() {
    let folder = tempdir().unwrap();
    let urdf = write(folder.path(), "cell.urdf", CELL);
    let urdf = urdf.to_str().unwrap();
    let spec = write(folder.path(), "found.toml", &(prints(&["import", urdf]) + ERROR));
    let spec = spec.to_str().unwrap();
    for out in [urdf, spec] {
        let run = abbe(&["export", spec, "--to", "urdf", "--from", urdf, "--force", "-o", out]);
        assert!(run.status == 2 && run.stderr.contains("cannot be overwritten"), "{}", run.stderr);
    }
    assert_eq!(fs::read_to_string(urdf).unwrap(), CELL);

    // The file alone on stdout, its report on stderr; the same content in a file.
    let printed = abbe(&["export", spec, "--to", "urdf", "--from", urdf, "--full"]);
    assert!(printed.stdout.starts_with("<robot name=\"cell\"><!-- one joint -->"), "{}", printed.stdout);
    assert!(printed.stderr.contains("+") && printed.stderr.contains("\nSign      "), "{}", printed.stderr);
    let out = folder.path().join("calibrated.urdf");
    let said = full(&["export", spec, "--to", "urdf", "--from", urdf, "-o", out.to_str().unwrap()]);
    assert_eq!(fs::read_to_string(&out).unwrap(), printed.stdout);
    assert!(
        said.contains("\n  -<joint name=\"flange\"") && said.contains("\n  +<joint name=\"flange\""),
        "{said}"
    );
    let report = json(&["export", spec, "--to", "urdf", "--from", urdf, "--json"]);
    assert_eq!(report["files"][0]["text"].as_str().unwrap(), printed.stdout);
    assert!(report["remains"]["position"]["largest"].as_f64().unwrap() < 1e-9);
    assert!(report["before"]["position"]["largest"].as_f64().unwrap() > 1e-3);
}

#[test]
fn several_files_need_a_folder_and_options_their_format() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("comp");
    let linuxcnc = ["export", "machine3", "--to", "linuxcnc", "--nodes", "5", "--samples", "20"];
    let refused = abbe(&linuxcnc);
    assert!(refused.status == 2 && refused.stderr.contains("-o DIR"), "{}", refused.stderr);
    prints(&[&linuxcnc[..], &["-o", out.to_str().unwrap()]].concat());
    for file in ["x.comp", "y.comp", "z.comp"] {
        assert_eq!(fs::read_to_string(out.join(file)).unwrap().lines().count(), 5);
    }
    for (words, said) in [
        (&["--to", "dh", "--from", "robot.urdf"][..], "leave `--from` out"),
        (&["--to", "linuxcnc-genhexkins"], "6 commanded joints and 0 loops"),
        (&["--to", "dh", "--nodes", "5"], "leave `--nodes` out"),
        (&["--to", "table", "--nodes", "1000"], "choose fewer nodes"),
    ] {
        let run = abbe(&[&["export", "ur5"][..], words].concat());
        assert!(run.status == 2 && run.stderr.contains(said), "{words:?}: {}", run.stderr);
    }
}
