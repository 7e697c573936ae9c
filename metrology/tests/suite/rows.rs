//! Rows that do not say what the map says of them: each cause is named with its lines, and none
//! where there is none.

use abbe::analysis::sampling;
use abbe::identify::{Loss, Measurement};
use abbe::{Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_metrology::Acceptance;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::identify::{Identify, Prior, Report, Settings};
use abbe_metrology::measure::Measure;
use abbe_metrology::simulate::{Places, Simulate};

use nalgebra::{Matrix3, Vector3};

use super::simulated_ur5::{joints, ur5, ur5_with};

/// Number of rows.
const ROWS: usize = 60;

/// Returns a map for one target or three, in mm; `known` says whether base and target are fitted.
fn map(known: bool, targets: &[[f64; 3]]) -> Map {
    map_with("", known, targets)
}

/// Returns that map with further keys of `[data]`.
fn map_with(keys: &str, known: bool, targets: &[[f64; 3]]) -> Map {
    let (joints, places) = (joints(), if known { "exact" } else { "unknown" });
    let place = |[x, y, z]: &[f64; 3]| format!("[{x}, {y}, {z}]");
    let all = targets.iter().map(place).collect::<Vec<_>>().join(", ");
    let columns = |i: usize| format!("columns = [\"x{i}\", \"y{i}\", \"z{i}\"]\nunit = \"mm\"\n");
    let columns: String = match targets.len() {
        1 => format!("[point]\n{}", columns(0)),
        count => (0..count)
            .map(|i| format!("[[target]]\nposition = {}\n{}", place(&targets[i]), columns(i)))
            .collect(),
    };
    let is_per_station = keys.contains("per station");
    let stated = match (targets.len(), is_per_station) {
        (1, false) => format!("[placement]\ntargets = [{all}]\n"),
        (1, true) => ["before", "after"]
            .map(|name| format!("[[placement]]\nstation = \"{name}\"\ntargets = [{all}]\n"))
            .concat(),
        _ => String::new(),
    };
    let placement = if is_per_station { String::new() } else { format!("placement = \"{places}\"\n") };
    let text = format!(
        "[data]\nuncertainty = \"0.02 mm\"\nbase = \"{places}\"\n{placement}{keys}\n[joints]\n{joints}\n\
         {columns}{stated}"
    );
    Map::parse("map.toml", &text, &ur5().spec).unwrap()
}

/// Simulates the rows of a machine with errors of its own, and gears that no model has.
fn simulated(targets: &[[f64; 3]], seed: u64) -> Data {
    let size = |k: u64| ((seed * 31 + k * 17) % 13) as f64 / 6.0 - 1.0;
    let errors: String = ["base", "shoulder", "elbow", "wrist 1", "wrist 2"]
        .iter()
        .zip(1..)
        .map(|(frame, k)| {
            format!(
                "[[source]]\nname = \"of {frame}\"\nclass = \"repeatable\"\nframe = \"{frame}\"\n\
                 e_x = \"{} mm\"\ne_s = \"{} mrad\"\ne_p = \"{} mrad + 0.03 mrad * sin(2*q{k})\"\n",
                0.4 * size(k),
                0.6 * size(k + 5),
                0.8 * size(k + 9)
            )
        })
        .collect();
    let job = Simulate {
        machine: ur5_with(&errors),
        map: map(true, targets),
        at: Places::Samples(ROWS),
        noise: None,
        outliers: 0.0,
        random: false,
        seed,
    };
    let observations = job.run(&mut ()).unwrap().observations;
    Data { file: "simulated".to_owned(), observations, stations: vec![String::new()], ..Data::default() }
}

fn points(data: &mut Data, row: usize) -> &mut [Option<[f64; 3]>] {
    match &mut data.observations[row].measured {
        Measurement::Points(points) => points,
        _ => unreachable!("points are measured"),
    }
}

/// Moves all points of rows, as if the instrument stood elsewhere.
fn move_instrument(data: &mut Data, rows: impl Iterator<Item = usize>, by: f64) {
    let (sine, cosine) = (1e-4 * by).sin_cos();
    let moved = Pose([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0], [by, -0.7 * by, 0.4 * by]]);
    for row in rows {
        points(data, row).iter_mut().flatten().for_each(|point| *point = moved.apply(*point));
    }
}

fn notes_of_identify(data: Data, targets: &[[f64; 3]]) -> Vec<String> {
    identify(map(false, targets), data).notes
}

fn measure(data: Data, targets: &[[f64; 3]]) -> Measure {
    Measure { machine: ur5(), map: map(true, targets), data, accept: Acceptance::default() }
}

fn notes_of_measure(data: Data, targets: &[[f64; 3]]) -> Vec<String> {
    measure(data, targets).run(&mut ()).unwrap().notes
}

fn identify(map: Map, data: Data) -> Report {
    let settings = Settings {
        loss: Loss::Squares,
        prior: Prior::default(),
        folds: 5,
        time: None,
        points: false,
        only_placement: false,
    };
    let (terms, harmonics, accept) = (Vec::new(), Vec::new(), Acceptance::default());
    let job = Identify { machine: ur5(), map, data, test: None, terms, harmonics, settings, accept };
    job.run(&mut ()).unwrap()
}

/// Returns the only note with these words.
fn note<'n>(notes: &'n [String], words: &str) -> &'n str {
    let found: Vec<&String> = notes.iter().filter(|note| note.contains(words)).collect();
    assert_eq!(found.len(), 1, "{words}: {notes:?}");
    found[0]
}

const ONE: &[[f64; 3]] = &[[90.0, -35.0, 60.0]];
const THREE: &[[f64; 3]] = &[[90.0, -35.0, 60.0], [-60.0, 40.0, 50.0], [10.0, 70.0, 20.0]];

#[test]
fn a_moved_instrument_is_named_with_its_line() {
    for seed in 0..10 {
        let (targets, from) = ([ONE, THREE][seed as usize % 2], 8 + 5 * seed as usize);
        let mut data = simulated(targets, seed);
        let line = data.observations[from].line;
        move_instrument(&mut data, from..ROWS, 0.5 + 0.2 * seed as f64);
        let notes = notes_of_identify(data.clone(), targets);
        let said = note(&notes, "was the instrument moved");
        assert!(said.contains(&format!("from row {line} on, F_0")), "{seed} {line}: {said}");
        // Obeyed, nothing of the motion is left.
        data.observations[from..].iter_mut().for_each(|row| row.station = 1);
        data.stations = vec!["before".to_owned(), "after".to_owned()];
        let obeyed = identify(map_with("station = \"that column\"\n", false, targets), data);
        assert!(!obeyed.notes.iter().any(|note| note.contains("elsewhere")), "{seed}: {:?}", obeyed.notes);
        let alone = identify(map(false, targets), simulated(targets, seed));
        let [left, least] = [obeyed, alone].map(|report| report.fit.after.rms);
        assert!(left < 1.1 * least, "{seed}: {left} {least}");
    }
}

#[test]
fn a_target_that_slips_is_named_with_its_line() {
    for seed in 0..10 {
        let (targets, from) = ([ONE, THREE][seed as usize % 2], 8 + 5 * seed as usize);
        let slips = seed as usize / 2 % targets.len();
        let mut elsewhere = targets.to_vec();
        let by = 0.4 + 0.2 * seed as f64;
        (0..3).for_each(|axis| elsewhere[slips][axis] += by * [0.6, -0.64, 0.48][axis]);
        let (mut data, mut after) = (simulated(targets, seed), simulated(&elsewhere, seed));
        let line = data.observations[from].line;
        (from..ROWS).for_each(|row| points(&mut data, row)[slips] = points(&mut after, row)[slips]);
        let notes = notes_of_identify(data.clone(), targets);
        let said = note(&notes, "did it slip");
        let name = if targets.len() == 1 { "the target".to_owned() } else { format!("target {}", slips + 1) };
        assert!(said.contains(&format!("from row {line} on, {name} is")), "{seed} {line}: {said}");
        // Obeyed, nothing of it is left.
        data.observations[from..].iter_mut().for_each(|row| row.station = 1);
        data.stations = vec!["before".to_owned(), "after".to_owned()];
        let keys = "station = \"that column\"\nplacement = \"per station\"\n";
        let obeyed = identify(map_with(keys, false, targets), data);
        assert!(!obeyed.notes.iter().any(|note| note.contains("elsewhere")), "{seed}: {:?}", obeyed.notes);
    }
}

/// A machine that warms up, an instrument that creeps, and a target that sags have moved at no row:
/// the order of the rows tells of a drift instead.
#[test]
fn what_drifts_has_not_moved() {
    let shapes: [fn(f64) -> f64; 3] = [|t| t, |t| (-t / 0.1).exp(), |t| (-t / 0.3).exp()];
    let (mut drifts, mut all) = (0, 0);
    for (i, shape) in shapes.iter().enumerate() {
        for (k, size) in [0.1, 0.15, 0.2, 0.3, 0.5, 1.0, 3.0].into_iter().enumerate() {
            for seed in 0..4 {
                let targets = [ONE, THREE][(i + k + seed as usize) % 2];
                let mut data = simulated(targets, seed);
                for row in 0..ROWS {
                    let by = size * shape(row as f64 / ROWS as f64);
                    points(&mut data, row).iter_mut().flatten().for_each(|point| point[0] += by);
                }
                let report = identify(map(false, targets), data);
                let said = report.notes.iter().any(|note| note.contains("elsewhere"));
                assert!(!said, "{i} {size} {seed}: {:?}", report.notes);
                let drift = report.drift.unwrap();
                (drifts, all) =
                    (drifts + usize::from(drift.is_drift && size > 0.3), all + usize::from(size > 0.3));
            }
        }
    }
    assert!(drifts * 10 >= all * 9, "{drifts} of {all}");
}

/// A single gross error, near an end or not, moves nothing.
#[test]
fn single_gross_errors_have_moved_nothing() {
    for (seed, row) in [0, 1, 2, 3, 30, 56, 57, 58, 59].into_iter().enumerate() {
        let targets = [ONE, THREE][seed % 2];
        let mut data = simulated(targets, seed as u64);
        for size in [1.0, 50.0] {
            points(&mut data, row)[0].as_mut().unwrap()[1] += size;
            let notes = notes_of_identify(data.clone(), targets);
            assert!(!notes.iter().any(|note| note.contains("elsewhere")), "{row} {size}: {notes:?}");
        }
    }
}

/// Rows that turn about the target move it by nothing, and the machine nevertheless.
#[test]
fn rows_about_a_target_do_not_stand_still() {
    let mut data = simulated(ONE, 2);
    let robot = Interpreter::new(ur5().spec);
    let s = sampling::nominal_parameters(robot.description());
    let mut q = data.observations[7].q.to_vec();
    let target = |q: &[f64]| robot.pose(q, &s).unwrap().apply(ONE[0]);
    let at = target(&q);
    for (k, row) in data.observations.iter_mut().take(20).enumerate() {
        // The wrist turns, and the arm brings the target back: Newton's method on three joints.
        (3..6).for_each(|joint| q[joint] += 0.3 + 0.1 * (k % 3) as f64);
        for _ in 0..30 {
            let here = target(&q);
            let derivatives = Matrix3::from_fn(|axis, joint| {
                let mut moved = q.clone();
                moved[joint] += 1e-6;
                (target(&moved)[axis] - here[axis]) / 1e-6
            });
            let off = Vector3::from_fn(|axis, _| at[axis] - here[axis]);
            let step = derivatives.lu().solve(&off).unwrap();
            (0..3).for_each(|joint| q[joint] += step[joint].clamp(-0.1, 0.1));
        }
        row.q = q.clone().into();
        row.measured = Measurement::Points(vec![Some(target(&q))].into());
    }
    let apart: Vec<f64> = (1..20)
        .map(|k| {
            let origin = |k: usize| robot.pose(&data.observations[k].q, &s).unwrap().position();
            sampling::norm(std::array::from_fn(|i| origin(k)[i] - origin(k - 1)[i]))
        })
        .collect();
    assert!(apart.iter().filter(|by| **by > 15.0).count() > 10, "{apart:?}");
    for notes in [notes_of_identify(data.clone(), ONE), notes_of_measure(data, ONE)] {
        assert!(!notes.iter().any(|note| note.contains("stood still")), "{notes:?}");
    }
}

/// Exact rows of an exact machine say nothing.
#[test]
fn exact_rows_say_nothing() {
    for targets in [ONE, THREE] {
        let at = Places::Samples(40);
        let (machine, map) = (ur5(), map(true, targets));
        let noise = Some(0.0);
        let job = Simulate { machine, map, at, noise, outliers: 0.0, random: false, seed: 5 };
        let observations = job.run(&mut ()).unwrap().observations;
        let data =
            Data { file: "exact".to_owned(), observations, stations: vec![String::new()], ..Data::default() };
        for notes in [notes_of_identify(data.clone(), targets), notes_of_measure(data, targets)] {
            assert!(
                !notes.iter().any(|note| note.contains("elsewhere") || note.contains("still")),
                "{notes:?}"
            );
        }
    }
}

#[test]
fn machines_that_their_model_lacks_have_moved_nothing() {
    for seed in 0..20 {
        let targets = [ONE, THREE][seed as usize % 2];
        let data = simulated(targets, seed);
        for notes in [notes_of_identify(data.clone(), targets), notes_of_measure(data, targets)] {
            assert!(!notes.iter().any(|note| note.contains("elsewhere")), "{seed}: {notes:?}");
        }
    }
}

#[test]
fn a_motion_of_all_rows_is_noticed() {
    for seed in 0..6 {
        let targets = [ONE, THREE][seed as usize % 2];
        let mut data = simulated(targets, seed);
        move_instrument(&mut data, 0..ROWS, 6.0 + seed as f64);
        let notes = notes_of_measure(data.clone(), targets);
        let said = note(&notes, "would explain");
        assert!(said.contains("F_0 elsewhere by") && said.contains("`base = \"unknown\"`"), "{said}");
        let obeyed = Measure { map: map(false, targets), ..measure(data, targets) }.run(&mut ()).unwrap();
        assert!(!obeyed.notes.iter().any(|note| note.contains("elsewhere")), "{seed}: {:?}", obeyed.notes);
    }
}

#[test]
fn another_tool_is_named() {
    let data = simulated(ONE, 4);
    let elsewhere = [[ONE[0][0] + 213.0, ONE[0][1], ONE[0][2]]];
    let notes = notes_of_identify(data.clone(), &elsewhere);
    assert!(note(&notes, "is it that of another tool").contains("the target comes out 21"), "{notes:?}");
    let notes = notes_of_measure(data, &elsewhere);
    assert!(note(&notes, "would explain").contains("the target elsewhere on the tool by 21"), "{notes:?}");
}

#[test]
fn rows_that_stand_still_are_named() {
    let mut data = simulated(THREE, 3);
    for row in [17, 40] {
        let last = points(&mut data, row - 1).to_vec();
        points(&mut data, row).copy_from_slice(&last);
    }
    let lines = [17, 40].map(|row| data.observations[row].line.to_string()).join(", ");
    for notes in [notes_of_identify(data.clone(), THREE), notes_of_measure(data, THREE)] {
        assert!(note(&notes, "stood still").contains(&format!("(lines {lines})")), "{notes:?}");
    }
}
