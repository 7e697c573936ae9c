//! Keys of a frame that say where it stands: `origin` and `axis`, `dh`, `mdh` or `transform`.
//!
//! Numbers and angles as a spec has them.

use std::f64::consts::FRAC_PI_4;

use abbe_spec::{DhConvention, edit::write::quoted};

use crate::import::chain::{Chain, DhRow, Frame, Geometry, Motion, Variable};
use crate::placement::Placement;

/// Writes the transform of a frame: as URDF or Denavit-Hartenberg numbers, or as a product.
///
/// `own` is set if the frame declares the variable. A product stands for a joint that follows the
/// variable of another joint, or its own with a multiplier or an offset.
pub(super) fn transform(chain: &Chain, frame: &Frame, own: bool) -> String {
    let Frame { geometry, motion, .. } = frame;
    let placement = match geometry {
        Geometry::Origin(placement) => placement,
        Geometry::DenavitHartenberg(row) => return dh_row(chain, row, motion.as_ref()),
    };
    match motion {
        None => format!("origin = {}\n", origin(placement)),
        Some(Motion { axis, multiplier: 1.0, offset: 0.0, prismatic, variable, .. })
            if own && *prismatic == chain.variables[*variable].prismatic =>
        {
            let axis = match axis {
                [1.0, 0.0, 0.0] => String::new(),
                axis => format!("axis = {}\n", three(axis)),
            };
            format!("origin = {}\n{axis}", origin(placement))
        }
        Some(motion) => {
            let factors =
                placement_factors(placement) + &motion_factors(motion, &chain.variables[motion.variable]);
            format!("transform = {}\n", quoted(factors.trim_end()))
        }
    }
}

/// Writes a placement as the inline table of `origin`.
pub(super) fn origin(placement: &Placement) -> String {
    match placement.rpy {
        [0.0, 0.0, 0.0] => format!("{{ xyz = {} }}", three(&placement.xyz)),
        rpy => {
            let [roll, pitch, yaw] = rpy.map(|amount| quoted_if_expression(&angle(amount, false)));
            format!("{{ xyz = {}, rpy = [{roll}, {pitch}, {yaw}] }}", three(&placement.xyz))
        }
    }
}

/// Writes the four numbers of a row; the variable is part of `theta` or `d`.
fn dh_row(chain: &Chain, row: &DhRow, motion: Option<&Motion>) -> String {
    let DhRow { convention, theta, d, a, alpha } = *row;
    let degrees = chain.degrees;
    let moving = |prismatic: bool| {
        let motion = motion.filter(|motion| motion.prismatic == prismatic)?;
        let Motion { variable, multiplier, with, offset, .. } = motion;
        let name = &chain.variables[*variable].name;
        let sign = if *multiplier < 0.0 { "-" } else { "" };
        let offset = match (*offset, prismatic) {
            (0.0, _) => String::new(),
            (offset, true) => signed(&format!("{} {}", number(offset), chain.length.symbol())),
            (offset, false) => signed(&angle(offset, degrees)),
        };
        let with = with.map_or(String::new(), |(other, sign)| {
            signed(&format!("{}{}", if sign < 0.0 { "-" } else { "" }, chain.variables[other].name))
        });
        Some(quoted(&format!("{sign}{name}{with}{offset}")))
    };
    let theta = moving(false).unwrap_or_else(|| quoted_if_expression(&angle(theta, degrees)));
    let d = moving(true).unwrap_or_else(|| number(d));
    let key = match convention {
        DhConvention::Standard => "dh",
        DhConvention::Modified => "mdh",
    };
    let alpha = quoted_if_expression(&angle(alpha, degrees));
    format!("{key} = {{ theta = {theta}, d = {d}, a = {}, alpha = {alpha} }}\n", number(a))
}

/// Writes ` + amount`, or ` - amount` for a negative one.
fn signed(amount: &str) -> String {
    amount.strip_prefix('-').map_or_else(|| format!(" + {amount}"), |amount| format!(" - {amount}"))
}

/// Writes a placement as factors; those that are the identity are left out.
fn placement_factors(placement: &Placement) -> String {
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

/// Writes the motion of a joint as factors.
///
/// For a rotation about a general axis the frame is turned until the axis is z, moved, and turned
/// back.
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

/// Writes `multiplier · q + offset`, as a length or an angle.
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

/// Returns a bare number as it is, and an expression in quotes.
pub(super) fn quoted_if_expression(text: &str) -> String {
    if text.parse::<f64>().is_ok() { text.to_owned() } else { quoted(text) }
}

/// Returns an array of three numbers.
pub(super) fn three(numbers: &[f64; 3]) -> String {
    let [x, y, z] = numbers.map(number);
    format!("[{x}, {y}, {z}]")
}

/// Writes an angle in rad.
///
/// The nearest number to a multiple of 45° becomes that multiple of pi, whose sine and cosine are
/// exact. With `degrees` set, other angles are in degrees where a number of at most nine decimals
/// gives the same angle.
pub(super) fn angle(value: f64, degrees: bool) -> String {
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

/// Writes the shortest number that reads back as the same `f64`.
pub(super) fn number(value: f64) -> String {
    let value = value + 0.0;
    if value == 0.0 || (1e-4..1e15).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}
