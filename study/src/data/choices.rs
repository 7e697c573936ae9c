//! Words of a map that stand for one of a few values.

use super::map::Base;
use super::turn::Order;

pub(super) const BASES: [(&str, Base); 3] =
    [("known", Base::Known), ("unknown", Base::Unknown), ("exact", Base::Exact)];

/// Placements of the targets, each with `true` if it is exact.
pub(super) const PLACEMENTS: [(&str, bool); 2] = [("unknown", false), ("exact", true)];

pub(super) const QUATERNION_ORDERS: [(&str, Order); 2] = [("wxyz", Order::Wxyz), ("xyzw", Order::Xyzw)];

/// Word of a number that is estimated from the data.
pub(super) const UNKNOWN: [(&str, ()); 1] = [("unknown", ())];
