//! Dependencies between crates, and between the files of a crate, have no cycles.

mod circles;
mod crates;
mod files;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use self::crates::CRATES;
use self::files::{File, files};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("the tests are in a folder of the workspace")
        .to_owned()
}

/// Returns the crates of this workspace that a manifest depends on, sorted by name, without
/// dev-dependencies.
fn dependencies(manifest: &str) -> Vec<&str> {
    let mut is_counted = false;
    let mut own = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            is_counted = matches!(line, "[dependencies]" | "[build-dependencies]");
        }
        let name = line.split([' ', '.', '=']).next().unwrap_or_default();
        if is_counted && (name == "abbe" || name.starts_with("abbe-")) {
            own.push(name);
        }
    }
    own.sort_unstable();
    own.dedup();
    own
}

#[test]
fn crates_depend_on_what_stands_above_them() {
    for (i, (folder, name, allowed)) in CRATES.iter().enumerate() {
        let text = fs::read_to_string(root().join(folder).join("Cargo.toml")).expect("a manifest");
        assert!(text.starts_with(&format!("[package]\nname = \"{name}\"\n")), "{folder}");
        let mut allowed = allowed.to_vec();
        allowed.sort_unstable();
        assert_eq!(
            dependencies(&text),
            allowed,
            "the table in arrows/crates.rs has the dependencies of {name}"
        );
        for other in allowed {
            let above = CRATES[..i].iter().any(|(_, above, _)| *above == other);
            assert!(above, "{other} does not stand above {name}, which depends on it");
            let path = other.replace('-', "_");
            let uses = [format!("{path}::"), format!("{path} as ")];
            let is_used = sources(folder).iter().any(|file| uses.iter().any(|used| file.text.contains(used)));
            assert!(is_used, "{name} depends on {other} and does not use it");
        }
    }
}

/// Returns the sources of a crate, including its build script.
fn sources(folder: &str) -> Vec<File> {
    let mut sources = files(&root().join(folder).join("src"));
    if let Ok(text) = fs::read_to_string(root().join(folder).join("build.rs")) {
        sources.push(File { module: Vec::new(), name: "build.rs".to_owned(), text });
    }
    sources
}

#[test]
fn the_map_names_every_crate() {
    let text = fs::read_to_string(root().join("CONTRIBUTING.md")).expect("CONTRIBUTING.md");
    let map = text.split("```").nth(1).expect("a map in a code block");
    let places: Vec<usize> = CRATES
        .iter()
        .map(|(folder, name, _)| {
            let line = map.lines().position(|line| {
                let mut words = line.split_whitespace();
                words.next() == Some(&format!("{folder}/")) && words.next() == Some(name)
            });
            line.unwrap_or_else(|| panic!("the map in CONTRIBUTING.md has no line `{folder}/ {name} …`"))
        })
        .collect();
    assert!(places.is_sorted(), "the map in CONTRIBUTING.md has the crates in another order");
}

#[test]
fn files_of_a_crate_have_no_circles() {
    let mut found = Vec::new();
    for (folder, ..) in CRATES {
        let files = files(&root().join(folder).join("src"));
        let names = |circle: Vec<usize>| {
            circle.into_iter().map(|file| format!("{folder}/src/{}", files[file].name)).collect::<Vec<_>>()
        };
        found.extend(circles::circles(&files::arrows(&files)).into_iter().map(names));
    }
    let allowed: Vec<Vec<&str>> = crates::CIRCLES.iter().map(|circle| circle.to_vec()).collect();
    let is_new = |circle: &&Vec<String>| {
        !allowed.iter().any(|allowed| circle.iter().all(|file| allowed.contains(&&**file)))
    };
    let new: Vec<String> = found.iter().filter(is_new).map(|circle| circle.join("\n  ")).collect();
    assert!(new.is_empty(), "these files use each other:\n  {}", new.join("\n\n  "));
    for circle in allowed {
        let is_there = found.iter().any(|found| found.iter().all(|file| circle.contains(&&**file)));
        assert!(is_there, "take this circle out of the list: it is no more\n  {}", circle.join("\n  "));
    }
}

/// The folders and files at the top of a crate: each is one, with all that it contains.
#[test]
fn folders_of_a_crate_have_no_circles() {
    let mut found = Vec::new();
    for (folder, ..) in CRATES {
        let files = files(&root().join(folder).join("src"));
        let rooms: Vec<&str> =
            files.iter().filter_map(|file| file.module.first()).map(String::as_str).collect();
        let rooms: Vec<&str> = rooms.into_iter().collect::<BTreeSet<_>>().into_iter().collect();
        let room = |file: usize| {
            rooms.iter().position(|room| files[file].module.first().is_some_and(|first| first == room))
        };
        let mut between = vec![Vec::new(); rooms.len()];
        for (file, used) in files::arrows(&files).into_iter().enumerate() {
            let others = used.into_iter().filter_map(room);
            if let Some(own) = room(file) {
                between[own].extend(others.filter(|other| *other != own));
            }
        }
        let names =
            |circle: Vec<usize>| circle.into_iter().map(|one| rooms[one]).collect::<Vec<_>>().join(", ");
        found.extend(
            circles::circles(&between).into_iter().map(|circle| format!("{folder}/src: {}", names(circle))),
        );
    }
    assert_eq!(found, crates::CIRCLES_OF_FOLDERS, "these folders use each other");
}
