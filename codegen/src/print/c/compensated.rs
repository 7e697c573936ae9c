//! Corrected commands in C, by the fixed number of steps of `abbe::compensator`.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::{documentation, head};
use super::real::Real;
use super::shortest::Solver;
use crate::print::compensated::{numbered, units};
use crate::print::layout::Writer;
use crate::program::Routines;

pub(super) fn declaration(writer: &mut Writer, spec: &Spec, routines: &Routines, real: Real) {
    if spec.variables.is_empty() {
        return;
    }
    writer.blank();
    documentation(writer, &routines.description, &COMPENSATED, Some("NOT_CONVERGED"), None);
    writer.lines(&format!("{};", head(&spec.name, &COMPENSATED, real, "ABBE_RESTRICT")));
}

pub(super) fn definition(writer: &mut Writer, spec: &Spec, real: Real) {
    if spec.variables.is_empty() {
        return;
    }
    writer.blank();
    writer.lines("/* 1 rad or 1 m in the unit of each variable. */");
    let units: Vec<String> = units(spec).map(|unit| real.number(unit)).collect();
    writer.braces(&format!("static const {real} UNITS[{}] = ", units.len()), &units, ";");
    let more_than_six = units.len() > 6;
    let Solver { texts, tolerances } = Solver::new(real);
    let [before, shortest] = [texts[0], texts[if more_than_six { 2 } else { 1 }]];
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
    let text = [before, head(&spec.name, &COMPENSATED, real, "restrict"), after].concat();
    writer.blank();
    writer.lines(text.trim_end());
}

const TEXT: &str = "\
static double clamped(int j, double value)
{
    const double above = (value > NAME_limits[j][0]) ? value : NAME_limits[j][0];
    return (above < NAME_limits[j][1]) ? above : NAME_limits[j][1];
}

static double dot(const double *a, const double *b, int count)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) {
        sum += a[k] * b[k];
    }
    return sum;
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

/* Weights the rows in metres and rad: 1 rad counts as 1 mm, so that the position has priority. */
static void weigh(const double *rows, double factor, double *weighted)
{
    for (int i = 0; i < 3; i++) {
        weighted[i] = rows[i] * factor * METRE;
        weighted[3 + i] = rows[3 + i] * factor * LEVER;
    }
}

static double cost(const double *rows)
{
    double weighted[6];
    weigh(rows, 1.0, weighted);
    return dot(weighted, weighted, 6);
}

SHORTEST
/* Sets q to start + step. Variables that exceed a limit are held at it, one at a time, the one with the
 * largest excess first. */
static void depart(const double *start, double *q, const double *twists, const double *after)
{
    double columns[COUNT][6];
    double wanted[6];
    double step[COUNT];
    weigh(after, -1.0, wanted);
    for (int j = 0; j < COUNT; j++) {
        weigh(&twists[6 * j], UNITS[j], columns[j]);
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
                const double beyond = fabs(q[j] - clamped(j, q[j])) / UNITS[j];
                if (beyond > furthest) {
                    furthest = beyond;
                    held = j;
                }
            }
        }
        if (held < 0) {
            break;
        }
        q[held] = clamped(held, q[held]);
        for (int i = 0; i < 6; i++) {
            wanted[i] += columns[held][i] * ((start[held] - q[held]) / UNITS[held]);
            columns[held][i] = 0.0;
        }
    }
    for (int j = 0; j < COUNT; j++) {
        q[j] = clamped(j, q[j]);
    }
}

HEAD
{
    double target[12];
    double real[12];
    double columns[6 * COUNT];
    double at[COUNT];
    double now[6];
    double least_cost = HUGE_VAL;
    double moved = 0.0;
    int inside = 1;
    int status = NAME_pose(q, s, target);
    if (status == UPPER_OK) {
        status = NAME_compensator_step(q, s, u, real, columns);
    }
    if (status != UPPER_OK) {
        return status;
    }
    deviation(target, real, before);
    for (int i = 0; i < 6; i++) {
        now[i] = before[i];
        after[i] = before[i];
    }
    for (int j = 0; j < COUNT; j++) {
        at[j] = q[j];
        corrected[j] = q[j];
        inside = (inside != 0 && q[j] >= NAME_limits[j][0] && q[j] <= NAME_limits[j][1]) ? 1 : 0;
    }
    if (inside != 0) {
        least_cost = cost(before);
    }
    for (int iteration = 0; iteration < ITERATIONS; iteration++) {
        double from[COUNT];
        for (int j = 0; j < COUNT; j++) {
            from[j] = at[j];
        }
        depart(q, at, columns, now);
        moved = 0.0;
        for (int j = 0; j < COUNT; j++) {
            const double far = fabs(at[j] - from[j]) / UNITS[j];
            moved = (far > moved) ? far : moved;
        }
        status = NAME_compensator_step(at, s, u, real, columns);
        if (status != UPPER_OK) {
            return status;
        }
        deviation(target, real, now);
        if (cost(now) < least_cost) {
            least_cost = cost(now);
            for (int i = 0; i < 6; i++) {
                after[i] = now[i];
            }
            for (int j = 0; j < COUNT; j++) {
                corrected[j] = at[j];
            }
        }
    }
    return (moved <= REST) ? UPPER_OK : UPPER_NOT_CONVERGED;
}
";
