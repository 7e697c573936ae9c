//! Size of a machine: that of its axes as lines in space, in any unit.

use abbe::Manipulator;
use abbe::analysis::sampling::{arm_length, arm_length_within, halton, nominal_parameters};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

fn interpreted(text: &str) -> Interpreter {
    Interpreter::new(Spec::parse("any.toml", text).unwrap_or_else(|mistake| panic!("{mistake}\n{text}")))
}

fn size(text: &str) -> f64 {
    let machine = interpreted(text);
    arm_length(&machine, &nominal_parameters(machine.description())).unwrap()
}

fn is_close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

/// Returns a chain, or a tree of two branches, of axes in general position; the origins of its
/// frames are moved along their axes by `along`, in m.
fn random_machine(seed: usize, unit: &str, along: f64) -> String {
    let number = |i: usize, j: usize| 2.0 * halton(1 + 31 * seed + i, j) - 1.0;
    let mut text = format!("[manipulator]\nname = \"any\"\nlength = \"{unit}\"\n");
    let count = 2 + seed % 5;
    // Origins of a frame and of the one that it hangs on, along their axes.
    let shift = |i: usize| along * number(i, 5);
    for i in 0..count {
        let slides = halton(1 + seed + i, 7) < 0.25;
        let parent = if seed % 3 == 1 && i == count - 1 { 0 } else { i.wrapping_sub(1) };
        let before = if i == 0 { 0.0 } else { shift(parent) };
        let (kind, limits, motion) = match slides {
            true => ("prismatic", "limits = [\"-0.5 m\", \"0.4 m\"]", format!("Tz(q{i})")),
            false => ("revolute", "limits = [-2.5, 2.8]", format!("Rz(q{i})")),
        };
        let named = if seed % 3 == 1 && i > 0 { format!("parent = \"{parent}\"\n") } else { String::new() };
        text += &format!(
            "[[frame]]\nname = \"{i}\"\n{named}variable = {{ name = \"q{i}\", kind = \"{kind}\", {limits} }}\n\
             transform = \"Tz({} m) Tx({} m) Ty({} m) Rx({}) Ry({}) {motion} Tz({} m)\"\n",
            -before,
            number(i, 0),
            number(i, 1),
            number(i, 2),
            number(i, 3),
            shift(i),
        );
    }
    let last = shift(count - 1);
    let frame = if seed % 3 == 1 { format!("frame = \"{}\"\n", count - 1) } else { String::new() };
    text + &format!("[tool]\n{frame}transform = \"Tz({} m) Tx(0.1 m)\"\n", -last)
}

#[test]
fn sizes_are_lengths() {
    for seed in 0..60 {
        let [mm, m] = ["mm", "m"].map(|unit| size(&random_machine(seed, unit, 0.3)));
        assert!(m > 0.0 && is_close(mm, 1000.0 * m), "{seed}: {mm} {m}");
    }
}

#[test]
fn sizes_do_not_depend_on_the_origins_along_the_axes() {
    for seed in 0..60 {
        let [here, there] = [0.0, 200.0].map(|along| size(&random_machine(seed, "m", along)));
        assert!((here - there).abs() < 1e-7 * here, "{seed}: {here} {there}");
    }
}

/// Axes 3 and 4 lean by 1.4 and 2.2 mrad, so that their common normals are 200 m away.
pub(super) const NEARLY_PARALLEL: &str = r#"
[manipulator]
name = "arm"
length = "m"
[[frame]]
name = "1"
variable = { name = "q1", kind = "revolute" }
dh = { theta = "q1", d = 0.1, a = 0, alpha = 1.5707963267948966 }
[[frame]]
name = "2"
variable = { name = "q2", kind = "revolute" }
dh = { theta = "q2 + 0.7853979133974066", d = 199.999833338786, a = -0.28284278318530015, alpha = 0.0014142134445219445 }
[[frame]]
name = "3"
variable = { name = "q3", kind = "revolute" }
dh = { theta = "q3 - 0.19739604061978472", d = -261.53849330009524, a = -0.332820224408221, alpha = -0.0036055507207634176 }
[[frame]]
name = "4"
variable = { name = "q4", kind = "revolute" }
dh = { theta = "q4 - 0.5880033727791217", d = 61.63846011052403, a = 9.999998333341998e-05, alpha = 1.5727963267948966 }
[[frame]]
name = "5"
variable = { name = "q5", kind = "revolute" }
dh = { theta = "q5 - 0.001", d = 0.10020000016666696, a = 0, alpha = -1.5707963267948966 }
[[frame]]
name = "6"
variable = { name = "q6", kind = "revolute" }
dh = { theta = "q6", d = 0.08, a = 0, alpha = 0 }
"#;

#[test]
fn nearly_parallel_axes_have_the_size_of_the_arm() {
    let size = size(NEARLY_PARALLEL);
    assert!((1.0..1.3).contains(&size), "{size}");
}

/// Three slides, with the limits of their variables.
fn gantry(unit: &str, limits: &str) -> String {
    let frame = |(name, motion): (&str, &str)| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{name}\", kind = \"prismatic\"{limits} }}\n\
             transform = \"{motion}({name})\"\n"
        )
    };
    let frames: String = [("x", "Tx"), ("y", "Ty"), ("z", "Tz")].map(frame).concat();
    format!("[manipulator]\nname = \"gantry\"\nlength = \"{unit}\"\n{frames}")
}

/// The size of a machine of slides is its travel, that of its limits or of the data. Without
/// either it is 1 m.
#[test]
fn sizes_of_slides_are_their_travel() {
    for (unit, metre) in [("mm", 1000.0), ("m", 1.0)] {
        assert!(is_close(size(&gantry(unit, ", limits = [\"-100 mm\", \"300 mm\"]")), 1.2 * metre));
        let open = gantry(unit, "");
        assert_eq!(size(&open), metre);
        let ranges = [[0.0, 0.2 * metre], [-0.1 * metre, 0.1 * metre], [f64::INFINITY, f64::NEG_INFINITY]];
        let within = arm_length_within(&interpreted(&open), &[], &ranges).unwrap();
        assert!(is_close(within, 0.4 * metre), "{within}");
    }
}

/// The pitch of a rail, of 0.1 mrad in 0.5 m, is no axis 5 km away.
#[test]
fn measured_rails_are_slides() {
    for (unit, metre) in [("mm", 1000.0), ("m", 1.0)] {
        let rail = format!(
            "[manipulator]\nname = \"rail\"\nlength = \"{unit}\"\n[parameters]\nfar = \"5000 m\"\n[[frame]]\nname = \"rail\"\n\
             variable = {{ name = \"x\", kind = \"prismatic\", limits = [0, \"2 m\"], home = \"0.9 m\" }}\n\
             transform = \"Tx(x) Ry(x/far)\"\n[tool]\ntransform = \"Tz(0.3 m)\"\n"
        );
        let expected = (0.9_f64.hypot(0.3) + 2.0) * metre;
        assert!((size(&rail) - expected).abs() < 1e-3 * expected, "{}", size(&rail));
    }
}

/// Only the longest branch of a tree counts.
#[test]
fn sizes_of_trees_are_those_of_their_longest_branch() {
    let tree = |left: f64, right: f64| {
        let frame = |name: &str, parent: &str, offset: f64| {
            format!(
                "[[frame]]\nname = \"{name}\"\n{parent}variable = {{ name = \"q_{name}\", kind = \"revolute\" }}\n\
                 transform = \"Tx({offset} m) Rz(q_{name})\"\n"
            )
        };
        let frames = [
            frame("trunk", "", 1.0),
            frame("left", "parent = \"trunk\"\n", left),
            frame("right", "parent = \"trunk\"\n", right),
        ];
        let tool = "[tool]\nframe = \"right\"\ntransform = \"Tx(0.5 m)\"\n";
        format!("[manipulator]\nname = \"tree\"\nlength = \"mm\"\n{}{tool}", frames.concat())
    };
    assert!(is_close(size(&tree(0.7, 0.4)), 1900.0) && is_close(size(&tree(2.0, 0.4)), 3000.0));
}
