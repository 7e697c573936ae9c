//! Specs of any length.

use std::fmt::Write;

/// The spec of a chain of frames in general position, alternating revolute and prismatic.
pub fn general_chain(frames: usize) -> String {
    let mut text = "[manipulator]\nname = \"chain\"\nlength = \"m\"\n".to_owned();
    for i in 0..frames {
        let (kind, theta, d) = if i % 2 == 0 {
            ("revolute", format!("q{i} + 0.1"), "0.2".to_owned())
        } else {
            ("prismatic", "0.3".to_owned(), format!("q{i} + 0.1 m"))
        };
        let twist = 0.4 + 0.01 * i as f64;
        let _ = write!(
            text,
            "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\" }}\n\
             dh = {{ theta = \"{theta}\", d = \"{d}\", a = 0.{}, alpha = {twist} }}\n",
            i + 1
        );
    }
    text
}
