//! `abbe analyze --out`: the figures and the report.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use abbe_manipulators::SHIPPED;
use roxmltree::Document;
use tempfile::tempdir;

use crate::analyses::analysis;
use crate::explore::without_scripts;
use crate::running::{abbe, full, prints, shipped, write};

/// Reads the files of a folder.
pub(crate) fn files(folder: &Path) -> BTreeMap<String, String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("a file").path());
    let name = |path: &Path| path.file_name().expect("a name").to_string_lossy().into_owned();
    entries.map(|path| (name(&path), fs::read_to_string(&path).expect("a text"))).collect()
}

/// Returns the files that an analysis writes.
fn written(arguments: &[&str]) -> BTreeMap<String, String> {
    let folder = tempdir().expect("a folder");
    let out = folder.path().join("out");
    let out = out.to_str().expect("a path");
    prints(&[&["analyze"], arguments, &["--out", out]].concat());
    files(Path::new(out))
}

/// Asserts that an SVG is well-formed, has a title and numbers, and that all numbers are finite.
fn is_drawn(name: &str, svg: &str) {
    let document = Document::parse(svg).unwrap_or_else(|error| panic!("{name}: {error}"));
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "svg", "{name}");
    let title =
        root.children().find(|node| node.has_tag_name((root.tag_name().namespace().unwrap_or(""), "title")));
    assert!(title.and_then(|title| title.text()).is_some_and(|title| !title.is_empty()), "{name}");
    assert_eq!(root.attribute("role"), Some("img"), "{name}");
    assert!(svg.contains("<desc>") && svg.contains("<path"), "{name}");
    for word in ["NaN", "inf"] {
        let numbers = root.descendants().flat_map(|node| node.attributes());
        assert!(numbers.into_iter().all(|attribute| !attribute.value().contains(word)), "{name}: {word}");
        assert!(!svg.contains(&format!(">{word}<")), "{name}: {word}");
    }
}

/// Asserts that a page loads nothing, and runs no scripts but those that its policy allows: no
/// address, only links to files beside it; and that every figure is drawn.
pub(crate) fn is_alone(report: &str) {
    assert!(report.len() < 1_000_000, "{} bytes", report.len());
    let report = &without_scripts(report);
    for address in ["<script", "http:", "https:", "//cdn", "@import", "url(", "src=", "NaN", "Infinity"] {
        assert!(!report.contains(address), "{address}");
    }
    for link in report.split("href=\"").skip(1) {
        let link = link.split('"').next().unwrap_or_default();
        assert!(link == "data:," || (link.ends_with(".svg") && !link.contains('/')), "{link}");
    }
    let tag = |text: &str| report.matches(text).count();
    assert_eq!(tag("<html"), 1);
    assert_eq!(tag("<figure>"), tag("<svg"));
    for svg in report.split("<svg").skip(1) {
        let svg = &svg[..svg.find("</svg>").expect("its end")];
        is_drawn("a figure of the page", &format!("<svg xmlns=\"http://www.w3.org/2000/svg\"{svg}</svg>"));
    }
}

#[test]
fn the_papers_figures_are_drawn() {
    let files = written(&["pps"]);
    for figure in [
        "manipulator.svg",
        "travel-base-rail-curvature-d1.svg",
        "travel-spin-encoder-q4.svg",
        "surface-arm-deflection-z-q4.svg",
        "cloud.svg",
        "histogram.svg",
        "pareto.svg",
    ] {
        is_drawn(figure, &files[figure]);
    }
    let text = |figure: &str| files[figure].clone();
    assert!(text("travel-base-rail-curvature-d1.svg").contains("±0.22 mm"));
    assert!(text("travel-base-rail-curvature-d1.svg").contains("d1 (mm)"));
    assert!(text("travel-spin-encoder-q4.svg").contains("q4 (deg)"));
    let surface = text("surface-arm-deflection-z-q4.svg");
    for figure in ["here: 0.12 mm", "here: -0.44 mm", "here: 0.2501 mm", "±0.44 mm"] {
        assert!(surface.contains(figure), "{figure}");
    }
    assert!(text("cloud.svg").contains("radius 5.48 mm, including random errors (the paper: 5.48 mm)"));
    for csv in ["configurations.csv", "sources.csv", "unreachable.csv"] {
        assert!(files.contains_key(csv));
    }
    assert_eq!(files.len(), 12, "and nothing else but the record: {:?}", files.keys());
}

/// An arm whose lengths have units.
const UNITS: &str = r#"
[manipulator]
name = "arm"
title = "Arm"
length = "m"
[[frame]]
name = "shoulder"
variable = { name = "q1", kind = "revolute", limits = ["-90 deg", "90 deg"] }
transform = "Rz(q1) Tx(0.4 m)"
[[frame]]
name = "lift"
variable = { name = "d2", kind = "prismatic", limits = ["0 mm", "250 mm"] }
transform = "Tz(d2) Tx(300 mm)"
[[source]]
name = "encoder"
class = "random"
distribution = "normal"
joint = "q1"
error = "0.1 mrad"
[[source]]
name = "foot"
class = "repeatable"
frame = "shoulder"
e_x = "0.2 mm"
[[source]]
name = "seat"
class = "tolerance"
frame = "lift"
e_x = "20 um"
"#;

#[test]
fn errors_are_in_millimetres_whatever_the_unit_of_the_spec() {
    let folder = tempdir().unwrap();
    let [metres, millimetres] = ["m", "mm"].map(|unit| {
        let text = UNITS.replace("length = \"m\"", &format!("length = \"{unit}\""));
        let (spec, out) = (write(folder.path(), "arm.toml", &text), folder.path().join(unit));
        let tolerance = ["--tolerance", "0.25 mm", "--out", out.to_str().unwrap()];
        let screen =
            full(&[&["analyze", spec.to_str().unwrap(), "--monte-carlo", "2000"], &tolerance[..]].concat());
        // Where several configurations are equally bad, rounding chooses one.
        let (errors, _) = screen.split_once("Norms of the errors").expect("a table");
        let errors = errors.lines().filter(|line| !line.contains("d2 =")).map(str::to_owned);
        let page = &files(&out)["report.html"];
        let cards = page.lines().filter(|line| line.contains("class=\"card\"")).map(str::to_owned);
        errors.chain(cards).collect::<Vec<_>>()
    });
    assert_eq!(metres, millimetres);
    assert!(metres.iter().any(|line| line.contains("<b>0.3041 mm</b>")), "{metres:?}");
}

#[test]
fn the_report_stands_alone() {
    let files = written(&["pps"]);
    let report = &files["report.html"];
    is_alone(report);
    assert_eq!(report.matches("<section class=\"abbe-panel\"></section>").count(), 1);
    // The figures of the study. All are printed on paper, too.
    assert_eq!(report.matches("<div class=\"picture\"><svg").count(), 7);
    let (_, paper) = report.split_once("@media print").expect("a style for paper");
    let (paper, _) = paper.split_once("</style>").expect("its end");
    assert!(!paper.contains("display: none"));
    // The inputs.
    let shipped = SHIPPED.iter().find(|shipped| shipped.name == "pps").expect("it is shipped");
    for text in [shipped.spec, shipped.study.expect("it has a study")] {
        let hash = sha256(text);
        assert!(report.contains(&hash), "{hash}");
    }
    // Conventions, verdicts and limitations.
    for words in [
        "spin about Y, roll about Z, pitch about X",
        "misses by 4 %",
        "Not reproducible from the paper",
        "cf. Figure 11 of the paper",
        "Cannot be known",
        "5.4798 mm",
    ] {
        assert!(report.contains(words), "{words}");
    }
}

fn sha256(text: &str) -> String {
    use sha2::{Digest, Sha256};
    Sha256::digest(text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn the_same_input_gives_the_same_files() {
    assert!(written(&["pps"]) == written(&["pps"]));
}

#[test]
fn every_shipped_manipulator_has_a_report() {
    for shipped in SHIPPED {
        let files = &analysis(shipped.name).files;
        is_alone(&files["report.html"]);
        assert!(files.contains_key("manipulator.svg"), "{}", shipped.name);
        for (name, svg) in files.iter().filter(|(name, _)| name.ends_with(".svg")) {
            is_drawn(name, svg);
        }
    }
}

/// Only published figures have verdicts.
#[test]
fn verdicts_have_a_column_where_there_are_any() {
    for (arguments, any) in [(&["pps"][..], true), (&["scara"], false)] {
        let page = &written(arguments)["report.html"];
        assert_eq!(page.contains(">agreement</th>"), any, "{arguments:?}");
    }
}

#[test]
fn a_folder_that_cannot_be_written_to_stays_as_it_was() {
    let folder = tempdir().expect("a folder");
    // A folder has the name of one of the files: no other file may appear.
    let out = folder.path().join("out");
    fs::create_dir_all(out.join("report.html")).expect("a folder");
    let run = abbe(&["analyze", "pps", "--force", "--out", out.to_str().expect("a path")]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("report.html"), "{}", run.stderr);
    let left = fs::read_dir(&out).expect("a folder").map(|entry| entry.expect("a file").file_name());
    assert_eq!(left.collect::<Vec<_>>(), ["report.html"]);
}

#[test]
fn a_study_says_which_figures() {
    let folder = tempdir().expect("a folder");
    let study = |figures: &str| {
        let head = "[study]\ntitle = \"T & <T>\"\n[workspace.joints]\nsamples = 700\n";
        let path = write(folder.path(), "study.toml", &format!("{head}{figures}"));
        path.to_str().expect("a path").to_owned()
    };
    let one = study("[[figure]]\nkind = \"travel\"\nover = \"q4\"\ncaption = \"<b> & \\\"b\\\"\"\n");
    let files = written(&["pps", "--study", &one]);
    let figures = files.keys().filter(|name| name.ends_with(".svg")).collect::<Vec<_>>();
    assert_eq!(figures, ["travel-q4.svg"]);
    is_drawn("travel-q4.svg", &files["travel-q4.svg"]);
    assert!(files["report.html"].contains("&lt;b&gt; &amp; &quot;b&quot;"));

    // The page names a disabled source as disabled.
    let off = study("[[figure]]\nkind = \"cloud\"\nsource = \"assembly\"\n");
    let files = written(&["pps", "--study", &off, "--disable", "assembly"]);
    assert!(files["report.html"].contains("“assembly” is disabled"));

    for (figures, message) in [
        ("kind = \"travl\"", "`kind` cannot be `travl`"),
        ("kind = \"travel\"", "`over` is missing"),
        ("kind = \"travel\"\nover = \"q9\"", "q9"),
        ("kind = \"surface\"\nover = [\"q4\"]", "two names"),
        ("kind = \"cloud\"\nsource = \"rail\"", "source"),
        ("kind = \"pareto\"\nover = \"q4\"", "there is no key `over`"),
        ("kind = \"cloud\"\n[[figure]]\nkind = \"cloud\"", "duplicate figure"),
    ] {
        let bad = study(&format!("[[figure]]\n{figures}\n"));
        let run = abbe(&["analyze", "pps", "--study", &bad]);
        assert_eq!(run.status, 2, "{figures}");
        assert!(run.stderr.contains(message), "{}", run.stderr);
    }
}

#[test]
fn a_spec_without_sources_or_with_one_point_is_drawn_too() {
    let folder = tempdir().expect("a folder");
    let spec = r#"
        [manipulator]
        name = "slide"
        length = "m"
        [[frame]]
        name = "carriage"
        variable = { name = "d", kind = "prismatic", limits = ["0 m", "1 m"] }
        transform = "Tx(d)"
    "#;
    let path = write(folder.path(), "slide.toml", spec);
    let files = written(&[path.to_str().expect("a path")]);
    is_drawn("manipulator.svg", &files["manipulator.svg"]);

    let source =
        "[[source]]\nname = \"s\"\nclass = \"random\"\ndistribution = \"normal\"\nframe = \"carriage\"\n";
    let path = write(folder.path(), "slide.toml", &format!("{spec}{source}e_x = \"1e-6\"\n"));
    let study = "[study]\ntitle = \"T\"\n[workspace.grid]\nd = [\"0.5 m\"]\n";
    let study = write(folder.path(), "study.toml", study);
    let files = written(&[path.to_str().expect("a path"), "--study", study.to_str().expect("a path")]);
    for (name, svg) in files.iter().filter(|(name, _)| name.ends_with(".svg")) {
        is_drawn(name, svg);
    }
    is_alone(&files["report.html"]);
    assert!(shipped("pps").contains("pps"));
}
