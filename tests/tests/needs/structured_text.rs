//! Generated Structured Text is valid by a grammar that others wrote, tree-sitter's for IEC
//! 61131-3, and PLCopen documents by the classes of the schema of TC6 XML.
//!
//! `PYTHON` names a Python that has `tree-sitter`, `tree-sitter-iec61131-3-st`, `plcopen` and
//! `xsdata`, if `python3` has none of them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use abbe_codegen::print::Language;
use abbe_manipulators::SHIPPED;
use abbe_spec::Spec;
use abbe_tests::chains::long_chain;
use abbe_tests::languages::NAMES;
use abbe_tests::needs::{Missing, Tests, python};

pub(crate) const TESTS: Tests = &[("tree_sitter", tree_sitter), ("schema", schema)];

fn tree_sitter() -> Result<(), Missing> {
    let python = python("tree_sitter, tree_sitter_iec61131_3_st")?;
    let folder = tempfile::tempdir().unwrap();
    for spec in specs() {
        let file = Language::StructuredText.files(&spec).remove(0);
        let path = folder.path().join(&file.name);
        fs::write(&path, &file.text).unwrap();
        let parsed = run(&python, "parse_st.py", &path);
        assert!(parsed.status.success(), "{}", String::from_utf8_lossy(&parsed.stderr));
        // The grammar is not satisfied by anything.
        fs::write(&path, file.text.replacen("END_IF;", "END_IF", 1).replacen("END_FOR;", "", 1)).unwrap();
        assert!(
            !run(&python, "parse_st.py", &path).status.success(),
            "{}: a wrong text is accepted",
            spec.name
        );
    }
    Ok(())
}

fn schema() -> Result<(), Missing> {
    let python = python("plcopen, xsdata")?;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("machine.xml");
    for spec in specs() {
        let document = Language::Plcopen.files(&spec).remove(0).text;
        fs::write(&path, &document).unwrap();
        let read = run(&python, "check_plcopen.py", &path);
        assert!(read.status.success(), "{}: {}", spec.name, String::from_utf8_lossy(&read.stderr));
        // The classes are not satisfied by anything.
        fs::write(&path, document.replacen("<body>", "<text>", 1).replacen("</body>", "</text>", 1)).unwrap();
        assert!(!run(&python, "check_plcopen.py", &path).status.success(), "{}", spec.name);
    }
    Ok(())
}

/// Returns the shipped manipulators, and machines with long chains, names, tables and loops.
fn specs() -> impl Iterator<Item = Spec> {
    let shipped = SHIPPED.iter().map(|one| Spec::parse(&format!("{}.toml", one.name), one.spec).unwrap());
    let others = [
        Spec::parse("long.toml", &long_chain()).unwrap(),
        Spec::parse("names.toml", NAMES).unwrap(),
        Spec::read(abbe_tests::specs::path("measured")).unwrap(),
        Spec::read(abbe_tests::specs::path("linkage")).unwrap(),
        Spec::read(abbe_tests::specs::path("planar")).unwrap(),
    ];
    shipped.chain(others)
}

fn run(python: &str, script: &str, path: &Path) -> Output {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("languages").join(script);
    Command::new(python).arg(script).arg(path).output().unwrap()
}
