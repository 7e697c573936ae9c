//! Formats of an export, and the options of their tables.

use std::ops::RangeInclusive;
use std::path::PathBuf;

/// Default number of configurations at which poses are compared.
pub const SAMPLES: usize = 1000;

/// Range of that number.
pub const SAMPLES_RANGE: RangeInclusive<usize> = 1..=1_000_000;

/// Format of an export.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Format {
    /// Table of Denavit-Hartenberg numbers, CSV.
    Dh,
    /// URDF file with the origins of the real robot.
    Urdf {
        /// File of the nominal robot.
        file: PathBuf,
        /// Link that is `F_0`; the root if not given.
        base: Option<String>,
        /// Link whose frame is the tool point; the only link without a child if not given.
        tip: Option<String>,
    },
    /// Calibration of an arm of Universal Robots, YAML.
    UrCalibration,
    /// Tables of volumetric compensation of TwinCAT CNC and the ISG kernel.
    IsgCsv {
        /// Number of values of each axis.
        nodes: usize,
    },
    /// Rows of HEIDENHAIN's KinematicsComp, and a table for each linear axis.
    KinematicsComp {
        /// Number of values of each axis.
        nodes: usize,
    },
    /// Compensation files of LinuxCNC, one for each axis.
    LinuxCnc {
        /// Number of values of each axis.
        nodes: usize,
        /// The matrix of `matrixkins` comes before the files.
        has_matrix: bool,
    },
    /// Corrections of the joints on a grid.
    Table {
        /// Number of values of each joint; by default about 10,000 nodes in all.
        nodes: Option<usize>,
    },
}

impl Format {
    /// Names of all formats.
    pub const NAMES: [&str; 8] = [
        "dh",
        "urdf",
        "ur-calibration",
        "isg-csv",
        "kinematics-comp",
        "linuxcnc",
        "linuxcnc-matrixkins",
        "table",
    ];

    /// Default number of values of a table over one axis.
    pub const NODES: usize = 101;

    /// Range of the number of values of an axis or joint.
    pub const NODES_RANGE: RangeInclusive<usize> = 2..=1_000_000;

    /// Names of the formats with nodes.
    pub const WITH_NODES: [&str; 5] =
        ["isg-csv", "kinematics-comp", "linuxcnc", "linuxcnc-matrixkins", "table"];
}
