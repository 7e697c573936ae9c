//! Tests: derivatives against finite differences, ranks against theory, statistics and designs
//! against Monte Carlo.

mod blocks;
mod coverage;
mod derivatives;
mod designs;
mod ranks;
mod sessions;
mod statistics;

use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;

use super::*;
use abbe_analysis::{Workspace, joint_samples};
use abbe_core::{Manipulator, Pose};

const EXACT: Uncertainty = Uncertainty { length: 1.0, angle: 1.0 };
const TARGETS: [[f64; 3]; 3] = [[-200.0, 10.0, 150.0], [250.0, 0.0, -100.0], [30.0, 40.0, 300.0]];

fn observation(q: &[f64], points: usize) -> Observation {
    numbered(1, q, points)
}

fn numbered(line: u64, q: &[f64], points: usize) -> Observation {
    let measured = match points {
        0 => Measurement::Pose(Box::new(Pose::IDENTITY)),
        _ => Measurement::Points(vec![Some([0.0; 3]); points].into()),
    };
    Observation::new(line, q, Vec::new(), measured)
}

/// Returns samples of the joints in `moved`.
fn sampled(robot: &dyn Manipulator, moved: &[usize], count: usize, points: usize) -> Vec<Observation> {
    let samples = joint_samples(robot, moved, count).unwrap().reached();
    samples.iter().zip(1..).map(|(sample, line)| numbered(line, &sample.q, points)).collect()
}

/// Returns nonzero values of all unknowns, including base, targets and tool.
fn disturbed(model: &Model) -> Vec<f64> {
    let value = |(k, unknown): (usize, &Unknown)| {
        let size = match unknown {
            Unknown::Base(_, component) | Unknown::Error(_, component) | Unknown::Tool(_, component) => {
                if component.is_rotation() {
                    0.02
                } else {
                    5.0
                }
            }
            Unknown::Target(..) | Unknown::Zero(_) => 3.0,
            Unknown::Intrinsic(parameter) => {
                if Camera::is_pixel(*parameter) {
                    5.0
                } else {
                    0.01
                }
            }
            Unknown::Fixture(fixture, _) => match model.fixtures[*fixture].geometry {
                FixtureGeometry::Point(_) => 20.0,
                FixtureGeometry::Direction(_) => 0.3,
            },
            Unknown::Magnitude(_) => 2.0,
        };
        size * (1.0 + k as f64 * 2.3).sin()
    };
    model.unknowns.iter().enumerate().map(value).collect()
}

fn residuals(model: &Model, observation: &Observation, x: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let (mut values, mut rows) = (Vec::new(), Vec::new());
    let take = |residual: f64, row: &[f64]| {
        values.push(residual);
        rows.push(row.to_vec());
    };
    model.at(x).linear(observation, take).unwrap();
    (values, rows)
}

/// Simulates measurements of a machine with errors `x` and noise.
fn measured(
    model: &Model,
    x: &[f64],
    list: &[Observation],
    noise: f64,
    random: &mut Xoshiro256PlusPlus,
) -> Vec<Observation> {
    let normal = rand_distr::Normal::new(0.0, noise).unwrap();
    let mut at = model.at(x);
    let see = |planned: &Observation| {
        let pose = at.pose(planned).unwrap();
        let point = |target: &[f64; 3]| {
            let at = pose.apply(*target);
            Some(at.map(|coordinate| coordinate + random.sample(normal)))
        };
        Observation {
            measured: Measurement::Points(model.targets.iter().map(point).collect()),
            ..planned.clone()
        }
    };
    list.iter().map(see).collect()
}
