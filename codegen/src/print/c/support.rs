//! Static helper functions of generated C, each printed only where it is used.

use std::collections::BTreeSet;

use abbe_spec::Function;

use super::{CPrinter, Real, sines};
use crate::print::{Printer, Writer};
use crate::procedure::{clamped, least_and_greatest, side, sign};
use crate::program::{Action, Routines};

/// A static helper function, in the order of printing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Support {
    SinCos,
    SinCosTwo,
    SinCosFour,
    Sine,
    Cosine,
    Least,
    Greatest,
    Sign,
    Side,
    Clamped,
}

impl Support {
    /// Returns the helpers that the functions with this text use.
    pub(super) fn used(routines: &Routines, functions: &str) -> BTreeSet<Self> {
        let actions = routines.programs().flat_map(|program| program.steps.iter().map(|step| step.action));
        let mut used: BTreeSet<Self> = actions.filter_map(Self::for_action).collect();
        let is_clamped = routines.has_commands() || routines.used_lookup_tables().next().is_some();
        used.extend(Some(Self::Clamped).filter(|_| is_clamped));
        if used.contains(&Self::Sine) || used.contains(&Self::Cosine) {
            used.insert(Self::SinCos);
        }
        let several = [(Self::SinCosTwo, 2), (Self::SinCosFour, 4)];
        let calls = |(_, count): &(Self, usize)| functions.contains(&format!("sin_cos_{count}("));
        used.extend(several.into_iter().filter(calls).map(|(support, _)| support));
        used
    }

    fn for_action(action: Action) -> Option<Self> {
        match action {
            Action::SinCos(_) => Some(Self::SinCos),
            Action::Call(Function::Sin, _) => Some(Self::Sine),
            Action::Call(Function::Cos, _) => Some(Self::Cosine),
            Action::Call(Function::Sign, _) => Some(Self::Sign),
            Action::Call(Function::Side, _) => Some(Self::Side),
            Action::Min(..) => Some(Self::Least),
            Action::Max(..) => Some(Self::Greatest),
            _ => None,
        }
    }

    /// Returns the source of the helper.
    pub(super) fn text(self, routines: &Routines, real: Real) -> String {
        let [least, greatest] = least_and_greatest();
        let procedure = match self {
            Self::SinCos => return sines::one(real),
            Self::SinCosTwo => return sines::several(real, 2),
            Self::SinCosFour => return sines::several(real, 4),
            Self::Sine => return real.text(&ONE_OF_BOTH.replace("NAME", "sine")),
            Self::Cosine => return real.text(&ONE_OF_BOTH.replace("NAME", "cosine")),
            Self::Least => least,
            Self::Greatest => greatest,
            Self::Sign => sign(),
            Self::Side => side(),
            Self::Clamped => clamped(),
        };
        let mut writer = Writer::new(" *");
        CPrinter { writer: &mut writer, routines, real }.helper(&procedure, procedure.name, None);
        writer.finish().trim_start().to_owned()
    }
}

/// Compares without branches, so that compilers can vectorize the loop.
pub(super) const ARE_BELOW: &str = include_str!("are_below.c");

const ONE_OF_BOTH: &str = include_str!("one_of_both.c");
