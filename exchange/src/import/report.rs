//! Spec of an imported chain, compared with the file.

use std::sync::Arc;

use abbe::{Manipulator, analysis::sampling};
use abbe_interpreter::Interpreter;
use abbe_spec::{Diagnostics, Notes, Spec, mistake};
use serde::Serialize;

use super::chain::{CONFIGURATIONS, Chain, Frame};
use super::spec_writer;

/// Largest difference that is rounding, per unit of length of the arm.
const ROUNDING: f64 = 1e-12;

/// Spec of an imported robot.
#[derive(Clone, Debug, Serialize)]
pub struct ImportReport {
    /// Name of the manipulator.
    pub manipulator: String,
    /// Unit of lengths.
    pub length: &'static str,
    /// Link that is `F_0`, or `F_0`.
    pub base: String,
    /// Link whose frame is the tool point, or the last frame.
    pub tip: String,
    /// Frames from base to tip.
    pub frames: Vec<ImportedFrame>,
    /// Number of masses that became loads.
    pub loads: usize,
    /// Largest difference of an entry of `A_T` between the file and the spec, in the unit of length
    /// of the spec and rad.
    pub largest_difference: f64,
    /// Number of configurations that were compared.
    pub configurations: usize,
    /// Text of the spec.
    pub spec: String,
}

/// Frame of an imported spec.
#[derive(Clone, Debug, Serialize)]
pub struct ImportedFrame {
    /// Name of the frame, which is that of its joint.
    pub joint: String,
    /// Link that the frame belongs to; tables of numbers have none.
    pub link: Option<String>,
    /// Variable that moves the frame; `None` for a fixed one.
    pub variable: Option<String>,
    /// The variable belongs to another joint.
    pub follows: bool,
}

impl ImportReport {
    /// Writes the spec of a chain; `file` is the name of the file in its description.
    ///
    /// Warns about joints without limits.
    ///
    /// # Errors
    ///
    /// The text is not a valid spec, or its poses differ from those of the chain by more than
    /// rounding.
    pub fn new(chain: &Chain, file: &str, notes: &mut dyn Notes) -> Result<Self, Diagnostics> {
        for variable in chain.variables.iter().filter(|one| one.limits.is_none() && !one.continuous) {
            notes.warn(&format!(
                "the joint `{}` has no limits: add `limits` to its variable to define a workspace",
                variable.joint
            ));
        }
        let text = spec_writer::spec(chain, file);
        let spec = Spec::parse(&format!("{file}, as a spec"), &text)?;
        let manipulator = spec.name.clone();
        let frame = |frame: &Frame| {
            let variable = frame.motion.map(|motion| &chain.variables[motion.variable]);
            ImportedFrame {
                joint: frame.joint.clone(),
                link: frame.link.clone(),
                variable: variable.map(|variable| variable.name.clone()),
                follows: variable.is_some_and(|variable| variable.joint != frame.joint),
            }
        };
        Ok(Self {
            manipulator,
            length: chain.length.symbol(),
            base: chain.base.clone(),
            tip: chain.tip.clone(),
            frames: chain.frames.iter().map(frame).collect(),
            loads: chain.masses.len(),
            largest_difference: largest_difference(chain, spec)?,
            configurations: CONFIGURATIONS,
            spec: text,
        })
    }
}

/// Returns the largest difference between an entry of the poses of a chain and of its spec; more
/// than rounding is an error.
fn largest_difference(chain: &Chain, spec: Spec) -> Result<f64, Diagnostics> {
    let interpreter = Interpreter::new(Arc::new(spec));
    let description = interpreter.description();
    let s = sampling::nominal_parameters(description);
    let mut largest = 0.0_f64;
    for k in 1..=CONFIGURATIONS {
        let q = chain.sample(k);
        // The variables of the spec have an order of their own.
        let index = |name: &str| chain.variables.iter().position(|variable| variable.name == name);
        let ordered: Vec<f64> =
            description.variables.iter().filter_map(|variable| index(&variable.name)).map(|v| q[v]).collect();
        let pose =
            interpreter.pose(&ordered, &s).map_err(|error| mistake::whole("the written spec", &error))?;
        let expected = chain.pose(&q).to_homogeneous();
        for (i, row) in pose.rows().iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                largest = largest.max((entry - expected[(i, j)]).abs());
            }
        }
    }
    // Rounding grows with the travels of slides and with the turns of joints.
    let farthest = |prismatic: bool| {
        let some = chain.variables.iter().filter(move |one| one.prismatic == prismatic);
        some.filter_map(|one| one.limits).map(|[lower, upper]| lower.abs().max(upper.abs()))
    };
    let lengths = chain.frames.iter().map(|frame| frame.geometry.size());
    let reach = 1.0 + lengths.chain(farthest(true)).sum::<f64>();
    if largest > ROUNDING * reach * farthest(false).fold(1.0, f64::max) {
        let message = format!("the written spec differs from the file by {largest:.1e}");
        let help = "this is an error in abbe: please report it with the file";
        return Err(mistake::with_help("abbe import", message, help));
    }
    Ok(largest)
}
