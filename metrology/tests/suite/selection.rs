//! Selection of richer terms: what is chosen is what the machine has.

use abbe::identify::{Loss, Measurement, Observation};
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Family, Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::Machine;

/// A slide of 1 m along x.
const SLIDE: &str = r#"
[manipulator]
name = "slide"
length = "mm"

[[frame]]
name = "slide"
variable = { name = "x", kind = "prismatic", limits = ["0 mm", "1000 mm"] }
transform = "Tx(x)"
"#;

/// A scale error of +100 ppm.
const SCALE: &str =
    "[[source]]\nname = \"scale\"\nclass = \"repeatable\"\njoint = \"x\"\nerror = \"1e-4 * x\"\n";

const LASER: &str = "[data]\nbase = \"exact\"\nplacement = \"exact\"\n\n[joints]\nx = { column = \"x\", unit = \"mm\" }\n\n\
                     [[instrument]]\nname = \"laser\"\nkind = \"displacement\"\ncolumn = \"travelled\"\nunit = \"um\"\nuncertainty = \"0.1 um\"\n";

fn machine(name: &str, text: &str) -> Machine {
    Machine::of_spec(Spec::parse(name, text).unwrap(), name)
}

/// Identifies the slide with the scale error from 40 displacements measured by a laser.
fn identified(terms: &[Family]) -> Report {
    let (nominal, real) = (machine("slide.toml", SLIDE), machine("real.toml", &format!("{SLIDE}{SCALE}")));
    let map = Map::parse("laser.toml", LASER, &nominal.spec).unwrap();
    let at = Places::Samples(41);
    let job =
        Simulate { machine: real, map: map.clone(), at, noise: None, outliers: 0.0, random: false, seed: 2 };
    let table = job.run(&mut ()).unwrap().table;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("data.csv");
    std::fs::write(&path, table.csv()).unwrap();
    let data = Data::read(&path, &map).unwrap();
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 10,
        time: None,
        points: false,
        only_placement: false,
    };
    let (terms, harmonics, accept) = (terms.to_vec(), Vec::new(), Acceptance::default());
    let job = Identify { machine: nominal, map, data, test: None, terms, harmonics, settings, accept };
    job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// A laser measures displacements between rows: a factor of the row alone multiplies a difference
/// of two rows, and the scale is invisible.
#[test]
fn a_laser_finds_the_scale_of_a_slide() {
    for terms in [&[Family::Joint][..], &Family::ALL] {
        let report = identified(terms);
        let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
        assert_eq!(names, ["x: in proportion to x, joint error"], "{terms:?}");
        let scale = report.found.terms[0].magnitude / 1000.0;
        assert!((scale - 1e-4).abs() < 1e-6, "{scale}");
        assert!(report.fit.after.rms < 1.5e-4, "{:?}", report.fit.after);
    }
}

/// Terms with inputs derived from rows are computed for the row that a displacement begins at, too.
#[test]
fn backlash_and_drift_are_tried_with_displacements() {
    for family in [Family::Backlash, Family::Drift] {
        let report = identified(&[family]);
        assert!(report.tried > 0, "{family:?}");
    }
}

/// Along several stations, time and station are the same thing: no drift is tried, and the report
/// says so.
#[test]
fn drift_is_not_tried_across_stations() {
    let machine = Machine::find("ur5").unwrap();
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"rad\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nbase = \"unknown\"\n\n[joints]\n{joints}\n[point]\n\
         columns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    let map = Map::parse("map.toml", &text, &machine.spec).unwrap();
    let at = Places::Samples(80);
    let job = Simulate {
        machine: machine.clone(),
        map: map.clone(),
        at,
        noise: None,
        outliers: 0.0,
        random: false,
        seed: 4,
    };
    let mut observations = job.run(&mut ()).unwrap().observations;
    observations[40..].iter_mut().for_each(|row| row.station = 1);
    let stations = ["first", "second"].map(str::to_owned).to_vec();
    let data = Data { file: "simulated".to_owned(), observations, stations, ..Data::default() };
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 10,
        time: None,
        points: false,
        only_placement: false,
    };
    let (terms, harmonics, accept) = (vec![Family::Drift], Vec::new(), Acceptance::default());
    let job = Identify { machine, map, data, test: None, terms, harmonics, settings, accept };
    let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
    assert!(report.terms.is_empty() && report.tried == 0, "{:?}", report.terms);
    assert!(
        report.notes.iter().any(|note| note.contains("drift terms were not tried")),
        "{:?}",
        report.notes
    );
}

/// Three slides at right angles, whose scales are 100, -50 and 30 ppm long.
fn gantry(scales: &str) -> Machine {
    let frame = |axis: char| {
        format!(
            "[[frame]]\nname = \"{axis}\"\nvariable = {{ name = \"{axis}\", kind = \"prismatic\", limits = \
             [\"0 mm\", \"500 mm\"] }}\ntransform = \"T{axis}({axis})\"\n\n"
        )
    };
    let frames: String = ['x', 'y', 'z'].map(frame).concat();
    machine("gantry.toml", &format!("[manipulator]\nname = \"gantry\"\nlength = \"mm\"\n\n{frames}{scales}"))
}

/// A laser measures axis by axis: each scale has an effect in a third of the rows only, and all
/// three are found, as scales.
#[test]
fn a_laser_finds_the_scales_of_three_slides() {
    let scale = |(axis, ppm): (char, i32)| {
        format!(
            "\n[[source]]\nname = \"scale of {axis}\"\nclass = \"repeatable\"\njoint = \"{axis}\"\n\
             error = \"{ppm}e-6 * {axis}\"\n"
        )
    };
    let real = gantry(&[('x', 100), ('y', -50), ('z', 30)].map(scale).concat());
    let nominal = gantry("");
    let joints: String =
        ['x', 'y', 'z'].map(|axis| format!("{axis} = {{ column = \"{axis}\", unit = \"mm\" }}\n")).concat();
    let laser = LASER.replace("x = { column = \"x\", unit = \"mm\" }\n", &joints).replace("0.1 um", "0.2 um");
    let map = Map::parse("laser.toml", &laser, &nominal.spec).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("data.csv");
    // Out and back, axis by axis.
    let along = |axis: usize| {
        let row = move |i: usize| [0, 1, 2].map(|k| if k == axis { 25 * i.min(40 - i) } else { 0 });
        (0..41).map(row)
    };
    let rows = (0..3).flat_map(along).map(|[x, y, z]| format!("{x},{y},{z}\n"));
    std::fs::write(&path, format!("x,y,z\n{}", rows.collect::<String>())).unwrap();
    let plan = Data::read_commanded(&path, &map).unwrap();
    for seed in 0..4 {
        let (machine, at) = (real.clone(), Places::Rows(plan.clone()));
        let job = Simulate { machine, map: map.clone(), at, noise: None, outliers: 0.0, random: false, seed };
        std::fs::write(&path, job.run(&mut ()).unwrap().table.csv()).unwrap();
        let data = Data::read(&path, &map).unwrap();
        let (machine, map, terms, harmonics) =
            (nominal.clone(), map.clone(), Family::ALL.to_vec(), Vec::new());
        let (settings, accept) = (Settings::default(), Acceptance::default());
        let job = Identify { machine, map, data, test: None, terms, harmonics, settings, accept };
        let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
        let mut names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
        names.sort_unstable();
        let scales = ["x", "y", "z"].map(|axis| format!("{axis}: in proportion to {axis}, joint error"));
        assert_eq!(names, scales, "seed {seed}");
        assert!(report.fit.after.rms < 3e-4, "seed {seed}: {:?}", report.fit.after);
    }
}

/// Terms that depend on the order of the rows are not written: the report says what the written
/// spec leaves, which was read back on the rows of the fit.
#[test]
fn the_report_says_what_the_written_spec_leaves() {
    let machine = Machine::find("ur5").unwrap();
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"rad\" }}\n")).collect();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nbase = \"exact\"\n\n[joints]\n{joints}\n[point]\n\
         columns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    let map = Map::parse("map.toml", &text, &machine.spec).unwrap();
    let at = Places::Samples(100);
    let (outliers, random, seed) = (0.0, false, 4);
    let job =
        Simulate { machine: machine.clone(), map: map.clone(), at, noise: None, outliers, random, seed };
    let steady = job.run(&mut ()).unwrap().observations;
    let drifting = |(i, mut row): (usize, Observation)| {
        let Measurement::Points(points) = &mut row.measured else { panic!("points") };
        points.iter_mut().flatten().for_each(|point| point[2] += 0.003 * i as f64);
        row
    };
    let drifting: Vec<Observation> = steady.iter().cloned().enumerate().map(drifting).collect();
    for (observations, is_drifting) in [(steady, false), (drifting, true)] {
        let data = Data {
            file: "simulated".to_owned(),
            observations,
            stations: vec![String::new()],
            ..Data::default()
        };
        let (machine, map, terms) = (machine.clone(), map.clone(), vec![Family::Drift]);
        let (harmonics, settings, accept) = (Vec::new(), Settings::default(), Acceptance::default());
        let job = Identify { machine, map, data, test: None, terms, harmonics, settings, accept };
        let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
        let said = report.notes.iter().any(|note| note.contains("the written spec leaves"));
        assert_eq!((said, report.terms.is_empty()), (is_drifting, !is_drifting), "{:?}", report.notes);
    }
}

/// An arm beside a camera that pans, with a finger that slides behind the tool.
const TREE: &str = r#"
[manipulator]
name = "tree"
length = "mm"

[[frame]]
name = "camera"
variable = { name = "pan", kind = "revolute", limits = ["-20 deg", "20 deg"] }
transform = "Rz(pan) Tz(200)"

[[frame]]
name = "column"
parent = "base"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"] }
transform = "Rz(q1) Tz(300)"

[[frame]]
name = "upper"
variable = { name = "q2", kind = "revolute", limits = ["-120 deg", "120 deg"] }
transform = "Ry(q2) Tx(400)"

[[frame]]
name = "fore"
variable = { name = "q3", kind = "revolute", limits = ["-140 deg", "140 deg"] }
transform = "Ry(q3) Tx(300)"

[[frame]]
name = "cover"
parent = "upper"
transform = "Ty(100)"

[tool]
frame = "fore"
transform = "Tz(50)"
"#;

/// The weight at the tool, a link that it bends, and a gear.
const GRAVITY: &str = "gravity = [0, 0, \"-9.80665 m/s^2\"]\n";
const WEIGHT: &str = "\n[[load]]\nname = \"weight\"\nmass = \"1 kg\"\nframe = \"fore\"\npoint = \"tool\"\n";
const BENT: &str = "\n[[source]]\nname = \"bent\"\nclass = \"repeatable\"\nframe = \"column\"\n\
                    compliance = { diagonal = [0, 0, 0, \"1e-7/(N*mm)\", \"1e-7/(N*mm)\", \"1e-7/(N*mm)\"] }\n";
const GEAR: &str = "\n[[source]]\nname = \"gear\"\nclass = \"repeatable\"\njoint = \"q2\"\n\
                    error = \"0.5 mrad * sin(q2)\"\n";

/// Identifies a tree by terms of a family; returns the report, and what the written spec leaves on
/// other rows of the machine, as a multiple of the noise.
fn of_tree(errors: &str, family: Family) -> (Report, f64) {
    let (nominal, real) =
        (machine("tree.toml", TREE), machine("real.toml", &format!("{GRAVITY}{TREE}{errors}")));
    let joint = |name| format!("{name} = {{ column = \"{name}\", unit = \"deg\" }}\n");
    let joints = ["pan", "q1", "q2", "q3"].map(joint).concat();
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nbase = \"exact\"\nplacement = \"exact\"\n\n[joints]\n{joints}\n[point]\n\
         columns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n"
    );
    let map = Map::parse("map.toml", &text, &nominal.spec).unwrap();
    let [data, unseen] = [1, 2].map(|seed| {
        let (machine, at, noise) = (real.clone(), Places::Samples(150), None);
        let job = Simulate { machine, map: map.clone(), at, noise, outliers: 0.0, random: false, seed };
        let observations = job.run(&mut ()).unwrap().observations;
        Data { file: "data.csv".to_owned(), observations, ..Data::default() }
    });
    let (machine, terms, harmonics) = (nominal.clone(), vec![family], Vec::new());
    let (settings, accept) = (Settings::default(), Acceptance::default());
    let job = Identify { machine, map: map.clone(), data, test: None, terms, harmonics, settings, accept };
    let report = job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
    let text = report.found.identified_spec(&nominal.spec, TREE, "found.toml").unwrap().text;
    let machine = self::machine("found.toml", &text);
    let job = Measure { machine, map, data: unseen, accept: Acceptance::default() };
    let left = job.run(&mut ()).unwrap().explained.left_rms;
    (report, left / (0.02 * 3f64.sqrt()))
}

/// Terms are found in a tree whose first frame does not carry the tool and whose last one hangs
/// beside it: the weight stands at the tool, and what is written is what was found.
#[test]
fn terms_are_found_on_trees() {
    for (errors, family) in [(format!("{WEIGHT}{BENT}"), Family::Elastic), (GEAR.to_owned(), Family::Joint)] {
        let (report, left) = of_tree(&errors, family);
        let names: Vec<&str> = report.terms.iter().map(|term| &term.name[..]).collect();
        println!("{family:?}: {names:?}, {left:.3} times the noise");
        assert!(!names.is_empty() && left < 1.2, "{family:?}: {names:?} {left}");
        assert!(!report.notes.iter().any(|note| note.contains("written spec leaves")), "{:?}", report.notes);
    }
}
