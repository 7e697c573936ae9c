//! `abbe identify` where a machine is small, or has few rows.

use std::fmt::Write;

use tempfile::tempdir;

use super::path;
use crate::running::{abbe, write};

/// Runs `identify` on these files; returns its status, and what it prints, without paths.
fn identified(spec: &str, map: &str, rows: &str, more: &[&str]) -> (i32, String) {
    let folder = tempdir().unwrap();
    let [spec, map, rows] = [("machine.toml", spec), ("map.toml", map), ("rows.csv", rows)]
        .map(|(name, text)| write(folder.path(), name, text));
    let run = abbe(&[&["identify", path(&spec), path(&rows), "--map", path(&map)], more].concat());
    (run.status, (run.stdout + &run.stderr).replace(path(folder.path()), ""))
}

/// The words and figures of a gantry do not depend on the unit of its spec, also where only the
/// rows say how far its slides travel.
#[test]
fn a_gantry_is_the_same_in_millimetres_and_metres() {
    let map = "[data]\nuncertainty = \"0.005 mm\"\nbase = \"exact\"\n[joints]\n\
               x = { column = \"x\", unit = \"mm\" }\ny = { column = \"y\", unit = \"mm\" }\n\
               z = { column = \"z\", unit = \"mm\" }\n\
               [point]\ncolumns = [\"X\", \"Y\", \"Z\"]\nunit = \"mm\"\n";
    let mut rows = "x,y,z,X,Y,Z\n".to_owned();
    for i in 0..40 {
        let [x, y, z] = [37, 53, 29].map(|step| f64::from(i * step % 40) * 10.0);
        // Target at (0.5, 0.3, -0.4), squareness 1 mrad, deviations of some µm.
        let off = f64::from(i * 17 % 7 - 3) * 0.002;
        writeln!(rows, "{x},{y},{z},{},{},{}", x + 0.5 - 0.001 * y + off, y + 0.3 - off, z - 0.4 + off)
            .unwrap();
    }
    for limits in ["", ", limits = [\"0 mm\", \"400 mm\"]"] {
        let [mm, m] = ["mm", "m"].map(|unit| {
            let frame = |(name, motion): (&str, &str)| {
                format!(
                    "[[frame]]\nname = \"{motion}\"\nvariable = {{ name = \"{name}\", kind = \"prismatic\"{limits} }}\n\
                     transform = \"{motion}({name})\"\n"
                )
            };
            let frames: String = [("x", "Tx"), ("y", "Ty"), ("z", "Tz")].map(frame).concat();
            let spec = format!("[manipulator]\nname = \"gantry\"\nlength = \"{unit}\"\n{frames}");
            let (status, text) = identified(&spec, map, &rows, &["--full"]);
            // Ranges are in the unit of the spec.
            let is_same = |line: &&str| !line.contains("Fitted ranges") && !line.contains("Results beyond");
            (status, text.lines().filter(is_same).collect::<Vec<_>>().join("\n"))
        });
        assert_eq!(mm, m, "{}\n{}", mm.1, m.1);
        assert!(mm.0 == 0 && !mm.1.contains("of the arm"), "{}", mm.1);
    }
}
