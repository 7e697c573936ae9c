//! `abbe identify` where a machine is small, or has few rows.

use std::fmt::Write;

use serde_json::Value;
use tempfile::tempdir;

use super::{number, path};
use crate::running::{abbe, json, prints, shipped, write};

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

/// Joints of a UR5, and a contact whose place is `at` where it is known, as the tip.
fn touches(position: &str, at: &str) -> String {
    let joints: String =
        (1..=6).map(|i| format!("q{i} = {{ column = \"q{i}\", unit = \"deg\" }}\n")).collect();
    format!(
        "[data]\n[joints]\n{joints}[[target]]\nname = \"tip\"\nposition = {position}\n\
         [[instrument]]\nname = \"cone\"\nkind = \"contact\"\ntarget = \"tip\"\n{at}uncertainty = \"0.1 mm\"\n"
    )
}

/// A tip in a cone is found from seven touches, too few for the errors of the arm. The spec is the
/// nominal one. More touches find the tip alone on request.
#[test]
fn a_tip_is_found_without_the_errors_of_the_arm() {
    let folder = tempdir().unwrap();
    let file = |name: &str, text: &str| write(folder.path(), name, text);
    let spec = file("arm.toml", shipped("ur5"));
    let truth =
        touches("[\"12 mm\", \"-40 mm\", \"150 mm\"]", "at = [\"420 mm\", \"-150 mm\", \"200 mm\"]\n");
    let (truth, map) = (file("truth.toml", &truth), file("map.toml", &touches("\"unknown\"", "")));
    for (samples, only) in [("7", &[][..]), ("30", &["--only", "placement"])] {
        let rows = folder.path().join("rows.csv");
        let simulate = ["simulate", path(&spec), "--map", path(&truth), "--samples", samples, "--seed", "1"];
        prints(&[&simulate[..], &["--out", path(&rows), "--force"]].concat());
        let found = folder.path().join("found.toml");
        let job =
            ["identify", path(&spec), path(&rows), "--map", path(&map), "--out", path(&found), "--force"];
        let report = json(&[&job[..], only, &["--json"]].concat());
        let value = |name: &str| {
            let all = report["parameters"].as_array().unwrap();
            let one = all.iter().find(|one| one["name"] == name).unwrap_or_else(|| panic!("{name} {report}"));
            [number(one, &["value"]), number(one, &["standard_deviation"])]
        };
        assert_eq!(report["parameters"].as_array().unwrap().len(), 6);
        assert!(["tool_x", "tool_y", "tool_z"].iter().all(|name| value(name)[1] < 0.5), "{report}");
        assert_eq!(std::fs::read_to_string(&found).unwrap(), shipped("ur5"));
        // There is nothing to compensate.
        let text = prints(&[&job[..], only].concat());
        assert!(text.contains("lists every place") && !text.contains("corrects commands"), "{text}");
        let map = std::fs::read_to_string(folder.path().join("found.map.toml")).unwrap();
        let tip = map.split("targets = [").nth(1).unwrap().split(']').next().unwrap();
        let tip: Vec<f64> =
            tip.split('"').filter_map(|part| part.strip_suffix(" mm")?.parse().ok()).collect();
        let off = tip.iter().zip([12.0, -40.0, 150.0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(tip.len() == 3 && off < 1.0, "{map}");
        let is_noted = report["notes"].to_string().contains("no error of the machine was fitted");
        assert_eq!(is_noted, only.is_empty(), "{}", report["notes"]);
    }
}

/// Three distances determine the squareness and two scales of a plotter. There is nothing to test.
#[test]
fn as_many_readings_as_unknowns_are_enough() {
    let slide = |name: &str, motion: &str| {
        format!(
            "[[frame]]\nname = \"{motion}\"\nvariable = {{ name = \"{name}\", kind = \"prismatic\", limits = [0, 200] }}\n\
             transform = \"{motion}({name})\"\n"
        )
    };
    let scale = |name: &str| {
        format!(
            "[[source]]\nname = \"scale of {name}\"\nclass = \"repeatable\"\njoint = \"{name}\"\nerror = \"0.001 * {name}\"\n\
             magnitude = {{ value = 0, standard_deviation = 20 }}\n"
        )
    };
    let frames = slide("x", "Tx") + &slide("y", "Ty") + &scale("x") + &scale("y");
    let spec = format!("[manipulator]\nname = \"plotter\"\nlength = \"mm\"\n{frames}");
    let map = "[data]\nbase = \"exact\"\n[joints]\nx = { column = \"x\", unit = \"mm\" }\n\
               y = { column = \"y\", unit = \"mm\" }\n[[instrument]]\nname = \"rule\"\nkind = \"displacement\"\n\
               column = \"travelled\"\nunit = \"mm\"\nuncertainty = \"0.02 mm\"\n";
    let at = |[x, y]: [f64; 2]| [1.002 * x - 0.003 * y, 0.997 * y];
    let far = |from, to| {
        let ([a, b], [c, d]) = (at(from), at(to));
        (c - a).hypot(d - b)
    };
    let rows = format!(
        "x,y,travelled\n0,0,\n200,200,{:.4}\n0,200,\n200,0,{:.4}\n0,0,{:.4}\n",
        far([0.0; 2], [200.0; 2]),
        far([0.0, 200.0], [200.0, 0.0]),
        far([200.0, 0.0], [0.0; 2])
    );
    let (status, text) = identified(&spec, map, &rows, &["--json"]);
    let report: Value =
        serde_json::from_str(text.lines().next().unwrap()).unwrap_or_else(|_| panic!("{text}"));
    let magnitude =
        |i: usize| ["value", "standard_deviation"].map(|key| number(&report["magnitudes"][i], &[key]));
    for ([found, deviation], [expected, uncertainty]) in
        [(magnitude(0), [2.0, 0.1]), (magnitude(1), [-3.0, 0.14])]
    {
        assert!((found - expected).abs() < 0.02 && (deviation / uncertainty - 1.0).abs() < 0.1, "{report}");
    }
    assert_eq!((status, number(&report, &["certainty", "freedom"])), (0, 0.0));
    let (_, text) = identified(&spec, map, &rows, &[]);
    assert!(text.contains("nothing could be tested"), "{text}");
}

/// One degree of freedom does not make dials better than stated.
#[test]
fn one_degree_of_freedom_leaves_the_stated_uncertainty() {
    let spec = "[manipulator]\nname = \"head\"\nlength = \"mm\"\n[parameters]\npivot = \"300 mm\"\n[[frame]]\nname = \"B\"\n\
                variable = { name = \"b\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }\ntransform = \"Ry(b)\"\n\
                [tool]\ntransform = \"Tz(-pivot)\"\n[[source]]\nname = \"pivot\"\nclass = \"repeatable\"\n\
                parameter = \"pivot\"\nerror = \"1 mm\"\nmagnitude = { value = 0, standard_deviation = 1 }\n";
    let dial = |axis: &str, direction: &str| {
        format!(
            "[[instrument]]\nname = \"dial {axis}\"\nkind = \"indicator\"\ncolumn = \"d{axis}\"\nunit = \"mm\"\n\
             at = [\"0 mm\", \"0 mm\", \"-300 mm\"]\ndirection = {direction}\nuncertainty = \"1 um\"\n"
        )
    };
    let map =
        "[data]\nbase = \"exact\"\nplacement = \"exact\"\n[joints]\nb = { column = \"b\", unit = \"deg\" }\n"
            .to_owned()
            + &dial("x", "[1, 0, 0]")
            + &dial("z", "[0, 0, 1]");
    for noise in [[0.3, -0.8, 0.5, 1.2, -0.4, 0.7], [0.0; 6], [1.1, 0.2, -1.4, 0.6, 0.9, -0.5]] {
        let row = |(i, b): (usize, f64)| {
            let (sin, cos) = b.to_radians().sin_cos();
            let [x, z] = [-300.2 * sin + 1e-3 * noise[i], 300.0 - 300.2 * cos + 1e-3 * noise[i + 3]];
            format!("{b},{x:.4},{z:.4}\n")
        };
        let rows: String = [-30.0, 0.0, 30.0].into_iter().enumerate().map(row).collect();
        let (_, text) = identified(spec, &map, &format!("b,dx,dz\n{rows}"), &["--json"]);
        let report: Value =
            serde_json::from_str(text.lines().next().unwrap()).unwrap_or_else(|_| panic!("{text}"));
        let one = &report["magnitudes"][0];
        let [found, deviation] = ["value", "standard_deviation"].map(|key| number(one, &[key]));
        assert!((0.7e-3..3e-3).contains(&deviation) && (found - 0.2).abs() < 4.0 * deviation, "{one}");
    }
}

/// Two lengths that act alike are said as their sum, and each with what its prior leaves of it; a
/// plan says it before anything is measured.
#[test]
fn lengths_in_line_are_known_as_a_sum() {
    let length = |name: &str| {
        format!(
            "[[source]]\nname = \"{name}\"\nclass = \"repeatable\"\nparameter = \"{name}\"\nerror = \"1 mm\"\n\
             magnitude = {{ value = 0, standard_deviation = 5 }}\n"
        )
    };
    let spec = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[parameters]\nupper = \"250 mm\"\nlower = \"350 mm\"\n\
                [[frame]]\nname = \"arm\"\nvariable = { name = \"q\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }\n\
                transform = \"Rz(q) Tx(upper) Tx(lower)\"\n"
        .to_owned()
        + &length("upper")
        + &length("lower");
    let map = "[data]\nuncertainty = \"0.02 mm\"\nbase = \"exact\"\nplacement = \"exact\"\n\
               [joints]\nq = { column = \"q\", unit = \"deg\" }\n\
               [point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";
    let row = |i: i32| {
        let (sin, cos) = f64::from(12 * i).to_radians().sin_cos();
        let off = 0.008 * f64::from((5 * i).rem_euclid(7) - 3);
        format!("{},{},{},{}\n", 12 * i, 601.4 * cos + off, 601.4 * sin - off, 0.5 * off)
    };
    let rows: String = (-6..=6).map(row).collect();
    let (status, text) = identified(&spec, map, &format!("q,x,y,z\n{rows}"), &["--full"]);
    assert!(status == 0 && text.contains("  upper + lower "), "{text}");
    let sentence = "± 3.5, which these data determine less well than the spec";
    assert!(
        ["= 1.39", "= 1.4"].iter().any(|sum| text.contains(&format!("they determine upper + lower {sum}")))
            && text.contains(sentence),
        "{text}"
    );
    let folder = tempdir().unwrap();
    let [spec, map] =
        [("arm.toml", &spec[..]), ("map.toml", map)].map(|(name, text)| write(folder.path(), name, text));
    let plan = prints(&["plan", path(&spec), "--map", path(&map), "--optimal", "8"]);
    assert!(plan.contains("upper + lower: these rows determine the sum, not its parts"), "{plan}");
}

/// The zeros of joints whose motions are coupled are found by their own names, each at its value.
#[test]
fn coupled_joints_have_zeros_of_their_own() {
    let frame = |name: &str, joint: &str, theta: &str, dh: &str| {
        format!(
            "[[frame]]\nname = \"{name}\"\nvariable = {{ name = \"{joint}\", kind = \"revolute\", limits = [\"-90 deg\", \"60 deg\"] }}\n\
             dh = {{ theta = \"{theta}\", {dh} }}\n"
        )
    };
    let spec = "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n".to_owned()
        + &frame("A", "a", "a", "d = 380, a = 60, alpha = \"-90 deg\"")
        + &frame("B", "b", "b", "d = 0, a = 440, alpha = 0")
        + &frame("C", "c", "c - b", "d = 0, a = 30, alpha = \"-90 deg\"")
        + "[tool]\ntransform = \"Tx(50 mm) Ty(40 mm) Tz(400 mm)\"\n";
    let zero = |joint: &str, error: &str| {
        format!(
            "[[source]]\nname = \"{joint} as built\"\nclass = \"repeatable\"\njoint = \"{joint}\"\nerror = \"{error}\"\n"
        )
    };
    let joints =
        ["a", "b", "c"].map(|joint| format!("{joint} = {{ column = \"{joint}\", unit = \"deg\" }}\n"));
    let map = "[data]\nuncertainty = \"0.02 mm\"\nplacement = \"exact\"\n[joints]\n".to_owned()
        + &joints.concat()
        + "[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n";
    let folder = tempdir().unwrap();
    let real = spec.clone() + &zero("b", "0.7 mrad") + &zero("c", "-0.6 mrad");
    let [real, of] =
        [("real.toml", &real), ("map.toml", &map)].map(|(name, text)| write(folder.path(), name, text));
    let rows = prints(&["simulate", path(&real), "--map", path(&of), "--samples", "80", "--seed", "1"]);
    let (status, text) = identified(&spec, &map, &rows, &["--json"]);
    let report: Value =
        serde_json::from_str(text.lines().next().unwrap()).unwrap_or_else(|_| panic!("{text}"));
    for (name, truth) in [("zero of b", 0.7e-3), ("zero of c", -0.6e-3)] {
        let all = report["joint_errors"].as_array().unwrap();
        let one = all.iter().find(|one| one["number"] == name).unwrap_or_else(|| panic!("{name} {all:?}"));
        let [value, deviation] = ["value", "standard_deviation"].map(|key| number(one, &[key]));
        assert!(status == 0 && (value - truth).abs() < 4.0 * deviation && deviation < 1e-4, "{one}");
    }
}
