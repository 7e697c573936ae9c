//! Selected models of simulated arms whose errors no family has in full: gears with many periods
//! per turn, beside compliances and constant errors.

use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Report, Settings};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::Machine;
use abbe_tests::sample_size;

const LOADS: &str = "[[load]]\nname = \"arm\"\nmass = \"8 kg\"\nframe = \"elbow\"\npoint = [100, 0, 50]\n\n\
                     [[load]]\nname = \"gripper\"\nmass = \"3 kg\"\nframe = \"wrist 3\"\npoint = \"tool\"\n";

const BENT: &str = "\n[[source]]\nname = \"bent\"\nclass = \"repeatable\"\nframe = \"shoulder\"\n\
                    e_x = \"0.3 mm\"\ne_s = \"0.5 mrad\"\ne_p = \"0.4 mrad\"\n";

/// Returns a UR5 with loads and these sources, whose joints have these limits in degrees.
fn arm(sources: &str, [lower, upper]: [i32; 2]) -> Machine {
    let text = Machine::find("ur5").unwrap().text().unwrap();
    let nominal = &text[..text.find("[[source]]").unwrap()];
    let limits = format!("[\"{lower} deg\", \"{upper} deg\"], home = \"{} deg\"", (lower + upper) / 2);
    let nominal = nominal.replace(", home = \"-90 deg\"", "").replace("[\"-360 deg\", \"360 deg\"]", &limits);
    let text = format!("gravity = [0, 0, \"-9.80665 m/s^2\"]\n{nominal}{LOADS}{sources}");
    Machine::of_spec(Spec::parse("arm.toml", &text).unwrap(), "arm.toml")
}

/// Returns a compliance about three axes, in 1e-6/(N m).
fn elastic(frame: &str, compliance: u32) -> String {
    let entry = format!("\"{compliance}e-6/(N*m)\"");
    format!(
        "\n[[source]]\nname = \"elastic {frame}\"\nclass = \"repeatable\"\nframe = \"{frame}\"\n\
         compliance = {{ diagonal = [0, 0, 0, {entry}, {entry}, {entry}] }}\n"
    )
}

/// Returns errors of every joint with 7 and 19 periods per turn.
fn gears(size: &str) -> String {
    let gear = |joint: u32, times: u32| {
        format!(
            "\n[[source]]\nname = \"gear {times} of q{joint}\"\nclass = \"repeatable\"\njoint = \"q{joint}\"\n\
             error = \"{size} * sin({times}*q{joint} + {joint})\"\n"
        )
    };
    (1..=6).flat_map(|joint| [7, 19].map(|times| gear(joint, times))).collect()
}

fn map(machine: &Machine) -> Map {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"rad\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\n\n[joints]\n{joints}[point]\ncolumns = [\"x\", \"y\", \"z\"]\n\
         unit = \"mm\"\n[placement]\ntargets = [[\"90 mm\", \"-35 mm\", \"60 mm\"]]\n"
    );
    Map::parse("map.toml", &text, &machine.spec).unwrap()
}

fn measured(machine: &Machine, samples: usize, seed: u64) -> Data {
    let (machine, map, at) = (machine.clone(), map(machine), Places::Samples(samples));
    let job = Simulate { machine, map, at, noise: None, outliers: 0.0, random: false, seed };
    let observations = job.run(&mut ()).unwrap().observations;
    Data { file: "data.csv".to_owned(), observations, stations: vec![String::new()], ..Data::default() }
}

fn identified(limits: [i32; 2], data: &Data, test: &Data, terms: &[Family]) -> Report {
    let machine = arm("", limits);
    let (map, data, test) = (map(&machine), data.clone(), Some(test.clone()));
    let (terms, harmonics) = (terms.to_vec(), Vec::new());
    let (settings, accept) = (Settings::default(), Acceptance::default());
    let job = Identify { machine, map, data, test, terms, harmonics, settings, accept };
    job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn unseen(report: &Report) -> f64 {
    report.test.as_ref().unwrap().after.mean
}

/// Returns errors of every joint with this function of the joints.
fn of_joints(function: impl Fn(u32) -> String) -> String {
    let source = |joint: u32| {
        format!(
            "\n[[source]]\nname = \"of q{joint}\"\nclass = \"repeatable\"\njoint = \"q{joint}\"\n\
             error = \"0.3 mrad * {}\"\n",
            function(joint)
        )
    };
    (1..=5).map(source).collect()
}

/// On unseen rows, the model selected from all families is at most 1.05 times as bad as the best of
/// those selected from one family: a family that explains the data can lose its first term to
/// another that fits by chance, or to the number of candidates. Of the arms, five have compliances,
/// five eccentric gears, five errors with the sum of two joints, and five all of these.
#[test]
fn all_families_are_as_good_as_the_best_one() {
    const WHOLE: [i32; 2] = [-360, 360];
    let frames = ["base", "shoulder", "elbow"].map(|frame| elastic(frame, 8)).concat();
    let eccentric = of_joints(|joint| format!("sin(q{joint} + {joint})"));
    let coupled = of_joints(|joint| format!("sin(q{joint} + q{})", joint + 1)).replace("of q", "coupled q");
    let kinds = [frames.clone(), eccentric.clone(), coupled.clone(), frames + &eccentric + &coupled];
    let machines = (0..20).map(|i| (i / 4 + 1, &kinds[i as usize % 4], [50, 60, 100][i as usize % 3]));
    for (seed, sources, samples) in machines.take(sample_size(20).max(1)) {
        let real = arm(&format!("{sources}{}{BENT}", gears("0.1 mrad")), WHOLE);
        let (data, test) = (measured(&real, samples, seed), measured(&real, 200, 100));
        let error = |terms: &[Family]| unseen(&identified(WHOLE, &data, &test, terms));
        let families = Family::ALL.map(|family| error(&[family]));
        let (all, best) = (error(&Family::ALL), families.into_iter().fold(error(&[]), f64::min));
        println!("seed {seed}, {samples} rows: {all:.4} {families:.4?}, {:.3}", all / best);
        assert!(all <= 1.05 * best, "seed {seed}, {samples} rows: {all} {families:?}");
    }
}

/// The terms of the report are those that were fitted: the complete fit determines a term of each
/// group, and predicts unseen rows no worse than constant errors do. Where joints move a little,
/// harmonics are nearly combinations of constants, and the data tell less of them than their
/// priors.
#[test]
fn selected_terms_are_those_of_the_fit() {
    const PART: [i32; 2] = [-30, 10];
    let real = arm(&format!("{}{}{BENT}", elastic("shoulder", 8), gears("0.1 mrad")), PART);
    for seed in 1..4 {
        let data = measured(&real, 150, seed);
        for family in [Family::Joint, Family::Product] {
            let report = identified(PART, &data, &data, &[family]);
            let held: Vec<_> = report.terms.iter().filter(|term| term.lines.is_empty()).collect();
            assert!(!report.terms.is_empty() && held.is_empty(), "{family:?}, seed {seed}: {held:?}");
            let (crossed, constant) = (&report.cross_validation.after, report.cross_validation.constant);
            assert!(crossed.mean <= constant.unwrap().mean, "{family:?}, seed {seed}: {crossed:?}");
        }
    }
}

/// Terms that were fitted to a part of the ranges can be worse than constant errors beyond it: the
/// test rows show it, and the report says it.
#[test]
fn terms_that_fail_beyond_the_fitted_ranges_are_named() {
    const PART: [i32; 2] = [-30, 30];
    let real = |limits| arm(&format!("{}{}{BENT}", elastic("shoulder", 4), gears("0.1 mrad")), limits);
    let data = measured(&real(PART), 200, 1);
    for (limits, is_worse) in [(PART, false), ([-80, 80], true)] {
        let report = identified(PART, &data, &measured(&real(limits), 100, 2), &[Family::Joint]);
        let test = report.test.unwrap();
        let constant = test.constant.unwrap();
        assert_eq!(test.after.mean > constant.mean, is_worse, "{test:?}");
        let said = report.notes.iter().any(|note| note.contains("identify without `--terms`"));
        assert_eq!(said, is_worse, "{:?}", report.notes);
    }
}
