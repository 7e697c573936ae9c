//! Tests of `archive.rs`.

use std::io::Read;

use zip::ZipArchive;

use super::*;

#[test]
fn files_round_trip() {
    let file = |(name, text): &(&str, &str)| SourceFile { name: (*name).into(), text: (*text).into() };
    let files = [("a.xml", "<a/>\n"), ("sources/größe.c", ""), ("b", "ÄÖ\0\n")];
    let written = archive(&files.iter().map(file).collect::<Vec<_>>());
    let mut read = ZipArchive::new(Cursor::new(&written)).unwrap();
    assert_eq!(read.len(), files.len());
    for (i, (name, text)) in files.into_iter().enumerate() {
        let mut file = read.by_index(i).unwrap();
        let mut content = String::new();
        file.read_to_string(&mut content).unwrap();
        assert_eq!((file.name(), content.as_str(), file.unix_mode()), (name, text, Some(0o100_644)));
        assert_eq!(file.last_modified().map(|date| date.year()), Some(1980));
    }
    assert_eq!(archive(&[]).len(), 22);
}
