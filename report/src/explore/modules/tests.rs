//! Tests of `modules.rs`.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use super::{MODULES, script};

/// Returns the names that a module imports, with their module.
fn imports(module: &str) -> Vec<(String, Vec<String>)> {
    let lines = module.lines().filter(|line| line.starts_with("import "));
    let import = |line: &str| {
        let (names, from) = line
            .strip_prefix("import { ")
            .and_then(|rest| rest.split_once(" } from \"./"))
            .unwrap_or_else(|| panic!("not an import of names on one line: {line}"));
        let names = names.split(", ").map(str::to_owned).collect();
        (from.trim_end_matches("\";").to_owned(), names)
    };
    lines.map(import).collect()
}

/// Returns the names that are declared at the beginning of a line: one, or those of a list.
fn declared(module: &str) -> Vec<(bool, String)> {
    const WORDS: [&str; 5] = ["const ", "let ", "function ", "function* ", "class "];
    let is_of_a_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '$');
    let declarations = |line: &str| {
        let (exported, line) = line.strip_prefix("export ").map_or((false, line), |line| (true, line));
        let line = line.strip_prefix("async ").unwrap_or(line);
        let rest = WORDS.iter().find_map(|word| line.strip_prefix(word)).unwrap_or_default();
        let names = match rest.strip_prefix('[') {
            Some(list) => list.split(']').next().unwrap_or_default(),
            None => rest.split(|c| !is_of_a_name(c)).next().unwrap_or_default(),
        };
        let names = names.split(", ").filter(|name| !name.is_empty());
        names.map(|name| (exported, name.to_owned())).collect::<Vec<_>>()
    };
    module.lines().flat_map(declarations).collect()
}

#[test]
fn every_module_is_in_the_script() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/explore/page");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut files: Vec<String> = files.filter(|name| name.ends_with(".js")).collect();
    let mut modules: Vec<&str> = MODULES.iter().map(|(name, _)| *name).collect();
    files.sort();
    modules.sort_unstable();
    assert_eq!(files, modules);
}

#[test]
fn names_are_unique_and_imports_come_from_earlier_modules() {
    let (mut names, mut exports) = (HashSet::new(), HashSet::new());
    for (name, module) in MODULES {
        for (from, imported) in imports(module) {
            for one in imported {
                assert!(exports.contains(&(from.clone(), one.clone())), "{name}: {one} of {from}");
            }
        }
        for (exported, one) in declared(module) {
            let is_name = one.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '$'));
            assert!(is_name, "{name}: {one}");
            assert!(names.insert(one.clone()), "{one} of {name} is the name of another module, too");
            if exported {
                exports.insert(((*name).to_owned(), one));
            }
        }
    }
}

#[test]
fn the_script_has_no_imports_and_exports() {
    let is_of_a_module = |line: &&str| line.starts_with("import ") || line.starts_with("export ");
    assert_eq!(script().lines().find(is_of_a_module), None);
}
