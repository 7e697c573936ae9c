//! Generates the module of the shipped positioner. For a folder of your own specs one line
//! suffices: `abbe_codegen::compile("specs")`.

use std::path::Path;

fn main() {
    let spec = Path::new("../../manipulators/specs/pps.toml");
    println!("cargo:rerun-if-changed={}", spec.display());
    let spec = abbe_spec::Spec::read(spec).expect("the spec is right");
    let out = std::env::var_os("OUT_DIR").expect("cargo says where to write");
    std::fs::write(Path::new(&out).join("pps.rs"), abbe_codegen::print::rust(&spec))
        .expect("it can be written");
}
