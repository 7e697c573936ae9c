//! Words of a workspace that stand for one of a few values.

use abbe::analysis::ToolOrientation;

pub(super) const ORIENTATIONS: [(&str, ToolOrientation); 4] = [
    ("free", ToolOrientation::Free),
    ("home", ToolOrientation::Home),
    ("down", ToolOrientation::Along(2, [0.0, 0.0, -1.0])),
    ("up", ToolOrientation::Along(2, [0.0, 0.0, 1.0])),
];
