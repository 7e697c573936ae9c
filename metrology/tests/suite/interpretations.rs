//! Data read with a wrong interpretation: file formats, units, signs, column orders.

use std::path::PathBuf;

use abbe::Pose;
use abbe::identify::{Loss, Measurement};
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::doctor::{Doctor, PoseFormat};
use abbe_metrology::identify::{Identify, Prior, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::{Machine, Notes};
use tempfile::{TempDir, tempdir};

const POINT: &str = "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";

fn ur5() -> Machine {
    Machine::find("ur5").unwrap()
}

/// Returns a UR5 with an error.
fn real() -> Machine {
    let text = ur5().text().unwrap()
        + "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\nframe = \"shoulder\"\ne_x = \"0.6 mm\"\ne_s = \"0.8 mrad\"\n";
    Machine::of_spec(Spec::parse("real.toml", &text).unwrap(), "real.toml")
}

fn euler(order: &str) -> String {
    format!(
        "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\neuler = {{ columns = [\"a\", \"b\", \"c\"], order = \"{order}\", unit = \"deg\" }}\n"
    )
}

/// Returns a map with joints in a unit, some of them reversed.
fn map(unit: &str, reversed: &[usize], layout: &str) -> Map {
    let sign = |i: &usize| if reversed.contains(i) { -1 } else { 1 };
    let joint =
        |i: usize| format!("q{i} = {{ column = \"j{i}\", unit = \"{unit}\", sign = {} }}\n", sign(&i));
    let joints: String = (1..=6).map(joint).collect();
    let head = "[data]\nuncertainty = \"0.02 mm\"\nangle_uncertainty = \"0.05 mrad\"\nbase = \"unknown\"\n\n[joints]\n";
    Map::parse("map.toml", &format!("{head}{joints}{layout}"), &ur5().spec).unwrap()
}

/// Simulates a file of measurements of the real machine as the map describes it.
fn simulated_file(map: &Map, seed: u64) -> String {
    let job = Simulate {
        machine: real(),
        map: map.clone(),
        at: Places::Samples(60),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    job.run(&mut ()).unwrap().table.csv()
}

/// Writes a file in its own temporary folder.
fn file(text: &str) -> (TempDir, PathBuf) {
    let folder = tempdir().unwrap();
    let path = folder.path().join("data.csv");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn read(text: &str, map: &Map) -> Result<Data, String> {
    let (_folder, path) = file(text);
    Data::read(&path, map).map_err(|mistake| mistake.to_string())
}

fn identified(map: &Map, text: &str) -> Result<f64, String> {
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let data = read(text, map)?;
    let job = Identify {
        machine: ur5(),
        map: map.clone(),
        data,
        test: None,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    };
    job.run(&mut ()).map(|report| report.fit.after.rms).map_err(|mistake| mistake.to_string())
}

#[derive(Default)]
struct RecordedNotes(Vec<String>);

impl Notes for RecordedNotes {
    fn note(&mut self, text: &str) {
        self.0.push(text.to_owned());
    }

    fn warn(&mut self, text: &str) {
        self.0.push(text.to_owned());
    }
}

/// Every wrong interpretation is refused; the message lists all necessary changes of the map and no
/// others.
#[test]
fn combinations_of_wrong_interpretations_are_named() {
    let metres = POINT.replace("mm", "m");
    let swapped = POINT.replace("\"x\", \"y\"", "\"y\", \"x\"");
    let [centimetres, inches, micrometres] = ["cm", "inch", "um"].map(|unit| POINT.replace("mm", unit));
    // Two matrices of which one is the other, transposed.
    let matrix = |a: &str, b: &str, c: &str| {
        let [d, e, f, g] =
            if b == "r12" { ["r13", "r31", "r23", "r32"] } else { ["r31", "r13", "r32", "r23"] };
        format!(
            "[pose]\nposition = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\
             matrix = [\"{a}\", \"{b}\", \"{d}\", \"{c}\", \"r22\", \"{f}\", \"{e}\", \"{g}\", \"r33\"]\n"
        )
    };
    let in_rad = euler("zyx").replace("unit = \"deg\"", "unit = \"rad\"");
    // R_z(c) R_y(b) R_x(a): angles about fixed axes x, y, z.
    let fixed = euler("zyx").replace("[\"a\", \"b\", \"c\"]", "[\"c\", \"b\", \"a\"]");
    let (deg, rad) =
        (|reversed: &[usize], layout: &str| map("deg", reversed, layout), map("rad", &[], POINT));
    let angles = "angles in rad, not deg";
    for (meant, taken, expected) in [
        (rad, deg(&[], POINT), vec![angles]),
        (deg(&[], POINT), map("rad", &[], POINT), vec!["angles in deg, not rad"]),
        (deg(&[2, 5], POINT), deg(&[], POINT), vec!["`q2`, `q5` count in the opposite direction"]),
        (map("rad", &[3], POINT), deg(&[], POINT), vec![angles, "`q3` count in the opposite direction"]),
        (deg(&[2], &metres), deg(&[], POINT), vec!["lengths in m, not mm", "`q2` count"]),
        (deg(&[], &swapped), deg(&[], POINT), vec!["two of the measured columns x, y and z swapped"]),
        (deg(&[], &euler("xyz")), deg(&[], &euler("zyx")), vec!["Euler angles in the order `xyz`"]),
        (deg(&[1, 4], &euler("zxy")), deg(&[], &euler("zyx")), vec!["order `zxy`", "`q1`, `q4` count"]),
        (deg(&[], POINT), deg(&[], &centimetres), vec!["lengths in mm, not cm"]),
        (deg(&[], &inches), deg(&[], POINT), vec!["lengths in inch, not mm"]),
        (deg(&[], &centimetres), deg(&[], POINT), vec!["lengths in cm, not mm"]),
        (deg(&[], &micrometres), deg(&[], POINT), vec!["lengths in um, not mm"]),
        (deg(&[2], &inches), deg(&[], &metres), vec!["lengths in inch, not m", "`q2` count"]),
        (
            deg(&[], &matrix("r11", "r12", "r21")),
            deg(&[], &matrix("r11", "r21", "r12")),
            vec!["orientations inverted"],
        ),
        (deg(&[], &in_rad), deg(&[], &euler("zyx")), vec!["angles of the orientations in rad, not deg"]),
        (
            deg(&[], &fixed),
            deg(&[], &euler("xyz")),
            vec!["fixed axes, `xyz`? reverse the columns, with `order = \"zyx\"`"],
        ),
    ] {
        let text = simulated_file(&meant, 3);
        assert!(identified(&meant, &text).unwrap() < 0.05);
        let refused = identified(&taken, &text).unwrap_err();
        assert!(expected.iter().all(|said| refused.contains(said)), "{expected:?}: {refused}");
        assert_eq!(refused.matches('?').count(), expected.len(), "{refused}");
    }
    // The columns of two joints are exchanged.
    let meant = deg(&[], POINT);
    let text = simulated_file(&meant, 4).replacen("j1,j2,j3", "j1,j3,j2", 1);
    let refused = identified(&meant, &text).unwrap_err();
    assert!(refused.contains("columns of `q2` and `q3` swapped"), "{refused}");
}

/// Implausibly large errors raise a warning.
#[test]
fn errors_near_a_metre_raise_a_warning() {
    let map = map("deg", &[], POINT);
    let known = Map::parse("map.toml", &map_text().replace("base = \"unknown\"\n", ""), &ur5().spec).unwrap();
    let mut data = read(&simulated_file(&map, 5), &map).unwrap();
    let measured = |data: &Data| {
        let mut heard = RecordedNotes::default();
        let report =
            Measure { machine: ur5(), map: known.clone(), data: data.clone(), accept: Acceptance::default() }
                .run(&mut heard)
                .unwrap();
        (report, heard.0.join("\n"))
    };
    let (_, said) = measured(&data);
    assert!(!said.contains("of the arm"), "{said}");
    // The instrument is at another place.
    let (s, c) = 0.4_f64.sin_cos();
    let station = Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]);
    let points = data.observations.iter_mut().filter_map(|row| match &mut row.measured {
        Measurement::Points(points) => points[0].as_mut(),
        _ => None,
    });
    points.for_each(|point| *point = station.apply([point[0] + 700.0, point[1], point[2]]));
    let (report, said) = measured(&data);
    assert!(report.errors[3].rms > 400.0);
    assert!(said.contains("with base and tool fitted") && said.contains("`base = \"unknown\"`"), "{said}");
    // Shuffled rows do not fit this machine.
    let count = data.observations.len();
    let shuffled: Vec<Measurement> =
        (0..count).map(|i| data.observations[(17 * i + 5) % count].measured.clone()).collect();
    data.observations.iter_mut().zip(shuffled).for_each(|(row, other)| row.measured = other);
    let (_, said) = measured(&data);
    assert!(said.contains("Check that these are measurements of this machine"), "{said}");
}

fn map_text() -> String {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
    format!("[data]\nuncertainty = \"0.02 mm\"\nbase = \"unknown\"\n\n[joints]\n{joints}{POINT}")
}

/// Semicolons or tabs as delimiters and decimal commas give the same data and are reported.
#[test]
fn delimiters_and_decimal_commas_are_recognized() {
    let map = map("deg", &[], POINT);
    let plain = simulated_file(&map, 6);
    let expected = read(&plain, &map).unwrap();
    assert_eq!(expected.dialect, None);
    let decimals = |delimiter: &str| plain.replace(',', delimiter).replace('.', ",");
    for (text, said) in [
        (decimals(";"), "separated by semicolons, with decimal commas"),
        (decimals("\t"), "separated by tabs, with decimal commas"),
        (plain.replace(',', ";"), "separated by semicolons"),
        (decimals(";").replace('\n', "\r\n"), "separated by semicolons, with decimal commas"),
    ] {
        let data = read(&text, &map).unwrap();
        assert_eq!(data.dialect, Some(said));
        assert!(data.summary().lines()[0].ends_with(&format!(": 60 rows ({said})")));
        assert_eq!(data.observations, expected.observations);
    }
    // Extra cells and invalid numbers are reported with their lines.
    let mut lines: Vec<String> = plain.lines().map(str::to_owned).collect();
    lines[10] += ",7.5";
    lines[20] += ",,";
    lines[30] = lines[30].replacen('.', ".1.", 1);
    let data = read(&lines.join("\r\n"), &map).unwrap();
    let unusable: Vec<_> = data.unusable.iter().map(|row| (row.line, row.reason.as_str())).collect();
    let [(11, long), (31, wrong)] = unusable[..] else { panic!("{unusable:?}") };
    assert!(
        long.contains("10 cells, but the heading has 9") && wrong.contains("not a number"),
        "{unusable:?}"
    );
    // Two columns have the same name.
    let refused = read(&plain.replacen("j2", "j1", 1), &map).unwrap_err();
    assert!(refused.contains("there is no column `j2`"), "{refused}");
    let refused = read(&plain.replacen(",z", ",z,z", 1), &map).unwrap_err();
    assert!(refused.contains("duplicate column `z`"), "{refused}");
    // Decimal commas and comma delimiters are ambiguous.
    let refused = read(&plain.replace('.', ","), &map).unwrap_err();
    assert!(
        refused.contains("line 2: the row has ") && refused.contains("quote cells that contain commas"),
        "{refused}"
    );
    // Without a heading, the line that is missing is printed.
    let headless = plain.split_once('\n').unwrap().1;
    let refused = read(headless, &map).unwrap_err();
    let line = refused.split_once("such as `").unwrap_or_else(|| panic!("{refused}")).1;
    let data = read(&format!("{}\n{headless}", line.split_once('`').unwrap().0), &map).unwrap();
    assert_eq!(data.observations.len(), headless.lines().count());
    let refused = read(&headless.replace(',', " "), &map).unwrap_err();
    assert!(refused.contains("separated by blanks"), "{refused}");
    // Several missing columns give one error.
    let refused = read(&plain.replace("j", "joint "), &map).unwrap_err();
    assert!(
        refused.contains("6 columns of the map are missing in") && refused.matches("error:").count() == 1,
        "{refused}"
    );
}

/// A fit that changes a link by far more than its prior is doubted (125 mm of 425 mm), and refused
/// where no machine can be that wrong (475 mm).
#[test]
fn impossible_lengths_are_refused() {
    let map = map("deg", &[], POINT);
    let read = |link: f64| {
        let text = ur5().text().unwrap().replacen("-425", &(-link).to_string(), 1);
        let machine = Machine::of_spec(Spec::parse("short.toml", &text).unwrap(), "short.toml");
        let at = Places::Samples(60);
        let (noise, outliers, random, seed) = (None, 0.0, false, 3);
        let job = Simulate { machine, map: map.clone(), at, noise, outliers, random, seed };
        read(&job.run(&mut ()).unwrap().table.csv(), &map).unwrap()
    };
    let identified = |data: Data| {
        let mut heard = RecordedNotes::default();
        let settings = Settings {
            loss: Loss::Squares,
            prior: Prior::default(),
            folds: 5,
            time: None,
            points: false,
            only_placement: false,
        };
        let job = Identify {
            machine: ur5(),
            map: map.clone(),
            data,
            test: None,
            terms: Vec::new(),
            harmonics: Vec::new(),
            settings,
            accept: Acceptance::default(),
        };
        (job.run(&mut heard).map(|_| ()).map_err(|mistake| mistake.to_string()), heard.0.join("\n"))
    };
    let (refused, _) = identified(read(-50.0));
    assert!(refused.as_ref().is_err_and(|said| said.contains("changes a length")), "{refused:?}");
    let (fitted, said) = identified(read(300.0));
    assert!(fitted.is_ok() && said.contains("changes a length"), "{fitted:?} {said}");
    let (fitted, said) = identified(read(424.0));
    assert!(fitted.is_ok() && !said.contains("changes a length"), "{fitted:?} {said}");
}

/// The doctor names joints that do not move instead of doubting the machine.
#[test]
fn the_doctor_names_joints_at_rest() {
    let row =
        |i: u32| format!("10,-60,80,20,30,{},{},{},{}\n", 12 * i, 97 * i % 370, 53 * i % 410, 31 * i % 290);
    let text = format!("j1,j2,j3,j4,j5,j6,x,y,z\n{}", (0..12).map(row).collect::<String>());
    let (_folder, path) = file(&text);
    let report = Doctor { machine: ur5(), data: (&path).into(), within: None }.run(&mut ()).unwrap();
    assert!(!report.fits);
    assert_eq!((report.still.len(), &*report.moved), (5, &["q6".to_owned()][..]));
}

/// The sign of differences between commanded and actual cannot be told from small errors: the one
/// that a map states comes first, and the other is named.
#[test]
fn the_sign_of_differences_is_that_of_a_map() {
    let text = simulated_file(&map("deg", &[], POINT), 8);
    let data = read(&text, &map("deg", &[], POINT)).unwrap();
    let interpreter = abbe_interpreter::Interpreter::new(ur5().spec.clone());
    let parameters =
        abbe::analysis::sampling::nominal_parameters(abbe::Manipulator::description(&interpreter));
    for sign in [1.0, -1.0] {
        let row = |row: &abbe::identify::Observation| {
            let ideal = abbe::Manipulator::pose(&interpreter, &row.q, &parameters).unwrap().position();
            let Measurement::Points(points) = &row.measured else { unreachable!() };
            let real = points[0].unwrap();
            let difference = [0, 1, 2].map(|k| sign * (ideal[k] - real[k]));
            let all = row.q.iter().map(|q| q.to_degrees()).chain(ideal).chain(difference);
            all.map(|value| value.to_string()).collect::<Vec<_>>().join(",") + "\n"
        };
        let rows: String = data.observations.iter().map(row).collect();
        let (_folder, path) = file(&format!("j1,j2,j3,j4,j5,j6,x,y,z,dx,dy,dz\n{rows}"));
        let report = Doctor { machine: ur5(), data: (&path).into(), within: None }.run(&mut ()).unwrap();
        let signs: Vec<PoseFormat> = report.found.iter().map(|found| found.interpretation.layout).collect();
        let expected = [true, false].map(|sign| PoseFormat::Difference { target_minus_actual: sign });
        assert_eq!(signs, expected, "{:?}", report.found);
    }
}
