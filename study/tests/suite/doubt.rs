//! Data that no machine of the spec gives: what is said of them, and what is not.

use abbe::identify::{Loss, Measurement};
use abbe_spec::Spec;
use abbe_study::data::{Calendar, Data, Map};
use abbe_study::identify::{Identify, Prior, Settings};
use abbe_study::measure::Measure;
use abbe_study::monitor::{self, Check, Checks, Monitor};
use abbe_study::simulate::{Places, Simulate};
use abbe_study::{Acceptance, Machine, Notes};

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
struct Heard(Vec<String>);

impl Notes for Heard {
    fn warn(&mut self, warning: &str) {
        self.0.push(warning.to_owned());
    }
}

fn arm() -> Machine {
    Machine::of_spec(Spec::parse("arm.toml", ARM).unwrap(), "arm.toml")
}

/// A map whose columns are called as the variables, in deg and m.
fn map(machine: &Machine, base: &str) -> Map {
    map_in("m", machine, base)
}

/// The same with points in another unit.
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

/// What an instrument writes down of a machine without errors.
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
    let mut heard = Heard::default();
    let job = Measure {
        machine: machine.clone(),
        map: map.clone(),
        data: data.clone(),
        accept: Acceptance::default(),
    };
    job.run(&mut heard).map_err(|mistake| mistake.to_string())?;
    Ok(heard.0)
}

/// Whether there is a result, and the warnings.
fn identified(machine: &Machine, map: &Map, data: &Data) -> (Result<(), String>, Vec<String>) {
    let settings =
        Settings { loss: Loss::Squares, prior: Prior::Share(0.01), folds: 5, time: None, points: false };
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
    let mut heard = Heard::default();
    let run = job.run(&mut heard).map(|_| ()).map_err(|mistake| mistake.to_string());
    (run, heard.0)
}

/// The same joints in another unit.
fn with_joint(data: &Data, joint: usize, factor: f64) -> Data {
    let mut data = data.clone();
    data.observations.iter_mut().for_each(|row| row.q[joint] *= factor);
    data
}

const DOUBT: &str = "Are they measurements of this machine?";

/// One joint in rad where the map says deg: no reading that is tried mends it. Whether there is a fit or none, the warning is the
/// same as that of `measure`.
#[test]
fn what_no_machine_measures_is_doubted_before_it_is_fitted() {
    let machine = Machine::find("ur5").unwrap();
    let map = map(&machine, "known");
    let data = simulated(&machine, &map, 3);
    assert_eq!(identified(&machine, &map, &data), (Ok(()), Vec::new()));
    let mut ends = Vec::new();
    for joint in [0, 2] {
        let wrong = with_joint(&data, joint, 1.0 / DEGREE);
        let said = measured(&machine, &map, &wrong).unwrap();
        assert!(said.len() == 1 && said[0].contains("% of the arm") && said[0].contains(DOUBT), "{said:?}");
        let (result, heard) = identified(&machine, &map, &wrong);
        assert_eq!(heard, said);
        ends.push(result.is_ok());
    }
    assert_eq!(ends, [false, true], "with a fit, and without one");
}

/// The first check is looked at: what changes is told by how a machine moves, and by that of another one in vain.
#[test]
fn checks_of_another_machine_are_doubted() {
    let machine = Machine::find("ur5").unwrap();
    let map = map(&machine, "known");
    let heard = |joint: Option<usize>| {
        let check = |day: u64| {
            let mut data = simulated(&machine, &map, 5);
            if let Some(joint) = joint {
                data = with_joint(&data, joint, 1.0 / DEGREE);
            }
            data.observations.truncate(12);
            Check { time: day as f64, data }
        };
        let checks = Checks { calendar: Calendar::Dates, list: (0..5).map(check).collect() };
        let mut heard = Heard::default();
        let settings = monitor::Settings::default();
        Monitor { machine: machine.clone(), map: map.clone(), checks, settings }.run(&mut heard).unwrap();
        heard.0
    };
    assert_eq!(heard(None), [""; 0]);
    let said = heard(Some(2));
    assert!(said.len() == 1 && said[0].contains(DOUBT), "{said:?}");
}

/// A few gross errors, however large, are none of all rows; neither is an instrument that stands elsewhere.
#[test]
fn gross_errors_are_no_other_machine() {
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
            let (_, heard) = identified(&machine, &map, &data);
            assert!(heard.iter().all(|said| !said.contains(DOUBT)), "{base}: {heard:?}");
        }
    }
    // Near with base and tool fitted, if not as near as a fifth: a question of where it stands.
    let data = moved(1, 30.0);
    let map = map(&machine, "known");
    let mut half = data.clone();
    for row in half.observations.iter_mut().step_by(2) {
        let Measurement::Points(points) = &mut row.measured else { unreachable!() };
        points.iter_mut().flatten().for_each(|point| point[0] -= 16.0);
    }
    let said = measured(&machine, &map, &half).unwrap();
    assert!(
        said.len() == 1 && said[0].contains("Where does the instrument stand") && !said[0].contains(DOUBT),
        "{said:?}"
    );
}

/// Two joints that read the same column: lengths in mm and angles in rad would draw all points and the whole machine together to
/// nearly one point, and so near each other. That is no reading.
#[test]
fn what_draws_all_points_together_is_no_reading() {
    let machine = arm();
    let map = map(&machine, "unknown");
    for seed in [4, 7] {
        let mut data = simulated(&machine, &map, seed);
        data.observations.iter_mut().for_each(|row| row.q[3] = row.q[0]);
        let said = measured(&machine, &map, &data).unwrap();
        assert!(said.len() == 1 && said[0].contains(DOUBT), "{seed}: {said:?}");
    }
    // Points in m and joints in rad that the map calls mm and deg are found.
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
