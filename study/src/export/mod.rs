//! `abbe export`: a machine with its repeatable errors in files that controllers and other programs
//! load. `abbe_exchange` has the formats.

mod options;

pub use self::options::{SAMPLES, SAMPLES_RANGE};
pub use abbe_exchange::export::{ExportReport as Report, ExportedFile, Figure, PoseDifference, RotaryAxis};
pub use abbe_exchange::urdf::Ends;
pub use abbe_exchange::{FORMATS, Format, FormatMismatch, Needs};

use abbe_exchange::export::RealMachine;
use abbe_spec::option::{NODES, TO_LINUXCNC_GENHEXKINS, TO_URDF};

use crate::{Machine, Notes, Result, finite, mistake, number::digits};

/// Job that writes a machine with its repeatable errors in another format.
#[derive(Clone)]
pub struct Export {
    /// Machine; its repeatable sources are its errors.
    pub machine: Machine,
    /// Format of the files.
    pub format: Format,
    /// Number of random configurations at which poses are compared.
    pub samples: usize,
    /// Seed of these configurations.
    pub seed: u64,
}

impl Export {
    /// Writes the files as text, reads them back and compares the poses of the tool. A table of
    /// corrections that makes its error larger is an error.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report> {
        let Self { machine: Machine { spec, origin, .. }, format, samples, seed } = self;
        if !matches!(format, Format::UrdfTree | Format::LinuxCncGenhexkins) {
            let instead = format!(
                "use `abbe compensate` for corrected commands, or `abbe generate` for code that corrects them in the \
                 controller; `{TO_URDF}` writes frames and loops, `{TO_LINUXCNC_GENHEXKINS}` six legs"
            );
            self.machine.require_chain("this format cannot hold the errors of this machine", &instead)?;
        }
        let mut machine = RealMachine::new(spec, self.machine.fixed_inputs(), *samples, *seed, origin)?;
        if machine.is_nominal() {
            notes.warn("this spec has no repeatable source: the nominal machine is exported");
        }
        let report = format.write(&mut machine, notes)?;
        let Report { before, remains, .. } = &report;
        if remains.position.rms > before.position.rms && !machine.is_nominal() {
            let [before, remains] = [before, remains].map(|difference| digits(difference.position.rms, 3));
            let message = format!(
                "the file would make the error of the tool larger: {remains} {unit} (rms) instead of {before} {unit}",
                unit = report.length
            );
            if let Format::Table { .. } = format {
                let help =
                    format!("give the table more nodes by `{NODES}`, or narrow the `limits` of the joints");
                return Err(mistake::with_help(origin, message, help));
            }
            notes.warn(&format!(
                "{message}; correct commands by `abbe compensate`, or in the controller by code of `abbe generate`"
            ));
        }
        finite(origin, report)
    }
}
