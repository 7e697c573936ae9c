//! Random platforms on legs.

use std::fmt::Write;

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Passive joints of a platform, and the directions that it keeps.
pub struct Body {
    /// Passive joints, in the order of a seed.
    pub passive: &'static [&'static str],
    /// Number of legs.
    pub legs: usize,
    /// Rotation axes and then translations that the platform does not have.
    pub lacks: [&'static [usize]; 2],
}

/// Bodies in space, that keep an axis, their orientation, or a plane.
pub const BODIES: [Body; 4] = [
    Body { passive: &["Tx", "Ty", "Tz", "Rz", "Rx", "Ry"], legs: 6, lacks: [&[], &[]] },
    Body { passive: &["Tx", "Ty", "Tz", "Rz"], legs: 4, lacks: [&[0, 1], &[]] },
    Body { passive: &["Tx", "Ty", "Tz"], legs: 3, lacks: [&[0, 1, 2], &[]] },
    Body { passive: &["Tx", "Ty", "Rz"], legs: 3, lacks: [&[0, 1], &[2]] },
];

/// Writes a platform on legs that extend, or hang on slides or cranks, as a seed has it. Returns
/// the number of legs with two solutions as well.
#[must_use]
pub fn platform(body: &Body, seed: u64) -> (String, u32) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let is_plane = body.lacks[1].contains(&2);
    let height = if is_plane { 0.0 } else { 500.0 };
    let mut text = "[manipulator]\nname = \"platform\"\nlength = \"mm\"\n\
        [[frame]]\nname = \"foot\"\ntransform = \"Rx(0.3) Rz(0.2) Ry(-0.4) Tx(120)\"\n"
        .to_owned();
    let mut order = body.passive.to_vec();
    // The angles of a body that turns about three axes stay in their order.
    let shuffled = if order.len() == 6 { 3 } else { order.len() };
    for i in 1..shuffled {
        order.swap(i, random.random_range(0..=i));
    }
    for motion in &order {
        let kind = if motion.starts_with('T') { "prismatic" } else { "revolute" };
        let home = if *motion == "Tz" { height } else { 0.0 };
        let _ = write!(
            text,
            "[[frame]]\nname = \"{motion}\"\ntransform = \"{motion}(p{motion})\"\n\
             variable = {{ name = \"p{motion}\", kind = \"{kind}\", passive = true, home = {home:?} }}\n"
        );
    }
    let last = order[order.len() - 1];
    let mut branches = 0;
    for leg in 0..body.legs {
        let side = if leg % 2 == 0 { 1.0 } else { -1.0 };
        let at = match body.legs {
            6 => 120.0 * (leg / 2) as f64 + 15.0 * side,
            count => 360.0 * leg as f64 / count as f64,
        };
        let twist = if body.legs == 3 { 40.0 } else { -40.0 * side };
        let mut number = |size: f64| random.random_range(-size..size);
        let (a, b) = ((at + number(5.0)).to_radians(), (at + twist + number(5.0)).to_radians());
        let (outer, inner, arm, tilt) = (600.0 + number(50.0), 250.0 + number(50.0), 120.0, number(0.6));
        let above = if is_plane { 0.0 } else { number(30.0) };
        let drive = random.random_range(0..3);
        // Drives turn and move either way, and either end of a leg is named first.
        let sign = ["", "-"][random.random_range(0..2)];
        let ends = [format!("j{leg}"), format!("b{leg}")];
        let [first, second] = [0, 1].map(|i| &ends[(i + usize::from(sign == "-")) % 2]);
        let (kind, motion, reach) = match drive {
            0 => ("prismatic", String::new(), 0.0),
            1 => ("prismatic", format!("{}({sign}q{leg})", if is_plane { "Tx" } else { "Tz" }), 0.0),
            _ => ("revolute", format!("{}({sign}q{leg}) Tx({arm})", if is_plane { "Rz" } else { "Ry" }), arm),
        };
        let (x, y) = (outer + reach * tilt.cos(), reach * tilt.sin());
        let foot = [x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos(), 0.0];
        let joint = [inner * b.cos(), inner * b.sin(), height + above];
        let length = foot.iter().zip(joint).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let [lower, upper] = if kind == "revolute" { [-0.5, 0.6] } else { [-20.0, 30.0] };
        let variable =
            format!("variable = {{ name = \"q{leg}\", kind = \"{kind}\", limits = [{lower}, {upper}] }}\n");
        let [of_frame, of_leg, more] = if drive == 0 {
            ["", &*variable, &*format!(" {} q{leg}", if sign.is_empty() { '+' } else { '-' })]
        } else {
            branches += 1;
            [&*variable, "", ""]
        };
        let _ = write!(
            text,
            "[[frame]]\nname = \"b{leg}\"\nparent = \"foot\"\n{of_frame}\
             transform = \"Rz({a:?}) Tx({outer:?}) Rz({tilt:?}) {motion}\"\n\
             [[frame]]\nname = \"j{leg}\"\nparent = \"{last}\"\n\
             transform = \"Rz({b:?}) Tx({inner:?}) Tz({above:?})\"\n\
             [[loop]]\nname = \"leg {leg}\"\nframes = [\"{first}\", \"{second}\"]\ncloses = \"distance\"\n\
             length = \"{length:?} mm{more}\"\n{of_leg}"
        );
    }
    let _ = write!(text, "[tool]\nframe = \"{last}\"\ntransform = \"Rz(0.7) Tx(50) Tz(40)\"\n");
    (text, branches)
}
