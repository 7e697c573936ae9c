//! `abbe compensate` of robot programs: each is written and read back here by formulas of its own,
//! and the corrected positions are given to the real machine.

mod configurations;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use abbe::analysis::InverseKinematics;
use abbe::{Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use tempfile::tempdir;

use crate::bad_input::refused;
use crate::running::{abbe, shipped, write};

type Rows = [[f64; 3]; 3];

fn path(path: &Path) -> &str {
    path.to_str().expect("a path is text")
}

fn product(a: Rows, b: Rows) -> Rows {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Returns the rotation about an axis, 0 = x, by degrees.
fn about(axis: usize, degrees: f64) -> Rows {
    let (s, c) = degrees.to_radians().sin_cos();
    match axis {
        0 => [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]],
        1 => [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]],
        _ => [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
    }
}

/// Returns w x y z of a rotation, w ≥ 0.
fn quaternion(r: Rows) -> [f64; 4] {
    let part = |x: f64, y: f64, z: f64| (1.0 + x + y + z).max(0.0).sqrt() / 2.0;
    let [a, b, c] = [r[0][0], r[1][1], r[2][2]];
    [
        part(a, b, c),
        part(a, -b, -c).copysign(r[2][1] - r[1][2]),
        part(-a, b, -c).copysign(r[0][2] - r[2][0]),
        part(-a, -b, c).copysign(r[1][0] - r[0][1]),
    ]
}

/// Returns the rotation of a vector in rad, by Rodrigues' formula.
fn rotation([x, y, z]: [f64; 3]) -> Rows {
    let angle = (x * x + y * y + z * z).sqrt();
    let k = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]].map(|row| row.map(|v| v / angle));
    let (kk, (s, c)) = (product(k, k), angle.sin_cos());
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| f64::from(u8::from(i == j)) + s * k[i][j] + (1.0 - c) * kk[i][j]))
}

/// A language: the ending of its files, a line with a position, and the numbers of that line.
struct Language {
    ending: &'static str,
    head: &'static str,
    /// Line of a position, with its orientation and its joints in degrees.
    line: fn([f64; 3], Rows, &[f64; 6]) -> String,
    /// Beginning of a line with a position.
    begins: &'static str,
    read: fn(&[f64]) -> ([f64; 3], Rows),
    foot: &'static str,
}

/// Returns the angles of Rz Ry Rx in degrees.
fn zyx(r: Rows) -> [f64; 3] {
    let middle = (-r[2][0]).asin();
    [r[1][0].atan2(r[0][0]), middle, r[2][1].atan2(r[2][2])].map(f64::to_degrees)
}

/// Returns the angles of Rx Ry Rz in degrees.
fn xyz(r: Rows) -> [f64; 3] {
    let middle = r[0][2].asin();
    [(-r[1][2]).atan2(r[2][2]), middle, (-r[0][1]).atan2(r[0][0])].map(f64::to_degrees)
}

const LANGUAGES: [Language; 5] = [
    Language {
        ending: "mod",
        head: "MODULE Part ! [[1,2,3],[1,0,0,0],[0,0,0,0]] is no position\r\n  PERS wobjdata w:=[FALSE,TRUE,\"\",[[500,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\r\n  PERS tooldata t:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\r\n",
        line: |[x, y, z], r, q| {
            let [a, b, c, d] = quaternion(r);
            let [e, f, g] = [q[0], q[3], q[5]].map(|angle| (angle / 90.0).floor());
            let h = u8::from(q[4] < 0.0);
            format!(
                "  CONST robtarget p:=[ [{x:.4},{y:.4},{z:.4}], [{a:.9},{b:.9},{c:.9},{d:.9}],[{e},{f},{g},{h}],[9E9,9E9,9E9,9E9,9E9,9E9]];\r"
            )
        },
        begins: "  CONST robtarget",
        read: |n| {
            let [w, x, y, z] = [n[3], n[4], n[5], n[6]];
            let r = [
                [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
                [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
                [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
            ];
            ([n[0], n[1], n[2]], r)
        },
        foot: "  PROC main()\r\n    MoveL Offs(p,0,0,100),v100,fine,t;\r\n  ENDPROC\r\nENDMODULE\r\n",
    },
    Language {
        ending: "src",
        head: "DEF part()\n; LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n$TOOL={X 0,Y 0,Z 0,A 0,B 0,C 0}\n$BASE=$NULLFRAME\n",
        line: |[x, y, z], r, q| {
            let [a, b, c] = zyx(r);
            let turn: u32 = (0..6).map(|i| u32::from(q[i] < 0.0) << i).sum();
            format!("LIN {{X {x:.4},Y {y:.4},Z {z:.4},A {a:.7},B {b:.7},C {c:.7},S 2,T {turn}}} C_DIS")
        },
        begins: "LIN {",
        read: |n| {
            let r = product(product(about(2, n[3]), about(1, n[4])), about(0, n[5]));
            ([n[0], n[1], n[2]], r)
        },
        foot: "LIN_REL {X 0,Y 0,Z 100,A 0,B 0,C 0}\nPTP {Z 400}\nEND\n",
    },
    Language {
        ending: "LS",
        head: "/PROG PART\n/MN\n  1:L P[1] 100mm/sec FINE ;\n/POS\n",
        line: |[x, y, z], r, _| {
            let [a, b, c] = zyx(r);
            // One position is one line here, and several lines in the files of a controller.
            format!(
                "P[1]{{ GP1: UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0', X = {x:.4} mm, Y = {y:.4} mm, Z = {z:.4} mm, W = {c:.7} deg, P = {b:.7} deg, R = {a:.7} deg }};"
            )
        },
        begins: "P[1]{",
        // After P[1], GP1, UF : 0, UT : 1 and three turns.
        read: |n| {
            let r = product(product(about(2, n[12]), about(1, n[11])), about(0, n[10]));
            ([n[7], n[8], n[9]], r)
        },
        foot: "/END\n",
    },
    Language {
        ending: "script",
        head: "def part():\n  set_tcp(p[0, 0, 0, 0, 0, 0])\n  # p[1, 2, 3, 0, 0, 0]\n",
        line: |position, r, _| {
            let [x, y, z] = position.map(|v| 1e-3 * v);
            let [w, a, b, c] = quaternion(r);
            let sine = (a * a + b * b + c * c).sqrt();
            let [a, b, c] = [a, b, c].map(|v| 2.0 * sine.atan2(w) * v / sine);
            format!("  movel(p[{x:.7}, {y:.7}, {z:.7}, {a:.9}, {b:.9}, {c:.9}], a=1.2, v=0.25)")
        },
        begins: "  movel(",
        read: |n| ([n[0], n[1], n[2]].map(|v| 1e3 * v), rotation([n[3], n[4], n[5]])),
        foot: "  force_mode(p[0,0,0,0,0,0],[0,0,1,0,0,0],[0,0,9,0,0,0],2,[1,1,1,1,1,1])\nend\n",
    },
    Language {
        ending: "mxprog",
        head: "ActivateRobot\n",
        line: |[x, y, z], r, _| {
            let [a, b, c] = xyz(r);
            format!("MoveLin({x:.4},{y:.4},{z:.4},{a:.7},{b:.7},{c:.7})")
        },
        begins: "MoveLin(",
        read: |n| {
            let r = product(product(about(0, n[3]), about(1, n[4])), about(2, n[5]));
            ([n[0], n[1], n[2]], r)
        },
        foot: "MoveLinRelTrf(0,0,10,0,0,0)\n",
    },
];

/// Returns the numbers of a line.
fn numbers(line: &str) -> Vec<f64> {
    let parts = line.split(|c: char| !c.is_ascii_digit() && !".-".contains(c));
    parts.filter_map(|part| part.parse().ok()).collect()
}

/// Returns rotation and position.
fn parts(pose: &Pose) -> (Rows, [f64; 3]) {
    let Pose([x, y, z, p]) = *pose;
    ([0, 1, 2].map(|i| [x[i], y[i], z[i]]), p)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// Returns an arm in metres with errors, and joints along a path that begins near home.
fn arm_in_metres(folder: &Path) -> (std::path::PathBuf, Interpreter, Vec<[f64; 6]>) {
    let errors = "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_y = \"0.7 mm\"\ne_r = \"-0.5 mrad\"\n";
    let spec = write(folder, "puma.toml", &format!("{}{errors}", shipped("puma560")));
    let machine = Interpreter::new(Spec::read(&spec).unwrap());
    let at = |k: i32| {
        let u = f64::from(k) / 59.0;
        [0.9 * u, 1.5 - 0.4 * u, -1.4 + 0.3 * u, 0.3 * u - 0.2, 0.7 - 0.2 * u, 0.2 - 0.5 * u]
    };
    (spec, machine, (0..60).map(at).collect())
}

/// Returns a spec of an arm with errors, its real machine, and joints along a path.
fn arm(folder: &Path) -> (std::path::PathBuf, Interpreter, Vec<[f64; 6]>) {
    let errors = "\n[[source]]\nname = \"truth\"\nclass = \"repeatable\"\nframe = \"elbow\"\ne_x = \"0.6 mm\"\ne_s = \"0.8 mrad\"\n";
    let spec = write(folder, "real.toml", &format!("{}{errors}", shipped("ur5")));
    let machine = Interpreter::new(Spec::read(&spec).unwrap());
    let at = |k: i32| {
        let u = f64::from(k) / 199.0;
        [
            0.4 * (6.0 * u).sin(),
            -1.2 + 0.3 * (5.0 * u).cos(),
            1.3 + 0.3 * u,
            -0.6 + 0.2 * (4.0 * u).sin(),
            1.2,
            0.5 * u,
        ]
    };
    (spec, machine, (0..200).map(at).collect())
}

/// Given to the controller, whose inverse kinematics are nominal, the corrected positions bring the
/// real tool to those of the program.
#[test]
fn the_real_machine_reaches_the_positions_of_a_corrected_program() {
    let folder = tempdir().unwrap();
    let arms = [(1.0, arm(folder.path())), (1e3, arm_in_metres(folder.path()))];
    for ((mm, (spec, machine, joints)), language) in
        arms.iter().flat_map(|arm| LANGUAGES.iter().map(move |l| (arm, l)))
    {
        let inverse = InverseKinematics::new(machine, &[]).unwrap();
        // Positions in a frame that is turned about z and shifted.
        let (turned, shift) = (about(2, 30.0), [300.0, -40.0, 50.0]);
        let in_frame = |(r, p): (Rows, [f64; 3])| {
            let back = about(2, -30.0);
            let from = [0, 1, 2].map(|i| p[i] - shift[i]);
            let p = [0, 1, 2].map(|i| (0..3).map(|k| back[i][k] * from[k]).sum());
            (product(back, r), p)
        };
        let mut text = language.head.to_owned();
        for q in joints {
            let (r, p) = parts(&machine.pose(q, &[]).unwrap());
            let (r, p) = in_frame((r, p.map(|v| mm * v)));
            let _ = writeln!(text, "{}", (language.line)(p, r, &q.map(f64::to_degrees)));
        }
        text += language.foot;
        let program = write(folder.path(), &format!("part.{}", language.ending), &text);
        let out = folder.path().join(format!("corrected.{}", language.ending));
        let frame = "Tx(300 mm) Ty(-40 mm) Tz(50 mm) Rz(30deg)";
        let run = abbe(&["compensate", path(spec), path(&program), "--frame", frame, "-o", path(&out)]);
        assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
        let all = format!("{0} of {0} commands", joints.len());
        assert!(run.stdout.contains(&all), "{}", run.stdout);
        let corrected = fs::read_to_string(&out).unwrap();
        let signs = |text: &str| text.replace(|c: char| c.is_ascii_digit() || c == '-', "");
        assert_eq!(signs(&corrected), signs(&text), "other text changed");
        let read = |text: &str| -> Vec<([f64; 3], Rows)> {
            let lines = text.lines().filter(|line| line.starts_with(language.begins));
            lines.map(|line| (language.read)(&numbers(line))).collect()
        };
        let (mut before, mut after) = (0.0_f64, 0.0_f64);
        for (written, most) in [(read(&text), &mut before), (read(&corrected), &mut after)] {
            assert_eq!(written.len(), joints.len());
            for ((p, r), q) in written.into_iter().zip(joints) {
                let r = product(turned, r);
                let p = [0, 1, 2].map(|i| shift[i] + (0..3).map(|k| turned[i][k] * p[k]).sum::<f64>());
                let target =
                    Pose([0, 1, 2, 3].map(|j| [0, 1, 2].map(|i| if j < 3 { r[i][j] } else { p[i] / mm })));
                let commanded = inverse.solve(q, &target).unwrap();
                let real = machine.real_pose(&commanded[0], &[], &[]).unwrap();
                let wanted = machine.pose(q, &[]).unwrap();
                let ((r, p), (ideal, point)) = (parts(&real), parts(&wanted));
                // The largest difference of the axes counts at 1 m.
                let turn = (0..9).map(|k| (r[k / 3][k % 3] - ideal[k / 3][k % 3]).abs()).fold(0.0, f64::max);
                *most = most.max(mm * distance(p, point)).max(1e3 * turn);
            }
        }
        println!("{}: {before} mm down to {after} mm", language.ending);
        assert!(before > 0.45 && after < 1.2e-3, "{}: {before} down to {after}", language.ending);
    }
}

/// Joint targets are corrected, too; the map states how a controller counts.
#[test]
fn joint_targets_count_as_the_map_says() {
    let folder = tempdir().unwrap();
    let (spec, machine, joints) = arm(folder.path());
    let target = |q: &[f64; 6]| {
        let [a, b, c, d, e, f] = q.map(f64::to_degrees);
        format!("PTP {{A1 {:.7},A2 {b:.7},A3 {:.7},A4 {d:.7},A5 {e:.7},A6 {f:.7}}}\n", -a, c - 90.0)
    };
    let text: String = joints.iter().take(20).map(target).collect();
    let program = write(folder.path(), "part.src", &format!("DEF part()\n{text}END\n"));
    let mut map = "[data]\nuncertainty = \"1 mm\"\n\n[point]\ncolumns = [\"x\", \"y\", \"z\"]\nunit = \"mm\"\n\n[joints]\n".to_owned();
    for i in 1..=6 {
        let more = match i {
            1 => ", sign = -1",
            3 => ", zero = \"90 deg\"",
            _ => "",
        };
        let _ = writeln!(map, "q{i} = {{ column = \"A{i}\", unit = \"deg\"{more} }}");
    }
    let map = write(folder.path(), "map.toml", &map);
    let out = folder.path().join("corrected.src");
    let run = abbe(&["compensate", path(&spec), path(&program), "--map", path(&map), "-o", path(&out)]);
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
    let corrected = fs::read_to_string(&out).unwrap();
    let mut lines = corrected.lines().filter(|line| line.starts_with("PTP"));
    for q in joints.iter().take(20) {
        // Each key has a digit of its own.
        let n: Vec<f64> =
            numbers(&lines.next().unwrap().replace('A', " A")).chunks(2).map(|pair| pair[1]).collect();
        let [a, b, c, d, e, f] = [-n[0], n[1], n[2] + 90.0, n[3], n[4], n[5]].map(f64::to_radians);
        let real = machine.real_pose(&[a, b, c, d, e, f], &[], &[]).unwrap();
        let wanted = machine.pose(q, &[]).unwrap();
        assert!(distance(real.position(), wanted.position()) < 1e-3);
    }
}

/// Lines that are left as they are are named.
#[test]
fn programs_tell_what_they_leave() {
    let folder = tempdir().unwrap();
    let (spec, ..) = arm(folder.path());
    let far = "LIN {X 9000,Y 0,Z 0,A 0,B 0,C 0}\n";
    let text = format!(
        "DEF part()\n$BASE={{X 5,Y 0,Z 0,A 0,B 0,C 0}}\nPTP {{A1 0,A2 -80,A3 80,A4 0,A5 40,A6 0}}\n{far}PTP {{Z 400}}\nEND\n"
    );
    let program = write(folder.path(), "part.src", &text);
    let out = folder.path().join("out.src");
    let run = abbe(&["compensate", path(&spec), path(&program), "-o", path(&out)]);
    assert_eq!(run.status, 1, "{}{}", run.stdout, run.stderr);
    assert!(fs::read_to_string(&out).unwrap().contains(far));
    for expected in ["line 2 sets a frame of positions", "incomplete positions: line 2, 5"] {
        assert!(run.stderr.contains(expected), "{expected}: {}", run.stderr);
    }
    assert!(
        run.stdout.contains("line 4: the nominal machine does not reach this position"),
        "{}",
        run.stdout
    );
    let report = abbe(&["compensate", path(&spec), path(&program), "--json"]).stdout;
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["rows"].as_array().unwrap().len(), 1);
    let empty = write(folder.path(), "empty.script", "def part():\nend\n");
    refused(&["compensate", path(&spec), path(&empty)], &["URScript (Universal Robots) has no positions"]);
    let bad = ["compensate", path(&spec), path(&program), "--frame", "Tx(5 kg)"];
    refused(&bad, &["--frame"]);
    // Every position that is not corrected is named, whatever its variable is called.
    let text = "def part():\n  Offset_1_p=p[-0.7,-0.1,0.2,1,-0.7,-1]\n  movel(p[1e999,0,0,0,0,0])\n  movej([0,-1.4,1.4,0,0.5,0])\nend\n";
    let program = write(folder.path(), "my part.script", text);
    let run = abbe(&["compensate", path(&spec), path(&program)]);
    assert!(run.stderr.contains("incomplete positions: line 2"), "{}", run.stderr);
    assert!(
        run.stdout
            .contains("line 3: the nominal machine does not reach this position: its numbers are not finite"),
        "{}",
        run.stdout
    );
    // Bytes of another encoding stay; data with the ending of a program are data.
    let text = "MODULE A ! f\u{fc}r\nCONST jointtarget a:=[[0,-80,80,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nENDMODULE\n";
    let bytes: Vec<u8> = text.chars().map(|c| c as u8).collect();
    let (program, out) = (folder.path().join("latin.mod"), folder.path().join("out.mod"));
    fs::write(&program, &bytes).unwrap();
    assert_eq!(abbe(&["compensate", path(&spec), path(&program), "-o", path(&out)]).status, 0);
    let written = fs::read(&out).unwrap();
    assert!(
        written.starts_with(&bytes[..20]) && written.ends_with(b"9E9]];\nENDMODULE\n") && written != bytes
    );
    let data = write(folder.path(), "data.dat", "DEFLECTION,q1,q2,q3,q4,q5,q6\n0,0,-1,1,0,0.5,0\n");
    assert_eq!(abbe(&["compensate", path(&spec), path(&data)]).status, 0);
    refused(
        &["compensate", path(&spec), path(&data), "--frame", "Tx(5)"],
        &["only a program has its positions"],
    );
}
