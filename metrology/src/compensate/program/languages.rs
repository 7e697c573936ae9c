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

    /// Compiles the patterns of poses, joints, elsewhere, relative positions and frames.
    pub(super) fn patterns(&self) -> Option<[Regex; 5]> {
        const NUMBER: &str = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)";
        let compiled = |text: &str| Regex::new(&text.replace(' ', r"\s*").replace('#', NUMBER)).ok();
        let all = [self.pose, self.joints, self.elsewhere, self.relative, self.frame].map(compiled);
        all.into_iter().collect::<Option<Vec<Regex>>>()?.try_into().ok()
    }
}
