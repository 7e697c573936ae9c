//! Rust bindings of the generated code: declarations, modules, and a list of all functions.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// Names of our functions: the common name of the benchmark, and our own.
const OURS: [(&str, &str); 4] = [
    ("dense", "error_jacobian"),
    ("distinct", "error_jacobian_distinct"),
    ("displacement", "displacement"),
    ("covariance", "covariance"),
];

/// Writes `bindings.rs` for the generated C, C++ and Rust. A peer's file contains the function that
/// it is named after; one of ours contains those of a manipulator.
pub fn write(out: &Path, c: &[PathBuf], cpp: &[PathBuf], rust: &[PathBuf], ours: &[PathBuf]) {
    let name = |path: &PathBuf| path.file_stem().expect("a name").to_string_lossy().into_owned();
    let mut text = String::from("unsafe extern \"C\" {\n");
    let mut list = String::new();
    let mut entry = |name: &str, function: &str| {
        writeln!(list, "    (\"{name}\", {function}),").expect("a string takes everything");
    };
    for name in c.iter().chain(cpp).map(name) {
        text.push_str(&format!("    fn {name}(q: *const f64, second: *mut f64, result: *mut f64);\n"));
        entry(&name, &name);
    }
    let mut own = String::new();
    for manipulator in ours.iter().map(name) {
        for (kind, function) in OURS {
            let function = format!("{manipulator}_{function}");
            text.push_str(&format!(
                "    fn {function}(q: *const f64, second: *mut f64, result: *mut f64) -> i32;\n"
            ));
            own.push_str(&format!("    (\"{manipulator}_{kind}\", {function}),\n"));
        }
    }
    text.push_str("}\n");
    for path in rust {
        let name = name(path);
        text.push_str(&format!("mod {name} {{ include!({path:?}); }}\n"));
        entry(&name, &format!("{name}::{name}"));
    }
    text.push_str(&format!(
        "/// Every function by its name.\npub const FUNCTIONS: &[(&str, Function)] = &[\n{list}];\n"
    ));
    text.push_str(&format!("/// Ours in C.\npub const OURS: &[(&str, Ours)] = &[\n{own}];\n"));
    fs::write(out.join("bindings.rs"), text).expect("the bindings");
}
