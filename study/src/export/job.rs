//! Job of `abbe export`.

use std::path::PathBuf;

use abbe_exchange::export::RealMachine;
use abbe_exchange::{dh, isg_csv, joint_corrections, kinematics_comp, linuxcnc, ur_calibration, urdf};
use abbe_spec::diagnostic::Diagnostics;

use super::Report;
use super::options::Format;
use crate::finite;
use crate::machine::Machine;
use crate::notes::Notes;
use crate::number::digits;

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
    /// Writes the files as text, reads them back and compares the poses of the tool.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let Self { machine: Machine { spec, origin, .. }, format, samples, seed } = self;
        self.machine.require_chain(
            "no format can hold the errors of this machine",
            "use `abbe compensate` for corrected commands, or `abbe generate` for code that corrects them in the \
             controller",
        )?;
        let mut machine = RealMachine::new(spec, self.machine.fixed_inputs(), *samples, *seed, origin)?;
        if machine.is_nominal() {
            notes.warn("this spec has no repeatable source: the nominal machine is exported");
        }
        let report = match format {
            Format::Dh => dh::write(&machine)?,
            Format::Urdf { file, base, tip } => {
                urdf::write(&machine, file, &urdf::Ends { base: base.clone(), tip: tip.clone() })?
            }
            Format::UrCalibration => ur_calibration::write(&machine)?,
            Format::IsgCsv { nodes } => isg_csv::write(&machine, *nodes)?,
            Format::KinematicsComp { nodes } => kinematics_comp::write(&machine, *nodes)?,
            Format::LinuxCnc { nodes, has_matrix } => linuxcnc::write(&mut machine, *nodes, *has_matrix)?,
            Format::Table { nodes } => joint_corrections::write(&machine, *nodes, notes)?,
        };
        let Report { before, remains, .. } = &report;
        if remains.position.rms > before.position.rms && !machine.is_nominal() {
            let [before, remains] = [before, remains].map(|difference| digits(difference.position.rms, 3));
            notes.warn(&format!(
                "the exported file makes the error of the tool larger, {remains} {unit} instead \
                 of {before} {unit} (rms): do not use it; increase the number of nodes, or narrow \
                 the `limits` of the joints",
                unit = report.length
            ));
        }
        finite(origin, report)
    }

    /// Returns the files that the job reads besides the spec.
    pub(crate) fn beside(&self) -> Vec<PathBuf> {
        match &self.format {
            Format::Urdf { file, .. } => vec![file.clone()],
            _ => Vec::new(),
        }
    }
}
