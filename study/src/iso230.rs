//! Names of ISO 230-1 for the errors of the axes of a machine tool.
//!
//! `EYX` is the error of the axis X along Y, `EAX` its rotation about X. The chain goes from the
//! workpiece to the tool: an axis that carries the tool moves with its error, and the error of a
//! table is seen from the part that carries it, so that there `E_i` has the opposite sign.

use abbe::{Component, Manipulator, Pose, VariableKind, rotation_vector};
use abbe_spec::Spec;
use serde::Serialize;

/// Letters of the components in the order of `ε`: spin about Y, roll about Z, pitch about X.
const DIRECTIONS: [char; 6] = ['X', 'Y', 'Z', 'B', 'C', 'A'];

/// Axis of a machine tool, and the names of its errors.
#[derive(Clone, Debug, Serialize)]
pub struct IsoAxis {
    /// Frame of the axis, from 1.
    pub frame: usize,
    /// Name of the frame.
    pub name: String,
    /// Letter of the axis.
    pub letter: String,
    /// The axis carries the workpiece: the errors of the frame have the opposite sign of those that
    /// ISO 230-1 names.
    pub carries_workpiece: bool,
    /// Names of `e_x e_y e_z e_s e_r e_p`, with a minus sign on the side of the workpiece.
    pub errors: [String; 6],
}

impl IsoAxis {
    /// Returns the name of an error: `EYX`, or `-EYC` on the side of the workpiece.
    fn error(letter: char, carries_workpiece: bool, direction: char) -> String {
        let sign = if carries_workpiece { "-" } else { "" };
        format!("{sign}E{direction}{letter}")
    }

    /// Returns the axes of a machine with slides along X, Y and Z of `F_0`; none of another
    /// machine, or if its frames are not a chain.
    ///
    /// Rotary axes before the first slide carry the workpiece; all other axes are taken to carry
    /// the tool, which a spec does not say. An axis has names if the axes of its frame are those of
    /// `F_0` where all variables are 0.
    pub fn all(spec: &Spec, manipulator: &dyn Manipulator) -> Vec<Self> {
        if !spec.is_serial() {
            return Vec::new();
        }
        let slides = spec.variables.iter().filter(|one| one.kind == VariableKind::Prismatic);
        let Some(first) = slides.map(|one| one.frame).min() else { return Vec::new() };
        let axes: Vec<Self> = spec
            .variables
            .iter()
            .enumerate()
            .filter_map(|(i, variable)| {
                let is_slide = variable.kind == VariableKind::Prismatic;
                let direction = direction(spec, manipulator, i)?;
                let letter = if is_slide { ['X', 'Y', 'Z'][direction] } else { ['A', 'B', 'C'][direction] };
                let carries_workpiece = !is_slide && variable.frame < first;
                Some(Self {
                    frame: variable.frame + 1,
                    name: spec.frames[variable.frame].name.clone(),
                    letter: letter.to_string(),
                    carries_workpiece,
                    errors: DIRECTIONS.map(|direction| Self::error(letter, carries_workpiece, direction)),
                })
            })
            .collect();
        let count = |letter: &str| axes.iter().filter(|axis| axis.letter == letter).count();
        let is_machine_tool = ["X", "Y", "Z"].into_iter().all(|letter| count(letter) == 1);
        if is_machine_tool { axes } else { Vec::new() }
    }

    /// Returns the name of a component of the error of a frame, from 1.
    pub fn name_of(axes: &[Self], frame: usize, component: Component) -> Option<String> {
        axes.iter().find(|axis| axis.frame == frame).map(|axis| axis.errors[component.index()].clone())
    }
}

/// Returns the direction of a variable, 0 = X, 1 = Y, 2 = Z; `None` unless it is one of `F_0`, and
/// the axes of its frame are parallel to those of `F_0`, where all variables are 0.
fn direction(spec: &Spec, manipulator: &dyn Manipulator, variable: usize) -> Option<usize> {
    let s: Vec<f64> = spec.parameters.iter().map(|parameter| parameter.value).collect();
    let frame = spec.variables[variable].frame;
    let at = |value: f64| {
        let mut q = vec![0.0; spec.variables.len()];
        q[variable] = value;
        let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
        manipulator.transforms(&q, &s, &mut transforms).ok()?;
        Some(manipulator.description().frame_pose(&transforms, Some(frame)))
    };
    let zero = at(0.0)?;
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let unit = |i: usize, k: usize| f64::from(u8::from(i == k));
    (0..3).all(|i| (0..3).all(|k| close(zero.0[i][k], unit(i, k)))).then_some(())?;
    let moved = at(1.0)?;
    let by: [f64; 3] = match spec.variables[variable].kind {
        VariableKind::Prismatic => std::array::from_fn(|k| moved.0[3][k] - zero.0[3][k]),
        VariableKind::Revolute => rotation_vector(&moved),
    };
    (0..3).find(|axis| (0..3).all(|k| close(by[k], unit(*axis, k))))
}
