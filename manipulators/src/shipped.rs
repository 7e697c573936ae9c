//! The files themselves, for programs that read specs at run time.

use abbe::analysis::Sweepable;

/// A shipped manipulator.
#[derive(Clone, Copy)]
pub struct Shipped {
    /// Its name.
    pub name: &'static str,
    /// The text of `specs/NAME.toml`.
    pub spec: &'static str,
    /// The text of `studies/NAME.toml`, if it has a study of its own.
    pub study: Option<&'static str>,
    /// Its generated code, with the lanes that sweeps need.
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

/// Maps of data files to the manipulators of the same name: what their columns are. Of `ur5` and `wam` for a public
/// data set, of `pps` for the measurements that the paper describes.
pub const MAPS: &[(&str, &str)] = &[
    ("pps", include_str!("../maps/pps.toml")),
    ("ur5", include_str!("../maps/ur5.toml")),
    ("wam", include_str!("../maps/wam.toml")),
];

/// Plans of measurements of the manipulators of the same name: sets of configurations.
pub const PLANS: &[(&str, &str)] = &[("pps", include_str!("../plans/pps.toml"))];
