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
    for marked in [&b"\xff\xfe-N"[..], b"\xfe\xffN-", &utf_16] {
        let help = "save it as UTF-8, or write it with `abbe … --out FILE` instead of `>`";
        assert_eq!(not_text(marked).unwrap().help, help);
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
    let folder = Bounded::read_all(Path::new("/"), most);
    assert_eq!(unfit(folder), "this is a directory, not a file");
}
