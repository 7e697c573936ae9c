//! Instruments that are read one number at a time: one file for each kind.
//!
//! An observable is a function `g` of the position `p` of a target in `F_0`, or of the orientation
//! `R` of the tool, and of a [fixture](Fixture): a point `c` or a unit direction `n`. A file states
//! the keys of its instrument in a map, the observable, and the gradients `∂g/∂p` and `∂g/∂c` or
//! `∂g/∂n`; residuals, derivatives by unknowns, readers of maps and reports are generic. Fixtures
//! stand still in `F_0` at unknown places, so only observables that [see the
//! base](InstrumentKind::sees_base) depend on the pose of `F_0`.

mod angle;
mod between;
mod camera;
mod contact;
mod displacement;
mod distance;
mod fixture;
mod geometry;
mod indicator;
mod kind;
mod lens;
mod plane;
mod point;
mod rotation;
mod sphere;

pub use fixture::{Fixture, FixtureGeometry, KnownDistance};
pub(super) use geometry::Geometry;
pub(super) use kind::Evaluation;
pub use kind::{InstrumentKind, Observable, Reference, SizeInformation};

pub use camera::CAMERA;
pub use contact::CONTACT;
pub use lens::{Camera, INTRINSICS};

/// The kinds, in the order in which documentation and messages list them.
pub static INSTRUMENTS: [&InstrumentKind; 11] = [
    &point::POINT,
    &distance::DISTANCE,
    &contact::CONTACT,
    &plane::PLANE,
    &sphere::SPHERE,
    &indicator::INDICATOR,
    &between::BETWEEN,
    &displacement::DISPLACEMENT,
    &angle::ANGLE,
    &rotation::ROTATION,
    &camera::CAMERA,
];
