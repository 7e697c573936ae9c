//! The families of richer terms that can be asked for.

/// A family of terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Errors of joints, and of frames with their own joint: one to four times per turn, or in proportion to its travel, its
    /// square and its cube.
    Joint,
    /// Errors of joints, parameters and frames in proportion to an input: to a load, a temperature, a motor's current.
    Load,
    /// Turns of base and frames in proportion to the moment that the loads of the spec, or the weight of 1 kg at the tool
    /// point, have about them: each about its own axis, then what couples the axes.
    Elastic,
    /// Errors of joints by the direction from which they came, row by row, or in which a weight pulls at them.
    Backlash,
    /// Errors of joints with another joint, or with two.
    Product,
    /// Errors of frames that grow or settle from row to row.
    Drift,
}

impl Family {
    /// All.
    pub const ALL: [Self; 6] =
        [Self::Joint, Self::Load, Self::Elastic, Self::Backlash, Self::Product, Self::Drift];
}

/// How often per turn of a joint errors are looked for, beside 1 to 4: gear ratios.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Harmonics {
    /// The joint.
    pub variable: usize,
    /// So many times per turn.
    pub times: Vec<u16>,
}
