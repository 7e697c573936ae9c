//! Words of a map that stand for one of a few values.

use super::map::Base;
use super::turn::Order;

pub(super) const BASES: [(&str, Base); 3] =
    [("known", Base::Known), ("unknown", Base::Unknown), ("exact", Base::Exact)];

/// Placements of the targets, each with `true` if it is exact.
pub(super) const PLACEMENTS: [(&str, bool); 2] = [("unknown", false), ("exact", true)];

pub(super) const QUATERNION_ORDERS: [(&str, Order); 2] = [("wxyz", Order::Wxyz), ("xyzw", Order::Xyzw)];

/// Mounts of a camera, each with `true` if the camera is on the tool.
pub(super) const MOUNTS: [(&str, bool); 2] = [("tool", true), ("room", false)];

/// Knowledge of the intrinsic parameters of a camera, each with `true` if they are known.
pub(super) const INTRINSIC_CHOICES: [(&str, bool); 2] = [("known", true), ("fitted", false)];

/// Word of a number that is estimated from the data.
pub(crate) const UNKNOWN: [(&str, ()); 1] = [("unknown", ())];
