//! Errors of the machine that tests of several suites simulate: included by its path.
#![allow(unreachable_pub)]

/// Errors of a simulated UR5, at two of its frames; more effects may follow.
pub const ERRORS: &str = r#"
[[source]]
name = "truth"
class = "repeatable"

[[source.effect]]
frame = "shoulder"
e_x = "0.6 mm"
e_s = "0.8 mrad"

[[source.effect]]
frame = "elbow"
e_y = "-0.5 mm"
e_p = "-1.1 mrad"
"#;
