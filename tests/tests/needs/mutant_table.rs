//! Every site of the routines is made wrong, in each language, and counted by function: mutants
//! that the self-test of C finds, or the comparison with Rust that the other languages have in its
//! place, those of the rest that are harmless, because 300 random calls have the same results, and
//! those that are missed.
//!
//! An ordinary run tries a sample with a fixed seed; `MUTANTS=200` sets the size of the sample.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};

use abbe::analysis::sampling::halton;
use abbe::compensator::{CHANGE, LARGEST, bound};
use abbe::function::{Array, COMMANDS, Signature};
use abbe::{Function, Manipulator, Quantity};
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::languages::{arguments, configurations, given_arrays};
use abbe_tests::mutants::Mutant;
use abbe_tests::mutants::every_site::{Syntax, every_mutant};
use abbe_tests::needs::{self, Missing, Tests, succeeds_in_time, tool};
use abbe_tests::specs;
use abbe_tests::structured_text::Program;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_xoshiro::Xoshiro256PlusPlus;
use rayon::prelude::*;
use serde_json::Value;

use crate::c99::program::{caller, functions};
use crate::languages::{called, command};

pub(crate) const TESTS: Tests = &[
    ("sample", sample),
    ("c_functions", || table(Language::C(Real::Double), FUNCTIONS)),
    ("c_commands", || table(Language::C(Real::Double), COMMAND_NAMES)),
    ("c_shared", || table(Language::C(Real::Double), SHARED)),
    ("javascript_functions", || table(Language::JavaScript, FUNCTIONS)),
    ("javascript_commands", || table(Language::JavaScript, COMMAND_NAMES)),
    ("javascript_shared", || table(Language::JavaScript, SHARED)),
    ("python_functions", || table(Language::Python, FUNCTIONS)),
    ("python_commands", || table(Language::Python, COMMAND_NAMES)),
    ("python_shared", || table(Language::Python, SHARED)),
    ("structured_text_functions", || table(Language::StructuredText, FUNCTIONS)),
    ("structured_text_commands", || table(Language::StructuredText, COMMAND_NAMES)),
    ("structured_text_shared", || table(Language::StructuredText, SHARED)),
];

const FUNCTIONS: &[&str] = &["pose", "error_jacobian", "inverse", "passive"];
const COMMAND_NAMES: &[&str] = &["compensated", "begin"];
/// Procedures of corrected commands and of inverse kinematics.
const SHARED: &[&str] =
    &["deviation", "weighted", "cost", "shortest", "clamped", "least", "greatest", "side"];

/// Least number of mutants that are caught for each one that is missed.
const CAUGHT: usize = 4;

/// Number of calls of the comparison with Rust, and of those that tell harmless mutants.
const CALLS: [usize; 2] = [40, 300];

/// Counts of a function.
#[derive(Clone, Copy, Debug, Default)]
struct Row {
    sites: usize,
    caught: usize,
    harmless: usize,
    missed: usize,
}

/// Outcome of a mutant; the results of all calls if no test finds it.
enum Outcome {
    Invalid,
    Caught,
    Results(Vec<f64>),
}

/// Tries a few mutants in each language that can run here: some are found.
fn sample() -> Result<(), Missing> {
    let all = [FUNCTIONS, COMMAND_NAMES, SHARED].concat();
    let c = Language::C(Real::Double);
    // A language without its tool is left out.
    let counted = [c, Language::JavaScript, Language::Python, Language::StructuredText]
        .map(|language| counted(language, &all, Some(SAMPLE)).unwrap_or_default());
    let rows = counted.iter().flat_map(BTreeMap::values);
    let [sites, caught] = rows.fold([0; 2], |[sites, caught], row| [sites + row.sites, caught + row.caught]);
    assert!(4 * caught > sites, "{caught} of {sites}");
    Ok(())
}

/// Tries every mutant, or as many as `MUTANTS` says.
fn table(language: Language, names: &[&str]) -> Result<(), Missing> {
    let asked = std::env::var("MUTANTS").ok().and_then(|count| count.parse().ok());
    if asked.is_none() {
        needs::thorough()?;
    }
    let rows = counted(language, names, asked)?;
    let [caught, missed] =
        rows.values().fold([0; 2], |[caught, missed], row| [caught + row.caught, missed + row.missed]);
    assert!(caught > 0 && caught >= CAUGHT * missed, "{}: {caught} caught, {missed} missed", language.name());
    Ok(())
}

/// Makes mutants of functions, at most a number of each machine, and counts them by function.
fn counted(
    language: Language,
    names: &[&str],
    most: Option<usize>,
) -> Result<BTreeMap<String, Row>, Missing> {
    let command = match language {
        Language::C(_) => tool("gcc", "").map(|_| vec![])?,
        Language::StructuredText => vec![],
        _ => command(language)?,
    };
    let mut table: BTreeMap<String, Row> = BTreeMap::new();
    let mut missed = Vec::new();
    let pps = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let machines = [
        (Spec::parse("pps.toml", pps.spec).unwrap(), names.to_vec()),
        (
            Spec::read(specs::path("linkage")).unwrap(),
            names.iter().copied().filter(|name| *name == "passive" && most != Some(SAMPLE)).collect(),
        ),
    ];
    for (spec, names) in machines.into_iter().filter(|(_, names)| !names.is_empty()) {
        let source = Source::new(language, command.clone(), spec);
        let syntax = match language {
            Language::Python => Syntax::Python,
            Language::StructuredText => Syntax::StructuredText,
            _ => Syntax::Braces,
        };
        let own = |function: &str| source.own_name(function);
        let mut all = every_mutant(&source.text, syntax, |function| names.contains(&&own(function)[..]));
        if let Some(count) = most {
            all.shuffle(&mut Xoshiro256PlusPlus::seed_from_u64(53));
            all.truncate(count);
        }
        let outcomes: Vec<(&Mutant, Option<[bool; 2]>)> =
            all.par_iter().with_max_len(1).map(|mutant| (mutant, source.judged(mutant))).collect();
        for (mutant, outcome) in outcomes {
            let Some([is_caught, is_harmless]) = outcome else { continue };
            let row = table.entry(own(&mutant.function)).or_default();
            row.sites += 1;
            row.caught += usize::from(is_caught);
            row.harmless += usize::from(is_harmless && !is_caught);
            row.missed += usize::from(!is_harmless && !is_caught);
            if !is_harmless && !is_caught {
                missed.push(format!("{} {}: {}", own(&mutant.function), mutant.kind, mutant.line));
            }
        }
    }
    println!(
        "{:<16} {:<15} {:>6} {:>7} {:>9} {:>7}",
        "language", "function", "sites", "caught", "harmless", "missed"
    );
    for (function, Row { sites, caught, harmless, missed }) in &table {
        println!("{:<16} {function:<15} {sites:>6} {caught:>7} {harmless:>9} {missed:>7}", language.name());
    }
    missed.iter().for_each(|mutant| println!("missed: {mutant}"));
    Ok(table)
}

/// Number of mutants in a language that an ordinary run tries.
const SAMPLE: usize = 4;

/// Generated code with its calls and their right results.
struct Source {
    language: Language,
    command: Vec<String>,
    folder: tempfile::TempDir,
    robot: Interpreter,
    names: Value,
    given: Vec<Vec<f64>>,
    text: String,
    right: Vec<f64>,
    /// Largest difference of each number that is none, and whether it is a status.
    tolerances: Vec<f64>,
}

impl Source {
    fn new(language: Language, command: Vec<String>, spec: Spec) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let is_c = matches!(language, Language::C(_));
        let files = match is_c {
            true => language.files_of(&spec, &language.functions(&spec)),
            false => language.files(&spec),
        };
        files.iter().for_each(|file| fs::write(folder.path().join(&file.name), &file.text).unwrap());
        let text = files[usize::from(is_c)].text.clone();
        let robot = Interpreter::new(spec);
        let given = calls(&robot, is_c);
        let bytes = |given: &[Vec<f64>]| {
            given.iter().flatten().flat_map(|value| value.to_ne_bytes()).collect::<Vec<u8>>()
        };
        fs::write(folder.path().join("input"), bytes(&given)).unwrap();
        fs::write(folder.path().join("main.c"), caller(&robot, Real::Double)).unwrap();
        if is_c {
            let main = ["-std=c99", "-O0", "-w", "-c", "-o", "main.o", "main.c"];
            assert!(Command::new("gcc").args(main).current_dir(&folder).status().unwrap().success());
        }
        let names = called(&robot);
        fs::write(folder.path().join("functions"), names.to_string()).unwrap();
        let mut source =
            Self { language, command, folder, robot, names, given, text, right: vec![], tolerances: vec![] };
        let Outcome::Results(right) = source.outcome(&source.text, "") else { panic!("the source is right") };
        source.tolerances = source.tolerances(&right);
        source.right = right;
        source
    }

    /// Returns the name of a function without that of the machine.
    fn own_name(&self, function: &str) -> String {
        let machine = format!("{}_", self.robot.description().name);
        let function = function.strip_prefix(&machine).unwrap_or(function);
        function.trim_start_matches('_').to_owned()
    }

    /// Returns whether a mutant is caught, and whether it is harmless; none if it is no program.
    fn judged(&self, mutant: &Mutant) -> Option<[bool; 2]> {
        let results = match self.outcome(&mutant.text, &self.own_name(&mutant.function)) {
            Outcome::Invalid => return None,
            Outcome::Caught => return Some([true, false]),
            Outcome::Results(results) => results,
        };
        let each = self.right.len() / self.given.len();
        let is_equal = |upto: usize| {
            let upto = upto * each;
            results.len() == self.right.len()
                && (0..upto).all(|k| {
                    let (a, b) = (results[k], self.right[k]);
                    a.to_bits() == b.to_bits()
                        || a.is_nan() && b.is_nan()
                        || (a - b).abs() <= self.tolerances[k]
                        || self.tolerances[k].is_nan()
                })
        };
        let [compared, all] = [CALLS[0], self.given.len()].map(is_equal);
        let is_compared = !matches!(self.language, Language::C(_));
        Some([is_compared && !compared, all])
    }

    /// Runs a text in place of the source. In Structured Text only a block that is changed runs.
    fn outcome(&self, text: &str, function: &str) -> Outcome {
        if self.language == Language::StructuredText {
            return self.structured_text(text, function);
        }
        let folder = tempfile::tempdir_in(&self.folder).unwrap();
        let [program, output] = ["program", "output"].map(|name| folder.path().join(name));
        let [input, functions] = ["input", "functions"].map(|name| self.folder.path().join(name));
        let mut run = if let Language::C(_) = self.language {
            let source = folder.path().join("mutant.c");
            fs::write(&source, text).unwrap();
            let mut compile = Command::new("gcc");
            compile.args(["-std=c99", "-O0", "-w", "-ffp-contract=off", "-I"]).arg(self.folder.path());
            compile.arg("-o").arg(&program).arg(&source).arg(self.folder.path().join("main.o")).arg("-lm");
            if !compile.stderr(Stdio::null()).status().unwrap().success() {
                return Outcome::Invalid;
            }
            let mut run = Command::new(&program);
            run.stdin(File::open(&input).unwrap()).stdout(File::create(&output).unwrap());
            run
        } else {
            let [module, script] = match self.language {
                Language::JavaScript => ["module.mjs", "run.mjs"],
                _ => ["module.py", "run.py"],
            };
            let module = folder.path().join(module);
            fs::write(&module, text).unwrap();
            let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("languages").join(script);
            let mut run = Command::new(&self.command[0]);
            run.args(&self.command[1..]).arg(script).args([&module, &functions, &input, &output]);
            run.env("OMP_NUM_THREADS", "1")
                .env("OPENBLAS_NUM_THREADS", "1")
                .stdin(Stdio::null())
                .stdout(Stdio::null());
            run
        };
        let has_ended = succeeds_in_time(run.stderr(Stdio::null()));
        let bytes = fs::read(&output).unwrap_or_default();
        let numbers = bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_ne_bytes(*bytes));
        let mut numbers: Vec<f64> = numbers.collect();
        // The number of the self-test is written before the calls, which may not end.
        let is_c = matches!(self.language, Language::C(_));
        if is_c && (numbers.is_empty() || numbers.remove(0) != 0.0) || !is_c && !has_ended {
            return Outcome::Caught;
        }
        Outcome::Results(numbers)
    }

    /// Functions that are called, with the arrays of their results.
    fn called(&self) -> Vec<&'static Signature> {
        let functions = match self.language {
            Language::C(_) => functions(&self.robot),
            _ => Function::all(self.robot.description()).collect(),
        };
        functions.into_iter().map(Function::signature).chain(COMMANDS).collect()
    }

    fn structured_text(&self, text: &str, function: &str) -> Outcome {
        let name = &self.robot.description().name;
        let Ok(mut program) = Program::parse(text) else { return Outcome::Invalid };
        program.replace(&format!("{name}_arctangent"), f64::atan2);
        let mut results = Vec::new();
        let mut blocks: Vec<_> = self
            .called()
            .into_iter()
            .map(|signature| (signature, program.instance(&format!("{name}_{}", signature.name))))
            .collect();
        for given in &self.given {
            for (signature, block) in &mut blocks {
                let is_called = match function {
                    "" => FUNCTIONS.contains(&signature.name) || COMMAND_NAMES.contains(&signature.name),
                    _ if SHARED.contains(&function) => {
                        COMMAND_NAMES.contains(&signature.name) || signature.name == "inverse"
                    }
                    own => own == signature.name,
                };
                let from = results.len();
                let lens = signature.results.iter().map(|array| array.len(self.robot.description()));
                let count: usize = lens.sum();
                if !is_called {
                    // What is not called is as before.
                    match self.right.get(from..=from + count) {
                        Some(right) => results.extend(right),
                        None => results.extend(vec![f64::NAN; count + 1]),
                    }
                    continue;
                }
                let numbers = arguments(&self.robot, signature, given);
                let mut rest = &numbers[..];
                for array in signature.arguments {
                    let (values, others) = rest.split_at(array.len(self.robot.description()));
                    let name = match array.name {
                        "s" => "parameters",
                        "u" => "inputs",
                        name => name,
                    };
                    // The block keeps the correction before, and has no infinite bounds.
                    if !values.is_empty() && name != "last" {
                        block.set(
                            name,
                            &values.iter().map(|value| value.clamp(-1e30, 1e30)).collect::<Vec<_>>(),
                        );
                    }
                    rest = others;
                }
                if block.call().is_err() {
                    return Outcome::Caught;
                }
                results.extend(block.get("status"));
                for array in
                    signature.results.iter().filter(|array| !array.is_empty(self.robot.description()))
                {
                    results.extend(block.get(array.name));
                }
            }
            // The comparison ends at its first difference.
            let begin = self.right.len() / self.given.len();
            let at = results.len() - results.len().min(begin);
            let differs = |k: usize| (results[k] - self.right[k]).abs() > self.tolerances[k];
            if !self.right.is_empty() && at < CALLS[0] * begin && (at..results.len()).any(differs) {
                return Outcome::Caught;
            }
        }
        Outcome::Results(results)
    }

    /// Returns the largest difference of each result that the self-test permits; NaN for results
    /// of what is refused.
    fn tolerances(&self, right: &[f64]) -> Vec<f64> {
        let description = self.robot.description();
        let metre = 1.0 / description.length.in_metres();
        let is_first = matches!(self.language, Language::C(_) | Language::StructuredText);
        let mut tolerances: Vec<f64> = Vec::new();
        while tolerances.len() < right.len() {
            for signature in self.called() {
                let is_command = COMMANDS.contains(&signature);
                if is_first {
                    tolerances.push(0.0);
                }
                let status = is_first.then(|| right[tolerances.len() - 1]);
                let has_results = status.is_none_or(|status| status == 0.0 || status > 3.0);
                for array in signature.results {
                    let len = array.len(description);
                    let own = &right[tolerances.len()..][..len];
                    let largest = own.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
                    let one = |k: usize| match () {
                        () if !has_results => f64::NAN,
                        () if !is_command => 1e-12 * largest,
                        () if array.quantity == Quantity::Displacement => 2e-9 * [metre, 1.0][k / 3],
                        () => 2e-9 * description.variables[k].kind.either(1.0, metre),
                    };
                    tolerances.extend((0..len).map(one));
                }
                if !is_first {
                    // The margin, or the status.
                    let has_more = is_command || signature.has_margin(description.orientation);
                    tolerances.extend(has_more.then_some(if is_command { 0.0 } else { 1e-12 }));
                }
            }
        }
        assert_eq!(tolerances.len(), right.len(), "{}", self.names);
        tolerances
    }
}

/// Returns random calls: at limits and beyond them, with bounds of several sizes, with free
/// rotations, and, if `has_wrong`, with what is refused.
fn calls(robot: &Interpreter, has_wrong: bool) -> Vec<Vec<f64>> {
    let description = robot.description();
    let variables = &description.variables;
    let mut first = BTreeMap::new();
    let mut end = 0;
    for array in given_arrays() {
        first.insert(array.name, end..end + array.len(description));
        end += Array::len(array, description);
    }
    let mut all = configurations(robot, CALLS[1]);
    for (index, given) in all.iter_mut().enumerate() {
        let random = |k: usize| halton(index + 1, k % 30);
        let j = (index / 8) % variables.len();
        let [lower, upper] = variables[j].limits;
        let beyond = 0.001 * (upper - lower);
        match index % 8 {
            2 if beyond.is_finite() => {
                given[j] = if index % 32 < 16 { lower - beyond } else { upper + beyond };
            }
            7 if beyond.is_finite() => given[j] = if index % 32 < 16 { lower } else { upper },
            4 => {
                for (j, one) in variables.iter().enumerate() {
                    let [change, largest] = [CHANGE, LARGEST].map(|both| bound(description, one.kind, both));
                    given[first["last"].start + j] = 8.0 * change * (random(j + 7) - 0.5);
                    given[first["change"].start + j] = 2.0 * change * random(j + 11);
                    given[first["largest"].start + j] = 0.3 * largest * random(j + 13);
                }
            }
            6 => {
                for k in first["rotations"].clone() {
                    given[k] = if random(k) < 0.5 { 0.0 } else { 1.0 };
                }
            }
            _ => {}
        }
        if has_wrong && index % 25 == 24 {
            let ranges: Vec<_> = first.values().filter(|range| !range.is_empty()).collect();
            let range = ranges[(index / 25) % ranges.len()];
            given[range.start + index % range.len()] = if index % 2 == 0 { f64::NAN } else { 1e9 };
        }
    }
    all
}
