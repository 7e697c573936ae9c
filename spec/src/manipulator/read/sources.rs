//! `[[source]]`: physical errors and the generalized errors that they cause.

use abbe_core::{Class, Distribution};

use super::deviations::{Chain, read_deviations};
use super::{CLASSES, Declarations, keys, read_effect};
use crate::diagnostic::Diagnostic;
use crate::document::{Document, Item, Section};
use crate::expr::{Dimension, Expression};
use crate::keys::Keys;
use crate::manipulator::{Cause, Deviation, Effect, Magnitude, Source, Uncertain, read_title};

/// Keys of a source: its own, and those of its effects.
fn all_keys() -> [&'static Keys; 4] {
    [&keys::SOURCE, &keys::PLACE, &keys::CAUSE, &keys::DEVIATION]
}

/// Maximum number of sources.
const MOST_SOURCES: usize = 10_000;

/// Reads all sources of a spec.
pub(super) fn read_sources(root: &Section<'_>, chain: Chain<'_>) -> Vec<Source> {
    let mut sources: Vec<Source> = Vec::new();
    let help = "combine similar random sources into one with the root sum of squares of their values";
    let mut known = Vec::new();
    for item in root.tables("source", MOST_SOURCES, help) {
        let Some(mut section) = item.named("this [[source]]") else { continue };
        let help = "rename one, or give one source several [[source.effect]] tables";
        match read_title(&mut section, "source", &mut known, help) {
            Some(name) => sources.extend(read_source(&section, name, chain)),
            None => section.check_keys(&all_keys()),
        }
    }
    for part in parts_of_balls(&mut sources.clone()) {
        if let Some((_, span)) = known.iter().find(|(name, _)| *name == part.name) {
            let message = format!("\"{}\" is the name of a part of another source", part.name);
            root.document.mistake(Diagnostic::new(span.clone(), message).help("rename this source"));
        }
    }
    sources
}

/// Returns a random source for each input with an uncertainty, which adds the derivatives of the
/// repeatable errors by the input times this uncertainty.
pub(super) fn input_uncertainties(
    declarations: &Declarations,
    sources: &[Source],
    document: &Document,
) -> Vec<Source> {
    let mut uncertainties = Vec::new();
    for (i, input) in declarations.inputs.iter().enumerate().filter(|(_, input)| input.uncertainty > 0.0) {
        let name = format!("uncertainty of {}", input.name);
        if sources.iter().any(|source| source.name == name) {
            let span = declarations.scope.names.get(&input.name).map_or(0..0, |name| name.span.clone());
            let message = format!("`uncertainty` of `{}` is a source named \"{name}\"", input.name);
            let mistake = Diagnostic::new(span, message).label("there is a source with this name");
            document.mistake(mistake.help("rename that source; remove it if it is the same uncertainty"));
        }
        let description = format!("Standard uncertainty of the input `{}`", input.name);
        let propagated = vec![(Uncertain::Input(i), input.uncertainty)];
        uncertainties.push(Source::propagating(name, description, propagated));
    }
    uncertainties
}

/// Leaves the first component of each ball and disc in its source, and returns the other parts: a
/// source for each.
pub(super) fn parts_of_balls(sources: &mut [Source]) -> Vec<Source> {
    let mut all = Vec::new();
    for source in sources {
        let Some(Distribution::Ball { parts, .. }) = source.class.distribution() else { continue };
        let [Effect { cause: Cause::Errors(errors), .. }] = &mut source.effects[..] else { continue };
        for (part, error) in (1..parts).zip(errors.split_off(1)) {
            let distribution = Distribution::Ball { part, parts };
            let class = match source.class {
                Class::Tolerance(_) => Class::Tolerance(distribution),
                _ => Class::Random(distribution),
            };
            let name = format!("{} ({})", source.name, error.0.name());
            let effects = source
                .effects
                .iter()
                .map(|effect| Effect { cause: Cause::Errors(vec![error.clone()]), ..effect.clone() });
            all.push(Source { name, class, effects: effects.collect(), ..source.clone() });
        }
    }
    all
}

fn read_source(section: &Section<'_>, name: String, chain: Chain<'_>) -> Option<Source> {
    section.check_keys(&all_keys());
    let class = section.required("class");
    let class = class.and_then(|class| read_class(&class, section));
    let degrees_of_freedom = read_degrees_of_freedom(section, class, chain)?;
    let enabled = section.get("enabled").map_or(Some(true), |item| item.boolean());
    let scale = section.get("scale").map_or(Some(1.0), |item| read_scale(&item));
    let magnitude =
        section.get("magnitude").map_or(Some(None), |item| read_magnitude(&item, class, chain).map(Some))?;
    let mut acts = Acts::default();
    let tables = section.get("effect").and_then(|item| item.array_of_tables("source.effect"));
    if tables.is_none()
        || section.items().any(|item| all_keys()[1..].iter().any(|keys| keys.contain(&item.key)))
    {
        acts.read(section, chain);
    }
    for item in tables.unwrap_or_default() {
        if let Some(table) = item.table(format!("an effect of {}", section.name), &all_keys()[1..]) {
            acts.read(&table, chain);
        }
    }
    let description = section.optional_text("description");
    let reference = section.optional_text("reference");
    let Acts { effects, deviations } = acts;
    let (class, enabled, scale) = (class?, enabled?, scale?);
    if let Some(distribution) = class.distribution() {
        check_half_width(distribution, &effects, &deviations, section.document);
        if let Distribution::Ball { parts, .. } = distribution {
            let errors = match &effects[..] {
                [Effect { cause: Cause::Errors(list), .. }] if deviations.is_empty() => list.len(),
                _ => 0,
            };
            if errors != usize::from(parts) {
                let name = distribution.name();
                let message = format!("a {name} is one error with {parts} components at a frame");
                let help = format!(
                    "give the source {parts} of `e_x` … `e_p` of a `frame`, the semi-axes of the {name}, and nothing else"
                );
                let span = section.get("distribution").map_or(section.span.clone(), |item| item.span());
                return section.document.refuse(span, message, help);
            }
        }
    }
    let source =
        Source { class, degrees_of_freedom, enabled, description, reference, ..Source::repeatable(name) };
    Some(Source { scale, magnitude, effects, deviations, ..source })
}

/// Reads `scale`, a pure number that is not negative.
fn read_scale(item: &Item<'_>) -> Option<f64> {
    let scale = item.quantity(Dimension::NONE)?;
    if scale >= 0.0 {
        return Some(scale);
    }
    item.refuse("`scale` is negative", "write 0 or a positive number")
}

/// Checks that a half-width or standard deviation is not negative. The effects of a random source
/// share one random number, so that their relative signs matter; only sources whose effects are all
/// negative are rejected.
fn check_half_width(
    distribution: Distribution,
    effects: &[Effect],
    deviations: &[Deviation],
    document: &Document,
) {
    let Some(mut errors) = deviations.iter().map(Deviation::error).collect::<Option<Vec<&Expression>>>()
    else {
        return;
    };
    for effect in effects {
        let Cause::Errors(list) = &effect.cause else { return };
        errors.extend(list.iter().map(|(_, error)| error));
    }
    let negative = |error: &&Expression| error.constant().is_some_and(|value| value < 0.0);
    let Some(first) = errors.first().filter(|_| errors.iter().all(negative)) else { return };
    let message = match distribution {
        Distribution::Normal => "a standard deviation cannot be negative",
        _ => "a half-width cannot be negative",
    };
    let help = "these errors have both signs: remove the minus sign";
    let mistake = Diagnostic::new(first.span(), message);
    document.mistake(mistake.label(format!("this is {}", first.constant().unwrap_or_default())).help(help));
}

/// Effects and deviations of a source.
#[derive(Default)]
struct Acts {
    effects: Vec<Effect>,
    deviations: Vec<Deviation>,
}

impl Acts {
    /// Reads a table with one effect: errors of a frame, or of a number of the chain.
    fn read(&mut self, section: &Section<'_>, chain: Chain<'_>) {
        if section.items().any(|item| keys::DEVIATION.contain(&item.key)) {
            self.deviations.extend(read_deviations(section, chain).unwrap_or_default());
        } else {
            self.effects.extend(read_effect(section, chain.tree, chain.scope));
        }
    }
}

/// Reads `degrees_of_freedom` of a normal error; infinite without it.
fn read_degrees_of_freedom(section: &Section<'_>, class: Option<Class>, chain: Chain<'_>) -> Option<f64> {
    let Some(item) = section.get("degrees_of_freedom") else { return Some(f64::INFINITY) };
    let (message, help) = match class {
        None | Some(Class::Random(Distribution::Normal) | Class::Tolerance(Distribution::Normal)) => {
            return positive(&item, chain);
        }
        Some(Class::Repeatable) => (
            "a repeatable error has no degrees of freedom",
            "degrees of freedom belong to an estimated standard deviation: remove them, or move them to `magnitude`",
        ),
        Some(_) => (
            "a half-width has no degrees of freedom",
            "degrees of freedom belong to a standard deviation that was estimated from \
             measurements: write distribution = \"normal\", or leave them out",
        ),
    };
    item.refuse_key(message, help)
}

/// Reads a positive number of degrees of freedom.
fn positive(item: &Item<'_>, chain: Chain<'_>) -> Option<f64> {
    let number = item.amount(chain.scope, Dimension::NONE, "`degrees_of_freedom`")?;
    if number > 0.0 {
        return Some(number);
    }
    item.refuse("`degrees_of_freedom` must be positive", "a standard deviation of n measurements has n - 1; leave it out if the standard deviation is known exactly")
}

/// Reads `magnitude = { value, standard_deviation, degrees_of_freedom }`: pure numbers.
fn read_magnitude(item: &Item<'_>, class: Option<Class>, chain: Chain<'_>) -> Option<Magnitude> {
    if class.and_then(Class::distribution).is_some() {
        let help = "remove `magnitude`: the distribution gives the size of the error";
        return item.refuse_key("only a repeatable error has a `magnitude`", help);
    }
    let table = item.table("`magnitude`", &[&keys::MAGNITUDE])?;
    let number = |item: &Item<'_>| {
        item.amount(chain.scope, Dimension::NONE, &format!("`{}` of a magnitude", item.key))
    };
    let value = table.get("value").map_or(Some(1.0), |item| number(&item))?;
    let standard_deviation = match table.get("standard_deviation") {
        Some(item) => {
            let read = number(&item)?;
            if read <= 0.0 {
                let help = "leave it out if the magnitude is unknown";
                return item.refuse("`standard_deviation` must be positive", help);
            }
            Some(read)
        }
        None => None,
    };
    let degrees_of_freedom = match table.get("degrees_of_freedom") {
        Some(item) if standard_deviation.is_none() => {
            let help = "add `standard_deviation`, or remove `degrees_of_freedom`";
            return item.refuse_key("`degrees_of_freedom` without `standard_deviation`", help);
        }
        Some(item) => positive(&item, chain)?,
        None => f64::INFINITY,
    };
    Some(Magnitude { value, standard_deviation, degrees_of_freedom })
}

fn read_class(item: &Item<'_>, section: &Section<'_>) -> Option<Class> {
    let class = item.choice(&CLASSES)?;
    let distribution = section.get("distribution");
    match (class, distribution) {
        (Class::Repeatable, Some(distribution)) => {
            item.document.fail(Diagnostic::new(distribution.key_span, "a repeatable error has no distribution")
                    .context(item.span(), "repeatable")
                    .help("leave `distribution` out, or write class = \"tolerance\" for one unknown value per machine, class = \"random\" for another value each time"))
        }
        (Class::Random(_), None) => {
            item.document.fail(Diagnostic::new(item.span(), "a random error needs its distribution")
                    .label("no `distribution` here")
                    .help(
                        "add distribution = \"uniform\" or \"triangular\" (values are half-widths), \"normal\" (values are σ) or \
                         \"arcsine\" (values are amplitudes)",
                    ))
        }
        (_, None) => Some(class),
        (_, Some(distribution)) => {
            let choices = Distribution::ALL.map(|distribution| (distribution.name(), distribution));
            let distribution = distribution.choice(&choices)?;
            Some(match class {
                Class::Tolerance(_) => Class::Tolerance(distribution),
                _ => Class::Random(distribution),
            })
        }
    }
}
