//! Files of compensation of LinuxCNC: of each joint lines of `nominal forward reverse`.
//!
//! With `COMP_FILE_TYPE = 0` forward and reverse are where the joint really is when it is commanded to nominal and comes from below, or from
//! above; LinuxCNC adds `nominal − forward` to the command, straight between the lines. It reads up to the first line that is anything else:
//! there is no comment in such a file.

use std::fmt::Write;

use abbe::{Error, Manipulator, Pose};
use abbe_spec::diagnostic::Diagnostics;

use super::found::{Found, Link};
use super::slides::{Axes, axes, interpolated};
use super::turning::{Kinematics, Turning};
use super::{COMMANDS, ExportedFile, Report};
use crate::mistake;
use crate::number::digits;

/// More lines LinuxCNC does not take.
const MOST_NODES: usize = 256;

/// One file for each slide, and what remains of the errors with them.
pub(super) fn report(found: &Found, nodes: usize) -> Result<Report, Diagnostics> {
    if nodes > MOST_NODES {
        let message = format!("a file of LinuxCNC has {MOST_NODES} lines at most");
        return Err(mistake::with_help("--nodes", message, format!("ask for fewer: `--nodes {MOST_NODES}`")));
    }
    let axes = axes(found)?;
    let Axes { slides, turning } = &axes;
    let evaluated = |error: Error| mistake::whole(&found.origin, &error);
    let mm = found.spec.length.in_metres() * 1e3;
    let (mut files, mut largest) = (Vec::new(), (0.0, String::new()));
    for (k, slide) in slides.iter().enumerate() {
        let mut text = String::new();
        for value in slide.nodes(nodes) {
            let error = along(found, &axes, k, value).map_err(evaluated)? * mm;
            let (nominal, actual) = (value * mm, value * mm + error);
            let _ = writeln!(text, "{nominal:.6} {actual:.6} {actual:.6}");
            if error.abs() > largest.0 {
                largest = (error.abs(), sentence(slide.letter(), nominal, actual));
            }
        }
        files.push(ExportedFile { name: format!("{}.comp", slide.letter().to_ascii_lowercase()), text });
    }
    let read: Option<Vec<_>> = files.iter().map(|file| read(&file.text)).collect();
    let read = read.ok_or_else(|| {
        let help = "this is a mistake of abbe: please report the spec";
        mistake::with_help("abbe export", "what was written cannot be read", help)
    })?;
    let corrected = |q: &[f64]| {
        let mut q = q.to_vec();
        for (slide, (nominal, forward)) in slides.iter().zip(&read) {
            let [trim] = interpolated(nominal, forward, q[slide.variable] * mm);
            q[slide.variable] += trim / mm;
        }
        q
    };
    let turned = Turning::all(found, turning).map_err(evaluated)?;
    let mut left_out: Vec<String> = turned.iter().map(|axis| axis.sentence(mm)).collect();
    left_out.extend(found.beyond_own_axis(slides));
    left_out.push(
        "A joint is corrected along itself, by its own position: straightness, squareness and what turns with a lever that changes remain. What the \
         tool point is off by along each axis is taken with the other axes at home."
            .to_owned(),
    );
    left_out.push(
        "Forward and reverse are the same: backlash that is known by an input stands at that input's value, and `BACKLASH` is not used beside a \
         file."
            .to_owned(),
    );
    let names: Vec<String> = files.iter().map(|file| format!("`COMP_FILE = {}`", file.name)).collect();
    left_out.push(format!(
        "The INI file names them, in mm: {}, each with `COMP_FILE_TYPE = 0`, in the section of its joint.",
        names.join(", ")
    ));
    let format = "files of compensation of LinuxCNC".to_owned();
    let remains = found.of_commands(|q| Ok(corrected(q))).map_err(evaluated)?;
    let sign = if largest.1.is_empty() { "All errors are 0.".to_owned() } else { largest.1 };
    let placed = Kinematics::new(found, slides, turning).remains(corrected).map_err(evaluated)?;
    Ok(Report { left_out, placed, turned, ..found.report(format, files, COMMANDS, remains, sign) })
}

/// What the tool point is off by along the axis, with the other slides at home, and what turns at 0.
fn along(found: &Found, axes: &Axes, k: usize, value: f64) -> Result<f64, Error> {
    let (q, u) = axes.at(found, k, value);
    let (links, tool) = found.links(&q, &axes.errors(found, &q, &u)?)?;
    let place = |pose: Pose, link: &Link| pose.then(&link.transform).then(&link.error);
    let real = links.iter().fold(Pose::IDENTITY, place).then(&tool);
    let (axis, ideal) = (axes.slides[k].axis, found.manipulator.pose(&q, &found.s)?);
    Ok(real.position()[axis] - ideal.position()[axis])
}

fn sentence(letter: char, nominal: f64, actual: f64) -> String {
    format!(
        "The files hold where the axis really is: commanded to {letter} = {} mm it stands at {} mm, and LinuxCNC adds nominal minus actual, {} mm, \
         to the command.",
        digits(nominal, 6),
        digits(actual, 8),
        digits(nominal - actual, 4)
    )
}

/// Nominal positions and the trims that LinuxCNC makes of a file.
fn read(text: &str) -> Option<(Vec<f64>, Vec<[f64; 1]>)> {
    let line = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split(' ').map(|cell| cell.parse().ok()).collect();
        let [nominal, forward, _] = numbers?[..] else { return None };
        Some((nominal, [nominal - forward]))
    };
    text.lines().map(line).collect()
}
