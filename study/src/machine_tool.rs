//! Spec of a machine tool from the order of its axes, such as `[w C' X' b Y Z (C1) t]`: from the
//! workpiece over the bed to the tool, axes that carry the workpiece with a prime (ISO 10791-6),
//! the errors with the letters of ISO 230-1.

use std::fmt::Write;

use abbe_spec::{mistake, option::AXES};

use crate::Result;

/// Order of the axes without another one.
const USUAL: &str = "w X' Y' b Z t";

/// Travel of an invented linear axis, in mm.
const TRAVEL: f64 = 500.0;

/// An axis: its letter, and whether it carries the workpiece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Axis {
    letter: char,
    is_primed: bool,
}

impl Axis {
    /// Returns the direction, 0 = X, and whether the axis is rotary.
    fn direction(self) -> (usize, bool) {
        let place = "XYZUVWABC".find(self.letter).unwrap_or_default();
        (place % 3, place >= 6)
    }

    fn name(self) -> String {
        format!("{}{}", self.letter, if self.is_primed { "'" } else { "" })
    }
}

/// Reads the axes: those before the bed, and those after it.
fn read(code: &str) -> Result<[Vec<Axis>; 2]> {
    let refused = |message: String, help: &str| Err(mistake::with_help(AXES, message, help));
    let inner = code.trim().trim_start_matches(['V', 'v']).trim_matches(['[', ']', ' ']);
    let words: Vec<&str> = inner.split_whitespace().collect();
    let form = format!("write the axes from workpiece to tool: `{USUAL}`");
    let [first, middle @ .., last] = &words[..] else {
        return refused("there are no axes".to_owned(), &form);
    };
    let beds = middle.iter().filter(|word| **word == "b").count();
    if *first != "w" || *last != "t" || beds != 1 {
        return refused("the order begins with `w`, ends with `t`, and has one bed `b`".to_owned(), &form);
    }
    let mut sides = [Vec::new(), Vec::new()];
    let mut side = 0;
    // A spindle, in parentheses, only turns.
    for word in middle.iter().filter(|word| !word.starts_with('(')) {
        if *word == "b" {
            side = 1;
            continue;
        }
        let bare = word.trim_end_matches(['\'', '\u{2032}', '\u{2019}']);
        let known = bare.len() == 1 && "XYZUVWABC".contains(bare);
        let axis = Axis { letter: bare.chars().next().unwrap_or('?'), is_primed: bare.len() < word.len() };
        if !known {
            let help = "linear axes are X Y Z U V W, rotary ones A B C; a spindle is in parentheses: (C)";
            return refused(format!("unknown axis `{}`", word.escape_debug()), help);
        }
        if sides.iter().flatten().any(|other: &Axis| other.letter == axis.letter) {
            return refused(format!("the axis {} is there twice", axis.letter), &form);
        }
        if axis.is_primed != (side == 0) {
            let help = "axes between `w` and `b` carry the workpiece and have a prime, X'; those after `b` have none";
            return refused(format!("the axis {} is on the wrong side of the bed", axis.name()), help);
        }
        sides[side].push(axis);
    }
    if sides.iter().all(Vec::is_empty) { refused("there are no axes".to_owned(), &form) } else { Ok(sides) }
}

/// Returns the template with these axes, by default three.
///
/// # Errors
///
/// The order of the axes cannot be read.
pub(crate) fn text(code: Option<&str>) -> Result<String> {
    let [carrying, carried] = read(code.unwrap_or(USUAL))?;
    let names = |axes: &[Axis]| axes.iter().map(|axis| format!("{} ", axis.name())).collect::<String>();
    let code = format!("[w {}b {}t]", names(&carrying), names(&carried));
    let all: Vec<Axis> = carrying.iter().chain(&carried).copied().collect();
    let (rotary, linear): (Vec<Axis>, Vec<Axis>) = all.iter().partition(|axis| axis.direction().1);
    // Rotary axes do not meet, so that the place of each is its own.
    let offset =
        |axis: &Axis| if rotary.get(1) == Some(axis) { "Tx(20 mm) Ty(20 mm) Tz(-80 mm) " } else { "" };
    let frames = |axes: &[Axis]| axes.iter().map(|axis| frame(*axis, offset(axis))).collect::<String>();
    let to_middle = |axis: &Axis| format!("T{}({})", XYZ[axis.direction().0], -TRAVEL / 2.0);
    let middle: Vec<String> = linear.iter().map(to_middle).collect();
    let (mut errors, mut places) = (String::new(), squarenesses(&linear));
    all.iter().for_each(|axis| motion_errors(&mut errors, *axis));
    rotary.iter().for_each(|axis| location_errors(&mut places, *axis));
    let parts = [
        ("CODE", code),
        ("CARRYING", frames(&carrying)),
        ("CARRIED", frames(&carried)),
        ("MIDDLE", middle.join(" ")),
        ("ERRORS", errors),
        ("PLACES", places),
    ];
    let text = include_str!("../templates/machine-tool.toml").to_owned();
    let text = parts.iter().fold(text, |text, (name, part)| text.replace(name, part));
    Ok(text.trim_end().to_owned() + "\n")
}

const XYZ: [char; 3] = ['x', 'y', 'z'];

/// Letters of errors by ISO 230-1, and their keys.
const ERRORS: [(char, &str); 6] =
    [('X', "e_x"), ('Y', "e_y"), ('Z', "e_z"), ('A', "e_p"), ('B', "e_s"), ('C', "e_r")];

/// Returns the frame of an axis, with an `offset` before its motion.
fn frame(axis: Axis, offset: &str) -> String {
    let ((direction, is_rotary), variable) = (axis.direction(), axis.letter.to_ascii_lowercase());
    let (kind, motion, limits) = match (is_rotary, axis.letter) {
        (false, _) => ("prismatic", 'T', "\"0 mm\", \"500 mm\"], home = \"250 mm\""),
        (true, 'C') => ("revolute", 'R', "\"-180 deg\", \"180 deg\"]"),
        (true, _) => ("revolute", 'R', "\"-110 deg\", \"110 deg\"]"),
    };
    format!(
        "[[frame]]\nname = \"{}\"\nvariable = {{ name = \"{variable}\", kind = \"{kind}\", limits = [{limits} }}\n\
         transform = \"{offset}{motion}{}({variable})\"\n\n",
        axis.name(),
        XYZ[direction],
    )
}

fn source(text: &mut String, name: &str, class: &str, axis: Axis, (key, error): (&str, &str), at: &str) {
    let _ = write!(
        text,
        "[[source]]\nname = \"{name}\"\nclass = \"{class}\"\nframe = \"{}\"\n{at}{key} = \"{error}\"\n\n",
        axis.name()
    );
}

/// Writes the six errors of the motion of an axis, and the random one of its scale.
fn motion_errors(text: &mut String, axis: Axis) {
    let ((direction, is_rotary), variable) = (axis.direction(), axis.letter.to_ascii_lowercase());
    for (i, (letter, key)) in ERRORS.into_iter().enumerate() {
        let (is_turn, is_along) = (i >= 3, i % 3 == direction);
        let error = match (is_rotary, is_turn, is_along) {
            (false, false, true) => format!("8 um * {variable}/({TRAVEL} mm)"),
            (false, false, false) => format!("3 um * sin(pi*{variable}/({TRAVEL} mm))"),
            (false, true, _) => format!("10e-6 * {variable}/({TRAVEL} mm)"),
            (true, false, true) => format!("1 um * cos(2*{variable})"),
            (true, false, false) => format!("2 um * sin({variable})"),
            (true, true, true) => format!("15e-6 * sin({variable})"),
            (true, true, false) => format!("5e-6 * cos({variable})"),
        };
        source(text, &format!("E{letter}{}", axis.letter), "repeatable", axis, (key, &error), "");
    }
    let error = if is_rotary { "1 arcsec" } else { "0.5 um" };
    let _ = write!(
        text,
        "[[source]]\nname = \"scale of {}\"\nclass = \"random\"\ndistribution = \"uniform\"\njoint = \"{variable}\"\n\
         error = \"{error}\"\n\n",
        axis.letter
    );
}

/// Returns the squarenesses of the linear axes: each turns the path of an axis, not its carriage.
fn squarenesses(linear: &[Axis]) -> String {
    let mut text = String::new();
    let find = |letter: char| linear.iter().find(|axis| axis.letter == letter);
    for (name, one, other, key, error) in [
        ("EC0Y", 'Y', 'X', "e_x", "-20e-6 * y"),
        ("EB0Z", 'Z', 'X', "e_x", "20e-6 * z"),
        ("EA0Z", 'Z', 'Y', "e_y", "-20e-6 * z"),
    ] {
        if let (Some(axis), Some(_)) = (find(one), find(other)) {
            source(&mut text, name, "tolerance", *axis, (key, error), "");
        }
    }
    text
}

/// Writes the place and direction of a rotary axis, in axes that do not turn with it: those of the
/// frame if it carries the workpiece, otherwise those before it.
fn location_errors(text: &mut String, axis: Axis) {
    let (direction, _) = axis.direction();
    let at = match axis.is_primed {
        true => String::new(),
        false => format!("at = \"R{}(-{})\"\n", XYZ[direction], axis.letter.to_ascii_lowercase()),
    };
    for (i, (letter, key)) in ERRORS.into_iter().enumerate().filter(|(i, _)| i % 3 != direction) {
        let error = if i < 3 { "10 um" } else { "20e-6" };
        source(text, &format!("E{letter}0{}", axis.letter), "tolerance", axis, (key, error), &at);
    }
}
