//! Functions of generated Structured Text, each printed only where it is used.
//!
//! A guarded function sets `fault` where it has no value, and returns 0.

use std::collections::BTreeSet;

use abbe_spec::Spec;
use abbe_spec::expr::Function;

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
    pub(super) fn used(spec: &Spec, routines: &Routines, has_compensated: bool) -> BTreeSet<Self> {
        let programs = routines.programs();
        let actions = programs.flat_map(|program| program.steps.iter().map(|step| step.action));
        let used = actions.filter_map(|action| match action {
            Action::SinCos(_) => Some(Self::CosineAndSine),
            _ => Self::for_action(action),
        });
        let mut used: BTreeSet<Self> = used.chain([Self::IsWithin]).collect();
        used.extend(has_compensated.then_some(Self::Arctangent));
        used.extend((has_compensated || !spec.tables.is_empty()).then_some(Self::Clamped));
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
const IS_WITHIN: &str = "\
(* Returns TRUE if a number is within an interval, and FALSE for NaN. Comparisons are by >= because
   a compiler for x86 or ARM that ignores that NaN has no order still gets these right. *)
FUNCTION PREFIX_is_within : BOOL
VAR_INPUT
    value, lower, upper : LREAL;
END_VAR
PREFIX_is_within := (value >= lower) AND (upper >= value);
END_FUNCTION
";

/// Rounding to nearest differs among controllers, and some truncate.
const NEAREST: &str = "\
(* Returns the nearest whole number, whichever way the controller converts. *)
FUNCTION PREFIX_nearest : DINT
VAR_INPUT
    x : LREAL;
END_VAR
VAR
    whole : DINT;
    rest : LREAL;
END_VAR
whole := LREAL_TO_DINT(x);
rest := x - DINT_TO_LREAL(whole);
IF rest > LREAL#0.5 THEN
    whole := whole + 1;
ELSIF rest < -LREAL#0.5 THEN
    whole := whole - 1;
END_IF;
PREFIX_nearest := whole;
END_FUNCTION
";

const GUARDED: &str = "\
(* COMMENT *)
FUNCTION PREFIX_NAME : LREAL
VAR_INPUT
    ARGUMENTS : LREAL;
END_VAR
VAR_IN_OUT
    fault : BOOL;
END_VAR
IF CONDITION THEN
    PREFIX_NAME := VALUE;
ELSE
    PREFIX_NAME := LREAL#0.0;
    fault := TRUE;
END_IF;
END_FUNCTION
";

const QUOTIENT: [&str; 4] = [
    "Quotient; a fault if it does not exist or exceeds 1E300.",
    "dividend, divisor",
    "ABS(divisor) > ABS(dividend) * LREAL#1.0E-300",
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

const ONE_OF_BOTH: &str = "\
FUNCTION PREFIX_NAME : LREAL
VAR_INPUT
    x : LREAL;
END_VAR
VAR
    sine, cosine : LREAL;
END_VAR
cosine := PREFIX_cosine_and_sine(x, sine);
PREFIX_NAME := NAME;
END_FUNCTION
";

/// The constants are those of `abbe`'s `sin_cos`; a test checks that both return the same bits.
const COSINE_AND_SINE: &str = "\
(* Returns the cosine, and the sine in its second argument. For |x| <= 1E5 the error is below 1.7
   units in the last place: Cody-Waite reduction by quarter turns, then minimax polynomials. For
   larger |x|, the controller's functions are used. *)
FUNCTION PREFIX_cosine_and_sine : LREAL
VAR_INPUT
    x : LREAL;
END_VAR
VAR_IN_OUT
    sine : LREAL;
END_VAR
VAR
    quadrant : DINT;
    turns, rest, z, sn, cs, other : LREAL;
END_VAR
IF NOT PREFIX_is_within(x, -LREAL#1.0E5, LREAL#1.0E5) THEN
    sine := SIN(x);
    PREFIX_cosine_and_sine := COS(x);
    RETURN;
END_IF;
IF NOT (ABS(x) > LREAL#0.0) THEN
    sine := x;
    PREFIX_cosine_and_sine := LREAL#1.0;
    RETURN;
END_IF;
quadrant := PREFIX_nearest(x * LREAL#0.6366197723675814);
turns := DINT_TO_LREAL(quadrant);
(* 0 to 3, also for negative angles. *)
quadrant := (quadrant + 400000) MOD 4;
rest := x - turns * LREAL#1.5707963267923333;
rest := rest - turns * LREAL#2.5632829192545614E-12;
rest := rest - turns * LREAL#6.123233995707727E-17;
rest := rest - turns * LREAL#2.9038559739793605E-28;
z := rest * rest;
IF (quadrant MOD 2) = 1 THEN
    rest := -rest;
END_IF;
sn := LREAL#1.58969099521155E-10;
sn := z * sn - LREAL#2.5050760253406863E-8;
sn := z * sn + LREAL#2.7557313707070068E-6;
sn := z * sn - LREAL#0.0001984126982985795;
sn := z * sn + LREAL#0.00833333333332249;
sn := z * sn - LREAL#0.16666666666666632;
sn := (rest * z) * sn + rest;
cs := LREAL#2.087572321298175E-9 - z * LREAL#1.1359647557788195E-11;
cs := z * cs - LREAL#2.7557314351390663E-7;
cs := z * cs + LREAL#2.480158728947673E-5;
cs := z * cs - LREAL#0.001388888888887411;
cs := z * cs + LREAL#0.0416666666666666;
cs := z * cs - LREAL#0.5;
cs := z * cs + LREAL#1.0;
IF (quadrant MOD 2) = 1 THEN
    other := sn;
    sn := cs;
    cs := other;
END_IF;
IF quadrant >= 2 THEN
    sn := -sn;
    cs := -cs;
END_IF;
sine := sn;
PREFIX_cosine_and_sine := cs;
END_FUNCTION
";

const ARCTANGENT: &str = "\
(* Angle of the point (x, y), which the standard has no function for. 0 at the origin. *)
FUNCTION PREFIX_arctangent : LREAL
VAR_INPUT
    y, x : LREAL;
END_VAR
VAR
    angle : LREAL;
END_VAR
IF ABS(x) > ABS(y) THEN
    angle := ATAN(y / x);
    IF LREAL#0.0 > x THEN
        IF LREAL#0.0 > y THEN
            angle := angle - LREAL#3.141592653589793;
        ELSE
            angle := angle + LREAL#3.141592653589793;
        END_IF;
    END_IF;
ELSIF y > LREAL#0.0 THEN
    angle := LREAL#1.5707963267948966 - ATAN(x / y);
ELSIF LREAL#0.0 > y THEN
    angle := -LREAL#1.5707963267948966 - ATAN(x / y);
ELSE
    angle := LREAL#0.0;
END_IF;
PREFIX_arctangent := angle;
END_FUNCTION
";

const POWER: &str = "\
(* Power; a fault for what has no real value, and for numbers of about 1E300 and more. *)
FUNCTION PREFIX_power : LREAL
VAR_INPUT
    base, exponent : LREAL;
END_VAR
VAR_IN_OUT
    fault : BOOL;
END_VAR
VAR
    whole : DINT;
    size : LREAL;
    is_valid, is_odd : BOOL;
END_VAR
PREFIX_power := LREAL#0.0;
is_odd := FALSE;
is_valid := base > LREAL#0.0;
size := ABS(base);
IF (LREAL#0.0 > base) AND PREFIX_is_within(exponent, -LREAL#1.0E9, LREAL#1.0E9) THEN
    whole := LREAL_TO_DINT(exponent);
    is_valid := DINT_TO_LREAL(whole) = exponent;
    is_odd := (whole MOD 2) <> 0;
END_IF;
IF is_valid THEN
    is_valid := LREAL#690.0 > exponent * LN(size);
    IF is_valid THEN
        PREFIX_power := EXPT(size, exponent);
        IF is_odd THEN
            PREFIX_power := -EXPT(size, exponent);
        END_IF;
    END_IF;
ELSIF NOT (size > LREAL#0.0) AND (exponent >= LREAL#0.0) THEN
    is_valid := TRUE;
    IF NOT (exponent > LREAL#0.0) THEN
        PREFIX_power := LREAL#1.0;
    END_IF;
END_IF;
fault := fault OR NOT is_valid;
END_FUNCTION
";
