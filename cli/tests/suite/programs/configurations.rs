//! Joints of a position by the configuration that stands with it.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use abbe::analysis::InverseKinematics;
use abbe::{Manipulator, Pose};
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;
use tempfile::tempdir;

use super::{LANGUAGES, Language, Rows, distance, numbers, parts, path};
use crate::running::{abbe, write};

/// The arm of `docs/programs.md`, with its errors.
fn six_axes(folder: &Path) -> (PathBuf, Interpreter) {
    let chapter = fs::read_to_string("../docs/programs.md").unwrap();
    let text = chapter.split("```toml\n").nth(1).and_then(|text| text.split("```").next()).unwrap();
    let spec = write(folder, "arm.toml", text);
    let machine = Interpreter::new(Spec::read(&spec).unwrap());
    (spec, machine)
}

/// Corrects a program of these joints in degrees, and returns the distances in mm by which
/// the real tool misses its positions, what is said, and the corrected program.
fn missed(
    (spec, machine): &(PathBuf, Interpreter),
    language: &Language,
    joints: &[[f64; 6]],
    line: impl Fn([f64; 3], Rows, &[f64; 6]) -> String,
) -> (Vec<f64>, String, String) {
    let folder = tempdir().unwrap();
    let inverse = InverseKinematics::new(machine, &[]).unwrap();
    let mut text = language.head.to_owned();
    for q in joints {
        let (r, p) = parts(&machine.pose(&q.map(f64::to_radians), &[]).unwrap());
        let _ = writeln!(text, "{}", line(p, r, q));
    }
    text += language.foot;
    let program = write(folder.path(), &format!("part.{}", language.ending), &text);
    let out = folder.path().join(format!("corrected.{}", language.ending));
    let run = abbe(&["compensate", path(spec), path(&program), "-o", path(&out)]);
    let corrected = fs::read_to_string(&out).unwrap();
    let lines = corrected.lines().filter(|line| line.starts_with(language.begins));
    let misses = lines.zip(joints).map(|(line, q)| {
        let q = q.map(f64::to_radians);
        let ([x, y, z], r) = (language.read)(&numbers(line));
        let target = [
            [r[0][0], r[1][0], r[2][0]],
            [r[0][1], r[1][1], r[2][1]],
            [r[0][2], r[1][2], r[2][2]],
            [x, y, z],
        ];
        let commanded = inverse.solve(&q, &Pose(target)).unwrap();
        let real = machine.real_pose(&commanded[0], &[], &[]).unwrap();
        distance(real.position(), machine.pose(&q, &[]).unwrap().position())
    });
    (misses.collect(), run.stderr, corrected.clone())
}

/// A position is corrected for the joints of its configuration, wherever those before it are.
#[test]
fn configurations_choose_the_joints() {
    let folder = tempdir().unwrap();
    let arm = six_axes(folder.path());
    // Anywhere: each position in a configuration of its own. cfx by the geometry of the drawing.
    let fraction =
        |k: usize, i: usize| (k as f64 * [0.7549, 0.5698, 0.4301, 0.3247, 0.2451, 0.185][i]).fract();
    let anywhere = |k: usize| {
        let limits = [
            [-160.0, 160.0],
            [-100.0, 100.0],
            [-105.0, 65.0],
            [-155.0, 155.0],
            [-115.0, 115.0],
            [-170.0, 170.0],
        ];
        std::array::from_fn(|i| limits[i][0] + fraction(k, i) * (limits[i][1] - limits[i][0]))
    };
    let joints: Vec<[f64; 6]> = (1..=120).map(anywhere).collect();
    let rapid = &LANGUAGES[0];
    let cfx = |q: &[f64; 6]| {
        let ([a, b], [c, d]) = (
            [q[1], q[1] + q[2]].map(|v| v.to_radians().sin()),
            [q[1], q[1] + q[2]].map(|v| v.to_radians().cos()),
        );
        let forearm = [70.0 * b + 302.0 * d, 70.0 * d - 302.0 * b];
        let reach = 270.0 * a + forearm[0];
        let side: f64 = a * forearm[1] - c * forearm[0];
        4 * u8::from(reach < 0.0) + 2 * u8::from(side > 0.0) + u8::from(q[4] < 0.0)
    };
    let line = |p, r, q: &[f64; 6]| {
        let text = (rapid.line)(p, r, q);
        let (before, after) = text.split_once("],[9E9").unwrap();
        format!("{},{}],[9E9{after}", before.rsplit_once(',').unwrap().0, cfx(q))
    };
    let wrong = |missed: &[f64]| missed.iter().filter(|distance| **distance > 1e-3).count();
    let (misses, said, corrected) = missed(&arm, rapid, &joints, line);
    assert!(wrong(&misses) == 0 && !said.contains("configuration"), "{misses:?}: {said}");
    // Where a correction passes 0 or a quarter turn, what stands there is that of the corrected
    // joints.
    let inverse = InverseKinematics::new(&arm.1, &[]).unwrap();
    let changes =
        |language: &Language, corrected: &str, joints: &[[f64; 6]], of: fn(&[f64; 6]) -> Vec<f64>| {
            let lines = corrected.lines().filter(|line| line.starts_with(language.begins));
            let is_changed = |(line, q): (&str, &[f64; 6])| {
                let n = numbers(line);
                let ([x, y, z], r) = (language.read)(&n);
                let [a, b, c] = [0, 1, 2].map(|j| [r[0][j], r[1][j], r[2][j]]);
                let found = inverse.solve(&q.map(f64::to_radians), &Pose([a, b, c, [x, y, z]])).unwrap();
                let new = of(&std::array::from_fn(|i| found[0][i].to_degrees()));
                assert_eq!(new, n[7..7 + new.len()], "{line}");
                new != of(q)
            };
            lines.zip(joints).filter(|pair| is_changed(*pair)).count()
        };
    let quarters = |q: &[f64; 6]| [q[0], q[3], q[5]].map(|angle| (angle / 90.0).floor()).to_vec();
    assert!(changes(rapid, &corrected, &joints, quarters) > 0);
    // Beside A2 = 0.
    let beside = |k: i32| [20.0, 0.002 + 0.005 * f64::from(k), 10.0, 30.0, 40.0, 50.0];
    let joints_beside: Vec<[f64; 6]> = (-20..20).map(beside).collect();
    let (.., corrected) = missed(&arm, &LANGUAGES[1], &joints_beside, LANGUAGES[1].line);
    let turn = |q: &[f64; 6]| vec![(0..6).map(|i| f64::from(u8::from(q[i] < 0.0) << i)).sum()];
    assert!(changes(&LANGUAGES[1], &corrected, &joints_beside, turn) > 0);
    // Without: the nearest to those before are often others.
    let without = |p, r, q: &[f64; 6]| {
        let text = (rapid.line)(p, r, q);
        let (start, rest) = text.split_once("],[").unwrap();
        format!("{start}],[9,9,9,x],[{}", rest.split_once("],[").unwrap().1)
    };
    let (misses, ..) = missed(&arm, rapid, &joints, without);
    let wrong_without = wrong(&misses);
    assert!(wrong_without > 40, "{wrong_without}");
    // One that no joints have is said.
    let (_, said, _) = missed(&arm, rapid, &joints[..3], |p, r, q| {
        let mut other = *q;
        other[0] += 90.0;
        (rapid.line)(p, r, &other)
    });
    assert!(said.contains("no joints of the nominal machine have all of the configuration"), "{said}");
    // TP's letter of the wrist is not read: of the errors of this arm none is there.
    for language in &LANGUAGES[1..3] {
        let letters = |q: &[f64; 6]| ["U T", "U B", "D T", "D B"][usize::from(cfx(q) & 2 | cfx(q) >> 2)];
        let line = |p, r, q: &[f64; 6]| {
            (language.line)(p, r, q)
                .replace("U T", letters(q))
                .replace("S 2", ["S 2", "S 3", "S 0", "S 1"][usize::from(cfx(q) & 2 | cfx(q) >> 2)])
        };
        let (misses, said, _) = missed(&arm, language, &joints, line);
        println!("{}: {} of {}", language.ending, wrong(&misses), joints.len());
        assert!(wrong(&misses) == 0 && !said.contains("configuration"), "{}: {said}", language.ending);
    }
}
