//! Line of sight of an instrument: where it can see the targets of a plan.

use abbe::{Pose, analysis::sampling::vectors::dot};

/// Cone: its axis, and the cosine of its half-angle.
pub(super) type Cone = ([f64; 3], f64);

/// Place of an instrument, and what it sees from there.
#[derive(Clone, Debug)]
pub struct Sight {
    /// Position of the instrument in `F_0`.
    pub(super) from: [f64; 3],
    /// Cone of the instrument, in `F_0`.
    pub(super) instrument: Option<Cone>,
    /// Cone of the targets, in the frame of the tool.
    pub(super) targets: Option<Cone>,
}

impl Sight {
    /// Returns whether the instrument sees all of these targets on the tool, whose pose is that in
    /// `F_0`.
    pub(crate) fn sees(&self, tool: &Pose, targets: &[[f64; 3]]) -> bool {
        let is_within = |cone: Option<Cone>, line: [f64; 3]| {
            cone.is_none_or(|(axis, cosine)| {
                dot(axis, line) >= cosine * (dot(axis, axis) * dot(line, line)).sqrt()
            })
        };
        targets.iter().all(|target| {
            let point = tool.apply(*target);
            let line: [f64; 3] = std::array::from_fn(|i| point[i] - self.from[i]);
            let faces = self.targets.map(|(axis, cosine)| (tool.turn(axis), cosine));
            is_within(self.instrument, line) && is_within(faces, line.map(|x| -x))
        })
    }
}
