//! Closed means closed: what does not close in home's mode is refused, and what closes is found.

use std::f64::consts::{PI, TAU};

use abbe::{Error, Manipulator, Pose, displacement};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use abbe_tests::mechanisms::Mechanism;
use abbe_tests::{sample_size, thorough};
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A four-bar linkage: crank, coupler, rocker and ground; the angle of the crank at home; and the
/// side of the knee.
#[derive(Clone, Copy, Debug)]
struct FourBar {
    links: [f64; 4],
    home: f64,
    side: f64,
}

/// Angles of a knee, relative to the crank and absolute.
type Knee = [f64; 2];

impl FourBar {
    /// Returns a random one that is regular at home.
    fn new(random: &mut Xoshiro256PlusPlus) -> Self {
        loop {
            let links = [0; 4].map(|_| random.random_range(30.0..130.0));
            let (home, side) = (random.random_range(-PI..PI), if random.random() { 1.0 } else { -1.0 });
            let machine = Self { links, home, side };
            if machine.smallest(home, links).is_some_and(|smallest| smallest > 0.05) {
                return machine;
            }
        }
    }

    fn interpreter(&self) -> Interpreter {
        let text = self.text();
        Interpreter::new(Spec::parse("machine.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}")))
    }

    fn text(&self) -> String {
        let Self { links: [crank, coupler, rocker, ground], home, .. } = self;
        let [p1, p2] = self.knee(*home, self.links).unwrap();
        format!(
            r#"
[manipulator]
name = "four_bar"
length = "mm"
[parameters]
crank = "{crank} mm"
coupler = "{coupler} mm"
rocker = "{rocker} mm"
ground = "{ground} mm"
[[frame]]
name = "crank"
variable = {{ name = "q", kind = "revolute", home = {home} }}
transform = "Rz(q) Tx(crank)"
[[frame]]
name = "coupler"
variable = {{ name = "p1", kind = "revolute", passive = true, home = {p1} }}
transform = "Rz(p1) Tx(coupler)"
[[frame]]
name = "rocker"
parent = "base"
variable = {{ name = "p2", kind = "revolute", passive = true, home = {p2} }}
transform = "Tx(ground) Rz(p2) Tx(rocker)"
[[loop]]
name = "knee"
frames = ["coupler", "rocker"]
closes = ["x", "y"]
[tool]
frame = "coupler"
transform = "Ty(30)"
"#
        )
    }

    /// Returns the angles of the knee, where two circles intersect.
    fn knee(&self, q: f64, [crank, coupler, rocker, ground]: [f64; 4]) -> Option<Knee> {
        let [x, y] = [ground - crank * q.cos(), -crank * q.sin()];
        let distance = x.hypot(y);
        let along = (coupler * coupler - rocker * rocker + distance * distance) / (2.0 * distance);
        let square = coupler * coupler - along * along;
        (square >= 0.0 && distance > 0.0).then(|| {
            let height = self.side * square.sqrt();
            let knee = [(along * x - height * y) / distance, (along * y + height * x) / distance];
            [knee[1].atan2(knee[0]) - q, (knee[1] - y).atan2(knee[0] - x)]
        })
    }

    /// Returns the smallest singular value of φ_p, with lengths relative to the sum of the links.
    fn smallest(&self, q: f64, links: [f64; 4]) -> Option<f64> {
        let [p1, p2] = self.knee(q, links)?;
        let sum: f64 = links.iter().sum();
        let [a, b] = [links[1] / sum, links[2] / sum];
        let determinant = a * b * (p2 - q - p1).sin().abs();
        let squares = a * a + b * b;
        let largest = (0.5 * (squares + (squares * squares - 4.0 * determinant * determinant).sqrt())).sqrt();
        Some(determinant / largest)
    }

    /// Returns the smallest singular value on the path to a command; `None` if it is interrupted.
    fn smallest_on_path(&self, q: f64, links: [f64; 4]) -> Option<f64> {
        let way = q - self.home;
        // Where the crank is aligned with the ground, the knee is nearest to being stretched.
        let aligned = (-4..=4).map(|k| (f64::from(k) * PI - self.home) / way);
        let shares =
            (0..=600).map(|k| f64::from(k) / 600.0).chain(aligned.filter(|t| (0.0..=1.0).contains(t)));
        let at = |share: f64| {
            let links = std::array::from_fn(|i| self.links[i] + share * (links[i] - self.links[i]));
            self.smallest(self.home + share * way, links)
        };
        shares.map(at).try_fold(f64::INFINITY, |least, found| Some(least.min(found?)))
    }
}

/// Returns the largest difference of angles.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let turn = |(a, b): (&f64, &f64)| ((a - b + PI).rem_euclid(TAU) - PI).abs();
    a.iter().zip(b).map(turn).fold(0.0, f64::max)
}

/// Counts of answers.
#[derive(Clone, Copy, Debug, Default)]
struct Answers {
    commands: usize,
    out_of_reach: usize,
    answered_out_of_reach: usize,
    open: usize,
    other_mode: usize,
    regular: usize,
    refused_on_regular_path: usize,
    interrupted: usize,
    answered_after_interruption: usize,
}

impl Answers {
    fn count(&mut self, machine: &FourBar, interpreter: &Interpreter, q: f64, links: [f64; 4]) {
        self.commands += 1;
        let mut passive = [0.0; 2];
        let found = interpreter.passive(&[q], &links, &mut passive);
        assert!(matches!(found, Ok(()) | Err(Error::NotClosed)), "{found:?}");
        let is_found = found.is_ok();
        let expected = machine.knee(q, links);
        let Some(expected) = expected else {
            self.out_of_reach += 1;
            self.answered_out_of_reach += usize::from(is_found);
            return;
        };
        let path = machine.smallest_on_path(q, links);
        if path.is_some_and(|smallest| smallest >= 1e-3) {
            self.regular += 1;
            self.refused_on_regular_path += usize::from(!is_found);
        }
        if path.is_none() {
            self.interrupted += 1;
            self.answered_after_interruption += usize::from(is_found);
        }
        if is_found {
            let [crank, coupler, rocker, ground] = links;
            let [a, b] = [q + passive[0], passive[1]];
            let x = crank * q.cos() + coupler * a.cos() - ground - rocker * b.cos();
            let y = crank * q.sin() + coupler * a.sin() - rocker * b.sin();
            self.open += usize::from(x.hypot(y) > 1e-10 * links.iter().sum::<f64>());
            // Near a singularity both modes are the same.
            let near = 1e-9 / machine.smallest(q, links).unwrap_or(0.0).max(1e-5);
            self.other_mode += usize::from(difference(&passive, &expected) > near);
        }
    }

    /// Asserts that nothing out of reach is answered, nothing is open or in another mode, and
    /// everything on a regular path is answered.
    fn check(&self) {
        assert_eq!((self.answered_out_of_reach, self.open, self.other_mode), (0, 0, 0), "{self:?}");
        assert_eq!(self.refused_on_regular_path, 0, "{self:?}");
        assert!(100 * self.regular.min(self.out_of_reach).min(self.interrupted) > self.commands, "{self:?}");
    }
}

/// Commands of random four-bar linkages, within two turns: 560,000 in a thorough run.
#[test]
fn four_bars_close_in_the_mode_of_home_or_are_refused() {
    let (mut random, mut answers) = (Xoshiro256PlusPlus::seed_from_u64(1), Answers::default());
    for _ in 0..if thorough() { 1400 } else { 30 } {
        let machine = FourBar::new(&mut random);
        let interpreter = machine.interpreter();
        for _ in 0..400 {
            let q = machine.home + random.random_range(-TAU..TAU);
            answers.count(&machine, &interpreter, q, machine.links);
        }
    }
    println!("{answers:?}");
    answers.check();
}

/// Four-bar linkages with other links than those of the spec: up to a third longer or shorter.
#[test]
fn changed_four_bars_close_in_the_mode_of_home_or_are_refused() {
    let (mut random, mut answers) = (Xoshiro256PlusPlus::seed_from_u64(2), Answers::default());
    for _ in 0..sample_size(100) {
        let machine = FourBar::new(&mut random);
        let interpreter = machine.interpreter();
        for _ in 0..100 {
            let links = machine.links.map(|link| link * random.random_range(0.67..1.33));
            let q = machine.home + random.random_range(-3.0..3.0);
            answers.count(&machine, &interpreter, q, links);
        }
    }
    println!("{answers:?}");
    answers.check();
}

/// A mechanism by its own equations.
struct OwnMachine {
    mechanism: Mechanism,
    units: Vec<f64>,
}

impl OwnMachine {
    fn new(mechanism: Mechanism) -> Self {
        let mut units = Vec::new();
        for closed in &mechanism.loops {
            let mut frames: Vec<Option<usize>> = closed.frames.map(Some).to_vec();
            let mut length = closed.length;
            while let Some(frame) = frames.pop() {
                let Some(frame) = frame else { continue };
                let position = mechanism.frames[frame].rest.position();
                length += position.iter().map(|x| x * x).sum::<f64>().sqrt();
                frames.push(mechanism.frames[frame].parent);
            }
            let unit = |coordinate: &usize| if *coordinate < 3 { length } else { 1.0 };
            match &closed.coordinates[..] {
                [] => units.push(length),
                several => units.extend(several.iter().map(unit)),
            }
        }
        Self { mechanism, units }
    }

    /// Returns the values at home of the joints that are passive, or of the others.
    fn home(&self, passive: bool) -> Vec<f64> {
        let joints = self.mechanism.frames.iter().filter_map(|frame| frame.joint);
        joints.filter(|(.., is_passive)| *is_passive == passive).map(|(_, home, _)| home).collect()
    }

    /// Returns the equations relative to their units, and the smallest number that is negative
    /// where a rotation is upside down.
    fn residual(&self, q: &[f64], p: &[f64]) -> (Vec<f64>, f64) {
        let (mut q, mut p) = (q.iter(), p.iter());
        let mut poses: Vec<Pose> = Vec::new();
        for frame in &self.mechanism.frames {
            let mut pose = frame.parent.map_or(Pose::IDENTITY, |parent| poses[parent]);
            if let Some((motion, _, is_passive)) = frame.joint {
                let mut moved = [0.0; 6];
                moved[motion] = *(if is_passive { &mut p } else { &mut q }).next().unwrap();
                pose = pose.then(&displacement(&moved));
            }
            poses.push(pose.then(&frame.rest));
        }
        let (mut rows, mut upright) = (Vec::new(), f64::INFINITY);
        for closed in &self.mechanism.loops {
            let [a, b] = closed.frames.map(|frame| poses[frame]);
            let parent = self.mechanism.frames[closed.frames[1]].parent;
            let axes = parent.map_or(Pose::IDENTITY, |parent| poses[parent]).0;
            let from: Vec<f64> = a.position().iter().zip(b.position()).map(|(a, b)| a - b).collect();
            let dot = |axis: [f64; 3], v: &[f64]| axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
            if closed.coordinates.is_empty() {
                rows.push(from.iter().map(|x| x * x).sum::<f64>().sqrt() - closed.length);
            }
            // W = R_a R_bᵀ.
            let w = |i: usize, j: usize| (0..3).map(|k| a.0[k][i] * b.0[k][j]).sum::<f64>();
            let vector: Vec<f64> = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| 0.5 * (w(i, j) - w(j, i))).to_vec();
            for coordinate in &closed.coordinates {
                let axis = axes[coordinate % 3];
                if *coordinate < 3 {
                    rows.push(dot(axis, &from));
                } else {
                    rows.push(dot(axis, &vector));
                    let turned: Vec<f64> = (0..3).map(|i| dot([w(i, 0), w(i, 1), w(i, 2)], &axis)).collect();
                    upright = upright.min((0..3).map(|i| w(i, i)).sum::<f64>() - dot(axis, &turned));
                }
            }
        }
        (rows.iter().zip(&self.units).map(|(row, unit)| row / unit).collect(), upright)
    }

    /// Returns φ_p by central differences.
    fn derivatives(&self, q: &[f64], p: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(p.len(), p.len(), |row, column| {
            let at = |change: f64| {
                let mut p = p.to_vec();
                p[column] += change;
                self.residual(q, &p).0[row]
            };
            (at(1e-5) - at(-1e-5)) / 2e-5
        })
    }

    /// Follows the straight path from home in small steps. Returns the passive variables at its end
    /// and the smallest singular value on it; `None` if it is interrupted, or nearly so.
    fn follow(&self, q: &[f64]) -> Option<(Vec<f64>, f64)> {
        let home = self.home(false);
        let (mut p, mut share, mut step, mut smallest) = (self.home(true), 0.0_f64, 0.1, f64::INFINITY);
        while share < 1.0 {
            let next = (share + step).min(1.0);
            let at: Vec<f64> = home.iter().zip(q).map(|(home, q)| home + next * (q - home)).collect();
            let mut trial = p.clone();
            let mut derivatives = self.derivatives(&at, &trial);
            for _ in 0..6 {
                let (residual, _) = self.residual(&at, &trial);
                if residual.iter().all(|row| row.abs() < 1e-13) {
                    break;
                }
                let change = derivatives.clone().lu().solve(&nalgebra::DVector::from_vec(residual))?;
                trial.iter_mut().zip(change.iter()).for_each(|(p, change)| *p -= change);
                derivatives = self.derivatives(&at, &trial);
            }
            let least = derivatives.svd(false, false).singular_values.min();
            let farthest = p.iter().zip(&trial).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let (residual, _) = self.residual(&at, &trial);
            let is_closed = residual.iter().all(|row| row.abs() < 1e-11);
            if is_closed && farthest < 0.5 * least.min(0.6) {
                (p, share, smallest) = (trial, next, smallest.min(least));
                step *= 1.5;
            } else if step < 1e-6 || least < 1e-3 {
                return None;
            } else {
                step /= 2.0;
            }
        }
        Some((p, smallest))
    }
}

/// Random mechanisms with one to three loops: what is returned closes, and what a regular path
/// reaches is returned.
#[test]
fn mechanisms_close_in_the_mode_of_home_or_are_refused() {
    let (mut regular, mut answered, mut refused, mut machines) = (0, 0, 0, 0);
    for seed in 0.. {
        let own = OwnMachine::new(Mechanism::new(seed));
        let (q_home, p_home) = (own.home(false), own.home(true));
        if own.derivatives(&q_home, &p_home).svd(false, false).singular_values.min() < 0.01 {
            continue;
        }
        machines += 1;
        let spec = Spec::parse("mechanism.toml", &own.mechanism.text)
            .unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let machine = Interpreter::new(spec);
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        for _ in 0..4 {
            let q: Vec<f64> = q_home.iter().map(|home| home + random.random_range(-1.5..1.5)).collect();
            let mut passive = vec![0.0; p_home.len()];
            let found = machine.passive(&q, &[], &mut passive);
            if found.is_ok() {
                let (residual, upright) = own.residual(&q, &passive);
                let gap = residual.iter().map(|row| row.abs()).fold(0.0, f64::max);
                assert!(gap < 1e-10 && upright > 0.0, "{seed}: open by {gap}, {upright}");
            }
            let path = own.follow(&q).filter(|(_, smallest)| *smallest >= 1e-3);
            match (path, found) {
                (Some((expected, smallest)), found) => {
                    assert!(found.is_ok(), "{seed}: {q:?} refused, {smallest:e}");
                    let far = difference(&passive, &expected);
                    assert!(
                        far < 1e-6,
                        "{seed}: {q:?} in another mode: {passive:?}, not {expected:?}, {smallest:e}"
                    );
                    regular += 1;
                }
                (None, Ok(())) => answered += 1,
                (None, Err(_)) => refused += 1,
            }
        }
        if machines == sample_size(120) {
            break;
        }
    }
    println!(
        "{machines} mechanisms: {regular} regular paths, others: {answered} answered, {refused} refused"
    );
    assert!(regular > machines / 2 && refused > machines / 4);
}

/// The limits of a passive joint hold: beyond them a command is refused, and the joint is named.
#[test]
fn limits_of_passive_joints_hold() {
    let machine = FourBar { links: [40.0, 120.0, 80.0, 100.0], home: 1.0, side: 1.0 };
    let text = machine.text();
    let [_, p2] = machine.knee(1.0, machine.links).unwrap();
    let limits = [p2 - 0.2, p2 + 0.3];
    let limited =
        text.replace("name = \"p2\",", &format!("name = \"p2\", limits = [{}, {}],", limits[0], limits[1]));
    let [free, limited] =
        [text, limited].map(|text| Interpreter::new(Spec::parse("machine.toml", &text).unwrap()));
    let mut counts = [0; 2];
    for k in 0..200 {
        let q = -PI + TAU * f64::from(k) / 200.0;
        let mut passive = [0.0; 2];
        free.passive(&[q], &machine.links, &mut passive).unwrap();
        let is_inside = passive[1] >= limits[0] && passive[1] <= limits[1];
        let found = limited.passive(&[q], &machine.links, &mut passive);
        let expected = if is_inside { Ok(()) } else { Err(Error::PassiveLimit { passive: 1 }) };
        assert_eq!(found, expected, "{q}");
        counts[usize::from(is_inside)] += 1;
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

/// A rotation never closes upside down, where the antisymmetric part of its matrix vanishes, too.
#[test]
fn rotations_do_not_close_upside_down() {
    let at = |home: f64| {
        let text = format!(
            r#"
[manipulator]
name = "gear"
length = "mm"
[[frame]]
name = "drive"
variable = {{ name = "q", kind = "revolute" }}
transform = "Rz(q) Tx(50)"
[[frame]]
name = "follower"
parent = "base"
variable = {{ name = "p", kind = "revolute", passive = true, home = {home} }}
transform = "Rz(p) Tx(80)"
[[loop]]
name = "belt"
frames = ["drive", "follower"]
closes = ["rz"]
[tool]
frame = "follower"
transform = "Ty(30)"
"#
        );
        let machine = Interpreter::new(Spec::parse("machine.toml", &text).unwrap_or_else(|m| panic!("{m}")));
        let mut passive = [0.0];
        machine.passive(&[0.4], &[], &mut passive).map(|()| passive[0])
    };
    assert!((at(0.3).unwrap() - 0.4).abs() < 1e-12);
    assert_eq!(at(PI), Err(Error::NotClosed));
}
