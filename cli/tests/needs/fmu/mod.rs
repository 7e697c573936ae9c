//! Functional mock-up units are valid, compile without warnings, and agree with the command. FMPy
//! simulates them.
//!
//! `PYTHON` names a Python that has FMPy, if `python3` has none.

mod agreement;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use abbe_codegen::print::{Fmi, Language};
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::languages::NAMES;
use abbe_tests::needs::{Missing, Tests, python, tool};
use abbe_tests::{is_tested, specs};
use tempfile::TempDir;

use self::agreement::assert_agreement;

pub(crate) const TESTS: Tests = &[
    ("shipped_robots_compiled_by_cc", (|| shipped_robots("cc", &["2", "3"]))),
    ("shipped_robots_compiled_by_fmpy", shipped_robots_compiled_by_fmpy),
    ("others", others),
    ("what_is_wrong_is_said", what_is_wrong_is_said),
    ("the_chapter_says_what_happens", the_chapter_says_what_happens),
    ("several_machines_in_one_program", several_machines_in_one_program),
];

/// Spec without joints, where nothing can be compensated. Two of its sources map to the same
/// identifier, and it has text that XML must escape.
const FIXED: &str = "[manipulator]\nname = \"fixed\"\nlength = \"m\"\ndescription = \"\\u0001 & <b>\"\n\
                     [inputs]\nheat = { value = \"1 K\", range = [\"0 K\", \"9 K\"], description = \"\\u0001 \\\"<\\n&\" }\n\
                     [[frame]]\nname = \"only\"\ntransform = \"Tz(1)\"\n[[source]]\nname = \"growth & <heat>\"\nclass = \"repeatable\"\n\
                     frame = \"only\"\ne_x = \"2e-5 m/K * heat\"\n\
                     [[source]]\nname = \"growth / [heat]\"\nclass = \"repeatable\"\nframe = \"only\"\ne_z = \"1e-5 m/K * heat\"\n\
                     magnitude = { value = 2 }\n";

fn shipped_robots(compiler: &str, versions: &[&str]) -> Result<(), Missing> {
    let python = simulation_python(compiler)?;
    for shipped in SHIPPED.iter().filter(|shipped| is_tested(shipped.name)) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        for version in versions {
            assert_agreement(&python, compiler, version, shipped.name, spec.clone());
        }
    }
    Ok(())
}

/// Half of the robots by each FMI version, because CMake is slow.
fn shipped_robots_compiled_by_fmpy() -> Result<(), Missing> {
    let python = simulation_python("fmpy")?;
    let shipped = SHIPPED.iter().filter(|shipped| is_tested(shipped.name));
    for (shipped, version) in shipped.zip(["3", "2"].into_iter().cycle()) {
        let spec = Spec::parse(&format!("{}.toml", shipped.name), shipped.spec).unwrap();
        assert_agreement(&python, "fmpy", version, shipped.name, spec);
    }
    Ok(())
}

/// A long chain, tables, names that are keywords, and a machine without joints.
fn others() -> Result<(), Missing> {
    let python = simulation_python("cc")?;
    let folder = tempfile::tempdir().unwrap();
    let written = [("long", long_chain()), ("names", NAMES.to_owned()), ("fixed", FIXED.to_owned())];
    let written = written.map(|(name, text)| {
        let path = folder.path().join(format!("{name}.toml"));
        fs::write(&path, text).unwrap();
        path
    });
    for path in written.into_iter().chain([specs::path("measured")]) {
        assert_agreement(&python, "cc", "3", path.to_str().unwrap(), Spec::read(&path).unwrap());
    }
    Ok(())
}

/// Invalid values, and a model description of another machine.
fn what_is_wrong_is_said() -> Result<(), Missing> {
    let python = simulation_python("cc")?;
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("fixed.toml");
    fs::write(&spec, FIXED).unwrap();
    for version in ["2", "3"] {
        let unit = unit(&folder, version, spec.to_str().unwrap(), "fixed");
        let said = script(&python, "refuse.py", &[&unit]);
        assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    }
    Ok(())
}

/// Symbols of two units in one program do not collide, in either FMI version.
fn several_machines_in_one_program() -> Result<(), Missing> {
    tool("cc", "")?;
    let folder = tempfile::tempdir().unwrap();
    let mut objects = Vec::new();
    let mut main = "#include <stdio.h>\n".to_owned();
    let mut calls = String::new();
    for (name, fmi) in [("ur5", Fmi::Three), ("scara", Fmi::Three), ("stanford", Fmi::Two), ("wam", Fmi::Two)]
    {
        let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
        let spec = Spec::parse(name, shipped.spec).unwrap();
        let at = folder.path().join(name);
        fs::create_dir(&at).unwrap();
        for file in Language::Fmu(fmi).files(&spec) {
            if let Some(source) = file.name.strip_prefix("sources/") {
                fs::write(at.join(source), file.text).unwrap();
            }
        }
        let fmi = fmi.name();
        let prefix = format!("-DFMI{fmi}_FUNCTION_PREFIX={name}_");
        for source in [format!("{name}.c"), format!("fmi-{fmi}.c")] {
            let object = folder.path().join(format!("{name}-{source}.o"));
            succeeds(Command::new("cc").args(["-c", &prefix, "-o"]).arg(&object).arg(at.join(source)));
            objects.push(object);
        }
        let function = format!("{name}_fmi{fmi}GetVersion");
        main += &format!("const char *{function}(void);\n");
        calls += &format!("    puts({function}());\n");
    }
    let [source, program] = ["main.c", "main"].map(|name| folder.path().join(name));
    fs::write(&source, format!("{main}int main(void)\n{{\n{calls}    return 0;\n}}\n")).unwrap();
    succeeds(Command::new("cc").arg("-o").arg(&program).arg(&source).args(&objects).arg("-lm"));
    assert_eq!(succeeds(&mut Command::new(&program)), "3.0\n3.0\n2.0\n2.0\n");
    Ok(())
}

/// The Python code in `docs/fmu.md` prints the output shown there.
fn the_chapter_says_what_happens() -> Result<(), Missing> {
    let python = simulation_python("fmpy")?;
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/fmu.md");
    let page = fs::read_to_string(page).unwrap();
    let blocks = page.split("```").skip(1).step_by(2).filter_map(|block| block.split_once('\n'));
    let folder = tempfile::tempdir().unwrap();
    let mut count = 0;
    for (language, block) in blocks {
        match language {
            "console" => {
                let line = block.lines().next().unwrap().strip_prefix("$ abbe ").unwrap();
                let run = Command::new(env!("CARGO_BIN_EXE_abbe"))
                    .args(line.split(' '))
                    .current_dir(&folder)
                    .output();
                assert!(run.unwrap().status.success(), "{line}");
            }
            "sh" => {
                for command in block.split("$ ").skip(1) {
                    let (line, expected) = command.split_once('\n').unwrap();
                    let line = line.replace("python ", &format!("'{python}' "));
                    let printed = succeeds(in_folder("sh", &python, &folder).args(["-c", &line]));
                    assert!(printed.contains(expected), "{line}: {printed}");
                    count += 1;
                }
            }
            "python" => {
                fs::write(folder.path().join("block.txt"), block).unwrap();
                succeeds(in_folder(&python, &python, &folder).args(["-m", "doctest", "block.txt"]));
                count += 1;
            }
            _ => {}
        }
    }
    assert_eq!(count, 8);
    Ok(())
}

/// Creates a command that runs in a folder and finds CMake, which may be a Python package.
fn in_folder(program: &str, python: &str, folder: &TempDir) -> Command {
    let mut command = Command::new(program);
    let beside = Path::new(python).parent().unwrap_or(Path::new("")).to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(beside).chain(std::env::split_paths(&path));
    command.env("PATH", std::env::join_paths(all).unwrap()).current_dir(folder);
    command
}

fn succeeds(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let printed = String::from_utf8_lossy(&stdout).into_owned();
    assert!(status.success(), "{printed}{}", String::from_utf8_lossy(&stderr));
    printed
}

/// Returns the Python that runs the simulations, if all tools are installed.
fn simulation_python(compiler: &str) -> Result<String, Missing> {
    tool("cc", "")?;
    match compiler {
        // CMake may be a Python package.
        "fmpy" => python("fmpy, cmake"),
        _ => python("fmpy"),
    }
}

fn script(python: &str, name: &str, arguments: &[&Path]) -> Output {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/needs/fmu").join(name);
    Command::new(python).arg("-B").arg(script).args(arguments).output().expect("Python has just run")
}

fn abbe(arguments: &[&str]) -> Vec<u8> {
    let output = Command::new(env!("CARGO_BIN_EXE_abbe")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

/// Generates a unit with the command.
fn unit(folder: &TempDir, version: &str, machine: &str, name: &str) -> PathBuf {
    let unit = folder.path().join(format!("{name}.{version}.fmu"));
    abbe(&["generate", machine, "--lang", "fmu", "--fmi", version, "--out", unit.to_str().unwrap()]);
    unit
}
