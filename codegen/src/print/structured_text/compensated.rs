//! Corrected commands in Structured Text, by the fixed number of steps of `abbe::compensator`.
//!
//! The block keeps the corrections of the cycle before itself.

use abbe_core::Description;
use abbe_core::compensator::{CHANGE, LARGEST, bound};
use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::declarations::{argument, comment, document, numbers, section};
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered};
use crate::print::layout::Writer;
use crate::program::Routines;

/// Prints the block of corrected commands, and those that it calls.
pub(super) fn blocks(writer: &mut Writer, spec: &Spec, routines: &Routines, prefix: &str) {
    let description = &routines.description;
    let (count, six_or_more) = (spec.variables.len(), spec.variables.len() >= 6);
    let given = |takes_inputs: bool| {
        let mut given = String::new();
        if !spec.parameters.is_empty() {
            given.push_str(", parameters := parameters");
        }
        if takes_inputs && !spec.inputs.is_empty() {
            given.push_str(", inputs := inputs");
        }
        given
    };
    let placed = [
        ("NORMAL_EQUATIONS", if six_or_more { BY_ROWS } else { BY_COLUMNS }.trim_end().to_owned()),
        ("COMPONENT", if six_or_more { ROWS_STEP } else { "part := x[j];" }.trim_end().to_owned()),
        ("PREFIX", prefix.to_owned()),
        ("GIVEN_INPUTS", given(true)),
        ("GIVEN", given(false)),
        ("LAST_COLUMN", (6 * count - 1).to_string()),
        ("LAST_JOINT", (count - 1).to_string()),
    ];
    let filled = |text: &str| {
        let text = placed.iter().fold(text.to_owned(), |text, (what, value)| text.replace(what, value));
        numbered(&text, spec, &Tolerances::DOUBLE, number)
    };
    for text in [DEVIATION, WEIGHTED, DEPARTURE] {
        writer.blank();
        writer.lines(filled(text).trim_end());
    }
    writer.blank();
    comment(writer, COMPENSATED.documentation);
    writer.lines(&format!("FUNCTION_BLOCK {prefix}_compensated"));
    interface(writer, spec, description);
    writer.lines(filled(BODY).trim_end());
}

/// Prints inputs, outputs and constants.
fn interface(writer: &mut Writer, spec: &Spec, description: &Description) {
    let bounds = |bounds| -> Vec<f64> {
        description.variables.iter().map(|one| bound(description, one.kind, bounds)).collect()
    };
    section(writer, "VAR_INPUT", |writer| {
        for array in COMPENSATED.arguments.iter().filter(|array| array.name != "last") {
            let values = match array.name {
                "change" => bounds(CHANGE),
                "largest" => bounds(LARGEST),
                "rotations" => vec![1.0; 3],
                _ => {
                    argument(writer, spec, description, array);
                    continue;
                }
            };
            document(writer, description, array);
            numbers(writer, array.name, &values);
        }
        comment(writer, RESET);
        writer.lines("reset : BOOL;");
    });
    section(writer, "VAR_OUTPUT", |writer| {
        comment(writer, OUTPUTS);
        for array in COMPENSATED.results {
            document(writer, description, array);
            let values = match array.name {
                "corrected" => description.variables.iter().map(|variable| variable.home).collect(),
                _ => vec![0.0; array.len(description)],
            };
            numbers(writer, array.name, &values);
        }
        writer.lines("status : INT := 1;");
    });
    section(writer, "VAR CONSTANT", |writer| {
        let ends = |end: usize| spec.variables.iter().map(|one| one.limits[end]).collect::<Vec<_>>();
        numbers(writer, "lower_limits", &ends(0));
        numbers(writer, "upper_limits", &ends(1));
        numbers(writer, "units", &crate::print::compensated::units(spec).collect::<Vec<_>>());
    });
}

const RESET: &str =
    "TRUE begins anew in each cycle, as if no correction preceded: only while the drives do not move.";

const OUTPUTS: &str = "With the statuses 1 to 3 nothing is written, and the outputs are those of the last valid cycle, at first \
     the home position. With any other status, the commands are within the limits and the bounds, and after is what is left \
     at them.";

const DEVIATION: &str = "\
(* Deviation of the real from the ideal pose: position in F_0, and the rotation vector of the real
   rotation times the transposed ideal one. *)
FUNCTION_BLOCK PREFIX_deviation
VAR_INPUT
    ideal, found : ARRAY[0..11] OF LREAL;
END_VAR
VAR_OUTPUT
    rows : ARRAY[0..5] OF LREAL;
END_VAR
VAR
    turn : ARRAY[0..8] OF LREAL;
    v : ARRAY[0..2] OF LREAL;
    twice_sine, scale : LREAL;
    i, k : DINT;
END_VAR
FOR i := 0 TO 2 DO
    rows[i] := found[9 + i] - ideal[9 + i];
    FOR k := 0 TO 2 DO
        turn[3 * i + k] := found[i] * ideal[k] + found[3 + i] * ideal[3 + k] + found[6 + i] * ideal[6 + k];
    END_FOR;
END_FOR;
v[0] := turn[7] - turn[5];
v[1] := turn[2] - turn[6];
v[2] := turn[3] - turn[1];
twice_sine := SQRT(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
scale := LREAL#0.5;
IF twice_sine >= LEAST_SINE THEN
    scale := PREFIX_arctangent(twice_sine, turn[0] + turn[4] + turn[8] - LREAL#1.0) / twice_sine;
END_IF;
FOR i := 0 TO 2 DO
    rows[3 + i] := v[i] * scale;
END_FOR;
END_FUNCTION_BLOCK
";

const WEIGHTED: &str = "\
(* Weights the position in metres, and the rotations about the weighted axes of the tool in rad: 1
   rad counts as 1 mm, so that the position has priority. *)
FUNCTION_BLOCK PREFIX_weighted
VAR_INPUT
    axes : ARRAY[0..8] OF LREAL;
    rows : ARRAY[0..5] OF LREAL;
END_VAR
VAR_OUTPUT
    weighted : ARRAY[0..5] OF LREAL;
    cost : LREAL;
END_VAR
VAR
    turn : LREAL;
    i : DINT;
END_VAR
FOR i := 0 TO 2 DO
    turn := axes[3 * i] * rows[3] + axes[3 * i + 1] * rows[4] + axes[3 * i + 2] * rows[5];
    weighted[i] := rows[i] * METRE;
    weighted[3 + i] := turn * LEVER;
END_FOR;
cost := LREAL#0.0;
FOR i := 0 TO 5 DO
    cost := cost + weighted[i] * weighted[i];
END_FOR;
END_FUNCTION_BLOCK
";

const DEPARTURE: &str = "\
(* Sets q to the command and the shortest step. Variables that exceed a bound are held at it, one at
   a time, the one with the largest excess first. The step is by iterated Tikhonov regularization:
   the first pass solves (M + damping) x = b, each other one adds damping / (M + damping) of the one
   before. *)
FUNCTION_BLOCK PREFIX_departure
VAR_INPUT
    axes : ARRAY[0..8] OF LREAL;
    command, lower, upper, present : ARRAY[0..LAST_JOINT] OF LREAL;
    twists : ARRAY[0..LAST_COLUMN] OF LREAL;
    found : ARRAY[0..5] OF LREAL;
END_VAR
VAR_OUTPUT
    q : ARRAY[0..LAST_JOINT] OF LREAL;
END_VAR
VAR CONSTANT
    units : ARRAY[0..LAST_JOINT] OF LREAL := [UNIT_LIST];
END_VAR
VAR
    weigh : PREFIX_weighted;
    columns : ARRAY[0..LAST_COLUMN] OF LREAL;
    rows, wanted, x, b : ARRAY[0..5] OF LREAL;
    m : ARRAY[0..35] OF LREAL;
    rest, far, size, part, furthest : LREAL;
    i, j, k, turn, pass, held : DINT;
END_VAR
q := present;
weigh(axes := axes, rows := found);
FOR i := 0 TO 5 DO
    wanted[i] := -weigh.weighted[i];
END_FOR;
FOR j := 0 TO LAST_JOINT DO
    FOR i := 0 TO 5 DO
        rows[i] := twists[6 * j + i] * units[j];
    END_FOR;
    weigh(axes := axes, rows := rows);
    far := (q[j] - command[j]) / units[j];
    FOR i := 0 TO 5 DO
        columns[6 * j + i] := weigh.weighted[i];
        wanted[i] := wanted[i] + columns[6 * j + i] * far;
    END_FOR;
END_FOR;
FOR turn := 0 TO COUNT DO
    FOR i := 0 TO 35 DO
        m[i] := LREAL#0.0;
    END_FOR;
NORMAL_EQUATIONS
    (* Cholesky factorization. *)
    FOR i := 0 TO 5 DO
        FOR j := 0 TO i DO
            rest := LREAL#0.0;
            FOR k := 0 TO j - 1 DO
                rest := rest + m[6 * i + k] * m[6 * j + k];
            END_FOR;
            rest := m[6 * i + j] - rest;
            IF i = j THEN
                m[6 * i + j] := SQRT(MAX(rest, LREAL#0.0) + DAMPING);
            ELSE
                m[6 * i + j] := rest / m[7 * j];
            END_IF;
        END_FOR;
        x[i] := LREAL#0.0;
    END_FOR;
    FOR pass := 1 TO PASSES DO
        FOR i := 0 TO 5 DO
            rest := LREAL#0.0;
            FOR k := 0 TO i - 1 DO
                rest := rest + m[6 * i + k] * b[k];
            END_FOR;
            b[i] := (b[i] - rest) / m[7 * i];
        END_FOR;
        FOR i := 5 TO 0 BY -1 DO
            rest := LREAL#0.0;
            FOR k := i + 1 TO 5 DO
                rest := rest + m[6 * k + i] * b[k];
            END_FOR;
            b[i] := (b[i] - rest) / m[7 * i];
        END_FOR;
        FOR i := 0 TO 5 DO
            x[i] := x[i] + b[i];
            b[i] := b[i] * DAMPING;
        END_FOR;
    END_FOR;
    furthest := LREAL#0.0;
    held := -1;
    FOR j := 0 TO LAST_JOINT DO
        size := LREAL#0.0;
        FOR i := 0 TO 5 DO
            size := size + columns[6 * j + i] * columns[6 * j + i];
        END_FOR;
        (* Skip variables that are held or do not move the tool. *)
        IF size > LREAL#0.0 THEN
            COMPONENT
            q[j] := command[j] + part * units[j];
            far := ABS(q[j] - LIMIT(lower[j], q[j], upper[j])) / units[j];
            IF far > furthest THEN
                furthest := far;
                held := j;
            END_IF;
        END_IF;
    END_FOR;
    IF held < 0 THEN
        EXIT;
    END_IF;
    q[held] := LIMIT(lower[held], q[held], upper[held]);
    far := (command[held] - q[held]) / units[held];
    FOR i := 0 TO 5 DO
        wanted[i] := wanted[i] + columns[6 * held + i] * far;
        columns[6 * held + i] := LREAL#0.0;
    END_FOR;
END_FOR;
FOR j := 0 TO LAST_JOINT DO
    q[j] := LIMIT(lower[j], q[j], upper[j]);
END_FOR;
END_FUNCTION_BLOCK
";

/// For six joints or more: J x of (J J') x = b.
const BY_ROWS: &str = "    \
    FOR i := 0 TO 5 DO
        b[i] := wanted[i];
        FOR k := 0 TO 5 DO
            FOR j := 0 TO LAST_JOINT DO
                m[6 * i + k] := m[6 * i + k] + columns[6 * j + k] * columns[6 * j + i];
            END_FOR;
        END_FOR;
    END_FOR;
";

const ROWS_STEP: &str = "\
part := LREAL#0.0;
            FOR i := 0 TO 5 DO
                part := part + columns[6 * j + i] * x[i];
            END_FOR;
";

/// For fewer than six joints: x of (J' J) x = J' b.
const BY_COLUMNS: &str = "    \
    FOR i := 0 TO 5 DO
        b[i] := LREAL#0.0;
    END_FOR;
    FOR j := 0 TO LAST_JOINT DO
        FOR i := 0 TO 5 DO
            b[j] := b[j] + columns[6 * j + i] * wanted[i];
        END_FOR;
        FOR k := 0 TO j DO
            FOR i := 0 TO 5 DO
                m[6 * j + k] := m[6 * j + k] + columns[6 * j + i] * columns[6 * k + i];
            END_FOR;
        END_FOR;
    END_FOR;
";

const BODY: &str = "\
VAR
    run_pose : PREFIX_pose;
    run_step : PREFIX_compensator_step;
    measure : PREFIX_deviation;
    weigh : PREFIX_weighted;
    depart : PREFIX_departure;
    last, command, lower, upper, present, former, best : ARRAY[0..LAST_JOINT] OF LREAL;
    axes : ARRAY[0..8] OF LREAL;
    first, found, rest : ARRAY[0..5] OF LREAL;
    sum, far, size, least, moved, angle : LREAL;
    is_outside, is_inside, is_elsewhere, is_held : BOOL;
    j, k, iteration : DINT;
END_VAR
IF reset THEN
    FOR j := 0 TO LAST_JOINT DO
        last[j] := LREAL#0.0;
    END_FOR;
END_IF;
sum := ABS(rotations[0]) + ABS(rotations[1]) + ABS(rotations[2]);
IF NOT PREFIX_is_within(sum, LREAL#0.0, LREAL#1.0E30) THEN
    status := 1;
    RETURN;
END_IF;
run_pose(q := qGIVEN);
IF run_pose.status <> 0 THEN
    status := run_pose.status;
    RETURN;
END_IF;
run_step(q := qGIVEN_INPUTS);
IF run_step.status <> 0 THEN
    status := run_step.status;
    RETURN;
END_IF;
measure(ideal := run_pose.pose, found := run_step.pose);
first := measure.rows;
found := first;
FOR k := 0 TO 8 DO
    axes[k] := run_pose.pose[k] * rotations[k / 3];
END_FOR;
is_outside := FALSE;
is_inside := TRUE;
is_elsewhere := FALSE;
FOR j := 0 TO LAST_JOINT DO
    command[j] := LIMIT(lower_limits[j], q[j], upper_limits[j]);
    (* Bounds that are not positive are 0. *)
    far := LREAL#0.0;
    IF change[j] > LREAL#0.0 THEN
        far := MIN(change[j], LREAL#1.0E30);
    END_IF;
    size := LREAL#0.0;
    IF largest[j] > LREAL#0.0 THEN
        size := MIN(largest[j], LREAL#1.0E30);
    END_IF;
    lower[j] := command[j] + LIMIT(last[j] - far, -size, last[j] + far);
    lower[j] := LIMIT(lower_limits[j], lower[j], upper_limits[j]);
    upper[j] := command[j] + LIMIT(last[j] - far, size, last[j] + far);
    upper[j] := LIMIT(lower_limits[j], upper[j], upper_limits[j]);
    present[j] := LIMIT(lower[j], command[j] + last[j], upper[j]);
    is_outside := is_outside OR (command[j] <> q[j]);
    is_inside := is_inside AND (q[j] >= lower[j]) AND (upper[j] >= q[j]);
    is_elsewhere := is_elsewhere OR (present[j] <> q[j]);
END_FOR;
IF is_elsewhere THEN
    run_step(q := presentGIVEN_INPUTS);
    IF run_step.status <> 0 THEN
        status := run_step.status;
        RETURN;
    END_IF;
    measure(ideal := run_pose.pose, found := run_step.pose);
    found := measure.rows;
END_IF;
best := present;
rest := found;
weigh(axes := axes, rows := found);
least := weigh.cost;
IF is_inside THEN
    weigh(axes := axes, rows := first);
    IF least > weigh.cost THEN
        best := q;
        rest := first;
        least := weigh.cost;
    END_IF;
END_IF;
moved := LREAL#0.0;
FOR iteration := 1 TO ITERATIONS DO
    former := present;
    depart(axes := axes, command := command, lower := lower, upper := upper, present := former,
           twists := run_step.columns, found := found);
    present := depart.q;
    moved := LREAL#0.0;
    FOR j := 0 TO LAST_JOINT DO
        moved := MAX(moved, ABS(present[j] - former[j]) / units[j]);
    END_FOR;
    run_step(q := presentGIVEN_INPUTS);
    IF run_step.status <> 0 THEN
        status := run_step.status;
        RETURN;
    END_IF;
    measure(ideal := run_pose.pose, found := run_step.pose);
    found := measure.rows;
    weigh(axes := axes, rows := found);
    IF least > weigh.cost THEN
        best := present;
        rest := found;
        least := weigh.cost;
    END_IF;
END_FOR;
is_held := FALSE;
FOR j := 0 TO LAST_JOINT DO
    is_held := is_held OR (lower[j] >= best[j]) OR (best[j] >= upper[j]);
    corrected[j] := best[j];
    correction[j] := best[j] - command[j];
    last[j] := correction[j];
END_FOR;
before := first;
after := rest;
weigh(axes := axes, rows := rest);
far := SQRT(weigh.weighted[0] * weigh.weighted[0] + weigh.weighted[1] * weigh.weighted[1]
            + weigh.weighted[2] * weigh.weighted[2]);
angle := SQRT(weigh.weighted[3] * weigh.weighted[3] + weigh.weighted[4] * weigh.weighted[4]
              + weigh.weighted[5] * weigh.weighted[5]);
IF is_outside THEN
    status := 6;
ELSIF (REACHED_POSITION >= far) AND (REACHED_ROTATION >= angle) THEN
    status := 0;
ELSIF is_held THEN
    status := 5;
ELSIF moved > REST THEN
    status := 4;
ELSE
    status := 7;
END_IF;
END_FUNCTION_BLOCK
";
