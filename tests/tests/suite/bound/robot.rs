//! Random robots with random sources of every kind.

use std::fmt::Write;

use rand::seq::IndexedRandom;
use rand::{Rng, RngExt};

/// Errors as functions of the placeholder `q`, of `p` (a payload of 0–5 kg) and of `heat` (a
/// temperature of −10 … 10 K).
const ANGLES: [&str; 12] = [
    "2e-4",
    "1e-4 * sin(3*q + 0.3)",
    "1e-4 * cos(q)^2",
    "5e-5 * q - 2e-5 * q^3",
    "1e-4 * abs(q - 0.2)",
    "sign(cos(q)) * 1e-4",
    "1e-4 * max(q, 0.1) - 5e-5 * min(q, 1 - q)",
    "1e-4 * sqrt(1 + q^2)",
    "1e-4 * atan2(sin(q), 2 + cos(q))",
    "1e-4 * exp(-q^2) + 1e-5 * p/(1 kg)",
    "1e-5 * heat/(1 K) * sin(q) + 1e-5 * log(2 + cos(q)) * tan(q/10)",
    "linear(q) + cubic(q)",
];

/// Returns a random spec, whose tables hold beyond their ends. Inputs have an uncertainty in a
/// third of them, so that the derivative of every error is a random source.
pub(crate) fn spec(random: &mut impl Rng) -> String {
    let text = exact_inputs(random);
    let uncertain = text.replace("\"5 kg\"] }", "\"5 kg\"], uncertainty = \"0.3 kg\" }");
    let uncertain = uncertain.replace("\"10 K\"] }", "\"10 K\"], uncertainty = \"0.5 K\" }");
    if random.random_bool(1.0 / 3.0) { uncertain } else { text }
}

fn exact_inputs(random: &mut impl Rng) -> String {
    let frames = random.random_range(2..=6);
    let euler = random.random_bool(0.2);
    let mut text = format!(
        "[manipulator]\nname = \"robot\"\nlength = \"m\"\ngravity = [0, 0, \"-9.81 m/s^2\"]\n{}\
         [inputs]\np = {{ value = \"2 kg\", range = [\"0 kg\", \"5 kg\"] }}\nheat = {{ value = \"0 K\", range = [\"-10 K\", \"10 K\"] }}\n\
         [tables.linear]\nx = [-3, -1, 0.5, 2]\ny = [0, 1e-4, -1e-4, 5e-5]\ninterpolation = \"linear\"\noutside = \"hold\"\n\
         [tables.cubic]\nx = [-2, -1, 0, 1, 2]\ny = [1e-4, 0, -1e-4, 2e-4, 2e-4]\ninterpolation = \"cubic\"\noutside = \"hold\"\n",
        if euler { "orientation = \"euler-yzx\"\n" } else { "" }
    );
    let mut joints = Vec::new();
    for i in 1..=frames {
        let is_slide = random.random_bool(0.25);
        let twist = *["0", "pi/2", "-pi/2", "0.4"].choose(random).unwrap();
        let before = match (joints.last(), random.random_bool(0.2)) {
            (Some((name, false)), true) => format!(" + {name}"),
            _ => String::new(),
        };
        let (a, d) = (random.random_range(0.0..0.5), random.random_range(-0.2..0.4));
        let (kind, limits, theta, d) = match is_slide {
            true => ("prismatic", "[-0.5, 0.8]".to_owned(), "0.3".to_owned(), format!("q{i} + {d:.3} m")),
            false => {
                let low = random.random_range(-180..0);
                let high = random.random_range(0..=180);
                (
                    "revolute",
                    format!("[\"{low} deg\", \"{high} deg\"]"),
                    format!("q{i}{before}"),
                    format!("{d:.3}"),
                )
            }
        };
        let _ = write!(
            text,
            "[[frame]]\nname = \"{i}\"\nvariable = {{ name = \"q{i}\", kind = \"{kind}\", limits = {limits} }}\n\
             dh = {{ theta = \"{theta}\", d = \"{d}\", a = {a:.3}, alpha = \"{twist}\" }}\n"
        );
        joints.push((format!("q{i}"), is_slide));
    }
    let _ = write!(text, "[tool]\ntransform = \"Tx(0.1) Ty({:.3})\"\n", random.random_range(-0.1..0.1));
    for k in 0..random.random_range(1..=5) {
        let class = match random.random_bool(0.5) {
            true => "class = \"repeatable\"",
            false => {
                let distribution = *["uniform", "normal", "arcsine"].choose(random).unwrap();
                &format!("class = \"random\"\ndistribution = \"{distribution}\"")
            }
        };
        let (joint, is_slide) = joints.choose(random).unwrap();
        let q = if *is_slide { format!("({joint}/(1 m))") } else { joint.clone() };
        let angle = replaced(ANGLES.choose(random).unwrap(), &q);
        let frame = random.random_range(1..=frames);
        let _ = write!(text, "[[source]]\nname = \"{k}\"\n{class}\n");
        let component = *["e_s", "e_r", "e_p"].choose(random).unwrap();
        let _ = match random.random_range(0..6) {
            0 => writeln!(text, "frame = \"{frame}\"\n{component} = \"{angle}\""),
            1 => writeln!(text, "frame = \"{frame}\"\ne_x = \"1 m * ({angle})\"\n{component} = \"1e-4\""),
            2 => writeln!(
                text,
                "frame = \"{frame}\"\nat = \"Tx(0.1) Rz(0.2)\"\n{component} = \"{angle}\"\ne_z = \"2e-4\""
            ),
            3 if !is_slide => writeln!(text, "joint = \"{joint}\"\nerror = \"{angle}\""),
            4 => writeln!(text, "frame = \"{frame}\"\ndh = {{ a = \"1e-4 m\", alpha = \"1e-4\" }}"),
            _ => writeln!(
                text,
                "frame = \"{frame}\"\nbeam = {{ length = \"0.3 m\", EI_y = \"4e4 N*m^2\", EI_z = \"4e4 N*m^2\", GJ = \"3e4 N*m^2\", axis = \"x\" }}"
            ),
        };
    }
    if !text.contains("beam") {
        return text.replace("gravity = [0, 0, \"-9.81 m/s^2\"]\n", "");
    }
    let _ = write!(
        text,
        "[[load]]\nname = \"payload\"\nmass = \"p\"\nframe = \"{frames}\"\npoint = [0.1, 0, 0]\n"
    );
    text
}

/// Replaces every `q` that is a whole name.
fn replaced(angle: &str, q: &str) -> String {
    let letters: Vec<char> = angle.chars().collect();
    let is_name = |k: usize| letters.get(k).is_some_and(char::is_ascii_alphanumeric);
    let mut text = String::new();
    for (k, letter) in letters.iter().enumerate() {
        match *letter == 'q' && !is_name(k + 1) && (k == 0 || !is_name(k - 1)) {
            true => text += q,
            false => text.push(*letter),
        }
    }
    text
}
