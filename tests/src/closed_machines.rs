//! Machines that are not a chain: two arms on a torso, a four-bar linkage and a six-legged
//! platform. This file is included in every crate whose tests use them.
#![allow(dead_code, unreachable_pub)]

use std::f64::consts::PI;
use std::fmt::Write;

/// Two arms on a torso; the tool is on the left hand.
pub const TWO_ARMS: &str = r#"
[manipulator]
name = "two_arms"
length = "mm"

[[frame]]
name = "torso"
variable = { name = "q1", kind = "revolute", limits = ["-100 deg", "100 deg"], home = "10 deg" }
transform = "Rz(q1) Tz(400)"

[[frame]]
name = "left"
variable = { name = "q2", kind = "revolute", limits = ["-100 deg", "100 deg"], home = "20 deg" }
transform = "Ty(100) Rx(q2) Tz(300)"

[[frame]]
name = "right"
parent = "torso"
variable = { name = "q3", kind = "revolute", limits = ["-100 deg", "100 deg"], home = "-20 deg" }
transform = "Ty(-100) Rx(q3) Tz(300)"

[[frame]]
name = "left hand"
parent = "left"
variable = { name = "q4", kind = "prismatic", limits = [0, 200], home = 50 }
transform = "Tz(200 mm + q4)"

[tool]
frame = "left hand"
transform = "Ty(30)"

[[source]]
name = "left bearing"
class = "repeatable"
frame = "left"
e_x = 0.02
e_s = "0.1 mrad"

[[source]]
name = "right bearing"
class = "repeatable"
frame = "right"
e_x = 0.02
e_s = "0.1 mrad"
"#;

/// A four-bar linkage with a tool on its coupler.
pub const FOUR_BAR: &str = r#"
[manipulator]
name = "four_bar"
length = "mm"

[[frame]]
name = "crank"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"], home = "60 deg" }
transform = "Rz(q1) Tx(40)"

[[frame]]
name = "coupler"
variable = { name = "p1", kind = "revolute", passive = true, home = "-30 deg" }
transform = "Rz(p1) Tx(120)"

[[frame]]
name = "rocker"
parent = "base"
variable = { name = "p2", kind = "revolute", passive = true, home = "80 deg" }
transform = "Tx(100) Rz(p2) Tx(80)"

[[loop]]
name = "knee"
frames = ["coupler", "rocker"]
closes = ["x", "y"]

[tool]
frame = "coupler"
transform = "Ty(30)"

[[source]]
name = "bearing"
class = "repeatable"
frame = "rocker"
e_x = 0.02
e_s = "0.1 mrad"
"#;

/// Returns a six-legged platform whose legs have the length 580 mm + q, with joints on circles of
/// the radii 400 mm (base) and 250 mm (platform). Every leg has seven sources with these errors:
/// its length, "leg I"; x, y, z of its joint on the base, "base I x" and so on; x, y, z of its
/// joint on the platform, "joint I x" and so on; `more` are further keys of each.
pub fn hexapod(errors: &[[f64; 7]; 6], more: &str) -> String {
    let mut text = "[manipulator]\nname = \"hexapod\"\nlength = \"mm\"\n".to_owned();
    let motions = [
        ("x", "prismatic", "Tx"),
        ("y", "prismatic", "Ty"),
        ("z", "prismatic", "Tz"),
        ("a", "revolute", "Rz"),
        ("b", "revolute", "Ry"),
        ("c", "revolute", "Rx"),
    ];
    for (variable, kind, motion) in motions {
        let name = if variable == "c" { "platform".to_owned() } else { format!("platform {variable}") };
        let home = if variable == "z" { 600.0 } else { 0.0 };
        let _ = write!(
            text,
            "\n[[frame]]\nname = \"{name}\"\ntransform = \"{motion}({variable})\"\n\
             variable = {{ name = \"{variable}\", kind = \"{kind}\", passive = true, home = {home} }}\n",
        );
    }
    for (i, errors) in errors.iter().enumerate() {
        let leg = i + 1;
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let at = |radius: f64, degrees: f64| {
            let angle = (120.0 * (i / 2) as f64 + side * degrees) * PI / 180.0;
            format!("Tx({:.6}) Ty({:.6})", radius * angle.cos(), radius * angle.sin())
        };
        let _ = write!(
            text,
            "\n[[frame]]\nname = \"base {leg}\"\nparent = \"base\"\ntransform = \"{}\"\n\
             \n[[frame]]\nname = \"joint {leg}\"\nparent = \"platform\"\ntransform = \"{}\"\n\
             \n[[loop]]\nname = \"leg {leg}\"\nframes = [\"base {leg}\", \"joint {leg}\"]\n\
             closes = \"distance\"\nlength = \"580 mm + q{leg}\"\n\
             variable = {{ name = \"q{leg}\", kind = \"prismatic\", limits = [-60, 150] }}\n",
            at(400.0, 15.0),
            at(250.0, 45.0),
        );
        let of_joint = |frame: &str, axis: &str| {
            (format!("{frame} {leg} {axis}"), format!("frame = \"{frame} {leg}\"\ne_{axis}"))
        };
        let of_joints = ["base", "joint"].map(|frame| ["x", "y", "z"].map(|axis| of_joint(frame, axis)));
        let length = (format!("leg {leg}"), format!("joint = \"q{leg}\"\nerror"));
        for ((name, key), error) in [length].iter().chain(of_joints.as_flattened()).zip(errors) {
            let _ = write!(
                text,
                "\n[[source]]\nname = \"{name}\"\nclass = \"repeatable\"\n{key} = {error}\n{more}"
            );
        }
    }
    text + "\n[tool]\nframe = \"platform\"\ntransform = \"Tz(100)\"\n"
}

/// Errors of a hexapod between −0.1 and 0.1 mm.
pub fn some_errors() -> [[f64; 7]; 6] {
    std::array::from_fn(|leg| std::array::from_fn(|k| 0.1 * (1.7 * (7 * leg + k) as f64 + 0.3).sin()))
}
