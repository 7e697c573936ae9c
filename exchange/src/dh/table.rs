//! Chain of a spec as rows of four Denavit-Hartenberg numbers.
//!
//! Units of the numbers of a table.

use std::str::FromStr;

use abbe::{LengthUnit, Manipulator, Pose, VariableKind};
use abbe_spec::{DhConvention, DhNumber, Diagnostics, mistake, option::TO_URDF};

use crate::export::{RealMachine, about_x, about_z};

/// Row of a table; its joint adds to theta or d.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    /// Name of the variable, or of a fixed frame.
    pub(crate) name: String,
    /// Index of the variable; `None` for a fixed row.
    pub(crate) variable: Option<usize>,
    /// The variable adds to d instead of theta.
    pub(crate) prismatic: bool,
    /// The variable counts against the axis.
    pub(crate) reversed: bool,
    /// theta, d, a and alpha where the variable is 0.
    pub(crate) numbers: [f64; 4],
}

/// Rows of a chain, between constant poses of base and tool.
#[derive(Clone, Debug)]
pub(crate) struct DhTable {
    pub(crate) convention: DhConvention,
    pub(crate) base: Pose,
    pub(crate) rows: Vec<Row>,
    pub(crate) tool: Pose,
}

/// Tolerance for an entry of a pose that has the form of a row, relative to its lengths; covers a
/// rounded quarter turn.
const TOLERANCE: f64 = 1e-9;

impl Row {
    /// Returns the four factors of the row in the order of the convention: number and amount with
    /// the variable.
    pub(crate) fn motions(&self, convention: DhConvention, q: &[f64]) -> [(DhNumber, f64); 4] {
        let own =
            self.variable.map_or(0.0, |variable| if self.reversed { -q[variable] } else { q[variable] });
        convention.order().map(|number| {
            let moved = match number {
                DhNumber::Theta => !self.prismatic,
                DhNumber::D => self.prismatic,
                _ => false,
            };
            (number, self.numbers[number as usize] + if moved { own } else { 0.0 })
        })
    }
}

/// Returns one of the four factors of a row.
pub(crate) fn motion(number: DhNumber, amount: f64) -> Pose {
    match number {
        DhNumber::Theta => about_z(amount, 0.0),
        DhNumber::D => about_z(0.0, amount),
        DhNumber::A => about_x(0.0, amount),
        DhNumber::Alpha => about_x(amount, 0.0),
    }
}

impl DhTable {
    /// Finds the numbers of the nominal chain, in the standard or else the modified convention; a
    /// chain without such numbers is a mistake.
    pub(crate) fn nominal(machine: &RealMachine) -> Result<Self, Diagnostics> {
        let mut refused = None;
        for convention in [DhConvention::Standard, DhConvention::Modified] {
            match Self::find(machine, convention) {
                Ok(table) => return Ok(table),
                Err((frame, reason)) => {
                    if refused.as_ref().is_none_or(|(farthest, _)| frame > *farthest) {
                        refused = Some((frame, reason));
                    }
                }
            }
        }
        let (frame, reason) = refused.unwrap_or_default();
        let name = machine.spec.frames.get(frame).map_or("", |frame| frame.name.as_str());
        Err(mistake::with_help(
            &machine.origin,
            format!("the frame \"{name}\" has no Denavit-Hartenberg numbers: {reason}"),
            format!(
                "write all frames with `dh`, or all with `mdh`; or export to another format: `{TO_URDF}`"
            ),
        ))
    }

    /// Finds the numbers in one convention; an error is the index of a frame and the reason.
    fn find(machine: &RealMachine, convention: DhConvention) -> Result<Self, (usize, String)> {
        let (spec, count) = (&machine.spec, machine.spec.variables.len());
        let at = |q: &[f64]| {
            let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
            let evaluated = machine.manipulator.transforms(q, &machine.s, &mut transforms);
            evaluated.map(|()| transforms).map_err(|error| (0, error.to_string()))
        };
        let depends = spec.variables_of_transforms();
        let zero = at(&vec![0.0; count])?;
        let mut table =
            Self { convention, base: Pose::IDENTITY, rows: Vec::new(), tool: zero[spec.frames.len()] };
        if !depends[spec.frames.len()].is_empty() {
            return Err((spec.frames.len() - 1, "the tool transform depends on a joint".to_owned()));
        }
        let last = spec.frames.iter().rposition(|frame| frame.variable.is_some()).unwrap_or_default();
        for (i, frame) in spec.frames.iter().enumerate() {
            let refused = |reason: &str| Err((i, reason.to_owned()));
            let numbers = numbers(&zero[i], convention);
            let Some(variable) = frame.variable else {
                match (numbers, depends[i].is_empty()) {
                    (_, false) => return refused("its transform depends on the joint of another frame"),
                    _ if is_same(&zero[i], &Pose::IDENTITY) => {}
                    _ if table.rows.is_empty() => table.base = table.base.then(&zero[i]),
                    _ if i > last => {
                        let behind = zero[i..spec.frames.len()].iter().fold(Pose::IDENTITY, |p, a| p.then(a));
                        table.tool = behind.then(&zero[spec.frames.len()]);
                        break;
                    }
                    (Some(numbers), _) => table.rows.push(Row {
                        name: frame.name.clone(),
                        variable: None,
                        prismatic: false,
                        reversed: false,
                        numbers,
                    }),
                    (None, _) => {
                        return refused("it is a fixed transform that four DH numbers cannot express");
                    }
                }
                continue;
            };
            if depends[i].iter().any(|other| *other != variable) {
                return refused("its transform depends on other joints, too");
            }
            let Some(numbers) = numbers else {
                return refused("its axes are not placed as either convention requires");
            };
            let mut q = vec![0.0; count];
            q[variable] = 1.0;
            let one = &at(&q)?[i];
            let prismatic = spec.variables[variable].kind == VariableKind::Prismatic;
            let row = [false, true].into_iter().map(|reversed| {
                let (name, variable) = (spec.variables[variable].name.clone(), Some(variable));
                Row { name, variable, prismatic, reversed, numbers }
            });
            let Some(row) = row.into_iter().find(|row| is_same(&row.pose(convention, &q), one)) else {
                return refused("its joint does not rotate about z or translate along z with factor 1");
            };
            table.rows.push(row);
        }
        Ok(table)
    }

    /// Returns the pose of the tool.
    pub(crate) fn pose(&self, q: &[f64]) -> Pose {
        let rows = self.rows.iter().map(|row| row.pose(self.convention, q));
        rows.fold(self.base, |pose, row| pose.then(&row)).then(&self.tool)
    }

    /// Returns the sum of all lengths; 1 if there are none.
    pub(crate) fn reach(&self) -> f64 {
        let length = |[_, d, a, _]: [f64; 4]| d.hypot(a);
        let [x, y, z] = self.tool.position();
        let all = self.rows.iter().map(|row| length(row.numbers)).sum::<f64>() + x.hypot(y).hypot(z);
        if all > 0.0 { all } else { 1.0 }
    }
}

impl Row {
    /// Returns the transform of the row.
    pub(crate) fn pose(&self, convention: DhConvention, q: &[f64]) -> Pose {
        let motions = self.motions(convention, q);
        motions.iter().fold(Pose::IDENTITY, |pose, (number, amount)| pose.then(&motion(*number, *amount)))
    }
}

/// Returns theta, d, a and alpha of a pose that has the form of a row.
///
/// ```text
/// standard   R = Rz(θ) Rx(α):  R₃₁ = 0,  p = (a cos θ, a sin θ, d)
/// modified   R = Rx(α) Rz(θ):  R₁₃ = 0,  p = (a, −d sin α, d cos α)
/// ```
fn numbers(pose: &Pose, convention: DhConvention) -> Option<[f64; 4]> {
    let Pose([x, y, z, p]) = pose;
    let numbers = match convention {
        DhConvention::Standard => {
            let (theta, alpha) = (x[1].atan2(x[0]), y[2].atan2(z[2]));
            [theta, p[2], p[0] * theta.cos() + p[1] * theta.sin(), alpha]
        }
        DhConvention::Modified => {
            let (theta, alpha) = ((-y[0]).atan2(x[0]), (-z[1]).atan2(z[2]));
            [theta, p[2] * alpha.cos() - p[1] * alpha.sin(), p[0], alpha]
        }
    };
    let row = Row { name: String::new(), variable: None, prismatic: false, reversed: false, numbers };
    is_same(&row.pose(convention, &[]), pose).then_some(numbers.map(|number| number + 0.0))
}

/// Returns whether two poses are equal but for rounding.
fn is_same(a: &Pose, b: &Pose) -> bool {
    let scale = 1.0 + b.position().iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    a.0.as_flattened().iter().zip(b.0.as_flattened()).all(|(a, b)| (a - b).abs() <= TOLERANCE * scale)
}

/// Units of numbers for which neither heading nor cell states one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Unit of lengths, and of the spec.
    pub length: Option<LengthUnit>,
    /// Angles are in degrees if set to `true`, in rad if `false`.
    pub degrees: Option<bool>,
}

/// Parses `mm,deg` in either order, or one of the two.
impl FromStr for Units {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut units = Self::default();
        for unit in text.split(',').map(str::trim) {
            match unit {
                "m" if units.length.is_none() => units.length = Some(LengthUnit::Metre),
                "mm" if units.length.is_none() => units.length = Some(LengthUnit::Millimetre),
                "deg" if units.degrees.is_none() => units.degrees = Some(true),
                "rad" if units.degrees.is_none() => units.degrees = Some(false),
                _ => return Err("give one of m and mm, and one of deg and rad, as in `mm,deg`"),
            }
        }
        Ok(units)
    }
}
