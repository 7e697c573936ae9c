//! Deviations of numbers of the nominal chain: joints, structural parameters, Denavit-Hartenberg
//! numbers.

use super::{find_frame, frames::motion_dimension, keys};
use crate::degrees::check_error_of_angle;
use crate::diagnostic::Diagnostic;
use crate::document::{Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Motion, Scope, Symbol};
use crate::manipulator::{ChainNumber, Deviation, DeviationCause, DhNumber, Factor, Tree};
use crate::value::find_name;

/// Nominal chain as far as it could be read; `tool` is `None` after a mistake in it.
#[derive(Clone, Copy)]
pub(super) struct Chain<'a> {
    pub(super) tree: Tree<'a>,
    /// `false` after a mistake in a frame or loop.
    pub(super) complete: bool,
    pub(super) tool: Option<&'a [Factor]>,
    pub(super) scope: &'a Scope,
}

impl Chain<'_> {
    /// Returns `true` if a symbol occurs in an `A_i` or the tool, or may occur in one that has a
    /// mistake.
    fn uses(&self, symbol: Symbol) -> bool {
        let Tree { frames, loops, .. } = self.tree;
        let mistaken =
            !self.complete || self.tool.is_none() || frames.iter().any(|frame| frame.factors.is_empty());
        let factors = frames.iter().flat_map(|frame| &frame.factors).chain(self.tool.unwrap_or_default());
        let lengths = loops.iter().filter_map(|closed| closed.closure.length());
        let mut expressions = factors.flat_map(Factor::expressions).chain(lengths);
        mistaken || expressions.any(|e| e.symbols().any(|used| used == symbol))
    }
}

/// Reads the deviations in a source or in one of its `[[source.effect]]` tables.
pub(super) fn read_deviations(section: &Section<'_>, chain: Chain<'_>) -> Option<Vec<Deviation>> {
    let places: Vec<Item<'_>> =
        ["joint", "parameter", "dh"].iter().filter_map(|key| section.get(key)).collect();
    let Some(place) = places.first() else {
        let item = ["error", "stiffness", "moment"].iter().find_map(|key| section.get(key))?;
        let (owners, label, help) = match item.key.as_str() {
            "error" => (
                "`joint` or `parameter`",
                "error of an unspecified quantity",
                "add `joint = …` or `parameter = …`; errors of a frame are called e_x, e_y, e_z, e_s, e_r, e_p",
            ),
            _ => (
                "`joint`",
                "of an unspecified joint",
                "add `joint = …`; an elastic `frame` has a `compliance` or `beam`",
            ),
        };
        let message = format!("`{}` needs a {owners}", item.key);
        return section.document.fail(Diagnostic::new(item.key_span, message).label(label).help(help));
    };
    let allowed: &[&str] = match (place.key.as_str(), section.get("stiffness")) {
        ("dh", _) => &["dh", "frame"],
        ("joint", Some(_)) => &["joint", "stiffness", "moment"],
        (key, _) => &[key, "error"],
    };
    let says_where = |item: &Item<'_>| {
        [&keys::PLACE, &keys::CAUSE, &keys::DEVIATION].iter().any(|keys| keys.contain(&item.key))
    };
    if let Some(other) =
        section.items().find(|item| says_where(item) && !allowed.contains(&item.key.as_str()))
    {
        let help = match (other.key.as_str(), place.key.as_str()) {
            ("frame", _) => {
                format!("remove `frame`: the error acts wherever the {} occurs in the chain", place.key)
            }
            ("at", _) => "remove `at`: it locates the errors e_… of a frame on its link".to_owned(),
            ("error", "dh") => "write the errors in `dh`: dh = { theta = …, a = … }".to_owned(),
            ("stiffness" | "moment", "dh" | "parameter") => {
                "loads deflect a `joint`, or a `frame` with a `compliance` or `beam`".to_owned()
            }
            ("moment", _) => "add the `stiffness` that the moment acts on".to_owned(),
            _ => "list them as [[source.effect]] tables of the source".to_owned(),
        };
        let message = format!("`{}` and `{}` cannot be combined", other.key, place.key);
        let mistake = Diagnostic::new(other.key_span, message).label("one too many");
        return section.document.fail(mistake.context(place.key_span.clone(), "the other one").help(help));
    }
    match place.key.as_str() {
        "dh" => read_numbers(section, place, chain),
        "joint" if section.get("stiffness").is_some() => {
            read_stiffness(section, place, chain).map(|deviation| vec![deviation])
        }
        _ => read_symbol(section, place, chain).map(|deviation| vec![deviation]),
    }
}

/// Reads `joint` or `parameter` with its `error`.
fn read_symbol(section: &Section<'_>, place: &Item<'_>, chain: Chain<'_>) -> Option<Deviation> {
    let form = match place.key.as_str() {
        "joint" => "`error = …`, or the `stiffness` of an elastic joint",
        _ => "`error = …`",
    };
    let error = section.required_as("error", form);
    let (number, dimension) = find_symbol(place, chain)?;
    let name = place.string()?;
    let what = format!("the error of `{name}`");
    let error = error?.expression(chain.scope, Entry::new(dimension, &what, Allowed::Everything))?;
    if matches!(number, ChainNumber::Joint(_)) && dimension == Some(Dimension::NONE) {
        check_error_of_angle(&error, section.document);
    }
    Some(Deviation { number, cause: DeviationCause::Error(error), span: place.key_span.clone() })
}

/// Reads `joint` with its `stiffness`, and the `moment` if that is measured.
fn read_stiffness(section: &Section<'_>, place: &Item<'_>, chain: Chain<'_>) -> Option<Deviation> {
    let (number, dimension) = find_symbol(place, chain)?;
    let load = if dimension == Some(Dimension::LENGTH) { Dimension::FORCE } else { Dimension::MOMENT };
    let quantity = |key: &str, dimension: Option<Dimension>| {
        let item = section.get(key)?;
        let what = format!("`{key}`");
        Some(item.expression(chain.scope, Entry::new(dimension, &what, Allowed::Everything)))
    };
    // Small exponents cannot overflow.
    let stiffness = quantity("stiffness", load.over(dimension.unwrap_or(Dimension::NONE)))??;
    let cause = match quantity("moment", Some(load)) {
        Some(moment) => DeviationCause::Error(moment? / stiffness),
        None => DeviationCause::Stiffness(stiffness),
    };
    Some(Deviation { number, cause, span: place.key_span.clone() })
}

fn find_symbol(place: &Item<'_>, chain: Chain<'_>) -> Option<(ChainNumber, Option<Dimension>)> {
    let name = place.string()?;
    let of_joint = place.key == "joint";
    let fits = |symbol: Symbol| match symbol {
        Symbol::Variable(_) => of_joint,
        Symbol::Parameter(_) => !of_joint,
        _ => false,
    };
    let declared = chain.scope.names.get(&name);
    if let Some(passive) =
        declared.filter(|declared| matches!(declared.symbol, Symbol::Passive(_)) && of_joint)
    {
        let message = format!("the passive joint `{name}` has no error and no stiffness");
        let help = "give the clearance of its bearing as errors e_x … e_p of its `frame`";
        let mistake = Diagnostic::new(place.span(), message).label("the loops determine its value");
        return place.document.fail(mistake.context(passive.span.clone(), "declared here").help(help));
    }
    if let Some(other) = declared.filter(|declared| !fits(declared.symbol)) {
        let (kind, help) = match other.symbol {
            Symbol::Variable(_) => ("a joint", format!("write joint = \"{name}\"")),
            Symbol::Parameter(_) => ("a parameter", format!("write parameter = \"{name}\"")),
            Symbol::Passive(_) => ("a passive joint", "give errors e_x … e_p of its `frame`".to_owned()),
            _ => ("an input", "an input can be used in `error`, but is not part of the chain".to_owned()),
        };
        let mistake = Diagnostic::new(place.span(), format!("`{name}` is {kind}, not a {}", place.key));
        return place.document.fail(mistake.context(other.span.clone(), "declared here").help(help));
    }
    let known = chain.scope.names.iter().filter(|(_, declared)| fits(declared.symbol));
    let known: Vec<&str> = known.map(|(name, _)| name.as_str()).collect();
    if let Some(frame) = chain.tree.frames.iter().find(|frame| frame.name == name && declared.is_none())
        && of_joint
        && let Some(joint) = frame.variable.and_then(|variable| known.get(variable))
    {
        let help = format!("its joint is called `{joint}`: write joint = \"{joint}\"");
        return place.refuse(format!("`{name}` is a frame, not a joint"), help);
    }
    find_name(place.document, place.span(), &name, &known, &place.key)?;
    let declared = declared?;
    if !chain.uses(declared.symbol) {
        let help = "use the parameter in a frame or in the tool, or give the errors of a `frame` instead";
        let mistake = Diagnostic::new(place.span(), format!("`{name}` is not used in any transform"));
        return place.document.fail(mistake.label("its error has no effect").help(help));
    }
    let number = match declared.symbol {
        Symbol::Variable(variable) => ChainNumber::Joint(variable),
        Symbol::Parameter(parameter) => ChainNumber::Parameter(parameter),
        _ => return None,
    };
    Some((number, declared.dimension))
}

/// Reads `dh = { theta, d, a, alpha }`: errors of the Denavit-Hartenberg numbers of a frame.
fn read_numbers(section: &Section<'_>, place: &Item<'_>, chain: Chain<'_>) -> Option<Vec<Deviation>> {
    let table = place.table("`dh`", &[&keys::NUMBERS])?;
    let named = section.required("frame")?;
    let frame = find_frame(&named, chain.tree.frames)?;
    if chain.tree.frames[frame].convention.is_none() && !chain.tree.frames[frame].factors.is_empty() {
        return section.document.fail(
            Diagnostic::new(
                named.span(),
                format!("the frame \"{}\" has no Denavit-Hartenberg numbers", chain.tree.frames[frame].name),
            )
            .label("not given by `dh` or `mdh`")
            .help("give its errors e_x, e_y, e_z, e_s, e_r, e_p, or those of a `joint` or `parameter`"),
        );
    }
    let read = |number: DhNumber| {
        let item = table.get(number.name())?;
        let what = format!("the error of `{}`", number.name());
        let dimension = Some(motion_dimension(number.motion().0));
        let error = item.expression(chain.scope, Entry::new(dimension, &what, Allowed::Everything));
        if number.motion().0 == Motion::Rotation {
            error.iter().for_each(|error| check_error_of_angle(error, section.document));
        }
        let number = ChainNumber::DenavitHartenberg { frame, number };
        Some(error.map(|error| Deviation {
            number,
            cause: DeviationCause::Error(error),
            span: item.key_span,
        }))
    };
    let deviations: Vec<Option<_>> = DhNumber::ALL.into_iter().filter_map(read).collect();
    if table.items().next().is_none() {
        let mistake = Diagnostic::new(place.span(), "`dh` is empty").label("no error here");
        return section.document.fail(mistake.help("give at least one of theta, d, a, alpha"));
    }
    deviations.into_iter().collect()
}
