//! What the columns of a table are.

use abbe::LengthUnit;
use abbe_spec::DhConvention;
use abbe_spec::diagnostic::{Diagnostic, Span};
use abbe_spec::document::Document;

use super::text::Text;

/// What a column says of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// What its joint is called.
    Name,
    /// Whether it turns or slides.
    Kind,
    Theta,
    D,
    A,
    Alpha,
    /// What is added to the variable.
    Offset,
    Lower,
    Upper,
    /// Which way the variable counts: 1 or −1.
    Sign,
    /// Where base or tool is.
    X,
    Y,
    Z,
    Roll,
    Pitch,
    Yaw,
}

impl Meaning {
    /// Of a name, if it is known.
    pub(super) fn of(name: &str) -> Option<Self> {
        Heading::of(name).map(|heading| heading.meaning)
    }
}

/// The unit that a heading names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Length(LengthUnit),
    Degree,
    Radian,
}

/// The name of a column, understood.
struct Heading {
    meaning: Meaning,
    unit: Option<Unit>,
    /// Whether it is a number of the link before, `a_{i-1}`: of the modified convention alone.
    is_before: bool,
}

/// The names by which columns are known, in lower case.
const NAMES: [(Meaning, &[&str]); 16] = [
    (Meaning::Name, &["joint", "name", "jointname", "link", "axis", "j", "i", "no", "#"]),
    (Meaning::Kind, &["kind", "type", "jointtype", "sigma"]),
    (Meaning::Theta, &["theta", "θ"]),
    (Meaning::D, &["d"]),
    (Meaning::A, &["a", "r"]),
    (Meaning::Alpha, &["alpha", "α", "⍺"]),
    (Meaning::Offset, &["offset", "thetaoffset", "zero"]),
    (Meaning::Lower, &["lower", "min", "qmin", "q⁻", "lowerlimit"]),
    (Meaning::Upper, &["upper", "max", "qmax", "q⁺", "upperlimit"]),
    (Meaning::Sign, &["sign", "sense", "direction"]),
    (Meaning::X, &["x"]),
    (Meaning::Y, &["y"]),
    (Meaning::Z, &["z"]),
    (Meaning::Roll, &["roll"]),
    (Meaning::Pitch, &["pitch"]),
    (Meaning::Yaw, &["yaw"]),
];

impl Heading {
    fn of(name: &str) -> Option<Self> {
        let (name, unit) = match name.trim_end_matches([')', ']']).rsplit_once(['(', '[']) {
            Some((before, inner)) if unit(inner).is_some() => (before, unit(inner)),
            _ => (name, None),
        };
        let letters = name.to_lowercase();
        let letters: String =
            letters.chars().filter(|c| !(c.is_whitespace() || "_{}()$\\^*".contains(*c))).collect();
        let known = |letters: &str| {
            NAMES.iter().find(|(_, names)| names.contains(&letters)).map(|(meaning, _)| *meaning)
        };
        if let Some(meaning) = known(&letters) {
            return Some(Self { meaning, unit, is_before: false });
        }
        let indices = [
            ("i-1", true),
            ("j-1", true),
            ("ⱼ₋₁", true),
            ("ᵢ₋₁", true),
            ("i", false),
            ("j", false),
            ("ⱼ", false),
            ("ᵢ", false),
        ];
        let (base, is_before) =
            indices.iter().find_map(|(index, is_before)| Some((letters.strip_suffix(index)?, *is_before)))?;
        Some(Self { meaning: known(base)?, unit, is_before })
    }
}

fn unit(text: &str) -> Option<Unit> {
    Some(match text.trim() {
        "m" => Unit::Length(LengthUnit::Metre),
        "mm" => Unit::Length(LengthUnit::Millimetre),
        "deg" | "°" | "degree" | "degrees" => Unit::Degree,
        "rad" | "radian" | "radians" => Unit::Radian,
        _ => return None,
    })
}

/// A column that is read.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) meaning: Meaning,
    pub(super) unit: Option<Unit>,
    /// Its place in a row.
    pub(super) place: usize,
    /// Its name in the heading.
    pub(super) span: Span,
}

/// The columns of a table.
pub(super) struct Columns {
    read: Vec<Column>,
    unread: Vec<String>,
    /// The whole heading.
    pub(super) span: Span,
}

impl Columns {
    /// The four numbers must be there, each once.
    pub(super) fn read(text: &Text, convention: DhConvention, document: &mut Document) -> Option<Self> {
        let whole = document.text.clone();
        let span = text.heading.first()?.start..text.heading.last()?.end;
        let mut columns = Self { read: Vec::new(), unread: Vec::new(), span };
        for (place, span) in text.heading.iter().enumerate() {
            let name = &whole[span.clone()];
            let Some(Heading { meaning, unit, is_before }) = Heading::of(name) else {
                if !name.is_empty() {
                    columns.unread.push(name.to_owned());
                }
                continue;
            };
            if let Some(other) = columns.get(meaning) {
                // A number of the row beside its name: both name it.
                if meaning == Meaning::Name {
                    continue;
                }
                let message = format!("two columns are the same: `{name}`");
                let mistake = Diagnostic::new(span.clone(), message).context(other.span.clone(), "the first");
                document.mistake(mistake.label("again").help("leave one of them out"));
                return None;
            }
            if is_before && convention == DhConvention::Standard {
                let message = format!("`{name}` is a number of the modified convention");
                document.mistake(
                    Diagnostic::new(span.clone(), message).help("read the table so: `--dh modified`"),
                );
                return None;
            }
            columns.read.push(Column { meaning, unit, place, span: span.clone() });
        }
        let four =
            [(Meaning::Theta, "theta"), (Meaning::D, "d"), (Meaning::A, "a"), (Meaning::Alpha, "alpha")];
        let missing: Vec<&str> = four
            .iter()
            .filter(|(meaning, _)| columns.get(*meaning).is_none())
            .map(|(_, name)| *name)
            .collect();
        if !missing.is_empty() {
            let message = format!("there is no column {}", abbe_spec::diagnostic::listed(&missing));
            let help =
                "a row has theta, d, a and alpha; where a number is 0 in all rows, write a column of zeros";
            document.mistake(Diagnostic::new(columns.span.clone(), message).help(help));
            return None;
        }
        Some(columns)
    }

    pub(super) fn get(&self, meaning: Meaning) -> Option<&Column> {
        self.read.iter().find(|column| column.meaning == meaning)
    }

    /// The unit of length that the heading names, that of `a` before that of `d`.
    pub(super) fn length(&self) -> Option<LengthUnit> {
        [Meaning::A, Meaning::D].into_iter().find_map(|meaning| match self.get(meaning)?.unit? {
            Unit::Length(length) => Some(length),
            _ => None,
        })
    }

    /// The names of columns that only rows of base and tool have.
    pub(super) fn of_ends<'t>(&self, whole: &'t str) -> Vec<&'t str> {
        let of_ends = |column: &&Column| {
            matches!(
                column.meaning,
                Meaning::X | Meaning::Y | Meaning::Z | Meaning::Roll | Meaning::Pitch | Meaning::Yaw
            )
        };
        self.read.iter().filter(of_ends).map(|column| &whole[column.span.clone()]).collect()
    }

    /// The names of columns that mean nothing here.
    pub(super) fn unread(&self) -> Vec<&str> {
        self.unread.iter().map(String::as_str).collect()
    }
}
