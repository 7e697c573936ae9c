//! Tests of `record.rs`.

use super::*;

#[test]
fn a_file_is_ours_until_it_is_changed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a  b, c.csv");
    fs::write(&file, "1,2\n").unwrap();
    assert!(!is_ours(&file).unwrap());
    add(&file, &hash::text("1,2\n")).unwrap();
    assert!(is_ours(&file).unwrap());
    fs::write(&file, "1,3\n").unwrap();
    assert!(!is_ours(&file).unwrap());
    fs::write(&file, "").unwrap();
    assert!(is_ours(&file).unwrap());
}

#[test]
fn runs_at_the_same_time_lose_nothing_and_repeat_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let writers = (0..8).map(|writer| {
        let file = folder.path().join(format!("{writer}.csv"));
        std::thread::spawn(move || {
            for i in (0..20).chain(0..20) {
                add(&file, &hash::text(&i.to_string())).unwrap();
            }
        })
    });
    writers.collect::<Vec<_>>().into_iter().for_each(|writer| writer.join().unwrap());
    let record = fs::read_to_string(folder.path().join(NAME)).unwrap();
    let mut lines: Vec<&str> = record.lines().filter(|line| !line.starts_with('#')).collect();
    lines.sort_unstable();
    let mut expected: Vec<String> = (0..8)
        .flat_map(|writer| (0..20).map(move |i| (writer, i)))
        .map(|(writer, i)| line(Path::new(&format!("{writer}.csv")), &hash::text(&i.to_string())))
        .collect();
    expected.sort_unstable();
    assert_eq!(lines, expected);
}

#[test]
fn a_line_that_was_cut_off_spoils_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.csv");
    fs::write(&file, "1\n").unwrap();
    fs::write(folder.path().join(NAME), format!("{HEAD}0123")).unwrap();
    add(&file, &hash::text("1\n")).unwrap();
    assert!(is_ours(&file).unwrap());
}
