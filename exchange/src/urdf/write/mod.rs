//! Writes the origins of the joints of the real robot into the URDF file of the nominal one, or a
//! `tree` of its own.

mod edit;
mod tree;

use abbe_spec::option::{BASE, BASE_LINK, TIP, TIP_LINK};
use std::path::Path;

use abbe::{Manipulator, Pose, VariableKind, analysis::sampling};
use abbe_spec::number::{digits, length};
use abbe_spec::{Diagnostics, Document, mistake};

use self::edit::{Edited, NewOrigin, three};
pub use self::tree::write_tree;
use super::{nominal::NominalChain, read::Ends};
use crate::export::origins::{Joint, origins};
use crate::export::report::{UNCHANGED, nominal_sign};
use crate::export::{ExportReport, ExportedFile, PoseDifference, RealMachine};
use crate::placement::placed;

/// Largest difference between the nominal poses of spec and file, relative to the reach: catalogue
/// numbers differ.
const SAME_ROBOT: f64 = 2e-3;

/// Writes a copy of the URDF file of the nominal robot with the origins of the real one.
///
/// # Errors
///
/// The file cannot be read, or the chain between the links `ends` is not that of the machine.
pub fn write(machine: &RealMachine, file: &Path, ends: &Ends) -> Result<ExportReport, Diagnostics> {
    let document = Document::read(file)?;
    let text = document.text.to_string();
    let nominal = NominalChain::read(&document, ends);
    let nominal = document.finish(nominal)?;
    let model = Model::new(machine, &nominal, file)?;
    let refused = |error| mistake::whole(&machine.origin, &error);
    let new = origins(machine, &model.joints, &model.tool).map_err(refused)?;
    let metres = machine.spec.length.in_metres();
    let joints = nominal.joints();
    let new_origins: Vec<NewOrigin> = joints
        .iter()
        .zip(&new)
        .map(|(joint, new)| NewOrigin {
            name: &joint.name,
            xyz: joint.xyz,
            rpy: joint.rpy,
            new: scaled(new, metres),
        })
        .collect();
    let Edited { text, changes } = edit::edit(&text, &new_origins);
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let document = Document::new(&name, text.as_str());
    let read = NominalChain::read(&document, ends);
    let read = document.finish(read)?;
    let mut left_out: Vec<String> = machine.held_at_mean().into_iter().collect();
    if joints.last().is_some_and(|joint| joint.axis.is_some()) {
        left_out.push(format!(
            "The last link is the child of a moving joint, so the file has no origin after it: of \
             the errors there it holds the rotation about the joint axis and the translation \
             along it. To represent all, choose with `{TIP}` a link that is fixed to the last one."
        ));
    }
    left_out.push(
        "Shapes, masses and branches beside the chain stay unchanged relative to their links.".to_owned(),
    );
    let most = new_origins.iter().map(|one| (one.distance(), one)).max_by(|a, b| a.0.total_cmp(&b.0));
    let most = most.filter(|(distance, _)| *distance > UNCHANGED);
    let sign = most.map_or_else(nominal_sign, |(distance, one)| {
        let [old, new] = [one.xyz, one.new.position()];
        let axis = (0..3).max_by(|a, b| (new[*a] - old[*a]).abs().total_cmp(&(new[*b] - old[*b]).abs()));
        let axis = axis.unwrap_or_default();
        format!(
            "The file holds the origins of the real robot, which replace the nominal ones: the \
             joint {} is at {} = {} m; in the original file it was at {} m. The distance between \
             both is {} mm; do not subtract anything from it.",
            one.name,
            ["x", "y", "z"][axis],
            digits(new[axis], 8),
            digits(old[axis], 8),
            digits(1e3 * distance, 4),
        )
    });
    let format = format!("URDF, {} of {} origins changed", changes.len(), joints.len());
    let files = vec![ExportedFile { name, text }];
    let report = ExportReport::for_model(machine, format, files, |q| model.tool(&read, q));
    Ok(ExportReport { changes, left_out, sign, ..report })
}

/// Chain of the file, matched with that of the spec.
struct Model {
    joints: Vec<Joint>,
    /// Index in the spec of each variable of the file, and the factor from its unit in the spec to
    /// that in the file.
    variables: Vec<(usize, f64)>,
    /// Pose of the tool of the spec in the tip of the file.
    tool: Pose,
    /// Unit of length of the spec in m.
    metres: f64,
}

impl Model {
    /// Matches every joint with a frame of the spec; the file of another robot is a mistake.
    fn new(machine: &RealMachine, nominal: &NominalChain, file: &Path) -> Result<Self, Diagnostics> {
        let spec = &machine.spec;
        let metres = spec.length.in_metres();
        let refused = |message: String, help: &str| Err(mistake::with_help(file.display(), message, help));
        let names: Vec<&str> = nominal.variables().collect();
        if names.len() != spec.variables.len() {
            let message = format!(
                "the chain between the links has {} moving joints, but the spec has {}",
                names.len(),
                spec.variables.len()
            );
            return refused(
                message,
                &format!("choose the ends of the chain of the spec: `{BASE_LINK} {TIP_LINK}`"),
            );
        }
        let variable = |(i, name): (usize, &&str)| {
            let index = spec.variables.iter().position(|variable| variable.name == *name).unwrap_or(i);
            let factor = if spec.variables[index].kind == VariableKind::Prismatic { metres } else { 1.0 };
            (index, factor)
        };
        let variables = names.iter().enumerate().map(variable).collect();
        let moves = spec.variables_of_transforms();
        let mut moving = (0..spec.frames.len()).filter(|i| !moves[*i].is_empty());
        let joints: Vec<Joint> = nominal
            .joints()
            .into_iter()
            .map(|joint| {
                let named = spec.frames.iter().position(|frame| frame.name == joint.name);
                let frame = match joint.axis {
                    Some(_) => moving.next(),
                    None => named.filter(|i| moves[*i].is_empty()),
                };
                Joint {
                    origin: scaled(&placed(joint.xyz, joint.rpy), 1.0 / metres),
                    axis: joint.axis,
                    at_zero: scaled(&joint.at_zero, 1.0 / metres),
                    frame,
                }
            })
            .collect();
        let is_missing = joints.iter().any(|joint| joint.axis.is_some() && joint.frame.is_none());
        if is_missing || moving.next().is_some() {
            let help = "export to the file from which the spec was imported, in which every moving joint \
                 has a frame";
            return refused("the joints of the file do not match the frames of the spec".to_owned(), help);
        }
        let mut model = Self { joints, variables, tool: Pose::IDENTITY, metres };
        let zero = vec![0.0; spec.variables.len()];
        let ideal = machine
            .manipulator
            .pose(&zero, &machine.s)
            .map_err(|error| mistake::whole(&machine.origin, &error))?;
        model.tool = model.tool(nominal, &zero).inverse().then(&ideal);
        let pairs = machine.configurations.iter().zip(&machine.ideal);
        let difference = PoseDifference::new(pairs.map(|(at, ideal)| [model.tool(nominal, &at.q), *ideal]));
        let reach = sampling::arm_length(&machine.manipulator, &machine.s).unwrap_or(1.0);
        if !(difference.position.largest <= SAME_ROBOT * reach && difference.angle.largest <= SAME_ROBOT) {
            let message = format!(
                "the robot of this file differs from that of the spec: the nominal tool poses \
                 differ by up to {} and {} rad",
                length(difference.position.largest, spec.length),
                digits(difference.angle.largest, 3)
            );
            return refused(
                message,
                &format!(
                    "check that `{BASE}` and `{TIP}` name the ends of the spec's chain, and that the \
                 zeros of the joints are the same"
                ),
            );
        }
        Ok(model)
    }

    /// Returns the pose of the tool of the spec by a file, in the unit of length of the spec.
    fn tool(&self, nominal: &NominalChain, q: &[f64]) -> Pose {
        let q: Vec<f64> = self.variables.iter().map(|(index, factor)| q[*index] * factor).collect();
        scaled(&nominal.pose(&q), 1.0 / self.metres).then(&self.tool)
    }
}

/// Converts a pose to another unit of length.
fn scaled(pose: &Pose, factor: f64) -> Pose {
    let Pose([x, y, z, p]) = *pose;
    Pose([x, y, z, p.map(|v| v * factor)])
}
