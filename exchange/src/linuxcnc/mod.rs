//! Compensation files of LinuxCNC: lines of `nominal forward reverse` for each joint.
//!
//! With `COMP_FILE_TYPE = 0` forward and reverse are the actual positions of the joint at a nominal
//! command, approached from below and from above. LinuxCNC adds `nominal − forward` to the command
//! of a joint that moves up and `nominal − reverse` to one that moves down, interpolated linearly
//! between the lines. It reads up to the first line of another form, so that the file cannot have
//! comments.
//!
//! With the kinematics `matrixkins` the joints X, Y and Z are a linear function of the coordinates,
//! and the files hold what that leaves along each axis. A platform on six legs has the kinematics
//! `genhexkins`.

mod genhexkins;
mod joint;

use abbe_spec::option::{NODES, TO_LINUXCNC, option};
use std::fmt::Write;

use abbe::Error;
use abbe_spec::number::digits;
use abbe_spec::{Diagnostics, mistake};

pub use genhexkins::write_genhexkins;
use joint::{CalibrationMatrix, CompensatedJoint};

use crate::export::report::unreadable;
use crate::export::rotary_axes::{RotaryAxis, placed_difference};
use crate::export::slides::{Axes, Slide, interpolated};
use crate::export::{ExportReport, ExportedFile, RealMachine};

/// Largest number of lines that LinuxCNC reads.
const MOST_NODES: usize = 256;

/// Writes one file for each slide and for each rotary axis with limits, with `nodes` lines; and the
/// matrix of `matrixkins` before them, if `has_matrix`.
///
/// # Errors
///
/// A machine with a matrix has rotary axes, `nodes` exceeds the limit of LinuxCNC, or the machine
/// does not consist of slides along X, Y and Z that carry the tool, after rotary axes of the
/// workpiece if any.
pub fn write(machine: &mut RealMachine, nodes: usize, has_matrix: bool) -> Result<ExportReport, Diagnostics> {
    if nodes > MOST_NODES {
        let message = format!("a compensation file of LinuxCNC has at most {MOST_NODES} lines");
        return Err(mistake::with_help(
            NODES,
            message,
            format!("choose fewer nodes: `{nodes}`", nodes = option("nodes", MOST_NODES)),
        ));
    }
    let axes = Axes::find(machine)?;
    let origin = machine.origin.clone();
    let evaluated = |error: Error| mistake::whole(&origin, &error);
    if let Some(variable) = axes.rotary.first().filter(|_| has_matrix) {
        let message =
            format!("`{}` is a rotary axis, and matrixkins has none", machine.spec.variables[*variable].name);
        let help = format!("`{TO_LINUXCNC}` writes files for other kinematics");
        return Err(mistake::with_help(&machine.origin, message, help));
    }
    let joints = CompensatedJoint::all(machine, &axes);
    let directions: Vec<usize> = joints.iter().flat_map(|joint| joint.directions.clone()).collect();
    machine.approached(&directions).map_err(evaluated)?;
    let machine = &*machine;
    let matrix = match has_matrix {
        true => Some(CalibrationMatrix::fit(machine, &axes, &directions).map_err(evaluated)?),
        false => None,
    };
    let joints: Vec<CompensatedJoint> = match &matrix {
        Some(matrix) => joints.into_iter().map(|joint| joint.after(matrix, &axes)).collect(),
        None => joints,
    };
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
        let commanded = q;
        let mut q = q.to_vec();
        if let Some(matrix) = &matrix {
            for slide in &axes.slides {
                let from_home =
                    |other: &Slide| commanded[other.variable] - machine.spec.variables[other.variable].home;
                let parts =
                    axes.slides.iter().map(|other| matrix.slope(slide.axis, other.axis) * from_home(other));
                q[slide.variable] += parts.sum::<f64>();
            }
        }
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
    let remaining = if has_matrix {
        "The matrix corrects scales and squareness, and the files what it leaves along each axis: \
             straightness"
    } else {
        "LinuxCNC corrects each joint along itself by its own position: straightness, squareness"
    };
    left_out.push(format!(
        "{remaining} and angular errors with varying lever arms remain. The error along each axis is \
         that of the tool point with the other axes at home."
    ));
    // The matrix is about coordinates 0, and moves the joints at home.
    let home = |slide: &Slide| machine.spec.variables[slide.variable].home;
    let moved = |joint: &CompensatedJoint| -> f64 {
        let Some((matrix, k)) = matrix.zip(joint.slide) else { return 0.0 };
        axes.slides.iter().map(|other| matrix.slope(axes.slides[k].axis, other.axis) * home(other)).sum()
    };
    let shifts: Vec<f64> = joints.iter().zip(&at_home).map(|(joint, error)| error + moved(joint)).collect();
    left_out.extend(origin_sentence(&joints, &shifts));
    left_out.push(directions_sentence(machine, &directions));
    left_out.extend(without_limits(machine, &axes));
    let names: Vec<String> = files.iter().map(|file| format!("`COMP_FILE = {}`", file.name)).collect();
    left_out.push(format!(
        "Name the files in the INI file, in mm and degrees: {}, each with `COMP_FILE_TYPE = 0` in \
         the section of its joint.",
        names.join(", ")
    ));
    if let Some(matrix) = &matrix {
        left_out.push(
            "Set `KINEMATICS = matrixkins` in the section [KINS] of the INI file, and name \
             `matrixkins.hal` there as a `HALFILE` behind the one that loads the kinematics."
                .to_owned(),
        );
        files.insert(0, matrix.file(&machine.spec.name));
    }
    let format = match has_matrix {
        true => "matrix of matrixkins and compensation files of LinuxCNC".to_owned(),
        false => "compensation files of LinuxCNC".to_owned(),
    };
    let report = ExportReport::for_commands(machine, format, files, corrected, largest.1)?;
    let placed = placed_difference(machine, &axes, true, corrected).map_err(evaluated)?;
    Ok(ExportReport { left_out, placed, turned, ..report })
}

/// Returns the sentence about the errors at home, which no trim corrects; none if they are 0.
fn origin_sentence(joints: &[CompensatedJoint], at_home: &[f64]) -> Option<String> {
    let shifted = joints.iter().zip(at_home).filter(|(joint, error)| (*error * joint.factor).abs() >= 5e-7);
    let shifts: Vec<String> = shifted
        .map(|(joint, error)| format!("{} {} {}", joint.name, digits(error * joint.factor, 4), joint.unit()))
        .collect();
    (!shifts.is_empty()).then(|| {
        format!(
            "The trims are 0 at home, as the mean of both directions. The errors there ({}) are a shift of the origin; the figures \
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
