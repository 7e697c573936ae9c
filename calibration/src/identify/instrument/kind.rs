//! Description of an instrument, and the observables it reads.

use super::{Geometry, INTRINSICS};

/// A kind of instrument: its keys in a map, its observables and their gradients.
///
/// Each kind is one file of this folder; [`INSTRUMENTS`](super::INSTRUMENTS) lists them.
#[derive(Debug)]
pub struct InstrumentKind {
    /// Value of `kind` in a map.
    pub name: &'static str,
    /// Description of the reading, for documentation.
    pub reads: &'static str,
    /// Keys of its table in a map, without those that all instruments have: `name`, `kind`,
    /// `setup`, `uncertainty`.
    ///
    /// `column` or `columns` make it an instrument that is read; without them the machine is moved
    /// until it touches. `at` and `direction` are the nominal [geometry](super::FixtureGeometry) of
    /// its fixture.
    pub keys: &'static [&'static str],
    /// Number of observables: 1, 3 for the coordinates x, y and z, or 2 for each corner that a
    /// camera sees.
    pub numbers: usize,
    /// The observable is an angle: a function of the rotation of the tool, in rad.
    pub is_angle: bool,
    /// The readings determine the position `at` of the fixture, so that the map may leave it out.
    pub finds_position: bool,
    /// The observable depends on the pose of `F_0` in the frame of the instrument.
    pub sees_base: bool,
    /// The offset of the readings is always unknown; otherwise the keys `zero` and `radius` state
    /// it.
    pub has_unknown_zero: bool,
    /// Second argument of the observable.
    pub reference: Reference,
    /// Information about the size of the machine.
    pub size: SizeInformation,
    /// Computes the observable and its gradient.
    pub(in super::super) evaluate: fn(&Observable, &Geometry) -> Evaluation,
}

/// Second argument of an observable, beside its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reference {
    /// The observable depends on the current pose alone.
    None,
    /// A second target on the tool.
    Target,
    /// The target, or the orientation of the tool, in the previous row.
    PreviousRow,
}

/// Response of an observable to a machine whose lengths, and whose fixtures, are all larger by the
/// same share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SizeInformation {
    /// The observable does not change.
    None,
    /// Only the variation of the observable over the rows carries information: an offset absorbs
    /// the rest.
    Variation,
    /// The observable is a length and grows by that share.
    Length,
}

/// One number that an instrument reads.
#[derive(Clone, Debug)]
pub struct Observable {
    /// Prefix of the name of its zero: `bar_zero`.
    pub name: String,
    /// The kind of its instrument.
    pub kind: &'static InstrumentKind,
    /// Index of its instrument; the observables of one instrument share a variance factor.
    pub instrument: usize,
    /// Coordinate 0, 1 or 2 where the instrument reads three; 0 or 1 for the pixel u or v.
    pub axis: usize,
    /// Indices of the targets; the second counts for [`Reference::Target`] alone.
    pub targets: [usize; 2],
    /// Index of the fixture.
    pub fixture: Option<usize>,
    /// Point `a` of `F_0` near which a direction is measured, so that tilts and the zero are
    /// separable; the length unit.
    pub at: [f64; 3],
    /// Unit normal of a mirror, in the frame of the tool.
    pub mirror: [f64; 3],
    /// Corner of a board, in the frame of the board; the length unit.
    pub corner: [f64; 3],
    /// Offset of the reading from the observable; minus its radius for a sphere.
    pub zero: f64,
    /// The offset is known.
    pub zero_known: bool,
    /// Standard deviation of the reading; the length unit, rad for an angle, pixels for a camera.
    pub uncertainty: f64,
}

impl Observable {
    /// Returns whether the reading is the same for a machine whose lengths, fixtures and unknown
    /// zeros are all larger by the same share, except that its residual grows by that share.
    pub fn is_blind_to_size(&self) -> bool {
        !self.kind.is_angle
            && self.kind.is_touched()
            && (self.kind.size == SizeInformation::None || !self.zero_known)
    }
}

/// Value of an observable and its gradient, in the axes of `F_0`.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Evaluation {
    /// Value without the zero.
    pub(in super::super) value: f64,
    /// Gradient with respect to the position of the first target, or the rotation of the tool for
    /// an angle.
    ///
    /// The gradient with respect to the [reference](InstrumentKind::reference) is its negative.
    pub(in super::super) along: [f64; 3],
    /// Gradient with respect to the point or the unit direction of the fixture.
    pub(in super::super) by_fixture: [f64; 3],
    /// Point of the tool whose motion `along` refers to, in the frame of the instrument; the first
    /// target if none.
    pub(in super::super) at: Option<[f64; 3]>,
    /// Gradient with respect to the intrinsic parameters of the camera.
    pub(in super::super) by_intrinsics: [f64; INTRINSICS],
}

impl Evaluation {
    /// Nothing depends on anything.
    pub(super) const ZERO: Self = Self {
        value: 0.0,
        along: [0.0; 3],
        by_fixture: [0.0; 3],
        at: None,
        by_intrinsics: [0.0; INTRINSICS],
    };
}

impl InstrumentKind {
    /// An instrument that reads one length.
    pub(super) const LENGTH: Self = Self {
        name: "",
        reads: "",
        keys: &[],
        numbers: 1,
        is_angle: false,
        finds_position: false,
        sees_base: false,
        has_unknown_zero: false,
        reference: Reference::None,
        size: SizeInformation::Length,
        evaluate: |_, _| Evaluation::ZERO,
    };

    /// Returns whether its table in a map has a key.
    pub fn has(&self, key: &str) -> bool {
        self.keys.contains(&key)
    }

    /// Returns whether the machine is moved until it touches, so that only its joints are read.
    pub fn is_touched(&self) -> bool {
        !["column", "columns", "pixels"].iter().any(|key| self.has(key))
    }

    /// Returns the unit of a reading: rad for an angle, px for a camera, otherwise `length`.
    pub fn unit(&self, length: &'static str) -> &'static str {
        match self.is_angle {
            true => "rad",
            false if self.has("pixels") => "px",
            false => length,
        }
    }
}
