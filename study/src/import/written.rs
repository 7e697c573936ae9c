//! A chain as the text of a spec.

use std::f64::consts::FRAC_PI_4;
use std::fmt::Write;

use abbe_spec::{DhConvention, as_identifier};

use super::chain::{Chain, Frame, Mass, Motion, Variable};
use super::geometry::{Geometry, Numbers};
use super::placement::Placement;
use crate::toml_text::quoted;

/// The spec of a chain; `origin` is the file that it comes from.
pub(super) fn spec(chain: &Chain, origin: &str) -> String {
    let Chain { robot, tip, frames, tool, masses, .. } = chain;
    let mut text = format!(
        "[manipulator]\nname = {}\ntitle = {}\ndescription = {}\nlength = {}\n",
        quoted(&as_identifier(robot)),
        quoted(robot),
        quoted(&format!("{}, imported from {origin}", chain.origin)),
        quoted(chain.length.symbol()),
    );
    if !masses.is_empty() {
        text += "gravity = [0, 0, \"-9.80665 m/s^2\"]         # where z of the base points up\n";
    }
    let mut own = vec![false; chain.variables.len()];
    for (i, frame) in frames.iter().enumerate() {
        text += "\n[[frame]]\n";
        line(&mut text, "name", &quoted(&frame.joint));
        if let Some(link) = &frame.link {
            line(&mut text, "description", &quoted(&format!("Link {link}")));
        }
        let owned = frame.motion.filter(|motion| !own[motion.variable] && chain.owner(motion.variable) == i);
        if let Some(motion) = owned {
            own[motion.variable] = true;
            let variable = &chain.variables[motion.variable];
            let endless = if variable.continuous { "       # turns without end" } else { "" };
            line(&mut text, "variable", &(self::variable(variable, chain.degrees) + endless));
        }
        text += &transform(chain, frame, owned.is_some());
    }
    if *tool != Placement::default() {
        let _ = write!(text, "\n[tool]\n");
        if frames.iter().any(|frame| frame.link.is_some()) {
            line(&mut text, "description", &quoted(&format!("Link {tip}")));
        }
        line(&mut text, "origin", &placed(tool));
    }
    for Mass { link, kilograms, frame, centre } in masses {
        text += "\n[[load]]\n";
        line(&mut text, "name", &quoted(link));
        line(&mut text, "mass", &quoted(&format!("{} kg", number(*kilograms))));
        line(&mut text, "frame", &quoted(&frames[*frame].joint));
        line(&mut text, "point", &three(centre));
    }
    text
}

impl Chain {
    /// The frame that a variable belongs to: that of its joint, or the first that follows it.
    fn owner(&self, variable: usize) -> usize {
        let joint = &self.variables[variable].joint;
        let moved = |frame: &Frame| frame.motion.is_some_and(|motion| motion.variable == variable);
        let frames = || self.frames.iter().enumerate().filter(|(_, frame)| moved(frame));
        let at_joint = frames().find(|(_, frame)| frame.joint == *joint);
        at_joint.or_else(|| frames().next()).map_or(0, |(i, _)| i)
    }
}

fn line(text: &mut String, key: &str, value: &str) {
    let _ = writeln!(text, "{key} = {value}");
}

fn variable(variable: &Variable, degrees: bool) -> String {
    let Variable { name, prismatic, limits, continuous, .. } = variable;
    let kind = if *prismatic { "prismatic" } else { "revolute" };
    let limits = match limits {
        _ if *continuous => ", limits = [\"-pi\", \"pi\"]".to_owned(),
        None => String::new(),
        Some([lower, upper]) => {
            let value = |value: f64| match degrees && !prismatic {
                true => quoted_if_text(&angle(value, true)),
                false => number(value),
            };
            let home = match *lower > 0.0 || *upper < 0.0 {
                true => format!(", home = {}", value(0.5 * (lower + upper))),
                false => String::new(),
            };
            format!(", limits = [{}, {}]{home}", value(*lower), value(*upper))
        }
    };
    format!("{{ name = {}, kind = \"{kind}\"{limits} }}", quoted(name))
}

/// A bare number, or an expression in quotes.
fn quoted_if_text(text: &str) -> String {
    if text.parse::<f64>().is_ok() { text.to_owned() } else { quoted(text) }
}

/// The four numbers of a row, what moves among them.
fn numbers(chain: &Chain, numbers: &Numbers, motion: Option<&Motion>) -> String {
    let Numbers { convention, theta, d, a, alpha } = *numbers;
    let degrees = chain.degrees;
    let moved = |prismatic: bool| {
        let motion = motion.filter(|motion| motion.prismatic == prismatic)?;
        let Motion { variable, multiplier, offset, .. } = motion;
        let name = &chain.variables[*variable].name;
        let sign = if *multiplier < 0.0 { "-" } else { "" };
        let offset = match (*offset, prismatic) {
            (0.0, _) => String::new(),
            (offset, true) => signed(&format!("{} {}", number(offset), chain.length.symbol())),
            (offset, false) => signed(&angle(offset, degrees)),
        };
        Some(quoted(&format!("{sign}{name}{offset}")))
    };
    let theta = moved(false).unwrap_or_else(|| quoted_if_text(&angle(theta, degrees)));
    let d = moved(true).unwrap_or_else(|| number(d));
    let key = match convention {
        DhConvention::Standard => "dh",
        DhConvention::Modified => "mdh",
    };
    let alpha = quoted_if_text(&angle(alpha, degrees));
    format!("{key} = {{ theta = {theta}, d = {d}, a = {}, alpha = {alpha} }}\n", number(a))
}

/// What is added to a name.
fn signed(amount: &str) -> String {
    amount.strip_prefix('-').map_or_else(|| format!(" + {amount}"), |amount| format!(" - {amount}"))
}

/// As URDF has it; a joint that follows another, or itself in another way, as a product.
fn transform(chain: &Chain, frame: &Frame, own: bool) -> String {
    let Frame { geometry, motion, .. } = frame;
    let placement = match geometry {
        Geometry::Origin(placement) => placement,
        Geometry::Numbers(of_row) => return numbers(chain, of_row, motion.as_ref()),
    };
    match motion {
        None => format!("origin = {}\n", placed(placement)),
        Some(Motion { axis, multiplier: 1.0, offset: 0.0, prismatic, variable })
            if own && *prismatic == chain.variables[*variable].prismatic =>
        {
            let axis = match axis {
                [1.0, 0.0, 0.0] => String::new(),
                axis => format!("axis = {}\n", three(axis)),
            };
            format!("origin = {}\n{axis}", placed(placement))
        }
        Some(motion) => {
            let factors =
                place_factors(placement) + &motion_factors(motion, &chain.variables[motion.variable]);
            format!("transform = {}\n", quoted(factors.trim_end()))
        }
    }
}

fn place_factors(placement: &Placement) -> String {
    let ([x, y, z], [roll, pitch, yaw]) = (placement.xyz, placement.rpy);
    let factors = [("Tx", x), ("Ty", y), ("Tz", z), ("Rz", yaw), ("Ry", pitch), ("Rx", roll)];
    factors
        .iter()
        .filter(|(_, amount)| *amount != 0.0)
        .map(|(name, amount)| factor(name, &angle(*amount, false)))
        .collect()
}

fn factor(name: &str, amount: &str) -> String {
    format!("{name}({amount}) ")
}

/// About an axis of its own: the frame is turned until it is z, moved, and turned back.
fn motion_factors(motion: &Motion, variable: &Variable) -> String {
    let Motion { prismatic, axis: [x, y, z], .. } = *motion;
    let amount = amount(motion, variable);
    if prismatic {
        let along = [("Tx", x), ("Ty", y), ("Tz", z)];
        let shares = along.iter().filter(|(_, share)| *share != 0.0);
        return shares.map(|(name, share)| factor(name, &scaled(*share, &amount))).collect();
    }
    let principal = match [x, y, z] {
        [x, 0.0, 0.0] => Some(("Rx", x)),
        [0.0, y, 0.0] => Some(("Ry", y)),
        [0.0, 0.0, z] => Some(("Rz", z)),
        _ => None,
    };
    if let Some((name, share)) = principal {
        return factor(name, &scaled(share, &amount));
    }
    // Rz(azimuth) Ry(inclination) takes z to the axis.
    let (azimuth, inclination) = (number(y.atan2(x)), number(x.hypot(y).atan2(z)));
    format!("Rz({azimuth}) Ry({inclination}) Rz({amount}) Ry(-({inclination})) Rz(-({azimuth})) ")
}

fn scaled(share: f64, amount: &str) -> String {
    match share {
        1.0 => amount.to_owned(),
        -1.0 => format!("-({amount})"),
        share => format!("{}*({amount})", number(share)),
    }
}

/// `multiplier · q + offset`, a length or an angle as the motion is one.
fn amount(motion: &Motion, variable: &Variable) -> String {
    let Motion { prismatic, multiplier, offset, .. } = *motion;
    let name = &variable.name;
    let product = match (variable.prismatic, prismatic) {
        (false, true) => format!("{} m * {name}", number(multiplier)),
        (true, false) => format!("{}/m * {name}", number(multiplier)),
        _ if multiplier == 1.0 => name.clone(),
        _ => format!("{}*{name}", number(multiplier)),
    };
    match (offset, prismatic) {
        (0.0, _) => product,
        (_, true) => format!("{product} + {} m", number(offset)),
        (_, false) => format!("{product} + {}", number(offset)),
    }
}

fn placed(placement: &Placement) -> String {
    match placement.rpy {
        [0.0, 0.0, 0.0] => format!("{{ xyz = {} }}", three(&placement.xyz)),
        rpy => {
            let [roll, pitch, yaw] = rpy.map(|amount| quoted_if_text(&angle(amount, false)));
            format!("{{ xyz = {}, rpy = [{roll}, {pitch}, {yaw}] }}", three(&placement.xyz))
        }
    }
}

fn three(numbers: &[f64; 3]) -> String {
    let [x, y, z] = numbers.map(number);
    format!("[{x}, {y}, {z}]")
}

/// An angle that is the nearest number to a multiple of 45° is that multiple: its sines are exact then. Others are in degrees
/// where that is asked for and a short number gives the same angle.
fn angle(value: f64, degrees: bool) -> String {
    let eighths = (value / FRAC_PI_4).round();
    if value == 0.0 {
        return "0".to_owned();
    }
    if eighths.abs() > 8.0 || eighths * FRAC_PI_4 != value {
        let short = (value.to_degrees() * 1e9).round() / 1e9;
        return match degrees && short.to_radians() == value {
            true => format!("{} deg", number(short)),
            false => number(value),
        };
    }
    let sign = if value < 0.0 { "-" } else { "" };
    let (count, parts) = match eighths.abs() as u32 {
        8 => (2, 1),
        4 => (1, 1),
        2 => (1, 2),
        6 => (3, 2),
        odd => (odd, 4),
    };
    let count = if count == 1 { String::new() } else { format!("{count}*") };
    let parts = if parts == 1 { String::new() } else { format!("/{parts}") };
    format!("{sign}{count}pi{parts}")
}

/// The shortest number that reads back as the same one.
fn number(value: f64) -> String {
    let value = value + 0.0;
    if value == 0.0 || (1e-4..1e15).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}
