//! Specs whose names have a meaning in a generated language: keywords, functions of its library,
//! headers and modules, and names that generated code uses itself.

/// Names of machines: in lower case.
const MACHINES: [&str; 48] = [
    "all",
    "ideal",
    "x_all_y",
    "a_ideal",
    "math",
    "float",
    "limits",
    "errno",
    "std",
    "int",
    "double",
    "class",
    "function",
    "numpy",
    "random",
    "types",
    "ast",
    "q",
    "u",
    "s",
    "last",
    "rotations",
    "axes",
    "best",
    "found",
    "corrected",
    "status",
    "pose",
    "compensated",
    "clamped",
    "deviation",
    "weighted",
    "shortest",
    "departure",
    "cost",
    "description",
    "given",
    "end",
    "at",
    "step",
    "limit",
    "arm_",
    "_arm",
    "arm__2",
    "a",
    "huge",
    "fp",
    "prefix",
];

/// Names of variables, parameters and inputs.
const NAMES: [&str; 72] = [
    "all",
    "ideal",
    "math",
    "float",
    "double",
    "int",
    "class",
    "function",
    "np",
    "numpy",
    "range",
    "None_",
    "Math",
    "NaN",
    "Infinity",
    "undefined",
    "arguments",
    "new",
    "delete",
    "this",
    "auto",
    "register",
    "errno",
    "I",
    "j0",
    "y1",
    "gamma",
    "isnan",
    "fabs",
    "HUGE_VAL",
    "end",
    "elseif",
    "zeros",
    "reshape",
    "numel",
    "i",
    "j",
    "k",
    "pass",
    "lambda",
    "def",
    "global",
    "raise",
    "clamped",
    "deviation",
    "weighted",
    "cost",
    "units",
    "total",
    "description",
    "given",
    "lookup",
    "status",
    "margin",
    "fault",
    "inputs",
    "parameters",
    "At",
    "AT",
    "Step",
    "run_pose",
    "pose",
    "real_pose",
    "passive",
    "t1",
    "s1",
    "c1",
    "a__b",
    "a_",
    "_b",
    "LEN",
    "Len",
];

/// Returns specs with such names: names and texts of arms of two joints.
pub fn specs(count: usize) -> impl Iterator<Item = (&'static str, String)> {
    (0..count).map(|index| {
        let machine = MACHINES[index % MACHINES.len()];
        // Seven names that differ.
        let name = |k: usize| NAMES[(index * 5 + k * 11 + index / MACHINES.len()) % NAMES.len()];
        let [q1, q2, a, b, c, load, table] = [0, 1, 2, 3, 4, 5, 6].map(name);
        let text = format!(
            r#"
[manipulator]
name = "{machine}"
length = "m"
[parameters]
{a} = "0.3 m"
{b} = 0.1
{c} = "0.2 m"
[inputs]
{load} = {{ value = "2 N", range = ["0 N", "3 N"] }}
[tables.{table}]
x = [-3, 0, 1, 3]
y = {{ values = [0.1, 0, 0.2, 0.1], unit = "mm" }}
interpolation = "linear"
outside = "hold"
[[frame]]
name = "first"
variable = {{ name = "{q1}", kind = "revolute", limits = [-1, 1] }}
transform = "Rz({q1} - {b}) Tx({a})"
[[frame]]
name = "second"
variable = {{ name = "{q2}", kind = "revolute", limits = [-1, 1] }}
transform = "Rx({q2}) Ty({c})"
[[source]]
name = "repeatable"
class = "repeatable"
frame = "second"
e_x = "1e-4 m/N*{load}*cos({q1}) + {table}({q2})"
"#
        );
        (machine, text)
    })
}
