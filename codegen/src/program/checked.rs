//! Checks of the numbers of a function that let no infinite number and no NaN out.

use abbe_core::{Description, MINIMUM_MARGIN};

use super::{ArrayRows, Block, Program, Role, Routine, Routines, Row, Stage};

/// Powers of ten that a box of arguments may have, the largest first.
const LIMITS: [i32; 9] = [100, 60, 40, 30, 20, 15, 10, 8, 6];

/// Numbers that a function has to check. The functions that it calls check their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Checks {
    /// Indices of the arguments to check.
    pub arguments: Vec<usize>,
    /// Box of the arguments in which the `bounded` results are finite: their largest absolute
    /// value.
    pub limit: f64,
    /// Indices of the results that need no check within the box.
    pub bounded: Vec<usize>,
    /// Indices of the results that need a check everywhere.
    pub unbounded: Vec<usize>,
}

impl Routines {
    /// Returns the checks of a function. `largest` is the largest number of the floating-point
    /// type.
    pub fn checks(&self, routine: &Routine, largest: f64) -> Checks {
        let description = &self.description;
        let some = |index: &usize| !routine.arrays[*index].is_empty(description);
        let of_role =
            |role| (0..routine.arrays.len()).filter(move |array| routine.arrays[*array].role == role);
        let passed_on = |array: &usize| {
            routine.stages.iter().any(|stage| match stage {
                Stage::Call { routine, arrays } => {
                    self.named(routine).function.is_some() && arrays.contains(array)
                }
                _ => false,
            })
        };
        let arguments = of_role(Role::Argument).filter(some).filter(|array| !passed_on(array)).collect();
        let results: Vec<usize> =
            of_role(Role::Result).filter(some).filter(|array| !passed_on(array)).collect();
        let bounded = |limit: f64| -> Vec<usize> {
            let is_bounded = |array: &usize| is_bounded(routine, *array, description, limit, largest);
            results.iter().copied().filter(is_bounded).collect()
        };
        let limits = LIMITS.map(|power| 10_f64.powi(power)).into_iter();
        let mut limits = limits.filter(|limit| *limit < largest * 1e-20);
        let most = bounded(1e6);
        let limit = limits.find(|limit| bounded(*limit) == most).unwrap_or(1e6);
        let unbounded = results.iter().copied().filter(|array| !most.contains(array)).collect();
        Checks { arguments, limit, bounded: most, unbounded }
    }
}

/// Returns `true` if a program writes the array as a whole, with finite numbers only.
fn is_bounded(routine: &Routine, array: usize, description: &Description, limit: f64, largest: f64) -> bool {
    let whole = ArrayRows { array, row: Row::All };
    let mut writers = routine.stages.iter().filter(|stage| stage.writes(array));
    let Some(Stage::Block(Block { reads, program, writes, repeated: None })) = writers.next() else {
        return false;
    };
    if writers.next().is_some() || !reads.is_empty() || !writes.contains(&whole) {
        return false;
    }
    let finite = finite_outputs(routine, program, writes, description, limit, largest);
    let mut first = 0;
    writes.iter().all(|place| {
        let len = routine.arrays[place.array].place_len(place.row, description);
        first += len;
        place.array != array || finite[first - len..first].iter().all(|finite| *finite)
    })
}

/// Returns which outputs of a block are finite, given that its margin will be checked.
fn finite_outputs(
    routine: &Routine,
    program: &Program,
    writes: &[ArrayRows],
    description: &Description,
    limit: f64,
    largest: f64,
) -> Vec<bool> {
    let mut first = 0;
    let margin = writes.iter().find_map(|place| {
        let array = &routine.arrays[place.array];
        first += array.place_len(place.row, description);
        (array.role == Role::Margin).then(|| (program.outputs[first - 1], MINIMUM_MARGIN))
    });
    program.finite_outputs(limit, margin, largest)
}
