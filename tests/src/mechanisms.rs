//! Random mechanisms.

use std::fmt::Write;

use abbe::{Manipulator, Pose, displacement};
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Coordinates of a loop.
const COORDINATES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Random mechanisms: each loop has passive joints of its own, as many as equations, in a branch
/// that begins at any earlier frame and ends where another one was put at home.
pub struct Mechanism {
    random: Xoshiro256PlusPlus,
    /// The spec.
    pub text: String,
    /// Frames, each after its parent.
    pub frames: Vec<MechanismFrame>,
    /// Loops.
    pub loops: Vec<MechanismLoop>,
    /// Poses of all frames at home, in `F_0`.
    poses: Vec<Pose>,
    passive: usize,
    commanded: usize,
    /// Units of length per metre.
    unit: f64,
}

/// A frame of a mechanism.
pub struct MechanismFrame {
    /// Frame that it hangs on.
    pub parent: Option<usize>,
    /// Motion of its joint, as an index of the six errors, and its value at home; `true` for a
    /// passive one.
    pub joint: Option<(usize, f64, bool)>,
    /// Pose behind the joint.
    pub rest: Pose,
}

/// A loop of a mechanism: its two frames, and the coordinates that close; none for a distance.
pub struct MechanismLoop {
    /// The frames.
    pub frames: [usize; 2],
    /// Coordinates that close.
    pub coordinates: Vec<usize>,
    /// Length of the leg of a distance.
    pub length: f64,
}

impl Mechanism {
    /// Returns the mechanism of a seed, in metres.
    pub fn new(seed: u64) -> Self {
        Self::in_units("m", 1.0, seed)
    }

    /// Returns the same mechanism in mm.
    pub fn in_millimetres(seed: u64) -> Self {
        Self::in_units("mm", 1000.0, seed)
    }

    fn in_units(symbol: &str, unit: f64, seed: u64) -> Self {
        let mut mechanism = Self {
            random: Xoshiro256PlusPlus::seed_from_u64(seed),
            text: format!("[manipulator]\nname = \"mechanism\"\nlength = \"{symbol}\"\n"),
            unit,
            frames: Vec::new(),
            loops: Vec::new(),
            poses: Vec::new(),
            passive: 0,
            commanded: 0,
        };
        mechanism.joint(None, false, true);
        let loops = 1 + seed % 3;
        for number in 0..loops {
            mechanism.close(number);
        }
        // The tool is on any frame that something moves.
        let tool = mechanism.below(mechanism.poses.len());
        let _ = write!(
            mechanism.text,
            "[tool]\nframe = \"f{tool}\"\ntransform = \"Tx(0.2 m) Rz(0.3) Ty(0.1 m)\"\n"
        );
        mechanism
    }

    fn below(&mut self, count: usize) -> usize {
        self.random.random_range(0..count)
    }

    /// Returns a number from −1 to 1 with three decimals.
    fn number(&mut self) -> f64 {
        (self.below(2001) as f64 - 1000.0) / 1000.0
    }

    /// Adds a frame in general position with a joint, and returns its index.
    fn joint(&mut self, parent: Option<usize>, passive: bool, may_slide: bool) -> usize {
        let numbers: Vec<f64> = (0..6).map(|_| self.number()).collect();
        let home = 0.4 * self.number();
        let (axis, is_slide) = (self.below(3), self.below(4) == 0 && may_slide);
        let [x, y, z, a, b, c] = [0, 1, 2, 3, 4, 5].map(|i| numbers[i]);
        let index = self.poses.len();
        let name = match passive {
            true => format!("p{}", self.passive),
            false => format!("q{}", self.commanded),
        };
        let kind = if is_slide { "prismatic" } else { "revolute" };
        let motion = format!("{}{}({name})", if is_slide { "T" } else { "R" }, ["x", "y", "z"][axis]);
        let unit = if is_slide { " m" } else { " rad" };
        let flags = match passive {
            true => "passive = true".to_owned(),
            false => format!("limits = [\"{}{unit}\", \"{}{unit}\"]", home - 0.05, home + 0.05),
        };
        let parent_name = parent.map_or("base".to_owned(), |parent| format!("f{parent}"));
        let _ = write!(
            self.text,
            "[[frame]]\nname = \"f{index}\"\nparent = \"{parent_name}\"\n\
             variable = {{ name = \"{name}\", kind = \"{kind}\", home = \"{home}{unit}\", {flags} }}\n\
             transform = \"{motion} Tx({x} m) Ty({y} m) Tz({z} m) Ry({a}) Rz({b}) Rx({c})\"\n"
        );
        *(if passive { &mut self.passive } else { &mut self.commanded }) += 1;
        let rest = displacement(&[x, y, z, a, b, c]);
        let (mut moved, motion) = ([0.0; 6], if is_slide { axis } else { [5, 3, 4][axis] });
        moved[motion] = home;
        self.frames.push(MechanismFrame { parent, joint: Some((motion, home, passive)), rest });
        let before = parent.map_or(Pose::IDENTITY, |parent| self.poses[parent]);
        self.poses.push(before.then(&displacement(&moved)).then(&rest));
        index
    }

    /// Adds a loop that closes at home.
    fn close(&mut self, number: u64) {
        let mut coordinates: Vec<usize> = (0..6).filter(|_| self.below(2) == 0).collect();
        let is_distance = self.below(3) == 0;
        if is_distance || coordinates.is_empty() {
            coordinates = vec![0];
        }
        let start = self.below(self.poses.len());
        let mut end = start;
        let mut remaining = coordinates.len();
        // Slides do not turn anything.
        let mut slides = coordinates.iter().filter(|coordinate| **coordinate < 3).count();
        while remaining > 0 {
            // A commanded joint between passive ones now and then.
            let passive = self.below(4) != 0;
            let text = self.text.len();
            end = self.joint(Some(end), passive, slides > 0);
            remaining -= usize::from(passive);
            slides -= usize::from(passive && self.text[text..].contains("prismatic"));
        }
        let other = if self.below(2) == 0 { None } else { Some(self.below(start + 1)) };
        let before = other.map_or(Pose::IDENTITY, |other| self.poses[other]);
        let mut there = before.inverse().then(&self.poses[end]);
        let closes = match is_distance {
            true => {
                there.0[3] = there.0[3].map(|coordinate| coordinate + 0.5);
                format!("\"distance\"\nlength = \"{:?} m\"", 0.5 * 3_f64.sqrt())
            }
            false => {
                format!("{:?}", coordinates.iter().map(|i| COORDINATES[*i]).collect::<Vec<_>>())
            }
        };
        let row = |i: usize| {
            let [x, y, z, p] = there.0.map(|axis| axis[i]);
            format!("[{x:?}, {y:?}, {z:?}, {:?}]", self.unit * p)
        };
        let index = self.poses.len();
        let other_name = other.map_or("base".to_owned(), |other| format!("f{other}"));
        let _ = write!(
            self.text,
            "[[frame]]\nname = \"f{index}\"\nparent = \"{other_name}\"\n\
             matrix = [{}, {}, {}, [0, 0, 0, 1]]\n\
             [[loop]]\nname = \"{number}\"\nframes = [\"f{end}\", \"f{index}\"]\ncloses = {closes}\n",
            row(0),
            row(1),
            row(2),
        );
        self.poses.push(before.then(&there));
        self.frames.push(MechanismFrame { parent: other, joint: None, rest: there });
        let coordinates = if is_distance { Vec::new() } else { coordinates };
        self.loops.push(MechanismLoop { frames: [end, index], coordinates, length: 0.5 * 3_f64.sqrt() });
    }
}

/// Returns `true` if a mechanism in metres closes around home, and errors and joints have effects
/// of their order there.
pub fn is_regular(machine: &dyn Manipulator) -> bool {
    let description = machine.description();
    let home: Vec<f64> = description.variables.iter().map(|variable| variable.home).collect();
    let mut columns = vec![[0.0; 6]; 6 * description.frames.len()];
    let passive = |q: &[f64]| {
        let mut passive = vec![0.0; description.passive().count()];
        machine.passive(q, &[], &mut passive).ok().map(|()| passive)
    };
    let closes_around = |(i, share): (usize, f64)| {
        let mut q = home.clone();
        q[i] += 0.05 * share;
        let [before, after] = [&home, &q].map(|q| passive(q));
        let pairs = before.zip(after);
        pairs.is_some_and(|(a, b)| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.3))
            && machine.error_jacobian(&q, &[], &mut columns).is_ok()
            && columns.as_flattened().iter().all(|entry| entry.abs() < 10.0)
    };
    let mut steps = (0..home.len()).flat_map(|i| [(i, -1.0), (i, 1.0)]);
    steps.all(closes_around)
}
