//! The machine with its errors, as nodes of chains or trees of frames.

use crate::chain::inverse::Inverse;
use crate::chain::{ClosedLoops, LocalTwist};
use crate::graph::{Frame, Six};

/// The machine with its errors, and what only chains or only trees have; see the fields of
/// [`Model`](super::Model).
pub(super) struct Machine {
    pub(super) real_pose: Frame,
    pub(super) drawn_pose: Frame,
    pub(super) real_errors: Option<Vec<Six>>,
    pub(super) drawn_errors: Vec<Six>,
    pub(super) local_twists: [Vec<LocalTwist>; 2],
    pub(super) inverse: Option<Inverse>,
    pub(super) loops: Option<ClosedLoops>,
}

impl Machine {
    pub(super) fn of_loops(loops: ClosedLoops, inverse: Option<Inverse>) -> Self {
        Self {
            real_pose: loops.real.pose,
            drawn_pose: loops.drawn.pose,
            real_errors: None,
            drawn_errors: Vec::new(),
            local_twists: [Vec::new(), Vec::new()],
            inverse,
            loops: Some(loops),
        }
    }
}
