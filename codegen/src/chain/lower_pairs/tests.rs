//! Tests of `lower_pairs.rs`.

use super::*;

/// Parses a spec of one frame with the revolute variable `q` after one with `d`, and a tool.
fn pairs(frame: &str, tool: &str) -> Vec<bool> {
    let text = format!(
        "[manipulator]\nname = \"arm\"\nlength = \"m\"\n[parameters]\na = \"0.3 m\"\nk = 1\n\
         [[frame]]\nname = \"1\"\nvariable = {{ name = \"d\", kind = \"prismatic\" }}\ntransform = \"Rx(0.3) Tz(a - d)\"\n\
         [[frame]]\nname = \"2\"\nvariable = {{ name = \"q\", kind = \"revolute\" }}\n{frame}\n\
         [tool]\ntransform = \"{tool}\"\n"
    );
    lower_pairs(&Spec::parse("arm.toml", &text).expect("a spec"))
}

#[test]
fn turns_and_slides_are_lower_pairs() {
    for frame in [
        "transform = \"Tx(a) Rz(q + 0.1) Ry(k)\"",
        "transform = \"Ry(-q)\"",
        "dh = { theta = \"q\", d = \"a\", a = 0.2, alpha = 0.4 }",
        "mdh = { theta = \"0.3 - q\", d = \"a\", a = 0.2, alpha = 0.4 }",
        "origin = { xyz = [0, 1, 0] }\naxis = [0.6, 0, -0.8]",
        "matrix = [[\"cos(q)\", 0, \"sin(q)\", \"a*cos(q)\"], [0, 1, 0, \"a\"], [\"-sin(q)\", 0, \"cos(q)\", \"-a*sin(q)\"], [0, 0, 0, 1]]",
    ] {
        assert_eq!(pairs(frame, "Tx(a)"), [true, true], "{frame}");
        // A tool that moves does so behind the last frame.
        assert_eq!(pairs(frame, "Tx(a) Rz(q)"), [true, false], "{frame}");
    }
}

#[test]
fn what_is_coupled_geared_or_screwed_is_none() {
    for frame in [
        "transform = \"Rz(2*q)\"",
        "transform = \"Rz(k*q)\"",
        "transform = \"Rz(q) Tz(a*q)\"",
        "transform = \"Rz(q) Rx(q)\"",
        "transform = \"Rz(q + d/(1 m))\"",
        "transform = \"Rz(abs(q))\"",
        "transform = \"Rz(q + 0.1*sin(q))\"",
        "matrix = [[\"cos(2*q)\", 0, \"sin(2*q)\", 0], [0, 1, 0, 0], [\"-sin(2*q)\", 0, \"cos(2*q)\", 0], [0, 0, 0, 1]]",
    ] {
        assert_eq!(pairs(frame, "Tx(a)"), [true, false], "{frame}");
    }
}
