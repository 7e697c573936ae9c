//! Manipulators in the formats of other programs: read as specs, and written with their identified
//! errors.
//!
//! [`FORMATS`] is the table of them, from which command, Python and documents take their names; a
//! [`Format`] is the choice of one. Each has a file or folder here.
//!
//! A **reader** is a function `read` from a document to a [`Chain`](import::Chain), which
//! [`ImportReport`](import::ImportReport) writes as a spec. A **writer** is a function `write` from
//! a [`RealMachine`](export::RealMachine) to an [`ExportReport`](export::ExportReport): the files,
//! what the format cannot hold, and the difference that remains when the files are read back. Both
//! must prove themselves: the spec is compared with the file, the file with the machine. Formats
//! share [`import`], [`export`] and `placement`, and do not know each other, but that the
//! calibration of Universal Robots starts from the nominal Denavit-Hartenberg numbers.
//!
//! ```
//! use abbe_exchange::dh;
//! use abbe_exchange::import::{AngleRounding, ImportReport};
//! use abbe_spec::DhConvention;
//! use abbe_spec::document::Document;
//!
//! let text = "joint,theta,d (mm),a (mm),alpha\nshoulder,0,0,400,0\nelbow,0,0,250,0\n";
//! let document = Document::new("scara.csv", text);
//! let (units, mut angles) = ("rad".parse()?, AngleRounding::new(false));
//! let chain = dh::read(&document, DhConvention::Standard, units, &mut angles, &mut ());
//! let report = ImportReport::new(&document.finish(chain)?, "scara.csv", &mut ())?;
//! assert_eq!(report.frames[1].variable.as_deref(), Some("elbow"));
//! assert!(report.largest_difference < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod dh;
pub mod export;
pub mod import;
pub mod isg_csv;
pub mod joint_corrections;
pub mod kinematics_comp;
pub mod linuxcnc;
pub mod ur_calibration;
pub mod urdf;

mod format;
mod placement;

pub use format::{FORMATS, FileFormat, Format, FormatMismatch, Needs};

/// Result of an export.
type Result<T, E = abbe_spec::Diagnostics> = std::result::Result<T, E>;
