//! Static helper functions of generated C, each printed only where it is used.

use std::collections::BTreeSet;

use abbe_spec::expr::Function;

use super::real::Real;
use crate::program::{Action, Routines};

/// A static helper function, in the order of printing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Support {
    SinCos,
    Sine,
    Cosine,
    Least,
    Greater,
    Sign,
    Side,
    LookUp,
}

impl Support {
    /// Returns the helpers that the routines use.
    pub(super) fn used(routines: &Routines) -> BTreeSet<Self> {
        let programs = routines.programs();
        let actions = programs.flat_map(|program| program.steps.iter().map(|step| step.action));
        let mut used: BTreeSet<Self> = actions.filter_map(Self::for_action).collect();
        if used.contains(&Self::Sine) || used.contains(&Self::Cosine) {
            used.insert(Self::SinCos);
        }
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
            Action::Lookup(..) => Some(Self::LookUp),
            _ => None,
        }
    }

    /// Returns the source of the helper.
    pub(super) fn text(self, real: Real) -> String {
        let text = match self {
            Self::SinCos if real == Real::Float => return SIN_COS_FLOAT.to_owned(),
            Self::SinCos => SIN_COS,
            Self::Sine => SINE,
            Self::Cosine => COSINE,
            Self::Least => LEAST,
            Self::Greater => GREATER,
            Self::Sign => SIGN,
            Self::Side => SIDE,
            Self::LookUp => LOOK_UP,
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

/// The constants are those of `abbe`'s `sin_cos`; a test checks that both return the same bits.
const SIN_COS: &str = "\
/* Sine and cosine. For |x| <= 1e5 the error is below 1.7 units in the last place and results are
 * identical on all machines: Cody-Waite reduction by quarter turns, then minimax polynomials. For
 * larger |x|, and at 0, math.h is used. Requires rounding to nearest, and no contraction of
 * a * b + c. */
static void sin_cos(double x, double *sine, double *cosine)
{
    const double round = 6755399441055744.0;
    if (!(fabs(x) <= 1e5) || !(fabs(x) > 0.0)) {
        *sine = sin(x);
        *cosine = cos(x);
        return;
    }
    const double rounded = x * 0.6366197723675814 + round;
    const double turns = rounded - round;
    const unsigned quadrant = (unsigned)(int)turns & 3U;
    double r = x - turns * 1.5707963267923333;
    r = r - turns * 2.5632829192545614e-12;
    r = r - turns * 6.123233995707727e-17;
    r = r - turns * 2.9038559739793605e-28;
    const double z = r * r;
    if ((quadrant & 1U) != 0U) {
        r = -r;
    }
    double s = 1.58969099521155e-10;
    s = z * s + -2.5050760253406863e-8;
    s = z * s + 2.7557313707070068e-6;
    s = z * s + -0.0001984126982985795;
    s = z * s + 0.00833333333332249;
    s = z * s + -0.16666666666666632;
    s = (r * z) * s + r;
    double c = z * -1.1359647557788195e-11 + 2.087572321298175e-9;
    c = z * c + -2.7557314351390663e-7;
    c = z * c + 2.480158728947673e-5;
    c = z * c + -0.001388888888887411;
    c = z * c + 0.0416666666666666;
    c = z * c + -0.5;
    c = z * c + 1.0;
    if ((quadrant & 1U) != 0U) {
        const double other = s;
        s = c;
        c = other;
    }
    *sine = ((quadrant & 2U) != 0U) ? -s : s;
    *cosine = ((quadrant & 2U) != 0U) ? -c : c;
}
";

/// Single precision. π/2 is subtracted in four parts of 12, 12, 12 and the remaining bits. Times an
/// n below 2¹² the first three parts are exact, and so are the first two differences. `S` and `C`
/// of degree 2 are minimax polynomials (Remez; coefficients rounded from the lowest power on,
/// refitting the rest each time). A test compares them with the best achievable ones.
const SIN_COS_FLOAT: &str = "\
/* Sine and cosine. For |x| <= 6e3 the error is below 2.4 units in the last place and results are
 * identical on all machines: Cody-Waite reduction by quarter turns, then minimax polynomials. For
 * larger |x|, and at 0, math.h is used. Requires rounding to nearest, and no contraction of
 * a * b + c. */
static void sin_cos(float x, float *sine, float *cosine)
{
    const float round = 12582912.0f;
    if (!(fabsf(x) <= 6e3f) || !(fabsf(x) > 0.0f)) {
        *sine = sinf(x);
        *cosine = cosf(x);
        return;
    }
    const float rounded = x * 0.63661975f + round;
    const float turns = rounded - round;
    const unsigned quadrant = (unsigned)(int)turns & 3U;
    float r = x - turns * 1.5703125f;
    r = r - turns * 0.0004837513f;
    r = r - turns * 7.5495336e-8f;
    r = r - turns * 2.563344e-12f;
    const float z = r * r;
    if ((quadrant & 1U) != 0U) {
        r = -r;
    }
    float s = -0.00019518292f;
    s = z * s + 0.008332189f;
    s = z * s + -0.16666655f;
    s = (r * z) * s + r;
    float c = z * 2.4432327e-5f + -0.001388731f;
    c = z * c + 0.041666646f;
    c = z * c + -0.5f;
    c = z * c + 1.0f;
    if ((quadrant & 1U) != 0U) {
        const float other = s;
        s = c;
        c = other;
    }
    *sine = ((quadrant & 2U) != 0U) ? -s : s;
    *cosine = ((quadrant & 2U) != 0U) ? -c : c;
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

const LOOK_UP: &str = "\
/* A function defined by points: piecewise polynomials, found by buckets of equal width. */
typedef struct {
    double first;
    double scale;
    int buckets;
    int stride;
    const int *starts;
    const double *knots;
    int knots_count;
    const double (*pieces)[4];
} lookup_table;

/* Returns a derivative of a table at x; order 0 is the table itself. */
static double look_up(const lookup_table *table, int order, double x)
{
    const double round = ROUND;
    const double u = (x - table->first) * table->scale;
    double bucket = u - 0.5;
    if (isnan(u) != 0) {
        return u;
    }
    bucket = (bucket > -1.0) ? bucket : -1.0;
    bucket = (bucket < (double)table->buckets) ? bucket : (double)table->buckets;
    bucket = (bucket + round) - round;
    int piece = (int)bucket + 1;
    double t = u - bucket;
    double unit = table->scale;
    if (table->knots_count > 0) {
        piece = table->starts[piece];
        for (int stride = table->stride; stride > 0; stride /= 2) {
            const int next = piece + stride;
            if (next < table->knots_count && x > table->knots[next]) {
                piece = next;
            }
        }
        t = x - table->knots[piece];
        unit = 1.0;
    }
    const double *p = table->pieces[piece];
    switch (order) {
    case 0:
        return t * (t * (t * p[3] + p[2]) + p[1]) + p[0];
    case 1:
        return unit * (t * (t * (3.0 * p[3]) + 2.0 * p[2]) + p[1]);
    case 2:
        return unit * (unit * (t * (6.0 * p[3]) + 2.0 * p[2]));
    default:
        return unit * (unit * (unit * (6.0 * p[3])));
    }
}
";
