//! DH tables as specs: the poses are those of the closed-form matrices in the literature.

use std::f64::consts::FRAC_PI_2;

use abbe::analysis::sampling;
use abbe::{LengthUnit, Manipulator};
use abbe_interpreter::Interpreter;
use abbe_spec::{DhConvention, Document, Spec};
use abbe_study::Notes;
use abbe_study::import::{Format, Import, Report, Units};
use nalgebra::Matrix4;

/// Notes of an import.
#[derive(Default)]
pub(super) struct Heard(pub(super) Vec<String>);

impl Notes for Heard {
    fn note(&mut self, note: &str) {
        self.0.push(note.to_owned());
    }

    fn warn(&mut self, warning: &str) {
        self.0.push(warning.to_owned());
    }
}

struct Imported {
    report: Report,
    spec: Interpreter,
    heard: Vec<String>,
}

fn imported(table: &str, convention: DhConvention, units: Units, round_angles: bool) -> Imported {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("Two Arms.csv");
    std::fs::write(&file, table).unwrap();
    let mut heard = Heard::default();
    let report =
        Import { file, format: Format::Table { convention, units }, round_angles }.run(&mut heard).unwrap();
    let spec = Interpreter::new(Spec::parse("robot.toml", &report.spec).unwrap());
    Imported { report, spec, heard: heard.0 }
}

const IN_MM: Units = Units { length: Some(LengthUnit::Millimetre), degrees: Some(true) };
const IN_M: Units = Units { length: Some(LengthUnit::Metre), degrees: Some(false) };
const UNSAID: Units = Units { length: None, degrees: None };

/// Returns `A_i` in the standard convention (Siciliano, Spong), multiplied out.
fn standard([theta, d, a, alpha]: [f64; 4]) -> Matrix4<f64> {
    let ((st, ct), (sa, ca)) = (theta.sin_cos(), alpha.sin_cos());
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        ct, -st * ca, st * sa, a * ct,
        st, ct * ca, -ct * sa, a * st,
        0.0, sa, ca, d,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

/// Returns `A_i` in the modified convention, Craig, equation (3.6).
fn modified([theta, d, a, alpha]: [f64; 4]) -> Matrix4<f64> {
    let ((st, ct), (sa, ca)) = (theta.sin_cos(), alpha.sin_cos());
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        ct, -st, 0.0, a,
        st * ca, ct * ca, -sa, -sa * d,
        st * sa, ct * sa, ca, ca * d,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

/// Matrix of a row.
type Row = fn([f64; 4]) -> Matrix4<f64>;

fn convention(is_modified: bool) -> (DhConvention, Row) {
    match is_modified {
        false => (DhConvention::Standard, standard),
        true => (DhConvention::Modified, modified),
    }
}

/// Compares the poses of a spec with those of rows of parameters; `q` is in the order of the rows.
fn assert_same(
    imported: &Imported,
    matrix: fn([f64; 4]) -> Matrix4<f64>,
    rows: impl Fn(&[f64]) -> Vec<[f64; 4]>,
    size: f64,
) {
    let arm = &imported.spec;
    let count = arm.description().variables.len();
    for k in 1..200 {
        let q: Vec<f64> =
            (0..count).map(|i| (k as f64 * (i as f64 + 2.0).sqrt()).fract() * 5.0 - 2.5).collect();
        let expected = rows(&q).into_iter().map(matrix).product::<Matrix4<f64>>();
        let found = arm.pose(&q, &sampling::nominal_parameters(arm.description())).unwrap().rows();
        let found = Matrix4::from_fn(|i, j| found[i][j]);
        let off = (found - expected).abs().max();
        assert!(off < 4e-15 * size, "{off:.1e}");
    }
}

/// Checks both conventions, with offsets, signs, a prismatic joint, a fixed row, expressions in
/// cells and units of all kinds.
#[test]
fn rows_of_every_kind() {
    let table = "\
joint, type, theta, d, a, alpha, offset, lower, upper, sign, note
A1, R, q1, 0.4 m, 25, 90, 0, -170, 170, 1, first
A2, revolute, -90, 0, 455, 0, , -190, 45, -1, second
rail, P, 30, , 0, -90, 120, 0, 1.2 m, 1,
A3, R, 90 - elbow, 0, 35, pi/3, , -120, 156, , it counts backwards
plate, fixed, 10, 12.5, 0, 180, , , , ,
";
    let right = std::f64::consts::FRAC_PI_2;
    let [ten, thirty] = [10.0_f64.to_radians(), 30.0_f64.to_radians()];
    for is_modified in [false, true] {
        let (convention, matrix) = convention(is_modified);
        let imported = imported(table, convention, IN_MM, false);
        let names: Vec<&str> =
            imported.spec.description().variables.iter().map(|variable| &*variable.name).collect();
        assert_eq!(names, ["q1", "a2", "rail", "elbow"]);
        assert_eq!(imported.report.manipulator, "two_arms");
        assert_eq!(imported.heard, ["ignored columns: `note`"]);
        assert!(
            imported.report.spec.contains("limits = [\"-170 deg\", \"170 deg\"]"),
            "{}",
            imported.report.spec
        );
        let rows = |q: &[f64]| {
            vec![
                [q[0], 400.0, 25.0, right],
                [-right - q[1], 0.0, 455.0, 0.0],
                [thirty, q[2] + 120.0, 0.0, -right],
                [right - q[3], 0.0, 35.0, right / 1.5],
                [ten, 12.5, 0.0, 2.0 * right],
            ]
        };
        assert_same(&imported, matrix, rows, 1000.0);
    }
}

/// Checks decimal commas, a byte order mark, units in the heading, and Greek names.
#[test]
fn tables_of_other_countries() {
    let table = "\u{feff}# from a data sheet\r\n\r\n\"Nr.\";θ_i [°];d_i [mm];a_i [mm];α_i [°]\r\n\
                 1;θ₁;340,5;0;−90\r\n2;θ₂ + 12,5;0;0;90\r\n";
    let imported = imported(table, DhConvention::Standard, UNSAID, false);
    assert_eq!(imported.report.length, "mm");
    let right = std::f64::consts::FRAC_PI_2;
    let rows = |q: &[f64]| vec![[q[0], 340.5, 0.0, -right], [q[1] + 12.5_f64.to_radians(), 0.0, 0.0, right]];
    assert_same(&imported, standard, rows, 1000.0);
    // Each row names its variable.
    assert!(
        imported.heard.iter().all(|note| !note.contains("were read as revolute")),
        "{:?}",
        imported.heard
    );
}

/// Checks the output of the Robotics Toolbox for Python 1.1 for a chain with an offset, a prismatic
/// joint and a reversed joint, and for a Panda.
#[test]
fn the_robotics_toolbox_for_python() {
    let table = "\
DHRobot: mixed, 3 joints (RPR), standard DH parameters
┌─────────────────────┬────────────┬─────┬────────────────────┬─────────┬────────┐
│         θⱼ          │     dⱼ     │ aⱼ  │         ⍺ⱼ         │   q⁻    │   q⁺   │
├─────────────────────┼────────────┼─────┼────────────────────┼─────────┼────────┤
│  q1 + 90°           │        0.1 │   0 │              90.0° │ -180.0° │ 180.0° │
│ 17.188733853924695° │  q2 + 0.05 │ 0.2 │               0.0° │       0 │      1 │
│ -q3                 │          0 │   0 │ 7.073507755567091° │ -180.0° │ 180.0° │
└─────────────────────┴────────────┴─────┴────────────────────┴─────────┴────────┘
";
    let right = std::f64::consts::FRAC_PI_2;
    let mixed = imported(table, DhConvention::Standard, IN_M, false);
    assert_eq!(mixed.report.manipulator, "mixed");
    let rows = |q: &[f64]| {
        vec![[q[0] + right, 0.1, 0.0, right], [0.3, q[1] + 0.05, 0.2, 0.0], [-q[2], 0.0, 0.0, 0.123456]]
    };
    assert_same(&mixed, standard, rows, 2.0);

    let table = "\
DHRobot.Panda: Panda (by Franka Emika), 7 joints (RRRRRRR), dynamics, geometry, modified DH parameters
┌─────────┬────────┬─────┬───────┬─────────┬────────┐
│  aⱼ₋₁   │  ⍺ⱼ₋₁  │ θⱼ  │  dⱼ   │   q⁻    │   q⁺   │
├─────────┼────────┼─────┼───────┼─────────┼────────┤
│     0.0 │   0.0° │  q1 │ 0.333 │ -166.0° │ 166.0° │
│     0.0 │ -90.0° │  q2 │   0.0 │ -101.0° │ 101.0° │
│     0.0 │  90.0° │  q3 │ 0.316 │ -166.0° │ 166.0° │
│  0.0825 │  90.0° │  q4 │   0.0 │ -176.0° │  -4.0° │
│ -0.0825 │ -90.0° │  q5 │ 0.384 │ -166.0° │ 166.0° │
│     0.0 │  90.0° │  q6 │   0.0 │   -1.0° │ 215.0° │
│   0.088 │  90.0° │  q7 │ 0.107 │ -166.0° │ 166.0° │
└─────────┴────────┴─────┴───────┴─────────┴────────┘

┌──────┬───────────────────────────────────────┐
│ tool │ t = 0, 0, 0.1; rpy/xyz = -45°, 0°, 0° │
└──────┴───────────────────────────────────────┘
";
    let panda = imported(table, DhConvention::Modified, IN_M, false);
    assert_eq!(panda.report.manipulator, "panda");
    assert!(
        panda.heard.iter().any(|note| note.contains("base and tool is rounded and was ignored")),
        "{:?}",
        panda.heard
    );
    let numbers = [
        [0.333, 0.0, 0.0],
        [0.0, 0.0, -right],
        [0.316, 0.0, right],
        [0.0, 0.0825, right],
        [0.384, -0.0825, -right],
        [0.0, 0.0, right],
        [0.107, 0.088, right],
    ];
    let rows = |q: &[f64]| q.iter().zip(numbers).map(|(q, [d, a, alpha])| [*q, d, a, alpha]).collect();
    assert_same(&panda, modified, rows, 2.0);
}

/// Checks the output of the Robotics Toolbox for MATLAB: rad with four decimals.
#[test]
fn the_robotics_toolbox_for_matlab() {
    let table = "\
Puma 560 [Unimation]:: 6 axis, RRRRRR, stdDH, fastRNE
 - viscous friction; params of 8/95;
+---+-----------+-----------+-----------+-----------+-----------+
| j |     theta |         d |         a |     alpha |    offset |
+---+-----------+-----------+-----------+-----------+-----------+
|  1|         q1|          0|          0|     1.5708|          0|
|  2|         q2|          0|     0.4318|          0|          0|
|  3|         q3|    0.15005|     0.0203|    -1.5708|          0|
|  4|         q4|     0.4318|          0|     1.5708|          0|
|  5|         q5|          0|          0|    -1.5708|     1.5708|
|  6|         q6|          0|          0|          0|          0|
+---+-----------+-----------+-----------+-----------+-----------+
tool:    t = (0, -0.1, 0), RPY/xyz = (-1.57, 0, -1.57) deg
";
    for round_angles in [false, true] {
        let right = if round_angles { std::f64::consts::FRAC_PI_2 } else { 15_708.0 / 10_000.0 };
        let puma = imported(table, DhConvention::Standard, IN_M, round_angles);
        assert_eq!(puma.report.manipulator, "puma_560");
        assert!(puma.heard.iter().any(|note| note.contains("5 angles")), "{:?}", puma.heard);
        let rows = |q: &[f64]| {
            vec![
                [q[0], 0.0, 0.0, right],
                [q[1], 0.0, 0.4318, 0.0],
                [q[2], 0.15005, 0.0203, -right],
                [q[3], 0.4318, 0.0, right],
                [q[4] + right, 0.0, 0.0, -right],
                [q[5], 0.0, 0.0, 0.0],
            ]
        };
        assert_same(&puma, standard, rows, 2.0);
    }
}

/// Returns T(xyz) Rz(yaw) Ry(pitch) Rx(roll), as in URDF.
fn placed(xyz: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Matrix4<f64> {
    Matrix4::new_translation(&xyz.into())
        * nalgebra::Rotation3::from_euler_angles(roll, pitch, yaw).to_homogeneous()
}

/// Checks that base and tool are the first and the last row, by `kind` or else by name, and may
/// have DH parameters.
#[test]
fn rows_of_base_and_tool() {
    let with_kind = "\
joint,kind,theta,d,a,alpha,x,y,z,roll,pitch,yaw,lower,upper
,base,,,,,100,-200,0.4 m,0,30,90,,
base,revolute,,340,0,-90,,,,,,,-170,170
arm,revolute,,0,260,0,0,0,0.0,,,,-120,120
flange,tool,,,,,0,12,80,10,-20,135,,
";
    let by_name = "\
name,theta,d,a,alpha,x,y,z,roll,pitch,yaw
Base,,,,,100,-200,400,0,30,90
waist,q1,340,0,-90,,,,,,
arm,q2,0,260,0,,,,,,
TOOL,,,,,0,12,80,10,-20,135
";
    let degrees = |angles: [f64; 3]| angles.map(f64::to_radians);
    let base = placed([100.0, -200.0, 400.0], degrees([0.0, 30.0, 90.0]));
    let tool = placed([0.0, 12.0, 80.0], degrees([10.0, -20.0, 135.0]));
    for (convention, matrix) in
        [(DhConvention::Standard, standard as fn([f64; 4]) -> _), (DhConvention::Modified, modified)]
    {
        for table in [with_kind, by_name] {
            let Imported { report, spec, heard } = imported(table, convention, IN_MM, false);
            assert_eq!(report.frames.len(), 3, "{report:?}");
            assert!(heard.iter().all(|note| !note.contains("not read")), "{heard:?}");
            let right = -std::f64::consts::FRAC_PI_2;
            for q in [[0.0, 0.0], [0.7, -1.3]] {
                let joints = matrix([q[0], 340.0, 0.0, right]) * matrix([q[1], 0.0, 260.0, 0.0]);
                let found = spec.pose(&q, &sampling::nominal_parameters(spec.description())).unwrap().rows();
                let off = base * joints * tool - Matrix4::from_fn(|i, j| found[i][j]);
                assert!(off.abs().max() < 1e-12 * 1e3, "{off}");
            }
        }
    }
    // DH parameters of a tool form a row of the table without errors of its own. Columns of a
    // position are not read without rows of base or tool.
    let table = "kind,theta,d,a,alpha,x\nrevolute,q1,340,0,-90,7\nrevolute,q2,0,260,0,7\n";
    let unread = imported(table, DhConvention::Standard, IN_MM, false);
    assert!(unread.heard.iter().any(|note| note == "ignored columns: `x`"), "{:?}", unread.heard);
    let table = "kind,theta,d,a,alpha\nrevolute,q1,340,0,-90\ntool,30,80,5,45\n";
    let Imported { report, spec, .. } = imported(table, DhConvention::Modified, IN_MM, false);
    assert_eq!(report.frames.len(), 1);
    let [turn, tilt] = [30_f64, 45.0].map(f64::to_radians);
    let right = -std::f64::consts::FRAC_PI_2;
    let expected = modified([0.4, 340.0, 0.0, right]) * modified([turn, 80.0, 5.0, tilt]);
    let found = spec.pose(&[0.4], &[]).unwrap().rows();
    assert!((expected - Matrix4::from_fn(|i, j| found[i][j])).abs().max() < 1e-10);
}

/// Checks that a rejected table produces no notes besides its diagnostics.
#[test]
fn rows_with_two_variables_are_no_rows_without() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("table.csv");
    std::fs::write(&file, "theta,d,a,alpha\nq1,d1,0,90\n").unwrap();
    let format = Format::Table { convention: DhConvention::Standard, units: IN_MM };
    let mut heard = Heard::default();
    let refused = Import { file, format, round_angles: false }.run(&mut heard).unwrap_err().to_string();
    assert!(refused.contains("this row has two variables"), "{refused}");
    assert!(heard.0.is_empty(), "{:?}", heard.0);
}

/// Checks tables from spreadsheets, which write a tab for every cell, including empty ones at the
/// end. A shorter row is rejected.
#[test]
fn empty_cells_at_the_end_are_cells() {
    let table = "theta\td\ta\talpha\tlower\tupper\r\nq1\t400\t25\t90\t\t\r\nq2\t0\t560\t0\t-90\t90\r\n";
    assert_eq!(imported(table, DhConvention::Standard, IN_MM, true).report.frames.len(), 2);
    for short in ["q1\t400\t25\t90\t\r", "q1\t400\t25\r", "q1\r"] {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("table.tsv");
        std::fs::write(&file, table.replacen("q1\t400\t25\t90\t\t\r", short, 1)).unwrap();
        let format = Format::Table { convention: DhConvention::Standard, units: IN_MM };
        let refused = Import { file, format, round_angles: false }.run(&mut ()).unwrap_err().to_string();
        assert!(refused.contains("the heading has 6") && refused.contains("the row ends here"), "{refused}");
    }
}

/// Checks that tables with changed, missing and repeated characters are read or rejected with a
/// help.
#[test]
fn damaged_tables() {
    let tables = [
        "joint,type,theta,d,a,alpha,offset,lower,upper\nA1,R,q1,0.4 m,25,90,0,-170,170\nrail,P,30,,0,-90,120,0,1.2 m\n",
        "│ θⱼ │ dⱼ │ aⱼ │ ⍺ⱼ │\n├────┤\n│ q1 + 90° │ 0.1 │ 0 │ 90.0° │\n│ -q2 │ 0 │ 1 │ −90° │\n└────┘\n",
    ];
    let pieces = [
        "", ",", ";", "│", "|", "\"", "°", "q", "θ", "-", "+", "−", "*", "pi", " ", "\n", "1e309", "nan",
        "mm", "(",
    ];
    // SplitMix64.
    let mut state = 14_u64;
    let mut random = |below: usize| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % below as u64) as usize
    };
    let folder = tempfile::tempdir().unwrap();
    let (mut read, mut refused) = (0, 0);
    for k in 0..3000 {
        let mut table: Vec<char> = tables[k % 2].chars().collect();
        for _ in 0..1 + random(3) {
            let at = random(table.len());
            let piece = pieces[random(pieces.len())];
            table.splice(at..at + random(2), piece.chars());
        }
        let file = folder.path().join("table.csv");
        std::fs::write(&file, table.iter().collect::<String>()).unwrap();
        let format = Format::Table { convention: convention(k % 3 == 0).0, units: IN_MM };
        match (Import { file, format, round_angles: false }).run(&mut ()) {
            Ok(_) => read += 1,
            Err(mistakes) => {
                assert!(mistakes.list.iter().all(|mistake| mistake.help.is_some()), "{mistakes}");
                assert!(!mistakes.to_string().contains("mistake of abbe"), "{mistakes}");
                refused += 1;
            }
        }
    }
    // Most damage shortens a row.
    assert!(read > 300 && refused > 300, "{read} read, {refused} refused");
}

/// A row of numbers among rows that name their variables moves nothing.
#[test]
fn rows_of_numbers_among_named_ones_are_fixed() {
    let table = "name,theta,d,a,alpha\nfoot,0.2,0.3,0,pi\n1,q1,0,0.4,0\n2,q2 + pi,0,0.2,0\n";
    let arm = imported(table, DhConvention::Standard, IN_M, false);
    assert_eq!(
        arm.spec.description().variables.iter().map(|one| &*one.name).collect::<Vec<_>>(),
        ["q1", "q2"]
    );
    let pi = std::f64::consts::PI;
    assert_same(
        &arm,
        standard,
        |q| vec![[0.2, 0.3, 0.0, pi], [q[0], 0.0, 0.4, 0.0], [q[1] + pi, 0.0, 0.2, 0.0]],
        1.0,
    );
    assert!(arm.heard[0].contains("`foot` is fixed"), "{:?}", arm.heard);
    assert!(arm.heard.iter().all(|note| !note.contains("all joints were read")), "{:?}", arm.heard);
    // Without any name, or with limits, all rows are joints.
    for table in [
        "theta,d,a,alpha\n0,0.3,0,pi\n0.1,0,0.4,0\n",
        "theta,d,a,alpha,lower,upper\n0,0.3,0,pi,-1,1\nq2,0,0.4,0,-1,1\n",
    ] {
        assert_eq!(
            imported(table, DhConvention::Standard, IN_M, false).spec.description().variables.len(),
            2
        );
    }
}

/// A joint may turn with that of a row above, in either sign.
#[test]
fn rows_of_coupled_joints() {
    let table =
        "theta,d,a,alpha\n90 - q1,400,25,90\n\"-q1 + q2 - 90\",0,560,0\nq2 + q3,0,35,90\n0,d4 - 2e1,0,0\n";
    for (convention, matrix) in
        [(DhConvention::Standard, standard as Row), (DhConvention::Modified, modified)]
    {
        let arm = imported(table, convention, IN_MM, false);
        let rows = |q: &[f64]| {
            vec![
                [FRAC_PI_2 - q[0], 400.0, 25.0, FRAC_PI_2],
                [q[1] - q[0] - FRAC_PI_2, 0.0, 560.0, 0.0],
                [q[1] + q[2], 0.0, 35.0, FRAC_PI_2],
                [0.0, q[3] - 20.0, 0.0, 0.0],
            ]
        };
        assert_same(&arm, matrix, rows, 1000.0);
    }
    let format = Format::Table { convention: DhConvention::Standard, units: IN_MM };
    // A row of numbers that another row names is no fixed one.
    let arm =
        imported("theta,d,a,alpha\n0,400,25,90\nq2 - q1,0,560,0\n", DhConvention::Standard, IN_MM, false);
    let rows = |q: &[f64]| vec![[q[0], 400.0, 25.0, FRAC_PI_2], [q[1] - q[0], 0.0, 560.0, 0.0]];
    assert_same(&arm, standard, rows, 1000.0);
    let slide = "theta,d,a,alpha\n0,d1,0,90\nq2 - d1,0,560,0\n";
    let import = Import { file: "t.csv".into(), format: format.clone(), round_angles: false };
    let refused = import.read(Document::new("t.csv", slide), &mut ()).unwrap_err().to_string();
    assert!(refused.contains("`d1` moves a joint of the other kind"), "{refused}");
    for (cell, part) in [("q2 - q3", "`q3` is no variable of a row above"), ("q1 q2", "expected a number")] {
        let text = format!("theta,d,a,alpha\nq1,0,0,90\n{cell},0,560,0\n");
        let import = Import { file: "t.csv".into(), format: format.clone(), round_angles: false };
        let refused = import.read(Document::new("t.csv", text.as_str()), &mut ()).unwrap_err().to_string();
        assert!(refused.contains(part), "{refused}");
    }
}
