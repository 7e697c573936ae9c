//! Comparison with public measurements of UR5 and WAM: the nominal models reproduce the commanded
//! points; errors identified from the grid set predict the random set.

use abbe::Manipulator;
use abbe::identify::{
    Figures, Folds, Measurement, Model, Observation, Options, Uncertainty, Unknown, cross_validate, fit,
    groups,
};
use abbe_manipulators::{ur5, wam};
use abbe_tests::needs::{Missing, Tests, measured_data};

const UR5: [&str; 2] = ["3D_UR5_uncalibrated_grid_cleaned.csv", "3D_UR5_uncalibrated_random_cleaned.csv"];
const WAM: [&str; 2] = ["3D_WAM_uncalibrated_grid_cleaned.csv", "3D_WAM_uncalibrated_random_cleaned.csv"];

pub(crate) const TESTS: Tests = &[
    ("nominal_models_reproduce_the_commanded_points", commanded_points),
    ("ur5_is_identified", identify_ur5),
    ("wam_is_identified", identify_wam),
    ("halves_of_a_grid_differ_as_they_say", halves),
];

/// Returns the rows of a file: number, commanded point, commanded minus measured point (mm), joints
/// (deg).
fn rows(file: &str) -> Result<Vec<Vec<f64>>, Missing> {
    let mut reader = csv::Reader::from_path(measured_data(file)?).unwrap();
    let records = reader.records();
    Ok(records.map(|record| record.unwrap().iter().map(|field| field.parse().unwrap()).collect()).collect())
}

/// Returns the joints of a row, in rad.
fn joints(row: &[f64]) -> Vec<f64> {
    row[7..].iter().map(|degrees| degrees.to_radians()).collect()
}

fn commanded_points() -> Result<(), Missing> {
    let robots: [(_, &dyn Manipulator, &[f64]); 2] = [
        (UR5, &ur5::Ur5, &ur5::Parameters::NOMINAL.to_array()),
        (WAM, &wam::Wam, &wam::Parameters::NOMINAL.to_array()),
    ];
    for (files, robot, s) in robots {
        for file in files {
            for row in rows(file)? {
                let point = robot.pose(&joints(&row), s).unwrap().position();
                let distance = point.iter().zip(&row[1..4]).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                // The data's own description states 0.003 mm, rounded to that digit.
                assert!(distance < 0.0036, "{file}, row {}: {distance:.4} mm", row[0]);
            }
        }
    }
    Ok(())
}

/// Returns the observations: measured point = target − difference.
fn observations(file: &str) -> Result<Vec<Observation>, Missing> {
    let observation = |(line, row): (u64, &Vec<f64>)| {
        let point = std::array::from_fn(|i| row[1 + i] - row[4 + i]);
        Observation::new(line, joints(row), Vec::new(), Measurement::Points(vec![Some(point)].into()))
    };
    Ok((2..).zip(&rows(file)?).map(observation).collect())
}

fn figures(model: &Model, data: &[Observation], x: &[f64]) -> Figures {
    model.figures(data, x).unwrap()
}

/// Returns the values of one model's unknowns in the order of another's.
fn embedded(from: &Model, x: &[f64], to: &Model) -> Vec<f64> {
    let value = |unknown| from.unknowns.iter().position(|u| u == unknown).map_or(0.0, |k| x[k]);
    to.unknowns.iter().map(value).collect()
}

/// Result of an identification: rank, and distances on the random set as delivered, with base and
/// tool fitted, and with all constants.
struct Identified {
    rank: usize,
    before: Figures,
    base_and_tool: Figures,
    after: Figures,
}

fn identified(robot: &dyn Manipulator, [grid, random]: [&str; 2]) -> Result<Identified, Missing> {
    let (grid, random) = (observations(grid)?, observations(random)?);
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
    let crossed = cross_validate(&model, &grid, &all, &Folds::new(&grid, 10)).unwrap().figures();
    let fitted = figures(&model, &grid, &all.x);
    assert!(fitted.mean < crossed.mean, "{fitted:?} {crossed:?}: rows left out are not seen");
    let moved: Vec<usize> = (0..robot.description().variables.len()).collect();
    let grouped = groups(&model, &grid[0].q, &moved, false).unwrap().len();
    assert_eq!(
        grouped + all.identifiable.rank + all.identifiable.weak.len(),
        model.unknowns.len(),
        "the twists explain all that is not known"
    );
    Ok(Identified {
        rank: all.identifiable.rank,
        before: figures(&ideal, &random, &[]),
        base_and_tool: figures(&simple, &random, &simple_fit.x),
        after: figures(&model, &random, &all.x),
    })
}

/// Compares machines identified from the even and from the odd rows of the grid: the distance of
/// their tools at the random configurations, relative to their stated uncertainties. These include
/// model errors, and 27 unknowns are common to all points.
fn halves() -> Result<(), Missing> {
    let (grid, random) = (observations(UR5[0])?, observations(UR5[1])?);
    let ideal = Model::ideal(&ur5::Ur5, vec![[0.0; 3]], Uncertainty { length: 0.02, angle: 1.0 });
    let model = ideal.with(ideal.constants(false));
    let half = |first: usize| {
        let rows: Vec<Observation> = grid.iter().skip(first).step_by(2).cloned().collect();
        // As `identify` does: the data choose the scale of errors of frames.
        let is_error = |k: &usize| matches!(model.unknowns[*k], Unknown::Error(..));
        let scaled = (0..model.unknowns.len()).filter(is_error).collect();
        let options = Options { priors: model.priors(1e-3).unwrap(), scaled, ..Options::default() };
        let found = fit(&model, &rows, &options).unwrap();
        // The tool point is the target where it was found.
        let found_target = Model { targets: vec![target(&model, &found.x)], ..model.clone() };
        let points = found_target.tool_points(&random).unwrap();
        let deviations = points.deviations(&found.identifiable, &found.covariance);
        (found.x, deviations)
    };
    let ((x, own), (y, other)) = (half(0), half(1));
    let mut squares = 0.0;
    for (row, (a, b)) in random.iter().zip(own.iter().zip(&other)) {
        let [p, q] = [&x, &y].map(|x| model.at(x).pose(row).unwrap().apply(target(&model, x)));
        let apart = p.iter().zip(q).map(|(p, q)| (p - q).powi(2)).sum::<f64>();
        squares += apart / (a * a + b * b);
    }
    let z = (squares / random.len() as f64).sqrt();
    println!("halves of the grid: z of tool points {z:.3}");
    // Both halves cover the grid and share model errors: the ratio is below 1.
    assert!((0.5..=1.25).contains(&z), "{z}");
    Ok(())
}

/// Returns the position of the target in the tool frame.
fn target(model: &Model, x: &[f64]) -> [f64; 3] {
    let mut at = model.targets[0];
    for (unknown, value) in model.unknowns.iter().zip(x) {
        if let Unknown::Target(0, axis) = unknown {
            at[*axis] += value;
        }
    }
    at
}

fn identify_ur5() -> Result<(), Missing> {
    let Identified { rank, before, base_and_tool, after } = identified(&ur5::Ur5, UR5)?;
    // Two more are weakly determined.
    assert_eq!(rank, 25);
    assert!((before.mean - 2.565).abs() < 0.0005 && (before.max - 3.379).abs() < 0.0005);
    assert!((base_and_tool.mean - 0.488).abs() < 0.001);
    assert!(after.mean <= 0.102 && after.max <= 0.160);
    Ok(())
}

fn identify_wam() -> Result<(), Missing> {
    let Identified { rank, before, base_and_tool, after } = identified(&wam::Wam, WAM)?;
    assert_eq!(rank, 31);
    assert!((before.mean - 17.63).abs() < 0.01 && (base_and_tool.mean - 4.06).abs() < 0.005);
    assert!(after.mean <= 3.10);
    Ok(())
}
