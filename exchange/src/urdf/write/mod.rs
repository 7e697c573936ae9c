//! Writes the origins of the joints of the real robot into the URDF file of the nominal one.

mod edit;

use std::path::Path;

use abbe::analysis::sampling;
use abbe::{Manipulator, Pose, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_spec::mistake;
use abbe_spec::number::{digits, length};

use self::edit::{Edited, NewOrigin};
use super::nominal::NominalChain;
use super::read::Ends;
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
    let mut document = Document::read(file)?;
    let text = document.text.to_string();
    let nominal = NominalChain::read(&mut document, ends);
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
    let mut document = Document::new(&name, text.as_str());
    let read = NominalChain::read(&mut document, ends);
    let read = document.finish(read)?;
    let mut left_out: Vec<String> = machine.held_at_mean().into_iter().collect();
    if joints.last().is_some_and(|joint| joint.axis.is_some()) {
        left_out.push(
            "The last link hangs on a joint that moves, and has no origin behind it: of what is wrong there the file holds a turn about \
             the axis and a shift along it. Name a tip that is fixed to it with `--tip`."
                .to_owned(),
        );
    }
    left_out.push(
        "Shapes and masses move with their links as they are, and so does what hangs on the chain beside it."
            .to_owned(),
    );
    let most = new_origins.iter().map(|one| (one.distance(), one)).max_by(|a, b| a.0.total_cmp(&b.0));
    let most = most.filter(|(distance, _)| *distance > UNCHANGED);
    let sign = most.map_or_else(nominal_sign, |(distance, one)| {
        let [old, new] = [one.xyz, one.new.position()];
        let axis = (0..3).max_by(|a, b| (new[*a] - old[*a]).abs().total_cmp(&(new[*b] - old[*b]).abs()));
        let axis = axis.unwrap_or_default();
        format!(
            "These are the origins of the real robot, to be used in place of the nominal ones: the joint {} stands at {} = {} m where the \
             file had {} m, {} mm from there in all, and nothing is to be subtracted from it.",
            one.name,
            ["x", "y", "z"][axis],
            digits(new[axis], 8),
            digits(old[axis], 8),
            digits(1e3 * distance, 4),
        )
    });
    let format = format!("URDF, {} of {} origins changed", changes.len(), joints.len());
    let files = vec![ExportedFile { name, text }];
    let report = ExportReport::for_model(machine, format, files, |q| model.tool(&read, q), sign);
    Ok(ExportReport { changes, left_out, ..report })
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
                "{} joints move between the links, and {} in the spec",
                names.len(),
                spec.variables.len()
            );
            return refused(
                message,
                "name the links at the ends of the spec's chain: `--base LINK --tip LINK`",
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
            let help =
                "export into the file from which the spec was imported: a frame for every joint that moves";
            return refused("its joints are not the frames of the spec".to_owned(), help);
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
                "this is not the robot of the spec: the nominal tools are up to {} and {} rad apart",
                length(difference.position.largest, spec.length),
                digits(difference.angle.largest, 3)
            );
            return refused(
                message,
                "do `--base` and `--tip` name the ends of the spec's chain, and are the joints' zeros the same?",
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
