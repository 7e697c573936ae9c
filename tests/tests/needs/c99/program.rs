//! A program around generated C.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use abbe::function::{COMMANDS, Signature};
use abbe::{Function, Manipulator};
use abbe_codegen::print::{Language, Real, SourceFile};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::languages::given_arrays;

/// Compiler options. Without `-ffp-contract=off` a compiler may round `a * b + c` once.
pub(crate) const STRICT: [&str; 9] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wconversion",
    "-Wdouble-promotion",
    "-Werror",
    "-O1",
    "-ffp-contract=off",
];

/// Writes the code of every function that has results, also of those that the code of a machine
/// without sources leaves out.
pub(crate) fn write(folder: &Path, spec: &Spec, real: Real) {
    let language = Language::C(real);
    write_files(folder, language.files_of(spec, &language.functions(spec)));
}

pub(crate) fn write_files(folder: &Path, files: Vec<SourceFile>) {
    for file in files {
        fs::write(folder.join(file.name), file.text).unwrap();
    }
}

/// Returns the functions that have results.
pub(crate) fn functions(robot: &Interpreter) -> Vec<Function> {
    let has_results = |function: &Function| {
        function.signature().results.iter().all(|array| !array.is_empty(robot.description()))
    };
    Function::all(robot.description()).filter(has_results).collect()
}

/// Returns the numbers of the self-test, and of every function and of compensated commands at every
/// configuration, each after its status.
pub(crate) fn called(
    compiler: &[&str],
    folder: &Path,
    robot: &Interpreter,
    real: Real,
    given: &[Vec<f64>],
) -> Vec<f64> {
    let [source, program, input] = ["main.c", "program", "input"].map(|name| folder.join(name));
    fs::write(&source, caller(robot, real)).unwrap();
    let given = given.iter().flatten().flat_map(|value| value.to_ne_bytes());
    fs::write(&input, given.collect::<Vec<u8>>()).unwrap();
    let own = folder.join(format!("{}.c", robot.description().name));
    compiled(compiler, &program, &[&own, &source]);
    let bytes = succeeds(Command::new(&program).stdin(fs::File::open(&input).unwrap()));
    bytes.chunks_exact(8).map(|bytes| f64::from_ne_bytes(bytes.try_into().unwrap())).collect()
}

/// Compiles sources with the common options, followed by those of the compiler.
pub(crate) fn compiled(compiler: &[&str], program: &Path, sources: &[&Path]) {
    let mut command = Command::new(compiler[0]);
    command.args(STRICT).args(&compiler[1..]).arg("-o").arg(program).args(sources).arg("-lm");
    succeeds(&mut command);
}

pub(crate) fn succeeds(command: &mut Command) -> Vec<u8> {
    let run = command.output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    run.stdout
}

/// Returns a program that reads configurations and writes the results of the functions.
pub(crate) fn caller(robot: &Interpreter, real: Real) -> String {
    let description = robot.description();
    let name = &description.name;
    let sizes: Vec<(&str, usize)> =
        given_arrays().into_iter().map(|array| (array.name, array.len(description))).collect();
    let count: usize = sizes.iter().map(|(_, size)| size).sum();
    let mut first = 0;
    let given = sizes.into_iter().map(|(name, size)| {
        first += size;
        format!("    const {real} *{name} = given + {}; (void){name};\n", first - size)
    });
    let call = |signature: &Signature| {
        let arrays = signature.results.iter().map(|array| (array.name, array.len(description)));
        let declared = arrays.clone().map(|(name, len)| format!("{real} {name}[{len}]; "));
        let names = signature.arguments.iter().chain(signature.results);
        let names = names.filter(|array| !array.is_empty(description)).map(|array| array.name);
        let written = arrays.map(|(name, len)| format!("put({name}, {len}); "));
        format!(
            "    {{ {}status = {name}_{}({}); put_one(status); {}}}\n",
            declared.collect::<String>(),
            signature.name,
            names.collect::<Vec<_>>().join(", "),
            written.collect::<String>()
        )
    };
    let functions = functions(robot).into_iter().map(Function::signature).chain(COMMANDS);
    format!(
        "#include \"{name}.h\"\n#include <stdio.h>\n\
         static void put_one(double number) {{ fwrite(&number, sizeof number, 1, stdout); }}\n\
         static void put(const {real} *numbers, int count) {{ for (int k = 0; k < count; k++) {{ put_one((double)numbers[k]); }} }}\n\
         int main(void)\n{{\n    double read[{count}];\n    {real} given[{count}];\n    int status = {name}_self_test();\n    put_one(status);\n    fflush(stdout);\n    \
         while (fread(read, sizeof(double), {count}, stdin) == {count}) {{\n    \
         for (int k = 0; k < {count}; k++) {{ given[k] = ({real})read[k]; }}\n{}{}    }}\n    return 0;\n}}\n",
        given.collect::<String>(),
        functions.map(call).collect::<String>(),
    )
}

/// Returns the result of the self-test, as a byte.
pub(crate) fn self_test(folder: &Path, name: &str, compiler: &[&str]) -> i32 {
    let program = folder.join("program");
    let sources = self_test_sources(folder, name);
    compiled(compiler, &program, &[&sources[0], &sources[1]]);
    Command::new(&program).status().unwrap().code().unwrap()
}

/// Writes a program that returns the result of the self-test, and returns its sources.
pub(crate) fn self_test_sources(folder: &Path, name: &str) -> [PathBuf; 2] {
    let source = folder.join("main.c");
    fs::write(&source, format!("#include \"{name}.h\"\nint main(void) {{ return {name}_self_test(); }}\n"))
        .unwrap();
    [folder.join(format!("{name}.c")), source]
}
