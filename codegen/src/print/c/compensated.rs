//! Corrected commands in C: the fixed number of steps of `abbe::compensator`, term by term.

use abbe_core::VariableKind;
use abbe_spec::Spec;

use super::real::Real;
use super::shortest::Solver;
use crate::print::layout::Writer;

pub(super) fn declaration(writer: &mut Writer, spec: &Spec, real: Real) {
    if spec.variables.is_empty() {
        return;
    }
    let (name, upper) = (&spec.name, spec.name.to_ascii_uppercase());
    writer.blank();
    writer.lines("/**");
    writer.documentation(
        "Commands that put the real tool where the ideal one is at `q`, within the limits of the variables: a fixed \
         number of steps. Where not all can be had the tool point comes first.",
    );
    writer.documentation_line("");
    for line in [
        "@param[in] q The commands that were given: rad and the length unit.",
        "@param[in] s Structural parameters.",
        "@param[in] u Inputs.",
        "@param[out] corrected The commands to be given instead: as many as `q`.",
        "@param[out] before What is wrong at `q`, six numbers: where the real tool point is from the ideal one, x, y, z \
         in `F_0`, and the rotation vector in rad.",
        "@param[out] after The same at `corrected`.",
    ] {
        writer.documentation(line);
    }
    writer.documentation(&format!(
        "@return `{upper}_OK`, `{upper}_NOT_FINITE`, `{upper}_OUT_OF_RANGE`, or `{upper}_NOT_CONVERGED`: more steps \
         were needed, at a limit or near a singular pose; `corrected` is the best that was seen."
    ));
    writer.lines(" */");
    writer.lines(&format!("{};", head(name, real, "ABBE_RESTRICT")));
}

fn head(name: &str, real: Real, restrict: &str) -> String {
    format!(
        "int {name}_compensated(const {real} *{restrict} q, const {real} *{restrict} s, const {real} *{restrict} u, \
         {real} *{restrict} corrected, {real} *{restrict} before, {real} *{restrict} after)"
    )
}

pub(super) fn definition(writer: &mut Writer, spec: &Spec, real: Real) {
    if spec.variables.is_empty() {
        return;
    }
    let metre = 1.0 / spec.length.in_metres();
    let units = spec.variables.iter().map(|variable| match variable.kind {
        VariableKind::Revolute => real.number(1.0),
        VariableKind::Prismatic => real.number(metre),
    });
    writer.blank();
    writer.lines("/* One rad or one metre in the unit of each variable. */");
    let units: Vec<String> = units.collect();
    writer.braces(&format!("static const {real} UNITS[{}] = ", units.len()), &units, ";");
    let more_than_six = units.len() > 6;
    let Solver { texts, damping, rest, tiny } = Solver::of(real);
    let [before, shortest] = [texts[0], texts[if more_than_six { 2 } else { 1 }]];
    let written = TEXT.replace("SHORTEST", &[before, shortest].concat());
    let placed = [
        ("FULL", units.len().max(6).to_string()),
        ("LONG", (6 + units.len()).to_string()),
        ("RANK", units.len().min(6).to_string()),
        ("COUNT", units.len().to_string()),
        ("METRE", real.number(1.0 / metre)),
        ("DAMPING", real.number(damping)),
        ("STILL", real.number(rest)),
        ("TINY", real.number(tiny)),
        ("NAME", spec.name.clone()),
        ("UPPER", spec.name.to_ascii_uppercase()),
    ];
    let (before, after) = written.split_once("HEAD").unwrap_or((&written, ""));
    let [before, after] = [before, after]
        .map(|text| placed.iter().fold(real.text(text), |text, (what, value)| text.replace(what, value)));
    let text = [before, head(&spec.name, real, "restrict"), after].concat();
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

/* From the ideal to the real pose: three lengths in F_0, and the rotation vector of R_real R_ideal^T. */
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
    const double scale = (twice_sine < TINY) ? 0.5 : angle / twice_sine;
    for (int i = 0; i < 3; i++) {
        rows[3 + i] = v[i] * scale;
    }
}

/* Rows in metres and rad; a rad counts as a millimetre, so that the tool point comes first. */
static void weigh(const double *rows, double factor, double *weighted)
{
    for (int i = 0; i < 3; i++) {
        weighted[i] = rows[i] * factor * METRE;
        weighted[3 + i] = rows[3 + i] * factor * 1e-3;
    }
}

static double cost(const double *rows)
{
    double weighted[6];
    weigh(rows, 1.0, weighted);
    return dot(weighted, weighted, 6);
}

SHORTEST
/* q becomes start + d; a variable that would go beyond a limit is held there, the one furthest beyond it first. */
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
            /* Held, or of no use to the tool. */
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
    for (int iteration = 0; iteration < 6; iteration++) {
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
    return (moved <= STILL) ? UPPER_OK : UPPER_NOT_CONVERGED;
}
";
