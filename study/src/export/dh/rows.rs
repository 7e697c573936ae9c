//! The chain as rows of four numbers.

use abbe::{Manipulator, Pose};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::{DhConvention, DhNumber};

use super::slides;
use crate::export::found::{Found, about_x, about_z};
use crate::mistake;

/// A row: its joint adds to theta or to d.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::export) struct Row {
    pub(in crate::export) name: String,
    /// Which variable moves it, if one does.
    pub(in crate::export) variable: Option<usize>,
    pub(in crate::export) prismatic: bool,
    /// Whether it counts against the axis.
    pub(in crate::export) reversed: bool,
    /// Theta, d, a and alpha where the variable is 0.
    pub(in crate::export) numbers: [f64; 4],
}

/// All rows, and what stands before and behind them.
#[derive(Clone, Debug)]
pub(in crate::export) struct Table {
    pub(in crate::export) convention: DhConvention,
    pub(in crate::export) base: Pose,
    pub(in crate::export) rows: Vec<Row>,
    pub(in crate::export) tool: Pose,
}

/// What an entry of a pose may be off by where a form is recognized: a rounded quarter turn is one.
const ALMOST: f64 = 1e-9;

impl Row {
    /// Its motions by numbers and variable, in order, as convention and `q` have them.
    pub(super) fn motions(&self, convention: DhConvention, q: &[f64]) -> [(DhNumber, f64); 4] {
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

/// One of the four motions.
pub(super) fn motion(number: DhNumber, amount: f64) -> Pose {
    match number {
        DhNumber::Theta => about_z(amount, 0.0),
        DhNumber::D => about_z(0.0, amount),
        DhNumber::A => about_x(0.0, amount),
        DhNumber::Alpha => about_x(amount, 0.0),
    }
}

impl Table {
    /// The numbers of the nominal chain; a chain that has none is a mistake.
    pub(in crate::export) fn nominal(found: &Found) -> Result<Self, Diagnostics> {
        let attempts =
            [DhConvention::Standard, DhConvention::Modified].map(|convention| Self::read(found, convention));
        let mut refused = None;
        for attempt in attempts {
            match attempt {
                Ok(table) => return Ok(table),
                Err((frame, reason)) => {
                    if refused.as_ref().is_none_or(|(farthest, _)| frame > *farthest) {
                        refused = Some((frame, reason));
                    }
                }
            }
        }
        let (frame, reason) = refused.unwrap_or_default();
        let name = found.spec.frames.get(frame).map_or("", |frame| frame.name.as_str());
        Err(mistake::with_help(
            &found.origin,
            format!("the frame \"{name}\" has no Denavit-Hartenberg numbers: {reason}"),
            "write the chain with `dh`, or with `mdh`, throughout; or export it to another format: `--to urdf`",
        ))
    }

    fn read(found: &Found, convention: DhConvention) -> Result<Self, (usize, String)> {
        let (spec, count) = (&found.spec, found.spec.variables.len());
        let at = |q: &[f64]| {
            let mut transforms = vec![Pose::IDENTITY; spec.frames.len() + 1];
            let evaluated = found.manipulator.transforms(q, &found.s, &mut transforms);
            evaluated.map(|()| transforms).map_err(|error| (0, error.to_string()))
        };
        let depends = spec.variables_of_transforms();
        let zero = at(&vec![0.0; count])?;
        let mut table =
            Self { convention, base: Pose::IDENTITY, rows: Vec::new(), tool: zero[spec.frames.len()] };
        if !depends[spec.frames.len()].is_empty() {
            return Err((spec.frames.len() - 1, "the tool behind it moves".to_owned()));
        }
        let last = spec.frames.iter().rposition(|frame| frame.variable.is_some()).unwrap_or_default();
        for (i, frame) in spec.frames.iter().enumerate() {
            let refused = |reason: &str| Err((i, reason.to_owned()));
            let numbers = numbers(&zero[i], convention);
            let Some(variable) = frame.variable else {
                match (numbers, depends[i].is_empty()) {
                    (_, false) => return refused("it moves with the joint of another frame"),
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
                    (None, _) => return refused("it is fixed, and takes more than four"),
                }
                continue;
            };
            if depends[i].iter().any(|other| *other != variable) {
                return refused("it moves with more than its own joint");
            }
            let Some(numbers) = numbers else {
                return refused("its axes do not stand as either convention has them");
            };
            let mut q = vec![0.0; count];
            q[variable] = 1.0;
            let one = &at(&q)?[i];
            let prismatic = slides(spec.variables[variable].kind);
            let row = [false, true].into_iter().map(|reversed| {
                let (name, variable) = (spec.variables[variable].name.clone(), Some(variable));
                Row { name, variable, prismatic, reversed, numbers }
            });
            let Some(row) = row.into_iter().find(|row| is_same(&row.pose(convention, &q), one)) else {
                return refused("its joint does not turn about z or slide along it, one to one");
            };
            table.rows.push(row);
        }
        Ok(table)
    }

    /// Where the tool is by these numbers.
    pub(super) fn pose(&self, q: &[f64]) -> Pose {
        let rows = self.rows.iter().map(|row| row.pose(self.convention, q));
        rows.fold(self.base, |pose, row| pose.then(&row)).then(&self.tool)
    }

    /// How long it is, stretched out; 1 if it has no length.
    pub(super) fn reach(&self) -> f64 {
        let length = |[_, d, a, _]: [f64; 4]| d.hypot(a);
        let [x, y, z] = self.tool.position();
        let all = self.rows.iter().map(|row| length(row.numbers)).sum::<f64>() + x.hypot(y).hypot(z);
        if all > 0.0 { all } else { 1.0 }
    }
}

impl Row {
    pub(in crate::export) fn pose(&self, convention: DhConvention, q: &[f64]) -> Pose {
        let motions = self.motions(convention, q);
        motions.iter().fold(Pose::IDENTITY, |pose, (number, amount)| pose.then(&motion(*number, *amount)))
    }
}

/// Theta, d, a and alpha of a pose, if they make it.
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

fn is_same(a: &Pose, b: &Pose) -> bool {
    let scale = 1.0 + b.position().iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    a.0.as_flattened().iter().zip(b.0.as_flattened()).all(|(a, b)| (a - b).abs() <= ALMOST * scale)
}
