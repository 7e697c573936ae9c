//! Identification on measurements that others made: fitted on the grid set, judged on the random set.

use std::path::{Path, PathBuf};

use abbe::Manipulator;
use abbe::identify::{Figures, Model, Observation, Options, Seen, Uncertainty, cross_validate, fit, groups};
use abbe_manipulators::{ur5, wam};

fn data(file: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/ur5_wam_jacobi").join(file);
    if !path.exists() {
        println!("skipped: {file} is not here");
        return None;
    }
    Some(path)
}

/// Measured point = target − difference.
fn read(file: &str) -> Option<Vec<Observation>> {
    let mut reader = csv::Reader::from_path(data(file)?).unwrap();
    let rows = reader.records().map(|record| {
        let numbers: Vec<f64> = record.unwrap().iter().map(|field| field.parse().unwrap()).collect();
        let point = std::array::from_fn(|i| numbers[1 + i] - numbers[4 + i]);
        let q = numbers[7..].iter().map(|degrees| degrees.to_radians()).collect();
        Observation { q, u: Vec::new(), seen: Seen::Points(vec![Some(point)]) }
    });
    Some(rows.collect())
}

fn figures(model: &Model, data: &[Observation], x: &[f64]) -> Figures {
    let mut room = model.room();
    let norms = data.iter().flat_map(|row| model.deviations(&mut room, row, x).unwrap());
    Figures::of(norms.map(|d| d.iter().map(|v| v * v).sum::<f64>().sqrt()).collect())
}

/// The values of one model's unknowns in the order of another's.
fn embedded(from: &Model, x: &[f64], to: &Model) -> Vec<f64> {
    let value = |unknown| from.unknowns.iter().position(|u| u == unknown).map_or(0.0, |k| x[k]);
    to.unknowns.iter().map(value).collect()
}

struct Found {
    rank: usize,
    before: Figures,
    base_and_tool: Figures,
    after: Figures,
}

fn identified(robot: &dyn Manipulator, grid: &str, random: &str) -> Option<Found> {
    let (grid, random) = (read(grid)?, read(random)?);
    let ideal = Model::ideal(robot, vec![[0.0; 3]], Uncertainty { length: 0.02, angle: 1.0 });
    let simple = ideal.with(ideal.base_and_tool(false));
    let simple_fit = fit(&simple, &grid, &Options::default()).unwrap();
    let model = ideal.with(ideal.constants(false));
    let options = Options {
        at: embedded(&simple, &simple_fit.x, &model),
        priors: model.priors(0.01).unwrap(),
        ..Options::default()
    };
    let all = fit(&model, &grid, &options).unwrap();
    let crossed = cross_validate(&model, &grid, &all, 10).unwrap();
    println!("fit {:?}\ncv {crossed:?}", figures(&model, &grid, &all.x));
    let moved: Vec<usize> = (0..robot.description().variables.len()).collect();
    let grouped = groups(&model, &grid[0].q, &moved, false).unwrap().len();
    assert_eq!(grouped + all.known.rank, model.unknowns.len(), "the twists explain all that is not known");
    Some(Found {
        rank: all.known.rank,
        before: figures(&ideal, &random, &[]),
        base_and_tool: figures(&simple, &random, &simple_fit.x),
        after: figures(&model, &random, &all.x),
    })
}

#[test]
fn ur5() {
    let files = ["3D_UR5_uncalibrated_grid_cleaned.csv", "3D_UR5_uncalibrated_random_cleaned.csv"];
    let Some(found) = identified(&ur5::Ur5, files[0], files[1]) else { return };
    println!("{:?}\n{:?}\n{:?}", found.before, found.base_and_tool, found.after);
    assert_eq!(found.rank, 27);
    assert!((found.before.mean - 2.565).abs() < 0.0005 && (found.before.max - 3.379).abs() < 0.0005);
    assert!((found.base_and_tool.mean - 0.488).abs() < 0.001);
    assert!(found.after.mean <= 0.102 && found.after.max <= 0.160);
}

#[test]
fn wam() {
    let files = ["3D_WAM_uncalibrated_grid_cleaned.csv", "3D_WAM_uncalibrated_random_cleaned.csv"];
    let Some(found) = identified(&wam::Wam, files[0], files[1]) else { return };
    println!("{:?}\n{:?}\n{:?}", found.before, found.base_and_tool, found.after);
    assert_eq!(found.rank, 31);
    assert!((found.before.mean - 17.63).abs() < 0.01);
    assert!(found.after.mean <= 3.10);
}
