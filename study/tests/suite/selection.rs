//! Selection of richer terms: what is chosen is what the machine has.

use abbe::identify::Loss;
use abbe_spec::Spec;
use abbe_study::data::{Data, Map};
use abbe_study::identify::{Family, Identify, Prior, Report, Settings};
use abbe_study::simulate::{Places, Simulate};
use abbe_study::{Acceptance, Machine};

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
    let settings =
        Settings { loss: Loss::Squares, prior: Prior::Share(0.01), folds: 10, time: None, points: false };
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
    let settings =
        Settings { loss: Loss::Squares, prior: Prior::Share(0.01), folds: 10, time: None, points: false };
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
