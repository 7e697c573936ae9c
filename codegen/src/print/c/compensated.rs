//! Corrected commands in C, by the fixed number of steps of `abbe::compensator`.

use abbe_core::compensator::Status;
use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::{SIZE, documentation, head};
use super::real::Real;
use super::shortest::Solver;
use crate::print::compensated::{meaning, numbered, units};
use crate::print::layout::Writer;
use crate::program::Routines;

pub(super) fn declaration(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    if !routines.has_compensated() {
        return;
    }
    writer.blank();
    let own = Status::ALL.into_iter().filter(|status| *status != Status::Reached);
    let own: Vec<&'static str> = own.map(Status::name).collect();
    let upper = spec.name.to_ascii_uppercase();
    let end = format!(
        "With `{upper}_OK` and the statuses from `{upper}_NOT_CONVERGED` on, the commands are within the limits and the \
         bounds, and `after` is what is left at them. `{upper}_OK`: {} With any other status, nothing is written. Arrays \
         may overlap: `corrected` may be `q`, and `correction` may be `last`",
        meaning(Status::Reached, &Solver::new(real).tolerances)
    );
    documentation(writer, &routines.description, &COMPENSATED, &own, Some(&end));
    writer.lines(&format!("{};", head(routines, &COMPENSATED, real, SIZE)));
}

pub(super) fn definition(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    if !routines.has_compensated() {
        return;
    }
    writer.blank();
    writer.lines("/* 1 rad or 1 m in the unit of each variable. */");
    let units: Vec<String> = units(spec).map(|unit| real.number(unit)).collect();
    writer.braces(&format!("static const {real} UNITS[{}] = ", units.len()), &units, ";");
    let six_or_more = units.len() >= 6;
    let Solver { texts, tolerances } = Solver::new(real);
    let [before, shortest] = [texts[0], texts[if six_or_more { 2 } else { 1 }]];
    let written = TEXT.replace("SHORTEST", &[before, shortest].concat());
    let placed = [
        ("FULL", units.len().max(6).to_string()),
        ("LONG", (6 + units.len()).to_string()),
        ("RANK", units.len().min(6).to_string()),
        ("NAME", spec.name.clone()),
        ("UPPER", spec.name.to_ascii_uppercase()),
    ];
    let (before, after) = written.split_once("HEAD").unwrap_or((&written, ""));
    let [before, after] = [before, after].map(|text| {
        let text = numbered(&real.text(text), spec, &tolerances, |value| real.number(value));
        placed.iter().fold(text, |text, (what, value)| text.replace(what, value))
    });
    let [s, u] = [("s", spec.parameters.len()), ("u", spec.inputs.len())]
        .map(|(name, len)| if len > 0 { format!(" {name},") } else { String::new() });
    let after = after.replace("_ALL", &[&s[..], &u].concat()).replace("_IDEAL", &s);
    let text = [before, head(routines, &COMPENSATED, real, SIZE), after].concat();
    writer.blank();
    writer.lines(text.trim_end());
}

const TEXT: &str = "\
/* Returns the nearest value of an interval, and its lower end for NaN. */
static double clamped(double value, double lower, double upper)
{
    const double above = (value > lower) ? value : lower;
    return (above < upper) ? above : upper;
}

static double dot(const double *a, const double *b, int count)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) {
        sum += a[k] * b[k];
    }
    return sum;
}

static void copied(const double *from, double *to, int count)
{
    for (int k = 0; k < count; k++) {
        to[k] = from[k];
    }
}

/* Deviation of the real from the ideal pose: position in F_0, and the rotation vector of R_real R_ideal^T. */
static void deviation(const double *ideal, const double *real, double *rows)
{
    double turn[3][3];
    double v[3];
    for (int i = 0; i < 3; i++) {
        rows[i] = real[9 + i] - ideal[9 + i];
        for (int j = 0; j < 3; j++) {
            turn[i][j] = real[i] * ideal[j] + real[3 + i] * ideal[3 + j] + real[6 + i] * ideal[6 + j];
        }
    }
    v[0] = turn[2][1] - turn[1][2];
    v[1] = turn[0][2] - turn[2][0];
    v[2] = turn[1][0] - turn[0][1];
    const double twice_sine = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double angle = atan2(twice_sine, turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
    const double scale = (twice_sine < LEAST_SINE) ? 0.5 : angle / twice_sine;
    for (int i = 0; i < 3; i++) {
        rows[3 + i] = v[i] * scale;
    }
}

/* Weights the position in metres, and the rotations about the weighted axes of the tool in rad: 1 rad counts as 1 mm,
 * so that the position has priority. */
static void weigh(double axes[3][3], const double *rows, double factor, double *weighted)
{
    for (int i = 0; i < 3; i++) {
        weighted[i] = rows[i] * factor * METRE;
        weighted[3 + i] = dot(axes[i], &rows[3], 3) * factor * LEVER;
    }
}

static double cost(double axes[3][3], const double *rows)
{
    double weighted[6];
    weigh(axes, rows, 1.0, weighted);
    return dot(weighted, weighted, 6);
}

SHORTEST
/* Sets q to start + step. Variables that exceed a bound are held at it, one at a time, the one with the
 * largest excess first. */
static void depart(double axes[3][3], const double *start, double bounds[COUNT][2], double *q, const double *twists,
                   const double *after)
{
    double columns[COUNT][6];
    double wanted[6];
    double step[COUNT];
    weigh(axes, after, -1.0, wanted);
    for (int j = 0; j < COUNT; j++) {
        weigh(axes, &twists[6 * j], UNITS[j], columns[j]);
        for (int i = 0; i < 6; i++) {
            wanted[i] += columns[j][i] * ((q[j] - start[j]) / UNITS[j]);
        }
    }
    for (int round = 0; round <= COUNT; round++) {
        double furthest = 0.0;
        int held = -1;
        shortest(columns, wanted, step);
        for (int j = 0; j < COUNT; j++) {
            /* Skip variables that are held or do not move the tool. */
            if (dot(columns[j], columns[j], 6) > 0.0) {
                q[j] = start[j] + step[j] * UNITS[j];
                const double beyond = fabs(q[j] - clamped(q[j], bounds[j][0], bounds[j][1])) / UNITS[j];
                if (beyond > furthest) {
                    furthest = beyond;
                    held = j;
                }
            }
        }
        if (held < 0) {
            break;
        }
        q[held] = clamped(q[held], bounds[held][0], bounds[held][1]);
        for (int i = 0; i < 6; i++) {
            wanted[i] += columns[held][i] * ((start[held] - q[held]) / UNITS[held]);
            columns[held][i] = 0.0;
        }
    }
    for (int j = 0; j < COUNT; j++) {
        q[j] = clamped(q[j], bounds[j][0], bounds[j][1]);
    }
}

/* Interval of a correction, within its change and, where that permits it, its largest size; and of the command with it,
 * within the limits. Bounds that are not positive are 0. */
static void bound(int j, double command, double last, double change, double largest, double *bounds)
{
    const double far = (change > 0.0) ? change : 0.0;
    const double size = (largest > 0.0) ? largest : 0.0;
    const double lower = NAME_limits[j][0];
    const double upper = NAME_limits[j][1];
    bounds[0] = clamped(command + clamped(-size, last - far, last + far), lower, upper);
    bounds[1] = clamped(command + clamped(size, last - far, last + far), lower, upper);
}

HEAD
{
    double target[12];
    double real[12];
    double axes[3][3];
    double columns[6 * COUNT];
    double start[COUNT];
    double bounds[COUNT][2];
    double at[COUNT];
    double best[COUNT];
    double first[6];
    double now[6];
    double left[6];
    double least = HUGE_VAL;
    double moved = 0.0;
    int outside = 0;
    int inside = 1;
    int begins_elsewhere = 0;
    int held = 0;
    int status = NAME_pose(q,_IDEAL target);
    if (are_below(last, COUNT, HUGE_VAL) == 0 || are_below(rotations, 3, HUGE_VAL) == 0) {
        return UPPER_NOT_FINITE;
    }
    if (status == UPPER_OK) {
        status = NAME_compensator_step(q,_ALL real, columns);
    }
    if (status != UPPER_OK) {
        return status;
    }
    deviation(target, real, first);
    copied(first, now, 6);
    for (int k = 0; k < 9; k++) {
        axes[k / 3][k % 3] = target[k] * rotations[k / 3];
    }
    for (int j = 0; j < COUNT; j++) {
        start[j] = clamped(q[j], NAME_limits[j][0], NAME_limits[j][1]);
        bound(j, start[j], last[j], change[j], largest[j], bounds[j]);
        at[j] = clamped(start[j] + last[j], bounds[j][0], bounds[j][1]);
        outside = (start[j] < q[j] || start[j] > q[j]) ? 1 : outside;
        inside = (q[j] >= bounds[j][0] && q[j] <= bounds[j][1]) ? inside : 0;
        begins_elsewhere = (at[j] < q[j] || at[j] > q[j]) ? 1 : begins_elsewhere;
    }
    if (begins_elsewhere != 0) {
        status = NAME_compensator_step(at,_ALL real, columns);
        if (status != UPPER_OK) {
            return status;
        }
        deviation(target, real, now);
    }
    least = cost(axes, now);
    copied(at, best, COUNT);
    copied(now, left, 6);
    if (inside != 0 && cost(axes, first) < least) {
        least = cost(axes, first);
        copied(q, best, COUNT);
        copied(first, left, 6);
    }
    for (int iteration = 0; iteration < ITERATIONS; iteration++) {
        double from[COUNT];
        copied(at, from, COUNT);
        depart(axes, start, bounds, at, columns, now);
        moved = 0.0;
        for (int j = 0; j < COUNT; j++) {
            const double far = fabs(at[j] - from[j]) / UNITS[j];
            moved = (far > moved) ? far : moved;
        }
        status = NAME_compensator_step(at,_ALL real, columns);
        if (status != UPPER_OK) {
            return status;
        }
        deviation(target, real, now);
        if (cost(axes, now) < least) {
            least = cost(axes, now);
            copied(at, best, COUNT);
            copied(now, left, 6);
        }
    }
    for (int j = 0; j < COUNT; j++) {
        held = (best[j] <= bounds[j][0] || best[j] >= bounds[j][1]) ? 1 : held;
        corrected[j] = best[j];
        correction[j] = best[j] - start[j];
    }
    copied(first, before, 6);
    copied(left, after, 6);
    weigh(axes, left, 1.0, now);
    if (outside != 0) {
        status = UPPER_OUTSIDE_LIMITS;
    } else if (sqrt(dot(now, now, 3)) <= REACHED_POSITION && sqrt(dot(&now[3], &now[3], 3)) <= REACHED_ROTATION) {
        status = UPPER_OK;
    } else if (held != 0) {
        status = UPPER_HELD;
    } else {
        status = (moved > REST) ? UPPER_NOT_CONVERGED : UPPER_NOT_REACHED;
    }
    return status;
}
";
