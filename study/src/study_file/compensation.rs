//! Reads `[compensation]`: the residuals of repeatable sources and tolerances after compensation.

use abbe::{Description, analysis::Residual};
use abbe_spec::expr::{Allowed, Dimension, Entry, Scope};
use abbe_spec::value::find_name;
use abbe_spec::{Diagnostic, Item, Spec};

use super::keys;

/// Residuals after compensation.
#[derive(Clone, Debug)]
pub struct Compensated {
    /// Norm of what remains of all repeatable sources and tolerances together, in the length unit.
    pub together: Option<f64>,
    default: Residual,
    /// Residuals of single sources, by name.
    named: Vec<(String, Residual)>,
}

impl Compensated {
    /// Returns the residual of every source; none for random ones, which cannot be compensated.
    pub fn residuals(&self, description: &Description) -> Vec<Option<Residual>> {
        let residual = |name: &str| {
            let named = self.named.iter().find(|(known, _)| known == name);
            named.map_or(self.default, |(_, residual)| *residual)
        };
        let sources = description.sources.iter();
        sources.map(|source| source.class.can_be_compensated().then(|| residual(&source.name))).collect()
    }
}

/// Reads `residual`; or `default` (the whole error if missing, nothing for an identified machine)
/// and a residual for each named source.
pub(super) fn read(item: &Item<'_>, spec: &Spec) -> Option<Compensated> {
    let section = item.section()?;
    let whole = if spec.covariance.of.is_empty() { 1.0 } else { 0.0 };
    let mut compensated = Compensated { together: None, default: Residual::Share(whole), named: Vec::new() };
    if let Some(item) = section.get("residual") {
        if let Some(other) = section.items().find(|item| item.key != "residual") {
            let message = format!("`residual` is of all sources together; `{}` contradicts it", other.key);
            let help = "remove it, or remove `residual` and give residuals by source";
            item.document.mistake(Diagnostic::new(other.key_span.clone(), message).help(help));
        }
        let norm = item.quantity(Dimension::LENGTH)?;
        if norm < 0.0 {
            let mistake = Diagnostic::new(item.span(), "`residual` cannot be negative");
            item.document.mistake(mistake.help("write the norm of what remains, such as \"0.05 mm\""));
        }
        return Some(Compensated { together: Some(norm), ..compensated });
    }
    let names = spec.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>();
    for item in section.items() {
        if keys::COMPENSATION.contain(&item.key) {
            compensated.default = residual(&item, spec)?;
            continue;
        }
        let found = find_name(item.document, item.key_span.clone(), &item.key, &names, "source");
        let Some(source) = found.map(|found| &spec.sources[found]) else { continue };
        if !source.class.can_be_compensated() {
            let message = format!("the source \"{}\" is random", source.name);
            let mistake =
                Diagnostic::new(item.key_span.clone(), message).label("random errors cannot be compensated");
            item.document.mistake(mistake.help("remove this entry: random errors are not changed"));
        }
        compensated.named.extend(residual(&item, spec).map(|residual| (item.key.clone(), residual)));
    }
    Some(compensated)
}

/// Reads a share from 0 to 1, or a length.
fn residual(item: &Item<'_>, spec: &Spec) -> Option<Residual> {
    let scope = Scope::new(spec.length);
    let entry = Entry { dimension: None, what: "a residual", names: Allowed::Nothing };
    let (value, dimension) = item.constant(&scope, entry)?;
    match dimension {
        Dimension::LENGTH if value >= 0.0 => Some(Residual::Bound(value)),
        Dimension::NONE if (0.0..=1.0).contains(&value) => Some(Residual::Share(value)),
        _ => {
            let message = "a residual must be a share from 0 to 1, or a length";
            let mistake = Diagnostic::new(item.span(), message).label("neither a share nor a length");
            item.document.fail(mistake.help("write 0.05 for one twentieth of the error, or \"0.02 mm\""))
        }
    }
}
