//! Languages of robot programs: how they write positions and joints.

use regex_lite::Regex;

use crate::data::{Column, Order, Turn};

/// Language of robot programs.
///
/// In patterns `#` is a number, and a blank is white space or nothing.
pub(super) struct Language {
    /// Name, with the maker of the controllers.
    pub(super) name: &'static str,
    /// Endings of the names of files.
    endings: &'static [&'static str],
    /// Beginnings of a line, one of which such a file has; nothing if its ending is enough.
    begins: &'static [&'static str],
    /// Beginning of a comment.
    pub(super) comment: &'static str,
    /// Pattern of the position and orientation of the tool.
    pose: &'static str,
    /// Pattern of the configuration of a position, which follows it; a controller of FANUC has it
    /// before.
    configuration: &'static str,
    /// Facts that the groups of that pattern state.
    pub(super) facts: fn(&[&str]) -> Vec<Fact>,
    /// The groups of that pattern as facts have them; nothing for one that stays.
    pub(super) restated: fn(&[Fact]) -> Vec<Option<String>>,
    /// Pattern of a joint target.
    joints: &'static str,
    /// Pattern of what makes later positions of a statement frames, tools or steps.
    elsewhere: &'static str,
    /// Pattern of positions that are relative or incomplete.
    relative: &'static str,
    /// Pattern of a statement that sets the frame of positions.
    frame: &'static str,
    /// Orientation.
    pub(super) rotation: Rotation,
    /// Unit of lengths in m.
    pub(super) metres: f64,
    /// Unit of angles in rad.
    pub(super) radians: f64,
    /// First letter of the names of joints.
    pub(super) joint: char,
}

/// Numbers of an orientation.
#[derive(Clone, Copy)]
pub(super) enum Rotation {
    /// A quaternion, the scalar first.
    Quaternion,
    /// A rotation vector.
    Vector,
    /// Angles about these axes (0 = x), in the order of the product.
    Euler([usize; 3]),
    /// Angles about these axes, the last one of the product first.
    Fixed([usize; 3]),
}

/// Fact of a configuration: of several joint positions for a position, it holds for some. Joints
/// count as the controller does, from 0.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Fact {
    /// The angle of a joint in quarter turns, rounded down; whole turns do not matter.
    Quadrant(usize, i32),
    /// The angle of a joint is negative.
    Negative(usize, bool),
    /// The center of the wrist is on the other side of axis 1 than where all joints are 0.
    Behind(bool),
    /// The center of the wrist is on the other side of the lower arm than where all joints are 0.
    Below(bool),
    /// Axis 3 is turned in its positive direction from where the arm is stretched.
    Bent(bool),
}

impl Fact {
    /// Returns whether a fact of an angle holds within `border`; both are in degrees.
    pub(super) fn holds(&self, angle: f64, border: f64) -> bool {
        match *self {
            Self::Quadrant(_, quarters) => [-border, border].iter().any(|by| {
                let difference = ((angle + by) / 90.0).floor() - f64::from(quarters);
                difference.rem_euclid(4.0) == 0.0
            }),
            Self::Negative(_, is) => angle.abs() < border || (angle < 0.0) == is,
            Self::Behind(_) | Self::Below(_) | Self::Bent(_) => true,
        }
    }

    /// Returns the fact with other joints, where it held before; angles are in degrees.
    pub(super) fn beyond(
        self,
        before: impl Fn(usize) -> Option<f64>,
        after: impl Fn(usize) -> Option<f64>,
    ) -> Self {
        let (Self::Quadrant(joint, _) | Self::Negative(joint, _)) = self else { return self };
        let (Some(before), Some(after)) = (before(joint), after(joint)) else { return self };
        if !self.holds(before, BORDER) || self.holds(after, ROUNDING) {
            return self;
        }
        match self {
            // Whole turns are counted as before: the nearest number that stands for this quarter.
            Self::Quadrant(_, quarters) => {
                let apart = ((after / 90.0).floor() as i32 - quarters).rem_euclid(4);
                Self::Quadrant(joint, quarters + if apart == 3 { -1 } else { apart })
            }
            _ => Self::Negative(joint, after < 0.0),
        }
    }

    /// Returns whether the fact is a yes.
    fn is_set(&self) -> bool {
        matches!(self, Self::Negative(_, true) | Self::Behind(true) | Self::Below(true))
    }
}

/// Difference in degrees within which joints agree with a configuration.
pub(super) const BORDER: f64 = 1e-3;
/// Difference in degrees within which corrected joints have not left a configuration.
const ROUNDING: f64 = 1e-5;

/// Pattern of nothing.
const NEVER: &str = r"\z.";

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// All languages.
pub(super) const LANGUAGES: [Language; 5] = [
    Language {
        name: "RAPID (ABB)",
        endings: &["mod", "modx", "prg", "sys"],
        begins: &["MODULE "],
        comment: "!",
        // robtarget: trans, rot, robconf, extax. A wobjdata or tooldata has no list after rot.
        pose: r"\[ \[ # , # , # \] , \[ # , # , # , # \] , \[",
        // cf1, cf4, cf6: quarter turns of axes 1, 4, 6. cfx: 4 behind axis 1, 2 behind the lower
        // arm, 1 axis 5 < 0.
        configuration: r"^ # , # , # , # \]",
        facts: |groups| {
            let [cf1, cf4, cf6, cfx] = [0, 1, 2, 3].map(|i| groups[i].parse().unwrap_or(0));
            let quadrants = [(0, cf1), (3, cf4), (5, cf6)].map(|(joint, cf)| Fact::Quadrant(joint, cf));
            let sides =
                [Fact::Behind(cfx & 4 != 0), Fact::Below(cfx & 2 != 0), Fact::Negative(4, cfx & 1 != 0)];
            [quadrants, sides].concat()
        },
        restated: |facts| {
            let quarters = facts.iter().filter_map(|fact| match fact {
                Fact::Quadrant(_, quarters) => Some(quarters.to_string()),
                _ => None,
            });
            let cfx = facts.iter().fold(0, |bits, fact| 2 * bits + u32::from(fact.is_set()));
            quarters.chain([cfx.to_string()]).map(Some).collect()
        },
        // jointtarget: robax, extax.
        joints: r"\[ \[ # , # , # , # , # , # \] , \[",
        elsewhere: NEVER,
        relative: r"\b(?:Offs|RelTool|PDispSet|PDispOn)\b",
        frame: r"(?i)\\WObj := (?:[a-vx-z]|w[a-np-z]|wobj[1-9a-z_]|wobj0\w)",
        rotation: Rotation::Quaternion,
        metres: 1e-3,
        radians: DEGREE,
        joint: 'J',
    },
    Language {
        name: "KRL (KUKA)",
        endings: &["src", "dat"],
        begins: &["DEF ", "DEFDAT ", "DEFFCT ", "GLOBAL DEF"],
        comment: ";",
        pose: r"(?i)\{ (?:\w+ : )?X # , Y # , Z # , A # , B # , C #",
        // Status: bit 0 is set behind axis 1, bit 1 if axis 3 is beyond the stretched arm. Turn:
        // bit i, if axis i + 1 is negative.
        configuration: r"^(?i) , S (\d+|'B[01]+') , T (\d+|'B[01]+')",
        facts: |groups| {
            let bits = |text: &str| {
                let number = text.trim_matches('\'');
                let bits = number.strip_prefix(['B', 'b']).map(|bits| u32::from_str_radix(bits, 2));
                bits.unwrap_or_else(|| number.parse()).unwrap_or(0)
            };
            let (status, turn) = (bits(groups[0]), bits(groups[1]));
            let signs = (0..6).map(|i| Fact::Negative(i, turn >> i & 1 != 0));
            signs.chain([Fact::Behind(status & 1 != 0), Fact::Bent(status & 2 != 0)]).collect()
        },
        restated: |facts| {
            let turn = facts[..6].iter().rev().fold(0, |bits, fact| 2 * bits + u32::from(fact.is_set()));
            vec![None, Some(turn.to_string())]
        },
        joints: r"(?i)\{ (?:\w+ : )?A1 # , A2 # , A3 # , A4 # , A5 # , A6 #",
        // Frames, tools and loads have the same keys.
        elsewhere: r"(?i)\$\w+|BASE_DATA|TOOL_DATA|LOAD|\bFRAME\b|_REL\b| : $",
        relative: r"(?i)_REL\b|\w : \{|\{ (?:[XYZABC]|A[1-6])\s+#",
        frame: r"(?i)\$BASE = (?:\{[^}]*[1-9]|[A-Z])|\bBASE_NO [1-9]",
        rotation: Rotation::Euler([2, 1, 0]),
        metres: 1e-3,
        radians: DEGREE,
        joint: 'A',
    },
    Language {
        name: "TP (FANUC)",
        endings: &["ls"],
        begins: &["/POS"],
        comment: "//",
        pose: r"X = # mm , Y = # mm , Z = # mm , W = # deg , P = # deg , R = # deg",
        // Wrist: N and F differ by robot. Arm: up or down, toward or back.
        configuration: r"CONFIG : '[NF] ([UD]) ([TB])",
        restated: |_| Vec::new(),
        facts: |groups| vec![Fact::Below(groups[0] == "D"), Fact::Behind(groups[1] == "B")],
        joints: r"J1 = # deg , J2 = # deg , J3 = # deg , J4 = # deg , J5 = # deg , J6 = # deg",
        elsewhere: NEVER,
        relative: r"\b(?:Offset|Tool_Offset|INC|PR\[)",
        frame: r"\bUF : [1-9]",
        rotation: Rotation::Fixed([2, 1, 0]),
        metres: 1e-3,
        radians: DEGREE,
        joint: 'J',
    },
    Language {
        name: "URScript (Universal Robots)",
        endings: &["script", "urscript"],
        begins: &[],
        comment: "#",
        pose: r"\bp\[ # , # , # , # , # , # \]",
        configuration: NEVER,
        facts: |_| Vec::new(),
        restated: |_| Vec::new(),
        joints: r"(?:\b(?:move[jlcp]|servoj|get_forward_kin) \(|_q =) \[ # , # , # , # , # , # \]",
        elsewhere: r"(?i)\b(?:set_|force_mode|pose_|speed|wrench|interpolate)|tcp|plane|frame|feature|offset",
        relative: r"\bpose_(?:trans|add)\b",
        frame: r"(?i)plane|feature",
        rotation: Rotation::Vector,
        metres: 1.0,
        radians: 1.0,
        joint: 'J',
    },
    Language {
        name: "Mecademic",
        endings: &["mxprog"],
        begins: &[],
        comment: "//",
        pose: r"\bMove(?:Pose|Lin) \( # , # , # , # , # , # \)",
        configuration: NEVER,
        facts: |_| Vec::new(),
        restated: |_| Vec::new(),
        joints: r"\bMoveJoints \( # , # , # , # , # , # \)",
        elsewhere: NEVER,
        relative: r"\bMove\w*Rel",
        frame: r"\bSetWRF\b",
        rotation: Rotation::Euler([0, 1, 2]),
        metres: 1e-3,
        radians: DEGREE,
        joint: 'J',
    },
];

impl Language {
    /// Returns the language of files with this ending.
    pub(super) fn find(ending: &str) -> Option<&'static Self> {
        LANGUAGES.iter().find(|language| language.endings.iter().any(|one| ending.eq_ignore_ascii_case(one)))
    }

    /// Returns whether a text begins as a program does, in one of its lines.
    pub(super) fn has_begun(&self, text: &str) -> bool {
        let is_begun = |line: &str| {
            let line = line.trim_start().to_ascii_uppercase();
            self.begins.iter().any(|begin| line.starts_with(begin))
        };
        self.begins.is_empty() || text.lines().any(is_begun)
    }

    /// Returns whether the configuration of a position stands behind it.
    pub(super) fn is_configured_behind(&self) -> bool {
        self.configuration.starts_with('^')
    }

    /// Returns the orientation, as columns of a table have it.
    pub(super) fn turn(&self) -> Turn {
        match self.rotation {
            Rotation::Quaternion => Turn::Quaternion(Column::unnamed(), Order::Wxyz),
            Rotation::Vector => Turn::RotationVector(Column::unnamed(), self.radians),
            Rotation::Euler(axes) | Rotation::Fixed(axes) => {
                Turn::Euler(Column::unnamed(), axes, self.radians)
            }
        }
    }

    /// Puts the numbers of an orientation into the order of [`turn`](Self::turn), or back.
    pub(super) fn in_order(&self, numbers: &mut [f64]) {
        if matches!(self.rotation, Rotation::Fixed(_)) {
            numbers.reverse();
        }
    }

    /// Compiles the patterns of poses, joints, elsewhere, relative positions, frames and
    /// configurations.
    pub(super) fn patterns(&self) -> Option<[Regex; 6]> {
        const NUMBER: &str = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)";
        let compiled = |text: &str| Regex::new(&text.replace(' ', r"\s*").replace('#', NUMBER)).ok();
        let all = [self.pose, self.joints, self.elsewhere, self.relative, self.frame, self.configuration]
            .map(compiled);
        all.into_iter().collect::<Option<Vec<Regex>>>()?.try_into().ok()
    }
}

#[cfg(test)]
mod tests;
