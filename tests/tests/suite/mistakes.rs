//! Mistakes as beginners make them: each is accepted as it was meant, or its first hint, obeyed by
//! a machine, gives the spec that was meant.

use abbe::Manipulator;
use abbe::analysis::sampling;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

const MEANT: &str = r#"gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]

[manipulator]
name = "arm"
length = "mm"

[parameters]
l1 = { value = "400 mm", description = "upper arm" }

[inputs]
warming = { value = "5 K", range = ["0 K", "20 K"] }
load = { value = "8 kg", range = ["0 kg", "20 kg"] }
wrench = { value = "12 N*m", range = ["0 N*m", "30 N*m"] }

[[load]]
frame = "hand"
mass = "load"

[[frame]]
name = "shoulder"
variable = { name = "q1", kind = "revolute", limits = ["-170 deg", "170 deg"] }
transform = "Rz(q1) Tz(300)"

[[frame]]
name = "upper"
variable = { name = "q2", kind = "revolute", limits = ["-90 deg", "90 deg"] }
transform = "Ry(q2) Tx(l1)"

[[frame]]
name = "hand"
variable = { name = "d3", kind = "prismatic", limits = ["0 mm", "250 mm"] }
transform = "Tx(d3)"

[tool]
transform = "Tx(80 mm)"

[[source]]
name = "gear"
class = "repeatable"
joint = "q1"
error = "0.2 mrad"

[[source]]
name = "bending"
class = "repeatable"
frame = "upper"
e_z = "-0.1 mm"
e_s = "0.15 mrad"

[[source]]
name = "winding"
class = "repeatable"
joint = "q2"
stiffness = "120000 N*m/rad"

[[source]]
name = "growth"
class = "repeatable"
parameter = "l1"
error = "l1 * 12e-6/K * warming"

[[source]]
name = "encoder"
class = "random"
distribution = "uniform"
joint = "q2"
error = "10 arcsec"
"#;

/// Parts of the spec, and what was written in their place.
const MISTAKES: &[(&str, &str)] = &[
    (r#""400 mm""#, r#""400 millimeters""#),
    (r#""400 mm""#, r#""40 cms""#),
    (r#""400 mm""#, r#""400 MM""#),
    (r#""400 mm""#, r#""0.4 meter""#),
    (r#""400 mm""#, r#""400mm ""#),
    (r#""5 K""#, r#""5 degC""#),
    (r#""5 K""#, r#""5 C""#),
    (r#""5 K""#, r#""5 k""#),
    (r#""8 kg""#, r#""8 KG""#),
    (r#""8 kg""#, r#""8 kgs""#),
    (r#""8 kg""#, r#""8 kilo""#),
    (r#""12 N*m""#, r#""12 Nm""#),
    (r#""12 N*m""#, r#""12 N m""#),
    (r#""12 N*m""#, r#""12 N.m""#),
    (r#""12 N*m""#, r#"12"#),
    (r#""-9.81 m/s^2""#, r#"-9.81"#),
    (r#""-9.81 m/s^2""#, r#""-9.81 m/s2""#),
    (r#""-9.81 m/s^2""#, r#""-9.81 m/s²""#),
    (r#""-9.81 m/s^2""#, r#""-9.81 m/s/s""#),
    (r#""-170 deg""#, r#""-170 degrees""#),
    (r#""-170 deg""#, r#""-170°""#),
    (r#""-170 deg""#, r#""-170 DEG""#),
    (r#""-170 deg""#, r#"-170"#),
    (r#""0.2 mrad""#, r#""0.2 mRad""#),
    (r#""0.2 mrad""#, r#""200 urads""#),
    (r#""-0.1 mm""#, r#""-100 micron""#),
    (r#""-0.1 mm""#, r#""-100 um ""#),
    (r#""-0.1 mm""#, r#""-100 µm""#),
    (r#""0.15 mrad""#, r#""0.15 mm/m""#),
    (r#""0.15 mrad""#, r#""150 urad/1""#),
    (r#""120000 N*m/rad""#, r#""120000 Nm/rad""#),
    (r#""120000 N*m/rad""#, r#"120000"#),
    (r#""120000 N*m/rad""#, r#""120000 N*m""#),
    (r#""120000 N*m/rad""#, r#""120 kN*m/rad""#),
    (r#"12e-6/K"#, r#"12e-6/degC"#),
    (r#"12e-6/K"#, r#"12 ppm/K"#),
    (r#"12e-6/K"#, r#"12 um/m/K"#),
    (r#""10 arcsec""#, r#""10 arcseconds""#),
    (r#""-0.1 mm""#, r#""-0,1 mm""#),
    (r#""-0.1 mm""#, r#"-0,1"#),
    (r#""0.2 mrad""#, r#"0.2 mrad"#),
    (r#""400 mm""#, r#"400 mm"#),
    (
        r#"[[frame]]
name = "upper""#,
        r#"[frame]
name = "upper""#,
    ),
    (r#"[manipulator]"#, r#"[Manipulator]"#),
    (r#"[manipulator]"#, r#"[robot]"#),
    (
        r#"[[source]]
name = "gear""#,
        r#"[[sources]]
name = "gear""#,
    ),
    (r#"[parameters]"#, r#"[parameter]"#),
    (r#"[inputs]"#, r#"[input]"#),
    (r#"[tool]"#, r#"[[tool]]"#),
    (r#"[[load]]"#, r#"[load]"#),
    (r#"class = "random""#, r#"class = "Random""#),
    (r#"class = "random""#, r#"class = "stochastic""#),
    (
        r#"class = "repeatable"
joint = "q1""#,
        r#"class = "systematic"
joint = "q1""#,
    ),
    (r#"distribution = "uniform""#, r#"distribution = "rectangular""#),
    (r#"kind = "prismatic""#, r#"kind = "linear""#),
    (r#"kind = "prismatic""#, r#"kind = "slide""#),
    (r#"kind = "prismatic""#, r#"kind = "Prismatic""#),
    (r#"kind = "prismatic""#, r#"type = "prismatic""#),
    (r#"limits = ["0 mm", "250 mm"]"#, r#"limit = ["0 mm", "250 mm"]"#),
    (r#"limits = ["0 mm", "250 mm"]"#, r#"range = ["0 mm", "250 mm"]"#),
    (r#"transform = "Tx(d3)""#, r#"transform = "tx(d3)""#),
    (r#"transform = "Tx(d3)""#, r#"transform = "TX(d3)""#),
    (r#"transform = "Tx(d3)""#, r#"transform = "Tx(D3)""#),
    (r#""Rz(q1) Tz(300)""#, r#""Rz(q1)*Tz(300)""#),
    (r#""Rz(q1) Tz(300)""#, r#""RotZ(q1) Tz(300)""#),
    (r#"length = "mm""#, r#"length = "millimeter""#),
    (r#"length = "mm""#, r#"length = "MM""#),
    (r#"length = "mm""#, r#"units = "mm""#),
    (r#"frame = "upper""#, r#"frame = "Upper""#),
    (r#"frame = "upper""#, r#"frame = "uper""#),
    (r#"frame = "upper""#, r#"link = "upper""#),
    (r#"joint = "q1""#, r#"joint = "Q1""#),
    (r#"joint = "q1""#, r#"joint = "q_1""#),
    (r#"joint = "q1""#, r#"joint = "shoulder""#),
    (r#"parameter = "l1""#, r#"parameter = "L1""#),
    (r#"parameter = "l1""#, r#"param = "l1""#),
    (r#"e_z = "-0.1 mm""#, r#"ez = "-0.1 mm""#),
    (r#"e_z = "-0.1 mm""#, r#"e_Z = "-0.1 mm""#),
    (r#"e_z = "-0.1 mm""#, r#"dz = "-0.1 mm""#),
    (r#"e_s = "0.15 mrad""#, r#"e_ry = "0.15 mrad""#),
    (r#"error = "0.2 mrad""#, r#"value = "0.2 mrad""#),
    (r#"error = "0.2 mrad""#, r#"errors = "0.2 mrad""#),
    (r#"mass = "load""#, r#"mass = "Load""#),
    (r#"mass = "load""#, r#"mass = load"#),
];

/// Returns pose, errors of all sources and limits at a configuration.
fn figures(spec: &Spec) -> Vec<f64> {
    let machine = Interpreter::new(spec.clone());
    let description = machine.description();
    let (s, u) = (sampling::nominal_parameters(description), sampling::nominal_inputs(description));
    let q: Vec<f64> = description.variables.iter().map(|one| one.limits[0] + 0.3 * one.limits[1]).collect();
    let real = machine.real_pose(&q, &s, &u).unwrap();
    let mut effects = vec![0.0; description.effects.len()];
    machine.effects(&q, &s, &u, &mut effects).unwrap();
    let limits = description.variables.iter().flat_map(|one| one.limits);
    real.0.as_flattened().iter().copied().chain(effects).chain(limits).collect()
}

/// Returns the texts that a hint proposes for a place, each in the ways in which it can be written
/// there.
fn obeyed(text: &str, span: std::ops::Range<usize>, help: &str) -> Vec<String> {
    let line = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[span.end..].find('\n').map_or(text.len(), |at| span.end + at);
    let key = text[line..end].split(" = ").next().unwrap_or_default();
    let mut all = Vec::new();
    for proposed in help.split('`').skip(1).step_by(2) {
        let within = |from: usize, new: &str, to: usize| [&text[..from], new, &text[to..]].concat();
        let quoted = format!("\"{proposed}\"");
        if text[span.clone()].starts_with('"') && !proposed.starts_with('"') {
            all.push(within(span.start, &quoted, span.end));
        }
        all.push(within(span.start, proposed, span.end));
        all.push(within(line, proposed, end));
        all.push(within(span.start, &quoted, span.end));
        all.push(within(line, &format!("{key} = {proposed}"), end));
    }
    all
}

#[test]
fn hints_that_are_obeyed_give_what_was_meant() {
    let meant = figures(&Spec::parse("meant.toml", MEANT).unwrap());
    let mut failed = Vec::new();
    for (right, wrong) in MISTAKES {
        assert!(MEANT.contains(right), "{right}");
        let mut text = MEANT.replacen(right, wrong, 1);
        // A hint may lead to another mistake, with a hint of its own.
        let found = (0..3).find_map(|_| match Spec::parse("mistake.toml", &text) {
            Ok(spec) => Some(figures(&spec)),
            Err(found) => {
                let first = &found.list[0];
                let span = first.span.clone().unwrap_or(0..0);
                let all = obeyed(&text, span, first.help.as_deref().unwrap_or_default());
                let good = all.iter().find_map(|text| Spec::parse("obeyed.toml", text).ok());
                text = all.into_iter().next().unwrap_or_default();
                good.map(|spec| figures(&spec))
            }
        });
        let is_meant = found.as_ref().is_some_and(|found| {
            found.len() == meant.len()
                && found.iter().zip(&meant).all(|(a, b)| (a - b).abs() <= 1e-9 * b.abs().max(1e-9))
        });
        if !is_meant {
            failed.push((right, wrong, found));
        }
    }
    println!("{} of {} mistakes", MISTAKES.len() - failed.len(), MISTAKES.len());
    assert!(failed.is_empty(), "{failed:#?}");
}
