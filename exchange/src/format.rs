//! Table of all formats, and the choice of one to write.

use std::{ops::RangeInclusive, path::PathBuf};

use abbe_spec::Notes;

use crate::export::{ExportReport, RealMachine};
use crate::urdf::Ends;
use crate::{Result, dh, isg_csv, joint_corrections, kinematics_comp, linuxcnc, ur_calibration, urdf};

/// Entry of the table of formats.
#[derive(Clone, Copy, Debug)]
pub struct FileFormat {
    /// Name by which it is chosen.
    pub name: &'static str,
    /// Description for help and documents.
    pub title: &'static str,
    /// Argument of its writer beside the machine.
    pub needs: Needs,
}

/// Argument of a writer beside the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Nothing.
    Nothing,
    /// The URDF file of the nominal robot, or nothing.
    NominalRobot,
    /// The number of nodes of its tables.
    Nodes,
}

/// All formats.
pub const FORMATS: [FileFormat; 9] = {
    use Needs::{Nodes, NominalRobot, Nothing};
    const fn format(name: &'static str, title: &'static str, needs: Needs) -> FileFormat {
        FileFormat { name, title, needs }
    }
    [
        format("dh", "table of Denavit-Hartenberg numbers, CSV", Nothing),
        format(
            "urdf",
            "URDF of the frames, with a file of its loops, or a corrected copy of the URDF of the nominal robot",
            NominalRobot,
        ),
        format("ur-calibration", "calibration of an arm of Universal Robots, YAML", Nothing),
        format("isg-csv", "volumetric compensation of TwinCAT CNC and the ISG kernel, CSV", Nodes),
        format("kinematics-comp", "rows and tables of HEIDENHAIN's KinematicsComp", Nodes),
        format("linuxcnc", "compensation files of LinuxCNC, one for each axis", Nodes),
        format("linuxcnc-matrixkins", "the same files, and the matrix of `matrixkins`", Nodes),
        format("linuxcnc-genhexkins", "six legs of LinuxCNC's kinematics `genhexkins`, HAL", Nothing),
        format("table", "corrections of the joints on a grid, CSV", Nodes),
    ]
};

/// Format to write, with what its writer needs.
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
    /// URDF of the frames, and a file of the loops.
    UrdfTree,
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
    /// Parameters of LinuxCNC's kinematics `genhexkins`.
    LinuxCncGenhexkins,
    /// Corrections of the joints on a grid.
    Table {
        /// Number of values of each joint; by default about 10,000 nodes in all.
        nodes: Option<usize>,
    },
}

/// Reason why no format is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormatMismatch {
    /// No format has this name.
    Unknown,
    /// The format has no use for a URDF file or its links.
    NeedlessRobot,
    /// The format has no use for a number of nodes.
    NeedlessNodes,
}

impl Format {
    /// Default number of values of a table over one axis.
    pub const NODES: usize = 101;

    /// Range of the number of values of an axis or joint.
    pub const NODES_RANGE: RangeInclusive<usize> = 2..=1_000_000;

    /// Returns the names of all formats.
    pub fn names() -> impl Iterator<Item = &'static str> {
        FORMATS.iter().map(|format| format.name)
    }

    /// Chooses the format with a name; `robot` is the URDF file of the nominal robot, `ends` are
    /// links of it.
    ///
    /// # Errors
    ///
    /// There is no such format, or what it needs is missing, or what is given is not for it.
    pub fn choose(
        name: &str,
        robot: Option<PathBuf>,
        Ends { base, tip }: Ends,
        nodes: Option<usize>,
    ) -> Result<Self, FormatMismatch> {
        let format = FORMATS.iter().find(|format| format.name == name).ok_or(FormatMismatch::Unknown)?;
        let are_ends_given = base.is_some() || tip.is_some();
        let is_needless = robot.as_ref().map_or(are_ends_given, |_| format.needs != Needs::NominalRobot);
        if is_needless {
            return Err(FormatMismatch::NeedlessRobot);
        }
        if format.needs != Needs::Nodes && nodes.is_some() {
            return Err(FormatMismatch::NeedlessNodes);
        }
        let of_axis = nodes.unwrap_or(Self::NODES);
        Ok(match name {
            "dh" => Self::Dh,
            "urdf" => robot.map_or(Self::UrdfTree, |file| Self::Urdf { file, base, tip }),
            "ur-calibration" => Self::UrCalibration,
            "isg-csv" => Self::IsgCsv { nodes: of_axis },
            "kinematics-comp" => Self::KinematicsComp { nodes: of_axis },
            "linuxcnc" => Self::LinuxCnc { nodes: of_axis, has_matrix: false },
            "linuxcnc-matrixkins" => Self::LinuxCnc { nodes: of_axis, has_matrix: true },
            "linuxcnc-genhexkins" => Self::LinuxCncGenhexkins,
            _ => Self::Table { nodes },
        })
    }

    /// Writes a machine in this format.
    ///
    /// # Errors
    ///
    /// The format cannot hold the machine, or `notes` stop the job.
    pub fn write(&self, machine: &mut RealMachine, notes: &mut dyn Notes) -> Result<ExportReport> {
        match self {
            Self::Dh => dh::write(machine),
            Self::Urdf { file, base, tip } => {
                urdf::write(machine, file, &Ends { base: base.clone(), tip: tip.clone() })
            }
            Self::UrdfTree => urdf::write_tree(machine),
            Self::UrCalibration => ur_calibration::write(machine),
            Self::IsgCsv { nodes } => isg_csv::write(machine, *nodes),
            Self::KinematicsComp { nodes } => kinematics_comp::write(machine, *nodes),
            Self::LinuxCnc { nodes, has_matrix } => linuxcnc::write(machine, *nodes, *has_matrix),
            Self::LinuxCncGenhexkins => linuxcnc::write_genhexkins(machine),
            Self::Table { nodes } => joint_corrections::write(machine, *nodes, notes),
        }
    }
}
