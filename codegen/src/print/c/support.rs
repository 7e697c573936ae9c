//! Static helper functions of generated C, each printed only where it is used.

use std::collections::BTreeSet;

use abbe_spec::expr::Function;

use super::real::Real;
use super::sines;
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
    Greater,
    Sign,
    Side,
    Clamped,
}

impl Support {
    /// Returns the helpers that the functions with this text use.
    pub(super) fn used(routines: &Routines, functions: &str) -> BTreeSet<Self> {
        let programs = routines.programs();
        let actions = programs.flat_map(|program| program.steps.iter().map(|step| step.action));
        let mut used: BTreeSet<Self> = actions.filter_map(Self::for_action).collect();
        let is_clamped = routines.has_compensated() || routines.used_lookup_tables().next().is_some();
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
            Action::Max(..) => Some(Self::Greater),
            _ => None,
        }
    }

    /// Returns the source of the helper.
    pub(super) fn text(self, real: Real) -> String {
        let text = match self {
            Self::SinCos => return sines::one(real),
            Self::SinCosTwo => return sines::several(real, 2),
            Self::SinCosFour => return sines::several(real, 4),
            Self::Sine => SINE,
            Self::Cosine => COSINE,
            Self::Least => LEAST,
            Self::Greater => GREATER,
            Self::Sign => SIGN,
            Self::Side => SIDE,
            Self::Clamped => CLAMPED,
        };
        real.text(text).replace("ROUND", &real.rounder())
    }
}

/// Compares without branches, so that compilers can vectorize the loop.
pub(super) const ARE_BELOW: &str = "\
/* Returns 1 if the absolute value of every number is below the limit, else 0; NaN is not. */
static int are_below(const double *numbers, int count, double limit)
{
    unsigned wrong = 0U;
    for (int k = 0; k < count; k++) {
        wrong |= (fabs(numbers[k]) < limit) ? 0U : 1U;
    }
    return (wrong == 0U) ? 1 : 0;
}
";

const SINE: &str = "\
static double sine(double x)
{
    double s;
    double c;
    sin_cos(x, &s, &c);
    return s;
}
";

const COSINE: &str = "\
static double cosine(double x)
{
    double s;
    double c;
    sin_cos(x, &s, &c);
    return c;
}
";

const LEAST: &str = "\
/* Returns the smaller of two numbers, or NaN if one of them is NaN. */
static double least(double a, double b)
{
    return (a < b || isnan(a) != 0) ? a : b;
}
";

const GREATER: &str = "\
/* Returns the larger of two numbers, or NaN if one of them is NaN. */
static double greater(double a, double b)
{
    return (a > b || isnan(a) != 0) ? a : b;
}
";

const SIGN: &str = "\
/* Returns -1, 0 or 1. */
static double sign(double x)
{
    return (x > 0.0) ? 1.0 : ((x < 0.0) ? -1.0 : x * 0.0);
}
";

const SIDE: &str = "\
/* Returns -1 for negative numbers, else 1: the derivative of the absolute value, at 0 the right-hand one. */
static double side(double x)
{
    return (x >= 0.0) ? 1.0 : ((x < 0.0) ? -1.0 : x);
}
";

const CLAMPED: &str = "\
/* Returns the nearest value of an interval, and its lower end for NaN. */
static double clamped(double value, double lower, double upper)
{
    const double above = (value > lower) ? value : lower;
    return (above < upper) ? above : upper;
}
";
