//! Tests of `table_paths.rs`.

use super::*;

#[test]
fn paths_lead_to_the_same_file() {
    for (file, folder, expected) in [
        ("/a/b/rail.csv", "/a/c", "../b/rail.csv"),
        ("/a/rail.csv", "/a/c/d", "../../rail.csv"),
        ("/a/c/rail.csv", "/a", "c/rail.csv"),
        ("/a/b/../rail.csv", "/a", "rail.csv"),
        ("/b/./rail.csv", "/a", "../b/rail.csv"),
    ] {
        assert_eq!(relative(Path::new(file), Path::new(folder)), expected, "{file}");
    }
}
