//! Tests of `outputs.rs`.

use super::*;

/// A folder that becomes a link before the files are complete: nothing is written through it.
#[test]
fn nothing_is_written_through_a_folder_that_became_a_link() {
    let root = tempfile::tempdir().unwrap();
    let [own, moved, foreign] = ["own", "moved", "foreign"].map(|name| root.path().join(name));
    fs::create_dir(&own).unwrap();
    fs::create_dir(&foreign).unwrap();
    let mut outputs = Outputs::new(&(), false);
    let file = outputs.file(&own.join("a.csv")).and_then(|file| file.fill("1,2\n")).unwrap();
    fs::rename(&own, &moved).unwrap();
    std::os::unix::fs::symlink(&foreign, &own).unwrap();
    assert!(outputs.finish([file]).is_err());
    assert_eq!(fs::read_dir(&foreign).unwrap().count(), 0);
}
