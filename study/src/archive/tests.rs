//! Tests of `archive.rs`.

use super::*;

#[test]
fn the_checksum_is_that_of_the_catalogue() {
    assert_eq!(crc32(b"123456789"), 0xcbf4_3926);
    assert_eq!(crc32(b""), 0);
}

/// Reads all files of an archive through its central directory.
fn read(archive: &[u8]) -> Vec<(String, String)> {
    let at16 = |at: usize| u16::from_le_bytes(archive[at..at + 2].try_into().unwrap());
    let at32 = |at: usize| u32::from_le_bytes(archive[at..at + 4].try_into().unwrap());
    let text = |at: usize, len: usize| String::from_utf8(archive[at..at + len].to_vec()).unwrap();
    let end = archive.len() - 22;
    assert_eq!(at32(end), END_OF_DIRECTORY);
    let mut at = at32(end + 16) as usize;
    let mut files = Vec::new();
    for _ in 0..at16(end + 10) {
        assert_eq!((at32(at), at32(at + 38)), (CENTRAL_HEADER, MODE));
        let (start, size) = (at32(at + 42) as usize, at32(at + 24) as usize);
        let name = text(at + 46, at16(at + 28).into());
        assert_eq!(at32(start), LOCAL_HEADER);
        assert_eq!(archive[start + 4..start + 30], archive[at + 6..at + 32]);
        let content = text(start + 30 + name.len(), size);
        assert_eq!(crc32(content.as_bytes()), at32(at + 16));
        at += 46 + name.len();
        files.push((name, content));
    }
    assert_eq!(at, end);
    files
}

#[test]
fn files_round_trip() {
    let file = |(name, text): &(&str, &str)| SourceFile { name: (*name).into(), text: (*text).into() };
    let files = [("a.xml", "<a/>\n"), ("sources/größe.c", ""), ("b", "ÄÖ\0\n")];
    let written = archive(&files.iter().map(file).collect::<Vec<_>>());
    let read = read(&written);
    assert!(read.iter().map(|(name, text)| (name.as_str(), text.as_str())).eq(files));
    assert_eq!(archive(&[]).len(), 22);
}
