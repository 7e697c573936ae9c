//! A camera on the tool and one in the room: hand-eye, board and joint zeros from pixels.

use abbe::identify::Measurement;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::plan::{Choice, Plan};
use abbe_metrology::simulate::{Places, Simulate};
use abbe_spec::Spec;
use abbe_study::{Machine, Study};

/// Zeros of joints of the simulated UR5, in rad.
const ZEROS: [(&str, f64); 4] =
    [("shoulder", 1.2e-3), ("elbow", -0.9e-3), ("wrist 1", 1.5e-3), ("wrist 2", -0.7e-3)];

fn nominal() -> Machine {
    Machine::find("ur5").unwrap()
}

/// Returns the UR5 with its joint zeros displaced.
fn real() -> Machine {
    let mut text =
        format!("{}\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\n", nominal().text().unwrap());
    for (frame, value) in ZEROS {
        text += &format!("[[source.effect]]\nframe = \"{frame}\"\ne_r = \"{value} rad\"\n");
    }
    Machine::of_spec(Spec::parse("real.toml", &text).unwrap(), "real.toml")
}

/// A board of 9 × 6 corners, 600 mm in front of the base or on the tool, and a camera of 640 × 480.
fn map_text(mount: &str, pixels: &str, intrinsics: &str, places: &str) -> String {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"j{i}\", unit = \"deg\" }}\n")).collect();
    format!(
        "[data]\ntitle = \"camera\"\n[joints]\n{joints}\n[[instrument]]\nname = \"camera\"\nkind = \"camera\"\n\
         mount = \"{mount}\"\npixels = [\"u\", \"v\"]\nboard = [9, 6]\npitch = \"15 mm\"\nimage = [640, 480]\nfocal = [800, 800]\n\
         distortion = [-0.1, 0.05, 0.001, -0.001, 0]\nintrinsics = \"{intrinsics}\"\n\
         uncertainty = {pixels}\n{places}"
    )
}

/// Placements of camera and board, which the identification does not know.
///
/// The station is `F_0` in the frame of the board, or of the camera, that stands in the room.
fn places(mount: &str) -> &'static str {
    match mount {
        "tool" => {
            "[[station]]\nposition = [\"100 mm\", \"560 mm\", \"120 mm\"]\nquaternion = [0, 1, 0, 0]\n\
             [placement]\nposition = [\"40 mm\", \"-15 mm\", \"60 mm\"]\nquaternion = [0.7, 0, 0.1, 0.7]\n"
        }
        _ => {
            "[[station]]\nposition = [\"60 mm\", \"50 mm\", \"1100 mm\"]\nquaternion = [0.70710678118654752, 0.70710678118654752, 0, 0]\n\
             [placement]\nposition = [\"-60 mm\", \"-40 mm\", \"20 mm\"]\nquaternion = [0.1, 0.9, 0.3, 0.3]\n"
        }
    }
}

fn parsed(text: &str) -> Map {
    Map::parse("map.toml", text, &nominal().spec).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn simulation(map: &Map, views: usize, seed: u64) -> abbe_metrology::simulate::Report {
    let job = Simulate {
        machine: real(),
        map: map.clone(),
        at: Places::Samples(views),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn simulated(map: &Map, views: usize, seed: u64) -> Data {
    let report = simulation(map, views, seed);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("views.csv");
    std::fs::write(&path, report.table.csv()).unwrap();
    Data::read(&path, map).unwrap_or_else(|mistake| panic!("{mistake}"))
}

fn job(map: &Map, data: Data, test: Option<Data>) -> Identify {
    let settings = Settings {
        loss: abbe::identify::Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    Identify {
        machine: nominal(),
        map: map.clone(),
        data,
        test,
        terms: Vec::new(),
        harmonics: Vec::new(),
        settings,
        accept: Acceptance::default(),
    }
}

fn identified(map: &Map, data: Data, test: Option<Data>) -> Report {
    job(map, data, test).run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// Returns the identified spec and map.
fn written(report: &Report, map: &Map) -> (Machine, Map) {
    let machine = nominal();
    let spec = report.found.identified_spec(&machine.spec, &machine.text().unwrap(), "found.toml").unwrap();
    let text = report.found.identified_map(map, &machine.spec, "found.map.toml").unwrap();
    let found = Machine::of_spec(Spec::parse("found.toml", &spec.text).unwrap(), "found.toml");
    let map = Map::parse("found.map.toml", &text, &found.spec).unwrap();
    (found, map)
}

fn measured(machine: Machine, map: Map, data: Data) -> abbe_metrology::measure::Report {
    let job = Measure { machine, map, data, accept: Acceptance::default() };
    job.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"))
}

/// Joint zeros and places are found from pixels alone, without a start value of the places of
/// camera and board, and views that nothing was fitted to are predicted to the noise of a pixel at
/// their distance. The written spec and map give the same figure in millimetres.
#[test]
fn a_camera_identifies_the_machine_on_tool_and_in_room() {
    for (mount, intrinsics) in [("tool", "known"), ("room", "known"), ("tool", "fitted")] {
        let case = format!("{mount}, {intrinsics}");
        let truth = parsed(&map_text(mount, "0.2", "known", places(mount)));
        let pixels = if intrinsics == "fitted" { "\"unknown\"" } else { "0.2" };
        let map = map_text(mount, pixels, intrinsics, "");
        let map = match intrinsics {
            "known" => map,
            _ => map
                .replace("[800, 800]", "[780, 790]")
                .replace("[-0.1, 0.05, 0.001, -0.001, 0]", "[0, 0, 0, 0, 0]"),
        };
        let map = parsed(&map);
        let (data, test) = (simulated(&truth, 40, 1), simulated(&truth, 20, 2));
        let report = identified(&map, data, Some(test.clone()));
        let figures = report.test.unwrap();
        assert!((0.95..1.05).contains(&report.uncertainty_factor), "{case}: {}", report.uncertainty_factor);
        assert!(figures.base_and_tool.mean > 2.0 * figures.after.mean, "{case}: {figures:?}");
        // 0.2 px at 350 to 700 mm, with a focal length of 800 px.
        assert!((0.1..0.2).contains(&figures.after.mean), "{case}: {figures:?}");
        for (number, truth) in [("zero of q3", 1.2e-3), ("zero of q4", -0.9e-3), ("zero of q5", 1.5e-3)] {
            let found = report.joint_errors.iter().find(|one| one.number == number);
            let found = found.unwrap_or_else(|| panic!("{case}: no {number} in {:?}", report.joint_errors));
            let z = (found.value - truth) / found.standard_deviation;
            assert!(z.abs() < 4.0 && found.standard_deviation < 2e-4, "{case}: {number} {found:?}");
        }
        if let Some(found) = report.placed.instruments.first() {
            let truth = [800.0, 800.0, 319.5, 239.5, -0.1, 0.05, 0.001, -0.001];
            for (k, (found_value, truth)) in found.intrinsics.unwrap().iter().zip(truth).enumerate() {
                let z = (found_value - truth) / found.covariance[k][k].sqrt();
                assert!(z.abs() < 4.0, "{case}: parameter {k} is {found_value}, z {z:.1}");
            }
        }
        assert_eq!(report.placed.instruments.len(), usize::from(intrinsics == "fitted"), "{case}");
        let (found, found_map) = written(&report, &map);
        let measure = measured(found, found_map, test);
        assert!(!measure.base_fitted, "{case}");
        let (left, mean) = (measure.explained.left_mean, figures.after.mean);
        assert!((left - mean).abs() < 1e-3 * mean, "{case}: {left} {mean}");
        assert_eq!((measure.instruments[0].unit.as_str(), measure.instruments[0].count), ("px", 20 * 54));
    }
}

/// Tags on three faces of a cube identify the machine, whichever of their corners a view shows:
/// all, two tags, or one; and the written map has them.
#[test]
fn tags_in_three_dimensions_identify_the_machine() {
    let face =
        |at: &dyn Fn([f64; 2]) -> [f64; 3]| [[10.0, 10.0], [70.0, 10.0], [70.0, 70.0], [10.0, 70.0]].map(at);
    let faces = [face(&|[x, y]| [x, y, 0.0]), face(&|[x, y]| [x, 0.0, y]), face(&|[x, y]| [0.0, x, y])];
    let corners = format!(
        "corners = {:?}\n",
        faces.as_flattened().iter().map(|at| at.map(|x| format!("{x} mm"))).collect::<Vec<_>>()
    );
    let of_tags = |places: &str| {
        let text = map_text("tool", "0.2", "known", places);
        parsed(&text.replace("board = [9, 6]\npitch = \"15 mm\"\n", &corners))
    };
    let (truth, map) = (of_tags(places("tool")), of_tags(""));
    let mut data = simulated(&truth, 60, 1);
    for (i, row) in data.observations.iter_mut().enumerate() {
        let Measurement::Readings(readings) = &mut row.measured else { unreachable!() };
        let hidden = [0..0, 8..16, 0..16][i % 3].clone();
        readings[hidden].fill(None);
    }
    let report = identified(&map, data, Some(simulated(&truth, 20, 2)));
    assert!((0.9..1.1).contains(&report.uncertainty_factor), "{}", report.uncertainty_factor);
    for (number, truth) in [("zero of q3", 1.2e-3), ("zero of q4", -0.9e-3), ("zero of q5", 1.5e-3)] {
        let found = report.joint_errors.iter().find(|one| one.number == number).unwrap();
        let z = (found.value - truth) / found.standard_deviation;
        assert!(z.abs() < 4.0 && found.standard_deviation < 4e-4, "{number} {found:?}");
    }
    let figures = report.test.as_ref().unwrap();
    assert!((0.1..0.25).contains(&figures.after.mean), "{figures:?}");
    let (found, found_map) = written(&report, &map);
    let left = measured(found, found_map, simulated(&truth, 20, 2)).explained.left_mean;
    assert!((left - figures.after.mean).abs() < 1e-3 * left, "{left} {figures:?}");
}

/// Without stated places, `measure` fits those of camera and board, and the intrinsic parameters.
#[test]
fn measure_finds_camera_and_board() {
    let truth = parsed(&map_text("room", "0.2", "known", places("room")));
    let map = map_text("room", "0.2", "fitted", "").replace("[800, 800]", "[780, 790]");
    let report = measured(real(), parsed(&map), simulated(&truth, 20, 3));
    assert!(report.base_fitted);
    assert!((0.25..0.3).contains(&report.instruments[0].left.rms), "{:?}", report.instruments);
}

/// A planned set of views predicts the standard deviations that an identification then states.
#[test]
fn planned_views_predict_the_identification() {
    let map = parsed(&map_text("tool", "0.2", "known", places("tool")));
    let machine = nominal();
    let study = Study::find(None, &machine).unwrap();
    let choice =
        Choice::Optimal { criterion: abbe::identify::Criterion::Variance, count: 30, candidates: 1000 };
    let plan = Plan { machine, map: map.clone(), study, choice, model_error: 0.0, seed: None };
    let report = plan.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}"));
    assert_eq!((report.rows, report.rank), (30, 30));
    let blind = Map::parse("map.toml", &map_text("tool", "0.2", "known", ""), &nominal().spec).unwrap();
    let plan = Plan { map: blind, ..plan };
    let mistake = plan.run(&mut ()).unwrap_err().to_string();
    assert!(mistake.contains("where the camera and the board are"), "{mistake}");
}

/// A camera that four axes cannot turn at will sees the board from where it does.
#[test]
fn views_of_a_camera_on_four_axes_are_planned() {
    let machine = Machine::find("scara").unwrap();
    let joints: String = [("q1", "deg"), ("q2", "deg"), ("d3", "mm"), ("q4", "deg")]
        .map(|(name, unit)| format!("{name} = {{ column = \"{name}\", unit = \"{unit}\" }}\n"))
        .concat();
    let text = format!(
        "[data]\n[joints]\n{joints}\n[[instrument]]\nname = \"camera\"\nkind = \"camera\"\nmount = \"tool\"\n\
         pixels = [\"u\", \"v\"]\nboard = [5, 4]\npitch = \"25 mm\"\nimage = [1280, 1024]\nfocal = [1200, 1200]\n\
         uncertainty = 0.1\n[[station]]\nposition = [\"-200 mm\", \"-40 mm\", \"420 mm\"]\n\
         quaternion = [0.988771078, 0, 0, -0.149438132]\n[placement]\n\
         position = [\"40 mm\", \"-25 mm\", \"15 mm\"]\nquaternion = [0, 1, 0, 0]\n"
    );
    let map = Map::parse("map.toml", &text, &machine.spec).unwrap();
    let study = Study::find(None, &machine).unwrap();
    let choice =
        Choice::Optimal { criterion: abbe::identify::Criterion::Variance, count: 10, candidates: 1000 };
    let plan =
        Plan { machine: machine.clone(), map: map.clone(), study, choice, model_error: 0.0, seed: None };
    assert_eq!(plan.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}")).rows, 10);
    let at = Places::Samples(12);
    let simulate =
        Simulate { machine: machine.clone(), map, at, noise: None, outliers: 0.0, random: false, seed: 1 };
    let observations = simulate.run(&mut ()).unwrap_or_else(|mistake| panic!("{mistake}")).observations;
    assert_eq!(observations.len(), 12);
    // Vertical axes show only the sum of the heights of camera and machine: what the map says of
    // the one is taken from the other. What is left changes by the prior of the stated place alone.
    let data = Data { file: "views".to_owned(), observations, ..Data::default() };
    let found = ["15 mm", "25 mm"].map(|height| {
        let map = Map::parse("map.toml", &text.replace("15 mm", height), &machine.spec).unwrap();
        let report =
            Identify { machine: machine.clone(), ..job(&map, data.clone(), None) }.run(&mut ()).unwrap();
        let note =
            report.notes.iter().find(|note| note.contains("z of the measured frame on the tool is held"));
        assert!(note.is_some_and(|note| note.contains("only its sum")), "{:?}", report.notes);
        (report.placed.stations[0].pose[2][3], report.cross_validation.after.mean)
    });
    let [(low, left), (high, left_of_other)] = found;
    assert!(((high - low).abs() - 10.0).abs() < 0.01, "{low} {high}");
    assert!((left - left_of_other).abs() < 0.01 * left, "{left} {left_of_other}");
}

/// Returns the mistake that an identification reports.
fn refused(map: &str, data: &str) -> String {
    let map = parsed(map);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("views.csv");
    std::fs::write(&path, data).unwrap();
    match Data::read(&path, &map) {
        Ok(data) => {
            job(&map, data, None).run(&mut ()).map(|_| String::new()).unwrap_or_else(|m| m.to_string())
        }
        Err(mistake) => mistake.to_string(),
    }
}

/// Wrong boards, mounts and joints are named, with what fits instead.
#[test]
fn mistakes_of_a_camera_are_named() {
    let truth = parsed(&map_text("tool", "0.2", "known", places("tool")));
    let table = simulation(&truth, 20, 4).table.csv();
    let map = map_text("tool", "0.2", "known", "");
    for (from, to, expected) in [
        ("board = [9, 6]", "board = [6, 9]", "write `board = [9, 6]`"),
        ("board = [9, 6]", "board = [8, 6]", "check the order of the corners"),
        ("mount = \"tool\"", "mount = \"room\"", "is the camera on the tool? write `mount = \"tool\"`"),
        (
            "q3 = { column = \"j3\", unit = \"deg\"",
            "q3 = { column = \"j3\", sign = -1, unit = \"deg\"",
            "does `q3` count in the opposite direction?",
        ),
        ("board = [9, 6]", "board = [10, 6]", "columns of the map are missing"),
    ] {
        assert!(map.contains(from));
        let mistake = refused(&map.replace(from, to), &table);
        assert!(mistake.contains(expected), "{to}: {mistake}");
    }
    // A view is not used with a corner outside the image, with three corners, or with half a pixel.
    let (heading, rows) = table.split_once('\n').unwrap();
    let row = rows.lines().next().unwrap();
    let with = |cells: &dyn Fn(usize, &str) -> String| {
        let cells: Vec<String> = row.split(',').enumerate().map(|(i, cell)| cells(i, cell)).collect();
        cells.join(",")
    };
    let outside = with(&|i, cell| if i == 6 { "700".to_owned() } else { cell.to_owned() });
    let three = with(&|i, cell| if i < 12 { cell.to_owned() } else { String::new() });
    let half = with(&|i, cell| if i == 7 { String::new() } else { cell.to_owned() });
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("views.csv");
    std::fs::write(&path, format!("{heading}\n{rows}{outside}\n{three}\n{half}\n")).unwrap();
    let data = Data::read(&path, &truth).unwrap();
    let reasons: Vec<&str> = data.unusable.iter().map(|row| row.reason.as_str()).collect();
    assert_eq!(data.observations.len(), 20);
    let expected = [
        "outside the image of 640 × 480 px",
        "3 corners in this view",
        "only one of the two pixels of corner 1",
    ];
    assert!(reasons.iter().zip(expected).all(|(reason, part)| reason.contains(part)), "{reasons:?}");
    assert_eq!(reasons.len(), expected.len());
}
