//! Folder with an arm and every kind of input file, as a place for outputs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::running::prints;

const SPEC: &str = r#"
[manipulator]
name = "arm"
length = "mm"

[tables.straightness]
file = "rail.csv"
x = { column = "d1", unit = "mm" }
y = { column = "dz", unit = "um" }
interpolation = "linear"

[[frame]]
name = "column"
variable = { name = "d1", kind = "prismatic", limits = ["0 mm", "800 mm"] }
transform = "Tz(d1 + 200 mm)"

[[frame]]
name = "shoulder"
variable = { name = "q2", kind = "revolute", limits = ["-150 deg", "150 deg"] }
dh = { theta = "q2", d = 0, a = 400, alpha = 0 }

[tool]
transform = "Tx(450 mm)"

[[source]]
name = "rail"
class = "repeatable"
frame = "column"
e_z = "straightness(d1)"

[[source]]
name = "encoder"
class = "random"
distribution = "uniform"
joint = "q2"
error = "20e-6"
"#;

const MAP: &str = r#"
[data]
title = "Laser tracker"
uncertainty = "0.01 mm"
base = "exact"

[joints]
d1 = { column = "d1", unit = "mm" }
q2 = { column = "q2 (deg)", unit = "deg" }

[point]
columns = ["x", "y", "z"]
unit = "mm"
"#;

const STUDY: &str = "[study]\ntitle = \"A path\"\n[workspace.path]\nfile = \"path.csv\"\n";

const PLAN: &str =
    "[plan]\ntitle = \"A path\"\n[[set]]\nname = \"path\"\nworkspace.path = { file = \"path.csv\" }\n";

const URDF: &str = r#"<robot name="arm">
<link name="base"/>
<link name="hand"><inertial><mass value="2"/></inertial></link>
<joint name="q" type="revolute"><parent link="base"/><child link="hand"/><origin xyz="0 0 0.1" rpy="0 0 0.5"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1"/></joint>
</robot>
"#;

/// Used as a path and as a plan; the column names of the map include units.
pub(crate) const PATH: &str =
    "d1,q2 (deg)\n0,-90\n100,-60\n200,-30\n300,0\n500,30\n600,60\n700,90\n800,120\n";

/// Files of the workshop.
pub(crate) const FILES: [&str; 12] = [
    "s.toml",
    "rail.csv",
    "m.toml",
    "study.toml",
    "path.csv",
    "plan.toml",
    "d.csv",
    "t.csv",
    "a.part",
    "r.urdf",
    "r.toml",
    "dh.csv",
];

/// Commands that write, with their inputs and without the output path, which is a file or a folder.
pub(crate) const WRITING: [(&str, &[&str]); 18] = [
    ("man --out", &[]),
    ("generate s.toml --out", &["s.toml", "rail.csv"]),
    ("generate s.toml --lang c --out", &["s.toml", "rail.csv"]),
    (
        "plan s.toml --map m.toml --optimal 20 --candidates 40 --study study.toml --out",
        &["s.toml", "rail.csv", "m.toml", "study.toml", "path.csv"],
    ),
    (
        "plan s.toml --map m.toml --sets plan.toml --out",
        &["s.toml", "rail.csv", "m.toml", "plan.toml", "path.csv"],
    ),
    ("simulate s.toml path.csv --map m.toml --out", &["s.toml", "rail.csv", "m.toml", "path.csv"]),
    ("compensate s.toml d.csv --map m.toml --out", &["s.toml", "rail.csv", "m.toml", "d.csv"]),
    ("compensate s.toml d.csv --map m.toml --report", &["s.toml", "rail.csv", "m.toml", "d.csv"]),
    ("monitor s.toml d.csv t.csv --map m.toml --report", &["s.toml", "rail.csv", "m.toml", "d.csv", "t.csv"]),
    (
        "identify s.toml d.csv --map m.toml --test t.csv --out",
        &["s.toml", "rail.csv", "m.toml", "d.csv", "t.csv"],
    ),
    (
        "identify s.toml d.csv --map m.toml --test t.csv --report",
        &["s.toml", "rail.csv", "m.toml", "d.csv", "t.csv"],
    ),
    ("measure s.toml d.csv --map m.toml --out", &["s.toml", "rail.csv", "m.toml", "d.csv"]),
    ("analyze s.toml --study study.toml --out", &["s.toml", "rail.csv", "study.toml", "path.csv"]),
    (
        "analyze s.toml --study study.toml --shard 1/2 --out",
        &["s.toml", "rail.csv", "study.toml", "path.csv"],
    ),
    ("merge a.part --out", &["a.part"]),
    ("import r.urdf --out", &["r.urdf"]),
    ("export r.toml --to urdf --from r.urdf --out", &["r.toml", "r.urdf"]),
    ("import dh.csv --dh standard --units mm,deg --out", &["dh.csv"]),
];

/// Returns the name of a file in the output folder of a command, if it writes a folder.
pub(crate) fn in_folder(command: &str) -> Option<&'static str> {
    let folders = [
        ("man", "abbe.1"),
        ("generate s.toml --lang c", "arm.h"),
        ("measure", "report.html"),
        ("analyze s.toml --study study.toml --out", "report.html"),
        ("merge", "report.html"),
    ];
    folders.into_iter().find(|(begin, _)| command.starts_with(begin)).map(|(_, file)| file)
}

pub(crate) struct Workshop(pub(crate) TempDir);

impl Workshop {
    pub(crate) fn new() -> Self {
        let workshop = Self(tempfile::tempdir().unwrap());
        for (name, text) in [
            ("s.toml", SPEC),
            ("rail.csv", "d1,dz\n0,0\n400,12\n800,3\n"),
            ("m.toml", MAP),
            ("study.toml", STUDY),
            ("plan.toml", PLAN),
            ("path.csv", PATH),
            ("r.urdf", URDF),
            ("dh.csv", "theta,d,a,alpha\n0,90,0,90\n0,0,-425,0\n0,0,-392,0\n"),
        ] {
            fs::write(workshop.at(name), text).unwrap();
        }
        // Both have the same configurations.
        for (name, at, seed) in [("d.csv", "--samples 30", "1"), ("t.csv", "d.csv", "2")] {
            let line = format!("simulate s.toml {at} --map m.toml --seed {seed}");
            fs::write(workshop.at(name), prints(&workshop.words(&line))).unwrap();
        }
        fs::write(workshop.at("r.toml"), prints(&workshop.words("import r.urdf"))).unwrap();
        prints(&workshop.words("analyze s.toml --study study.toml --shard 1/1 --out a.part"));
        // The part counts as a copied file: there is no record of it.
        fs::remove_file(workshop.at(".abbe-written")).unwrap();
        workshop
    }

    pub(crate) fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.at(name).to_str().expect("a path is text").to_owned()
    }

    /// Splits a command line into words, with the paths of its files.
    pub(crate) fn words(&self, line: &str) -> Vec<String> {
        // Numbers have points, too.
        let is_file = |word: &str| word.contains('.') && word.contains(char::is_alphabetic);
        let path = |word: &str| if is_file(word) { self.path(word) } else { word.to_owned() };
        line.split_whitespace().map(path).collect()
    }
}

/// Reads all files below a folder, following links, except the records of written files.
pub(crate) fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(contents(&path));
        } else if path.file_name() != Some(".abbe-written".as_ref()) {
            let content = fs::read(&path).unwrap_or_default();
            all.insert(path, content);
        }
    }
    all
}
