//! Tests of `bounded.rs`.

use super::*;

#[test]
fn what_is_no_text() {
    let utf_16: Vec<u8> = "name = 1".encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (head, word) in [
        (&b"\x1f\x8b\x08"[..], "gzip"),
        (b"PK\x03\x04", "spreadsheet"),
        (b"\xff\xfea\x00", "UTF-16"),
        (&utf_16, "UTF-16"),
    ] {
        assert!(not_text(head).unwrap().message.contains(word), "{word}");
    }
    for text in ["", "a", "q1,q2\n1,2\n", "\u{feff}[data]", "größe = 1", "a\0b", "\0\0\0"] {
        assert_eq!(not_text(text.as_bytes()), None);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn what_never_ends_is_not_waited_for() {
    let most = 1 << 20;
    let unfit = |result: io::Result<Vec<u8>>| UnreadableFile::from_error(&result.unwrap_err(), "").message;
    let zero = Bounded::read_all(Path::new("/dev/zero"), most);
    assert_eq!(unfit(zero), "this file is larger than 1 MiB");
    let pipe = std::env::temp_dir().join(format!("abbe-nobody-writes-{}", std::process::id()));
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    let mut bytes = Vec::new();
    let read = Bounded::open_patiently(&pipe, most, Duration::from_millis(20))
        .and_then(|mut input| input.read_to_end(&mut bytes));
    assert_eq!(unfit(read.map(|_| bytes)), "no data from this pipe for 0 s");
    fs::remove_file(pipe).unwrap();
    let folder = Bounded::read_all(Path::new("/"), most);
    assert_eq!(unfit(folder), "this is a directory, not a file");
}
