//! The gallery in `docs/gallery.md` and its pictures: the first screen, the manipulator and the
//! shares of its sources, as `abbe analyze` writes them for every shipped manipulator.
//! `UPDATE_EXPECT=1` writes them.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use abbe_manipulators::MECHANISMS;
use expect_test::expect_file;

use super::analyses::{Analysis, analysis};
use super::running::json;

/// Largest size of a picture, in bytes.
const LARGEST_PICTURE: usize = 10_000;

const HEAD: &str = "\
# Gallery: the shipped manipulators

These manipulators come with `abbe`: every command takes their name instead of a file, and their specs in
[`manipulators/specs`](../manipulators/specs) are examples to start from. `abbe list` prints their names. The pictures
and the figures are those of `abbe analyze NAME --out DIR`. The `reference` of each source in a spec says where its
error comes from; many are assumptions.

| name | manipulator | joints | error sources | largest error |
|---|---|---|---|---|
";

const TAIL: &str = "
## Your own

A file beside your data needs no place here: `abbe analyze arm.toml` and `abbe identify arm.toml data.csv --map map.toml`
take it. To add a machine to the shipped ones,

1. write `manipulators/specs/NAME.toml`, with the `reference` of its lengths and of each source, and a line in
   `manipulators/src/shipped.rs`. The tests hold it to every law, and write its section and pictures here
   (`UPDATE_EXPECT=1 cargo test -p abbe-cli gallery`);
2. if measurements of it are public, write `manipulators/maps/NAME.toml` for them, as for `ur5` and `wam`: its `reference`
   says who measured, where the file is, at which version, and under which licence. The file itself stays where it is;
3. identify it by one part of the data, and judge it by another: `abbe identify NAME fit.csv --map NAME --test other.csv`.
   What is said of it, such as the two rows in the [README](../README.md), is compared with that by
   `cli/tests/needs/measured_data.rs`, which is reported as ignored where the data are not.
";

#[test]
fn the_page_shows_what_analyze_writes() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs");
    let pictures = docs.join("pictures/gallery");
    fs::create_dir_all(&pictures).unwrap();
    let (mut page, mut sections) = (HEAD.to_owned(), String::new());
    let listed = json(&["list", "--json"]);
    let listed = listed.as_array().expect("a list");
    assert!(listed.len() >= 10);
    for entry in listed {
        let text = |key: &str| entry[key].as_str().expect("text");
        let (name, title) = (text("name"), text("title"));
        // Machines with loops have a chapter of their own.
        if MECHANISMS.iter().any(|(known, _)| *known == name) {
            continue;
        }
        let Analysis { screen, files, .. } = analysis(name);
        // The verdict, the figures and the sources: three blocks of the first screen.
        let blocks = screen.trim_end().split("\n\n").take(3).collect::<Vec<_>>();
        let figure = blocks[1].split_whitespace().skip(2).take(2).collect::<Vec<_>>().join(" ");
        let sources = entry["sources"].as_u64().expect("a count");
        let joints = text("joints");
        writeln!(page, "| [`{name}`](#{name}) | {title} | {joints} | {sources} | {figure} |").unwrap();
        writeln!(sections, "\n## {name}\n").unwrap();
        for (written, suffix, caption) in [
            ("manipulator", "", format!("Frames of the {title} at home")),
            ("pareto", "-sources", "Share of each of its sources".to_owned()),
        ] {
            let picture = &files[&format!("{written}.svg")];
            assert!(picture.len() < LARGEST_PICTURE, "{name}: {} bytes", picture.len());
            expect_file![pictures.join(format!("{name}{suffix}.svg"))].assert_eq(picture);
            writeln!(sections, "![{caption}](pictures/gallery/{name}{suffix}.svg)").unwrap();
        }
        writeln!(sections, "\n```text\n$ abbe analyze {name}\n{}\n```", blocks.join("\n\n")).unwrap();
    }
    page.push_str(
        "\nR is a revolute joint, P a prismatic one, F a frame without a joint, from the base to the tool.\n",
    );
    page.push_str(&sections);
    page.push_str(TAIL);
    expect_file![docs.join("gallery.md")].assert_eq(&page);
}
