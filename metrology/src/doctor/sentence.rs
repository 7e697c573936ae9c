//! Conclusion in one sentence.

use abbe_spec::Spec;

use super::report::Finding;
use abbe_study::number::digits;

/// Returns the conclusion in one sentence. `columns` are those of the joints, row by row.
pub(super) fn sentence(
    found: &[Finding],
    others: &[Finding],
    spec: &Spec,
    within: f64,
    columns: &[Vec<f64>],
) -> String {
    let unit = spec.length.symbol();
    match found {
        [] => {
            let nearest = match others.first() {
                None => "no interpretation of these columns fits".to_owned(),
                Some(one) => {
                    let turns = one.angle.map_or(String::new(), |angle| {
                        format!(
                            " of the positions and {}° of the orientations",
                            digits(angle.to_degrees(), 3)
                        )
                    });
                    let (within, left) = (digits(within, 3), digits(one.residual, 3));
                    format!(
                        "the closest leaves {left} {unit}{turns}, and the limit is {within} \
                        {unit}"
                    )
                }
            };
            let check = at_rest(spec, columns).unwrap_or_else(|| {
                "Check that these are data of this machine, and which columns are the joints.".to_owned()
            });
            format!("No interpretation fits: {nearest}. {check}")
        }
        [only] => {
            format!(
                "One interpretation fits, with an error of {} {unit}: {}.",
                digits(only.residual, 3),
                only.words
            )
        }
        [first, rest @ ..] => format!(
            "{} interpretations fit these rows equally well; the simplest has an error of {} \
             {unit}: {}.",
            rest.len() + 1,
            digits(first.residual, 3),
            first.words
        ),
    }
}

/// Names the joints that do not move, if there are any: the rows then say too little about the
/// machine.
fn at_rest(spec: &Spec, columns: &[Vec<f64>]) -> Option<String> {
    let first = columns.first()?;
    let is_at_rest = |joint: &usize| columns.iter().all(|row| row[*joint] == first[*joint]);
    let names = |joints: Vec<usize>| -> Vec<&str> {
        joints.into_iter().map(|joint| spec.variables[joint].name.as_str()).collect()
    };
    let (still, moved): (Vec<usize>, Vec<usize>) = (0..first.len()).partition(is_at_rest);
    let (still, moved) = (names(still), names(moved));
    let verb = if still.len() == 1 { "does" } else { "do" };
    (!still.is_empty()).then(|| {
        format!(
            "{} {verb} not move in these rows, only {}: too little to tell whether they are data of this \
             machine. Use rows in which every joint moves.",
            still.join(", "),
            moved.join(", ")
        )
    })
}
