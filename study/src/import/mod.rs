//! Robots that are described in other formats, as specs.
//!
//! A format is read into a `chain` (`urdf`, `dh`), and the chain is `written` as a spec; both are evaluated at the same
//! configurations before anything is handed out.

mod almost;
mod chain;
pub(crate) mod described;
mod dh;
mod geometry;
mod placement;
mod urdf;
mod written;

use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;

use abbe::Manipulator;
use abbe::analysis::sampling;
use abbe_interpreter::Interpreter;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_spec::{DhConvention, Spec};
use serde::Serialize;

use self::almost::Almost;
use self::chain::Chain;
pub use self::dh::Units;
use self::urdf::Ends;
use crate::mistake;
use crate::notes::Notes;

/// At how many configurations the spec is held against the file.
const CONFIGURATIONS: usize = 100;

/// What the spec may differ from its file: rounding, per metre of the arm.
const ROUNDING: f64 = 1e-12;

/// What is the spec of this robot?
#[derive(Clone, Debug)]
pub struct Import {
    /// The file.
    pub file: PathBuf,
    /// What it is.
    pub format: Format,
    /// Whether angles that are multiples of 45° but for 1e-5 rad, as files have them that round, become such.
    pub round_angles: bool,
}

/// What a robot is described in.
#[derive(Clone, Debug)]
pub enum Format {
    /// URDF.
    Urdf {
        /// The link that is `F_0`; the root if not given.
        base: Option<String>,
        /// The link whose frame is the tool point; the only last one if not given.
        tip: Option<String>,
        /// Whether fixed joints are put into the frames that follow them; they are frames of their own if not.
        fold: bool,
    },
    /// A table of Denavit-Hartenberg numbers.
    Table {
        /// Which product of the four numbers a row is.
        convention: DhConvention,
        /// What its numbers are in where the table does not say it.
        units: Units,
    },
}

/// A spec, and what became of the robot in it.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The manipulator's name.
    pub manipulator: String,
    /// The unit of its lengths.
    pub length: &'static str,
    /// The link that is `F_0`, or `F_0`.
    pub base: String,
    /// The link whose frame is the tool point, or the last frame.
    pub tip: String,
    /// From base to tip.
    pub frames: Vec<ImportedFrame>,
    /// How many masses became loads.
    pub loads: usize,
    /// The largest difference of an entry of `A_T` between the file and the spec, in the spec's length unit and rad, at this many configurations.
    pub largest_difference: f64,
    /// How many.
    pub configurations: usize,
    /// The text of the spec.
    pub spec: String,
}

/// A frame of the spec.
#[derive(Clone, Debug, Serialize)]
pub struct ImportedFrame {
    /// Its name, which is that of its joint.
    pub joint: String,
    /// The link that it belongs to; a table of numbers has none.
    pub link: Option<String>,
    /// The variable that moves it; none of a fixed one.
    pub variable: Option<String>,
    /// Whether the variable is that of another joint.
    pub follows: bool,
}

impl Import {
    /// Reads the file and writes the spec.
    pub fn run(&self, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let is_table = self.file.extension().is_some_and(|ending| ending == "csv" || ending == "tsv");
        if is_table && matches!(self.format, Format::Urdf { .. }) {
            let message = "this is a table, and Denavit-Hartenberg numbers are written in two ways";
            let help = "say which: `--dh standard`, Rz(theta) Tz(d) Tx(a) Rx(alpha), or `--dh modified`, \
                        Rx(alpha) Tx(a) Rz(theta) Tz(d)";
            return Err(mistake::with_help(self.file.display(), message, help));
        }
        self.read(Document::read(&self.file)?, notes)
    }

    /// Writes the spec of a text; `file` is what the spec calls it.
    pub fn read(&self, mut document: Document, notes: &mut dyn Notes) -> Result<Report, Diagnostics> {
        let mut almost = Almost::new(self.round_angles);
        let chain = match &self.format {
            Format::Urdf { base, tip, fold } => {
                let ends = Ends { base: base.clone(), tip: tip.clone() };
                urdf::chain(&mut document, &ends, *fold, &mut almost, notes)
            }
            Format::Table { convention, units } => {
                dh::chain(&mut document, *convention, *units, &mut almost, notes)
            }
        };
        let chain = document.finish(chain)?;
        almost.note(notes);
        for variable in chain.variables.iter().filter(|one| one.limits.is_none() && !one.continuous) {
            notes.warn(&format!(
                "the joint `{}` has no limits: add `limits` to its variable, so that a workspace is known",
                variable.joint
            ));
        }
        let origin = self.file.file_name().unwrap_or_default().to_string_lossy();
        let text = written::spec(&chain, &origin);
        let spec = Spec::parse(&format!("{origin}, as a spec"), &text)?;
        let largest_difference = difference(&chain, spec.clone())?;
        let frame = |frame: &chain::Frame| {
            let variable = frame.motion.map(|motion| &chain.variables[motion.variable]);
            ImportedFrame {
                joint: frame.joint.clone(),
                link: frame.link.clone(),
                variable: variable.map(|variable| variable.name.clone()),
                follows: variable.is_some_and(|variable| variable.joint != frame.joint),
            }
        };
        Ok(Report {
            manipulator: spec.name.clone(),
            length: chain.length.symbol(),
            base: chain.base.clone(),
            tip: chain.tip.clone(),
            frames: chain.frames.iter().map(frame).collect(),
            loads: chain.masses.len(),
            largest_difference,
            configurations: CONFIGURATIONS,
            spec: text,
        })
    }
}

/// The largest difference between the poses of a chain and those of its spec; more than rounding is an error.
fn difference(chain: &Chain, spec: Spec) -> Result<f64, Diagnostics> {
    let interpreter = Interpreter::new(Arc::new(spec));
    let description = interpreter.description();
    let s = sampling::nominal_parameters(description);
    let mut largest = 0.0_f64;
    for k in 1..=CONFIGURATIONS {
        // Multiples of square roots fill the ranges evenly; the spec's variables stand in an order of their own.
        let fraction = |v: usize| (k as f64 * (v as f64 + 2.0).sqrt()).fract();
        let value = |v: usize| {
            let [lower, upper] = chain.variables[v].limits.unwrap_or([-PI, PI]);
            lower + (upper - lower) * fraction(v)
        };
        let q: Vec<f64> = (0..chain.variables.len()).map(value).collect();
        let number = |name: &str| chain.variables.iter().position(|variable| variable.name == name);
        let ordered: Vec<f64> = description
            .variables
            .iter()
            .filter_map(|variable| number(&variable.name))
            .map(|v| q[v])
            .collect();
        let pose =
            interpreter.pose(&ordered, &s).map_err(|error| mistake::whole("the written spec", &error))?;
        let expected = chain.pose(&q).to_homogeneous();
        for (i, row) in pose.rows().iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                largest = largest.max((entry - expected[(i, j)]).abs());
            }
        }
    }
    let reach = 1.0 + chain.frames.iter().map(|frame| frame.geometry.size()).sum::<f64>();
    if largest > ROUNDING * reach {
        let message = format!("the written spec differs from the file by {largest:.1e}");
        return Err(mistake::with_help(
            "abbe import",
            message,
            "this is a mistake of abbe: please report the file",
        ));
    }
    Ok(largest)
}
