//! Errors of linear axes in the arrangement of KinematicsComp, a function of controls of
//! HEIDENHAIN.
//!
//! The technical manual of the iTNC 530 HSCI (July 2013, section 6.4) publishes the arrangement: in
//! the kinematics table, which starts at the tool reference point, the errors of an axis stand
//! before its `MachAxis` as rows `Trans` in the column COMPTAB. Their values are columns C1 to C6
//! of the compensation file of the axis (along X, Y, Z, about X, Y, Z), and the positioning error
//! is in the column of the axis itself. The manual does not publish the bytes of these files, how a
//! row names its column, or the signs. So these are tables to be entered, as ISO 230-1 has the
//! errors: actual minus nominal.

use std::fmt::Write;

use abbe::Error;
use abbe_spec::{Diagnostics, mistake, number::digits};

use crate::export::report::{rounded, unreadable};
use crate::export::slides::{Axes, ErrorTable, Reference, tool_points};
use crate::export::{ExportReport, ExportedFile, RealMachine, RotaryAxis};

/// Largest number of rows in the column COMPTAB, those of MachAxis included.
const MOST_ROWS: usize = 100;

/// Writes the rows of the transformations, and for each slide a table of `nodes` values.
///
/// # Errors
///
/// The machine does not consist of slides along X, Y and Z that carry the tool, after rotary axes
/// of the workpiece if any.
pub fn write(machine: &RealMachine, nodes: usize) -> Result<ExportReport, Diagnostics> {
    let axes = Axes::find(machine)?;
    let slides = &axes.slides;
    let evaluated = |error: Error| mistake::whole(&machine.origin, &error);
    let reference = Reference::at_tool(machine).map_err(evaluated)?;
    let mm = machine.spec.length.in_metres() * 1e3;
    let letters: Vec<char> = slides.iter().map(|slide| slide.letter()).collect();
    let mut files = vec![ExportedFile { name: "rows.csv".to_owned(), text: rows(&letters) }];
    let mut largest = (0.0, String::new());
    for (k, slide) in slides.iter().enumerate() {
        let letter = slide.letter();
        let mut text = format!("{letter} (mm)");
        for (column, direction) in ["X", "Y", "Z", "A", "B", "C"].into_iter().enumerate() {
            let unit = if column < 3 { "mm" } else { "deg" };
            let _ = write!(text, ",C{} E{direction}{letter} ({unit})", column + 1);
        }
        text.push('\n');
        for value in slide.nodes(nodes) {
            let [x, y, z, a, b, c] = reference.errors(machine, &axes, k, value).map_err(evaluated)?;
            let [x, y, z] = [x, y, z].map(|v| v * mm);
            let numbers = [value * mm, x, y, z, a.to_degrees(), b.to_degrees(), c.to_degrees()];
            let _ = writeln!(text, "{}", numbers.map(|number| rounded(number, 9).to_string()).join(","));
            if x.abs().max(y.abs()).max(z.abs()) > largest.0 {
                let own = [x, y, z][slide.axis];
                largest = (x.abs().max(y.abs()).max(z.abs()), sentence(letter, value * mm, own));
            }
        }
        files.push(ExportedFile { name: format!("{}.csv", letter.to_ascii_lowercase()), text });
    }
    let tables: Option<Vec<ErrorTable>> = files[1..].iter().map(|file| read(&file.text)).collect();
    let tables = tables.ok_or_else(|| unreadable("the exported file cannot be read back"))?;
    let corrected = |q: &[f64], _: &[f64]| {
        let [real, ideal] = tool_points(slides, &tables, reference.tool.map(|v| v * mm), q, mm);
        let mut q = q.to_vec();
        slides.iter().for_each(|slide| q[slide.variable] -= (real[slide.axis] - ideal[slide.axis]) / mm);
        q
    };
    let turned = RotaryAxis::all(machine, &axes).map_err(evaluated)?;
    let mut left_out: Vec<String> = turned.iter().map(|axis| axis.sentence(mm)).collect();
    left_out.push(
        "HEIDENHAIN publishes the arrangement of the rows, not the bytes of the files, how a row names \
         its column, or the signs: enter the tables by hand or in its tools, and measure one axis \
         before and after. The figures assume that the control subtracts the errors."
            .to_owned(),
    );
    left_out.push(format!(
        "The rows are those of the linear axes: {} of at most {MOST_ROWS} in COMPTAB. EXX, EYY and EZZ \
         stand in the column of their own axis of its COM file.",
        6 * slides.len()
    ));
    left_out.extend(axes.errors_beyond_own_axis(machine, &[]));
    let format = "rows of KinematicsComp".to_owned();
    let report = ExportReport::for_commands(machine, format, files, corrected, largest.1)?;
    Ok(ExportReport { left_out, turned, ..report })
}

/// Writes the rows from the tool reference point: before each axis its straightness and its
/// rotations.
fn rows(letters: &[char]) -> String {
    let mut text = "NR,DOC,KEY,AXIS,COORD,COMPTAB\n".to_owned();
    let mut number = 0;
    let mut row = |doc: &str, key: &str, axis: char, table: &str| {
        let _ = writeln!(text, "{number},{doc},{key},{axis},,{table}");
        number += 1;
    };
    for letter in letters.iter().rev() {
        for (column, direction) in ['X', 'Y', 'Z', 'A', 'B', 'C'].into_iter().enumerate() {
            if direction != *letter {
                let table = format!("column C{} of {letter}", column + 1);
                row(&format!("E{direction}{letter}"), "Trans", direction, &table);
            }
        }
        row("", "MachAxis", *letter, "");
    }
    text
}

/// Returns the sentence about the sign: the positioning error of an axis.
fn sentence(letter: char, at: f64, own: f64) -> String {
    format!(
        "The tables hold errors, actual minus nominal: at {letter} = {} mm the positioning error of the \
         carriage is {} mm (E{letter}{letter}).",
        digits(at, 6),
        digits(own, 4)
    )
}

/// Reads a table: positions in mm, and errors in mm and rad.
fn read(text: &str) -> Option<ErrorTable> {
    let row = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
        let [at, x, y, z, a, b, c] = numbers?[..] else { return None };
        Some((at, [x, y, z, a.to_radians(), b.to_radians(), c.to_radians()]))
    };
    text.lines().skip(1).map(row).collect()
}
