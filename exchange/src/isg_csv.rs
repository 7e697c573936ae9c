//! Tables of the volumetric compensation of TwinCAT CNC and the ISG kernel, in their CSV format.
//!
//! `EYX` is the error of the carriage X along Y, `ECX` its rotation about Z, both functions of X:
//! actual minus nominal by ISO 230-1, in mm and rad. `ECC` is the rotation about Z of the table C,
//! a function of C in degrees. `P0X P0Y P0Z` is the tool point with all axes at 0 and `PXC PYC PZC`
//! a point on the axis C, from the reference point. The control moves the linear axes against the
//! resulting error of the tool point on the workpiece.

use std::fmt::Write;

use abbe::Pose;
use abbe::analysis::sampling::vectors::{scale, subtract};
use abbe_spec::{Diagnostics, mistake, number::digits};

use crate::export::report::{rounded, unreadable};
use crate::export::rotary_axes::{TabledAxis, placed_difference};
use crate::export::slides::{Axes, ErrorTable, Reference, Slide, interpolated, small_motion, tool_points};
use crate::export::{ExportReport, ExportedFile, RealMachine, RotaryAxis};

/// Writes the tables, with `nodes` values of each slide.
///
/// # Errors
///
/// The machine does not consist of slides along X, Y and Z that carry the tool, after rotary axes
/// of the workpiece if any.
pub fn write(machine: &RealMachine, nodes: usize) -> Result<ExportReport, Diagnostics> {
    let axes = Axes::find(machine)?;
    let slides = &axes.slides;
    let evaluated = |error: abbe::Error| mistake::whole(&machine.origin, &error);
    let reference = Reference::new(machine, &axes).map_err(evaluated)?;
    let mm = machine.spec.length.in_metres() * 1e3;
    let tabled = TabledAxis::all(machine, &axes).map_err(evaluated)?;
    let rotary: Vec<TabledAxis> = tabled.iter().copied().flatten().collect();
    let mut text = heading(machine, &reference, &rotary, mm);
    let mut largest = (0.0, String::new());
    for (k, slide) in slides.iter().enumerate() {
        let letter = slide.letter();
        let _ = writeln!(text, "#\n{letter} {}", names(letter).join(" "));
        for value in slide.nodes(nodes) {
            let [x, y, z, a, b, c] = reference.errors(machine, &axes, k, value).map_err(evaluated)?;
            let [at, x, y, z] = [value, x, y, z].map(|v| v * mm);
            let _ = writeln!(text, "{}", row(&[at, x, y, z, a, b, c]));
            for (i, error) in [x, y, z].into_iter().enumerate() {
                if error.abs() > largest.0 {
                    largest = (error.abs(), sentence(letter, at, i, error));
                }
            }
        }
    }
    for axis in &rotary {
        let letter = axis.letter();
        let _ = writeln!(text, "#\n{letter} {}", names(letter).join(" "));
        for value in abbe::analysis::sampling::grid(axis.range, nodes) {
            let [x, y, z, a, b, c] = axis.errors(machine, &axes, value).map_err(evaluated)?;
            let [x, y, z] = [x, y, z].map(|v| v * mm);
            let _ = writeln!(text, "{}", row(&[value.to_degrees(), x, y, z, a, b, c]));
        }
    }
    let tables = Tables::read(&text, slides, &rotary)
        .ok_or_else(|| unreadable("the exported file cannot be read back"))?;
    let turned = RotaryAxis::all(machine, &axes).map_err(evaluated)?;
    let without_table = turned.iter().zip(&tabled).filter(|(_, table)| table.is_none());
    let mut left_out: Vec<String> = without_table.map(|(axis, _)| axis.sentence(mm)).collect();
    if !rotary.is_empty() {
        left_out.push(
            "The tables of the rotary axes hold their errors of location, too: enter their nominal \
             poses in the kinematic parameters of the control."
                .to_owned(),
        );
    }
    left_out.extend(axes.errors_beyond_own_axis(machine, &[]));
    left_out.push(
        "The control corrects the position of the tool point, not its orientation, with the tool \
         length set in the control."
            .to_owned(),
    );
    left_out.push(
        "Errors of fixed frames and of the tool are not errors of an axis; they are left out.".to_owned(),
    );
    let letters = |letters: Vec<String>| letters.join(", ");
    let carriers = letters(slides.iter().map(|slide| slide.letter().to_string()).collect());
    left_out.push(match rotary.is_empty() {
        true => format!(
            "Configure the kinematic chain in the control, from the bed to the tool: {carriers}. The chain \
             of the spec must lead from the workpiece to the tool: errors of a slide that carries the \
             workpiece have the opposite signs."
        ),
        false => format!(
            "Configure the kinematic chain in the control, from the workpiece to the tool: {}, then \
             the bed, then {carriers}.",
            letters(rotary.iter().map(|axis| axis.letter().to_string()).collect())
        ),
    });
    let format = "volumetric compensation tables (ISG CSV)".to_owned();
    let files = vec![ExportedFile { name: format!("{}.volcomp.csv", machine.spec.name), text }];
    let corrected = |q: &[f64], _: &[f64]| tables.corrected(slides, &rotary, q, mm);
    let report = ExportReport::for_commands(machine, format, files, corrected, largest.1)?;
    // A control that has tables of the axes must not have their poses as well.
    let placed = match rotary.is_empty() {
        true => placed_difference(machine, &axes, false, corrected).map_err(evaluated)?,
        false => None,
    };
    Ok(ExportReport { left_out, placed, turned, ..report })
}

/// Returns the names of the six errors of an axis.
fn names(letter: char) -> [String; 6] {
    ["X", "Y", "Z", "A", "B", "C"].map(|direction| format!("E{direction}{letter}"))
}

/// Returns the first block: the tool point, and a point on each rotary axis.
fn heading(machine: &RealMachine, reference: &Reference, rotary: &[TabledAxis], mm: f64) -> String {
    let mut names = vec!["P0X P0Y P0Z".to_owned()];
    let mut values = reference.tool.to_vec();
    for axis in rotary {
        names.push(["X", "Y", "Z"].map(|direction| format!("P{direction}{}", axis.letter())).join(" "));
        values.extend(subtract(axis.center, reference.point));
    }
    let values: Vec<f64> = values.into_iter().map(|value| value * mm).collect();
    format!(
        "// {}: errors of its axes as ISO 230-1 has them, actual minus nominal, in mm and rad\n{}\n{}\n",
        machine.spec.name,
        names.join(" "),
        row(&values)
    )
}

/// Returns the sentence about the sign: an error in mm of an axis in mm.
fn sentence(letter: char, at: f64, direction: usize, error: f64) -> String {
    let axis = ['X', 'Y', 'Z'][direction];
    format!(
        "The tables hold errors, actual minus nominal, and the control subtracts them: at \
         {letter} = {} mm the position error of the carriage is {} mm along {axis} \
         (E{axis}{letter}), so the control moves {axis} by {} mm. Measure one axis with the \
         tables active: if its error has doubled, the control is configured with `negate`.",
        digits(at, 6),
        digits(error, 4),
        digits(-error, 4)
    )
}

/// Writes numbers with nine decimals: a picometre and a nanoradian.
fn row(values: &[f64]) -> String {
    values.iter().map(|value| rounded(*value, 9).to_string()).collect::<Vec<_>>().join(" ")
}

/// Tables, read as the control reads them.
struct Tables {
    /// Tool point from the reference point, in mm.
    tool: [f64; 3],
    /// A point on each rotary axis from the reference point, in mm.
    centers: Vec<[f64; 3]>,
    slides: Vec<ErrorTable>,
    rotary: Vec<ErrorTable>,
}

impl Tables {
    /// Reads the tables.
    fn read(text: &str, slides: &[Slide], rotary: &[TabledAxis]) -> Option<Self> {
        let mut blocks =
            text.split("\n#\n").map(|block| block.lines().filter(|line| !line.starts_with("//")));
        let numbers =
            |line: &str| line.split(' ').map(|cell| cell.parse::<f64>().ok()).collect::<Option<Vec<f64>>>();
        let mut points = numbers(blocks.next()?.nth(1)?)?
            .chunks(3)
            .map(<[f64; 3]>::try_from)
            .collect::<Vec<_>>()
            .into_iter();
        let tool = points.next()?.ok()?;
        let centers = points.collect::<Result<Vec<_>, _>>().ok()?;
        let letters = slides.iter().map(Slide::letter).chain(rotary.iter().map(TabledAxis::letter));
        let mut axes = Vec::new();
        for (mut lines, letter) in blocks.zip(letters) {
            lines.next()?.starts_with(letter).then_some(())?;
            let rows: Option<Vec<Vec<f64>>> = lines.map(numbers).collect();
            let (mut nodes, mut errors) = (Vec::new(), Vec::new());
            for row in rows? {
                let [at, six @ ..] = &row[..] else { return None };
                nodes.push(*at);
                errors.push(six.try_into().ok()?);
            }
            axes.push((nodes, errors));
        }
        let is_complete = axes.len() == slides.len() + rotary.len() && centers.len() == rotary.len();
        let rotary = is_complete.then(|| axes.split_off(slides.len()))?;
        Some(Self { tool, centers, slides: axes, rotary })
    }

    /// Returns the corrected command: minus the error of the tool point on the workpiece, seen from
    /// the bed.
    ///
    /// Each rotary axis of the workpiece takes the tool point to its table by a rotation about its
    /// center and the inverse of the table's error. `mm` is the unit of length of `q` in mm.
    fn corrected(&self, slides: &[Slide], rotary: &[TabledAxis], q: &[f64], mm: f64) -> Vec<f64> {
        let [real, ideal] = tool_points(slides, &self.slides, self.tool, q, mm);
        let (mut to_real, mut to_ideal) = (Pose::IDENTITY, Pose::IDENTITY);
        for ((axis, center), (nodes, errors)) in rotary.iter().zip(&self.centers).zip(&self.rotary) {
            let angle = q[axis.variable];
            let mut about = [0.0; 3];
            about[axis.axis] = angle;
            let turned = small_motion([0.0; 3], about);
            let about_center = |pose: &Pose| {
                let [to, from] = [*center, scale(*center, -1.0)].map(|shift| small_motion(shift, [0.0; 3]));
                to.then(pose).then(&from)
            };
            let [x, y, z, a, b, c] = interpolated(nodes, errors, angle.to_degrees());
            let error = about_center(&small_motion([x, y, z], [a, b, c]));
            let turned = about_center(&turned);
            to_real = to_real.then(&turned).then(&error.inverse());
            to_ideal = to_ideal.then(&turned);
        }
        let off = to_ideal.inverse().turn(subtract(to_real.apply(real), to_ideal.apply(ideal)));
        let mut q = q.to_vec();
        slides.iter().for_each(|slide| q[slide.variable] -= off[slide.axis] / mm);
        q
    }
}
