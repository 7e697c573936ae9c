//! Implausible data: which warnings appear, and which do not.

use abbe::identify::{Loss, Measurement};
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::monitor::{self, Check, Checks, Monitor};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::date::Calendar;
use abbe_study::{Machine, Notes};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

const ARM: &str = r#"
[manipulator]
name = "arm"
length = "mm"

[[frame]]
name = "turn"
variable = { name = "q1", kind = "revolute", limits = ["-150 deg", "150 deg"] }
dh = { theta = "q1", d = 400, a = 0, alpha = "90 deg" }

[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute", limits = ["-20 deg", "120 deg"], home = "45 deg" }
dh = { theta = "q2", d = 0, a = 450, alpha = 0 }

[[frame]]
name = "elbow"
variable = { name = "q3", kind = "revolute", limits = ["-120 deg", "60 deg"] }
dh = { theta = "q3", d = 0, a = 0, alpha = "90 deg" }

[[frame]]
name = "wrist"
variable = { name = "q4", kind = "revolute", limits = ["-170 deg", "170 deg"] }
dh = { theta = "q4", d = 420, a = 0, alpha = "-90 deg" }

[tool]
transform = "Tx(80) Tz(120)"
"#;

#[derive(Default)]
struct RecordedNotes(Vec<String>);

impl Notes for RecordedNotes {
    fn warn(&mut self, warning: &str) {
        self.0.push(warning.to_owned());
    }
}

fn arm() -> Machine {
    Machine::of_spec(Spec::parse("arm.toml", ARM).unwrap(), "arm.toml")
}

/// Returns a map whose columns have the names of the variables, in deg and m.
fn map(machine: &Machine, base: &str) -> Map {
    map_in("m", machine, base)
}

/// Returns such a map with points in another unit.
fn map_in(unit: &str, machine: &Machine, base: &str) -> Map {
    let joints = machine.spec.variables.iter().map(|variable| {
        let name = &variable.name;
        format!("{name} = {{ column = \"{name}\", unit = \"deg\" }}\n")
    });
    let joints: String = joints.collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nbase = \"{base}\"\n\n[joints]\n{joints}\n[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"{unit}\"\n"
    );
    Map::parse("map.toml", &text, &machine.spec).unwrap()
}

/// Simulates measurements of a machine without errors.
fn simulated(machine: &Machine, map: &Map, seed: u64) -> Data {
    let job = Simulate {
        machine: machine.clone(),
        map: map.clone(),
        at: Places::Samples(60),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("data.csv");
    std::fs::write(&file, job.run(&mut ()).unwrap().table.csv()).unwrap();
    Data::read(&file, map).unwrap()
}

fn measured(machine: &Machine, map: &Map, data: &Data) -> Result<Vec<String>, String> {
    let mut recorded = RecordedNotes::default();
    let job = Measure {
        machine: machine.clone(),
        map: map.clone(),
        data: data.clone(),
        accept: Acceptance::default(),
    };
    job.run(&mut recorded).map_err(|mistake| mistake.to_string())?;
    Ok(recorded.0)
}

/// Returns the outcome of an identification and its warnings.
fn identified(machine: &Machine, map: &Map, data: &Data) -> (Result<(), String>, Vec<String>) {
    let (run, recorded) = run(machine, map, data);
    (run.map(|_| ()), recorded)
}

/// Returns the report of an identification and its warnings.
fn run(machine: &Machine, map: &Map, data: &Data) -> (Result<Report, String>, Vec<String>) {
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let job = Identify {
        machine: machine.clone(),
        map: map.clone(),
        data: data.clone(),
        test: None,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    let mut recorded = RecordedNotes::default();
    let report = job.run(&mut recorded).map_err(|mistake| mistake.to_string());
    (report, recorded.0)
}

/// Scales the values of one joint, as a wrong unit does.
fn with_joint(data: &Data, joint: usize, factor: f64) -> Data {
    let mut data = data.clone();
    data.observations.iter_mut().for_each(|row| row.q[joint] *= factor);
    data
}

const IMPLAUSIBLE: &str = "Check that these are measurements of this machine";

/// One joint in rad where the map says deg cannot be corrected by any interpretation. The warning
/// is the same as that of `measure`, whether the fit converges or not; neither is accepted.
#[test]
fn implausible_data_raise_a_warning_before_the_fit() {
    let machine = Machine::find("ur5").unwrap();
    let map = map(&machine, "known");
    let data = simulated(&machine, &map, 3);
    assert_eq!(identified(&machine, &map, &data), (Ok(()), Vec::new()));
    let mut ends = Vec::new();
    for joint in [0, 2] {
        let wrong = with_joint(&data, joint, 1.0 / DEGREE);
        let said = measured(&machine, &map, &wrong).unwrap();
        assert!(
            said.len() == 1 && said[0].contains("% of the arm") && said[0].contains(IMPLAUSIBLE),
            "{said:?}"
        );
        let (result, recorded) = identified(&machine, &map, &wrong);
        assert_eq!(recorded, said);
        ends.push(result.unwrap_err());
    }
    let [without, with] = [&ends[0], &ends[1]].map(|end| end.contains("changes a length"));
    assert_eq!([without, with], [false, true], "with a fit, and without one: {ends:?}");
}

/// The first check is tested, because a wrong model of the machine explains no change.
#[test]
fn checks_of_another_machine_raise_a_warning() {
    let machine = Machine::find("ur5").unwrap();
    let map = map(&machine, "known");
    let recorded = |joint: Option<usize>| {
        let check = |day: u64| {
            let mut data = simulated(&machine, &map, 5);
            if let Some(joint) = joint {
                data = with_joint(&data, joint, 1.0 / DEGREE);
            }
            data.observations.truncate(12);
            Check { time: day as f64, data }
        };
        let checks = Checks { calendar: Calendar::Dates, list: (0..5).map(check).collect(), since: None };
        let mut recorded = RecordedNotes::default();
        let settings = monitor::Settings::default();
        Monitor { machine: machine.clone(), map: map.clone(), checks, settings }.run(&mut recorded).unwrap();
        recorded.0
    };
    assert_eq!(recorded(None), [""; 0]);
    let said = recorded(Some(2));
    assert!(said.len() == 1 && said[0].contains(IMPLAUSIBLE), "{said:?}");
}

/// A few gross errors, however large, do not make the data implausible; neither does an instrument
/// at another place.
#[test]
fn gross_errors_do_not_make_data_implausible() {
    let machine = Machine::find("ur5").unwrap();
    let moved = |every: usize, by: f64| {
        let mut data = simulated(&machine, &map(&machine, "known"), 7);
        for row in data.observations.iter_mut().step_by(every) {
            let Measurement::Points(points) = &mut row.measured else { unreachable!() };
            points.iter_mut().flatten().for_each(|point| point[0] += by);
        }
        data
    };
    for base in ["known", "unknown"] {
        let map = map(&machine, base);
        for data in [moved(15, 900.0), moved(1, 900.0)] {
            let (_, recorded) = identified(&machine, &map, &data);
            assert!(recorded.iter().all(|said| !said.contains(IMPLAUSIBLE)), "{base}: {recorded:?}");
        }
    }
    // With base and tool fitted the errors are below the threshold, but not by the factor of five:
    // only the placement is questioned.
    let data = moved(1, 30.0);
    let map = map(&machine, "known");
    let mut half = data.clone();
    for row in half.observations.iter_mut().step_by(2) {
        let Measurement::Points(points) = &mut row.measured else { unreachable!() };
        points.iter_mut().flatten().for_each(|point| point[0] -= 16.0);
    }
    let said = measured(&machine, &map, &half).unwrap();
    assert!(
        said.len() == 1
            && said[0].contains("Check the placement of the instrument")
            && !said[0].contains(IMPLAUSIBLE),
        "{said:?}"
    );
}

/// Two joints read the same column. Lengths in mm and angles in rad would shrink all points and the
/// whole machine to nearly one point, with small residuals; this must not count as a better
/// interpretation.
#[test]
fn an_interpretation_must_not_shrink_all_points() {
    let machine = arm();
    let map = map(&machine, "unknown");
    for seed in [4, 7] {
        let mut data = simulated(&machine, &map, seed);
        data.observations.iter_mut().for_each(|row| row.q[3] = row.q[0]);
        let said = measured(&machine, &map, &data).unwrap();
        assert!(said.len() == 1 && said[0].contains(IMPLAUSIBLE), "{seed}: {said:?}");
    }
    // Points in m and joints in rad are found if the map says mm and deg.
    let map = map_in("mm", &machine, "unknown");
    let mut data = simulated(&machine, &map, 9);
    for row in &mut data.observations {
        row.q.iter_mut().for_each(|q| *q *= DEGREE);
        let Measurement::Points(points) = &mut row.measured else { unreachable!() };
        points.iter_mut().flatten().flatten().for_each(|x| *x *= 1e-3);
    }
    let refused = measured(&machine, &map, &data).unwrap_err();
    assert!(
        refused.contains("lengths in m, not mm") && refused.contains("angles in rad, not deg"),
        "{refused}"
    );
    assert_eq!(refused.matches('?').count(), 2, "{refused}");
}

/// One time in all rows is no order of time: no statement on drift, and the reason.
#[test]
fn a_single_time_is_no_order() {
    let machine = Machine::find("ur5").unwrap();
    let map = map(&machine, "known");
    let mut data = simulated(&machine, &map, 3);
    let report = |data: &Data| {
        let (machine, map, data) = (machine.clone(), map.clone(), data.clone());
        let mut recorded = RecordedNotes::default();
        let report =
            Measure { machine, map, data, accept: Acceptance::default() }.run(&mut recorded).unwrap();
        (report.drift.is_some(), recorded.0)
    };
    assert_eq!(report(&data), (true, Vec::new()));
    for (i, row) in data.observations.iter_mut().enumerate() {
        row.approach_mut().time = Some(i as f64);
    }
    assert_eq!(report(&data), (true, Vec::new()));
    for row in &mut data.observations {
        row.approach_mut().time = Some(20_000.0);
    }
    let (is_tested, said) = report(&data);
    assert!(!is_tested && said.len() == 1 && said[0].contains("all rows have the same time"), "{said:?}");
}

/// Returns a machine of the frames and a map of whole poses, with nothing known of base and tool.
fn posed(frames: &[(&str, &str, &str)], base: &str) -> (Machine, Map) {
    let frame = |(name, kind, transform): &(&str, &str, &str)| {
        let limits = if *kind == "prismatic" { "[0, 400]" } else { "[\"-110 deg\", \"110 deg\"]" };
        format!(
            "[[frame]]\nname = \"of {name}\"\nvariable = {{ name = \"{name}\", kind = \"{kind}\", limits = {limits} }}\n\
             transform = \"{transform}\"\n"
        )
    };
    let text: String = frames.iter().map(frame).collect();
    let text = format!(
        "[manipulator]\nname = \"posed\"\nlength = \"mm\"\n{text}[tool]\ntransform = \"Tx(20) Tz(-50)\"\n"
    );
    let machine = Machine::of_spec(Spec::parse("posed.toml", &text).unwrap(), "posed.toml");
    let joint = |(name, kind, _): &(&str, &str, &str)| {
        let unit = if *kind == "prismatic" { "mm" } else { "deg" };
        format!("{name} = {{ column = \"{name}\", unit = \"{unit}\" }}\n")
    };
    let joints: String = frames.iter().map(joint).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.05 mrad\"\nbase = \"{base}\"\nplacement = \"{base}\"\n\n\
         [joints]\n{joints}\n[pose]\nposition = [\"px\", \"py\", \"pz\"]\nunit = \"mm\"\n\
         quaternion = {{ columns = [\"w\", \"i\", \"j\", \"k\"], order = \"wxyz\" }}\n"
    );
    let map = Map::parse("map.toml", &text, &machine.spec).unwrap();
    (machine, map)
}

/// Coordinates of the measured frame that the joints show only together with the place of the
/// machine are named: all three on slides, the height on a SCARA, none on an arm.
#[test]
fn coordinates_that_only_sums_show_are_named() {
    let slides = [("x", "prismatic", "Tx(x)"), ("y", "prismatic", "Ty(y)"), ("z", "prismatic", "Tz(z)")];
    let scara = [
        ("a", "revolute", "Rz(a) Tx(300)"),
        ("b", "revolute", "Rz(b) Tx(250)"),
        ("z", "prismatic", "Tz(z)"),
        ("c", "revolute", "Rz(c)"),
    ];
    let wrist = [
        ("a", "revolute", "Rz(a) Tz(300)"),
        ("b", "revolute", "Rx(b) Tz(250)"),
        ("c", "revolute", "Ry(c) Tz(200)"),
    ];
    for (frames, expected) in [
        (
            &slides[..],
            Some(
                "note: x, y, z of the measured frame on the tool are held: these joints show only their sums",
            ),
        ),
        (&scara, Some("note: z of the measured frame on the tool is held: these joints show only its sum")),
        (&wrist, None),
    ] {
        let (machine, map) = posed(frames, "exact");
        let data = simulated(&machine, &map, 1);
        let (machine, map) = posed(frames, "unknown");
        let notes = run(&machine, &map, &data).0.unwrap().notes;
        let held: Vec<&String> = notes.iter().filter(|note| note.contains("held: these joints")).collect();
        assert!(held.len() == usize::from(expected.is_some()), "{held:?}");
        assert!(held.iter().all(|note| note.starts_with(expected.unwrap())), "{held:?}");
    }
}
