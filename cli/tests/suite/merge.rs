//! Parts of an analysis: for any division, the merged report is byte for byte that of one run;
//! parts that do not belong together are refused.

use std::fs;
use std::path::{Path, PathBuf};

use abbe_tests::processes::{SECOND, has_ended, processor_time, wait_for};
use abbe_tests::thorough;

use super::running::{abbe, command, prints, shipped, write};

/// One study for each enumeration of configurations: random and even samples, a grid with inputs,
/// tool points of which some are unreachable, and a list.
const STUDIES: [(&str, &str, &str); 6] = [
    (
        "random",
        "pps",
        "[study]\ntitle = \"t\"\ntolerance = { position = \"5 mm\", orientation = \"2 mrad\" }\n\
         [workspace.random]\nsamples = 9000\nseed = 3\n\
         [compensation]\ndefault = 0.1\n[[figure]]\nkind = \"travel\"\nover = \"d1\"\n\
         [[figure]]\nkind = \"surface\"\nover = [\"d1\", \"q4\"]\n[[figure]]\nkind = \"cloud\"\n\
         [[figure]]\nkind = \"histogram\"\nrows = \"orientation\"\n[[figure]]\nkind = \"travel\"\n\
         over = \"d2\"\n[figure.workspace.joints]\nsamples = 50\n",
    ),
    ("even", "scara", "[study]\ntitle = \"t\"\n[workspace.joints]\nsamples = 1000\n"),
    (
        "grid",
        "machine3",
        "[study]\ntitle = \"t\"\ntolerance = \"0.1 mm\"\n[workspace.grid]\nx = { from = 0, to = 600, count = 12 }\n\
         y = { from = 0, to = 400, count = 11 }\nz = { from = 0, to = 450, count = 10 }\n",
    ),
    (
        "box",
        "puma560",
        "[study]\ntitle = \"t\"\n[workspace.box]\nx = { from = \"-1 m\", to = \"1 m\", count = 7 }\n\
         y = { from = \"0 m\", to = \"1 m\", count = 7 }\nz = { from = \"0 m\", to = \"1.2 m\", count = 7 }\n",
    ),
    ("path", "scara", ""),
    ("shipped", "pps", ""),
];

fn part(folder: &Path, spec: &str, options: &[&str], shard: &str) -> PathBuf {
    let file = folder.join(format!("{}.part", shard.replace('/', "-of-")));
    let path = file.to_str().unwrap();
    prints(&[&["analyze", spec, "--shard", shard, "--out", path], options].concat());
    file
}

fn merged<'a>(parts: &'a [PathBuf], options: &[&'a str]) -> Vec<&'a str> {
    let parts = parts.iter().map(|part| part.to_str().unwrap());
    ["merge"].into_iter().chain(parts).chain(options.iter().copied()).collect()
}

#[test]
fn any_division_gives_the_report_of_one_run() {
    let is_tested = |name| thorough() || ["random", "grid", "path"].contains(&name);
    for (name, spec, study) in STUDIES.into_iter().filter(|(name, ..)| is_tested(*name)) {
        let folder = tempfile::tempdir().unwrap();
        let study = match name {
            "shipped" => None,
            "path" => {
                let points = (0..700).map(|i| format!("{}\n", f64::from(i) / 400.0));
                write(folder.path(), "path.csv", &format!("q1 (rad)\n{}", points.collect::<String>()));
                let text = "[study]\ntitle = \"t\"\n[workspace.path]\nfile = \"path.csv\"\n";
                Some(write(folder.path(), "study.toml", text))
            }
            _ => Some(write(folder.path(), "study.toml", study)),
        };
        let study = study.as_ref().map(|path| path.to_str().unwrap());
        let mut options = vec!["--monte-carlo", "500", "--seed", "5"];
        options.extend(study.iter().flat_map(|study| ["--study", study]));
        let whole = folder.path().join("whole");
        let asked = [&["analyze", spec, "--json", "--out", whole.to_str().unwrap()], &options[..]].concat();
        let expected = prints(&asked);
        // An ordinary run has fewer studies and parts.
        let counts = match (name, thorough()) {
            ("random", true) => &[1, 2, 64, 7][..],
            ("random", false) => &[1, 7],
            (_, true) => &[3, 7],
            (_, false) => &[3],
        };
        for &count in counts {
            let made = tempfile::tempdir().unwrap();
            let mut parts = (1..=count)
                .map(|i| part(made.path(), spec, &options, &format!("{i}/{count}")))
                .collect::<Vec<_>>();
            parts.reverse();
            assert_eq!(prints(&merged(&parts, &["--json"])), expected, "{name} in {count}");
            if counts.last() != Some(&count) {
                continue;
            }
            let out = made.path().join("merged");
            let text = prints(&merged(&parts, &["--out", out.to_str().unwrap()]));
            let at_once = prints(&[&["analyze", spec], &options[..]].concat());
            let answer = |text: &str| text.split("\nNext").next().unwrap().to_owned();
            assert_eq!(answer(&text), answer(&at_once));
            for file in fs::read_dir(&whole).unwrap().map(|file| file.unwrap().file_name()) {
                let kept = !["configurations.csv", ".abbe-written"].iter().any(|other| file == *other);
                assert!(out.join(&file).exists() || !kept, "{file:?}");
                if kept {
                    let [one, other] = [&whole, &out].map(|folder| fs::read(folder.join(&file)).unwrap());
                    assert!(one == other, "{name}: {file:?}");
                }
            }
        }
    }
}

/// Holds that parts merge without the files that they were created from, and that parts created
/// from different tables are refused.
#[test]
fn parts_merge_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    const STUDY: &str = "[study]\ntitle = \"beside\"\n[workspace.joints]\nsamples = 200\n";
    let text = shipped("scara").to_owned()
        + "\n[tables.rail]\nfile = \"rail.csv\"\nx = { column = \"x\", unit = \"mm\" }\ny = { column = \"y\", unit = \"um\" }\n\
           interpolation = \"linear\"\n[[source]]\nname = \"rail\"\nclass = \"repeatable\"\nframe = \"stroke\"\ne_y = \"rail(d3)\"\n";
    let at = write(folder.path(), "arm.toml", &text);
    write(folder.path(), "rail.csv", "x,y\n-150,0\n-70,5\n0,0\n");
    write(folder.path(), "arm.study.toml", STUDY);
    let spec = at.to_str().unwrap();
    let expected = prints(&["analyze", spec, "--json"]);
    let parts = ["1/2", "2/2"].map(|shard| part(folder.path(), spec, &["--no-figures"], shard));
    fs::remove_file(&at).unwrap();
    fs::remove_file(folder.path().join("arm.study.toml")).unwrap();
    fs::remove_file(folder.path().join("rail.csv")).unwrap();
    assert_eq!(prints(&merged(&parts, &["--json"])), expected);
    write(folder.path(), "arm.toml", &text);
    write(folder.path(), "arm.study.toml", STUDY);
    write(folder.path(), "rail.csv", "x,y\n-150,0\n-70,6\n0,0\n");
    let other = part(folder.path(), spec, &["--no-figures", "--force"], "2/2");
    let refused = abbe(&merged(&[parts[0].clone(), other], &[]));
    assert_eq!(refused.status, 2);
    assert!(refused.stderr.contains("other input files differ"), "{}", refused.stderr);
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let others = tempfile::tempdir().unwrap();
    let other = |spec, options: &[&str], shard| part(others.path(), spec, options, shard);
    let [one, two] = ["1/2", "2/2"].map(|shard| part(at, "scara", &[], shard));
    let refused = |parts: &[&PathBuf], says: &[&str]| {
        let run = abbe(&merged(&parts.iter().map(|part| (*part).clone()).collect::<Vec<_>>(), &[]));
        assert_eq!((run.status, run.stdout.as_str()), (2, ""));
        for words in says {
            assert!(run.stderr.contains(words), "{words}:\n{}", run.stderr);
        }
    };
    refused(&[&two], &["missing: part 1/2", "abbe analyze scara --shard 1/2 --out FILE"]);
    refused(&[&one, &two, &one], &["this is part 1/2, and so is", "give every part once"]);
    let third = other("scara", &[], "3/9");
    refused(&[&third], &["missing: parts 1/9, 2/9, 4/9, 5/9, 6/9 and 3 more"]);
    refused(&[&one, &third], &["one of 9 parts", "one of 2", "same N"]);
    for (spec, options, says) in [
        ("ur5", &[][..], "the specs differ"),
        ("scara", &["--set", "arm1=210mm"], "changes by --set"),
        ("scara", &["--seed", "2"], "the seeds differ"),
        ("scara", &["--monte-carlo", "10"], "numbers of draws differ"),
        ("scara", &["--no-figures"], "with figures, the other without"),
        ("scara", &["--interpret"], "by the interpreter"),
    ] {
        let stranger = other(spec, options, "2/2");
        refused(&[&one, &stranger], &["belong to different analyses", says]);
        fs::remove_file(stranger).unwrap();
    }
    let study = write(at, "s.toml", "[study]\ntitle = \"t\"\n[workspace.joints]\nsamples = 10\n");
    refused(&[&one, &other("scara", &["--study", study.to_str().unwrap()], "2/2")], &["the studies differ"]);

    // Damaged or truncated parts, and files that are no parts.
    let bytes = fs::read(&two).unwrap();
    let broken = at.join("broken.part");
    let damaged = |bytes: &[u8], says: &[&str]| {
        fs::write(&broken, bytes).unwrap();
        refused(&[&one, &broken], says);
    };
    for cut in [12, 40, bytes.len() / 2, bytes.len() - 1] {
        damaged(&bytes[..cut], &["damaged", "create it again"]);
    }
    for at in [20, bytes.len() / 3, bytes.len() - 40, bytes.len() - 1] {
        let mut changed = bytes.clone();
        changed[at] ^= 4;
        damaged(&changed, &["damaged"]);
    }
    // CBOR, the format of version 0.1.
    damaged(b"abbe part 1\n\xa1\x61a\x01\xff\xfe", &["the format 1", "reads 4", "one version of abbe"]);
    damaged(&[&bytes[..12], b"\xff\xfe", &bytes[14..]].concat(), &["damaged"]);
    damaged(b"q1,q2\n0,0\n", &["not a part of an analysis", "--shard I/N"]);
    damaged(b"", &["not a part of an analysis"]);
    refused(&[&at.join("nowhere.part")], &["cannot read"]);

    let bare = ["1/2", "2/2"].map(|shard| other("scara", &["--no-figures"], shard));
    let run = abbe(&merged(&bare, &["--out", at.join("out").to_str().unwrap()]));
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("--no-figures") && !at.join("out").exists(), "{}", run.stderr);
}

#[test]
fn options_that_do_not_go_together() {
    for (arguments, says) in [
        (&["--shard", "1/2"][..], "--out"),
        (&["--shard", "0/2", "--out", "x"], "1/2 to 2/2"),
        (&["--shard", "3/2", "--out", "x"], "1/2 to 2/2"),
        (&["--shard", "1", "--out", "x"], "I/N"),
        (&["--shard", "1/2", "--out", "x", "--json"], "--json"),
        (&["--shard", "1/2", "--out", "x", "--check"], "--check"),
        (&["--no-figures"], "--shard"),
    ] {
        let run = abbe(&[&["analyze", "pps"], arguments].concat());
        assert_eq!(run.status, 2, "{arguments:?}");
        assert!(run.stderr.contains(says), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(abbe(&["merge"]).status, 2);
}

/// A killed part leaves nothing; computed again, it is the same.
#[test]
fn a_lost_part_is_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let study = write(
        folder.path(),
        "many.toml",
        "[study]\ntitle = \"t\"\n[workspace.random]\nsamples = 50_000_000\nseed = 1\n",
    );
    let file = folder.path().join("1.part");
    let options = ["analyze", "puma560", "--no-figures", "--shard", "1/1", "--out"];
    let arguments = [&options[..], &[file.to_str().unwrap(), "--study", study.to_str().unwrap()]].concat();
    let mut lost = command(&arguments).spawn().unwrap();
    let process = lost.id();
    wait_for("work of the part", || {
        has_ended(process) || processor_time(process).is_none_or(|time| time >= SECOND / 2)
    });
    lost.kill().unwrap();
    // Windows has no signals.
    let killed = if cfg!(windows) { Some(1) } else { None };
    assert_eq!(lost.wait().unwrap().code(), killed, "killed before its end");
    assert!(!file.exists());
    let few = fs::read_to_string(&study).unwrap().replace("50_000_000", "5000");
    fs::write(&study, few).unwrap();
    prints(&arguments);
    let first = fs::read(&file).unwrap();
    prints(&arguments);
    assert_eq!(first, fs::read(&file).unwrap());
    // The killed run left nothing: the folder has the study, the part and the record.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}
