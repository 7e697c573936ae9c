//! Paths are bytes, not text.
#![cfg(target_os = "linux")]

use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;

use crate::running::abbe;

#[test]
fn paths_of_any_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let name = |bytes: &[u8]| folder.path().join(OsStr::from_bytes(bytes));
    let (spec, map, data) = (name(b"arm\xff.toml"), name(b"\xfe.toml"), name(b"data \xff\n.csv"));
    let (found, page) = (name(b"found\xff.toml"), name(b"page\xff.html"));
    fs::write(&spec, abbe_manipulators::SHIPPED.iter().find(|shipped| shipped.name == "ur5").unwrap().spec)
        .unwrap();
    fs::write(&map, abbe_manipulators::MAPS.iter().find(|(name, _)| *name == "ur5").unwrap().1).unwrap();
    let run = |words: &[&OsStr]| {
        let run = abbe(words);
        assert_eq!(run.status, 0, "{}", run.stderr);
    };
    let word = OsStr::new;
    let (spec, map, data) = (spec.as_os_str(), map.as_os_str(), data.as_os_str());
    run(&[word("check"), spec]);
    run(&[word("simulate"), spec, word("--map"), map, word("--samples"), word("40"), word("--out"), data]);
    let out = [word("--out"), found.as_os_str(), word("--report"), page.as_os_str()];
    run(&[&[word("identify"), spec, data, word("--map"), map][..], &out].concat());
    run(&[word("check"), found.as_os_str()]);
    assert!(page.exists());
    // A study beside it is found, too.
    fs::write(name(b"arm\xff.study.toml"), "[study]\ntitle = \"Any\"\n[workspace.joints]\nsamples = 5\n")
        .unwrap();
    assert!(abbe(&[word("analyze"), spec]).stdout.contains("Study     Any\n"));
}
