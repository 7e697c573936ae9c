//! Types in the sources of the crates: their fields, their doc comments and what serde makes of
//! them.

use std::fs;
use std::path::Path;

use syn::{Attribute, Expr, Fields, Item, Lit, Meta, Type, UseTree};

use super::crates;

/// A struct, an enum or an alias in a source file.
pub(super) struct Definition {
    pub(super) name: String,
    /// Crate and modules, such as `study`, `analyze`, `report`, `combined`.
    pub(super) module: Vec<String>,
    pub(super) attributes: Attributes,
    pub(super) kind: Kind,
    /// Imports of its file: name, and path without it.
    imports: Vec<(String, Vec<String>)>,
}

pub(super) enum Kind {
    Struct(Vec<FieldSource>),
    /// Tuple struct with one field, or an alias.
    Transparent(Box<Type>),
    Enum(Vec<Variant>),
    Other,
}

pub(super) struct Variant {
    pub(super) name: String,
    pub(super) attributes: Attributes,
    pub(super) data: Data,
}

/// Data of a variant.
pub(super) enum Data {
    None,
    Fields(Vec<FieldSource>),
    Tuple(Vec<Type>),
}

pub(super) struct FieldSource {
    pub(super) name: String,
    pub(super) of_type: Type,
    pub(super) attributes: Attributes,
}

/// Attributes of a type, a field or a variant.
#[derive(Default)]
pub(super) struct Attributes {
    pub(super) documentation: String,
    pub(super) rename: Option<String>,
    pub(super) rename_all: Option<String>,
    pub(super) serialize_with: Option<String>,
    pub(super) skip: bool,
    /// Left out of some reports.
    pub(super) skip_if: bool,
    pub(super) flatten: bool,
}

impl Attributes {
    fn read(attributes: &[Attribute]) -> Self {
        let mut read = Self::default();
        for attribute in attributes {
            if let (true, Meta::NameValue(pair)) = (attribute.path().is_ident("doc"), &attribute.meta)
                && let Expr::Lit(text) = &pair.value
                && let Lit::Str(line) = &text.lit
            {
                read.documentation += &line.value();
                read.documentation.push('\n');
            }
            read.read_serde(attribute);
        }
        read
    }

    /// Reads `serde(…)`, also within `cfg_attr(feature = "serde", …)`.
    fn read_serde(&mut self, attribute: &Attribute) {
        if attribute.path().is_ident("cfg_attr") {
            let _ = attribute.parse_nested_meta(|meta| {
                if meta.path.is_ident("serde") {
                    return meta.parse_nested_meta(|meta| self.read_key(&meta));
                }
                meta.value().and_then(|value| value.parse::<Lit>()).map(drop)
            });
        } else if attribute.path().is_ident("serde") {
            attribute.parse_nested_meta(|meta| self.read_key(&meta)).expect("attributes of serde");
        }
    }

    fn read_key(&mut self, meta: &syn::meta::ParseNestedMeta<'_>) -> syn::Result<()> {
        let key = meta.path.get_ident().map(ToString::to_string).unwrap_or_default();
        let text = || meta.value()?.parse::<syn::LitStr>().map(|text| text.value());
        match key.as_str() {
            "skip" => self.skip = true,
            "flatten" => self.flatten = true,
            "skip_serializing_if" => {
                text()?;
                self.skip_if = true;
            }
            "rename" => self.rename = Some(text()?),
            "rename_all" => self.rename_all = Some(text()?),
            "serialize_with" => self.serialize_with = Some(text()?),
            "with" | "into" | "try_from" | "remote" | "tag" => drop(text()?),
            _ => return Err(meta.error("the generator does not know this attribute")),
        }
        Ok(())
    }
}

/// Every type of the crates that the reports are made of.
pub(super) struct Sources(Vec<Definition>);

impl Sources {
    /// Reads the sources of all crates below the root of the workspace.
    pub(super) fn read(root: &Path) -> Self {
        let mut all = Vec::new();
        for (folder, name) in crates::FOLDERS {
            read_folder(&root.join(folder).join("src"), &[name.to_owned()], &mut all);
        }
        Self(all)
    }

    /// Finds the type that a path in the file of `from` names. Panics if there are several.
    pub(super) fn find(&self, path: &[String], from: Option<&Definition>) -> Option<&Definition> {
        let (name, mut before) = path.split_last().map(|(name, before)| (name.clone(), before.to_vec()))?;
        let mut named: Vec<&Definition> = self.0.iter().filter(|one| one.name == name).collect();
        if let Some(from) = from {
            // What the file imports, or else what is in the file.
            let first = before.first().unwrap_or(&name).clone();
            match from.imports.iter().find(|(imported, _)| *imported == first) {
                Some((_, module)) if before.is_empty() => before.clone_from(module),
                Some((_, module)) => before.splice(0..0, module.iter().cloned()).for_each(drop),
                None if before.is_empty() => named.retain(|one| one.module == from.module),
                None => {}
            }
        }
        let absolute = absolute(&before, from);
        let score = |one: &Definition| {
            let declared = match before.first() {
                Some(first) if absolute.is_none() => crates::declare(first).contains(&one.module[0].as_str()),
                _ => true,
            };
            let below = absolute.as_ref().is_some_and(|module| one.module.starts_with(module));
            let shared = before.iter().filter(|part| one.module.contains(part)).count();
            let nearer = from.map_or(0, |from| {
                from.module.iter().zip(&one.module).take_while(|(one, other)| one == other).count()
            });
            (declared, below, shared, nearer)
        };
        let best = named.iter().map(|one| score(one)).max()?;
        named.retain(|one| score(one) == best);
        assert_eq!(
            named.len(),
            1,
            "{path:?} could be {:?}",
            named.iter().map(|one| &one.module).collect::<Vec<_>>()
        );
        named.first().copied()
    }
}

/// Resolves `crate`, `super` and `self` at the beginning of a path.
fn absolute(path: &[String], from: Option<&Definition>) -> Option<Vec<String>> {
    let mut module = from?.module.clone();
    match path.first()?.as_str() {
        "crate" => module.truncate(1),
        "self" => {}
        "super" => path.iter().take_while(|part| *part == "super").for_each(|_| drop(module.pop())),
        _ => return None,
    }
    module.extend(path.iter().filter(|part| !["crate", "self", "super"].contains(&part.as_str())).cloned());
    Some(module)
}

fn read_folder(folder: &Path, module: &[String], all: &mut Vec<Definition>) {
    for entry in fs::read_dir(folder).expect("a folder of sources").flatten() {
        let path = entry.path();
        let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let inside = || module.iter().cloned().chain([stem.clone()]).collect::<Vec<_>>();
        if path.is_dir() {
            read_folder(&path, &inside(), all);
        } else if path.extension().is_some_and(|kind| kind == "rs") {
            let file = syn::parse_file(&fs::read_to_string(&path).expect("a source")).expect("Rust");
            let module =
                if ["mod", "lib", "main"].contains(&stem.as_str()) { module.to_vec() } else { inside() };
            let mut imports = Vec::new();
            for item in &file.items {
                if let Item::Use(line) = item {
                    imported(&line.tree, &mut Vec::new(), &mut imports);
                }
            }
            all.extend(file.items.into_iter().filter_map(|item| definition(item, &module, &imports)));
        }
    }
}

fn imported(tree: &UseTree, before: &mut Vec<String>, found: &mut Vec<(String, Vec<String>)>) {
    match tree {
        UseTree::Path(path) => {
            before.push(path.ident.to_string());
            imported(&path.tree, before, found);
            before.pop();
        }
        UseTree::Name(name) if name.ident == "self" => {
            found.push((before.last().cloned().unwrap_or_default(), before.clone()));
        }
        UseTree::Name(name) => found.push((name.ident.to_string(), before.clone())),
        UseTree::Rename(name) => found.push((name.rename.to_string(), before.clone())),
        UseTree::Group(group) => group.items.iter().for_each(|tree| imported(tree, before, found)),
        UseTree::Glob(_) => {}
    }
}

fn definition(item: Item, module: &[String], imports: &[(String, Vec<String>)]) -> Option<Definition> {
    let (name, attributes, kind) = match item {
        Item::Struct(item) => {
            let kind = match data(item.fields) {
                Data::Fields(fields) => Kind::Struct(fields),
                Data::Tuple(mut types) if types.len() == 1 => Kind::Transparent(Box::new(types.remove(0))),
                _ => Kind::Other,
            };
            (item.ident, item.attrs, kind)
        }
        Item::Enum(item) => {
            let variants = item.variants.into_iter().map(|variant| Variant {
                name: variant.ident.to_string(),
                attributes: Attributes::read(&variant.attrs),
                data: data(variant.fields),
            });
            (item.ident, item.attrs, Kind::Enum(variants.collect()))
        }
        Item::Type(item) => (item.ident, item.attrs, Kind::Transparent(item.ty)),
        _ => return None,
    };
    let attributes = Attributes::read(&attributes);
    Some(Definition {
        name: name.to_string(),
        module: module.to_vec(),
        attributes,
        kind,
        imports: imports.to_vec(),
    })
}

fn data(fields: Fields) -> Data {
    match fields {
        Fields::Unit => Data::None,
        Fields::Unnamed(fields) => Data::Tuple(fields.unnamed.into_iter().map(|field| field.ty).collect()),
        Fields::Named(fields) => {
            let fields = fields.named.into_iter().map(|field| FieldSource {
                name: field.ident.expect("a name").to_string(),
                attributes: Attributes::read(&field.attrs),
                of_type: field.ty,
            });
            Data::Fields(fields.collect())
        }
    }
}
