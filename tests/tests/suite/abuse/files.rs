//! Small valid files of every kind, to be damaged.

use abbe_spec::Spec;
use abbe_study::Machine;

/// Arm with every feature of a spec, and quick to compute.
pub(crate) const ARM: &str = r#"
[manipulator]
name = "arm"
title = "An arm on a rail"
length = "mm"

[parameters]
reach = { value = "450 mm", description = "Elbow to tool point" }
a1 = "300 mm"

[inputs]
payload = { value = "2 kg", range = ["0 kg", "5 kg"] }

[tables.straightness]
x = { values = [0, 200, 400, 600, 800], unit = "mm" }
y = { values = [0, 3, -2, 4, 1], unit = "um" }
interpolation = "cubic"

[[frame]]
name = "rail"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "800 mm"], home = "100 mm" }
transform = "Tx(d1) Tz(200 mm + straightness(d1))"

[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute", limits = ["-150 deg", "150 deg"], home = "20 deg" }
dh = { theta = "q2", d = "100 mm", a = "a1", alpha = "pi/2" }

[[frame]]
name = "elbow"
variable = { name = "q3", kind = "revolute", limits = ["-140 deg", "140 deg"], home = 0.7 }
origin = { xyz = [10, 0, 0], rpy = [0, 0, 0.1] }
axis = [0, 0, 1]

[tool]
transform = "Tx(reach)"

[[source]]
name = "shoulder encoder"
class = "random"
distribution = "uniform"
joint = "q2"
error = "20e-6"

[[source]]
name = "sag"
class = "repeatable"
frame = "elbow"
e_s = "3e-5/kg * payload * cos(q2)"
magnitude = { value = 1, standard_deviation = 0.2 }

[[source]]
name = "rail"
class = "random"
distribution = "normal"
degrees_of_freedom = 9

[[source.effect]]
frame = "rail"
e_z = "sqrt(d1/(1 mm)) * 0.1 um"
e_p = "1e-5*(1 - d1/(1600 mm))"

[[source]]
name = "as built"
class = "repeatable"
frame = "shoulder"
dh = { a = "0.05 mm", alpha = "-0.1 mrad" }
"#;

pub(crate) fn machine() -> Machine {
    Machine::of_spec(Spec::parse("arm.toml", ARM).unwrap(), "arm.toml")
}

pub(crate) const STUDIES: [&str; 3] = [
    r#"
[study]
title = "Samples"
tolerance = { position = "0.3 mm", orientation = "1 mrad", probability = 0.95 }

[workspace.joints]
samples = 60
"#,
    r#"
[study]
title = "A grid"
tolerance = "0.3 mm"

[workspace.grid]
d1 = { from = 0, to = "800 mm", count = 4 }
q2 = ["-1 rad", 0, "60 deg"]
payload = ["0 kg", "4 kg"]

[[figure]]
kind = "histogram"
caption = "How often"
"#,
    r#"
[study]
title = "A volume"

[workspace.box]
x = { from = "500 mm", to = "900 mm", count = 3 }
y = { from = "-100 mm", to = "100 mm", count = 2 }
z = ["300 mm"]
"#,
];

pub(crate) const MAPS: [&str; 3] = [
    r#"
[data]
title = "A point"
uncertainty = "0.02 mm"
base = "unknown"

[joints]
d1 = { column = "d1", unit = "mm" }
q2 = { column = "q2", unit = "deg" }
q3 = { column = "q3", unit = "deg", sign = 1 }

[inputs]
payload = { column = "load", unit = "kg" }

[point]
columns = ["x", "y", "z"]
unit = "mm"
"#,
    r#"
[data]
title = "A pose"
uncertainty = "0.02 mm"
angle_uncertainty = "0.1 mrad"

[joints]
d1 = { column = "d1", unit = "mm" }
q2 = { column = "q2", unit = "deg" }
q3 = { column = "q3", unit = "deg" }

[pose]
position = ["x", "y", "z"]
unit = "mm"
euler = { columns = ["a", "b", "c"], order = "zyx", unit = "deg" }

[accept]
mean = "0.15 mm"
max = "0.3 mm"
"#,
    r#"
[data]
title = "Instruments"
group = "n"
time = "n"

[joints]
d1 = { column = "d1", unit = "mm" }
q2 = { column = "q2", unit = "deg" }
q3 = { column = "q3", unit = "deg" }

[[target]]
name = "ball"
position = ["0 mm", "0 mm", "0 mm"]

[[instrument]]
name = "tracker"
kind = "point"
target = "ball"
columns = ["x", "y", "z"]
unit = "mm"
uncertainty = "unknown"

[[instrument]]
name = "bar"
kind = "distance"
column = "r"
unit = "mm"
uncertainty = "1 um"
at = ["0 mm", "0 mm", "100 mm"]
zero = "unknown"
"#,
];

pub(crate) const PLANS: [&str; 1] = [r#"
[plan]
title = "Two sets"
repeat = 2

[inputs]
payload = ["0 kg", "5 kg"]

[[set]]
name = "samples"
workspace.joints = { samples = 12 }

[[set]]
name = "one at a time"
axes = { q2 = { from = "-60 deg", to = "60 deg", count = 5 }, d1 = [0, "400 mm"] }
"#];

/// Twenty-four rows for all maps, consistent with the arm.
pub(crate) const DATA: &str = include_str!("data.csv");
