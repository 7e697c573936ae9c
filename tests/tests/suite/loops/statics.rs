//! Loads act through loops: errors and forces are those of a spring model with the least energy.

use std::fmt::Write;

use abbe::{Function, Manipulator, Pose, displacement};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::mechanisms::{Mechanism, is_regular};
use abbe_tests::sample_size;
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{assert_close, interpreter, mechanism, samples};

/// Compliances, in m/N, 1/N and 1/(N·m).
const SOFT: f64 = 2e-8;
const GRAVITY: [f64; 3] = [0.5, -1.0, 2.0];

/// A mechanism with springs. Its unknowns z are the passive variables, then one deflection per
/// spring variable.
struct SpringModel {
    mechanism: Mechanism,
    /// Compliance matrix of the springs, one block per elastic element.
    compliance: DMatrix<f64>,
    springs: Vec<Spring>,
    loads: Vec<Load>,
    tool: Option<usize>,
    passive: usize,
}

/// Unknown deflection.
#[derive(Clone, Copy, PartialEq)]
enum Spring {
    /// One of the six errors of a frame.
    Frame(usize, usize),
    /// The joint of a frame.
    Joint(usize),
    /// The length of a loop.
    Leg(usize),
}

/// Force and moment in the axes of `F_0`, at a point of a frame.
struct Load {
    frame: usize,
    point: [f64; 3],
    force: [f64; 3],
    moment: [f64; 3],
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Returns the vector of the antisymmetric part of `R_a R_bᵀ`.
fn turned(a: &Pose, b: &Pose) -> [f64; 3] {
    let entry = |i: usize, j: usize| (0..3).map(|k| a.0[k][i] * b.0[k][j]).sum::<f64>();
    [0, 1, 2].map(|i| 0.5 * (entry((i + 2) % 3, (i + 1) % 3) - entry((i + 1) % 3, (i + 2) % 3)))
}

impl SpringModel {
    /// Adds springs and loads to the text of a random mechanism; springs of legs only if their
    /// ends permit it.
    fn new(seed: u64) -> (Self, Interpreter) {
        let with_legs = Self::build(seed, true);
        let (model, spec) = match with_legs {
            (model, Ok(spec)) => (model, spec),
            _ => {
                let (model, spec) = Self::build(seed, false);
                (model, spec.unwrap_or_else(|mistakes| panic!("{mistakes}")))
            }
        };
        (Self { tool: Some(spec.tool_frame), ..model }, Interpreter::new(spec))
    }

    fn build(seed: u64, with_legs: bool) -> (Self, Result<Spec, abbe_spec::diagnostic::Diagnostics>) {
        let mechanism = Mechanism::new(seed);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1000 + seed);
        let mut number = || (random.random_range(-1000..=1000) as f64) / 1000.0;
        let gravity = GRAVITY.map(|component| format!("\"{component} m/s^2\"")).join(", ");
        let mut text =
            mechanism.text.replacen("[manipulator]", &format!("[manipulator]\ngravity = [{gravity}]"), 1);
        let (mut springs, mut blocks) = (Vec::new(), Vec::new());
        for frame in 0..mechanism.frames.len() {
            let kind = (number() * 1000.0).rem_euclid(4.0) as usize;
            match (kind, mechanism.frames[frame].joint) {
                (0, _) => {
                    let roots = DMatrix::from_fn(6, 6, |_, _| number());
                    let block = SOFT * (&roots * roots.transpose() + DMatrix::identity(6, 6));
                    let unit = |i: usize, j: usize| match (i < 3, j < 3) {
                        (true, true) => "m/N",
                        (false, false) => "1/(N*m)",
                        _ => "1/N",
                    };
                    let row = |i: usize| {
                        let entries = (0..6).map(|j| match unit(i, j).strip_prefix("1/") {
                            Some(below) => format!("\"{:?}/{below}\"", block[(i, j)]),
                            None => format!("\"{:?} {}\"", block[(i, j)], unit(i, j)),
                        });
                        format!("[{}]", entries.collect::<Vec<_>>().join(", "))
                    };
                    let rows = (0..6).map(row).collect::<Vec<_>>().join(", ");
                    let _ = write!(
                        text,
                        "[[source]]\nname = \"soft {frame}\"\nclass = \"repeatable\"\nframe = \"f{frame}\"\n\
                         compliance = {{ matrix = [{rows}] }}\n"
                    );
                    springs.extend((0..6).map(|i| Spring::Frame(frame, i)));
                    blocks.push(block);
                }
                (1, Some((motion, _, false))) => {
                    let stiffness = (1.5 + number()) / SOFT;
                    let unit = if motion < 3 { "N/m" } else { "N*m/rad" };
                    let joint = mechanism.frames[..frame].iter();
                    let joint = joint.filter(|frame| matches!(frame.joint, Some((.., false)))).count();
                    let _ = write!(
                        text,
                        "[[source]]\nname = \"gear {frame}\"\nclass = \"repeatable\"\njoint = \"q{joint}\"\n\
                         stiffness = \"{stiffness:?} {unit}\"\n"
                    );
                    springs.push(Spring::Joint(frame));
                    blocks.push(DMatrix::from_element(1, 1, 1.0 / stiffness));
                }
                _ => {}
            }
        }
        for (k, closed) in
            mechanism.loops.iter().enumerate().filter(|(_, closed)| closed.coordinates.is_empty())
        {
            if !with_legs {
                break;
            }
            let (stiffness, length) =
                ((1.5 + number()) / SOFT, format!("length = \"{:?} m\"\n", closed.length));
            let variable = format!(
                "length = \"{:?} m + d{k}\"\nvariable = {{ name = \"d{k}\", kind = \"prismatic\", limits = [-0.1, 0.1] }}\n",
                closed.length
            );
            text = text.replacen(&length, &variable, 1);
            let _ = write!(
                text,
                "[[source]]\nname = \"leg {k}\"\nclass = \"repeatable\"\njoint = \"d{k}\"\nstiffness = \"{stiffness:?} N/m\"\n"
            );
            springs.push(Spring::Leg(k));
            blocks.push(DMatrix::from_element(1, 1, 1.0 / stiffness));
        }
        let mut loads = Vec::new();
        for _ in 0..3 {
            let frame = (1000.0 * number()).rem_euclid(mechanism.frames.len() as f64) as usize;
            let [point, force, moment] = [0; 3].map(|_| [0; 3].map(|_| number()));
            let mass = 1.0 + number();
            let vector = |v: [f64; 3], unit: &str| v.map(|x| format!("\"{x} {unit}\"")).join(", ");
            let _ = write!(
                text,
                "[[load]]\nframe = \"f{frame}\"\nmass = \"{mass} kg\"\naxes = \"base\"\npoint = [{}]\nforce = [{}]\nmoment = [{}]\n",
                vector(point, "m"),
                vector(force, "N"),
                vector(moment, "N*m"),
            );
            let force = [0, 1, 2].map(|i| force[i] + mass * GRAVITY[i]);
            loads.push(Load { frame, point, force, moment });
        }
        let mut compliance = DMatrix::zeros(springs.len(), springs.len());
        let mut first = 0;
        for block in blocks {
            compliance.view_mut((first, first), block.shape()).copy_from(&block);
            first += block.nrows();
        }
        let passive = mechanism.frames.iter().filter(|frame| matches!(frame.joint, Some((.., true)))).count();
        let spec = Spec::parse("mechanism.toml", &text);
        (Self { mechanism, compliance, springs, loads, tool: None, passive }, spec)
    }

    /// Returns the poses of all frames, with the changes of the passive variables and the
    /// deflections of the springs.
    fn poses(&self, z: &[f64]) -> Vec<Pose> {
        let deflection = |spring: Spring| {
            self.springs.iter().position(|one| *one == spring).map_or(0.0, |i| z[self.passive + i])
        };
        let mut poses: Vec<Pose> = Vec::new();
        let mut passive = z.iter();
        for (i, frame) in self.mechanism.frames.iter().enumerate() {
            let mut pose = frame.parent.map_or(Pose::IDENTITY, |parent| poses[parent]);
            if let Some((motion, home, is_passive)) = frame.joint {
                let mut moved = [0.0; 6];
                let change = if is_passive { *passive.next().unwrap() } else { deflection(Spring::Joint(i)) };
                moved[motion] = home + change;
                pose = pose.then(&displacement(&moved));
            }
            let errors = std::array::from_fn(|k| deflection(Spring::Frame(i, k)));
            poses.push(pose.then(&frame.rest).then(&displacement(&errors)));
        }
        poses
    }

    /// Returns the equations of the loops.
    fn equations(&self, z: &[f64]) -> Vec<f64> {
        let poses = self.poses(z);
        let mut equations = Vec::new();
        for (k, closed) in self.mechanism.loops.iter().enumerate() {
            let [a, b] = closed.frames.map(|frame| poses[frame]);
            let difference = [0, 1, 2].map(|i| a.0[3][i] - b.0[3][i]);
            if closed.coordinates.is_empty() {
                let spring = self.springs.iter().position(|spring| *spring == Spring::Leg(k));
                let change = spring.map_or(0.0, |i| z[self.passive + i]);
                equations.push(dot(difference, difference).sqrt() - closed.length - change);
            }
            let axes = self.mechanism.frames[closed.frames[1]].parent.map_or(Pose::IDENTITY, |c| poses[c]);
            let turn = turned(&a, &b);
            equations.extend(closed.coordinates.iter().map(|coordinate| match *coordinate {
                along @ 0..3 => dot(axes.0[along], difference),
                about => dot(axes.0[about - 3], turn),
            }));
        }
        equations
    }

    /// Returns the work of the loads.
    fn work(&self, z: &[f64], home: &[Pose]) -> f64 {
        let poses = self.poses(z);
        let work = |load: &Load| {
            let pose = &poses[load.frame];
            dot(load.force, pose.apply(load.point)) + dot(load.moment, turned(pose, &home[load.frame]))
        };
        self.loads.iter().map(work).sum()
    }

    /// Minimizes `½ εᵀ C⁻¹ ε − W` under `φ = 0` by Newton's method on the conditions of a
    /// stationary point, and returns z and the multipliers of φ. `sign` is that of the loads.
    /// Returns `None` for a mechanism that is singular, or nearly so.
    fn minimum(&self, sign: f64) -> Option<(Vec<f64>, Vec<f64>)> {
        let (springs, equations) =
            (self.springs.len(), self.equations(&vec![0.0; self.passive + self.springs.len()]).len());
        let unknowns = self.passive + springs;
        let stiffness = self.compliance.clone().try_inverse().unwrap();
        let home = self.poses(&vec![0.0; unknowns]);
        let (mut z, mut multipliers) = (vec![0.0; unknowns], DVector::zeros(equations));
        for _ in 0..4 {
            let slopes: Vec<Vec<f64>> = (0..unknowns)
                .map(|i| {
                    slope(&z, i, |z| {
                        let mut all = self.equations(z);
                        all.push(sign * self.work(z, &home));
                        all
                    })
                })
                .collect();
            let rates = DMatrix::from_fn(equations, unknowns, |row, column| slopes[column][row]);
            if rates.columns(0, self.passive).singular_values().min() < 0.05 {
                return None;
            }
            let mut matrix = DMatrix::zeros(unknowns + equations, unknowns + equations);
            matrix.view_mut((self.passive, self.passive), (springs, springs)).copy_from(&(SOFT * &stiffness));
            matrix.view_mut((unknowns, 0), (equations, unknowns)).copy_from(&rates);
            matrix.view_mut((0, unknowns), (unknowns, equations)).copy_from(&-rates.transpose());
            let mut right = DVector::zeros(unknowns + equations);
            let deflections = DVector::from_column_slice(&z[self.passive..]);
            let energy = &stiffness * deflections;
            for i in 0..unknowns {
                let constraint: f64 = (0..equations).map(|k| rates[(k, i)] * multipliers[k]).sum();
                let elastic = if i < self.passive { 0.0 } else { energy[i - self.passive] };
                right[i] = slopes[i][equations] + constraint - elastic;
            }
            for (k, equation) in self.equations(&z).into_iter().enumerate() {
                right[unknowns + k] = -equation / SOFT;
            }
            // Displacements are in units of SOFT.
            let step = matrix.lu().solve(&right)?;
            z.iter_mut().zip(&step).for_each(|(z, step)| *z += SOFT * step);
            multipliers += step.rows(unknowns, equations);
        }
        Some((z, multipliers.iter().copied().collect()))
    }
}

/// Returns the derivatives of functions by one unknown, to sixth order in the step.
fn slope(z: &[f64], i: usize, functions: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let step = 0.02;
    let mut sum: Vec<f64> = Vec::new();
    for (distance, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
        for sign in [1.0, -1.0] {
            let mut at = z.to_vec();
            at[i] += sign * distance * step;
            let values = functions(&at);
            sum.resize(values.len(), 0.0);
            let factor = sign * weight / (60.0 * step);
            sum.iter_mut().zip(values).for_each(|(sum, value)| *sum += factor * value);
        }
    }
    sum
}

/// Displacement of the tool by the springs and the forces of the loops are those of the least
/// energy, in random mechanisms with one to three loops.
#[test]
fn loads_through_loops_minimize_energy() {
    let (mut elastic, mut legs, mut checked) = (0, 0, 0);
    for seed in 0.. {
        let (model, machine) = SpringModel::new(seed);
        if model.springs.is_empty() || !is_regular(&machine) {
            continue;
        }
        let home: Vec<f64> = machine.description().variables.iter().map(|variable| variable.home).collect();
        // Half of the difference by loads and opposite loads is without terms of second order.
        let [Some((z, pushed)), Some((opposite, pulled))] = [1.0, -1.0].map(|sign| model.minimum(sign))
        else {
            continue;
        };
        let multipliers: Vec<f64> = pushed.iter().zip(&pulled).map(|(a, b)| 0.5 * (a - b)).collect();
        let mut forces = vec![0.0; multipliers.len()];
        machine.leg_forces(&home, &[], &[], &mut forces).unwrap();
        let largest = multipliers.iter().fold(1.0, |largest: f64, force| largest.max(force.abs()));
        for (found, expected) in forces.iter().zip(&multipliers) {
            assert!((found - expected).abs() < 1e-6 * largest, "{seed}: {forces:?}, not {multipliers:?}");
        }
        let tool = |z: &[f64]| {
            let tool = displacement(&[0.2, 0.0, 0.0, 0.0, 0.3, 0.0])
                .then(&displacement(&[0.0, 0.1, 0.0, 0.0, 0.0, 0.0]));
            model.poses(z)[model.tool.unwrap()].then(&tool)
        };
        let (bent, back) = (tool(&z), tool(&opposite));
        let shift = [0, 1, 2].map(|i| bent.0[3][i] - back.0[3][i]);
        let expected = shift.into_iter().chain(turned(&bent, &back)).map(|twice| 0.5 * twice);
        let expected: Vec<f64> = expected.collect();
        let mut predicted = [0.0; 6];
        let mut columns = vec![[0.0; 6]; 6 * machine.description().frames.len()];
        let mut errors = vec![[0.0; 6]; machine.description().frames.len()];
        machine.error_jacobian(&home, &[], &mut columns).unwrap();
        machine.generalized_errors(&home, &[], &[], &mut errors).unwrap();
        for (column, error) in columns.iter().zip(errors.as_flattened()) {
            predicted.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * error);
        }
        let largest = expected.iter().fold(SOFT, |largest: f64, one| largest.max(one.abs()));
        for (found, wanted) in predicted.iter().zip(&expected) {
            assert!((found - wanted).abs() < 1e-6 * largest, "{seed}: {predicted:?}, not {expected:?}");
        }
        checked += 1;
        elastic += model.springs.len();
        legs += model.springs.iter().filter(|spring| matches!(spring, Spring::Leg(_))).count();
        if checked == 2 * sample_size(25).max(10) {
            break;
        }
    }
    assert!(elastic > 3 * checked && legs > 2, "{elastic} springs, {legs} legs of {checked} mechanisms");
}

/// The shipped couch on six legs of 20 N/µm, with 80 kg at 700 mm: forces and sag by hand.
///
/// With the directions u of the legs and their joints P on the platform, the forces f balance the
/// weight W at r, and the work of the weight is twice the energy of the legs:
///
/// ```text
/// Σ f u + W = 0        Σ f P × u + r × W = 0        W · δ = Σ f² / k
/// ```
#[test]
fn a_loaded_hexapod_balances() {
    let shipped = mechanism("hexapod");
    let mut spec = Spec::clone(shipped.spec());
    spec.sources.iter_mut().for_each(|source| source.enabled = source.name == "legs give way");
    let machine = Interpreter::new(spec);
    let (weight, stiffness) = (80.0 * 9.80665, 20e3);
    let (q, inputs) = ([0.0; 6], [2.0]);
    let s: Vec<f64> = machine.description().parameters.iter().map(|parameter| parameter.nominal).collect();
    let (mut forces, mut passive) = ([0.0; 6], [0.0; 6]);
    machine.leg_forces(&q, &s, &inputs, &mut forces).unwrap();
    machine.passive(&q, &s, &mut passive).unwrap();
    let circle = |radius: f64, degrees: f64| {
        [radius * degrees.to_radians().cos(), radius * degrees.to_radians().sin()]
    };
    let mut sum = [0.0, 0.0, -weight, -700.0 * weight, 0.0, 0.0];
    let on_base = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0];
    let on_platform = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0];
    for ((base, platform), force) in on_base.into_iter().zip(on_platform).zip(forces) {
        let ([bx, by], [px, py]) = (circle(600.0, base), circle(400.0, platform));
        let [x, y, z] = [px - bx, py - by, passive[2]].map(|entry| force * entry / 750.0);
        let moment = [py * z, -px * z, px * y - py * x];
        sum.iter_mut().zip([x, y, z].into_iter().chain(moment)).for_each(|(sum, part)| *sum += part);
    }
    assert_close(&sum, &[0.0; 6], 1e6);
    let found =
        machine.evaluate_unchecked(Function::PredictedDisplacement, &[&q[..], &s, &inputs].concat()).unwrap();
    // From the tool point to the weight, 200 mm before and 250 mm below it.
    let sag = -(found[2] - 200.0 * found[3]);
    let work: f64 = forces.iter().map(|force| force * force / stiffness).sum();
    assert_close(&[sag], &[work / weight], 1.0);
    assert!((sag - 0.0652).abs() < 1e-4 && (forces[2] - 628.4).abs() < 0.1, "{sag} {forces:?}");
}

/// A load cell under the platform of the couch: its reading is an input, which acts as the weight
/// does. Readings of the forces of the legs act as the forces of that weight.
#[test]
fn load_cells_are_inputs() {
    let path = format!("{}/../manipulators/mechanisms/hexapod.toml", env!("CARGO_MANIFEST_DIR"));
    let shipped = std::fs::read_to_string(path).unwrap();
    let shipped = shipped.replacen("enabled = false", "enabled = true", 1);
    let mut cells = shipped.replacen("mass = \"80 kg\"", "axes = \"base\"\nforce = [0, 0, \"-cell\"]", 1);
    cells =
        cells.replacen("[inputs]", "[inputs]\ncell = { value = \"0 N\", range = [\"0 N\", \"1500 N\"] }", 1);
    let (weighed, read) = (interpreter(&shipped), interpreter(&cells));
    let inputs: String = (1..=6).map(|leg| format!("force_{leg} = \"0 N\"\n")).collect();
    let mut strained = shipped.replacen("[inputs]", &format!("[inputs]\n{inputs}"), 1);
    for leg in 1..=6 {
        let joint = format!("joint = \"q{leg}\"\nstiffness");
        strained = strained.replacen(
            &joint,
            &format!("joint = \"q{leg}\"\nmoment = \"-force_{leg}\"\nstiffness"),
            1,
        );
    }
    let strained = interpreter(&strained);
    let s = [600.0, 400.0, 750.0];
    for q in samples(&weighed, 5) {
        // Forces in the unit of length mm are in mN.
        let newtons = 80.0 * 9.80665;
        let mut forces = [0.0; 6];
        weighed.leg_forces(&q, &s, &[2.0], &mut forces).unwrap();
        let expected = weighed.real_pose(&q, &s, &[2.0]).unwrap();
        let found = read.real_pose(&q, &s, &[1000.0 * newtons, 2.0]).unwrap();
        assert_close(found.0.as_flattened(), expected.0.as_flattened(), 1000.0);
        let readings: Vec<f64> = forces.iter().map(|force| 1000.0 * force).chain([2.0]).collect();
        let found = strained.real_pose(&q, &s, &readings).unwrap();
        assert_close(found.0.as_flattened(), expected.0.as_flattened(), 1000.0);
    }
}
