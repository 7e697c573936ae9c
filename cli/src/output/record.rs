//! Which files abbe wrote: `.abbe-written`, in every folder in which it wrote any, has the SHA-256 and the name of each, as
//! `sha256sum` prints them. A file that is still one of them is abbe's, and may be replaced; any other is somebody's.
//!
//! One rule for all kinds of files: CSV has no room for a mark, and a mark would not say that a file was changed by hand.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

use abbe_study::hash;

use super::target::parent;

/// The record of a folder.
const NAME: &str = ".abbe-written";

const HEAD: &str = "# SHA-256 of the files that abbe wrote here. It replaces them as long as they are unchanged; others it \
                    replaces only with --force.\n";

/// Whether there is a record in a folder.
pub(super) fn is_in(folder: &Path) -> bool {
    fs::symlink_metadata(folder.join(NAME)).is_ok_and(|found| found.is_file())
}

/// Whether a file is abbe's, or has nothing in it.
pub(super) fn is_ours(file: &Path) -> io::Result<bool> {
    if fs::metadata(file)?.len() == 0 {
        return Ok(true);
    }
    if !is_in(parent(file)) {
        return Ok(false);
    }
    let line = line(file, &hash::of_reader(File::open(file)?)?);
    let record = fs::read(parent(file).join(NAME))?;
    Ok(String::from_utf8_lossy(&record).lines().any(|known| known == line))
}

/// Notes that a file with this SHA-256 is abbe's.
pub(super) fn add(file: &Path, hash: &str) -> io::Result<()> {
    let path = parent(file).join(NAME);
    if fs::symlink_metadata(&path).is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::other(format!("{NAME} is no file")));
    }
    let mut record = File::options().read(true).append(true).create(true).open(path)?;
    let mut known = Vec::new();
    record.read_to_end(&mut known)?;
    let (known, line) = (String::from_utf8_lossy(&known), line(file, hash));
    if known.lines().any(|known| known == line) {
        return Ok(());
    }
    let before = match &*known {
        "" => HEAD,
        known if known.ends_with('\n') => "",
        _ => "\n",
    };
    // In one step: runs at the same time append whole lines.
    record.write_all(format!("{before}{line}\n").as_bytes())
}

fn line(file: &Path, hash: &str) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    format!("{hash}  {}", name.replace(['\n', '\r'], "?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_ours_until_it_is_changed() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a  b, c.csv");
        fs::write(&file, "1,2\n").unwrap();
        assert!(!is_ours(&file).unwrap());
        add(&file, &hash::of_text("1,2\n")).unwrap();
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
                    add(&file, &hash::of_text(&i.to_string())).unwrap();
                }
            })
        });
        writers.collect::<Vec<_>>().into_iter().for_each(|writer| writer.join().unwrap());
        let record = fs::read_to_string(folder.path().join(NAME)).unwrap();
        let mut lines: Vec<&str> = record.lines().filter(|line| !line.starts_with('#')).collect();
        lines.sort_unstable();
        let mut expected: Vec<String> = (0..8)
            .flat_map(|writer| (0..20).map(move |i| (writer, i)))
            .map(|(writer, i)| line(Path::new(&format!("{writer}.csv")), &hash::of_text(&i.to_string())))
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
        add(&file, &hash::of_text("1\n")).unwrap();
        assert!(is_ours(&file).unwrap());
    }
}
