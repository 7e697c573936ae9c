//! Text of an import.

use std::fmt::Write;

use abbe_study::import::{ImportedFrame, Report};
use abbe_study::number::counted;

/// Prints the summary of an imported robot.
pub fn imported(report: &Report) -> String {
    let Report { manipulator, base, tip, frames, loads, largest_difference, configurations, length, .. } =
        report;
    let moving = frames.iter().filter(|frame| frame.variable.is_some()).count();
    let mut text = format!(
        "{manipulator}: from {base} to {tip}, {}, {moving} of them moved, {} as loads\n\n",
        counted(frames.len(), "frame", "frames"),
        counted(*loads, "mass", "masses")
    );
    let width = frames.iter().map(|frame| frame.joint.chars().count()).max().unwrap_or_default();
    for ImportedFrame { joint, link, variable, follows } in frames {
        let variable = match variable {
            None => "fixed".to_owned(),
            Some(name) if *follows => format!("follows {name}"),
            Some(name) => name.clone(),
        };
        let _ = match link {
            Some(link) => writeln!(text, "  {joint:width$}  {variable:width$}  carries {link}"),
            None => writeln!(text, "  {joint:width$}  {variable}"),
        };
    }
    let _ = writeln!(
        text,
        "\nThe poses of the spec agree with the file: at {configurations} configurations they \
         differ by at most {largest_difference:.1e} {length} or rad."
    );
    text
}
