//! The program of `docs/in-a-controller.md` is accepted, and does what the page says.

use std::f64::consts::TAU;
use std::path::Path;

use abbe_tests::structured_text::{Instance, Program};

use super::{shipped, text};

/// Returns the program of the chapter with the blocks that it uses.
fn program() -> Program {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/in-a-controller.md");
    let page = std::fs::read_to_string(page).unwrap();
    let (_, block) = page.split_once("```iecst\n").unwrap();
    let (code, _) = block.split_once("```").unwrap();
    Program::parse(&(text(&shipped("pps")) + code)).unwrap_or_else(|fault| panic!("{fault}"))
}

/// Runs a cycle, in which no drive may move further than its command and the bound of the change;
/// drives that stand, no further than the bound. Returns the drives.
fn cycle(main: &mut Instance<'_>, command: &[f64], is_standing: bool) -> Vec<f64> {
    const CHANGE: [f64; 6] = [1.0, 1.0, 1.0, 0.002, 0.002, 0.002];
    let (before, drives) = (main.get("command"), main.get("drives"));
    main.set("command", command);
    main.call().unwrap();
    let now = main.get("drives");
    for j in 0..6 {
        let commanded = if is_standing { 0.0 } else { (command[j] - before[j]).abs() };
        let moved = (now[j] - drives[j]).abs();
        assert!(moved <= commanded + CHANGE[j] * (1.0 + 1e-9), "joint {j} moves by {moved}");
    }
    now
}

#[test]
fn the_program_of_the_chapter_runs() {
    let program = program();
    let mut main = program.instance("main");
    let command = [9.0, 80.0, 987.0, 1.2, 0.02, 0.01];
    main.set("standing", &command);
    main.set("command", &command);
    main.call().unwrap();
    assert_eq!((main.get("drives"), main.get("is_reached")), (command.to_vec(), vec![0.0]));
    // Drives are enabled, and the correction moves in from cycle to cycle.
    main.set("enabled", &[1.0]);
    for k in 0..40 {
        cycle(&mut main, &command, k == 0);
    }
    assert_eq!((main.get("fault"), main.get("is_reached")), (vec![0.0], vec![1.0]));
    let before = main.get("drives");
    assert_ne!(before, command);
    // A command beyond the limits holds the drives where they are.
    let beyond = [9.0, 80.0, 987.0, 1.2, 0.02, 1.0];
    assert_eq!(cycle(&mut main, &beyond, true), before);
    assert_eq!((main.get("fault"), main.get("is_elsewhere")), (vec![1.0], vec![0.0]));
}

#[test]
fn faults_stay_and_drives_resume_where_they_stand() {
    let program = program();
    let (mut main, mut begin) = (program.instance("main"), program.instance("pps_begin"));
    begin.set("inputs", &[70.0, 0.0, 850.0]);
    let spec = shipped("pps");
    let at = |share: f64| -> Vec<f64> {
        let swing = |(j, [lower, upper]): (usize, [f64; 2])| {
            (lower + upper) / 2.0 + 0.3 * (upper - lower) * (TAU * share * (j + 1) as f64).sin()
        };
        spec.variables.iter().map(|variable| variable.limits).enumerate().map(swing).collect()
    };
    let mut standing = at(0.0);
    for stop in 0..50 {
        // The drives stand, and a rising edge ends the fault.
        main.set("standing", &standing);
        main.set("enabled", &[0.0]);
        main.set("acknowledged", &[0.0]);
        main.call().unwrap();
        main.set("acknowledged", &[1.0]);
        let share = f64::from(stop) / 50.0;
        main.set("command", &at(share));
        main.call().unwrap();
        assert_eq!((main.get("fault"), main.get("drives")), (vec![0.0], standing.clone()));
        // At the command that they carry out there, none moves.
        begin.set("q", &standing);
        begin.call().unwrap();
        assert_eq!(begin.get("status"), [0.0]);
        main.set("enabled", &[1.0]);
        let still = cycle(&mut main, &begin.get("command"), true);
        assert!(still.iter().zip(&standing).all(|(now, before)| (now - before).abs() < 1e-7), "{still:?}");
        main.set("enabled", &[0.0]);
        main.call().unwrap();
        main.set("enabled", &[1.0]);
        // Along a path that begins beside them, until something stops it.
        for k in 0..30 {
            cycle(&mut main, &at(share + f64::from(k) / 2000.0), k == 0);
        }
        let mut wrong = main.get("command");
        wrong[stop as usize % 6] = [1e40, -1e4][stop as usize % 2];
        let held = main.get("drives");
        assert_eq!(cycle(&mut main, &wrong, true), held);
        // The acknowledgement is still there, and ends nothing.
        main.set("standing", &held);
        for _ in 0..20 {
            assert_eq!(cycle(&mut main, &at(share), true), held);
            assert_eq!(main.get("fault"), [1.0]);
        }
        // A path that begins elsewhere is refused.
        main.set("acknowledged", &[0.0]);
        main.call().unwrap();
        main.set("acknowledged", &[1.0]);
        let mut elsewhere = at(share);
        elsewhere[1] += if elsewhere[1] < 280.0 { 100.0 } else { -100.0 };
        assert_eq!(cycle(&mut main, &elsewhere, true), held);
        assert_eq!((main.get("fault"), main.get("is_elsewhere")), (vec![1.0], vec![1.0]));
        // The drives are pushed while they stand.
        let far = [20.0, 20.0, 20.0, 0.05, 0.01, 0.01].map(|far| f64::from(stop % 7) / 7.0 * far);
        standing = at(share + 0.02).iter().zip(far).map(|(q, far)| q + far).collect();
    }
}
