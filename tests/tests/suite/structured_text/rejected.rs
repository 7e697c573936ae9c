//! The parser of the tests rejects what a dialect refuses.

use abbe_tests::structured_text::Program;

use super::{shipped, text};

/// A change of the generated text, and the mistake that it is.
const WRONG: &[(&str, &str, &str)] = &[
    ("    d1, d2", "    d1, D1, d2", "D1 is declared twice"),
    ("d1 := q[0];", "d9 := q[0];", "D9 is not declared"),
    ("d1 := q[0];", "q[0] := d1;", "assigns to an input or a constant"),
    ("d1 := q[0];", "d1 := q[0.0];", "a number without its type"),
    ("d1 := q[0];", "d1 := q[LREAL#0.0];", "expected Dint, found Lreal"),
    ("d1 := q[0];", "d1 = q[0];", "expected :=, found"),
    ("d1 := q[0];", "d1 := q[0]", "expected ;"),
    ("d1 := q[0];", "d1 := 0;", "expected Lreal, found Whole"),
    ("d1 := q[0];", "d1 := 0.5;", "a number without its type"),
    ("d1 := q[0];", "d1 := LREAL#1;", "not a number of LREAL"),
    ("d1 := q[0];", "d1 := LREAL#1.5e3;", "not a number of LREAL"),
    ("d1 := q[0];", "d1 := LREAL#.5;", "not a number of LREAL"),
    ("d1 := q[0];", "d1 := k;", "expected Lreal, found Dint"),
    ("d1 := q[0];", "d1 := q;", "expected Lreal, found Array"),
    ("d1 := q[0];", "d1 := fault + d2;", "Bool + Lreal"),
    ("d1 := q[0];", "d1 := d2 + fault;", "Lreal + Bool"),
    ("d1 := q[0];", "d1 := NOT d2;", "NOT of Lreal"),
    ("d1 := q[0];", "d1 := d2 ** LREAL#2.0;", "is no operand"),
    ("d1 := q[0];", "d1 := ATAN2(d2, d1);", "ATAN2 is not declared"),
    ("d1 := q[0];", "d1 := SQRT(d2, d1);", "expected ), found"),
    ("d1 := q[0];", "d1 := pps_root(d2);", "expected ,"),
    ("d1 := q[0];", "d1 := pps_root(d2, TRUE);", "TRUE is not declared"),
    ("d1 := q[0];", "d1 := pps_root(d2, d3);", "FAULT must be a variable of Bool"),
    ("far := ABS(towards[j]", "far := pps_weighted(q[j]", "PPS_WEIGHTED is no function"),
    ("d1 := q[0];", "IF d1 THEN d1 := d2; END_IF;", "expected Bool, found Lreal"),
    ("d1 := q[0];", "IF fault THEN d1 := d2;", "expected END_IF"),
    ("d1 := q[0];", "FOR d1 := 0 TO 1 DO fault := TRUE; END_FOR;", "a counter is a local variable of DINT"),
    ("d1 := q[0];", "FOR k := 0 TO 1 DO fault := TRUE; END_WHILE;", "expected END_FOR"),
    ("d1 := q[0];", "status := k;", "expected Int, found Dint"),
    ("last[j] := q[j] - best[j];", "(* last[j] := q[j] - best[j];", "a comment does not end"),
    ("d1 := q[0];", "d1 := q[0]; (* a (* comment *)", "a comment in a comment"),
    ("d1 := q[0];", "d1 := q[0]; // a comment", "expected a name"),
    ("d1 := q[0];", "d1 := q[0]; {pragma}", "unexpected `{`"),
    ("    d1, d2", "    d1_, d2", "is no identifier: underscores"),
    ("    d1, d2", "    d__1, d2", "is no identifier: underscores"),
    ("    d1, d2", "    S, d1, d2", "S is reserved"),
    ("    d1, d2", "    step, d1, d2", "STEP is reserved"),
    ("    d1, d2", "    limit, d1, d2", "LIMIT is reserved"),
    ("    d1, d2", "    pps_nearest, d1, d2", "PPS_NEAREST is the name of a unit"),
    ("    d1, d2", "    LREAL, d1, d2", "LREAL is reserved"),
    ("pps_array_12 : ARRAY[0..11] OF LREAL;", "pps_array_12 : ARRAY[1..12] OF LREAL;", "arrays begin at 0"),
    (
        "pps_array_12 : ARRAY[0..11] OF LREAL;",
        "pps_array_12 : ARRAY[0..12] OF LREAL;",
        "two names of one type",
    ),
    ("pose : pps_array_12;", "pose : pps_array_12", "expected ;"),
    ("pose : pps_array_12;", "pose : pps_none;", "PPS_NONE is no type"),
    ("pose : pps_array_12;", "pose : pps_array_13;", "expected"),
    // MATIEC takes types without names for different ones, reads REALs, and skips the loop.
    ("pose : pps_array_12;", "pose : ARRAY[0..11] OF LREAL;", "ARRAY is no type"),
    ("d1 := q[0];", "d1 := LREAL#1.0E300;", "not a number of LREAL"),
    ("d1 := q[0];", "d1 := LREAL#1.0E-300;", "not a number of LREAL"),
    ("d1 := q[0];", "FOR k := 0 TO 0 DO fault := TRUE; END_FOR;", "from a number to itself"),
    ("pps_array_13 := [600.0,", "pps_array_13 := [600.0, 1.0,", "14 values for 13 elements"),
    ("pps_array_13 := [600.0,", "pps_array_13 := [600,", "is no initial value"),
    ("END_FUNCTION\n", "END_FUNCTION_BLOCK\n", "expected END_FUNCTION"),
    ("END_FUNCTION_BLOCK\n", "", "FUNCTION_BLOCK is not declared"),
    ("run_compensator_step(q := q,", "run_compensator_step(q := q, q := q,", "Q is no input"),
    ("run_compensator_step(q := q,", "run_compensator_step(pose := q,", "POSE is no input"),
    ("run_compensator_step(q := q,", "run_compensator_step(q := axes,", "expected Array(Lreal, 6)"),
    ("run_pose(q := q,", "run_none(q := q,", "RUN_NONE is not declared"),
    ("run_pose.status <> 0", "run_pose.q <> 0", "Q is no output"),
    ("run_pose.status <> 0", "run_pose.fault <> 0", "FAULT is no output"),
];

#[test]
fn wrong_programs_are_rejected() {
    let right = text(&shipped("pps"));
    Program::parse(&right).unwrap();
    let mut faults = Vec::new();
    for (from, to, mistake) in WRONG {
        assert!(right.contains(from), "{from}");
        let found = Program::parse(&right.replacen(from, to, 1)).err();
        if !found.as_ref().is_some_and(|found| found.contains(mistake)) {
            faults.push(format!("{from} → {to}: {found:?}, not {mistake}"));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}
