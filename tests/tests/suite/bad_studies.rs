//! Every mistake in a study, a map, a plan, a URDF file or a DH table is shown with its location,
//! the line, a caret and a help.
//!
//! The files are like those of `bad_specs`: `bad-studies/NAME.toml` is a study of `machine3` with a
//! mistake, `bad-studies/NAME.txt` its diagnostic, and likewise `bad-maps`, `bad-plans`, the robots
//! of `bad-urdfs` and the tables of `bad-tables`. `UPDATE_EXPECT=1 cargo test -p abbe-tests` writes
//! the diagnostics.

use std::path::{Path, PathBuf};

use abbe::LengthUnit;
use abbe_metrology::data::Map;
use abbe_metrology::plan::Sets;
use abbe_spec::DhConvention;
use abbe_spec::diagnostic::Diagnostics;
use abbe_spec::document::Document;
use abbe_study::import::{Format, Import, Units};
use abbe_study::{Machine, Study};
use expect_test::expect_file;

/// Compares the diagnostics of every file of a folder. Paths are relative, so that diagnostics name
/// no folder of this machine.
fn told(folder: &str, ending: &str, least: usize, read: impl Fn(&Path, &Machine) -> Option<Diagnostics>) {
    let machine = Machine::find("machine3").unwrap();
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> =
        entries.filter(|file| file.extension().is_some_and(|e| e == ending)).collect();
    files.sort();
    assert!(files.len() >= least);
    for file in files {
        let mistakes = read(&file, &machine);
        let mistakes =
            mistakes.unwrap_or_else(|| panic!("{} is read as if nothing were wrong", file.display()));
        let text = mistakes.to_string();
        for (part, least) in [("error: ", 1), ("--> ", 1), ("= help: ", mistakes.list.len().min(20))] {
            assert!(text.matches(part).count() >= least, "`{part}` is missing in\n{text}");
        }
        let snapshot = std::env::current_dir().unwrap().join(file.with_extension("txt"));
        expect_file![snapshot].assert_eq(&format!("{text}\n"));
    }
}

#[test]
fn every_study_is_told_what_is_wrong_with_it() {
    told("bad-studies", "toml", 50, |file, machine| {
        Study::read(Document::read(file).unwrap(), &machine.spec).err()
    });
}

#[test]
fn every_map_is_told_what_is_wrong_with_it() {
    told("bad-maps", "toml", 25, |file, machine| Map::find(file, &machine.spec).err());
}

#[test]
fn every_plan_is_told_what_is_wrong_with_it() {
    told("bad-plans", "toml", 10, |file, machine| Sets::find(file, &machine.spec).err());
}

#[test]
fn every_robot_is_told_what_is_wrong_with_it() {
    told("bad-urdfs", "urdf", 30, |file, _| {
        let fold = file.ends_with("nothing_moves.urdf");
        let format = Format::Urdf { base: None, tip: None, fold };
        Import { file: file.to_owned(), format, round_angles: false }.run(&mut ()).err()
    });
}

/// Checks DH tables. The first word of a name is the convention; with `bare` in it, no unit is
/// given.
#[test]
fn every_table_of_numbers_is_told_what_is_wrong_with_it() {
    told("bad-tables", "csv", 20, |file, _| {
        let name = file.file_stem().unwrap().to_str().unwrap();
        let convention = match name.starts_with("modified") {
            true => DhConvention::Modified,
            false => DhConvention::Standard,
        };
        let units = match name.contains("bare") {
            true => Units::default(),
            false => Units { length: Some(LengthUnit::Millimetre), degrees: Some(true) },
        };
        let format = Format::Table { convention, units };
        Import { file: file.to_owned(), format, round_angles: false }.run(&mut ()).err()
    });
}
