//! The manipulator as a stick figure: its frames at home.

use abbe::analysis::Configuration;
use abbe::{Error, Manipulator, Pose};
use serde::Serialize;

/// Frames of the chain, base to tip.
#[derive(Clone, Debug, Serialize)]
pub struct Stick {
    /// What stands at each: several frames may share an origin.
    pub places: Vec<Place>,
    /// The longest side of the box around it, in the length unit.
    pub size: f64,
}

/// An origin.
#[derive(Clone, Debug, Serialize)]
pub struct Place {
    /// The names of the frames here.
    pub label: String,
    /// In `F_0`, in the length unit.
    pub origin: [f64; 3],
    /// The axes of the last frame here, unit vectors in `F_0`.
    pub axes: [[f64; 3]; 3],
}

impl Stick {
    /// At the home configuration.
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
        let mut places: Vec<Place> = Vec::new();
        for (label, Pose([x, y, z, origin])) in all {
            let near = |place: &&mut Place| distance(place.origin, origin) < 1e-6 * size;
            match places.iter_mut().find(near) {
                Some(place) => {
                    place.label += &format!(" · {label}");
                    place.axes = [x, y, z];
                }
                None => places.push(Place { label, origin, axes: [x, y, z] }),
            }
        }
        Ok(Self { places, size })
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
