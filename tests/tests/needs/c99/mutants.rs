//! Mutants of generated C are found, by the self-test or by the comparison with Rust.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::process::{Command, Stdio};

use abbe::Manipulator;
use abbe_codegen::print::{Language, Real};
use abbe_interpreter::Interpreter;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::languages::configurations;
use abbe_tests::mutants::{Mutant, WITHOUT_EFFECT, mutants};
use abbe_tests::needs::{Missing, succeeds_in_time, tool};
use abbe_tests::specs;

use super::compare;
use super::program::caller;

/// Check that finds a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Finder {
    SelfTest,
    Comparison,
    Nobody,
}

/// Checks one mutant of each kind in each function in a thorough run, and a tenth of them
/// otherwise. Functions that all sources share are mutated for three joints and for six, which take
/// different branches; one of the two has to tell.
pub(crate) fn are_found() -> Result<(), Missing> {
    tool("cc", "")?;
    let six_joints = SHIPPED.iter().find(|shipped| shipped.name == "pps").unwrap();
    let six_joints = Spec::parse("pps.toml", six_joints.spec).unwrap();
    let measured = Spec::read(specs::path("measured")).unwrap();
    let six_joints = [(measured, false), (six_joints, true)].map(|(spec, is_second)| {
        let (name, source) = (spec.name.clone(), Source::new(spec));
        assert_eq!(source.finder(&source.text), Finder::Nobody, "{name}");
        let is_own = |function: &str| {
            function.starts_with(&format!("{name}_"))
                && !["compensated", "begin"].iter().any(|command| function.ends_with(command))
        };
        let is_test = ["self_test", "sums_to", "follows_ieee", "_right"];
        let is_left_out = |function: &str| {
            is_test.iter().any(|end| function.ends_with(end)) || is_second && is_own(function)
        };
        let all = mutants(&source.text, 1, |function| !is_left_out(function));
        let chosen: Vec<&Mutant> = all.iter().filter(|mutant| mutant.is_tried(&format!("{name}_"))).collect();
        let finders: Vec<Finder> = chosen.iter().map(|mutant| source.finder(&mutant.text)).collect();
        let by_test = finders.iter().filter(|finder| **finder == Finder::SelfTest).count();
        println!("{name}: {} mutants, {by_test} found by the self-test", chosen.len());
        let survivors = chosen.iter().zip(finders).filter(|(_, finder)| *finder == Finder::Nobody);
        let (own, shared): (Vec<_>, Vec<_>) = survivors.partition(|(mutant, _)| is_own(&mutant.function));
        assert!(own.is_empty(), "{own:#?}");
        let shared = shared.into_iter().map(|(Mutant { function, kind, line, .. }, _)| {
            ((function.replace(&format!("{name}_"), ""), *kind), line.clone())
        });
        shared.collect::<BTreeMap<_, _>>()
    });
    let [three, mut six] = six_joints;
    six.retain(|(function, kind), _| {
        let mutant = (&function[..], *kind);
        let has_effect = !WITHOUT_EFFECT.contains(&mutant) && !WITHOUT_EFFECT_IN_C.contains(&mutant);
        three.contains_key(&(function.clone(), *kind)) && has_effect
    });
    assert!(six.is_empty(), "{six:#?}");
    Ok(())
}

/// Mutants that no run tells from the source, in C only. A truth value of 0.5 is 0. The last part
/// of π/2 has an effect only next to its multiples.
const WITHOUT_EFFECT_IN_C: [(&str, &str); 2] = [("compensated", "number"), ("sin_cos_2", "number")];

/// Source of a manipulator, and a folder with its header and a program that calls its functions.
struct Source {
    folder: tempfile::TempDir,
    robot: Interpreter,
    given: Vec<Vec<f64>>,
    text: String,
}

impl Source {
    fn new(spec: Spec) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut files = Language::C(Real::Double).files(&spec);
        files.iter().for_each(|file| fs::write(folder.path().join(&file.name), &file.text).unwrap());
        let robot = Interpreter::new(spec);
        fs::write(folder.path().join("main.c"), caller(&robot, Real::Double)).unwrap();
        let mut given = configurations(&robot, 40);
        let mut beyond = given[0].clone();
        let description = robot.description();
        let first = description.variables.len() + description.parameters.len();
        beyond[first] = description.inputs[0].range[1] + 1.0;
        given.push(beyond);
        let bytes = given.iter().flatten().flat_map(|value| value.to_ne_bytes());
        fs::write(folder.path().join("input"), bytes.collect::<Vec<u8>>()).unwrap();
        Self { folder, robot, given, text: files.remove(1).text }
    }

    /// Compiles and runs a text in place of the source.
    fn finder(&self, text: &str) -> Finder {
        let [source, main, program, input, output] =
            ["mutant.c", "main.c", "program", "input", "output"].map(|name| self.folder.path().join(name));
        fs::write(&source, text).unwrap();
        let mut compile = Command::new("cc");
        compile.args(["-std=c99", "-O0", "-w", "-ffp-contract=off", "-o"]).arg(&program);
        let compiled = compile.args([&source, &main]).arg("-lm").output().unwrap();
        assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
        let mut run = Command::new(&program);
        run.stdin(File::open(&input).unwrap()).stdout(File::create(&output).unwrap()).stderr(Stdio::null());
        let has_ended = succeeds_in_time(&mut run);
        let bytes = fs::read(&output).unwrap();
        let found: Vec<f64> =
            bytes.as_chunks::<8>().0.iter().map(|bytes| f64::from_ne_bytes(*bytes)).collect();
        match found.first() {
            Some(0.0) if has_ended && compare(&self.robot, &self.given, &found[1..]).is_ok() => {
                Finder::Nobody
            }
            // The number is written before the functions are called.
            Some(0.0) => Finder::Comparison,
            _ => Finder::SelfTest,
        }
    }
}
