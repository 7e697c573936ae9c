//! Tests of the positioner as a clinic uses it: the load cell, the targets on the couch, and
//! section 6 of the paper.

use abbe::identify::Loss;
use abbe_metrology::Acceptance;
use abbe_metrology::compensate::Compensate;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Prior, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::plan::{Choice, Plan, Sets};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::analyze::{Agreement, Analyze, Report};
use abbe_study::{Changes, Machine, Study};

fn pps() -> Machine {
    Machine::find("pps").unwrap()
}

/// Returns the shipped positioner with values set, as by `--set`.
fn pps_with(set: &[&str]) -> Machine {
    let mut machine = pps();
    let set: Vec<String> = set.iter().map(|one| (*one).to_owned()).collect();
    machine.change(&Changes::read([&set, &[], &[], &[]], &machine.spec).unwrap());
    machine
}

fn shipped_map(machine: &Machine) -> Map {
    Map::find("pps".as_ref(), &machine.spec).unwrap()
}

fn section_6() -> Analyze {
    let machine = pps();
    let study = Study::find(Some("pps-section6".as_ref()), &machine).unwrap();
    Analyze::new(machine, study)
}

fn value(machine: &Machine, name: &str) -> f64 {
    machine.spec.parameters.iter().find(|parameter| parameter.name == name).unwrap().value
}

/// Checks the tool point of the study of section 6 against the nominal treatment point as printed:
/// (0, 840, -90) mm from O_T, lateral, along the couch and down. O_T is where the plane of the
/// targets meets the spin axis, x = z = 0 on the couch.
#[test]
fn the_nominal_treatment_point_is_that_of_section_6() {
    let job = section_6();
    let nominal = ["x", "y", "z"].map(|name| value(job.machine(), name));
    let targets = shipped_map(job.machine()).targets();
    let heights: Vec<f64> = targets.iter().map(|target| target[1] + nominal[1]).collect();
    assert!(heights.iter().all(|height| (height - 10.0).abs() < 1e-9), "{heights:?}");
    assert_eq!([nominal[0], nominal[2], 10.0 - nominal[1]], [0.0, 840.0, -90.0]);
}

/// The study of section 6 is analyzed at the 450 rows that the plan of section 6 measures.
#[test]
fn section_6_is_analyzed_where_it_is_measured() {
    let machine = pps();
    let map = shipped_map(&machine);
    let choice = Choice::Sets(Sets::find("pps".as_ref(), &machine.spec).unwrap());
    let study = Study::find(None, &machine).unwrap();
    let plan = Plan { machine, map, choice, study, model_error: 0.0, seed: None };
    let planned = plan.run(&mut ()).unwrap();
    let job = section_6();
    let evaluator = job.machine().evaluator(false);
    let reached = job.study().region.workspace(&*evaluator, None).unwrap().reached();
    assert_eq!((planned.observations.len(), reached.len()), (450, 450));
    let key = |q: &[f64], u: &[f64]| {
        let rounded = q.iter().chain(u).map(|value| (value * 1e5).round() as i64);
        rounded.collect::<Vec<_>>()
    };
    let mut rows: Vec<_> = planned.observations.iter().map(|row| key(&row.q, &row.u)).collect();
    let mut analyzed: Vec<_> = reached.iter().map(|place| key(&place.q, &place.u)).collect();
    rows.sort_unstable();
    analyzed.sort_unstable();
    assert_eq!(rows, analyzed);
}

/// Compares with the figures of section 6: errors of the order of 5 mm, a repeatability of 0.1 mm
/// as predicted, and less than 0.15 mm (3 sigma) along each axis as measured.
#[test]
fn section_6_is_predicted() {
    let report: Report = section_6().run(&mut ()).unwrap();
    assert_eq!((report.configurations, report.unreachable), (450, 0));
    assert_eq!(report.comparisons.len(), 2);
    for comparison in &report.comparisons {
        assert!(matches!(comparison.agreement, Agreement::Met), "{comparison:?}");
    }
    let deviation = report.budget.combined.standard_deviation;
    let three_sigma = 3.0 * deviation.into_iter().fold(0.0, f64::max);
    println!("radius {:.3} mm, 3 sigma {three_sigma:.3} mm", report.budget.combined.radius.value);
    // The remark of the study.
    assert_eq!(format!("{three_sigma:.2}"), "0.11");
}

/// Setting the treatment point moves the evaluated point, not the targets on the couch: three
/// targets with the same readings have the same residuals.
#[test]
fn targets_on_the_couch_stay_where_they_are() {
    let measured = {
        let machine = pps();
        let map = shipped_map(&machine);
        let at = Places::Samples(12);
        let job = Simulate { machine, map, at, noise: Some(0.0), outliers: 0.0, random: false, seed: 1 };
        job.run(&mut ()).unwrap().observations
    };
    let errors = |machine: Machine, map: Map| {
        let data = Data {
            file: "simulated".to_owned(),
            observations: measured.clone(),
            stations: vec![String::new()],
            ..Data::default()
        };
        let mut notes = Vec::new();
        let job = Measure { machine, map, data, accept: Acceptance::default() };
        let report = job.run(&mut Collected(&mut notes)).unwrap();
        (report.explained.left_mean, notes)
    };
    let moved = pps_with(&["y=-90mm"]);
    let (left, notes) = errors(moved.clone(), shipped_map(&moved));
    assert!(left < 0.05 && notes.is_empty(), "{left} {notes:?}");
    // In the frame of the tool they move along, by 190 mm, and the reason is said.
    let in_tool = |machine: &Machine, stated: &str| {
        let text = shipped_map(&pps()).text().replace("target_frame = \"flange\"\n", stated);
        let places = [
            (r#""10 mm", "1100 mm"]"#, r#""-90 mm", "250 mm"]"#),
            (r#""10 mm", "250 mm"]"#, r#""-90 mm", "-600 mm"]"#),
        ];
        let text = places.iter().fold(text, |text, (from, to)| text.replace(from, to));
        Map::parse("map.toml", &text, &machine.spec).unwrap()
    };
    let (left, notes) = errors(pps(), in_tool(&pps(), ""));
    assert!(left < 0.05 && notes.is_empty(), "{left} {notes:?}");
    let (left, notes) = errors(moved.clone(), in_tool(&moved, ""));
    assert!(
        left > 150.0 && notes.iter().any(|note| note.contains("setting `y` moves the targets")),
        "{notes:?}"
    );
    // Who says that they move along is not told.
    let (_, notes) = errors(moved.clone(), in_tool(&moved, "target_frame = \"tool\"\n"));
    assert!(!notes.iter().any(|note| note.contains("moves the targets")), "{notes:?}");
}

/// Identifies a machine whose arm is softer than designed and whose turntable gives way, from 150
/// rows with the load cell's columns, and compares with exact rows at other weights. Section 3 of
/// the paper: the load cell is there to compensate the deflection by weight and place of the
/// patient.
#[test]
fn the_load_cell_explains_weights_that_were_not_measured() {
    let nominal = {
        let mut machine = pps();
        let unknown = ["assembly".to_owned()];
        machine.change(&Changes::read([&[], &[], &unknown, &[]], &machine.spec).unwrap());
        machine
    };
    let real = {
        let softer = [("2.354e13 N", "1.9e13 N"), ("3.245e13 N", "2.5e13 N")];
        let text = softer.iter().fold(pps().text().unwrap(), |text, (from, to)| text.replace(from, to));
        let turntable = r#"
[[source]]
name = "bearing of the turntable"
class = "repeatable"
frame = "spin"
compliance = { diagonal = [0, 0, 0, 0, "3e-10/(N*mm)", "3e-10/(N*mm)"] }
"#;
        Machine::of_spec(Spec::parse("real.toml", &(text + turntable)).unwrap(), "real.toml")
    };
    let measured = |samples: usize, noise: Option<f64>, seed: u64| {
        let (machine, map) = (real.clone(), shipped_map(&real));
        let at = Places::Samples(samples);
        let job = Simulate { machine, map, at, noise, outliers: 0.0, random: false, seed };
        let observations = job.run(&mut ()).unwrap().observations;
        Data { file: "simulated".to_owned(), observations, stations: vec![String::new()], ..Data::default() }
    };
    let (data, test) = (measured(150, None, 1), measured(100, Some(0.0), 2));
    let figures = |data: &Data, test: &Data| {
        let settings = Settings {
            loss: Loss::Squares,
            prior: Prior::default(),
            folds: 5,
            time: None,
            points: false,
            only_placement: false,
        };
        let job = Identify {
            machine: nominal.clone(),
            map: shipped_map(&nominal),
            data: data.clone(),
            test: Some(test.clone()),
            terms: vec![Family::Elastic],
            harmonics: Vec::new(),
            settings,
            accept: Acceptance::default(),
        };
        let report = job.run(&mut ()).unwrap();
        // The found map states the targets in the frame of the map, the couch.
        let text = report.found.identified_map(&job.map, &nominal.spec, "found.map.toml").unwrap();
        let found = Map::parse("found.map.toml", &text, &nominal.spec).unwrap();
        assert!(text.contains("[placement]\ntargets"), "{text}");
        // The couch stays level, so that rows hardly tell their height from that of the base.
        for (found, designed) in found.targets().iter().zip(job.map.targets()) {
            let apart = (found[0] - designed[0]).hypot(found[2] - designed[2]);
            assert!(apart < 8.0, "{found:?} {designed:?}");
        }
        let test = report.test.unwrap();
        (test.before.mean, test.after.mean)
    };
    let (before, after) = figures(&data, &test);
    let blind = |data: &Data| {
        let mut data = data.clone();
        let nominal = nominal.spec.inputs.iter().map(|input| input.value).collect::<Vec<_>>();
        data.observations.iter_mut().for_each(|row| row.u = nominal.clone().into());
        data
    };
    let (_, without) = figures(&blind(&data), &blind(&test));
    println!("{before:.2} mm as delivered, {after:.3} with the load cell, {without:.3} without");
    assert!(before > 3.0 && after < 0.03 && without > 5.0 * after, "{before} {after} {without}");
}

/// Joints that the map fixes are held, and what is written is what the report says is left: the
/// positioner with roll and pitch at rest brings its treatment point to where it should be.
#[test]
fn joints_that_the_map_fixes_are_held() {
    let machine = pps();
    let map = shipped_map(&machine);
    let at = Places::Samples(12);
    let job = Simulate {
        machine: machine.clone(),
        map: map.clone(),
        at,
        noise: Some(0.0),
        outliers: 0.0,
        random: false,
        seed: 1,
    };
    let observations = job.run(&mut ()).unwrap().observations;
    let data =
        Data { file: "simulated".to_owned(), observations, stations: vec![String::new()], ..Data::default() };
    let job = Compensate { machine, map, data, poses: false, tolerance: 1e-3, weight: None };
    let report = job.run(&mut ()).unwrap();
    assert_eq!(report.held, ["q5", "q6"]);
    assert!(report.before.max > 1.0 && report.after.max < 1e-3, "{:?} {:?}", report.before, report.after);
    assert!(report.rows.iter().all(|row| row.corrected.q[4..] == [0.0, 0.0]), "{:?}", report.rows[0].q);
    let turned = report.rows.iter().filter(|row| row.after.angle > row.before.angle + 1e-5);
    assert_eq!(report.row_summary.turned, turned.count());
    // A value that the joint cannot have is still a mistake of the rows.
    let text = shipped_map(&job.machine).text().replace("q5 = { value = 0 }", "q5 = { value = 1.5 }");
    let map = Map::parse("map.toml", &text, &job.machine.spec).unwrap();
    let beyond = Compensate {
        map: map.clone(),
        data: Data { observations: beyond(&job.data, 1.5), ..job.data },
        ..job
    };
    let said = beyond.run(&mut ()).unwrap_err().to_string();
    assert!(said.contains("q5 is commanded to") && said.contains("beyond its limits"), "{said}");
}

/// Returns the rows with another value of the fifth joint.
fn beyond(data: &Data, value: f64) -> Vec<abbe::identify::Observation> {
    let mut rows = data.observations.clone();
    rows.iter_mut().for_each(|row| row.q[4] = value);
    rows
}

struct Collected<'n>(&'n mut Vec<String>);

impl abbe_study::Notes for Collected<'_> {
    fn warn(&mut self, text: &str) {
        self.0.push(text.to_owned());
    }
}
