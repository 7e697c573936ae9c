//! Heading line of a table.

use abbe::LengthUnit;
use abbe_spec::{DhConvention, Diagnostic, Document, diagnostic::Span, option::DH_MODIFIED};

use super::heading::{Heading, Quantity, Unit};
use super::text::Text;

/// Column of a known quantity.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) quantity: Quantity,
    pub(super) unit: Option<Unit>,
    /// Index of its cell in a row.
    pub(super) index: usize,
    /// Span of its name in the heading.
    pub(super) span: Span,
}

/// Columns of a table.
pub(super) struct Columns {
    known: Vec<Column>,
    ignored: Vec<String>,
    /// Span of the heading line.
    pub(super) span: Span,
}

impl Columns {
    /// Reads the heading; the four numbers must be there, each once.
    pub(super) fn read(text: &Text, convention: DhConvention, document: &Document) -> Option<Self> {
        let whole = document.text.clone();
        let span = text.heading.first()?.start..text.heading.last()?.end;
        let mut columns = Self { known: Vec::new(), ignored: Vec::new(), span };
        for (index, span) in text.heading.iter().enumerate() {
            let name = &whole[span.clone()];
            let Some(Heading { quantity, unit, is_of_previous_link }) = Heading::parse(name) else {
                if !name.is_empty() {
                    columns.ignored.push(name.to_owned());
                }
                continue;
            };
            if let Some(other) = columns.get(quantity) {
                // A joint may have both a name and a number: the first of the two columns names it.
                if quantity == Quantity::Name {
                    continue;
                }
                let mistake = Diagnostic::new(span.clone(), format!("duplicate column `{name}`"))
                    .context(other.span.clone(), "first column of this name");
                return document.fail(mistake.label("again").help("remove one of them"));
            }
            if is_of_previous_link && convention == DhConvention::Standard {
                let message = format!("`{name}` is a column of the modified convention");
                let help = format!("read the table in that convention: `{DH_MODIFIED}`");
                return document.refuse(span.clone(), message, help);
            }
            columns.known.push(Column { quantity, unit, index, span: span.clone() });
        }
        let four =
            [(Quantity::Theta, "theta"), (Quantity::D, "d"), (Quantity::A, "a"), (Quantity::Alpha, "alpha")];
        let missing: Vec<&str> = four
            .iter()
            .filter(|(quantity, _)| columns.get(*quantity).is_none())
            .map(|(_, name)| *name)
            .collect();
        if !missing.is_empty() {
            let message = format!("the column {} is missing", abbe_spec::diagnostic::listed(&missing));
            let help = "a table needs the columns theta, d, a and alpha; if one is 0 for all joints, add \
                 a column of zeros";
            return document.refuse(columns.span.clone(), message, help);
        }
        Some(columns)
    }

    /// Returns the column of a quantity.
    pub(super) fn get(&self, quantity: Quantity) -> Option<&Column> {
        self.known.iter().find(|column| column.quantity == quantity)
    }

    /// Returns the unit of length in the heading: that of `a`, or else that of `d`.
    pub(super) fn length(&self) -> Option<LengthUnit> {
        [Quantity::A, Quantity::D].into_iter().find_map(|quantity| match self.get(quantity)?.unit? {
            Unit::Length(length) => Some(length),
            _ => None,
        })
    }

    /// Returns the names of the columns that only the rows of base and tool use.
    pub(super) fn placement_names<'t>(&self, whole: &'t str) -> Vec<&'t str> {
        let is_placement = |column: &&Column| {
            matches!(
                column.quantity,
                Quantity::X | Quantity::Y | Quantity::Z | Quantity::Roll | Quantity::Pitch | Quantity::Yaw
            )
        };
        self.known.iter().filter(is_placement).map(|column| &whole[column.span.clone()]).collect()
    }

    /// Returns the names of the columns that are not read.
    pub(super) fn ignored(&self) -> Vec<&str> {
        self.ignored.iter().map(String::as_str).collect()
    }
}
