//! Tables of the volumetric compensation of TwinCAT CNC and the ISG kernel, in their CSV format.
//!
//! `EYX` is the error of the carriage X along Y, `ECX` its rotation about Z, both functions of X:
//! actual minus nominal by ISO 230-1, in mm and rad. `P0X P0Y P0Z` is the tool point with all axes
//! at 0, from the reference point. The control moves the axes against the resulting error of the
//! tool point.

use std::fmt::Write;

use abbe::{Pose, real_pose};
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::mistake;
use abbe_spec::number::digits;

use crate::export::report::unreadable;
use crate::export::rotary_axes::{Kinematics, RotaryAxis};
use crate::export::slides::{Axes, Reference, Slide, interpolated};
use crate::export::{ExportReport, ExportedFile, RealMachine};

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
    let mut text = format!(
        "// {}: errors of its axes as ISO 230-1 has them, actual minus nominal, in mm and rad\nP0X P0Y P0Z\n{}\n",
        machine.spec.name,
        row(&reference.tool.map(|v| v * mm))
    );
    let mut largest = (0.0, String::new());
    for (k, slide) in slides.iter().enumerate() {
        let letter = slide.letter();
        let names = ["X", "Y", "Z", "A", "B", "C"].map(|direction| format!("E{direction}{letter}"));
        let _ = writeln!(text, "#\n{letter} {}", names.join(" "));
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
    let tables =
        Tables::read(&text, slides).ok_or_else(|| unreadable("the exported file cannot be read back"))?;
    let turned = RotaryAxis::all(machine, &axes).map_err(evaluated)?;
    let mut left_out: Vec<String> = turned.iter().map(|axis| axis.sentence(mm)).collect();
    left_out.extend(axes.errors_beyond_own_axis(machine));
    left_out.push(
        "The control corrects the position of the tool point, not its orientation, with the tool \
         length set in the control."
            .to_owned(),
    );
    left_out.push(
        "Errors of fixed frames and of the tool are not errors of an axis; they are left out.".to_owned(),
    );
    left_out.push(
        "Configure the kinematic chain in the control, from the bed to the tool: ".to_owned()
            + &slides.iter().map(|slide| slide.letter().to_string()).collect::<Vec<_>>().join(", ")
            + ".",
    );
    let format = "volumetric compensation tables (ISG CSV)".to_owned();
    let files = vec![ExportedFile { name: format!("{}.volcomp.csv", machine.spec.name), text }];
    let corrected = |q: &[f64]| tables.corrected(slides, q, mm);
    let sign = if largest.1.is_empty() { "All errors are 0.".to_owned() } else { largest.1 };
    let report = ExportReport::for_commands(machine, format, files, corrected, sign).map_err(evaluated)?;
    let placed = Kinematics::new(machine, &axes).remains(corrected).map_err(evaluated)?;
    Ok(ExportReport { left_out, placed, turned, ..report })
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
    let number = |value: &f64| format!("{}", format!("{value:.9}").parse::<f64>().unwrap_or(*value) + 0.0);
    values.iter().map(number).collect::<Vec<_>>().join(" ")
}

/// Tables, read as the control reads them.
struct Tables {
    /// Tool point from the reference point, in mm.
    tool: [f64; 3],
    /// Nodes of each slide in mm, and six errors at each node.
    axes: Vec<(Vec<f64>, Vec<[f64; 6]>)>,
}

impl Tables {
    /// Reads the tables.
    fn read(text: &str, slides: &[Slide]) -> Option<Self> {
        let mut blocks =
            text.split("\n#\n").map(|block| block.lines().filter(|line| !line.starts_with("//")));
        let numbers =
            |line: &str| line.split(' ').map(|cell| cell.parse::<f64>().ok()).collect::<Option<Vec<f64>>>();
        let tool = numbers(blocks.next()?.nth(1)?)?.try_into().ok()?;
        let mut axes = Vec::new();
        for (block, slide) in blocks.zip(slides) {
            let mut lines = block;
            lines.next()?.starts_with(slide.letter()).then_some(())?;
            let rows: Option<Vec<Vec<f64>>> = lines.map(numbers).collect();
            let (mut nodes, mut errors) = (Vec::new(), Vec::new());
            for row in rows? {
                let [at, six @ ..] = &row[..] else { return None };
                nodes.push(*at);
                errors.push(six.try_into().ok()?);
            }
            axes.push((nodes, errors));
        }
        (axes.len() == slides.len()).then_some(Self { tool, axes })
    }

    /// Returns the corrected command: minus the error of the tool point by the product of `T(x)
    /// T(t) R(θ)` of all axes and the tool.
    ///
    /// `mm` is the unit of length of `q` in mm.
    fn corrected(&self, slides: &[Slide], q: &[f64], mm: f64) -> Vec<f64> {
        let (mut real, mut ideal) = (Pose::IDENTITY, self.tool);
        for (slide, (nodes, errors)) in slides.iter().zip(&self.axes) {
            let at = q[slide.variable] * mm;
            ideal[slide.axis] += at;
            let [x, y, z, a, b, c] = interpolated(nodes, errors, at);
            let mut shift = [x, y, z];
            shift[slide.axis] += at;
            let [x, y, z] = shift;
            // Spin about Y, roll about Z, pitch about X.
            real = real.then(&real_pose(&[Pose::IDENTITY, Pose::IDENTITY], &[[x, y, z, b, c, a]]));
        }
        let real = real.apply(self.tool);
        let mut q = q.to_vec();
        slides.iter().for_each(|slide| q[slide.variable] -= (real[slide.axis] - ideal[slide.axis]) / mm);
        q
    }
}
