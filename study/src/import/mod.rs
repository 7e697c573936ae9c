//! `abbe import`: a robot in another format as a spec. `abbe_exchange` has the formats.

mod options;

pub use self::options::{Format, Units};
pub use abbe_exchange::import::{ImportReport as Report, ImportedFrame};

use std::path::PathBuf;

use abbe_exchange::{dh, import::AngleRounding, urdf};
use abbe_spec::Document;
use abbe_spec::option::{DH_MODIFIED, DH_STANDARD};

use crate::{Notes, Result, mistake};

/// Job that writes the spec of a robot in another format.
#[derive(Clone, Debug)]
pub struct Import {
    /// File of the robot.
    pub file: PathBuf,
    /// Format of the file.
    pub format: Format,
    /// Rounds angles within 1e-5 rad of a multiple of 45° to that multiple.
    pub round_angles: bool,
}

impl Import {
    /// Reads the file and writes the spec.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let is_table = self.file.extension().is_some_and(|ending| ending == "csv" || ending == "tsv");
        if is_table && matches!(self.format, Format::Urdf { .. }) {
            let message = "the convention of these Denavit-Hartenberg numbers is unknown";
            let help = format!(
                "give it: `{DH_STANDARD}`, Rz(theta) Tz(d) Tx(a) Rx(alpha), or `{DH_MODIFIED}`, Rx(alpha) \
                 Tx(a) Rz(theta) Tz(d)"
            );
            return Err(mistake::with_help(self.file.display(), message, help));
        }
        self.read(Document::read(&self.file)?, notes)
    }

    /// Writes the spec of a text; the spec names [`file`](Self::file) as its origin.
    pub fn read(&self, document: Document, notes: &mut dyn Notes) -> Result<Report> {
        let read = |angles: &mut AngleRounding, notes: &mut dyn Notes| match &self.format {
            Format::Urdf { base, tip, fold } => {
                let ends = urdf::Ends { base: base.clone(), tip: tip.clone() };
                urdf::read(&document, &ends, *fold, angles, notes)
            }
            Format::Table { convention, units } => dh::read(&document, *convention, *units, angles, notes),
        };
        let mut angles = AngleRounding::new(self.round_angles);
        let chain = read(&mut angles, notes);
        let as_meant = chain.as_ref().and_then(|_| read(&mut angles.as_meant()?, &mut ()));
        let chain = document.finish(chain)?;
        let shift = as_meant.map_or(0.0, |other| chain.largest_shift(&other));
        angles.note(shift, notes);
        Report::new(&chain, &self.file.file_name().unwrap_or_default().to_string_lossy(), notes)
    }
}
