//! Positioning tests: forms of files, ISO 230-2 and ISO 230-6, and what is refused.

use std::fs;
use std::path::Path;

use super::running::{abbe, full, json, narrow, prints, write};

/// The runs of `evaluation.rs`, computed there by hand, with one column for each pass.
const WIDE: &str = "position (mm),1+ (um),1- (um),2+ (um),2- (um),3+ (um),3- (um)\n\
                    0,0,-1,1,0,2,1\n100,3,0,4,2,5,4\n200,-4,-1,-2,-1,0,-1\n";

/// Returns the same runs with one row for each reading.
fn long(header: &str, row: impl Fn(f64, bool, f64) -> String) -> String {
    let mut text = format!("{header}\n");
    for line in WIDE.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        for (i, deviation) in cells[1..].iter().enumerate() {
            text += &format!("{}\n", row(cells[0], i % 2 == 0, *deviation));
        }
    }
    text
}

#[test]
fn every_form_of_a_file_has_the_same_characteristics() {
    let folder = tempfile::tempdir().unwrap();
    let sign = |up: bool| if up { "+" } else { "-" };
    let forms = [
        WIDE.to_owned(),
        WIDE.replace("1+ (um),1- (um)", "Run 1 forward (um),Run 1 reverse (um)"),
        long("Target (mm),Run,Direction,Deviation (um)", |at, up, off| format!("{at},1,{},{off}", sign(up))),
        long("position (mm),direction,error (mm)", |at, up, off| {
            format!("{at},{},{}", if up { "up" } else { "down" }, off / 1e3)
        }),
        long("position (mm),direction,actual (mm)", |at, up, off| {
            format!("{at},{},{:.6}", if up { 1 } else { -1 }, at + off / 1e3)
        }),
        long("position (mm);direction;deviation (um)", |at, up, off| {
            format!("{at:.1};{};{off:.1}", sign(up)).replace('.', ",")
        }),
    ];
    for (i, form) in forms.iter().enumerate() {
        let file = write(folder.path(), &format!("runs{i}.csv"), form);
        let report = json(&["positioning", file.to_str().unwrap(), "--json"]);
        let both = &report["lines"][0]["bidirectional"];
        let value = |name: &str| both[name]["value"].as_f64().unwrap();
        let found = ["accuracy", "systematic", "mean", "repeatability", "reversal"].map(value);
        assert!(
            found.iter().zip([12.0, 6.0, 4.5, 8.0, 2.0]).all(|(a, b)| (a - b).abs() < 1e-6),
            "{i}: {found:?}"
        );
        assert!(both["accuracy"]["uncertainty"].is_null() && report["diagonals"].is_null());
        narrow(&prints(&["positioning", file.to_str().unwrap()]));
        narrow(&full(&["positioning", file.to_str().unwrap()]));
    }
}

/// E↑ = 4 − (−2), of means of three readings at positions 100 mm apart: u² = 2 · 0.3² / 3 + 0.1²;
/// the scale of 1 um/m moves 100 mm by 0.1 um.
#[test]
fn uncertainty_of_the_instrument_is_propagated() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), "runs.csv", WIDE);
    let file = file.to_str().unwrap();
    let stated = ["--reading-uncertainty", "0.3um", "--scale-uncertainty", "1um/m"];
    let report = json(&[&["positioning", file, "--json"][..], &stated].concat());
    let uncertainty = report["lines"][0]["forward"]["systematic"]["uncertainty"].as_f64().unwrap();
    assert!((uncertainty - 2.0 * (2.0 * 0.09 / 3.0 + 0.01_f64).sqrt()).abs() < 1e-12, "{uncertainty}");
    assert!(prints(&[&["positioning", file][..], &stated].concat()).contains("6 ± 0.53"));
    // Three approaches are fewer than the standard has.
    assert!(abbe(&["positioning", file]).stderr.contains("ISO 230-2 evaluates 5 approaches"));
    let arcsec = WIDE.replace("(um)", "(arcsec)").replace("(mm)", "(deg)");
    let file = write(folder.path(), "angles.csv", &arcsec);
    let report = json(&["positioning", file.to_str().unwrap(), "--json", "--reading-uncertainty", "1arcsec"]);
    assert_eq!((report["unit"].as_str(), report["position_unit"].as_str()), (Some("arcsec"), Some("deg")));
    assert!((report["instrument"][0].as_f64().unwrap() - 1.0).abs() < 1e-12);
}

/// A characteristic is accepted if it is within its limit by its uncertainty of 95 % on one side,
/// and rejected if it is beyond it by that; the page has the verdict and the figure.
#[test]
fn limits_are_kept_by_the_uncertainty() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), "runs.csv", WIDE);
    let stated = ["--reading-uncertainty", "0.3um", "--scale-uncertainty", "1um/m"];
    let positioning = [&["positioning", file.to_str().unwrap()][..], &stated].concat();
    let report = json(&[&positioning[..], &["--json"]].concat());
    let both = &report["lines"][0]["bidirectional"];
    let names =
        [("A", "accuracy"), ("E", "systematic"), ("M", "mean"), ("R", "repeatability"), ("B", "reversal")];
    for (figure, name) in names {
        let number = |key: &str| both[name][key].as_f64().unwrap();
        let guard = 1.644_853_6 * number("uncertainty") / 2.0;
        for (share, status, words) in [
            (1.01, 0, "Accepted on the runs, as built"),
            (0.5, 1, "Neither accepted nor rejected on the runs"),
            (-0.5, 1, "Neither accepted nor rejected on the runs"),
            (-1.01, 1, "Not accepted on the runs"),
        ] {
            let limit = format!("{figure} {:.6}um", number("value") + share * guard);
            let run = abbe(&[&positioning[..], &["--accept", &limit]].concat());
            assert_eq!(run.status, status, "{limit}: {}{}", run.stdout, run.stderr);
            assert!(run.stdout.contains(words), "{limit}: {}", run.stdout);
            narrow(&run.stdout);
        }
    }
    let page = folder.path().join("page.html");
    let written =
        ["--accept", "A 20um, B 0.001mm", "--report", page.to_str().unwrap(), "--date", "2026-03-14"];
    let run = abbe(&[&positioning[..], &written].concat());
    assert_eq!(run.status, 1, "{}", run.stderr);
    let page = fs::read_to_string(page).unwrap();
    for expected in
        ["Not accepted on the runs", "2026-03-14", "from below", "two standard deviations", "runs.csv"]
    {
        assert!(page.contains(expected), "{expected}");
    }
    for (limits, message) in
        [("A", "A"), ("Q 3um", "unknown figure `Q`"), ("A 3 arcsec", "this limit"), ("", "there is no limit")]
    {
        let run = abbe(&[&positioning[..], &["--accept", limits]].concat());
        assert!(run.status == 2 && run.stderr.contains(message), "{limits}: {}", run.stderr);
    }
    let single = write(folder.path(), "single.csv", "position (mm),1+ (um),1- (um)\n0,1,2\n9,3,4\n");
    let run = abbe(&["positioning", single.to_str().unwrap(), "--accept", "A 3um"]);
    assert!(run.status == 2 && run.stderr.contains("A is not known"), "{}", run.stderr);
}

/// Ballbar: 24 angles, an ellipse of ± 3 um by a squareness, and ± 0.5 um of the directions.
fn ballbar(header: &str, row: impl Fn(f64, &str, f64) -> String) -> String {
    let mut text = format!("{header}\n");
    for (direction, lag) in [("ccw", 0.5), ("cw", -0.5)] {
        for k in 0..24 {
            let angle = 15.0 * f64::from(k);
            let own = 2.0 + 7.0 * angle.to_radians().cos() + 3.0 * (2.0 * angle).to_radians().sin() + lag;
            text += &format!("{}\n", row(angle, direction, own));
        }
    }
    text
}

#[test]
fn circles_are_evaluated_by_iso_230_4() {
    let folder = tempfile::tempdir().unwrap();
    let forms = [
        ballbar("angle (deg),direction,deviation (um)", |at, side, own| format!("{at},{side},{own:.6}")),
        ballbar("Angle (rad);Direction;radial deviation (mm)", |at, side, own| {
            format!("{:.12};{side};{:.9}", at.to_radians(), own / 1e3)
        }),
    ];
    for (i, form) in forms.iter().enumerate() {
        let file = write(folder.path(), &format!("circle{i}.csv"), form);
        let file = file.to_str().unwrap();
        let circle = &json(&["positioning", file, "--json"])["circle"];
        let value = |pointer: &str| circle.pointer(pointer).unwrap().as_f64().unwrap();
        for (pointer, expected) in [
            ("/forward/circularity/value", 6.0),
            ("/forward/largest/value", 5.5),
            ("/reverse/smallest/value", -1.5),
            ("/forward/center/0", 7.0),
            ("/circularity/value", 7.0),
            ("/hysteresis/value", 1.0),
            ("/mean/value", 2.0),
        ] {
            assert!((value(pointer) - expected).abs() < 1e-5, "{pointer}: {}", value(pointer));
        }
        let run = abbe(&["positioning", file, "--accept", "G 7.5um, H 0.9um"]);
        assert_eq!((run.status, &run.stderr[..]), (1, ""), "{}", run.stdout);
        assert!(
            run.stdout.contains("Not accepted on the runs") && run.stdout.contains("circular hysteresis")
        );
        narrow(&run.stdout);
        narrow(&full(&["positioning", file]));
        let page = folder.path().join(format!("circle{i}.html"));
        prints(&["positioning", file, "--report", page.to_str().unwrap()]);
        assert!(fs::read_to_string(page).unwrap().contains("counterclockwise"));
        let run = abbe(&["positioning", file, "--accept", "A 3um"]);
        assert!(run.status == 2 && run.stderr.contains("unknown figure `A`"), "{}", run.stderr);
    }
    for (text, message) in [
        ("angle (deg),1+ (um)\n0,1\n60,2\n90,2\n120,1\n", "none in half of the circle or more"),
        ("angle (deg),1+ (um)\n0,1\n120,2\n240,1\n360,1\n", "fewer than four angles"),
        ("angle (deg),direction,actual (mm)\n0,+,100\n90,+,100\n", "angles and deviations of its radius"),
        ("angle (deg),diagonal,1+ (um)\n0,PPP,1\n90,PPP,2\n", "angles and deviations of its radius"),
        ("angle (deg),direction,radius (mm)\n0,+,100\n90,+,100\n", "no column has deviations"),
        ("angle (deg),1+ (arcsec)\n0,1\n90,2\n200,1\n", "angles and deviations of its radius"),
        ("angle (mm),1+ (um)\n0,1\n90,2\n200,1\n", "angles and deviations of its radius"),
    ] {
        let file = write(folder.path(), "wrong.csv", text);
        let run = abbe(&["positioning", file.to_str().unwrap()]);
        assert!(run.status == 2 && run.stderr.contains(message), "{text}: {}", run.stderr);
    }
    let one = write(folder.path(), "one.csv", "angle (deg),1+ (um)\n0,1\n90,2\n200,1\n300,4\n");
    let run = abbe(&["positioning", one.to_str().unwrap(), "--accept", "H 3um"]);
    assert!(run.status == 2 && run.stderr.contains("H is not known"), "{}", run.stderr);
    let one = one.to_str().unwrap();
    let run = abbe(&["positioning", one, "--scale-uncertainty", "1um/m"]);
    assert!(run.status == 2 && run.stderr.contains("is not used for circles"), "{}", run.stderr);
    // No option is offered that is refused.
    let text = prints(&["positioning", one]);
    assert!(!text.contains("--scale-uncertainty") && !text.contains("--out"), "{text}");
    let run = abbe(&["positioning", one, "--out", "x.csv"]);
    assert!(run.status == 2 && !Path::new("x.csv").exists(), "{}", run.stderr);
}

/// Checks that the answer says why characteristics are missing, and at which position.
#[test]
fn missing_characteristics_have_their_reason() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("0,1,2,1,3\n100,3,,4,\n", Some("position 100 mm has no approach from above")),
        ("0,1,2,2,1\n100,3,1,4,\n", Some("position 100 mm has a single approach in a direction")),
        ("0,1,,2,\n100,3,,4,\n", None),
        ("0,1,2,2,1\n100,3,1,4,1\n", None),
    ];
    for (i, (rows, reason)) in cases.into_iter().enumerate() {
        let text = format!("position (mm),1+ (um),1- (um),2+ (um),2- (um)\n{rows}");
        let file = write(folder.path(), &format!("runs{i}.csv"), &text);
        let answer = prints(&["positioning", file.to_str().unwrap()]);
        assert_eq!(answer.contains("Missing"), reason.is_some(), "{answer}");
        assert!(reason.is_none_or(|reason| answer.contains(reason)), "{answer}");
    }
}

/// The table of mean deviations is read by a spec: the error of the tool is that of the table.
#[test]
fn mean_deviations_are_a_table_of_a_spec() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), "runs.csv", WIDE);
    let out = folder.path().join("exx.csv");
    prints(&["positioning", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    let text = fs::read_to_string(&out).unwrap();
    assert!(
        text.starts_with("position (mm),deviation (um),forward (um),reverse (um)\n0,0.5,1,0\n"),
        "{text}"
    );
    let spec = write(
        folder.path(),
        "axis.toml",
        "[manipulator]\nname = \"axis\"\nlength = \"mm\"\n[tables.exx]\nfile = \"exx.csv\"\n\
         x = { column = \"position (mm)\", unit = \"mm\" }\ny = { column = \"deviation (um)\", unit = \"um\" }\n\
         interpolation = \"linear\"\n[[frame]]\nname = \"X\"\n\
         variable = { name = \"x\", kind = \"prismatic\", limits = [0, 200] }\ntransform = \"Tx(x)\"\n\
         [[source]]\nname = \"EXX\"\nclass = \"repeatable\"\nframe = \"X\"\ne_x = \"exx(x)\"\n",
    );
    let report = json(&["jacobian", spec.to_str().unwrap(), "--q", "100", "--json"]);
    let error = report["generalized_errors"][0].as_f64().unwrap();
    assert!((error - 0.003).abs() < 1e-15, "{error}");
}

#[test]
fn diagonals_are_evaluated_together() {
    let folder = tempfile::tempdir().unwrap();
    let row = |name: &str, at: u32, deviations: [f64; 4]| {
        format!("{name},{at},{}\n", deviations.map(|deviation| deviation.to_string()).join(","))
    };
    let text = ["diagonal,position (mm),1+ (um),1- (um),2+ (um),2- (um)\n".to_owned()]
        .into_iter()
        .chain([row("PPP", 0, [0.0, 0.0, 0.0, 0.0]), row("PPP", 500, [4.0, 3.0, 6.0, 3.0])])
        .chain([row("NPP", 0, [0.0, 2.0, 0.0, 2.0]), row("NPP", 500, [-5.0, -4.0, -5.0, -4.0])])
        .collect::<String>();
    let file = write(folder.path(), "diagonals.csv", &text);
    let report = json(&["positioning", file.to_str().unwrap(), "--json"]);
    // PPP: E = 5 − 0, B = 2. NPP: E = 2 − (−5), B = 2.
    let systematic = |i: usize| report["lines"][i]["bidirectional"]["systematic"]["value"].as_f64();
    assert_eq!([systematic(0), systematic(1)], [Some(5.0), Some(7.0)]);
    assert_eq!(report["diagonals"]["systematic"]["value"].as_f64(), Some(7.0));
    assert_eq!(report["diagonals"]["reversal"]["value"].as_f64(), Some(2.0));
    let text = prints(&["positioning", file.to_str().unwrap()]);
    assert!(text.starts_with("diagonals.csv: E_d 7 um, B_d 2 um (ISO 230-6)\n"), "{text}");
    let refused = abbe(&["positioning", file.to_str().unwrap(), "--out", "x.csv"]);
    assert!(refused.status == 2 && refused.stderr.contains("of diagonals and circles"), "{refused:?}");
    assert!(!Path::new("x.csv").exists());
}

#[test]
fn files_of_another_form_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        ("x,1+ (um)\n0,1\n", "no column is named `position`"),
        ("position,1+ (um)\n0,1\n1,2\n", "column `position` has no unit"),
        ("position (kg),1+ (um)\n0,1\n1,2\n", "`kg` is not a unit of a length or an angle"),
        ("position (mm),1+ (arcsec)\n0,1\n1,2\n", "not both lengths or both angles"),
        ("position (mm),first (um)\n0,1\n1,2\n", "no column has deviations"),
        ("position (mm),deviation (um)\n0,1\n1,2\n", "no column is named `direction`"),
        ("position (mm),direction,deviation (um)\n0,+,1\n1,left,2\n", "line 3: `left` is not a direction"),
        ("position (mm),direction,deviation (um)\n0,+,1\n1,+,\n", "line 3: `deviation (um)` is missing"),
        ("position (mm),1+ (um)\n0,1\n0,2\n", "fewer than two target positions"),
        ("position (mm),1+ (um)\n", "there are no readings"),
        (
            "0,1,2\n1,1,3\n",
            "Put a line with its 3 names, in the order of the columns, above it, such as `position (mm),direction,deviation (um)`",
        ),
        ("0,1,2\n1,1,3\n", "the file has no heading: its first line is numbers"),
    ];
    for (i, (text, message)) in cases.into_iter().enumerate() {
        let file = write(folder.path(), &format!("runs{i}.csv"), text);
        let run = abbe(&["positioning", file.to_str().unwrap()]);
        assert!(run.status == 2 && run.stdout.is_empty(), "{text}: {run:?}");
        assert!(run.stderr.contains(message) && run.stderr.contains("help: "), "{text}: {}", run.stderr);
    }
    let file = write(folder.path(), "runs.csv", WIDE);
    let run = abbe(&["positioning", file.to_str().unwrap(), "--reading-uncertainty", "3 kg"]);
    assert!(run.status == 2 && run.stderr.contains("--reading-uncertainty"), "{run:?}");
    let run = abbe(&["positioning", file.to_str().unwrap(), "--scale-uncertainty=-1um/m"]);
    assert!(run.status == 2 && run.stderr.contains("`--scale-uncertainty` is negative"), "{run:?}");
}
