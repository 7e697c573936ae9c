//! A URDF file in which the origins of the joints are those of the real robot, and nothing else is changed.

mod edit;

use std::path::Path;

use abbe::analysis::sampling;
use abbe::{Manipulator, Pose, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;

use self::edit::{Edited, Moved};
use super::difference::Difference;
use super::found::Found;
use super::origins::{Joint, origins};
use super::{ExportedFile, MODEL, Report, UNCHANGED, as_nominal};
use crate::import::described::{Described, placed};
use crate::mistake;
use crate::number::{digits, length};

/// How far the nominal chains of spec and file may be apart, as a part of the reach: numbers of a catalogue are.
const SAME_ROBOT: f64 = 2e-3;

/// The file, and the links between which the chain is.
#[derive(Clone, Copy)]
pub(super) struct From<'a> {
    pub(super) file: &'a Path,
    pub(super) base: Option<&'a str>,
    pub(super) tip: Option<&'a str>,
}

/// The calibrated file, and what remains of the errors with it.
pub(super) fn report(found: &Found, from: From<'_>) -> Result<Report, Diagnostics> {
    let mut document = Document::read(from.file)?;
    let text = document.text.to_string();
    let described = Described::read(&mut document, from.base, from.tip);
    let described = document.finish(described)?;
    let model = Model::new(found, &described, from.file)?;
    let refused = |error| mistake::whole(&found.origin, &error);
    let new = origins(found, &model.joints, &model.tool).map_err(refused)?;
    let metres = found.spec.length.in_metres();
    let joints = described.joints();
    let moved: Vec<Moved> = joints
        .iter()
        .zip(&new)
        .map(|(joint, new)| Moved {
            name: &joint.name,
            xyz: joint.xyz,
            rpy: joint.rpy,
            new: scaled(new, metres),
        })
        .collect();
    let Edited { text, changes } = edit::edit(&text, &moved);
    let name = from.file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut document = Document::new(&name, text.as_str());
    let read = Described::read(&mut document, from.base, from.tip);
    let read = document.finish(read)?;
    let remains = found.of_model(|q| model.tool_by(&read, q));
    let mut left_out: Vec<String> = found.held_at_mean().into_iter().collect();
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
    let most = moved.iter().map(|one| (one.distance(), one)).max_by(|a, b| a.0.total_cmp(&b.0));
    let most = most.filter(|(distance, _)| *distance > UNCHANGED);
    let sign = most.map_or_else(as_nominal, |(distance, one)| {
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
    Ok(Report { changes, left_out, ..found.report(format, files, MODEL, remains, sign) })
}

/// The chain of the file beside that of the spec.
struct Model {
    joints: Vec<Joint>,
    /// Which variable of the spec each of the file is, and what it is multiplied by.
    variables: Vec<(usize, f64)>,
    /// From the tip to the spec's tool.
    tool: Pose,
    metres: f64,
}

impl Model {
    /// Finds every joint in the spec; a file of another robot is a mistake.
    fn new(found: &Found, described: &Described, file: &Path) -> Result<Self, Diagnostics> {
        let spec = &found.spec;
        let metres = spec.length.in_metres();
        let refused = |message: String, help: &str| Err(mistake::with_help(file.display(), message, help));
        let names: Vec<&str> = described.variables().collect();
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
        let variable = |(place, name): (usize, &&str)| {
            let index = spec.variables.iter().position(|variable| variable.name == *name).unwrap_or(place);
            let factor = if spec.variables[index].kind == VariableKind::Prismatic { metres } else { 1.0 };
            (index, factor)
        };
        let variables = names.iter().enumerate().map(variable).collect();
        let moves = spec.variables_of_transforms();
        let mut moving = (0..spec.frames.len()).filter(|i| !moves[*i].is_empty());
        let joints: Vec<Joint> = described
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
                    axis: joint.axis.map(|(axis, _)| axis),
                    at_zero: scaled(&joint.at_zero, 1.0 / metres),
                    frame,
                }
            })
            .collect();
        let lost = joints.iter().any(|joint| joint.axis.is_some() && joint.frame.is_none());
        if lost || moving.next().is_some() {
            let help =
                "export into the file from which the spec was imported: a frame for every joint that moves";
            return refused("its joints are not the frames of the spec".to_owned(), help);
        }
        let mut model = Self { joints, variables, tool: Pose::IDENTITY, metres };
        let zero = vec![0.0; spec.variables.len()];
        let ideal =
            found.manipulator.pose(&zero, &found.s).map_err(|error| mistake::whole(&found.origin, &error))?;
        model.tool = model.tool_by(described, &zero).inverse().then(&ideal);
        let pairs = found.configurations.iter().zip(&found.ideal);
        let apart = Difference::new(pairs.map(|(at, ideal)| [model.tool_by(described, &at.q), *ideal]));
        let reach = sampling::arm_length(&found.manipulator, &found.s).unwrap_or(1.0);
        if !(apart.position.largest <= SAME_ROBOT * reach && apart.angle.largest <= SAME_ROBOT) {
            let message = format!(
                "this is not the robot of the spec: the nominal tools are up to {} and {} rad apart",
                length(apart.position.largest, spec.length),
                digits(apart.angle.largest, 3)
            );
            return refused(
                message,
                "do `--base` and `--tip` name the ends of the spec's chain, and are the joints' zeros the same?",
            );
        }
        Ok(model)
    }

    /// Where the spec's tool is by a file, in the spec's length unit.
    fn tool_by(&self, described: &Described, q: &[f64]) -> Pose {
        let q: Vec<f64> = self.variables.iter().map(|(index, factor)| q[*index] * factor).collect();
        scaled(&described.pose(&q), 1.0 / self.metres).then(&self.tool)
    }
}

/// A pose in another length unit.
fn scaled(pose: &Pose, factor: f64) -> Pose {
    let Pose([x, y, z, p]) = *pose;
    Pose([x, y, z, p.map(|v| v * factor)])
}
