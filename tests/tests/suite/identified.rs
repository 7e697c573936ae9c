//! Simulated machines with known errors are identified: magnitudes of sources of the spec, zeros of
//! joints in words, backlash and gears as terms of a spec.

use std::time::Duration;

use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Harmonics, Identify, Kind, Magnitude, Prior, Report, Settings};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_metrology::{Acceptance, measure};
use abbe_spec::Spec;
use abbe_study::Machine;

const POINT: &str = "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";

const POSE: &str = "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
                    quaternion = { columns = [\"qw\", \"qx\", \"qy\", \"qz\"], order = \"wxyz\" }\n";

/// Returns a UR5 without random errors, with these sources.
fn ur5(sources: &str) -> String {
    let (_, text) = abbe_manipulators::SHIPPED
        .iter()
        .map(|one| (one.name, one.spec))
        .find(|(name, _)| *name == "ur5")
        .expect("it is shipped");
    let nominal = &text[..text.find("[[source]]").expect("it has sources")];
    format!("{nominal}{sources}")
}

fn machine(text: &str) -> Machine {
    Machine::of_spec(Spec::parse("ur5.toml", text).expect("a spec"), "ur5.toml")
}

fn map(base: &str, layout: &str, machine: &Machine) -> Map {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"rad\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.05 mrad\"\nbase = {base:?}\n\n[joints]\n{joints}{layout}"
    );
    Map::parse("map.toml", &text, &machine.spec).expect("a map")
}

/// Simulates measurements at random configurations.
fn measured(truth: &str, base: &str, layout: &str, samples: usize, seed: u64) -> Data {
    let machine = machine(truth);
    let map = map(base, layout, &machine);
    let job = Simulate {
        machine,
        map,
        at: Places::Samples(samples),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    let observations = job.run(&mut ()).expect("it is simulated").observations;
    Data { file: "data.csv".to_owned(), observations, ..Data::default() }
}

fn job(nominal: &str, base: &str, layout: &str, data: &Data) -> Identify {
    let machine = machine(nominal);
    let map = map(base, layout, &machine);
    let settings = Settings {
        loss: abbe::identify::Loss::Squares,
        prior: Prior::default(),
        folds: 10,
        time: None,
        points: false,
        only_placement: false,
    };
    let (data, terms, harmonics) = (data.clone(), Vec::new(), Vec::new());
    Identify { machine, map, data, test: None, terms, harmonics, settings, accept: Acceptance::default() }
}

/// Returns the identified machine as a spec.
fn written(report: &Report, nominal: &str) -> String {
    let machine = machine(nominal);
    report.found.identified_spec(&machine.spec, nominal, "found.toml").expect("it is a spec").text
}

/// Returns the residual of the written spec and map on the measurements.
fn left(report: &Report, nominal: &str, base: &str, layout: &str, data: &Data) -> f64 {
    let found = machine(&written(report, nominal));
    let map = map(base, layout, &machine(nominal));
    let map = report.found.identified_map(&map, &found.spec, "found.map.toml");
    let map = Map::parse("found.map.toml", &map.expect("it is a map"), &found.spec).expect("it is a map");
    let (data, accept) = (data.clone(), Acceptance::default());
    let job = measure::Measure { machine: found, map, data, accept };
    job.run(&mut ()).expect("it is measured").explained.left_rms
}

const WINDUP: &str = "[[source]]\nname = \"windup\"\nclass = \"repeatable\"\njoint = \"q3\"\n\
                      error = \"sign(cos(q2)) * 1 mrad\"\nmagnitude = { value = 0, standard_deviation = 1 }\n";

const SAG: &str = "[[source]]\nname = \"sag\"\nclass = \"repeatable\"\nframe = \"shoulder\"\n\
                   compliance = { diagonal = [0, 0, 0, \"1e-4/(N*m)\", \"1e-4/(N*m)\", \"1e-4/(N*m)\"] }\n\n\
                   [source.magnitude]\nvalue = 0.2\n\n\
                   [[load]]\nname = \"gripper\"\nmass = \"1 kg\"\nframe = \"wrist 3\"\npoint = \"tool\"\n";

const BENT: &str = "\n[[source]]\nname = \"bent\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_s = \"0.8 mrad\"\ne_x = \"0.3 mm\"\n";

/// Checks magnitudes: the spec states 0 ± 1, or 0.2, the machine has 0.7. The value is found and
/// written to the spec.
#[test]
fn magnitudes_of_sources_are_found() {
    let gravity = "gravity = [0, 0, \"-9.80665 m/s^2\"]\n";
    for (source, of_machine, gravity) in [
        (WINDUP, WINDUP.replace("value = 0,", "value = 0.7,"), ""),
        (SAG, SAG.replace("0.2", "0.7"), gravity),
    ] {
        let nominal = format!("{gravity}{}", ur5(source));
        let truth = format!("{gravity}{}", ur5(&format!("{of_machine}{BENT}")));
        let data = measured(&truth, "exact", POINT, 200, 3);
        let report = job(&nominal, "exact", POINT, &data).run(&mut ()).expect("it is identified");
        let [found] = &report.magnitudes[..] else { panic!("one magnitude: {:?}", report.magnitudes) };
        let deviation = found.standard_deviation.expect("it can be known");
        assert!((found.value - 0.7).abs() < 4.0 * deviation, "{found:?}");
        assert!(deviation < 0.05, "{found:?}");
        let parameter = report.parameters.iter().find(|one| one.name == found.source).expect("a parameter");
        assert_eq!(parameter.value, found.value);
        let spec = Spec::parse("found.toml", &written(&report, &nominal)).expect("a spec");
        let source = spec.sources.iter().find(|one| one.name == found.source).expect("its source");
        let magnitude = source.magnitude.expect("a magnitude");
        assert!((magnitude.value - found.value).abs() < 1e-6 * found.value);
        assert!((magnitude.standard_deviation.unwrap() - deviation).abs() < 0.01 * deviation);
        // A second fit starts at the value found.
        let again = job(&written(&report, &nominal), "exact", POINT, &data).run(&mut ()).unwrap();
        assert!((again.magnitudes[0].value - found.value).abs() < 0.1 * deviation, "{:?}", again.magnitudes);
    }
}

/// Checks that a constant joint error, which is equivalent to errors of frames, is attributed to
/// the named source.
#[test]
fn a_named_source_is_kept_before_errors_that_act_alike() {
    let zero = "[[source]]\nname = \"zero\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"1 mrad\"\nmagnitude = { value = 0 }\n";
    let data = measured(&ur5(&zero.replace("{ value = 0 }", "{ value = 1.5 }")), "exact", POINT, 100, 4);
    let report = job(&ur5(zero), "exact", POINT, &data).run(&mut ()).unwrap();
    let [found] = &report.magnitudes[..] else { panic!("one magnitude") };
    assert!(
        (found.value - 1.5).abs() < 4.0 * found.standard_deviation.expect("it can be known"),
        "{found:?}"
    );
    assert!(
        report.joint_errors.iter().all(|meaning| meaning.number != "zero of q2"),
        "{:?}",
        report.joint_errors
    );
    // A source without an observable effect is reported.
    let hidden = zero.replace("joint = \"q2\"\nerror = \"1 mrad\"", "frame = \"wrist 3\"\ne_p = \"1 mrad\"");
    let report = job(&ur5(&hidden), "exact", POINT, &data).run(&mut ()).unwrap();
    assert_eq!(report.magnitudes[0].standard_deviation, None);
}

/// Two magnitudes act as each other: their sum is determined, and each has its share of it, by its
/// prior.
#[test]
fn magnitudes_that_act_alike_are_said_as_a_sum() {
    let source = |name: &str, error: &str, value: f64| {
        format!(
            "[[source]]\nname = {name:?}\nclass = \"repeatable\"\njoint = \"q2\"\nerror = {error:?}\n\
             magnitude = {{ value = {value}, standard_deviation = 3 }}\n\n"
        )
    };
    let both = |one: f64, other: f64| {
        ur5(&(source("encoder", "1 mrad", one) + &source("coupling", "0.5 mrad", other)))
    };
    let data = measured(&both(1.0, 1.0), "exact", POINT, 100, 4);
    let report = job(&both(0.0, 0.0), "exact", POINT, &data).run(&mut ()).unwrap();
    let [encoder, coupling] = &report.magnitudes[..] else { panic!("{:?}", report.magnitudes) };
    let sum = encoder.sum.as_ref().expect("a sum");
    let [(_, one), (name, factor)] = &sum.of[..] else { panic!("{sum:?}") };
    assert!(*one == 1.0 && name == "coupling" && (factor - 0.5).abs() < 1e-6, "{sum:?}");
    assert!((sum.value - 1.5).abs() < 4.0 * sum.standard_deviation, "{sum:?}");
    assert!(sum.standard_deviation < 0.1, "{sum:?}");
    // Variances of 9 and 9 in the sum a + b/2 leave 9 (1 − 0.8) and 9 (1 − 0.2).
    let of = |magnitude: &Magnitude, value: f64, deviation: f64| {
        let found = magnitude.standard_deviation.unwrap();
        assert!((magnitude.value - value).abs() < 0.2 && (found - deviation).abs() < 0.1, "{magnitude:?}");
    };
    of(encoder, 1.2, 9.0_f64.sqrt() * 0.2_f64.sqrt());
    of(coupling, 0.6, 9.0_f64.sqrt() * 0.8_f64.sqrt());
}

const ZEROS: [f64; 6] = [0.7, -0.5, 1.1, -0.8, 0.6, 0.9];

fn zeros() -> String {
    let source = |(i, zero): (usize, f64)| {
        let name = format!("q{}", i + 1);
        format!(
            "[[source]]\nname = \"zero of {name}\"\nclass = \"repeatable\"\njoint = {name:?}\nerror = \"{zero} mrad\"\n\n"
        )
    };
    ZEROS.into_iter().enumerate().map(source).collect()
}

/// Checks that every named zero is true, and that none is named of a joint whose zero is
/// indistinguishable from base or tool.
#[test]
fn zeros_of_joints_are_found() {
    for (base, layout, told) in [
        ("exact", POSE, &[1, 2, 3, 4, 5][..]),
        ("known", POSE, &[2, 3, 4, 5][..]),
        ("exact", POINT, &[1, 2, 3, 4][..]),
    ] {
        let data = measured(&ur5(&zeros()), base, layout, 150, 5);
        let report = job(&ur5(""), base, layout, &data).run(&mut ()).unwrap();
        let joint =
            |number: &str| number.strip_prefix("zero of q").map(|joint| joint.parse::<usize>().unwrap());
        let mut said = Vec::new();
        for meaning in &report.joint_errors {
            let Some(joint) = joint(&meaning.number) else { continue };
            let truth = 1e-3 * ZEROS[joint - 1];
            assert!((meaning.value - truth).abs() < 4.5 * meaning.standard_deviation, "{meaning:?}, {truth}");
            assert!(meaning.standard_deviation < 1e-4, "{meaning:?}");
            said.push(joint);
        }
        assert!(told.iter().all(|joint| said.contains(joint)), "{base} {layout}: {said:?}");
        let cannot: &[usize] = if base == "exact" { &[6] } else { &[1, 6] };
        assert!(cannot.iter().all(|joint| !said.contains(joint)), "{base} {layout}: {said:?}");
    }
}

/// Checks that the written spec contains zeros of joints and values of frames, and predicts as the
/// fit does.
#[test]
fn the_written_spec_is_the_machine_that_was_found() {
    let data = measured(&ur5(&format!("{}{BENT}", zeros())), "exact", POINT, 150, 6);
    let report = job(&ur5(""), "exact", POINT, &data).run(&mut ()).unwrap();
    let found = written(&report, &ur5(""));
    assert!(
        found.contains("name = \"identified: zero of q2\"") && found.contains("joint = \"q2\""),
        "{found}"
    );
    assert!(found.contains("dh = { a = ") && found.contains("frame = \"elbow\""), "{found}");
    let left = left(&report, &ur5(""), "exact", POINT, &data);
    assert!(
        (left - report.fit.after.rms).abs() < 0.01 * report.fit.after.rms,
        "{left} {:?}",
        report.fit.after
    );
}

/// Returns ordered rows, each with the direction of the last move of a joint as an input.
fn with_backlash(backlash: &str, samples: usize) -> Data {
    let input = "[inputs]\nslack = { value = 0, range = [-1, 1] }\n\n";
    let truth = ur5(&format!("{backlash}{BENT}")).replacen("[[frame]]", &format!("{input}[[frame]]"), 1);
    let mut data = measured(&ur5(BENT), "exact", POINT, samples, 7);
    let mut before = data.observations[0].q[0];
    let mut first = true;
    for row in &mut data.observations {
        let direction = if first { 0.0 } else { (row.q[0] - before).signum() };
        (before, first) = (row.q[0], false);
        row.u = vec![direction].into();
    }
    let machine = machine(&truth);
    let map = map("exact", POINT, &machine);
    let at = Places::Rows(data);
    let job = Simulate { machine, map, at, noise: None, outliers: 0.0, random: false, seed: 8 };
    let mut observations = job.run(&mut ()).unwrap().observations;
    observations.iter_mut().for_each(|row| row.u = Vec::new().into());
    Data { file: "data.csv".to_owned(), observations, ..Data::default() }
}

#[test]
fn backlash_is_found_by_the_direction_of_the_last_move() {
    let backlash = "[[source]]\nname = \"backlash\"\nclass = \"repeatable\"\njoint = \"q1\"\nerror = \"0.05 mrad * slack\"\n";
    let data = with_backlash(backlash, 200);
    let mut job = job(&ur5(""), "exact", POINT, &data);
    job.terms = vec![Family::Joint, Family::Backlash, Family::Drift];
    let report = job.run(&mut ()).unwrap();
    let [term] = &report.terms[..] else { panic!("backlash alone: {:?}", report.terms) };
    assert_eq!(term.name, "q1: joint error with q1_direction");
    let [found] = &report.found.terms[..] else { panic!("one term") };
    assert!((found.magnitude - 5e-5).abs() < 4.0 * found.standard_deviation, "{found:?}");
    // A spec expresses it: an input, and an error of the joint proportional to it.
    let spec = written(&report, &ur5(""));
    assert!(spec.contains("[inputs.q1_direction]") && spec.contains("* (q1_direction/1)"), "{spec}");
}

/// Checks a gear of 101 teeth, which is found only if its ratio is declared.
#[test]
fn a_gear_is_found_where_its_ratio_is_said() {
    let gear = "[[source]]\nname = \"gear\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"0.05 mrad * sin(101*q2 + 0.4)\"\n";
    let data = measured(&ur5(gear), "exact", POINT, 200, 9);
    let mut job = job(&ur5(""), "exact", POINT, &data);
    job.terms = vec![Family::Joint];
    assert_eq!(job.run(&mut ()).unwrap().terms.len(), 0);
    job.harmonics = vec![Harmonics { variable: 1, times: vec![51, 101] }];
    let report = job.run(&mut ()).unwrap();
    let [term] = &report.terms[..] else { panic!("the gear alone: {:?}", report.terms) };
    assert_eq!(term.name, "q2: 101 times per turn of q2, joint error");
    for (found, truth) in report.found.terms.iter().zip([5e-5 * 0.4_f64.cos(), 5e-5 * 0.4_f64.sin()]) {
        assert!((found.magnitude - truth).abs() < 4.0 * found.standard_deviation, "{found:?} {truth}");
    }
    let written = written(&report, &ur5(""));
    assert!(written.contains("* (sin(101*q2))"), "{written}");
    let left = left(&report, &ur5(""), "exact", POINT, &data);
    assert!((left - report.fit.after.rms).abs() < 0.01 * report.fit.after.rms, "{left}");
}

/// Checks that machines with constant errors alone yield no terms: the best of more than 500 groups
/// is chance.
#[test]
fn chance_is_no_term() {
    let mut taken = 0;
    for seed in 20..24 {
        let data = measured(&ur5(BENT), "exact", POINT, 60, seed);
        let mut job = job(&ur5(""), "exact", POINT, &data);
        job.terms = Family::ALL.to_vec();
        let report = job.run(&mut ()).unwrap();
        assert!(report.tried > 500, "{}", report.tried);
        taken += report.terms.len();
    }
    // At 5 % each, two or more of four have a probability of 1.4 %.
    assert!(taken <= 1, "{taken}");
}

/// Checks a shoulder with compliance about three axes, two of them coupled: weight about one
/// rotates it about the other, too.
#[test]
fn full_compliances_are_found_and_written() {
    let number = |value: f64| format!("\"{value}e-5/(N*m)\"");
    let compliance = |off: f64| {
        let (d, o) = (number(8.0), number(off));
        format!(
            "[[source]]\nname = \"gives way\"\nclass = \"repeatable\"\nframe = \"elbow\"\ncompliance = {{ matrix = [\
             [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], \
             [0, 0, 0, {d}, 0, {o}], [0, 0, 0, 0, 0, 0], [0, 0, 0, {o}, 0, {d}]] }}\n\n"
        )
    };
    let load = "[[load]]\nname = \"gripper\"\nmass = \"3 kg\"\nframe = \"wrist 3\"\npoint = \"tool\"\n";
    let gravity = "gravity = [0, 0, \"-9.80665 m/s^2\"]\n";
    let nominal = format!("{gravity}{}", ur5(load));
    for off in [0.0, 6.0, -6.0] {
        let truth = format!("{gravity}{}", ur5(&format!("{}{load}", compliance(off))));
        let data = measured(&truth, "exact", POINT, 200, 9);
        let mut job = job(&nominal, "exact", POINT, &data);
        job.terms = vec![Family::Elastic];
        let report = job.run(&mut ()).expect("it is identified");
        let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
        let coupled = names.iter().any(|name| name.contains("elastic deflection, e_s coupled with e_p"));
        println!("{off}: {names:?}");
        assert_eq!(coupled, off != 0.0, "{off}: {names:?}");
        // Only the noise remains: √3 σ of a point.
        assert!(report.fit.after.rms < 1.1 * 0.02 * 3f64.sqrt(), "{off}: {:?}", report.fit.after);
        let found = written(&report, &nominal);
        assert_eq!(found.contains("compliance = { matrix = "), coupled, "{found}");
        let left = left(&report, &nominal, "exact", POINT, &data);
        let rms = report.fit.after.rms;
        assert!((left - rms).abs() < 0.01 * rms, "{off}: {left} {rms}\n{found}");
    }
}

/// Checks that the priors from the spec's random sources hold: an error of 1 µm cannot become 0.3
/// mm, whatever the data.
#[test]
fn priors_of_the_spec_hold_what_they_are_of() {
    let tight = "[[source]]\nname = \"elbow as made\"\nclass = \"random\"\ndistribution = \"normal\"\nframe = \"elbow\"\ne_x = \"1 um\"\n";
    let data = measured(&ur5(BENT), "exact", POINT, 150, 6);
    let found = |prior| {
        let mut job = job(&ur5(tight), "exact", POINT, &data);
        job.settings.prior = prior;
        job.run(&mut ()).expect("it is identified")
    };
    let length = |report: &Report| {
        let of_elbow = report.parameters.iter().find(|one| one.name == "e_x3");
        of_elbow.map_or(0.0, |one| one.value)
    };
    let (free, held) = (found(Prior::Share(0.01)), found(Prior::Spec));
    assert!((length(&free) - 0.3).abs() < 0.05, "{:?}", free.parameters);
    assert!(length(&held).abs() < 0.02, "{:?}", held.parameters);
    assert!(held.uncertainty_factor > 1.5 * free.uncertainty_factor, "{}", held.uncertainty_factor);
    // The other error has no prior: it is as free as before.
    let spin =
        |report: &Report| report.parameters.iter().any(|one| one.frame == Some(3) && one.unit == "rad");
    assert!(spin(&free) && spin(&held));
}

/// The data choose the scale of the prior, and cross-validation is better with it than with ten
/// times as much as the errors have.
#[test]
fn a_prior_that_is_chosen_is_said_and_no_worse() {
    let small = BENT.replace("0.8 mrad", "0.1 mrad").replace("0.3 mm", "0.04 mm");
    let data = measured(&ur5(&small), "exact", POINT, 16, 6);
    let found = |prior| {
        let mut job = job(&ur5(""), "exact", POINT, &data);
        job.settings.prior = prior;
        job.run(&mut ()).expect("it is identified")
    };
    let (stated, chosen) = (found(Prior::Share(0.01)), found(Prior::Auto));
    let share = chosen.prior.expect("it is said");
    let rms = |report: &Report| report.cross_validation.after.rms;
    println!("{share}: {} by {}", rms(&chosen), rms(&stated));
    assert!((1e-5..1e-3).contains(&share) && rms(&chosen) < rms(&stated), "{share}");
    // Zero holds the errors of frames.
    let none = found(Prior::Share(0.0));
    assert!(none.prior.is_none() && none.parameters.iter().all(|one| one.kind != Kind::Machine));
}

/// Checks that no more terms are tried after the time limit, which is reported, and that a
/// sufficient limit has no effect.
#[test]
fn time_ends_the_search_for_terms() {
    let wave =
        "[[source]]\nname = \"gear\"\nclass = \"repeatable\"\njoint = \"q2\"\nerror = \"1 mrad * sin(q2)\"\n";
    let data = measured(&ur5(wave), "exact", POINT, 100, 3);
    let found = |time| {
        let mut job = job(&ur5(""), "exact", POINT, &data);
        (job.settings.time, job.terms) = (time, vec![Family::Joint, Family::Product]);
        job.run(&mut ()).expect("it is identified")
    };
    let over = found(Some(Duration::ZERO));
    assert!(over.tried == 0 && over.terms.is_empty());
    assert!(
        over.notes.iter().any(|note| note.contains("the time limit was reached before")),
        "{:?}",
        over.notes
    );
    let (long, any) = (found(Some(Duration::from_secs(3600))), found(None));
    let names = |report: &Report| report.terms.iter().map(|term| term.name.clone()).collect::<Vec<_>>();
    assert!(names(&any).iter().any(|name| name.contains("once per turn of q2")), "{:?}", names(&any));
    assert_eq!((names(&long), long.tried), (names(&any), any.tried));
}
