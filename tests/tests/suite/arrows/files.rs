//! Dependencies between the files of a crate: the paths in their sources, resolved through
//! re-exports. Methods and `#[cfg(test)]` modules are ignored.

use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Source file of a crate.
pub(crate) struct File {
    /// Path of its module. Empty for `lib.rs` and `main.rs`.
    pub(crate) module: Vec<String>,
    /// Path below `src`.
    pub(crate) name: String,
    pub(crate) text: String,
}

/// Returns the source files of a folder, except those of tests.
pub(crate) fn files(source: &Path) -> Vec<File> {
    let mut files = Vec::new();
    collect(source, &[], &mut files);
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files
}

fn collect(folder: &Path, module: &[String], files: &mut Vec<File>) {
    for entry in fs::read_dir(folder).expect("a folder of sources").flatten() {
        let (path, name) = (entry.path(), entry.file_name().into_string().expect("names are UTF-8"));
        let stem = name.strip_suffix(".rs").unwrap_or(&name);
        if stem == "tests" {
            continue;
        }
        let own = [module, &[stem.to_owned()]].concat();
        if path.is_dir() {
            collect(&path, &own, files);
        } else if name.ends_with(".rs") {
            let is_folder = ["mod", "lib", "main"].contains(&stem);
            files.push(File {
                module: if is_folder { module.to_vec() } else { own },
                name: [module, &[name]].concat().join("/"),
                text: fs::read_to_string(path).expect("a source file"),
            });
        }
    }
}

/// Content of a source: its imports, its exports, and every path in it.
#[derive(Default)]
struct Source {
    /// Full paths by their local names. For `pub use` these are re-exports.
    imports: HashMap<String, Vec<String>>,
    /// Modules that are re-exported as a whole.
    globs: Vec<Vec<String>>,
    /// Names of its items.
    defined: BTreeSet<String>,
    /// Full paths that it uses.
    paths: Vec<Vec<String>>,
}

/// Returns the files that each file uses.
pub(crate) fn arrows(files: &[File]) -> Vec<Vec<usize>> {
    let modules: HashMap<&[String], usize> =
        files.iter().enumerate().map(|(i, file)| (&file.module[..], i)).collect();
    let is_module = |path: &[String]| modules.contains_key(path);
    let sources: Vec<Source> = files
        .iter()
        .map(|file| {
            let tokens: TokenStream =
                file.text.parse().unwrap_or_else(|error| panic!("{}: {error}", file.name));
            let mut source = Source::default();
            read(tokens, &file.module, &is_module, &mut source);
            source
        })
        .collect();
    let find = |path: &[String]| resolve(path, &modules, &sources, 0);
    files
        .iter()
        .enumerate()
        .map(|(i, _)| {
            let used: BTreeSet<usize> = sources[i].paths.iter().filter_map(|path| find(path)).collect();
            used.into_iter().filter(|other| *other != i).collect()
        })
        .collect()
}

/// Returns the file that defines the item of a full path. `None` for a module, which counts as used
/// through its items.
fn resolve(
    path: &[String],
    modules: &HashMap<&[String], usize>,
    sources: &[Source],
    depth: usize,
) -> Option<usize> {
    let length = (0..=path.len()).rev().find(|length| modules.contains_key(&path[..*length]))?;
    let (file, name) = (modules[&path[..length]], path.get(length)?);
    let source = &sources[file];
    if depth > 16 {
        return Some(file);
    }
    let through = |target: &[String]| resolve(target, modules, sources, depth + 1);
    if let Some(target) = source.imports.get(name) {
        return through(&[target, &path[length + 1..]].concat());
    }
    if source.defined.contains(name) {
        return Some(file);
    }
    let is_there = |glob: &&Vec<String>| {
        modules.get(&glob[..]).is_some_and(|file| {
            sources[*file].defined.contains(name) || sources[*file].imports.contains_key(name)
        })
    };
    match source.globs.iter().find(is_there) {
        Some(glob) => through(&[glob, &path[length..]].concat()),
        None => Some(file),
    }
}

/// Reads the tokens of a module or of a group in it.
fn read(tokens: TokenStream, module: &[String], is_module: &dyn Fn(&[String]) -> bool, source: &mut Source) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let word = |i: usize| match tokens.get(i) {
        None | Some(TokenTree::Group(_)) => String::new(),
        Some(token) => token.to_string(),
    };
    let group = |i: usize, delimiter: Delimiter| match tokens.get(i) {
        Some(TokenTree::Group(group)) if group.delimiter() == delimiter => Some(group.stream()),
        _ => None,
    };
    let mut i = 0;
    let (mut is_test, mut is_public) = (false, false);
    while i < tokens.len() {
        match (&*word(i), &tokens[i]) {
            ("#", _) => {
                // Attributes are one group each; `#![…]` has one more token.
                let at = if word(i + 1) == "!" { i + 2 } else { i + 1 };
                let attribute = group(at, Delimiter::Bracket).unwrap_or_default().to_string();
                is_test |= attribute.replace(' ', "") == "cfg(test)";
                i = at + 1;
                continue;
            }
            ("pub", _) => {
                is_public = true;
                i += if group(i + 1, Delimiter::Parenthesis).is_some() { 2 } else { 1 };
                continue;
            }
            ("use", _) => {
                let end = (i..tokens.len()).find(|end| word(*end) == ";").unwrap_or(tokens.len());
                let mut leaves = Vec::new();
                flatten(&tokens[i + 1..end], Vec::new(), &mut leaves);
                for (path, name) in leaves {
                    let path = full(path, module, is_module);
                    match (path, &*name) {
                        (Some(path), "*") if is_public => source.globs.push(path),
                        (Some(path), "*") => source.paths.push([path, vec!["*".to_owned()]].concat()),
                        (Some(path), name) => {
                            if !is_public {
                                source.paths.push(path.clone());
                            }
                            source.imports.insert(name.to_owned(), path);
                        }
                        (None, _) => {}
                    }
                }
                i = end;
            }
            ("mod", _) => {
                if let Some(inner) = group(i + 2, Delimiter::Brace).filter(|_| !is_test) {
                    source.defined.insert(word(i + 1));
                    read(inner, &[module, &[word(i + 1)]].concat(), is_module, source);
                }
                i += 2;
            }
            (
                "struct" | "enum" | "trait" | "type" | "union" | "fn" | "const" | "static",
                TokenTree::Ident(_),
            ) => {
                source.defined.insert(word(i + 1));
            }
            ("macro_rules", _) => {
                source.defined.insert(word(i + 2));
            }
            (_, TokenTree::Ident(_)) if i < 2 || word(i - 1) != ":" || word(i - 2) != ":" => {
                let mut path = vec![word(i)];
                while word(i + 1) == ":"
                    && word(i + 2) == ":"
                    && matches!(tokens.get(i + 3), Some(TokenTree::Ident(_)))
                {
                    path.push(word(i + 3));
                    i += 3;
                }
                if path.len() > 1 {
                    let through = source.imports.get(&path[0]).map(|start| [start, &path[1..]].concat());
                    source.paths.extend(through.or_else(|| full(path, module, is_module)));
                }
            }
            (_, TokenTree::Group(group)) => read(group.stream(), module, is_module, source),
            _ => {}
        }
        (is_test, is_public) = (false, false);
        i += 1;
    }
}

/// Collects the leaves of a `use`: their paths, and their local names.
fn flatten(tokens: &[TokenTree], mut path: Vec<String>, leaves: &mut Vec<(Vec<String>, String)>) {
    let mut i = 0;
    while let Some(token) = tokens.get(i) {
        match token {
            TokenTree::Ident(name) if name == "as" => {
                let name = tokens.get(i + 1).map(ToString::to_string).unwrap_or_default();
                leaves.push((path, name));
                return;
            }
            TokenTree::Ident(name) => path.push(name.to_string()),
            TokenTree::Group(group) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                for part in inner.split(|token| token.to_string() == ",") {
                    if !part.is_empty() {
                        flatten(part, path.clone(), leaves);
                    }
                }
                return;
            }
            TokenTree::Punct(sign) if sign.as_char() == '*' => {
                leaves.push((path, "*".to_owned()));
                return;
            }
            _ => {}
        }
        i += 1;
    }
    if path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    let name = path.last().cloned().unwrap_or_default();
    leaves.push((path, name));
}

/// Returns a path from the root of the crate, or `None` if it leads elsewhere.
fn full(path: Vec<String>, module: &[String], is_module: &dyn Fn(&[String]) -> bool) -> Option<Vec<String>> {
    let first = path.first()?.as_str();
    if !["crate", "self", "super"].contains(&first) {
        let child = [module, &path[..1]].concat();
        return is_module(&child).then(|| [module, &path].concat());
    }
    let mut start = if first == "crate" { Vec::new() } else { module.to_vec() };
    let ups = path.iter().take_while(|part| *part == "super").count();
    start.truncate(start.len().saturating_sub(ups));
    let skipped = path.iter().take_while(|part| ["crate", "self", "super"].contains(&part.as_str())).count();
    start.extend(path.into_iter().skip(skipped));
    Some(start)
}
