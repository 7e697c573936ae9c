//! `abbe check`: its report and its verdict.

use abbe_manipulators::SHIPPED;
use tempfile::tempdir;

use crate::bad_input::refused;
use crate::running::{abbe, full, json, narrow, prints, write};

#[test]
fn every_shipped_manipulator_passes() {
    for shipped in SHIPPED {
        let text = full(&["check", shipped.name]);
        assert!(!text.contains("FAILS"), "{text}");
        narrow(&text);
    }
}

#[test]
fn it_shows_what_follows_from_a_spec() {
    let text = full(&["check", "pps"]);
    for word in [
        "lengths in mm; orientation as euler-yzx",
        "0 … 2256 mm",
        "-90 … 90 deg",
        "base rail curvature, signs as printed   repeatable   frame lateral   off",
        "22 of 36 from poses",
        "24 of 42 and 21 of 42",
        "sincos",
        "slope of the first-order remainder",
    ] {
        let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(squeezed(&text).contains(&squeezed(word)), "{word}\n{text}");
    }
    let report = json(&["check", "pps", "--json"]);
    let ranks =
        report["identifiable"].as_array().unwrap().iter().map(|found| found["rank"].as_u64().unwrap());
    assert_eq!(ranks.collect::<Vec<_>>(), [22, 24, 19, 21]);
    let laws = report["laws"].as_array().unwrap();
    assert_eq!(laws.len(), 7);
    assert!(laws.iter().all(|law| law["holds"] == true));
    assert_eq!(json(&["check", "puma560", "--json"])["identifiable"][0]["rank"], 26);
    assert_eq!(json(&["check", "ur5", "--json"])["identifiable"][1]["rank"], 30);
}

#[test]
fn a_law_that_fails_is_exit_status_1() {
    // This source is undefined over half of the joint range.
    let spec = r#"
        [manipulator]
        name = "slide"
        length = "mm"
        [[frame]]
        name = "carriage"
        variable = { name = "d", kind = "prismatic", limits = [-1, 1] }
        transform = "Tx(d)"
        [[source]]
        name = "wear"
        class = "repeatable"
        frame = "carriage"
        e_x = "1 mm * sqrt(d/(1 mm))"
    "#;
    let folder = tempdir().unwrap();
    let path = write(folder.path(), "slide.toml", spec);
    let run = abbe(&["check", path.to_str().unwrap(), "--full"]);
    assert_eq!(run.status, 1, "{}", run.stderr);
    assert!(run.stdout.contains("FAILS") && run.stdout.contains("not a finite number"), "{}", run.stdout);
    let run = abbe(&["check", path.to_str().unwrap(), "--json"]);
    assert_eq!(run.status, 1);
    assert!(run.stdout.contains("\"holds\":false"));
    // A spec that cannot be evaluated cannot be analyzed; the message says where.
    let run = abbe(&["analyze", path.to_str().unwrap()]);
    assert_eq!((run.status, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("at d = -0.5 mm: the source \"wear\" has no finite value"), "{}", run.stderr);
}

/// Identifiability depends neither on the representation of orientations nor on samples at singular
/// Euler angles.
#[test]
fn euler_rows_hide_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let spec = |orientation: &str| {
        let text = format!(
            "[manipulator]\nname = \"arm\"\nlength = \"m\"\norientation = \"{orientation}\"\n\
             [[frame]]\nname = \"roll\"\nvariable = {{ name = \"q1\", kind = \"revolute\", limits = [\"-180 deg\", \"180 deg\"] }}\n\
             transform = \"Rz(q1) Tx(1)\"\n\
             [[frame]]\nname = \"slide\"\nvariable = {{ name = \"d2\", kind = \"prismatic\", limits = [0, 1] }}\ntransform = \"Tx(d2)\"\n"
        );
        let path = crate::running::write(folder.path(), &format!("{orientation}.toml"), &text);
        json(&["check", path.to_str().unwrap(), "--json"])["identifiable"].clone()
    };
    let found = spec("euler-yzx");
    assert_eq!(found, spec("rotation-vector"));
    // With poses and a base frame: 4 per revolute joint, 2 per prismatic joint, and 6 for the tool.
    assert_eq!(found[1]["rank"], 12);
}

/// Multiplies two row-major matrices.
fn product(a: &[[f64; 4]; 4], b: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

fn matrix(value: &serde_json::Value) -> [[f64; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| value[i][j].as_f64().unwrap()))
}

fn near(a: &[[f64; 4]; 4], b: &[[f64; 4]; 4]) -> bool {
    let scale = a.as_flattened().iter().fold(1.0_f64, |most, entry| most.max(entry.abs()));
    a.as_flattened().iter().zip(b.as_flattened()).all(|(a, b)| (a - b).abs() <= 1e-9 * scale)
}

/// The printed parameters reproduce the matrices, the matrices the pose, and this is the pose of
/// `jacobian`.
#[test]
fn the_nominal_chain_at_home_is_shown() {
    let about = |axis: usize, angle: f64| -> [[f64; 4]; 4] {
        let (s, c) = angle.sin_cos();
        match axis {
            0 => [[1.0, 0.0, 0.0, 0.0], [0.0, c, -s, 0.0], [0.0, s, c, 0.0], [0.0, 0.0, 0.0, 1.0]],
            _ => [[c, -s, 0.0, 0.0], [s, c, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]],
        }
    };
    let along = |axis: usize, length: f64| {
        let mut matrix = about(2, 0.0);
        matrix[axis][3] = length;
        matrix
    };
    let mut numbers = 0;
    for shipped in SHIPPED {
        let home = &json(&["check", shipped.name, "--json"])["home"];
        let mut pose = about(2, 0.0);
        for link in home["frames"].as_array().unwrap() {
            let shown = matrix(&link["matrix"]);
            if let Some(dh) = link.get("dh") {
                let [theta, d, a, alpha] = ["theta", "d", "a", "alpha"].map(|key| dh[key].as_f64().unwrap());
                let motions = match dh["convention"].as_str().unwrap() {
                    "standard" => [about(2, theta), along(2, d), along(0, a), about(0, alpha)],
                    _ => [about(0, alpha), along(0, a), about(2, theta), along(2, d)],
                };
                let made = motions.iter().skip(1).fold(motions[0], |made, motion| product(&made, motion));
                assert!(near(&shown, &made), "{} {link}", shipped.name);
                numbers += 1;
            }
            pose = product(&pose, &shown);
        }
        let pose = product(&pose, &matrix(&home["tool"]));
        assert!(near(&matrix(&home["pose"]), &pose), "{}", shipped.name);
        let jacobian = json(&["jacobian", shipped.name, "--json"]);
        assert!(near(&matrix(&jacobian["pose"]), &pose), "{}", shipped.name);
    }
    assert!(numbers > 30, "{numbers} frames have Denavit-Hartenberg numbers");
    let text = full(&["check", "pps"]);
    assert!(text.contains("Nominal chain at home") && text.contains("Axes and origins at home"), "{text}");
    let slide = json(&["check", "pps", "--json"]);
    assert!(slide["home"]["frames"].as_array().unwrap().iter().any(|link| link.get("dh").is_none()));
}

/// Whole numbers beyond a revolution are never rad: `bad-specs` has those of a spec.
#[test]
fn joint_variables_in_degrees_are_refused() {
    let run = abbe(&["jacobian", "puma560", "--q", "0,-90,90deg,0,0,0"]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("the value of `q2` is -90 rad, more than one revolution"), "{}", run.stderr);
    assert!(run.stderr.contains("write `-90 deg` for degrees, or `-90 rad`"), "{}", run.stderr);
    assert_eq!(abbe(&["jacobian", "puma560", "--q", "0,-90deg,7 rad,0,0,0"]).status, 0);
}

#[test]
fn inputs_and_loads_without_effect_are_noted() {
    let spec = |error: &str, more: &str| {
        format!(
            "[manipulator]\nname = \"arm\"\nlength = \"mm\"\ngravity = [0, 0, \"-9.81 m/s^2\"]\n\
             [inputs]\nwarming = \"0 K\"\npayload = \"2 kg\"\n\
             [[frame]]\nname = \"elbow\"\nvariable = {{ name = \"q1\", kind = \"revolute\" }}\ntransform = \"Rz(q1) Tx(400)\"\n\
             [[load]]\nmass = \"payload\"\nframe = \"elbow\"\n\
             [[source]]\nname = \"heat\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_x = \"{error}\"\n{more}"
        )
    };
    let folder = tempdir().unwrap();
    let notes = |text: &str| {
        let path = write(folder.path(), "arm.toml", text);
        let report = json(&["check", path.to_str().unwrap(), "--json"]);
        let printed = prints(&["check", path.to_str().unwrap()]);
        assert!(printed.lines().count() <= 25);
        let notes = report["notes"].as_array().unwrap().iter().map(|note| note.as_str().unwrap().to_owned());
        let notes: Vec<String> = notes.collect();
        let printed = printed.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(notes.iter().all(|note| printed.contains(note)), "{printed}");
        notes
    };
    let elastic = "[[source]]\nname = \"gear\"\nclass = \"repeatable\"\nframe = \"elbow\"\n\
                   compliance = { diagonal = [0, 0, 0, 0, 0, \"1e-10/(N*mm)\"] }\n";
    assert_eq!(
        notes(&spec("1 um", "")),
        [
            "The input `warming` is not used: no source or load depends on it.",
            "1 load has no effect: no elastic source at its frame or before it carries it. `identify` uses \
             loads for elastic terms."
        ]
    );
    assert_eq!(notes(&spec("1 um/K * warming", elastic)), Vec::<String>::new());
}

#[test]
fn angles_beyond_a_turn_are_doubted() {
    let spec = |alpha: &str, more: &str| {
        format!(
            "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[parameters]\ntwist = 90\n[[frame]]\nname = \"elbow\"\n\
             variable = {{ name = \"q1\", kind = \"revolute\" {more} }}\n\
             dh = {{ theta = \"q1\", d = 0, a = \"400 mm\", alpha = {alpha} }}\n\
             [tool]\ntransform = \"Rx(twist)\"\n"
        )
    };
    let folder = tempdir().unwrap();
    let warned = |text: &str| {
        let path = write(folder.path(), "arm.toml", text);
        let run = abbe(&["check", path.to_str().unwrap()]);
        assert_eq!(run.status, 0, "{}", run.stderr);
        let report = json(&["check", path.to_str().unwrap(), "--json"]);
        let warnings = report["warnings"].as_array().unwrap();
        for warning in warnings {
            assert!(run.stderr.contains(warning["message"].as_str().unwrap()), "{}", run.stderr);
        }
        warnings.clone()
    };
    let found = warned(&spec("90.5", ""));
    assert_eq!(found.len(), 2);
    let expected =
        "an angle of the frame \"elbow\" is 90.5 rad, more than one revolution; write `90.5deg` for degrees";
    assert_eq!((found[0]["message"].as_str().unwrap(), &found[0]["line"]), (expected, &9.into()));
    assert!(found[1]["message"].as_str().unwrap().starts_with("an angle of the tool is 90 rad"));
    // No warning for an angle with a unit, or for one of less than a turn.
    let without = |text: &str| warned(&text.replace("Rx(twist)", "Rx(twist/90)"));
    assert!(without(&spec("\"720 deg\"", "")).is_empty());
    assert!(without(&spec("\"2*pi\"", "")).is_empty());
    assert!(without(&spec("\"90 rad\"", "")).is_empty());
    assert!(without(&spec("0", ", limits = [\"-720 deg\", \"720 deg\"]")).is_empty());
    for shipped in SHIPPED {
        assert_eq!(
            json(&["check", shipped.name, "--json"])["warnings"],
            serde_json::json!([]),
            "{}",
            shipped.name
        );
    }
}

const PAGE: &str = include_str!("../../../docs/reference/spec.md");

/// Loops that close are shown on the first screen; those that do not are exit status 1, with a way
/// out.
#[test]
fn loops_at_home() {
    let linkage = PAGE.split("```").find_map(|block| block.strip_prefix("toml\n# linkage.toml\n")).unwrap();
    let folder = tempdir().unwrap();
    let checked = |text: &str| {
        let run = abbe(&["check", write(folder.path(), "linkage.toml", text).to_str().unwrap()]);
        assert!(run.stdout.lines().count() <= 25, "{}", run.stdout);
        narrow(&run.stdout);
        (run.status, run.stdout.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    let narrow_range = linkage.replace("-170 deg", "50 deg").replace("170 deg", "70 deg");
    let straight = linkage.replace("60 deg", "0 deg").replace("-40 deg", "0 deg").replace("65 deg", "0 deg");
    for (text, status, words) in [
        (linkage.to_owned(), 0, "Loops 2 equations for 2 passive variables: knee 2"),
        (linkage.to_owned(), 0, "p1 = -41.624°, p2 = 64.9435°; condition number 2.6"),
        (linkage.to_owned(), 0, "Tree 3 frames, 1 joint, 0 fixed; tool on coupler"),
        (
            linkage.replace("Tx(80)", "Tx(10)"),
            1,
            "the loops are not closed at home Open at home: \"knee\" by 23 mm.",
        ),
        (narrow_range.replace("65 deg", "150 deg"), 1, "write these as `home` of the passive joints"),
        (
            straight.replace("Tx(120)", "Tx(100)").replace("Tx(80)", "Tx(40)"),
            1,
            "p1, p2 can move together, 0.4 : 1 (loop knee)",
        ),
    ] {
        let (found, shown) = checked(&text);
        assert!(found == status && shown.contains(words), "{found:?}, {words}\n{shown}");
    }
}

/// Errors per unit of a magnitude are no angles of their own: 1 is not asked about, 0.3 is.
#[test]
fn an_error_of_a_magnitude_needs_no_unit() {
    let folder = tempdir().unwrap();
    let spec = |source: &str| {
        let text = format!(
            "[manipulator]\nname = \"arm\"\nlength = \"mm\"\n[[frame]]\nname = \"a\"\n\
             variable = {{ name = \"q1\", kind = \"revolute\", limits = [\"-90 deg\", \"90 deg\"] }}\n\
             transform = \"Rz(q1)\"\n[tool]\ntransform = \"Tx(1000)\"\n[[source]]\nname = \"tilt\"\n\
             class = \"repeatable\"\nframe = \"a\"\n{source}\n"
        );
        write(folder.path(), "arm.toml", &text)
    };
    assert_eq!(abbe(&["check", spec("magnitude = { value = 0.001 }\ne_s = 1").to_str().unwrap()]).status, 0);
    for (bare, written) in
        [("e_s = 0.3", "`\"0.3 mrad\"`"), ("e_s = \"0.3\"", "`0.3 mrad`"), ("e_s = \"-0.02\"", "`-0.02 deg`")]
    {
        refused(&["check", spec(bare).to_str().unwrap()], &["a number without a unit is in rad", written]);
    }
    // The hint is obeyed.
    assert_eq!(abbe(&["check", spec("e_s = \"0.3 mrad\"").to_str().unwrap()]).status, 0);
}
