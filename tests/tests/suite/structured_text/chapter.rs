//! The program of `docs/in-a-controller.md` is accepted, and does what the page says.

use std::path::Path;

use abbe_tests::structured_text::Program;

use super::{shipped, text};

#[test]
fn the_program_of_the_chapter_runs() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/in-a-controller.md");
    let page = std::fs::read_to_string(page).unwrap();
    let (_, block) = page.split_once("```iecst\n").unwrap();
    let (code, _) = block.split_once("```").unwrap();
    let whole = text(&shipped("pps")) + code;
    let program = Program::parse(&whole).unwrap_or_else(|fault| panic!("{fault}"));
    let mut cycle = program.instance("main");
    let command = [9.0, 80.0, 987.0, 1.2, 0.02, 0.01];
    cycle.set("command", &command);
    // Drives are enabled, and the correction moves in from cycle to cycle.
    cycle.set("enabled", &[1.0]);
    let mut before = command.to_vec();
    for k in 0..40 {
        cycle.call().unwrap();
        let drives = cycle.get("drives");
        assert!(drives.iter().zip(&before).all(|(now, then)| (now - then).abs() <= 1.0 + 1e-9), "cycle {k}");
        before = drives;
    }
    assert_eq!((cycle.get("hold"), cycle.get("is_reached")), (vec![0.0], vec![1.0]));
    assert_ne!(before, command);
    // A command beyond the limits holds the drives where they are.
    cycle.set("command", &[9.0, 80.0, 987.0, 1.2, 0.02, 1.0]);
    cycle.call().unwrap();
    assert_eq!((cycle.get("hold"), cycle.get("drives")), (vec![1.0], before));
}
