//! Generated Structured Text is valid by a grammar that others wrote: tree-sitter's for IEC
//! 61131-3.
//!
//! `PYTHON` names a Python that has `tree-sitter` and `tree-sitter-iec61131-3-st`, if `python3` has
//! neither.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use abbe_codegen::print::Language;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::languages::NAMES;
use abbe_tests::needs::{Missing, Tests, python};
use abbe_tests::specs;

pub(crate) const TESTS: Tests = &[("tree_sitter", tree_sitter)];

fn tree_sitter() -> Result<(), Missing> {
    let python = python("tree_sitter, tree_sitter_iec61131_3_st")?;
    let folder = tempfile::tempdir().unwrap();
    let shipped = SHIPPED.iter().map(|one| Spec::parse(&format!("{}.toml", one.name), one.spec).unwrap());
    let others = [
        Spec::parse("long.toml", &long_chain()).unwrap(),
        Spec::parse("names.toml", NAMES).unwrap(),
        Spec::read(specs::path("measured")).unwrap(),
        Spec::read(specs::path("linkage")).unwrap(),
        Spec::read(specs::path("planar")).unwrap(),
    ];
    for spec in shipped.chain(others) {
        let file = Language::StructuredText.files(&spec).remove(0);
        let path = folder.path().join(&file.name);
        fs::write(&path, &file.text).unwrap();
        let parsed = parse(&python, &path);
        assert!(parsed.status.success(), "{}", String::from_utf8_lossy(&parsed.stderr));
        // The grammar is not satisfied by anything.
        fs::write(&path, file.text.replacen("END_IF;", "END_IF", 1).replacen("END_FOR;", "", 1)).unwrap();
        assert!(!parse(&python, &path).status.success(), "{}: a wrong text is accepted", spec.name);
    }
    Ok(())
}

fn parse(python: &str, path: &Path) -> Output {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("languages/parse_st.py");
    Command::new(python).arg(script).arg(path).output().unwrap()
}
