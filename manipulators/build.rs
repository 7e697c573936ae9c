//! Generates the module of every spec.
fn main() {
    abbe_codegen::compile("specs");
}
