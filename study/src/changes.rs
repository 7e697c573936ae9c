//! Changes to a spec for one run: values of parameters and inputs, sources switched on and off or
//! scaled.
//!
//! Text of a spec with the changes of a machine.

use abbe_spec::diagnostic::Span;
use abbe_spec::edit::{Edits, write};
use abbe_spec::expr::{Dimension, Symbol};
use abbe_spec::option::{DISABLE, ENABLE, NamedOption, Q, SCALE, SCALE_GEAR, SET, SET_X};
use abbe_spec::value::{find_name, parse_value};
use abbe_spec::{Diagnostic, Document, Spec};

use crate::{Result, number, number::exact_quantity};

/// Changes to a spec, applied in order.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    pub(crate) values: Vec<(Symbol, f64)>,
    /// Indices of sources, with `true` for those switched on.
    switches: Vec<(usize, bool)>,
    /// Indices of sources, with factors of their errors.
    scales: Vec<(usize, f64)>,
    /// Each change of a command line or of Python, as it was written.
    pub(crate) stated: Vec<(&'static str, String)>,
}

impl Changes {
    /// Parses lists of `NAME=VALUE`, of sources to switch on and off, and of `SOURCE=FACTOR`.
    /// Mistakes are reported under the options `--set`, `--enable`, `--disable` and `--scale`.
    pub fn read([set, enable, disable, scale]: [&[String]; 4], spec: &Spec) -> Result<Self> {
        let named = [("set", set), ("enable", enable), ("disable", disable), ("scale", scale)];
        let stated = named.iter().flat_map(|(name, texts)| texts.iter().map(|text| (*name, text.clone())));
        let mut changes = Self { stated: stated.collect(), ..Self::default() };
        each_line(&SET, set, |document, span| {
            let line = document.text[span.clone()].to_owned();
            let Some((name, _)) = line.split_once('=') else {
                let mistake = Diagnostic::new(span, "expected NAME=VALUE").help(format!("write `{SET_X}`"));
                return document.mistake(mistake);
            };
            let value = span.start + name.len() + 1..span.end;
            let named = span.start..span.start + name.len();
            let Some((symbol, dimension)) = find_symbol(document, named, name.trim(), spec) else { return };
            let what = format!("the value of `{}`", name.trim());
            if let Some(number) = parse_value(document, value.clone(), spec.length, dimension, &what) {
                changes.set(document, value, spec, symbol, number);
            }
        })?;
        for (option, names, on) in [(&ENABLE, enable, true), (&DISABLE, disable, false)] {
            each_line(option, names, |document, span| {
                let name = document.text[span.clone()].to_owned();
                changes.switch(document, span, &name, spec, on);
            })?;
        }
        each_line(&SCALE, scale, |document, span| changes.scale(document, span, spec))?;
        Ok(changes)
    }

    /// Parses `NAME=VALUE` with a number in coherent units.
    pub fn parse_number(change: &str, spec: &Spec) -> Result<Self> {
        let mut changes = Self { stated: vec![("set", change.to_owned())], ..Self::default() };
        let document = Document::new(SET, change);
        let Some((name, value)) = change.split_once('=') else {
            document.mistake(Diagnostic::new(0..change.len(), "expected NAME=VALUE"));
            return document.finish(None);
        };
        let span = name.len() + 1..change.len();
        let symbol = find_symbol(&document, 0..name.len(), name, spec);
        match (symbol, value.parse::<f64>()) {
            (Some((symbol, _)), Ok(value)) if value.is_finite() => {
                changes.set(&document, span, spec, symbol, value);
            }
            (Some(_), _) => document.mistake(Diagnostic::new(span, "expected a finite number")),
            (None, _) => {}
        }
        document.finish(Some(changes))
    }

    /// Returns the changes as options, in the order in which they are applied. Numbers have all
    /// their digits.
    pub fn options(&self, spec: &Spec) -> Vec<(&'static str, String)> {
        let source = |index: usize| spec.sources[index].name.clone();
        let values = self.values.iter().map(|(symbol, value)| {
            let unit = match *symbol {
                Symbol::Parameter(i) => &spec.parameters[i].unit,
                Symbol::Input(i) => &spec.inputs[i].unit,
                _ => "",
            };
            ("set", format!("{}={}", spec.name_of(*symbol), number::exact_quantity(*value, unit)))
        });
        let switches =
            self.switches.iter().map(|(index, on)| (if *on { "enable" } else { "disable" }, source(*index)));
        let scales =
            self.scales.iter().map(|(index, factor)| ("scale", format!("{}={factor}", source(*index))));
        values.chain(switches).chain(scales).collect()
    }

    /// Returns true if there are no changes.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty() && self.switches.is_empty() && self.scales.is_empty()
    }

    /// Sets a parameter or input; reports a mistake if an input is outside its range.
    pub fn set(&mut self, document: &Document, span: Span, spec: &Spec, symbol: Symbol, value: f64) {
        if let Symbol::Input(input) = symbol {
            let input = &spec.inputs[input];
            let [lower, upper] = input.range;
            if !(lower..=upper).contains(&value) {
                let message = format!("`{}` is outside its range", input.name);
                let label = format!("this is {}", number::quantity(value, &input.unit));
                let range = format!("{} … {}", number::short(lower), number::quantity(upper, &input.unit));
                let mistake = Diagnostic::new(span, message).label(label);
                document.mistake(mistake.help(format!("its range is {range}")));
                return;
            }
        }
        self.values.push((symbol, value));
    }

    /// Switches a source on or off; reports a mistake if there is no source with this name.
    pub fn switch(&mut self, document: &Document, span: Span, name: &str, spec: &Spec, on: bool) {
        let found = find_source(document, span, name, spec);
        self.switches.extend(found.map(|source| (source, on)));
    }

    /// Scales the errors of a source, given as `SOURCE=FACTOR`.
    fn scale(&mut self, document: &Document, span: Span, spec: &Spec) {
        let line = document.text[span.clone()].to_owned();
        // A name can contain `=`, a factor cannot.
        let Some((name, _)) = line.rsplit_once('=') else {
            let mistake =
                Diagnostic::new(span, "expected SOURCE=FACTOR").help(format!("write `{SCALE_GEAR}`"));
            return document.mistake(mistake);
        };
        let named = span.start..span.start + name.len();
        let Some(source) = find_source(document, named.clone(), name.trim(), spec) else { return };
        let value = named.end + 1..span.end;
        let what = format!("the factor of `{}`", name.trim());
        let factor = parse_value(document, value.clone(), spec.length, Dimension::NONE, &what);
        match factor {
            Some(factor) if factor < 0.0 => {
                let message = format!("{what} is negative");
                let help = "write 0 or a positive number";
                document.mistake(Diagnostic::new(value, message).help(help));
            }
            factor => self.scales.extend(factor.map(|factor| (source, factor))),
        }
    }

    /// Applies the changes. Values become the nominal ones.
    pub fn apply(&self, spec: &mut Spec) {
        for &(symbol, value) in &self.values {
            match symbol {
                Symbol::Parameter(i) => spec.parameters[i].value = value,
                Symbol::Input(i) => spec.inputs[i].value = value,
                _ => {}
            }
        }
        let wholes: Vec<usize> = (0..spec.sources.len()).map(|k| spec.whole(k)).collect();
        for (source, whole) in spec.sources.iter_mut().zip(wholes) {
            let switches = self.switches.iter().filter(|(of, _)| *of == whole);
            switches.for_each(|(_, on)| source.enabled = *on);
            let scales = self.scales.iter().filter(|(of, _)| *of == whole);
            scales.for_each(|(_, factor)| source.scale *= factor);
        }
    }
}

/// Finds a source by name; reports a mistake if there is none.
fn find_source(document: &Document, span: Span, name: &str, spec: &Spec) -> Option<usize> {
    let names = spec.sources.iter().map(|source| source.name.as_str()).collect::<Vec<_>>();
    find_name(document, span, name, &names, "source").map(|source| spec.whole(source))
}

/// Finds a parameter or input by name; reports a mistake if there is none.
pub fn find_symbol(document: &Document, span: Span, name: &str, spec: &Spec) -> Option<(Symbol, Dimension)> {
    if spec.variables.iter().any(|variable| variable.name == name) {
        let message = format!("`{name}` is a joint variable, not a parameter or input");
        let help = format!("`abbe jacobian` sets joint variables by `{Q}`; a workspace moves them");
        return document.refuse(span, message, help);
    }
    let all = spec.symbols().skip(spec.variables.len()).collect::<Vec<_>>();
    let names = all.iter().map(|(name, ..)| *name).collect::<Vec<_>>();
    let found = find_name(document, span, name, &names, "parameter or input")?;
    let (_, symbol, dimension) = all[found];
    Some((symbol, dimension))
}

/// Parses all values of an option as lines of one document, so that all mistakes are reported at
/// once.
fn each_line(option: &NamedOption, values: &[String], mut read: impl FnMut(&Document, Span)) -> Result<()> {
    let document = Document::new(option, values.join("\n"));
    let mut start = 0;
    for value in values {
        read(&document, start..start + value.len());
        start += value.len() + 1;
    }
    document.finish(Some(()))
}

/// Returns the text of a spec with the values of parameters and inputs, and the switches and scales
/// of the sources, of a changed one. Everything else stays as it is. `None` if the text has no
/// place for a change.
pub fn changed_text(text: &str, unchanged: &Spec, changed: &Spec) -> Option<String> {
    let values = |spec: &Spec| {
        let parameters =
            spec.parameters.iter().map(|p| ("parameters", p.name.clone(), p.value, p.unit.clone()));
        let inputs =
            spec.inputs.iter().map(|input| ("inputs", input.name.clone(), input.value, input.unit.clone()));
        parameters.chain(inputs).collect::<Vec<_>>()
    };
    Edits::apply(text, |root, edits| {
        let both = values(unchanged).into_iter().zip(values(changed));
        for (_, (table, name, value, unit)) in both.filter(|(old, new)| old.2 != new.2) {
            let item = root.get(table)?.as_table()?.get(&name)?;
            let span = item.as_table().map_or(Some(item.span()), |table| Some(table.get("value")?.span()))?;
            let text = exact_quantity(value, &unit);
            edits.replace(span, if unit.is_empty() { text } else { write::quoted(&text) });
        }
        let sources = unchanged.sources.iter().zip(&changed.sources).enumerate();
        for (i, (old, new)) in sources.filter(|(i, _)| unchanged.whole(*i) == *i) {
            let changes = [
                (old.enabled != new.enabled, "enabled", new.enabled.to_string()),
                (old.scale != new.scale, "scale", new.scale.to_string()),
            ];
            for (_, key, value) in changes.into_iter().filter(|(is_changed, ..)| *is_changed) {
                edits.set(root.get("source")?.list().get(i)?, key, value);
            }
        }
        Some(())
    })
}
