//! Words of a map that stand for one of a few values.

use super::{Base, Order};
use crate::acceptance::FITTED;

pub(super) const BASES: [(&str, Base); 3] =
    [("known", Base::Known), ("unknown", Base::Unknown), ("exact", Base::Exact)];

/// Knowledge of the placement on the tool.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Placed {
    /// Approximately the nominal one, the same at all stations.
    Near,
    /// Exactly the nominal one.
    Exactly,
    /// Approximately the nominal one, and another at each station.
    PerStation,
}

pub(super) const PLACEMENTS: [(&str, Placed); 3] =
    [("unknown", Placed::Near), ("exact", Placed::Exactly), ("per station", Placed::PerStation)];

pub(super) const QUATERNION_ORDERS: [(&str, Order); 2] = [("wxyz", Order::Wxyz), ("xyzw", Order::Xyzw)];

/// Commands that rows hold, each with `true` for those after the correction.
pub(super) const COMMANDS: [(&str, bool); 2] = [("programmed", false), ("corrected", true)];

/// Places on the tool of an acceptance, each with `true` if it may be fitted to the judged rows.
pub(super) const JUDGED_TARGETS: [(&str, bool); 2] = [("stated", false), (FITTED, true)];

/// Mounts of a camera, each with `true` if the camera is on the tool.
pub(super) const MOUNTS: [(&str, bool); 2] = [("tool", true), ("room", false)];

/// Knowledge of the intrinsic parameters of a camera, each with `true` if they are known.
pub(super) const INTRINSIC_CHOICES: [(&str, bool); 2] = [("known", true), ("fitted", false)];

/// Word of a number that is estimated from the data.
pub(crate) const UNKNOWN: [(&str, ()); 1] = [("unknown", ())];
