//! Writes the frames of the real machine as a URDF of its own, and its loops beside it.
//!
//! Each frame is a link that has the name and, with its errors E, the pose of the frame. One that
//! moves is the product of two joints, the first about or along an axis of its factor R(q):
//!
//! ```text
//! A(q) E = B · R(q) · C E      origin of the joint · joint · fixed joint
//! ```

use abbe::{Pose, VariableKind};
use abbe_spec::expr::{Elementary, Symbol};
use abbe_spec::literal::quoted;
use abbe_spec::option::FROM;
use abbe_spec::{Closure, Diagnostics, Document, Factor, Loop, mistake};

use super::{Ends, NominalChain, scaled, three};
use crate::export::origins::moves;
use crate::export::{ExportReport, ExportedFile, RealMachine};
use crate::placement::roll_pitch_yaw;

/// Limit of a joint with one limit or of a slide without, and effort and velocity: URDF requires
/// some.
const UNLIMITED: f64 = 1e6;

/// Writes the frames of a machine as links and joints, and its loops as tables of TOML, in m and
/// rad.
///
/// # Errors
///
/// A frame is not moved by its own variable alone, as by a revolute or prismatic joint, the length
/// of a leg is more than a constant and a variable, or a name does not fit into a URDF.
pub fn write_tree(machine: &RealMachine) -> Result<ExportReport, Diagnostics> {
    let spec = &machine.spec;
    let (metres, name) = (spec.length.in_metres(), &spec.name);
    let refused = |what: &str, reason: &str| {
        let help = "a joint of a URDF turns about or slides along one axis by one variable, and legs have the \
                    length of a constant and a variable; `abbe generate` writes code for any machine";
        mistake::with_help(&machine.origin, format!("\"{what}\" {reason}"), help)
    };
    let mut text = format!("<robot name=\"{name}\">\n  <link name=\"{}\"/>\n", link_name(machine, None));
    let mut join = |[name, kind, parent, link]: [&str; 4], origin: &Pose, rest: &str| {
        let escaped = |text: &str| text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        let [name, parent, link] = [name, parent, link].map(escaped);
        let (xyz, rpy) = (three(scaled(origin, metres).position()), three(roll_pitch_yaw(origin)));
        text += &format!(
            "  <link name=\"{link}\"/>\n  <joint name=\"{name}\" type=\"{kind}\">\n    \
             <parent link=\"{parent}\"/>\n    <child link=\"{link}\"/>\n    \
             <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>\n{rest}  </joint>\n"
        );
    };
    for (i, frame) in spec.frames.iter().enumerate() {
        let (mut parent, mut origin) = (link_name(machine, frame.parent), Pose::IDENTITY);
        let carrier = unused(machine, format!("{} joint", frame.name));
        for factor in frame.factors.chunks(1) {
            if moves(factor) {
                let immobile = || match factor {
                    [Factor::Matrix(_)] => {
                        refused(&frame.name, "is a matrix: give it as `transform` or `dh`")
                    }
                    _ => refused(&frame.name, "does not move as a joint of its own variable"),
                };
                let (axis, symbol) = axis(machine, &factor[0]).ok_or_else(immobile)?;
                let variable = match symbol {
                    Symbol::Variable(i) if frame.variable == Some(i) => &spec.variables[i],
                    Symbol::Passive(i) if frame.passive == Some(i) => &spec.passive[i],
                    _ => return Err(immobile()),
                };
                let is_prismatic = variable.kind == VariableKind::Prismatic;
                let is_free = !is_prismatic && variable.limits.iter().all(|limit| limit.is_infinite());
                let (kind, unit) = match is_prismatic {
                    true => ("prismatic", metres),
                    false => (if is_free { "continuous" } else { "revolute" }, 1.0),
                };
                let [lower, upper] = variable.limits.map(|limit| (limit * unit).clamp(-UNLIMITED, UNLIMITED));
                let ends =
                    if is_free { String::new() } else { format!("lower=\"{lower}\" upper=\"{upper}\" ") };
                let rest = format!(
                    "    <axis xyz=\"{}\"/>\n    <limit {ends}effort=\"{UNLIMITED}\" velocity=\"{UNLIMITED}\"/>\n",
                    three(axis)
                );
                join([&variable.name, kind, &parent, &carrier], &origin, &rest);
                (parent, origin) = (carrier.clone(), Pose::IDENTITY);
            }
            origin = origin.then(&machine.pose_at_zero(factor));
        }
        let fixed = format!("{} fixed", frame.name);
        join([&fixed, "fixed", &parent, &frame.name], &origin.then(&machine.mean_error(i)), "");
    }
    if moves(&spec.tool) {
        return Err(refused("tool", "moves in its frame"));
    }
    let carrier = link_name(machine, Some(spec.tool_frame));
    let tool = unused(machine, "tool".to_owned());
    join([&format!("{tool} fixed"), "fixed", &carrier, &tool], &machine.pose_at_zero(&spec.tool), "");
    let mut files = vec![ExportedFile { name: format!("{name}.urdf"), text: text + "</robot>\n" }];
    let document = Document::new(&files[0].name, files[0].text.as_str());
    let read = NominalChain::read(&document, &Ends { base: None, tip: Some(tool) });
    document.finish(read)?;
    let too_long = |closed: &Loop| refused(&closed.name, "is longer than a constant and a variable");
    let tables = spec.loops.iter().map(|closed| table(machine, closed).ok_or_else(|| too_long(closed)));
    let tables = tables.collect::<Result<String, _>>()?;
    if !tables.is_empty() {
        let text = format!("# Loops of {name}.urdf, in m and rad.\n{tables}");
        files.push(ExportedFile { name: format!("{name}.loops.toml"), text });
    }
    let mut report = ExportReport::for_mean(machine, "URDF of its frames", files)?;
    report.left_out.push(format!(
        "The links have no shapes and masses: for a chain, `{FROM}` keeps those of the URDF of the nominal robot. \
         A URDF is a tree; the program that loads it needs the loops as constraints."
    ));
    Ok(report)
}

/// Returns the name of a link that is no frame, other than those of frames.
fn unused(machine: &RealMachine, mut name: String) -> String {
    while machine.spec.frames.iter().any(|frame| frame.name == name) {
        name.push('_');
    }
    name
}

/// Returns the name of the link of a frame, or of `F_0`.
fn link_name(machine: &RealMachine, frame: Option<usize>) -> String {
    frame.map_or_else(|| unused(machine, "base".to_owned()), |frame| machine.spec.frames[frame].name.clone())
}

/// Returns the axis of a factor that moves by one variable, or against it, and the variable.
fn axis(machine: &RealMachine, factor: &Factor) -> Option<([f64; 3], Symbol)> {
    let (axis, amount) = match factor {
        Factor::Elementary(Elementary { axis, amount, .. }) => (Pose::IDENTITY.0[*axis], amount),
        Factor::About { axis, amount, .. } => (*axis, amount),
        Factor::Matrix(_) => return None,
    };
    machine.affine(amount)?.1.map(|(symbol, sign)| (axis.map(|x| sign * x), symbol))
}

/// Returns the table of a loop; `None` for a length that is more than a constant and a variable.
fn table(machine: &RealMachine, closed: &Loop) -> Option<String> {
    let spec = &machine.spec;
    let link = |frame| quoted(&link_name(machine, frame));
    let [first, second] = closed.frames;
    let mut text = format!("\n[[loop]]\nname = {}\n", quoted(&closed.name));
    text += &format!("links = [{}, {}]\n", link(first), link(second));
    match &closed.closure {
        Closure::Coordinates(coordinates) => {
            let names: Vec<&str> = coordinates.iter().map(|i| Closure::COORDINATES[*i]).collect();
            let axes = link(second.and_then(|second| spec.frames[second].parent));
            text += &format!("closes = {names:?}\naxes = {axes}\n");
        }
        Closure::Distance(length) => {
            let (length, own) = machine.affine(length)?;
            let metres = spec.length.in_metres();
            text += &format!("closes = \"distance\"\nlength = {:?}\n", length * metres);
            if let Some((Symbol::Variable(i), sign)) = own {
                let limits = spec.variables[i].limits.map(|limit| limit * metres);
                let joint = quoted(&spec.variables[i].name);
                text += &format!("joint = {joint}\nfactor = {sign:?}\nlimits = {limits:?}\n");
            }
        }
    }
    Some(text)
}
