//! Report of an export: the files, and how good they are.

use std::fmt::Display;

use abbe::Pose;
use abbe_spec::{Diagnostics, mistake, number::digits};
use serde::Serialize;

use super::{PoseDifference, RealMachine, RotaryAxis};
use crate::Result;

/// Change of a number, in any unit, below which it is rounding.
pub(crate) const UNCHANGED: f64 = 1e-12;

/// Decimals of a length or an angle in a file of full precision.
pub(crate) const DECIMALS: usize = 15;

/// Text of one file.
#[derive(Clone, Debug, Serialize)]
pub struct ExportedFile {
    /// File name without a folder.
    pub name: String,
    /// Complete text.
    pub text: String,
}

/// Files in another format, and the differences between poses with and without them.
#[derive(Clone, Debug, Serialize)]
pub struct ExportReport {
    /// Name of the machine.
    pub name: String,
    /// Name of the format and its variant.
    pub format: String,
    /// Unit of length of the differences.
    pub length: &'static str,
    /// The file, or several files that belong together.
    pub files: Vec<ExportedFile>,
    /// Changes in a file that was given, as hunks of a diff.
    pub changes: Vec<String>,
    /// Sentences about the errors that the format cannot hold.
    pub left_out: Vec<String>,
    /// Names of the differences `before` and `remains`.
    pub compared: [&'static str; 2],
    /// Difference without the files.
    pub before: PoseDifference,
    /// Difference with the files at the nodes of a table; `remains` is between the nodes.
    pub at_nodes: Option<PoseDifference>,
    /// Difference with the files.
    pub remains: PoseDifference,
    /// Difference with the files and with rotary axes of the workpiece placed in the control;
    /// `None` without such axes.
    pub placed: Option<PoseDifference>,
    /// Rotary axes of the workpiece.
    pub turned: Vec<RotaryAxis>,
    /// Number of random configurations of the differences.
    pub configurations: usize,
    /// Seed of the configurations.
    pub seed: u64,
    /// Sentence that explains the sign by a number of this machine.
    pub sign: String,
}

impl ExportReport {
    /// Reports a format that holds a model: compares the pose of the tool by `model` with the real
    /// one. The sentence about the sign is left to the format.
    pub(crate) fn for_model(
        machine: &RealMachine,
        format: String,
        files: Vec<ExportedFile>,
        model: impl Fn(&[f64]) -> Pose,
    ) -> Self {
        Self::new(machine, format, files, machine.model_difference(model))
    }

    /// Reports a format that corrects commands: compares the real pose of the tool at commands
    /// corrected for a configuration and its inputs with the nominal one. An empty `sign` says that
    /// no number differs from 0.
    pub(crate) fn for_commands(
        machine: &RealMachine,
        format: String,
        files: Vec<ExportedFile>,
        corrected: impl Fn(&[f64], &[f64]) -> Vec<f64>,
        sign: String,
    ) -> Result<Self> {
        let remains = machine.command_difference(|q, u| Ok(corrected(q, u)));
        let remains = remains.map_err(|error| mistake::whole(&machine.origin, &error))?;
        let sign = if sign.is_empty() { "All errors are 0.".to_owned() } else { sign };
        let compared = ["as commanded", "corrected"];
        Ok(Self { compared, sign, ..Self::new(machine, format, files, remains) })
    }

    /// Reports a format that holds the machine with its mean errors, loops closed: compares its
    /// tool with the real one.
    pub(crate) fn for_mean(machine: &RealMachine, format: &str, files: Vec<ExportedFile>) -> Result<Self> {
        if machine.mean.dh_numbers.iter().any(|errors| *errors != [0.0; 4]) {
            let message = "this format takes no errors of Denavit-Hartenberg numbers";
            return Err(mistake::with_help(&machine.origin, message, "give errors e_x … e_p of the frame"));
        }
        let model = |q: &[f64]| machine.mean_tool(q).unwrap_or(Pose([[f64::NAN; 3]; 4]));
        let report = Self::for_model(machine, format.to_owned(), files, model);
        let sign = format!(
            "The numbers are those of the real machine, whose tool is up to {} {} from that of the nominal \
             one: do not subtract anything from them.",
            digits(report.before.position.largest, 4),
            report.length
        );
        Ok(Self { sign, left_out: machine.held_at_mean().into_iter().collect(), ..report })
    }

    fn new(machine: &RealMachine, format: String, files: Vec<ExportedFile>, remains: PoseDifference) -> Self {
        let pairs = machine.ideal.iter().zip(&machine.real);
        Self {
            name: machine.spec.name.clone(),
            format,
            length: machine.spec.length.symbol(),
            files,
            changes: Vec::new(),
            left_out: Vec::new(),
            compared: ["nominal", "exported"],
            before: PoseDifference::new(pairs.map(|(ideal, real)| [*ideal, *real])),
            at_nodes: None,
            remains,
            placed: None,
            turned: Vec::new(),
            configurations: machine.samples,
            seed: machine.seed,
            sign: String::new(),
        }
    }
}

/// Returns the diagnostics of a text that cannot be read back.
pub(crate) fn unreadable(message: impl Display) -> Diagnostics {
    mistake::with_help("abbe export", message, "this is an error in abbe: please report it with the spec")
}

/// Returns the sentence about the sign where no number changes.
pub(crate) fn nominal_sign() -> String {
    "The machine has no errors: the numbers are nominal.".to_owned()
}

/// Rounds a number to the decimals that a file has.
pub(crate) fn rounded(value: f64, decimals: usize) -> f64 {
    format!("{value:.decimals$}").parse::<f64>().unwrap_or(value) + 0.0
}
