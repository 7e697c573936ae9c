//! Families of richer terms that a user can request.

/// Family of terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Errors of joints, and errors of frames that depend on their own joint: one to four periods
    /// per turn, or in proportion to travel, its square and its cube.
    Joint,
    /// Errors of joints, parameters and frames in proportion to an input, such as a load, a
    /// temperature or a motor current.
    Load,
    /// Rotational errors of base and frames in proportion to the moment of the loads of the spec,
    /// or of 1 kg at the tool point. Diagonal compliances come first, then off-diagonal entries.
    Elastic,
    /// Errors of joints that depend on the direction of approach, row by row, or on the direction
    /// of the gravity moment.
    Backlash,
    /// Errors of joints that depend on another joint, or on two.
    Product,
    /// Errors of frames that drift or settle from row to row.
    Drift,
    /// Errors of joints as functions of their own values, by up to 64 cycles per turn.
    Profile,
}

impl Family {
    /// Every family.
    pub const ALL: [Self; 7] =
        [Self::Joint, Self::Load, Self::Elastic, Self::Backlash, Self::Product, Self::Drift, Self::Profile];
}

/// Additional numbers of periods per turn of a joint, beside 1 to 4, such as gear ratios.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Harmonics {
    /// Index of the joint.
    pub variable: usize,
    /// Numbers of periods per turn.
    pub times: Vec<u16>,
}
