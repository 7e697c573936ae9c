//! Code of selected functions and under another name, and corrected commands whose arrays overlap.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use abbe::Manipulator;
use abbe::analysis::sampling::{arm_length, joint_sample, nominal_parameters};
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::is_tested;
use abbe_tests::needs::{Missing, tool};

use super::program::{STRICT, succeeds, write_files};

fn shipped(name: &str) -> Spec {
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == name).unwrap();
    Spec::parse(&format!("{name}.toml"), shipped.spec).unwrap()
}

/// Compiles selected functions alone, and links several machines of one spec: the object defines
/// nothing else, and the self-tests pass.
pub(crate) fn are_alone() -> Result<(), Missing> {
    tool("gcc", "")?;
    tool("nm", "")?;
    let names = SHIPPED.iter().map(|shipped| shipped.name).filter(|name| is_tested(name));
    for spec in names.map(shipped).chain([Spec::parse("long.toml", &long_chain()).unwrap()]) {
        for (real, only) in [
            (Real::Double, &["compensated", "pose"][..]),
            (Real::Float, &["compensated"]),
            (Real::Double, &["covariance"]),
        ] {
            let folder = tempfile::tempdir().unwrap();
            let mut objects = Vec::new();
            for name in ["left", "right"] {
                let spec = Spec { name: name.to_owned(), ..spec.clone() };
                write_files(folder.path(), Language::C(real).files_of(&spec, only));
                let [source, object] = ["c", "o"].map(|end| folder.path().join(format!("{name}.{end}")));
                let mut compile = Command::new("gcc");
                compile.args(STRICT).arg("-c").arg(&source).arg("-o").arg(&object);
                succeeds(&mut compile);
                let defined = succeeds(Command::new("nm").args(["--defined-only", "-g"]).arg(&object));
                let defined = String::from_utf8(defined).unwrap();
                let found: BTreeSet<String> = defined
                    .lines()
                    .filter_map(|line| line.rsplit_once(" T "))
                    .map(|(_, symbol)| symbol.to_owned())
                    .collect();
                let wanted = only.iter().copied().chain(["self_test"]);
                assert_eq!(found, wanted.map(|function| format!("{name}_{function}")).collect());
                objects.push(object);
            }
            let main = folder.path().join("main.c");
            let text = "#include \"left.h\"\n#include \"right.h\"\n\
                        int main(void) { return left_self_test() + right_self_test(); }\n";
            fs::write(&main, text).unwrap();
            let program = folder.path().join("program");
            let mut compile = Command::new("gcc");
            compile.args(STRICT).arg(&main).args(&objects).arg("-lm").arg("-o").arg(&program);
            succeeds(&mut compile);
            assert!(Command::new(&program).status().unwrap().success(), "{} {only:?}", spec.name);
        }
    }
    Ok(())
}

/// Gives `corrected` the array of `q`, and `correction` that of `last`: the results have the same
/// bits as in arrays of their own, with every optimization.
pub(crate) fn arrays_may_overlap() -> Result<(), Missing> {
    tool("gcc", "")?;
    let mut compilers = vec![
        &["gcc", "-O0"][..],
        &["gcc", "-O2"],
        &["gcc", "-O3", "-flto"],
        &["gcc", "-O3", "-march=native", "-flto"],
    ];
    if tool("clang", "").is_ok() {
        compilers.extend([&["clang", "-O1"][..], &["clang", "-O3"]]);
    }
    for name in ["pps", "ur5", "general6r"] {
        let spec = shipped(name);
        for compiler in &compilers {
            let folder = tempfile::tempdir().unwrap();
            write_files(folder.path(), Language::C(Real::Double).files_of(&spec, &["compensated"]));
            overlap(&spec, folder.path(), compiler);
        }
    }
    Ok(())
}

fn overlap(spec: &Spec, folder: &Path, compiler: &[&str]) {
    let name = &spec.name;
    let robot = Interpreter::new(spec.clone());
    let description = robot.description();
    let arm = arm_length(&robot, &nominal_parameters(description)).unwrap();
    let moved: Vec<usize> = (0..description.variables.len()).collect();
    let q: Vec<String> = (0..200)
        .map(|index| joint_sample(description, arm, &moved, index))
        .map(|q| q.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(", "))
        .map(|q| format!("{{ {q} }}"))
        .collect();
    let some = |is_some: bool, text: String| if is_some { text } else { String::new() };
    let s = some(!spec.parameters.is_empty(), format!("{name}_parameters, "));
    let u = some(!spec.inputs.is_empty(), format!("{name}_inputs, "));
    let call = |q: &str, last: &str, corrected: &str, correction: &str| {
        format!(
            "{name}_compensated({q}, {s}{u}{last}, {name}_change, {name}_largest, {name}_whole_pose, {corrected}, {correction}, \
             before, after)"
        )
    };
    let count = moved.len();
    let source = folder.join("main.c");
    let text = format!(
        "#include \"{name}.h\"\n#include <string.h>\n\
         static const double given[200][{count}] = {{ {} }};\n\
         int main(void)\n{{\n    double last[{count}] = {{ 0.0 }};\n    double both[{count}] = {{ 0.0 }};\n    \
         for (int k = 0; k < 200; k++) {{\n        \
         double q[{count}]; double apart[{count}]; double correction[{count}]; double before[6]; double after[6];\n        \
         memcpy(q, given[k], sizeof q);\n        \
         const int one = {};\n        const int other = {};\n        \
         if (one != other || memcmp(q, apart, sizeof q) != 0 || memcmp(both, correction, sizeof both) != 0) {{ return 1; }}\n        \
         memcpy(last, correction, sizeof last);\n    }}\n    return 0;\n}}\n",
        q.join(", "),
        call("given[k]", "last", "apart", "correction"),
        call("q", "both", "q", "both"),
    );
    fs::write(&source, text).unwrap();
    let program = folder.join("program");
    let mut compile = Command::new(compiler[0]);
    compile.args(STRICT).args(&compiler[1..]).arg(&source).arg(folder.join(format!("{name}.c")));
    succeeds(compile.arg("-lm").arg("-o").arg(&program));
    assert!(Command::new(&program).status().unwrap().success(), "{name} {compiler:?}");
}
