//! Reports of every command, on shipped machines and on machines with errors of every kind.

use std::borrow::Cow;
use std::path::Path;

use abbe::identify::Criterion;
use abbe_metrology::compensate::Compensate;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::doctor::Doctor;
use abbe_metrology::identify::{Family, Identify, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::monitor;
use abbe_metrology::monitor::{Checks, Monitor};
use abbe_metrology::plan::{Choice, Plan};
use abbe_metrology::positioning::Positioning;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_study::allocate::Allocate;
use abbe_study::analyze::Analyze;
use abbe_study::bound::Bound;
use abbe_study::check::Check;
use abbe_study::explore::Explore;
use abbe_study::export::{Export, Format};
use abbe_study::import::{self, Import};
use abbe_study::jacobian::Jacobian;
use abbe_study::list::List;
use abbe_study::{Machine, Study};
use serde::Serialize;
use serde_json::{Value, to_value};

/// Errors of a UR5.
const ERRORS: &str = r#"
[[source]]
name = "shoulder"
class = "repeatable"
frame = "shoulder"
e_x = "0.6 mm"
e_s = "0.8 mrad"

[[source]]
name = "reading"
class = "random"
distribution = "normal"
frame = "elbow"
e_y = "0.05 mm"
"#;

/// Columns of poses with repeated visits, in the order of time.
const MAP: &str = r#"
[data]
uncertainty = "0.02 mm"
angle_uncertainty = "0.05 mrad"
base = "unknown"

[accept]
mean = "1 mm"
max = "5 mm"

[joints]
q1 = { column = "q1", unit = "deg" }
q2 = { column = "q2", unit = "deg" }
q3 = { column = "q3", unit = "deg" }
q4 = { column = "q4", unit = "deg" }
q5 = { column = "q5", unit = "deg" }
q6 = { column = "q6", unit = "deg" }

[pose]
position = ["x", "y", "z"]
unit = "mm"
euler = { columns = ["a", "b", "c"], order = "zyx", unit = "deg" }
"#;

const ROBOT: &str = r#"<robot name="arm"> <link name="base"/> <link name="hand"/>
<joint name="elbow" type="revolute"> <parent link="base"/> <child link="hand"/> <axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/> </joint> </robot>"#;

fn json(report: &impl Serialize) -> Value {
    to_value(report).expect("JSON")
}

fn machine(name: &str) -> Machine {
    Machine::find(name).expect("a shipped machine")
}

/// Returns a four-bar linkage.
fn linkage() -> Machine {
    let page = include_str!("../../../../docs/reference/spec.md");
    let text = page.split("```").find(|block| block.starts_with("toml\n# linkage.toml")).expect("an example");
    Machine::of_spec(Spec::parse("linkage.toml", &text["toml".len()..]).unwrap(), "linkage.toml")
}

/// Returns a machine whose loop leaves a passive joint free.
fn hinge() -> Machine {
    let text = r#"
        manipulator = { name = "hinge", length = "mm" }
        frame = [
            { name = "slide", variable = { name = "q1", kind = "prismatic" }, transform = "Tx(q1)" },
            { name = "hinge", variable = { name = "p1", kind = "revolute", passive = true }, transform = "Rz(p1)" },
        ]
        loop = [{ name = "pin", frames = ["hinge", "slide"], closes = ["x"] }]
    "#;
    Machine::of_spec(Spec::parse("hinge.toml", text).unwrap(), "hinge.toml")
}

/// Returns the reports by the name of their class.
pub(super) fn reports() -> Vec<(&'static str, Value)> {
    let mut all = vec![
        ("CheckReport", json(&Check { machine: machine("pps") }.run(&mut ()).unwrap())),
        ("CheckReport", json(&Check { machine: machine("machine3") }.run(&mut ()).unwrap())),
        ("CheckReport", json(&Check { machine: machine("ur5") }.run(&mut ()).unwrap())),
        ("CheckReport", json(&Check { machine: linkage() }.run(&mut ()).unwrap())),
        ("CheckReport", json(&Check { machine: hinge() }.run(&mut ()).unwrap())),
        ("JacobianReport", json(&Jacobian { machine: machine("pps"), q: None }.run(&mut ()).unwrap())),
    ];
    let list = json(&List.run(&mut ()).unwrap());
    all.extend(list.as_array().unwrap().iter().map(|one| ("ShippedManipulator", one.clone())));
    all.extend(predicted());
    all.extend(exchanged());
    all.extend(measured());
    all.extend(positioned());
    all
}

fn predicted() -> Vec<(&'static str, Value)> {
    let mut all = Vec::new();
    let linkage = linkage();
    let study = Study::joint_samples(&linkage.spec);
    all.push(("AnalyzeReport", json(&Analyze::new(linkage, study).run(&mut ()).unwrap())));
    for name in ["pps", "machine3", "scara"] {
        let study = || match name {
            "scara" => {
                let text = "[study]\ntitle = \"Few\"\ntolerance = { position = \"0.1 mm\", orientation = \"1 mrad\" }\n\n[workspace.joints]\nsamples = 20\n";
                Study::read(Document::new("few.toml", text), &machine(name).spec).unwrap()
            }
            _ => Study::find(None, &machine(name)).unwrap(),
        };
        let mut job = Analyze::new(machine(name), study());
        job.monte_carlo = Some(50);
        all.push(("AnalyzeReport", json(&job.run(&mut ()).unwrap())));
        let explore = Explore { analysis: Cow::Borrowed(&job), study: None, residuals: None };
        all.push(("ExploreReport", json(&explore.run(&mut ()).unwrap())));
        if study().tolerance.is_some() {
            let job = Allocate::new(machine(name), study());
            all.push(("AllocateReport", json(&job.run(&mut ()).unwrap())));
        }
        let mut job = Bound::new(machine(name), study());
        job.effort.boxes = 50;
        job.least = true;
        all.push(("BoundReport", json(&job.run(&mut ()).unwrap())));
    }
    all
}

fn positioned() -> Vec<(&'static str, Value)> {
    let folder = tempfile::tempdir().unwrap();
    let report = |name: &str, text: &str, reading: Option<&str>| {
        let data = folder.path().join(name);
        std::fs::write(&data, text).unwrap();
        let (reading, accept) = (reading.map(str::to_owned), reading.map(|_| "E 3um".to_owned()));
        let job = Positioning { data: (&data).into(), reading, scale: None, accept };
        ("PositioningReport", json(&job.run(&mut ()).unwrap()))
    };
    vec![
        report("axis.csv", "position (mm),1+ (um),1- (um),2+ (um)\n0,1,2,1\n9,3,4,5\n", Some("1um")),
        report("diagonals.csv", "diagonal,position (mm),1+ (um),1- (um)\nPPP,0,1,2\nPPP,9,3,4\n", None),
        report(
            "circle.csv",
            "angle (deg),1+ (um),2+ (um),1- (um)\n0,1,2,0\n100,3,2,1\n200,4,5,2\n300,1,2,0\n",
            None,
        ),
        report("up.csv", "position (deg),1+ (arcsec)\n0,1\n9,3\n", None),
    ]
}

fn exchanged() -> Vec<(&'static str, Value)> {
    let mut arm = machine("machine3");
    let nodes = Format::IsgCsv { nodes: 5 };
    arm.spec = arm.spec.clone();
    let export = Export { machine: arm, format: nodes, samples: 20, seed: 0 }.run(&mut ()).unwrap();
    let format = import::Format::Urdf { base: None, tip: None, fold: false };
    let import = Import { file: "arm.urdf".into(), format, round_angles: false };
    let import = import.read(Document::new("arm.urdf", ROBOT), &mut ()).unwrap();
    vec![("ExportReport", json(&export)), ("ImportReport", json(&import))]
}

fn measured() -> Vec<(&'static str, Value)> {
    let folder = tempfile::tempdir().unwrap();
    let nominal = machine("ur5");
    let text = format!("{}{ERRORS}", nominal.text().unwrap());
    let real = Machine::of_spec(Spec::parse("real.toml", &text).unwrap(), "real.toml");
    let map = || Map::parse("map.toml", MAP, &nominal.spec).unwrap();
    let simulate = |seed: u64| Simulate {
        machine: real.clone(),
        map: map(),
        at: Places::Samples(30),
        noise: Some(0.02),
        outliers: 0.0,
        random: true,
        seed,
    };
    let simulated = simulate(1).run(&mut ()).unwrap();
    let file = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let csv = simulated.table.csv();
    let rows = file("rows.csv", csv.clone());
    // Each configuration three times, with other errors of measurement.
    let visits: String =
        csv.clone() + &csv.lines().skip(1).flat_map(|line| visit(line, 2)).collect::<String>();
    let visits = file("visits.csv", visits);
    let read = |path: &Path| Data::read(path, &map()).unwrap();
    let accept = map().accept;
    let mut all = vec![("SimulateReport", json(&simulated))];
    for path in [&rows, &visits] {
        let job = Measure { machine: nominal.clone(), map: map(), data: read(path), accept: accept.clone() };
        all.push(("MeasureReport", json(&job.run(&mut ()).unwrap())));
        let job = Identify {
            machine: nominal.clone(),
            map: map(),
            data: read(path),
            test: Some(read(&rows)),
            terms: vec![Family::Joint],
            harmonics: Vec::new(),
            settings: Settings { folds: 4, ..Settings::default() },
            accept: accept.clone(),
        };
        all.push(("IdentifyReport", json(&job.run(&mut ()).unwrap())));
    }
    let commanded = Data::read_commanded(rows.as_path(), &map()).unwrap();
    let job = Compensate {
        machine: real.clone(),
        map: map(),
        data: commanded,
        poses: false,
        tolerance: 1e-3,
        weight: None,
    };
    all.push(("CompensateReport", json(&job.run(&mut ()).unwrap())));
    let choice = Choice::Optimal { criterion: Criterion::Variance, count: 12, candidates: 30 };
    let study = Study::find(None, &nominal).unwrap();
    let job = Plan { machine: nominal.clone(), map: map(), choice, study, model_error: 0.0, seed: None };
    all.push(("PlanReport", json(&job.run(&mut ()).unwrap())));
    let moved: String = csv
        .lines()
        .enumerate()
        .map(|(i, line)| if i == 0 { format!("{line}\n") } else { visit(line, 1).concat() })
        .collect();
    let again = file("again.csv", moved);
    let checks = Checks::read([rows.as_path(), again.as_path()], &map()).unwrap();
    let settings = monitor::Settings { tolerance: Some(0.5), ..Default::default() };
    let job = Monitor { machine: nominal.clone(), map: map(), checks, settings };
    all.push(("MonitorReport", json(&job.run(&mut ()).unwrap())));
    let job = Doctor { machine: nominal, data: rows.as_path().into(), within: None };
    all.push(("DoctorReport", json(&job.run(&mut ()).unwrap())));
    all
}

/// Returns further visits of a configuration, whose last six numbers differ a little.
fn visit(line: &str, count: usize) -> Vec<String> {
    let cells: Vec<&str> = line.split(',').collect();
    let repeated = |i: usize| {
        let cells = cells.iter().enumerate().map(|(k, cell)| match (k, cell.parse::<f64>()) {
            (6.., Ok(number)) => (number + 0.001 * (i + 1) as f64 * (k % 3) as f64).to_string(),
            _ => (*cell).to_owned(),
        });
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    (0..count).map(repeated).collect()
}
