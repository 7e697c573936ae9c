fn main() {
    abbe_codegen::compile("specs");
}
