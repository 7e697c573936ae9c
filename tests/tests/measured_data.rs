//! Against measurements that others made: UR5 and WAM, if the data folder stands beside the repository.

use std::path::{Path, PathBuf};

use abbe::Manipulator;
use abbe_manipulators::{ur5, wam};

fn data(file: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/ur5_wam_jacobi").join(file);
    if !path.exists() {
        println!("skipped: {file} is not here");
        return None;
    }
    Some(path)
}

/// The largest distance between the commanded point and the nominal pose at the commanded joints, mm.
fn worst(file: &str, robot: &dyn Manipulator, s: &[f64]) -> Option<f64> {
    let mut reader = csv::Reader::from_path(data(file)?).unwrap();
    let joints = robot.description().variables.len();
    let mut worst: f64 = 0.0;
    for record in reader.records() {
        let numbers: Vec<f64> = record.unwrap().iter().map(|field| field.parse().unwrap()).collect();
        let q: Vec<f64> = numbers[7..7 + joints].iter().map(|degrees| degrees.to_radians()).collect();
        let point = robot.pose(&q, s).unwrap().position();
        let distance = point.iter().zip(&numbers[1..4]).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        worst = worst.max(distance);
    }
    println!("{file}: {worst:.4} mm");
    Some(worst)
}

#[test]
fn nominal_models_reproduce_the_commanded_points() {
    let files: [(&str, &dyn Manipulator, &[f64]); 4] = [
        ("3D_UR5_uncalibrated_grid_cleaned.csv", &ur5::Ur5, &ur5::Parameters::NOMINAL.to_array()),
        ("3D_UR5_uncalibrated_random_cleaned.csv", &ur5::Ur5, &ur5::Parameters::NOMINAL.to_array()),
        ("3D_WAM_uncalibrated_grid_cleaned.csv", &wam::Wam, &wam::Parameters::NOMINAL.to_array()),
        ("3D_WAM_uncalibrated_random_cleaned.csv", &wam::Wam, &wam::Parameters::NOMINAL.to_array()),
    ];
    for (file, robot, s) in files {
        // The data's own description says 0.003 mm, to that digit.
        assert!(worst(file, robot, s).is_none_or(|worst| worst < 0.0036), "{file}");
    }
}
