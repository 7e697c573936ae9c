//! Specs for tests: chains of any length, and features that the shipped specs lack.

use std::fmt::Write;

/// Returns the spec of a chain of frames in general position, alternately revolute and prismatic.
pub fn general_chain(frames: usize) -> String {
    let mut text = "[manipulator]\nname = \"chain\"\nlength = \"m\"\n".to_owned();
    for i in 0..frames {
        let (kind, theta, d) = if i % 2 == 0 {
            ("revolute", format!("q{i} + 0.1"), "0.2".to_owned())
        } else {
            ("prismatic", "0.3".to_owned(), format!("q{i} + 0.1 m"))
        };
        let twist = 0.4 + 0.01 * (i % 500) as f64;
        let _ = write!(
            text,
            "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\" }}\n\
             dh = {{ theta = \"{theta}\", d = \"{d}\", a = 0.{}, alpha = {twist} }}\n",
            i + 1
        );
    }
    text
}

/// Returns the spec of a chain of revolute joints with skew neighboring axes.
pub fn revolute_chain(frames: usize) -> String {
    let mut text = "[manipulator]\nname = \"chain\"\nlength = \"m\"\n".to_owned();
    for i in 0..frames {
        let (name, d, twist) = (i + 1, 0.1 + 0.01 * (i % 7) as f64, 0.5 + 0.1 * (i % 11) as f64);
        let _ = write!(
            text,
            "[[frame]]\nname = \"{name}\"\n\
             variable = {{ name = \"q{name}\", kind = \"revolute\", limits = [\"-150 deg\", \"150 deg\"] }}\n\
             dh = {{ theta = \"q{name}\", d = {d}, a = 0.3, alpha = {twist} }}\n"
        );
    }
    text
}

/// Returns the spec of an arm of six revolute joints with `count` parameters, all of them in its
/// lengths.
pub fn many_parameters(count: usize) -> String {
    let mut text = "[manipulator]\nname = \"many\"\nlength = \"m\"\n[parameters]\n".to_owned();
    for i in 0..count {
        let _ = writeln!(text, "p{i} = \"{} mm\"", 1 + i % 9);
    }
    for frame in 0..6 {
        let own: Vec<String> = (frame..count).step_by(6).map(|i| format!("p{i}")).collect();
        let sum = if own.is_empty() { "0 m".to_owned() } else { own.join(" + ") };
        let _ = write!(
            text,
            "[[frame]]\nname = \"{frame}\"\nvariable = {{ name = \"q{frame}\", kind = \"revolute\" }}\n\
             dh = {{ theta = \"q{frame}\", d = \"0.1 m + ({sum})/100\", a = 0.3, alpha = 0.7 }}\n"
        );
    }
    text
}

/// Returns the spec of a chain of 40 frames, long enough to be generated as loops: Euler rows, a
/// parameter in two places, a variable in two, and sources of both classes.
pub fn long_chain() -> String {
    let chain = general_chain(40).replacen("name = \"chain\"\nlength = \"m\"\n", LONG_HEAD, 1).replacen(
        "d = \"0.2\"",
        "d = \"reach/2\"",
        1,
    );
    chain + LONG_TAIL
}

const LONG_HEAD: &str = r#"name = "long"
length = "m"
orientation = "euler-yzx"
[parameters]
reach = "0.4 m"
[inputs]
load = { value = "2 kg", range = ["0 kg", "5 kg"] }
"#;

const LONG_TAIL: &str = r#"[tool]
transform = "Tx(reach) Rz(q2/5) Ry(0.2)"
[[source]]
name = "sag"
class = "repeatable"
frame = "3"
e_x = "1e-4 m/kg * load * cos(q4)"
e_s = "2e-5/kg * load"
e_p = "1e-4"
[[source]]
name = "bow"
class = "repeatable"
frame = "30"
e_z = "0.001 * q31"
e_r = "3e-4"
[[source]]
name = "encoder"
class = "random"
distribution = "uniform"
frame = "20"
e_r = "1e-4"
"#;

/// Returns a spec with variables in several frames, twice in one frame, inside a matrix and in the
/// tool, with a screw joint and an axis in general direction.
pub fn coupled_joints() -> &'static str {
    r#"
        [manipulator]
        name = "coupled"
        length = "m"
        [parameters]
        pitch = "0.01 m"
        [[frame]]
        name = "screw"
        variable = { name = "q1", kind = "revolute" }
        transform = "Rz(q1) Tz(pitch*q1/(2*pi)) Rz(0.3) Rx(0.2)"
        [[frame]]
        name = "parallelogram"
        variable = { name = "q2", kind = "revolute" }
        matrix = [["cos(q2 - q1)", "-sin(q2 - q1)", 0, "0.5 m * cos(q2)"],
                  ["sin(q2 - q1)", "cos(q2 - q1)", 0, "0.5 m * sin(q2)"],
                  [0, 0, 1, "pitch * q1"],
                  [0, 0, 0, 1]]
        [[frame]]
        name = "fixed"
        transform = "Tx(0.1) Ry(0.4) Rz(0.2) Rx(0.1) Ty(0.2)"
        [[frame]]
        name = "skew"
        variable = { name = "q3", kind = "revolute" }
        origin = { xyz = [0.1, 0.2, 0.3], rpy = [0.1, 0.2, 0.3] }
        axis = [0.6, 0, 0.8]
        [[frame]]
        name = "slide"
        variable = { name = "d4", kind = "prismatic" }
        origin = { rpy = [0, 0, "q3/2"] }
        axis = [0, 0.6, -0.8]
        [tool]
        transform = "Tz(0.2 m + d4/3) Rx(q1/5)"
    "#
}

/// Returns the spec of a realistic random arm: 2 to 8 joints, some prismatic, neighboring axes
/// mostly parallel or perpendicular, many lengths 0, in all notations of specs. `index` selects the
/// arm.
pub fn random_arm(index: u64) -> String {
    let mut state = index.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(0x2545_F491_4F6C_DD1D);
    let mut below = |count: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % count
    };
    let frames = 2 + below(7);
    let mut text = "[manipulator]\nname = \"arm\"\nlength = \"m\"\n[parameters]\n".to_owned();
    for k in 0..3 {
        writeln!(text, "a{k} = \"{} mm\"", 100 + below(400)).unwrap();
    }
    for i in 1..=frames {
        let prismatic = below(5) == 0;
        let kind = if prismatic { "prismatic" } else { "revolute" };
        let mut length = |zeros: u64| match below(zeros + 3) {
            0 => format!("\"a{}\"", below(3)),
            1 | 2 => format!("\"{} mm\"", 50 + below(500)),
            _ => "0".to_owned(),
        };
        let (a, mut d) = (length(2), length(2));
        let alpha = match below(8) {
            0 | 1 => "0",
            2 | 3 => "\"pi/2\"",
            4 | 5 => "\"-pi/2\"",
            6 => "\"pi\"",
            _ => "0.3",
        };
        let mut theta = format!("\"q{i}\"");
        if prismatic {
            (theta, d) = (["0", "\"pi/2\"", "0.4"][below(3) as usize].to_owned(), theta);
        }
        writeln!(
            text,
            "[[frame]]\nname = \"frame {i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\" }}"
        )
        .unwrap();
        match below(4) {
            0 => writeln!(text, "mdh = {{ theta = {theta}, d = {d}, a = {a}, alpha = {alpha} }}"),
            1 => {
                let axis =
                    ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]", "[0, 0, -1]", "[0.6, 0, 0.8]"][below(5) as usize];
                writeln!(text, "origin = {{ xyz = [{a}, 0, 0.2], rpy = [{alpha}, 0, 0] }}\naxis = {axis}")
            }
            _ => writeln!(text, "dh = {{ theta = {theta}, d = {d}, a = {a}, alpha = {alpha} }}"),
        }
        .unwrap();
    }
    let tool = ["", "Tz(0.1)", "Tx(a0) Tz(0.2)", "Tx(0.1) Ry(0.2) Tz(a1)"][below(4) as usize];
    if !tool.is_empty() {
        writeln!(text, "[tool]\ntransform = \"{tool}\"").unwrap();
    }
    text
}

/// Adds gravity, a full compliance at every frame, and a mass and a wrench at the tool to a spec
/// without loads.
pub fn elastic_links(spec: &str) -> String {
    let mut text = spec.replacen("[manipulator]", "[manipulator]\ngravity = [0, 0, \"-9.81 m/s^2\"]", 1);
    let frames: Vec<&str> =
        spec.split("[[frame]]\nname = \"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    for (i, frame) in frames.iter().enumerate() {
        let entry = |row: usize, column: usize| {
            let whole = if row == column { 9 } else { 0 };
            let unit = match (row < 3, column < 3) {
                (true, true) => " m/N",
                (false, false) => "/(N*m)",
                _ => "/N",
            };
            format!("\"{whole}.{}e-6{unit}\"", 1 + (row + column + i) % 7)
        };
        let row = |row: usize| (0..6).map(|column| entry(row, column)).collect::<Vec<_>>().join(", ");
        let rows = (0..6).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", ");
        let _ = write!(
            text,
            "[[source]]\nname = \"link {frame}\"\nclass = \"repeatable\"\nframe = \"{frame}\"\n\
             compliance = {{ matrix = [{rows}] }}\n"
        );
    }
    let last = frames[frames.len() - 1];
    let _ = write!(
        text,
        "[[load]]\nname = \"carried\"\nmass = \"3 kg\"\nframe = \"{last}\"\npoint = \"tool\"\n\
         [[load]]\nname = \"wrench\"\naxes = \"base\"\nforce = [\"1 N\", \"2 N\", \"3 N\"]\n\
         moment = [\"1 N*m\", \"2 N*m\", \"3 N*m\"]\nframe = \"{last}\"\npoint = \"tool\"\n"
    );
    text
}
