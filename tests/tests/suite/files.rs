//! Every test file belongs to an executable: integration tests of a crate form one, `tests/suite`,
//! and those with requirements another, `tests/needs`.

use std::fs;
use std::path::{Path, PathBuf};

fn entries(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path()).collect()
}

fn stem(path: &Path) -> &str {
    path.file_stem().unwrap().to_str().unwrap()
}

#[test]
fn every_file_is_a_module_of_one_executable() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folders = entries(&root).into_iter().flat_map(|folder| [entries(&folder), vec![folder]].concat());
    let mut executables = 0;
    for folder in folders.filter(|folder| folder.join("Cargo.toml").exists() && !folder.ends_with("python")) {
        for executable in entries(&folder.join("tests")) {
            let main = executable.join("main.rs");
            // Run by name, not by default.
            let apart = ["instructions", "kernels"].contains(&stem(&executable));
            assert!(apart || main.exists(), "{}: a module of `suite` or `needs`", executable.display());
            let Ok(main) = fs::read_to_string(main) else { continue };
            executables += 1;
            let modules = entries(&executable).into_iter().filter(|path| {
                path.join("mod.rs").exists() || path.extension().is_some_and(|kind| kind == "rs")
            });
            for module in modules.filter(|path| stem(path) != "main") {
                let line = format!("mod {};\n", stem(&module));
                assert!(main.contains(&line), "{} has no `{}`", executable.display(), line.trim());
            }
        }
    }
    assert!(executables >= 6, "{executables}");
}
