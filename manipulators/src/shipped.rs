//! The shipped files, for programs that read specs at run time.

use abbe::analysis::Sweepable;

/// A shipped manipulator.
#[derive(Clone, Copy)]
pub struct Shipped {
    /// Name of the manipulator.
    pub name: &'static str,
    /// Text of `specs/NAME.toml`.
    pub spec: &'static str,
    /// Text of `studies/NAME.toml`, if the manipulator has a study.
    pub study: Option<&'static str>,
    /// Generated code, with support for batches.
    pub compiled: &'static dyn Sweepable,
}

macro_rules! shipped {
    ($($name:ident: $type:ident $(with $study:ident)?),+ $(,)?) => {
        /// Every shipped manipulator, in alphabetical order.
        pub const SHIPPED: &[Shipped] = &[$(Shipped {
            name: stringify!($name),
            spec: include_str!(concat!("../specs/", stringify!($name), ".toml")),
            study: shipped!(@study $name $($study)?),
            compiled: &crate::$name::$type,
        }),+];
    };
    (@study $name:ident study) => {
        Some(include_str!(concat!("../studies/", stringify!($name), ".toml")))
    };
    (@study $name:ident) => {
        None
    };
}

shipped! {
    general6r: General6r,
    iiwa: Iiwa,
    machine3: Machine3,
    panda: Panda,
    pps: Pps with study,
    puma560: Puma560,
    scara: Scara,
    stanford: Stanford,
    ur5: Ur5,
    wam: Wam,
}

/// Shipped machines with closed loops, by name, in alphabetical order. They have no generated code
/// here, so that programs that use the others need not compile it.
pub const MECHANISMS: &[(&str, &str)] = &[
    ("delta", include_str!("../mechanisms/delta.toml")),
    ("hexapod", include_str!("../mechanisms/hexapod.toml")),
    ("palletizer", include_str!("../mechanisms/palletizer.toml")),
    ("pps_hexapod", include_str!("../mechanisms/pps_hexapod.toml")),
];

/// Studies beside those of [`SHIPPED`], by name: section 6 of the paper for `pps`.
pub const STUDIES: &[(&str, &str)] = &[("pps-section6", include_str!("../studies/pps-section6.toml"))];

/// Files that shipped studies name.
pub const STUDY_FILES: &[(&str, &str)] = &[("pps-section6.csv", include_str!("../studies/pps-section6.csv"))];

/// Maps of data files, by manipulator: `ur5` and `wam` for a public data set, `pps` for the
/// measurements described in the paper.
pub const MAPS: &[(&str, &str)] = &[
    ("pps", include_str!("../maps/pps.toml")),
    ("ur5", include_str!("../maps/ur5.toml")),
    ("wam", include_str!("../maps/wam.toml")),
];

/// Measurement plans (sets of configurations), by manipulator.
pub const PLANS: &[(&str, &str)] = &[("pps", include_str!("../plans/pps.toml"))];
