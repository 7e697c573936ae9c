//! Combinations of unknowns that cannot be distinguished, by the reason.

use abbe_metrology::identify::{Indistinguishable, IndistinguishableReason as Reason};
use abbe_study::number::digits;

use crate::document::Table;

/// Tabulates unknowns that cannot be distinguished.
pub(in crate::views) fn indistinguishable(groups: &[Indistinguishable]) -> Table {
    let row = |groups: &[Indistinguishable]| {
        let sentences: Vec<String> = groups.iter().map(sentence).collect();
        [reason(&groups[0].reason), sentences.join("\n")]
    };
    let rows = groups.chunk_by(|one, next| one.reason == next.reason).map(row);
    Table::new("", ["because", "indistinguishable errors"]).rows(rows)
}

/// States the combination, such as `e_z1 acts as e_z2`.
fn sentence(group: &Indistinguishable) -> String {
    let these = combination(&group.these);
    match (&group.act_as[..], group.these.len()) {
        ([], _) => format!("{these} cannot be observed"),
        (others, 1) => format!("{these} acts as {}", combination(others)),
        (others, _) => format!("{these} act as {}", combination(others)),
    }
}

/// Formats a combination, such as `e_r2 − 425 e_y2`.
pub(in crate::views) fn combination(terms: &[(String, f64)]) -> String {
    let mut text = String::new();
    for (name, factor) in terms {
        let size = digits(factor.abs(), 4);
        let factor_text = if size == "1" { String::new() } else { format!("{size} ") };
        let sign = match (text.is_empty(), *factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        text += &format!("{sign}{factor_text}{name}");
    }
    text
}

/// States the reason.
fn reason(reason: &Reason) -> String {
    match reason {
        Reason::Revolute(joint) => format!(
            "{joint} is revolute: errors about and along its axis are indistinguishable from those of \
             the next frame"
        ),
        Reason::Prismatic(joint) => format!(
            "{joint} is prismatic: translations, and rotations about its axis, are indistinguishable \
             from those of the next frame"
        ),
        Reason::NotMoved(joint) => format!("{joint} does not move in these data"),
        Reason::Fixed { frame, name } => format!("the frame {frame} ({name}) is fixed"),
        Reason::UnknownMounting => "the mounting of the target on the tool is unknown".to_owned(),
        Reason::SingleTarget => "rotations about a single target do not move it".to_owned(),
        Reason::UnknownPlacement => "the placement of the instruments is unknown: motions of the whole \
                                     machine are indistinguishable from it"
            .to_owned(),
    }
}
