//! Robustness: no input causes a panic or a meaningless result. Inputs are damaged files, and specs
//! made to break generated code.
//!
//! Requirements of every input: no panic; an end within seconds; diagnostics with a location and a
//! help; and no NaN or infinity in a result. The inputs are seeded.
//! `ABBE_ABUSE=2000 cargo test -p abbe-tests abuse::` sets their number per kind; `-- --nocapture`
//! prints the figures.

mod compiled;
mod files;
mod jobs;
mod watch;

use std::path::Path;

use abbe_interpreter::Interpreter;
use abbe_metrology::data::{Data, Map};
use abbe_metrology::plan::Sets;
use abbe_spec::Spec;
use abbe_spec::document::Document;
use abbe_study::{Machine, Study};
use abbe_tests::abuse::{Choices, damaged, damaged_table, spec};
use tempfile::tempdir;

use files::{ARM, DATA, MAPS, PLANS, STUDIES, machine};
use jobs::Asked;
use watch::{Figures, many, watched};

/// Returns a file as text, if it is.
fn text(bytes: &[u8]) -> Option<&str> {
    std::str::from_utf8(bytes).ok()
}

#[test]
fn specs() {
    let shipped = abbe_manipulators::SHIPPED.iter().map(|shipped| shipped.spec);
    let all: Vec<&str> = shipped.chain([ARM]).collect();
    let mut figures = Figures::new("specs");
    for seed in 0..many(400) {
        let mut c = Choices::seeded(seed);
        let whole = *c.one_of(&all);
        let file = damaged(&mut c, whole.as_bytes());
        let Some(text) = text(&file) else { continue };
        figures.add(watched("spec", seed, text, || {
            let spec = Spec::parse("damaged.toml", text)?;
            let of = |machine| jobs::of_spec(machine, seed % 8 == 0);
            of(Machine::of_spec(spec, "damaged.toml"))
        }));
    }
    figures.print();
}

#[test]
fn random_specs() {
    let mut figures = Figures::new("random specs");
    for seed in 0..many(120) {
        let text = spec(&mut Choices::seeded(seed), "arm");
        figures.add(watched("random spec", seed, &text, || {
            let spec = Spec::parse("random.toml", &text)?;
            jobs::of_spec(Machine::of_spec(spec, "random.toml"), seed % 8 == 0)
        }));
    }
    figures.print();
    assert!(figures.answered * 2 > figures.all(), "most random specs are right");
}

#[test]
fn studies() {
    let machine = machine();
    let mut figures = Figures::new("studies");
    for seed in 0..many(400) {
        let mut c = Choices::seeded(seed);
        let whole = *c.one_of(&STUDIES);
        let file = damaged(&mut c, whole.as_bytes());
        let Some(text) = text(&file) else { continue };
        figures.add(watched("study", seed, text, || {
            let study = Study::read(Document::new("damaged.toml", text), &machine.spec)?;
            jobs::analyze(&machine, study)
        }));
    }
    figures.print();
}

#[test]
fn maps() {
    let machine = machine();
    let folder = tempdir().unwrap();
    let data = folder.path().join("data.csv");
    std::fs::write(&data, DATA).unwrap();
    let mut figures = Figures::new("maps");
    for seed in 0..many(400) {
        let mut c = Choices::seeded(seed);
        let whole = *c.one_of(&MAPS);
        let file = damaged(&mut c, whole.as_bytes());
        let Some(text) = text(&file) else { continue };
        figures.add(watched("map", seed, text, || {
            let map = Map::parse("damaged.toml", text, &machine.spec)?;
            jobs::of_data(&machine, &map, &data, Asked::numbered(seed))
        }));
    }
    figures.print();
}

#[test]
fn data() {
    let machine = machine();
    let map = Map::parse("map.toml", MAPS[0], &machine.spec).unwrap();
    let folder = tempdir().unwrap();
    let path = folder.path().join("data.csv");
    let mut figures = Figures::new("data");
    for seed in 0..many(250) {
        let file = damaged_table(&mut Choices::seeded(seed), DATA.as_bytes());
        std::fs::write(&path, &file).unwrap();
        figures.add(watched("data", seed, &String::from_utf8_lossy(&file), || {
            jobs::of_data(&machine, &map, &path, Asked::numbered(seed))
        }));
        assert!(std::fs::read(&path).unwrap() == file, "nothing changes what it reads");
    }
    figures.print();
}

#[test]
fn plans() {
    let machine = machine();
    let map = Map::parse("map.toml", MAPS[0], &machine.spec).unwrap();
    let folder = tempdir().unwrap();
    let path = folder.path().join("plan.toml");
    let mut figures = Figures::new("plans");
    for seed in 0..many(200) {
        let mut c = Choices::seeded(seed);
        let whole = *c.one_of(&PLANS);
        let file = damaged(&mut c, whole.as_bytes());
        std::fs::write(&path, &file).unwrap();
        figures.add(watched("plan", seed, &String::from_utf8_lossy(&file), || {
            jobs::plan(&machine, &map, Sets::find(&path, &machine.spec)?)
        }));
    }
    figures.print();
}

/// Compares the interpreter's real pose with the exact chain, product by product.
#[test]
fn random_specs_are_computed_alike() {
    let mut compared = 0;
    for seed in 0..many(300) {
        let text = abbe_tests::abuse::plain_spec(&mut Choices::seeded(seed));
        let Ok(spec) = Spec::parse("random.toml", &text) else { continue };
        compared += usize::from(jobs::is_computed_alike(&Interpreter::new(spec), seed, &text));
    }
    assert!(compared * 2 > many(300) as usize, "{compared}");
}

/// Checks that a file of another kind is recognized, or at least rejected as unexpected.
#[test]
fn other_files_are_named() {
    let folder = tempdir().unwrap();
    let machine = machine();
    let map = Map::parse("map.toml", MAPS[0], &machine.spec).unwrap();
    let utf_16: Vec<u8> = DATA.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let urdf = "<?xml version=\"1.0\"?>\n<robot name=\"r\"/>\n";
    let rust = abbe_codegen::print::rust(&machine.spec);
    for (name, bytes, said) in [
        ("a.csv.gz", &b"\x1f\x8b\x08\x00\x00\x00"[..], ["gzip", "gzip"]),
        ("a.xlsx", b"PK\x03\x04\x14", ["zip", "zip"]),
        ("a.txt", &utf_16, ["UTF-16", "UTF-16"]),
        ("a.urdf", urdf.as_bytes(), ["XML", "XML"]),
        ("a.rs", rust.as_bytes(), ["source code", "column"]),
        ("a.csv", DATA.as_bytes(), ["table of data", ""]),
        ("a.toml", ARM.as_bytes(), ["", "TOML"]),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let [as_spec, as_data] = [Spec::read(&path).err(), Data::read(&path, &map).err()];
        for (refused, said) in [as_spec, as_data].iter().zip(said) {
            let told = refused.as_ref().map_or(String::new(), ToString::to_string);
            assert!(told.contains(said) && told.is_empty() == said.is_empty(), "{name}, {said}:\n{told}");
        }
    }
    let folder = Spec::read(Path::new("/")).unwrap_err().to_string();
    assert!(folder.contains("directory"), "{folder}");
}

/// Checks that the undamaged files are valid.
#[test]
fn whole_files_are_answered() {
    let machine = machine();
    jobs::of_spec(machine.clone(), true).unwrap();
    for study in STUDIES {
        jobs::analyze(&machine, Study::read(Document::new("study.toml", study), &machine.spec).unwrap())
            .unwrap();
    }
    let folder = tempdir().unwrap();
    let data = folder.path().join("data.csv");
    std::fs::write(&data, DATA).unwrap();
    for map in MAPS {
        let map = Map::parse("map.toml", map, &machine.spec).unwrap();
        for question in 0..6 {
            match jobs::of_data(&machine, &map, &data, Asked::numbered(question)) {
                // Simulations and plans need the uncertainties that one of the maps leaves open.
                Err(refusal) if refusal.to_string().contains("which this map calls unknown") => {}
                answer => answer.unwrap(),
            }
        }
    }
    let map = Map::parse("map.toml", MAPS[0], &machine.spec).unwrap();
    let plan = folder.path().join("plan.toml");
    for sets in PLANS {
        std::fs::write(&plan, sets).unwrap();
        jobs::plan(&machine, &map, Sets::find(&plan, &machine.spec).unwrap()).unwrap();
    }
}
