//! Stick figure of the manipulator at home.

use abbe::analysis::Configuration;
use abbe::{Error, Manipulator, Pose};
use serde::Serialize;

/// Origins of the frames, base to tip.
#[derive(Clone, Debug, Serialize)]
pub struct Stick {
    /// Distinct origins; several frames may share one.
    pub origins: Vec<FrameOrigin>,
    /// Longest side of the bounding box, in the length unit; 1 if all origins coincide.
    pub size: f64,
}

/// An origin with its frames.
#[derive(Clone, Debug, Serialize)]
pub struct FrameOrigin {
    /// Names of the frames at this origin.
    pub label: String,
    /// Position in `F_0`, in the length unit.
    pub origin: [f64; 3],
    /// Axes of the last frame at this origin, unit vectors in `F_0`.
    pub axes: [[f64; 3]; 3],
}

impl Stick {
    /// Evaluates the frames at the home configuration.
    pub(super) fn at_home(manipulator: &dyn Manipulator, home: &Configuration) -> Result<Self, Error> {
        let frames = &manipulator.description().frames;
        let mut transforms = vec![Pose::IDENTITY; frames.len() + 1];
        manipulator.transforms(&home.q, &home.s, &mut transforms)?;
        let named = frames.iter().enumerate().map(|(i, frame)| format!("F{} {}", i + 1, frame.name));
        let names = named.chain(["tool point".to_owned()]);
        let mut pose = Pose::IDENTITY;
        let mut all = vec![("F0".to_owned(), pose)];
        for (name, transform) in names.zip(&transforms) {
            pose = pose.then(transform);
            all.push((name, pose));
        }
        let size = (0..3).map(|axis| {
            let along = all.iter().map(|(_, pose)| pose.position()[axis]);
            along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
        });
        let size = size.fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let mut origins: Vec<FrameOrigin> = Vec::new();
        for (label, Pose([x, y, z, origin])) in all {
            let near = |shared: &&mut FrameOrigin| distance(shared.origin, origin) < 1e-6 * size;
            match origins.iter_mut().find(near) {
                Some(shared) => {
                    shared.label += &format!(" · {label}");
                    shared.axes = [x, y, z];
                }
                None => origins.push(FrameOrigin { label, origin, axes: [x, y, z] }),
            }
        }
        Ok(Self { origins, size })
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
