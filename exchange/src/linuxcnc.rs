//! Compensation files of LinuxCNC: lines of `nominal forward reverse` for each joint.
//!
//! With `COMP_FILE_TYPE = 0` forward and reverse are the actual positions of the joint at a nominal
//! command, approached from below and from above. LinuxCNC adds `nominal − forward` to the command
//! of a joint that moves up and `nominal − reverse` to one that moves down, interpolated linearly
//! between the lines. It reads up to the first line of another form, so that the file cannot have
//! comments.

use std::fmt::Write;

use abbe::{Error, Manipulator, VariableKind};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::mistake;
use abbe_spec::number::digits;

use crate::export::report::unreadable;
use crate::export::rotary_axes::{Kinematics, RotaryAxis, angle_error};
use crate::export::slides::{Axes, interpolated};
use crate::export::{ExportReport, ExportedFile, RealMachine, product};

/// Largest number of lines that LinuxCNC reads.
const MOST_NODES: usize = 256;

/// Writes one file for each slide and for each rotary axis with limits, with `nodes` lines.
///
/// # Errors
///
/// `nodes` exceeds the limit of LinuxCNC, or the machine does not consist of slides along X, Y and
/// Z that carry the tool, after rotary axes of the workpiece if any.
pub fn write(machine: &mut RealMachine, nodes: usize) -> Result<ExportReport, Diagnostics> {
    if nodes > MOST_NODES {
        let message = format!("a compensation file of LinuxCNC has at most {MOST_NODES} lines");
        return Err(mistake::with_help(
            "--nodes",
            message,
            format!("choose fewer nodes: `--nodes {MOST_NODES}`"),
        ));
    }
    let axes = Axes::find(machine)?;
    let origin = machine.origin.clone();
    let evaluated = |error: Error| mistake::whole(&origin, &error);
    let joints = CompensatedJoint::all(machine, &axes);
    let directions: Vec<usize> = joints.iter().flat_map(|joint| joint.directions.clone()).collect();
    machine.approached(&directions).map_err(evaluated)?;
    let machine = &*machine;
    let (mut files, mut tables, mut largest) = (Vec::new(), Vec::new(), (0.0, String::new()));
    for joint in &joints {
        let mut text = String::new();
        for line in joint.lines(machine, &axes, nodes).map_err(evaluated)? {
            let [nominal, forward, reverse] = line;
            let _ = writeln!(text, "{nominal:.6} {forward:.6} {reverse:.6}");
            if (forward - nominal).abs() > largest.0 {
                largest = ((forward - nominal).abs(), joint.sentence(nominal, forward));
            }
        }
        tables.push(read(&text).ok_or_else(|| unreadable("the exported file cannot be read back"))?);
        files.push(ExportedFile { name: joint.file(), text });
    }
    let at_home: Vec<f64> = joints
        .iter()
        .map(|joint| joint.error_at_home(machine, &axes))
        .collect::<Result<_, _>>()
        .map_err(evaluated)?;
    // The error at home is a shift of the origin, which the work offset takes.
    let corrected = |q: &[f64], u: &[f64]| {
        let mut q = q.to_vec();
        for ((joint, (nominal, trims)), at_home) in joints.iter().zip(&tables).zip(&at_home) {
            let trims = interpolated(nominal, trims, q[joint.variable] * joint.factor);
            let is_reverse = joint.directions.iter().any(|input| u[*input] < 0.0);
            q[joint.variable] += trims[usize::from(is_reverse)] / joint.factor - at_home;
        }
        q
    };
    let turned = RotaryAxis::all(machine, &axes).map_err(evaluated)?;
    let mm = machine.spec.length.in_metres() * 1e3;
    let mut left_out: Vec<String> = turned.iter().map(|axis| axis.sentence(mm)).collect();
    left_out.extend(axes.errors_beyond_own_axis(machine, &directions));
    left_out.push(
        "LinuxCNC corrects each joint along itself by its own position: straightness, squareness \
         and angular errors with varying lever arms remain. The error along each axis is that of \
         the tool point with the other axes at home."
            .to_owned(),
    );
    left_out.extend(origin_sentence(&joints, &at_home));
    left_out.push(directions_sentence(machine, &directions));
    left_out.extend(without_limits(machine, &axes));
    let names: Vec<String> = files.iter().map(|file| format!("`COMP_FILE = {}`", file.name)).collect();
    left_out.push(format!(
        "Name the files in the INI file, in mm and degrees: {}, each with `COMP_FILE_TYPE = 0` in \
         the section of its joint.",
        names.join(", ")
    ));
    let format = "compensation files of LinuxCNC".to_owned();
    let sign = if largest.1.is_empty() { "All errors are 0.".to_owned() } else { largest.1 };
    let report = ExportReport::for_commands(machine, format, files, corrected, sign).map_err(evaluated)?;
    let placed = Kinematics::new(machine, &axes, true)
        .and_then(|kinematics| kinematics.remains(corrected))
        .map_err(evaluated)?;
    Ok(ExportReport { left_out, placed, turned, ..report })
}

/// Joint with a file.
struct CompensatedJoint {
    variable: usize,
    /// Index among the slides; none for a rotary axis.
    slide: Option<usize>,
    /// Letter of a slide, name of the variable of a rotary axis.
    name: String,
    range: [f64; 2],
    home: f64,
    /// Unit of the variable in mm or degrees.
    factor: f64,
    /// Inputs that give its direction of approach.
    directions: Vec<usize>,
}

impl CompensatedJoint {
    /// Returns the slides, then the rotary axes with limits.
    fn all(machine: &RealMachine, axes: &Axes) -> Vec<Self> {
        let joint = |variable: usize, slide: Option<usize>, name: String| {
            let one = &machine.spec.variables[variable];
            let factor = match one.kind {
                VariableKind::Prismatic => machine.spec.length.in_metres() * 1e3,
                VariableKind::Revolute => 1_f64.to_degrees(),
            };
            let directions = machine.directions(variable);
            Self { variable, slide, name, range: one.limits, home: one.home, factor, directions }
        };
        let slides = axes.slides.iter().enumerate();
        let slides = slides.map(|(k, slide)| joint(slide.variable, Some(k), slide.letter().to_string()));
        let rotary = axes
            .rotary
            .iter()
            .map(|variable| joint(*variable, None, machine.spec.variables[*variable].name.clone()));
        slides.chain(rotary).filter(|joint| joint.range.iter().all(|end| end.is_finite())).collect()
    }

    fn file(&self) -> String {
        format!("{}.comp", self.name.to_lowercase())
    }

    /// Returns the lines of the file, in mm or degrees. Trims are 0 at home, as the mean of both
    /// directions.
    fn lines(&self, machine: &RealMachine, axes: &Axes, nodes: usize) -> Result<Vec<[f64; 3]>, Error> {
        let values = abbe::analysis::sampling::grid(self.range, nodes);
        let errors: Result<Vec<[f64; 2]>, Error> =
            values.iter().map(|value| self.errors(machine, axes, *value)).collect();
        let errors = errors?;
        let [forward, reverse] = interpolated(&values, &errors, self.home);
        let at_home = (forward + reverse) / 2.0;
        let line = |(value, errors): (&f64, &[f64; 2])| {
            let [forward, reverse] = errors.map(|error| (value + error - at_home) * self.factor);
            [value * self.factor, forward, reverse]
        };
        Ok(values.iter().zip(&errors).map(line).collect())
    }

    /// Returns the error at home, the mean of both directions, in the unit of the variable.
    fn error_at_home(&self, machine: &RealMachine, axes: &Axes) -> Result<f64, Error> {
        let [forward, reverse] = self.errors(machine, axes, self.home)?;
        Ok((forward + reverse) / 2.0)
    }

    /// Returns the errors at `value`, approached from below and from above: of a slide that of the
    /// tool point along it, with the other slides at home and rotary axes at 0.
    fn errors(&self, machine: &RealMachine, axes: &Axes, value: f64) -> Result<[f64; 2], Error> {
        let mut errors = [0.0; 2];
        for (error, side) in errors.iter_mut().zip([1.0, -1.0]) {
            let (q, mut u) = match self.slide {
                Some(k) => axes.at(machine, k, value),
                None => machine.at_home(self.variable, value),
            };
            self.directions.iter().for_each(|input| u[*input] = side);
            *error = match self.slide {
                Some(k) => {
                    let (links, tool) = machine.links(&q, &axes.errors(machine, &q, &u)?)?;
                    let real = product(&links).then(&tool);
                    let ideal = machine.manipulator.pose(&q, &machine.s)?;
                    let axis = axes.slides[k].axis;
                    real.position()[axis] - ideal.position()[axis]
                }
                None => angle_error(machine, self.variable, &q, &u)?,
            };
        }
        Ok(errors)
    }

    fn unit(&self) -> &'static str {
        if self.slide.is_some() { "mm" } else { "deg" }
    }

    /// Returns the sentence about the sign: an actual position of the joint.
    fn sentence(&self, nominal: f64, actual: f64) -> String {
        let unit = self.unit();
        format!(
            "The files hold actual positions: at the command {} = {} {unit} the axis is at {} \
             {unit}, and LinuxCNC adds nominal minus actual, {} {unit}, to the command.",
            self.name,
            digits(nominal, 6),
            digits(actual, 8),
            digits(nominal - actual, 4)
        )
    }
}

/// Returns the sentence about the errors at home, which no trim corrects; none if they are 0.
fn origin_sentence(joints: &[CompensatedJoint], at_home: &[f64]) -> Option<String> {
    let shifted = joints.iter().zip(at_home).filter(|(joint, error)| (*error * joint.factor).abs() >= 5e-7);
    let shifts: Vec<String> = shifted
        .map(|(joint, error)| format!("{} {} {}", joint.name, digits(error * joint.factor, 4), joint.unit()))
        .collect();
    (!shifts.is_empty()).then(|| {
        format!(
            "The trims are 0 at home. The errors there ({}) are a shift of the origin; the figures \
             assume that the work offset takes it.",
            shifts.join(", ")
        )
    })
}

/// Returns the sentence about the forward and reverse columns.
fn directions_sentence(machine: &RealMachine, directions: &[usize]) -> String {
    let names: Vec<String> =
        directions.iter().map(|input| format!("`{}`", machine.spec.inputs[*input].name)).collect();
    let columns = if names.is_empty() {
        "The forward and reverse columns are equal: no error depends on a direction of approach, a \
         pure number from -1 to 1."
            .to_owned()
    } else {
        format!("The forward column holds for {} = 1, the reverse column for -1.", names.join(", "))
    };
    columns + " LinuxCNC does not use `BACKLASH` together with a compensation file."
}

/// Returns the sentence about rotary axes without a file; none if there are none.
fn without_limits(machine: &RealMachine, axes: &Axes) -> Option<String> {
    let variables = axes.rotary.iter().map(|variable| &machine.spec.variables[*variable]);
    let endless = variables.filter(|one| !one.limits.iter().all(|limit| limit.is_finite()));
    let names: Vec<String> = endless.map(|one| format!("`{}`", one.name)).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Rotary axes without limits have no file, because it would have no ends: {}.",
            names.join(", ")
        )
    })
}

/// Reads a file as LinuxCNC does: nominal positions, and the trims that it adds to commands in
/// either direction.
fn read(text: &str) -> Option<(Vec<f64>, Vec<[f64; 2]>)> {
    let line = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split(' ').map(|cell| cell.parse().ok()).collect();
        let [nominal, forward, reverse] = numbers?[..] else { return None };
        Some((nominal, [nominal - forward, nominal - reverse]))
    };
    text.lines().map(line).collect()
}
