//! Help: its examples run, its exit status is documented, and `docs/reference/command.md` contains
//! it.

use std::fs;
use std::path::Path;

use expect_test::expect_file;

use crate::readme;
use crate::running::{abbe, command, prints};

/// Returns the names of the commands in the order of the help.
fn commands() -> Vec<String> {
    let text = prints(&["--help"]);
    let listed = text.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    // Continuation lines are indented further.
    let names = listed.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    names.filter(|name| !name.is_empty() && *name != "help").map(str::to_owned).collect()
}

fn help(name: &str) -> String {
    prints(&[name, "--help"])
}

/// Returns the command lines below `Examples:` without their descriptions.
fn examples(help: &str) -> Vec<&str> {
    let lines = help.lines().skip_while(|line| *line != "Examples:").skip(1);
    let lines = lines.take_while(|line| !line.is_empty()).map(str::trim_start);
    lines.map(|line| line.split_once("  ").map_or(line, |(line, _)| line)).collect()
}

const STUDY: &str = "[study]\ntitle = \"Cell\"\ntolerance = \"1 mm\"\n[workspace.joints]\nsamples = 100\n";

const ROBOT: &str = r#"<robot name="robot">
<link name="base_link"/><link name="tool0"/>
<joint name="turn" type="continuous"><parent link="base_link"/><child link="tool0"/><origin xyz="0.3 0 0"/></joint>
</robot>"#;

/// Data of a UR5 whose second joint has another zero and whose third joint has the opposite sign.
const PENDANT: &str = "\
A1,A2,A3,A4,A5,A6,X,Y,Z,A,B,C
-62.9,100.6,31.2,24.9,30.2,-104.3,-564.47,648.70,50.42,-101.614,79.202,75.556
119.0,82.9,-80.8,-5.7,33.4,-83.9,404.89,-310.20,-328.12,122.232,16.872,115.495
5.6,147.9,-41.1,-104.6,62.0,21.9,-256.13,-188.22,-742.60,84.766,-19.190,-54.561
52.5,180.9,-51.4,101.1,-25.2,72.2,296.26,38.34,-576.41,121.007,42.349,62.644
90.9,-6.6,87.4,-67.9,111.7,-15.3,58.38,563.69,413.25,-156.043,14.893,22.874
-35.8,110.4,-20.2,97.0,43.7,102.9,-577.81,181.25,-297.32,-146.330,55.960,128.206
41.1,9.1,-86.6,111.5,97.1,16.6,-180.13,-283.43,413.11,-155.263,13.647,-60.774
-51.6,-14.8,-84.9,117.6,-98.8,72.1,-184.79,85.23,757.22,6.009,10.026,110.434
-49.5,154.5,-89.5,-109.4,27.5,-109.2,-30.36,-287.32,-570.35,132.485,61.312,-31.059
1.3,209.6,45.7,-101.5,23.9,-112.5,21.39,-212.29,-719.73,-75.589,41.045,169.437
";

const CALIBRATED: &str = "[manipulator]\nname = \"robot\"\nlength = \"m\"\n[[frame]]\nname = \"turn\"\n\
                          variable = { name = \"turn\", kind = \"revolute\", limits = [-3, 3] }\norigin = { xyz = [0.3, 0, 0] }\n";

/// The examples run in order: later ones read the output of earlier ones.
#[test]
fn examples_run() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("arm.toml"), readme::spec()).unwrap();
    fs::write(at.join("cell.toml"), STUDY).unwrap();
    fs::write(at.join("robot.urdf"), ROBOT).unwrap();
    fs::write(at.join("pendant.csv"), PENDANT).unwrap();
    fs::write(at.join("calibrated.toml"), CALIBRATED).unwrap();
    fs::write(
        at.join("x-axis.csv"),
        "position (mm),1+ (um),1- (um),2+ (um),2- (um)\n0,0,-1,0,-1\n100,3,0,3,0\n",
    )
    .unwrap();
    let diagonals = "diagonal,position (mm),1+ (um),1- (um)\nPPP,0,0,1\nPPP,500,4,3\n";
    fs::write(at.join("diagonals.csv"), diagonals).unwrap();
    let circle = "angle (deg),1+ (um),1- (um)\n0,1,0\n90,3,1\n180,4,2\n270,1,0\n";
    fs::write(at.join("ballbar.csv"), circle).unwrap();
    let program =
        "MODULE P\nCONST jointtarget a:=[[0,-80,80,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nENDMODULE\n";
    fs::write(at.join("part.mod"), program).unwrap();
    fs::write(at.join("dh.csv"), "theta,d,a,alpha\nq1,400,25,90\nq2,0,455,0\n").unwrap();
    let run = |line: &str| {
        let words = shell_words::split(line).unwrap();
        let output = command(&words[1..]).current_dir(at).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    };
    for name in commands() {
        if name == "monitor" {
            for (seed, day) in (1..).zip(["monday", "tuesday", "wednesday"]) {
                run(&format!("abbe simulate ur5 plan.csv --map ur5 --seed {seed} --out {day}.csv"));
            }
        }
        let text = help(&name);
        let examples = examples(&text);
        assert!(!examples.is_empty(), "{name}");
        for line in examples {
            assert!(line.starts_with(&format!("abbe {name}")), "{line}");
            run(line);
        }
    }
    examples(&prints(&["--help"])).into_iter().for_each(run);
}

#[test]
fn every_help_has_the_exit_status() {
    for name in commands() {
        let text = help(&name);
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        let status = text.split("Exit status:\n").nth(1).unwrap();
        let codes: Vec<&str> = status.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
        assert!(codes == ["0", "2", "128"] || codes == ["0", "1", "2", "128"], "{name}: {codes:?}");
    }
}

#[test]
fn the_reference_has_every_help() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reference/command.md");
    let text = fs::read_to_string(&path).unwrap();
    let heading = "## Every command\n";
    let (before, _) = text.split_once(heading).expect("the reference has its heading");
    let mut expected = format!("{before}{heading}");
    for name in commands() {
        let help: String = help(&name).lines().map(|line| line.trim_end().to_owned() + "\n").collect();
        expected += &format!("\n### abbe {name}\n\n```text\n{help}```\n");
    }
    expect_file![path].assert_eq(&expected);
}

/// Options of one name mean the same in every command that needs them.
#[test]
fn options_stand_wherever_they_make_sense() {
    let with = |option: &str| -> Vec<String> {
        let has =
            |name: &String| help(name).lines().any(|line| line.split_whitespace().any(|word| word == option));
        commands().into_iter().filter(has).collect()
    };
    let silent = ["new", "generate", "schema", "completions", "man"];
    let json: Vec<String> = commands().into_iter().filter(|name| !silent.contains(&name.as_str())).collect();
    assert_eq!(with("--json"), json);
    let measured = ["plan", "simulate", "measure", "identify", "compensate", "monitor"];
    assert_eq!(with("--threads"), [&["analyze", "bound", "allocate", "merge"][..], &measured].concat());
    let set = ["plan", "simulate", "measure", "identify", "compensate", "export", "monitor"];
    assert_eq!(
        with("--set"),
        [&["check", "jacobian", "analyze", "explore", "bound", "allocate", "doctor"][..], &set].concat()
    );
    assert_eq!(with("--scale"), with("--set"));
    assert_eq!(with("--seed"), ["analyze", "plan", "simulate", "export"]);
    for name in ["measure", "identify", "compensate", "monitor", "simulate"] {
        let usage = help(name).lines().find(|line| line.starts_with("Usage:")).unwrap().to_owned();
        let data = usage.find("DATA").unwrap();
        assert!(usage.find("<SPEC>").unwrap() < data, "{usage}");
    }
}

#[test]
fn every_shell_is_completed() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = prints(&["completions", shell]);
        assert!(script.contains("identify") && script.contains("monte-carlo"), "{shell}");
    }
    assert_eq!(abbe(&["completions", "tcsh"]).status, 2);
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("man1");
    prints(&["man", "--out", out.to_str().unwrap()]);
    let page = |name: &str| fs::read_to_string(out.join(format!("{name}.1"))).unwrap();
    for name in commands() {
        let text = page(&format!("abbe-{name}"));
        for expected in [".TH", ".SH EXAMPLES\n", ".SH \"EXIT STATUS\"\n", &format!("abbe {name}")] {
            assert!(text.contains(expected), "{name}: {expected}");
        }
    }
    assert!(page("abbe").contains("abbe\\-identify(1)"));
    // The other file is the record of written files.
    assert_eq!(fs::read_dir(&out).unwrap().count(), commands().len() + 2);
}

/// Every option that a document writes after `abbe COMMAND` exists in that command.
#[test]
fn documents_name_options_that_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = |name: &str| fs::read_dir(root.join(name)).unwrap().map(|entry| entry.unwrap().path());
    let pages = folder("docs")
        .chain(folder("docs/reference"))
        .chain([root.join("README.md"), root.join("manipulators/README.md")]);
    let pages = pages.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    let helps: Vec<(String, String)> =
        commands().into_iter().map(|name| (name.clone(), help(&name))).collect();
    let mut named = 0;
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        for line in text.split(['\n', '`']) {
            let line = line.trim_start_matches("$ ").split(" # ").next().unwrap_or_default();
            let Some((_, words)) = line.split_once("abbe ").filter(|(before, _)| before.is_empty()) else {
                continue;
            };
            let mut words = words.split_whitespace();
            let name = words.next().unwrap_or_default();
            let Some((_, help)) = helps.iter().find(|(command, _)| command == name) else { continue };
            for option in words.filter(|word| word.starts_with("--")) {
                let option =
                    option.trim_end_matches(['.', ',', ')', ']']).split('=').next().unwrap_or_default();
                let known = help.split_whitespace().any(|word| word.trim_end_matches(',') == option);
                assert!(known || option == "--help", "{}: abbe {name} has no {option}", page.display());
                named += 1;
            }
        }
    }
    assert!(named > 50, "{named}");
}
