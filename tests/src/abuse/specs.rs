//! Random valid specs.

use std::collections::HashSet;
use std::fmt::Write;

use super::{Choices, expression};

/// Names with a meaning in generated Rust or JavaScript, in the crate or in its prelude.
const NAMES: &str = "default default_ result results Vec vec self_ Self_ String Box None_ Some_ option zero one zero_ one_ \
    q s u t1 t2 t3 s1 c1 s2 c2 sin_1 cos_1 sin_x cos_x x y z p1_x p1_y r1_11 a2 a2_z4 pose columns effects errors \
    variances magnitudes displacement covariance transforms margin entries constant factor term entry raw abbe core std \
    alloc Scalar T FRAMES ERRORS VARIABLES PARAMETERS INPUTS EFFECTS SOURCES DISTINCT DESCRIPTION NOMINAL Parameters \
    Inputs Description Frame Text List error_columns error_jacobian joint_jacobian real_pose drawn_pose compensated \
    to_array main test println assert panic print usize f64 bool str char i32 u8 Ok_ Err_ drop clone copy debug \
    function var new class arguments eval NaN Infinity undefined Math Float64Array export default__ const_ let_ \
    constructor prototype toString lookup i k e_x e_s links v1_s m1 e1_x _x x_ x__ a__b aB A B_ async_ union raw_ dyn_ \
    macro_rules auto static_ w yields wher D1 d_1 h_1 LOOKUP TABLE_ UP_TABLE one_sided index row column";

/// Escapes of characters that a name must not contain.
const REFUSED_IN_NAMES: [&str; 4] = ["\\u202E", "\\u2066", "\\u2028", "\\uFEFF"];

/// Words for titles, descriptions, and names of frames and sources: ends of comments and strings,
/// changes of writing direction, code.
const WORDS: [&str; 46] = [
    "arm",
    "*/",
    "/*",
    "//",
    "\\\"",
    "\\\\",
    "\\\\\\\"",
    "#",
    "##",
    "\\u202E",
    "\\u2066",
    "\\u200B",
    "\\u2028",
    "\\uFEFF",
    "'",
    "`",
    "```",
    "~~~",
    "```rust",
    "{",
    "}",
    "{{}}",
    "${x}",
    "%s",
    "<b>",
    "</script>",
    "<!--",
    "]]>",
    "[link](x)",
    "[`x`]",
    "| a |",
    "&amp;",
    "größe",
    "機械",
    "🦾",
    "é",
    "\\u0301",
    "https://example.org/a_b?c=d&e",
    "- item",
    "1. item",
    "#[x]",
    "#![x]",
    "r#x#",
    "\\\\n",
    "0",
    "$crate",
];

fn words(c: &mut Choices<'_>, lines: bool) -> String {
    let count = if c.once_in(40) { 400 } else { 1 + c.below(6) };
    let words: Vec<&str> = (0..count).map(|_| *c.one_of(&WORDS)).collect();
    let text = words.join(if lines && c.once_in(3) { "\\n" } else { " " });
    if c.once_in(60) { text.repeat(30) } else { text }
}

/// Reserved names: words of Rust, units, functions.
const RESERVED: &str = "t h s u m g e pi min max";

struct Names {
    taken: HashSet<String>,
    plain: bool,
}

impl Names {
    /// Returns an unused name. Names that differ only in case are equal.
    fn fresh(&mut self, c: &mut Choices<'_>, like: &str) -> String {
        let all: Vec<&str> = NAMES.split_whitespace().filter(|name| !is_reserved(name)).collect();
        let mut name = match self.plain || c.once_in(4) {
            true => format!("{like}{}", self.taken.len() + 1),
            false => (*c.one_of(&all)).to_owned(),
        };
        while !self.taken.insert(name.to_ascii_lowercase()) {
            name.push_str("_2");
        }
        name
    }
}

fn is_reserved(name: &str) -> bool {
    RESERVED.split_whitespace().any(|reserved| reserved == name)
}

/// Returns a spec file with hostile names and texts.
pub fn spec(c: &mut Choices<'_>, name: &str) -> String {
    build(c, Some(name))
}

/// Returns a spec file with plain names and texts.
pub fn plain_spec(c: &mut Choices<'_>) -> String {
    build(c, None)
}

fn build(c: &mut Choices<'_>, hostile: Option<&str>) -> String {
    let mut names = Names { taken: HashSet::new(), plain: hostile.is_none() };
    let mut text = String::new();
    let said =
        |c: &mut Choices<'_>, lines| if hostile.is_some() { words(c, lines) } else { "said".to_owned() };
    let title = |c: &mut Choices<'_>, of: usize| -> String {
        let said = said(c, false);
        let said = REFUSED_IN_NAMES.iter().fold(said, |said, escape| said.replace(escape, "\\u00AD"));
        let said: String = said.chars().take(60).collect();
        // Not within an escape sequence.
        let said = said.trim_end_matches(|x: char| x == '\\' || x.is_ascii_hexdigit() || x == 'u');
        format!("{of} {said}")
    };
    let orientation = *c.one_of(&["rotation-vector", "euler-yzx"]);
    let (head, about, source) = (said(c, true), said(c, true), said(c, true));
    let _ = write!(
        text,
        "[manipulator]\nname = \"{}\"\ntitle = \"{head}\"\ndescription = \"{about}\"\nreference = \"{source}\"\n\
         length = \"{}\"\norientation = \"{orientation}\"\n",
        hostile.unwrap_or("arm"),
        c.one_of(&["mm", "m"])
    );
    let [mut numbers, mut lengths] = [Vec::new(), Vec::new()];
    let _ = writeln!(text, "[parameters]");
    for _ in 0..c.below(4) {
        let (name, about) = (names.fresh(c, "p"), said(c, true));
        let is_length = c.once_in(2);
        let value = if is_length { format!("{} mm", c.decimal(-300, 300)) } else { c.decimal(-2, 2) };
        let _ = writeln!(text, "{name} = {{ value = \"{value}\", description = \"{about}\" }}");
        if is_length { &mut lengths } else { &mut numbers }.push(name);
    }
    let mut inputs = Vec::new();
    if c.once_in(2) {
        let (name, about) = (names.fresh(c, "u"), said(c, false));
        let _ =
            writeln!(text, "[inputs]\n{name} = {{ value = 0.5, range = [0, 2], description = \"{about}\" }}");
        inputs.push(name);
    }
    let mut frames = Vec::new();
    let count = if c.once_in(12) { 31 } else { 1 + c.below(6) };
    for index in 0..count {
        let frame = title(c, index);
        let _ = writeln!(text, "[[frame]]\nname = \"{frame}\"");
        frames.push(frame);
        if c.once_in(5) {
            let moved = expression(c, true, [&numbers, &lengths], 3);
            let turned = expression(c, false, [&numbers, &lengths], 3);
            let _ = writeln!(text, "transform = \"Tx({moved}) Ry({turned})\"");
            continue;
        }
        let (name, revolute) = (names.fresh(c, "j"), c.once_in(2));
        let axis = *c.one_of(&["x", "y", "z"]);
        let bent = c.once_in(2).then(|| expression(c, !revolute, [&numbers, &lengths], 3));
        let argument = match &bent {
            Some(bent) => format!("{name} + ({bent})"),
            None => name.clone(),
        };
        let (kind, limits, motion) = match revolute {
            true => ("revolute", "[\"-120 deg\", \"130 deg\"]", "R"),
            false => ("prismatic", "[\"-200 mm\", \"500 mm\"]", "T"),
        };
        let _ = writeln!(text, "variable = {{ name = \"{name}\", kind = \"{kind}\", limits = {limits} }}");
        if revolute { &mut numbers } else { &mut lengths }.push(name);
        let away = expression(c, true, [&numbers, &lengths], 3);
        let turned = expression(c, false, [&numbers, &lengths], 3);
        let _ = writeln!(text, "transform = \"{motion}{axis}({argument}) Ty({away}) Rz({turned})\"");
    }
    let away = expression(c, true, [&numbers, &lengths], 2);
    let _ = writeln!(text, "[tool]\ntransform = \"Tz({away})\"");
    numbers.extend(inputs);
    for index in 0..c.below(5) {
        let (name, reference) = (title(c, index), said(c, true));
        let class = *c.one_of(&[
            "class = \"repeatable\"",
            "class = \"random\"\ndistribution = \"uniform\"",
            "class = \"random\"\ndistribution = \"normal\"",
        ]);
        let _ = writeln!(text, "[[source]]\nname = \"{name}\"\nreference = \"{reference}\"\n{class}");
        let _ = writeln!(text, "frame = \"{}\"", c.one_of(&frames));
        let (e, f) = (*c.one_of(&["x", "y", "z"]), *c.one_of(&["s", "r", "p"]));
        let (moved, turned) =
            (expression(c, true, [&numbers, &lengths], 3), expression(c, false, [&numbers, &lengths], 3));
        let _ = writeln!(
            text,
            "e_{e} = \"1e-3*(1.5 + sin({turned}))*abs({moved})\"\ne_{f} = \"1e-3*abs({turned})\""
        );
    }
    text
}
