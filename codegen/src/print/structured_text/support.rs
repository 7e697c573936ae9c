//! Functions of generated Structured Text, each printed only where it is used.
//!
//! A guarded function sets `fault` where it has no value, and returns 0.

use std::collections::BTreeSet;

use abbe_spec::{Function, Spec};

use crate::procedure::{Procedure, clamped, side, sign};
use crate::program::{Action, Operand, Routines};

/// A function of the file, in the order of printing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Support {
    IsWithin,
    Nearest,
    Clamped,
    CosineAndSine,
    Sine,
    Cosine,
    Arctangent,
    Quotient,
    Root,
    Arcsine,
    Arccosine,
    Power,
    Exponential,
    Logarithm,
    Sign,
    Side,
}

/// Name without the prefix, and source of every function.
const FUNCTIONS: [(Support, &str, Source); 16] = [
    (Support::IsWithin, "is_within", Source::Text(IS_WITHIN)),
    (Support::Nearest, "nearest", Source::Text(NEAREST)),
    (Support::Clamped, "clamped", Source::Described(clamped)),
    (Support::CosineAndSine, "cosine_and_sine", Source::Text(COSINE_AND_SINE)),
    (Support::Sine, "sine", Source::Text(ONE_OF_BOTH)),
    (Support::Cosine, "cosine", Source::Text(ONE_OF_BOTH)),
    (Support::Arctangent, "arctangent", Source::Text(ARCTANGENT)),
    (Support::Quotient, "quotient", Source::Guarded(QUOTIENT)),
    (Support::Root, "root", Source::Guarded(ROOT)),
    (Support::Arcsine, "arcsine", Source::Guarded(ARCSINE)),
    (Support::Arccosine, "arccosine", Source::Guarded(ARCCOSINE)),
    (Support::Power, "power", Source::GuardedText(POWER)),
    (Support::Exponential, "exponential", Source::Guarded(EXPONENTIAL)),
    (Support::Logarithm, "logarithm", Source::Guarded(LOGARITHM)),
    (Support::Sign, "sign", Source::Described(sign)),
    (Support::Side, "side", Source::Described(side)),
];

/// Source of a function.
#[derive(Clone, Copy)]
enum Source {
    Described(fn() -> Procedure),
    Text(&'static str),
    /// The last argument is `fault`.
    GuardedText(&'static str),
    /// Comment, arguments, the condition that there is a value, and the value.
    Guarded([&'static str; 4]),
}

impl Support {
    /// Iterates over the names of all functions.
    pub(super) fn names() -> impl Iterator<Item = &'static str> {
        FUNCTIONS.into_iter().map(|(_, name, ..)| name)
    }

    /// Returns the functions that a file uses.
    pub(super) fn used(spec: &Spec, routines: &Routines, has_commands: bool) -> BTreeSet<Self> {
        let actions = routines.programs().flat_map(|program| program.steps.iter().map(|step| step.action));
        let used = actions.filter_map(|action| match action {
            Action::SinCos(_) => Some(Self::CosineAndSine),
            _ => Self::for_action(action),
        });
        let mut used: BTreeSet<Self> = used.chain([Self::IsWithin]).collect();
        used.extend(has_commands.then_some(Self::Arctangent));
        used.extend((has_commands || !spec.tables.is_empty()).then_some(Self::Clamped));
        if used.contains(&Self::Sine) || used.contains(&Self::Cosine) {
            used.insert(Self::CosineAndSine);
        }
        if used.contains(&Self::CosineAndSine) || !spec.tables.is_empty() {
            used.insert(Self::Nearest);
        }
        used
    }

    /// Returns the function that an action calls, if any.
    pub(super) fn for_action(action: Action) -> Option<Self> {
        Some(match action {
            Action::Div(_, Operand::Constant(divisor)) if divisor != 0.0 => return None,
            Action::Div(..) => Self::Quotient,
            Action::Pow(..) => Self::Power,
            Action::Atan2(..) => Self::Arctangent,
            Action::Call(function, _) => match function {
                Function::Sin => Self::Sine,
                Function::Cos => Self::Cosine,
                Function::Sqrt => Self::Root,
                Function::Asin => Self::Arcsine,
                Function::Acos => Self::Arccosine,
                Function::Exp => Self::Exponential,
                Function::Log => Self::Logarithm,
                Function::Sign => Self::Sign,
                Function::Side => Self::Side,
                Function::Tan | Function::Atan | Function::Abs => return None,
            },
            _ => return None,
        })
    }

    /// Returns the name without the prefix.
    pub(super) const fn name(self) -> &'static str {
        FUNCTIONS[self as usize].1
    }

    /// Returns `true` if the last argument is `fault`.
    pub(super) const fn is_guarded(self) -> bool {
        !matches!(FUNCTIONS[self as usize].2, Source::Text(_) | Source::Described(_))
    }

    /// Returns the function if it is described.
    pub(super) fn described(self) -> Option<Procedure> {
        match FUNCTIONS[self as usize].2 {
            Source::Described(describe) => Some(describe()),
            _ => None,
        }
    }

    /// Returns the source of a function that is not described.
    pub(super) fn text(self, prefix: &str) -> String {
        let text = match FUNCTIONS[self as usize].2 {
            Source::Described(_) => String::new(),
            Source::Text(text) | Source::GuardedText(text) => text.to_owned(),
            Source::Guarded(parts) => {
                let parts = ["COMMENT", "ARGUMENTS", "CONDITION", "VALUE"].into_iter().zip(parts);
                parts.fold(GUARDED.to_owned(), |text, (part, with)| text.replace(part, with))
            }
        };
        text.replace("PREFIX", prefix).replace("NAME", self.name())
    }
}

/// `>` and `>=` are false for NaN even where a compiler ignores that NaN has no order.
const IS_WITHIN: &str = include_str!("is_within.st");

/// Rounding to nearest differs among controllers, and some truncate.
const NEAREST: &str = include_str!("nearest.st");

const GUARDED: &str = include_str!("guarded.st");

const QUOTIENT: [&str; 4] = [
    "Quotient; a fault if it does not exist or exceeds 1E74.",
    "dividend, divisor",
    "ABS(divisor) > ABS(dividend) * LREAL#1.0E-37 * LREAL#1.0E-37",
    "dividend / divisor",
];
const ROOT: [&str; 4] = ["Square root; a fault for negative numbers.", "x", "x >= LREAL#0.0", "SQRT(x)"];
const WITHIN_ONE: &str = "PREFIX_is_within(x, -LREAL#1.0, LREAL#1.0)";
const ARCSINE: [&str; 4] = ["Inverse sine; a fault beyond -1 and 1.", "x", WITHIN_ONE, "ASIN(x)"];
const ARCCOSINE: [&str; 4] = ["Inverse cosine; a fault beyond -1 and 1.", "x", WITHIN_ONE, "ACOS(x)"];
const EXPONENTIAL: [&str; 4] =
    ["Exponential function; a fault for numbers of about 1E300 and more.", "x", "LREAL#690.0 > x", "EXP(x)"];
const LOGARITHM: [&str; 4] =
    ["Natural logarithm; a fault for numbers that are not positive.", "x", "x > LREAL#0.0", "LN(x)"];

const ONE_OF_BOTH: &str = include_str!("one_of_both.st");

/// The constants are those of `abbe`'s `sin_cos`; a test checks that both return the same bits.
const COSINE_AND_SINE: &str = include_str!("cosine_and_sine.st");

const ARCTANGENT: &str = include_str!("arctangent.st");

const POWER: &str = include_str!("power.st");
