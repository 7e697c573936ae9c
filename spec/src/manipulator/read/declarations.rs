//! Parameters, inputs and variables: the names that expressions may use.

use abbe_core::{LengthUnit, VariableKind};

use super::{JOINT_KINDS, keys};
use crate::degrees::check_angle_item;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Document, Item, Section};
use crate::expr::{Allowed, Dimension, Entry, Name, Scope, Symbol};
use crate::keys::Keys;
use crate::manipulator::{Input, Parameter, Variable, check_identifier};

/// Maximum number of parameters, and of inputs.
const MOST: usize = 10_000;

/// Names of a spec and their declarations.
pub(super) struct Declarations {
    pub(super) scope: Scope,
    pub(super) parameters: Vec<Parameter>,
    pub(super) inputs: Vec<Input>,
    pub(super) variables: Vec<Variable>,
    pub(super) passive: Vec<Variable>,
}

impl Declarations {
    pub(super) fn new(length: LengthUnit) -> Self {
        let scope = Scope::new(length);
        let (parameters, inputs, variables) = (Vec::new(), Vec::new(), Vec::new());
        Self { scope, parameters, inputs, variables, passive: Vec::new() }
    }

    /// Reads `[parameters]`.
    pub(super) fn read_parameters(&mut self, root: &Section<'_>) {
        let help = "write constants that are never changed where they are used";
        let Some(section) = root.section("parameters", MOST, help) else { return };
        for item in section.items() {
            let (value, table) = self.valued(&item, &keys::PARAMETER, "parameter");
            let symbol = Symbol::Parameter(self.parameters.len());
            self.declare(&item.key, item.key_span.clone(), symbol, value.map(|v| v.1), root.document);
            let (value, dimension) = value.unwrap_or((0.0, Dimension::NONE));
            self.set_range(&item.key, [value; 2]);
            let description = table.map_or_else(String::new, |t| t.optional_text("description"));
            let unit = dimension.unit(self.scope.length.symbol());
            let line = root.document.line(item.key_span.start);
            self.parameters.push(Parameter { name: item.key, value, dimension, unit, description, line });
        }
    }

    /// Reads `[inputs]`.
    pub(super) fn read_inputs(&mut self, root: &Section<'_>) {
        let help = "use parameters, or write constants where they are used";
        let Some(section) = root.section("inputs", MOST, help) else { return };
        for item in section.items() {
            let (value, table) = self.valued(&item, &keys::INPUT, "input");
            let symbol = Symbol::Input(self.inputs.len());
            self.declare(&item.key, item.key_span.clone(), symbol, value.map(|v| v.1), root.document);
            let (mut range, mut levels) = ([f64::NEG_INFINITY, f64::INFINITY], Vec::new());
            if let (Some((value, dimension)), Some(table)) = (value, &table)
                && let Some((entry, read)) = self.values_of_input(table, dimension)
            {
                range = [read[0], read[read.len() - 1]];
                if entry.key == "levels" {
                    levels = read;
                }
                let is_used = levels.is_empty() || levels.contains(&value);
                if !is_used || !(range[0]..=range[1]).contains(&value) {
                    let place = if levels.is_empty() { "outside its range" } else { "not among its levels" };
                    let message = format!("the value of `{}` is {place}", item.key);
                    let help = format!("change the {} or the value", entry.key);
                    let mistake = Diagnostic::new(entry.span(), message);
                    root.document.mistake(mistake.label(format!("the value is {value}")).help(help));
                }
            }
            let uncertainty = match (value, &table) {
                (Some((_, dimension)), Some(table)) => self.uncertainty(table, dimension),
                _ => 0.0,
            };
            let (value, dimension) = value.unwrap_or((0.0, Dimension::NONE));
            self.set_range(&item.key, range);
            let description = table.map_or_else(String::new, |t| t.optional_text("description"));
            let unit = dimension.unit(self.scope.length.symbol());
            let (line, name) = (root.document.line(item.key_span.start), item.key);
            let input = Input { name, value, dimension, unit, range, levels, uncertainty, description, line };
            self.inputs.push(input);
        }
    }

    /// Reads the `range` of an input, or its `levels`, in ascending order; `None` without them.
    fn values_of_input<'d>(&self, table: &Section<'d>, dimension: Dimension) -> Option<(Item<'d>, Vec<f64>)> {
        match (table.get("range"), table.get("levels")) {
            (Some(item), None) => {
                let range = self.interval(&item, dimension)?;
                Some((item, range.to_vec()))
            }
            (None, Some(item)) => {
                let items = item.array("a list of values")?;
                let levels = items.iter().map(|one| one.amount(&self.scope, dimension, "a level"));
                let mut levels = levels.collect::<Option<Vec<f64>>>()?;
                levels.sort_by(f64::total_cmp);
                levels.dedup();
                if levels.is_empty() {
                    return item.refuse("`levels` has no values", "give at least one value");
                }
                Some((item, levels))
            }
            (Some(_), Some(item)) => {
                let mistake = Diagnostic::new(item.key_span, "`range` and `levels` cannot be combined");
                table.document.fail(mistake.help("remove the range: it is that of the levels"))
            }
            (None, None) => None,
        }
    }

    /// Reads the `uncertainty` of an input; 0 without it.
    fn uncertainty(&self, table: &Section<'_>, dimension: Dimension) -> f64 {
        let Some(item) = table.get("uncertainty") else { return 0.0 };
        let what = "the uncertainty of an input";
        let Some(value) = item.amount(&self.scope, dimension, what) else { return 0.0 };
        if value <= 0.0 {
            let help = "write the standard uncertainty of the input, or leave it out if the value is exact";
            let mistake = Diagnostic::new(item.span(), "`uncertainty` must be positive");
            table.document.mistake(mistake.label(format!("this is {value}")).help(help));
        }
        value
    }

    /// Returns the variable, passive or not, that a symbol stands for.
    pub(super) fn variable(&self, symbol: Symbol) -> Option<&Variable> {
        match symbol {
            Symbol::Variable(i) => self.variables.get(i),
            Symbol::Passive(i) => self.passive.get(i),
            _ => None,
        }
    }

    /// Reads the `variable` of a frame, or of the leg that ends at it, and returns its symbol.
    pub(super) fn read_variable(&mut self, frame: usize, item: &Item<'_>) -> Option<Symbol> {
        let table = item.table("`variable`", &[&keys::VARIABLE, &keys::FRAME_VARIABLE])?;
        let name_item = table.required("name");
        let kind = table.required("kind").and_then(|kind| kind.choice(&JOINT_KINDS));
        let dimension = kind.map(|kind| kind.either(Dimension::NONE, Dimension::LENGTH));
        let name_item = name_item?;
        let name = name_item.string()?;
        let is_passive = table.get("passive").and_then(|item| item.boolean()).unwrap_or(false);
        let symbol = match is_passive {
            true => Symbol::Passive(self.passive.len()),
            false => Symbol::Variable(self.variables.len()),
        };
        self.declare(&name, name_item.span(), symbol, dimension, item.document);
        let mut limits = [f64::NEG_INFINITY, f64::INFINITY];
        let mut home = 0.0;
        if let Some(dimension) = dimension {
            let entry = table.get("limits");
            let mut is_meant = true;
            if kind == Some(VariableKind::Revolute) {
                is_meant = Self::check_angles(&name, &table);
            }
            if let Some(read) = entry.as_ref().and_then(|entry| self.interval(entry, dimension)) {
                limits = read;
            }
            let home_item = table.get("home");
            if let Some(item) = &home_item {
                home = item.amount(&self.scope, dimension, "the home value").unwrap_or(home);
            }
            if is_meant && !(limits[0]..=limits[1]).contains(&home) {
                let span = home_item.map(|item| item.span()).or(entry.map(|entry| entry.span()));
                let message = format!("home of `{name}` is outside its limits");
                let label = format!("home is {home}, the limits are {} to {}", limits[0], limits[1]);
                let mistake = Diagnostic::new(span.unwrap_or(item.key_span.clone()), message).label(label);
                item.document.mistake(mistake.help("give a `home` within the limits; it is 0 if not given"));
            }
        }
        self.set_range(&name, limits);
        let kind = kind.unwrap_or(VariableKind::Revolute);
        let description = table.optional_text("description");
        let list = if is_passive { &mut self.passive } else { &mut self.variables };
        list.push(Variable { name, kind, limits, home, description, frame });
        Some(symbol)
    }

    /// Records limits and a home of a revolute joint that are probably in degrees, and returns
    /// `true` if there are none.
    fn check_angles(name: &str, table: &Section<'_>) -> bool {
        let before = table.document.mistakes();
        if let Some(home) = table.get("home") {
            check_angle_item(&home, &format!("home of `{name}`"));
        }
        for limit in table.get("limits").map_or_else(Vec::new, |limits| limits.list()) {
            check_angle_item(&limit, &format!("a limit of `{name}`"));
        }
        table.document.mistakes() == before
    }

    /// Reads the value of a parameter or input: `x = 5`, `x = "5 mm"` or `x = { value = "5 mm", …
    /// }`.
    fn valued<'d>(
        &self,
        item: &Item<'d>,
        known: &Keys,
        what: &str,
    ) -> (Option<(f64, Dimension)>, Option<Section<'d>>) {
        let entry =
            Entry { dimension: None, what: &format!("the value of a {what}"), names: Allowed::Nothing };
        if !item.is_table() {
            return (item.constant(&self.scope, entry), None);
        }
        let Some(table) = item.table(format!("the {what} `{}`", item.key), &[known]) else {
            return (None, None);
        };
        let value = table.required("value");
        (value.and_then(|value| value.constant(&self.scope, entry)), Some(table))
    }

    /// Reads the two ends of an interval, the lower one first.
    pub(super) fn interval(&self, item: &Item<'_>, dimension: Dimension) -> Option<[f64; 2]> {
        let what = format!("an end of `{}`", item.key);
        let ends: [Item<'_>; 2] = item.entries("two numbers, lower and upper")?;
        let [lower, upper] = ends.map(|end| end.amount(&self.scope, dimension, &what));
        let (lower, upper) = (lower?, upper?);
        if lower > upper {
            let help = "write the lower end first";
            let mistake = Diagnostic::new(item.span(), format!("the ends of `{}` are reversed", item.key));
            return item.document.fail(mistake.label(format!("{lower} is more than {upper}")).help(help));
        }
        Some([lower, upper])
    }

    fn set_range(&mut self, name: &str, range: [f64; 2]) {
        if let Some(name) = self.scope.names.get_mut(name) {
            name.range = range;
        }
    }

    fn declare(
        &mut self,
        name: &str,
        span: Span,
        symbol: Symbol,
        dimension: Option<Dimension>,
        document: &Document,
    ) {
        // An invalid name is declared anyway, so that its uses are not reported as well.
        check_identifier(name, span.clone(), document);
        if self.scope.tables.iter().any(|table| table.name == name) {
            let message = format!("duplicate name `{name}`: there is a table with this name");
            document.mistake(Diagnostic::new(span, message).help("rename one of them"));
            return;
        }
        if let Some(first) = self.scope.names.get(name) {
            let message = format!("duplicate name `{name}`");
            let help = "rename one; parameters, inputs and variables share one namespace";
            let mistake = Diagnostic::new(span, message).label("second declaration");
            document.mistake(mistake.context(first.span.clone(), "first declaration").help(help));
            return;
        }
        let range = [f64::NEG_INFINITY, f64::INFINITY];
        self.scope.names.insert(name.to_owned(), Name { symbol, dimension, span, range });
    }
}
