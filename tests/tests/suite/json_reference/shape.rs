//! Shapes of the JSON: what serde makes of each type.

use std::collections::BTreeMap;

use syn::{Expr, GenericArgument, Lit, PathArguments, Type};

use super::source::{Attributes, Data, Definition, FieldSource, Kind, Sources, Variant};
use super::unit;

/// Shape of a value in JSON.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Shape {
    Boolean,
    Integer,
    Number,
    Text,
    /// One of several texts, each with its sentence.
    Choice(Vec<(String, String)>),
    /// List, and its length if it is fixed.
    List(Box<Shape>, Option<usize>),
    /// List of values of several shapes.
    Tuple(Vec<Shape>),
    /// Object with names of the machine as keys.
    Map(Box<Shape>),
    /// Value that may be null.
    Optional(Box<Shape>),
    /// Object, by its name in `Shapes`.
    Group(String),
    /// One of several texts, or an object with exactly one of the fields of a group.
    Variant(Vec<(String, String)>, String),
}

/// Object with known fields.
#[derive(Debug)]
pub(super) struct Group {
    /// Sentences about the group.
    pub(super) documentation: String,
    pub(super) fields: Vec<Field>,
}

/// Field of an object.
#[derive(Debug)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) documentation: String,
    pub(super) shape: Shape,
    /// Left out of some reports.
    pub(super) may_be_absent: bool,
    /// Unit that the sentences of a flattened group say.
    common_unit: Option<&'static str>,
}

impl Group {
    /// Returns the unit of a field: `None` if it has no numbers, or if nothing says it.
    pub(super) fn unit(&self, field: &Field) -> Option<&'static str> {
        let said = || unit::said(&field.documentation);
        let common = || unit::common(&self.documentation).or(field.common_unit);
        field.shape.has_numbers().then(|| said().or_else(common)).flatten()
    }
}

impl Shape {
    /// Returns true for numbers with a unit, and lists and maps of them.
    pub(super) fn has_numbers(&self) -> bool {
        match self {
            Self::Number => true,
            Self::List(inner, _) | Self::Optional(inner) | Self::Map(inner) => inner.has_numbers(),
            _ => false,
        }
    }
}

/// All groups below the reports, by their unique names.
pub(super) struct Shapes<'s> {
    sources: &'s Sources,
    pub(super) groups: BTreeMap<String, Group>,
    /// Modules of the types that have a name.
    names: BTreeMap<String, Vec<String>>,
}

impl<'s> Shapes<'s> {
    pub(super) fn new(sources: &'s Sources) -> Self {
        Self { sources, groups: BTreeMap::new(), names: BTreeMap::new() }
    }

    /// Adds the report at this path and all groups below it under a name.
    pub(super) fn add(&mut self, name: &str, path: &str) -> Shape {
        let path: Vec<String> = path.split("::").map(str::to_owned).collect();
        let definition = self.sources.find(&path, None).unwrap_or_else(|| panic!("no type {path:?}"));
        self.group(name.to_owned(), definition)
    }

    fn group(&mut self, name: String, definition: &'s Definition) -> Shape {
        if self.names.insert(name.clone(), definition.module.clone()).is_none() {
            let Kind::Struct(fields) = &definition.kind else { panic!("{name} has no fields") };
            let group = Group {
                documentation: sentences(&definition.attributes.documentation),
                fields: fields.iter().flat_map(|field| self.fields(field, definition)).collect(),
            };
            self.groups.insert(name.clone(), group);
        }
        Shape::Group(name)
    }

    /// Returns the fields that a field becomes: none, one, or those of a flattened group.
    fn fields(&mut self, field: &FieldSource, within: &'s Definition) -> Vec<Field> {
        let FieldSource { name, of_type, attributes } = field;
        if attributes.skip {
            return Vec::new();
        }
        let documentation = sentences(&attributes.documentation);
        if attributes.flatten {
            return match attributes.serialize_with.as_deref() {
                Some("by_axis") => ["x", "y", "z", "norm"]
                    .map(|name| Field {
                        name: name.to_owned(),
                        documentation: documentation.clone(),
                        shape: Shape::Optional(Box::new(Shape::Number)),
                        may_be_absent: false,
                        common_unit: None,
                    })
                    .into(),
                None => self.flattened(of_type, within),
                Some(other) => panic!("{}: {other} is not in the table", within.name),
            };
        }
        let shape = match attributes.serialize_with.as_deref() {
            None => self.shape(of_type, within),
            Some("class" | "distribution") => Shape::Text,
            Some("is_met") => Shape::Boolean,
            Some("crate::finite::or_null" | "abbe_study::finite::or_null") => {
                match self.shape(of_type, within) {
                    Shape::List(inner, length) => Shape::List(Box::new(Shape::Optional(inner)), length),
                    number => Shape::Optional(Box::new(number)),
                }
            }
            Some("serialize_values") => Shape::Map(Box::new(Shape::Number)),
            Some(other) => panic!("{}: {other} is not in the table", within.name),
        };
        let name = attributes.rename.clone().unwrap_or_else(|| name.clone());
        let shape = match (attributes.skip_if, shape) {
            (true, Shape::Optional(inner)) => *inner,
            (_, shape) => shape,
        };
        vec![Field { name, documentation, shape, may_be_absent: attributes.skip_if, common_unit: None }]
    }

    fn flattened(&mut self, of_type: &Type, within: &'s Definition) -> Vec<Field> {
        let path = path(of_type).expect("a flattened type");
        let definition = self.sources.find(&path, Some(within)).expect("a flattened type");
        let Kind::Struct(fields) = &definition.kind else { panic!("{path:?} has no fields") };
        let unit = unit::common(&sentences(&definition.attributes.documentation));
        let fields = fields.iter().flat_map(|field| self.fields(field, definition));
        fields.map(|field| Field { common_unit: field.common_unit.or(unit), ..field }).collect()
    }

    fn shape(&mut self, of_type: &Type, within: &'s Definition) -> Shape {
        match of_type {
            Type::Reference(reference) => self.shape(&reference.elem, within),
            Type::Slice(slice) => Shape::List(Box::new(self.shape(&slice.elem, within)), None),
            Type::Array(array) => {
                let length = match &array.len {
                    Expr::Lit(length) => match &length.lit {
                        Lit::Int(length) => length.base10_parse().ok(),
                        _ => None,
                    },
                    _ => None,
                };
                Shape::List(Box::new(self.shape(&array.elem, within)), length)
            }
            Type::Tuple(tuple) => {
                Shape::Tuple(tuple.elems.iter().map(|one| self.shape(one, within)).collect())
            }
            Type::Path(named) => {
                let last = named.path.segments.last().expect("a type");
                let of: Vec<&Type> = match &last.arguments {
                    PathArguments::AngleBracketed(arguments) => arguments
                        .args
                        .iter()
                        .filter_map(|one| match one {
                            GenericArgument::Type(inner) => Some(inner),
                            _ => None,
                        })
                        .collect(),
                    _ => Vec::new(),
                };
                let inner = |shapes: &mut Self, i: usize| Box::new(shapes.shape(of[i], within));
                match last.ident.to_string().as_str() {
                    "f32" | "f64" => Shape::Number,
                    "bool" => Shape::Boolean,
                    "u8" | "u16" | "u32" | "u64" | "usize" | "i8" | "i16" | "i32" | "i64" | "isize" => {
                        Shape::Integer
                    }
                    "str" | "String" | "PathBuf" => Shape::Text,
                    "Named" => Shape::Map(Box::new(Shape::Number)),
                    "RunRecord" => Shape::Map(Box::new(Shape::Text)),
                    "Cow" => Shape::Text,
                    "Arc" | "Rc" | "Box" => *inner(self, 0),
                    "Option" => Shape::Optional(inner(self, 0)),
                    "Vec" => Shape::List(inner(self, 0), None),
                    "BTreeMap" | "HashMap" | "IndexMap" => Shape::Map(inner(self, 1)),
                    name => self.named(name, &path(of_type).expect("a path"), within),
                }
            }
            _ => panic!("{}: this type is not in the table", within.name),
        }
    }

    fn named(&mut self, name: &str, path: &[String], within: &'s Definition) -> Shape {
        let found = self.sources.find(path, Some(within));
        let definition = found.unwrap_or_else(|| panic!("{}: no type {path:?}", within.name));
        match &definition.kind {
            Kind::Struct(_) => {
                let name = self.unique(name, definition);
                self.group(name, definition)
            }
            Kind::Transparent(inner) => self.shape(inner, definition),
            Kind::Enum(variants) => self.variants(name, variants, definition),
            Kind::Other => panic!("{}: {name} is not in the table", within.name),
        }
    }

    fn variants(&mut self, name: &str, variants: &'s [Variant], definition: &'s Definition) -> Shape {
        let case = definition.attributes.rename_all.as_deref();
        let named = |one: &Variant| variant(&one.name, &one.attributes, case);
        let said = |one: &Variant| sentences(&one.attributes.documentation);
        let plain = variants.iter().filter(|one| matches!(one.data, Data::None));
        let plain: Vec<_> = plain.map(|one| (named(one), said(one))).collect();
        if plain.len() == variants.len() {
            return Shape::Choice(plain);
        }
        let name = self.unique(name, definition);
        if self.names.insert(name.clone(), definition.module.clone()).is_none() {
            let fields = variants.iter().filter_map(|one| {
                let shape = match &one.data {
                    Data::None => return None,
                    Data::Tuple(types) if types.len() == 1 => self.shape(&types[0], definition),
                    Data::Tuple(types) => {
                        Shape::Tuple(types.iter().map(|of_type| self.shape(of_type, definition)).collect())
                    }
                    Data::Fields(fields) => {
                        let inner = format!("{name}{}", one.name);
                        let fields = fields.iter().flat_map(|field| self.fields(field, definition)).collect();
                        self.groups.insert(inner.clone(), Group { documentation: said(one), fields });
                        Shape::Group(inner)
                    }
                };
                Some(Field {
                    name: named(one),
                    documentation: said(one),
                    shape,
                    may_be_absent: true,
                    common_unit: None,
                })
            });
            let fields = fields.collect();
            let documentation = sentences(&definition.attributes.documentation);
            self.groups.insert(name.clone(), Group { documentation, fields });
        }
        Shape::Variant(plain, name)
    }

    /// Returns the name of a type, with that of its module if another type has it.
    fn unique(&self, name: &str, definition: &Definition) -> String {
        let mut candidate = name.to_owned();
        for module in definition.module.iter().rev() {
            match self.names.get(&candidate) {
                Some(other) if *other != definition.module => {
                    let camel: String = module.split('_').map(capitalized).collect();
                    if camel != name {
                        candidate = camel + name;
                    }
                }
                _ => break,
            }
        }
        candidate
    }
}

pub(super) fn capitalized(word: &str) -> String {
    let mut letters = word.chars();
    letters
        .next()
        .map(|first| first.to_uppercase().collect::<String>() + letters.as_str())
        .unwrap_or_default()
}

fn variant(name: &str, attributes: &Attributes, case: Option<&str>) -> String {
    let separated = |separator: char| {
        name.char_indices().fold(String::new(), |mut text, (i, letter)| {
            if letter.is_uppercase() && i > 0 {
                text.push(separator);
            }
            text.extend(letter.to_lowercase());
            text
        })
    };
    match (&attributes.rename, case) {
        (Some(name), _) => name.clone(),
        (None, Some("lowercase")) => name.to_lowercase(),
        (None, Some("snake_case")) => separated('_'),
        (None, Some("kebab-case")) => separated('-'),
        (None, None) => name.to_owned(),
        (None, Some(case)) => panic!("{case} is not in the table"),
    }
}

fn path(of_type: &Type) -> Option<Vec<String>> {
    match of_type {
        Type::Path(named) => Some(named.path.segments.iter().map(|part| part.ident.to_string()).collect()),
        _ => None,
    }
}

/// Joins the lines of a doc comment to paragraphs, and keeps the text of links alone.
fn sentences(documentation: &str) -> String {
    let mut text = String::new();
    for line in documentation.lines().map(str::trim) {
        match (line.is_empty(), text.is_empty() || text.ends_with('\n')) {
            (true, false) => text.push('\n'),
            (true, true) => {}
            (false, true) => text += line,
            (false, false) => {
                text.push(' ');
                text += line;
            }
        }
    }
    let mut plain = String::new();
    let mut rest = text.trim_end();
    while let Some(start) = rest.find("[`") {
        let Some(end) = rest[start..].find("`]").map(|end| start + end) else { break };
        plain += &rest[..start];
        plain += &rest[start + 1..=end];
        rest = &rest[end + 2..];
        if let Some(target) = rest.strip_prefix('(') {
            rest = target.split_once(')').map_or("", |(_, rest)| rest);
        }
    }
    plain + rest
}
