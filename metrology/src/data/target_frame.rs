//! Frame in which a map states the positions of its targets: that of the tool, or the flange, the
//! last frame before it.

use abbe::{Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_spec::{Section, Spec};

/// Frames of the positions of targets, each with `true` for the flange.
pub(super) const TARGET_FRAMES: [(&str, bool); 2] = [("tool", false), ("flange", true)];

/// Frame of the positions of targets.
#[derive(Clone, Debug, Default)]
pub struct TargetFrame {
    /// The map says which.
    pub is_stated: bool,
    /// `T`, from the tool to the flange, if positions are in the frame of the flange.
    tool: Option<Pose>,
}

impl TargetFrame {
    /// Reads `target_frame` of `[data]`.
    pub(super) fn read(head: &Section<'_>, spec: &Spec) -> Option<Self> {
        let Some(item) = head.get("target_frame") else { return Some(Self::default()) };
        Some(Self { is_stated: true, tool: item.choice(&TARGET_FRAMES)?.then(|| tool(spec)) })
    }

    /// Converts a position to the frame of the tool.
    pub(super) fn to_tool(&self, position: [f64; 3]) -> [f64; 3] {
        self.tool.map_or(position, |tool| tool.inverse().apply(position))
    }

    /// Converts a position in the frame of the tool to this frame.
    pub(crate) fn placed_in_frame(&self, position: [f64; 3]) -> [f64; 3] {
        self.tool.map_or(position, |tool| tool.apply(position))
    }

    /// Converts the covariance of all coordinates of the targets, three rows for each, from the
    /// axes of the tool: `R C_ij Rᵀ` of each block.
    pub(crate) fn covariance_from_tool(&self, rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let Some(Pose([x, y, z, _])) = self.tool else { return rows.to_vec() };
        let turned = Pose([x, y, z, [0.0; 3]]);
        let turn = |vector: &[f64]| -> Vec<f64> {
            vector.as_chunks::<3>().0.iter().flat_map(|three| turned.apply(*three)).collect()
        };
        let turn_rows = |rows: &[Vec<f64>]| rows.iter().map(|row| turn(row)).collect::<Vec<_>>();
        transposed(&turn_rows(&transposed(&turn_rows(rows))))
    }
}

fn transposed(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..rows.len()).map(|j| rows.iter().map(|row| row[j]).collect()).collect()
}

/// Returns `T`, the transform of the tool with the parameters of the spec.
fn tool(spec: &Spec) -> Pose {
    let q: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
    let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
    // The nominal chain has been evaluated by the check of the spec.
    let evaluated = Interpreter::new(spec.clone()).transforms(&q, &s, &mut transforms);
    evaluated.map_or(Pose::IDENTITY, |()| transforms[spec.frames.len()])
}

#[cfg(test)]
mod tests;
