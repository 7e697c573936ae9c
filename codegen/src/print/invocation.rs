//! Calls of the functions of a file.

use crate::program::{Array, Role, Routines};

/// A call of a generated function, or of a helper of several functions.
pub(super) struct Invocation {
    pub(super) routine: &'static str,
    pub(super) is_function: bool,
    /// Names of the arguments: those of the routine, and those of the caller.
    pub(super) given: Vec<(&'static str, String)>,
    /// Names and sizes of the results, and the variables of the caller that take them.
    pub(super) filled: Vec<(&'static str, usize, String)>,
    /// `true` if variables of a procedure take the results.
    pub(super) in_procedure: bool,
}

/// Returns the call of a generated function at joint variables `q`: without empty arrays if
/// `skips_empty`.
pub(super) fn evaluated(
    Routines { description, list, .. }: &Routines,
    function: &'static str,
    q: &'static str,
    results: &[&'static str],
    skips_empty: bool,
) -> Invocation {
    let arrays = list.iter().filter(|routine| routine.name == function).flat_map(|routine| &routine.arrays);
    let arrays = arrays.filter(|array| !(skips_empty && array.is_empty(description)));
    let of_role = |role| arrays.clone().filter(move |array| array.role == role);
    let given = of_role(Role::Argument).map(|Array { name, .. }| {
        let own = if *name == "q" { q } else { name };
        (*name, own.to_owned())
    });
    let filled = of_role(Role::Result).zip(results);
    let filled = filled.map(|(array, own)| (array.name, array.len(description), str::to_owned(own)));
    let (given, filled) = (given.collect(), filled.collect());
    Invocation { routine: function, is_function: true, given, filled, in_procedure: true }
}
