//! Words of a workspace that stand for one of a few values.

use abbe::analysis::ToolOrientation;

pub(super) const ORIENTATIONS: [(&str, ToolOrientation); 2] =
    [("free", ToolOrientation::Free), ("home", ToolOrientation::Home)];
