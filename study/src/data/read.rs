//! Reads a map from top to bottom.

use std::path::Path;
use std::sync::Arc;

use abbe::identify::{Uncertainty, register};
use abbe_codegen::diagnostic::{Diagnostic, Diagnostics};
use abbe_codegen::document::{Document, Item, Section};
use abbe_codegen::expr::{Allowed, Dimension, Entry, Scope, find_name, parse_value};
use abbe_codegen::spec::{Spec, VariableKind};

use super::column::{Channel, Column};
use super::configurations::resolution;
use super::keys;
use super::map::{Base, Layout, Map, Target};
use super::turn::{Order, Turn};

impl Map {
    /// The map in a file, or the one shipped under that name.
    pub fn find(argument: &Path, spec: &Spec) -> Result<Self, Diagnostics> {
        let name = argument.to_string_lossy();
        let shipped = abbe_manipulators::MAPS.iter().find(|(shipped, _)| *shipped == name);
        match shipped {
            Some((name, text)) if !argument.exists() => {
                Self::from_document(Document::new(format!("maps/{name}.toml"), *text), spec)
            }
            _ => Self::from_document(Document::read(argument)?, spec),
        }
    }

    /// The map that a text is; `path` is what mistakes are shown under.
    pub fn parse(path: &str, text: &str, spec: &Spec) -> Result<Self, Diagnostics> {
        Self::from_document(Document::new(path, text), spec)
    }

    fn from_document(mut document: Document, spec: &Spec) -> Result<Self, Diagnostics> {
        let text = Arc::clone(&document.text);
        let tables = document.tables(&text);
        let map = tables.and_then(|tables| read_map(&Section::root(&tables), &mut document, spec));
        document.finish(map)
    }
}

fn read_map(root: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Map> {
    if !document.is_kind(root, "data") {
        return None;
    }
    root.check_keys(&[&keys::FILE, &keys::FORMS], document);
    let mut head = root.required("data", document).and_then(|item| document.section(&item))?;
    head.name = "[data]".to_owned();
    head.check_keys(&[&keys::DATA], document);
    let joints = joints(root, document, spec);
    let inputs = inputs(root, document, spec);
    let layout = layout(root, document, spec);
    let length = head.required("uncertainty", document);
    let length = length.and_then(|item| positive(&item, document, spec, Dimension::LENGTH));
    let is_pose = matches!(layout, Some(Layout::Pose(..)));
    let angle = match head.get("angle_uncertainty") {
        Some(item) => positive(&item, document, spec, Dimension::NONE),
        None if is_pose => {
            head.required("angle_uncertainty", document);
            None
        }
        None => Some(1.0),
    };
    let mut named = |key: &str| match head.get(key) {
        Some(item) => column(&item, document).map(Some),
        None => Some(None),
    };
    let (group, time) = (named("group"), named("time"));
    let bases = [("known", Base::Known), ("unknown", Base::Unknown), ("exact", Base::Exact)];
    let base = match head.get("base") {
        Some(item) => document.choice(&item, &bases)?,
        None => Base::Known,
    };
    Some(Map {
        title: head.optional_text("title", document),
        uncertainty: Uncertainty { length: length?, angle: angle? },
        base,
        joints: joints?,
        inputs: inputs?,
        layout: layout?,
        group: group?,
        time: time?,
        resolution: resolution(spec),
        path: document.path.clone(),
        text: Arc::clone(&document.text),
    })
}

fn positive(item: &Item<'_>, document: &mut Document, spec: &Spec, dimension: Dimension) -> Option<f64> {
    let value = constant(item, document, spec, dimension)?;
    if value > 0.0 {
        return Some(value);
    }
    let mistake = Diagnostic::new(item.span(), format!("`{}` must be more than zero", item.key));
    document.mistake(mistake.help("say what the instrument's data sheet says: one standard deviation"));
    None
}

fn constant(item: &Item<'_>, document: &mut Document, spec: &Spec, dimension: Dimension) -> Option<f64> {
    let scope = Scope::new(spec.length);
    let what = format!("`{}`", item.key);
    let entry = Entry { dimension: Some(dimension), what: &what, names: Allowed::Nothing };
    document.constant(item, &scope, entry).map(|(value, _)| value)
}

fn joints(root: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Vec<Channel>> {
    let section = root.required("joints", document).and_then(|item| document.section(&item))?;
    let names: Vec<&str> = spec.variables.iter().map(|variable| variable.name.as_str()).collect();
    for item in section.items() {
        find_name(document, item.key_span.clone(), &item.key, &names, "variable");
    }
    let channels = spec.variables.iter().map(|variable| {
        let dimension = match variable.kind {
            VariableKind::Revolute => Dimension::NONE,
            VariableKind::Prismatic => Dimension::LENGTH,
        };
        let Some(item) = section.get(&variable.name) else {
            let name = &variable.name;
            let message = format!("`{name}` has no column");
            let help = format!(
                "add `{name} = {{ column = \"…\", unit = \"…\" }}`, or `{name} = {{ value = 0 }}` if it stays"
            );
            document.mistake(Diagnostic::new(section.span.clone(), message).help(help));
            return None;
        };
        channel(&item, document, spec, dimension)
    });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

fn inputs(root: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Vec<Channel>> {
    let section = match root.get("inputs") {
        Some(item) => Some(document.section(&item)?),
        None => None,
    };
    let names: Vec<&str> = spec.inputs.iter().map(|input| input.name.as_str()).collect();
    for item in section.iter().flat_map(Section::items) {
        find_name(document, item.key_span.clone(), &item.key, &names, "input");
    }
    let channels =
        spec.inputs.iter().map(|input| match section.as_ref().and_then(|section| section.get(&input.name)) {
            Some(item) => channel(&item, document, spec, input.dimension),
            None => Some(Channel::Fixed(input.value)),
        });
    let channels: Vec<Option<Channel>> = channels.collect();
    channels.into_iter().collect()
}

/// `{ column = "…", unit = "…", sign = -1 }` or `{ value = … }`.
fn channel(item: &Item<'_>, document: &mut Document, spec: &Spec, dimension: Dimension) -> Option<Channel> {
    let mut section = document.section(item)?;
    section.name = format!("`{}`", item.key);
    section.check_keys(&[&keys::CHANNEL], document);
    if let Some(value) = section.get("value") {
        return constant(&value, document, spec, dimension).map(Channel::Fixed);
    }
    let column = section.required("column", document).and_then(|item| column(&item, document));
    let factor = unit(&section, document, spec, dimension);
    let sign = match section.get("sign") {
        Some(item) => match constant(&item, document, spec, Dimension::NONE)? {
            sign if sign.abs() == 1.0 => sign,
            _ => {
                document.mistake(
                    Diagnostic::new(item.span(), "a sign is 1 or -1").help("a factor belongs into `unit`"),
                );
                return None;
            }
        },
        None => 1.0,
    };
    Some(Channel::Column(column?, factor? * sign))
}

fn column(item: &Item<'_>, document: &mut Document) -> Option<Column> {
    document.string(item).map(|name| Column { name, span: Some(item.span()) })
}

fn columns<const N: usize>(section: &Section<'_>, key: &str, document: &mut Document) -> Option<[Column; N]> {
    let item = section.required(key, document)?;
    let items: [Item<'_>; N] = document.entries(&item, &format!("{N} names of columns"))?;
    let columns: Vec<Column> = items.iter().filter_map(|item| column(item, document)).collect();
    columns.try_into().ok()
}

/// What the numbers are multiplied with: `unit`, a text such as "deg".
fn unit(section: &Section<'_>, document: &mut Document, spec: &Spec, dimension: Dimension) -> Option<f64> {
    let item = section.required("unit", document)?;
    let name = document.string(&item)?;
    let text = format!("1 {name}");
    let mut line = Document::new("", text.as_str());
    let what = format!("the unit `{}`", name.escape_debug());
    let factor = parse_value(&mut line, 0..text.trim_end().len(), spec.length, dimension, &what);
    if let (None, Some(found)) = (factor, line.found.into_iter().next()) {
        let help = found.help.unwrap_or_else(|| "write `mm`, `deg`, `kg` …".to_owned());
        document.mistake(Diagnostic::new(item.span(), found.message).help(help));
    }
    factor
}

fn layout(root: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Layout> {
    let mut forms = root.items().filter(|item| keys::FORMS.contain(&item.key));
    let (Some(form), None) = (forms.next(), forms.next()) else {
        let message = "a map says once what was measured";
        let help = "give one of `[point]`, `[difference]`, `[[target]]` (three or more) and `[pose]`";
        document.mistake(Diagnostic::new(0..0, message).help(help));
        return None;
    };
    if form.key == "target" {
        return targets(&form, document, spec);
    }
    let mut section = document.section(&form)?;
    section.name = format!("[{}]", form.key);
    let factor = unit(&section, document, spec, Dimension::LENGTH);
    match form.key.as_str() {
        "point" => {
            section.check_keys(&[&keys::POINT], document);
            Some(Layout::Point(columns(&section, "columns", document)?, factor?))
        }
        "difference" => {
            section.check_keys(&[&keys::DIFFERENCE], document);
            let target = columns(&section, "target", document);
            Some(Layout::Difference(target?, columns(&section, "difference", document)?, factor?))
        }
        _ => {
            section.check_keys(&[&keys::POSE, &keys::TURN], document);
            let position = columns(&section, "position", document);
            Some(Layout::Pose(position?, factor?, turn(&section, document, spec)?))
        }
    }
}

fn turn(section: &Section<'_>, document: &mut Document, spec: &Spec) -> Option<Turn> {
    if section.get("matrix").is_some() {
        return Some(Turn::Matrix(Box::new(columns(section, "matrix", document)?)));
    }
    if let Some(item) = section.get("quaternion") {
        let section = document.section(&item)?;
        section.check_keys(&[&keys::QUATERNION], document);
        let order = section.required("order", document)?;
        let order = document.choice(&order, &[("wxyz", Order::Wxyz), ("xyzw", Order::Xyzw)]);
        return Some(Turn::Quaternion(Box::new(columns(&section, "columns", document)?), order?));
    }
    let Some(item) = section.get("euler") else {
        let help = "give `quaternion`, `matrix` or `euler`";
        document.mistake(Diagnostic::new(section.span.clone(), "this pose has no orientation").help(help));
        return None;
    };
    let section = document.section(&item)?;
    section.check_keys(&[&keys::EULER], document);
    let orders = [
        ("xyz", [0, 1, 2]),
        ("xzy", [0, 2, 1]),
        ("yxz", [1, 0, 2]),
        ("yzx", [1, 2, 0]),
        ("zxy", [2, 0, 1]),
        ("zyx", [2, 1, 0]),
    ];
    let order = section.required("order", document).and_then(|item| document.choice(&item, &orders));
    let factor = unit(&section, document, spec, Dimension::NONE);
    Some(Turn::Euler(Box::new(columns(&section, "columns", document)?), order?, factor?))
}

fn targets(item: &Item<'_>, document: &mut Document, spec: &Spec) -> Option<Layout> {
    let items = document.array(item, "tables, each a [[target]]")?;
    let mut targets = Vec::new();
    for item in &items {
        let mut section = document.section(item)?;
        section.span = item.span();
        section.name = "this [[target]]".to_owned();
        section.check_keys(&[&keys::TARGET], document);
        let columns = columns(&section, "columns", document);
        let factor = unit(&section, document, spec, Dimension::LENGTH);
        let position = section.required("position", document)?;
        let position: [Item<'_>; 3] =
            document.entries(&position, "three lengths in the frame of the tool")?;
        let [x, y, z] = position.map(|item| constant(&item, document, spec, Dimension::LENGTH));
        targets.push(Target { columns: columns?, factor: factor?, position: [x?, y?, z?] });
    }
    let positions: Vec<[f64; 3]> = targets.iter().map(|target| target.position).collect();
    let mistake = match register(&positions, &positions) {
        None => "three targets make a frame; this has fewer",
        Some(found) if found.breadth < 1e-3 => {
            "these targets are in line: a turn about that line cannot be seen"
        }
        Some(_) => return Some(Layout::Targets(targets)),
    };
    let help = "move one of them out of the line, or measure a single one as `[point]`";
    document.mistake(Diagnostic::new(item.key_span.clone(), mistake).help(help));
    None
}
