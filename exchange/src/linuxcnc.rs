//! Compensation files of LinuxCNC: lines of `nominal forward reverse` for each joint.
//!
//! With `COMP_FILE_TYPE = 0` forward and reverse are the actual positions of the joint at a nominal
//! command, approached from below and from above. LinuxCNC adds `nominal − forward` to the command,
//! interpolated linearly between the lines. It reads up to the first line of another form, so that
//! the file cannot have comments.

use std::fmt::Write;

use abbe::{Error, Manipulator};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::mistake;
use abbe_spec::number::digits;

use crate::export::report::unreadable;
use crate::export::rotary_axes::{Kinematics, RotaryAxis};
use crate::export::slides::{Axes, interpolated};
use crate::export::{ExportReport, ExportedFile, RealMachine, product};

/// Largest number of lines that LinuxCNC reads.
const MOST_NODES: usize = 256;

/// Writes one file for each slide, with `nodes` lines.
///
/// # Errors
///
/// `nodes` exceeds the limit of LinuxCNC, or the machine does not consist of slides along X, Y and
/// Z that carry the tool, after rotary axes of the workpiece if any.
pub fn write(machine: &RealMachine, nodes: usize) -> Result<ExportReport, Diagnostics> {
    if nodes > MOST_NODES {
        let message = format!("a compensation file of LinuxCNC has at most {MOST_NODES} lines");
        return Err(mistake::with_help(
            "--nodes",
            message,
            format!("choose fewer nodes: `--nodes {MOST_NODES}`"),
        ));
    }
    let axes = Axes::find(machine)?;
    let slides = &axes.slides;
    let evaluated = |error: Error| mistake::whole(&machine.origin, &error);
    let mm = machine.spec.length.in_metres() * 1e3;
    let (mut files, mut largest) = (Vec::new(), (0.0, String::new()));
    for (k, slide) in slides.iter().enumerate() {
        let mut text = String::new();
        for value in slide.nodes(nodes) {
            let error = error_along(machine, &axes, k, value).map_err(evaluated)? * mm;
            let (nominal, actual) = (value * mm, value * mm + error);
            let _ = writeln!(text, "{nominal:.6} {actual:.6} {actual:.6}");
            if error.abs() > largest.0 {
                largest = (error.abs(), sentence(slide.letter(), nominal, actual));
            }
        }
        files.push(ExportedFile { name: format!("{}.comp", slide.letter().to_ascii_lowercase()), text });
    }
    let read: Option<Vec<_>> = files.iter().map(|file| read(&file.text)).collect();
    let read = read.ok_or_else(|| unreadable("the exported file cannot be read back"))?;
    let corrected = |q: &[f64]| {
        let mut q = q.to_vec();
        for (slide, (nominal, forward)) in slides.iter().zip(&read) {
            let [trim] = interpolated(nominal, forward, q[slide.variable] * mm);
            q[slide.variable] += trim / mm;
        }
        q
    };
    let turned = RotaryAxis::all(machine, &axes).map_err(evaluated)?;
    let mut left_out: Vec<String> = turned.iter().map(|axis| axis.sentence(mm)).collect();
    left_out.extend(axes.errors_beyond_own_axis(machine));
    left_out.push(
        "LinuxCNC corrects each joint along itself by its own position: straightness, squareness \
         and angular errors with varying lever arms remain. The error along each axis is that of \
         the tool point with the other axes at home."
            .to_owned(),
    );
    left_out.push(
        "The forward and reverse columns are equal: backlash that depends on an input is \
         evaluated at the value of the input. LinuxCNC does not use `BACKLASH` together with a \
         compensation file."
            .to_owned(),
    );
    let names: Vec<String> = files.iter().map(|file| format!("`COMP_FILE = {}`", file.name)).collect();
    left_out.push(format!(
        "Name the files in the INI file, in mm: {}, each with `COMP_FILE_TYPE = 0` in the section \
         of its joint.",
        names.join(", ")
    ));
    let format = "compensation files of LinuxCNC".to_owned();
    let sign = if largest.1.is_empty() { "All errors are 0.".to_owned() } else { largest.1 };
    let report = ExportReport::for_commands(machine, format, files, corrected, sign).map_err(evaluated)?;
    let placed = Kinematics::new(machine, &axes).remains(corrected).map_err(evaluated)?;
    Ok(ExportReport { left_out, placed, turned, ..report })
}

/// Returns the error of the tool point along slide `k` at `value`, with the other slides at home
/// and rotary axes at 0.
fn error_along(machine: &RealMachine, axes: &Axes, k: usize, value: f64) -> Result<f64, Error> {
    let (q, u) = axes.at(machine, k, value);
    let (links, tool) = machine.links(&q, &axes.errors(machine, &q, &u)?)?;
    let real = product(&links).then(&tool);
    let (axis, ideal) = (axes.slides[k].axis, machine.manipulator.pose(&q, &machine.s)?);
    Ok(real.position()[axis] - ideal.position()[axis])
}

/// Returns the sentence about the sign: an actual position in mm of an axis.
fn sentence(letter: char, nominal: f64, actual: f64) -> String {
    format!(
        "The files hold actual positions: at the command {letter} = {} mm the axis is at {} mm, \
         and LinuxCNC adds nominal minus actual, {} mm, to the command.",
        digits(nominal, 6),
        digits(actual, 8),
        digits(nominal - actual, 4)
    )
}

/// Reads a file as LinuxCNC does: nominal positions, and the trims that it adds to commands.
fn read(text: &str) -> Option<(Vec<f64>, Vec<[f64; 1]>)> {
    let line = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split(' ').map(|cell| cell.parse().ok()).collect();
        let [nominal, forward, _] = numbers?[..] else { return None };
        Some((nominal, [nominal - forward]))
    };
    text.lines().map(line).collect()
}
