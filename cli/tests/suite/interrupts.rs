//! Ctrl-C during long work: the process ends at once with status 130 and leaves no file.
//!
//! Each command would take minutes. It is interrupted after a given processor time, and its
//! processor time after the signal is limited: unlike time, both do not depend on other load.

#![cfg(target_os = "linux")]

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Child, Stdio};

use abbe_tests::processes::{SECOND, has_ended, processor_time, wait_for};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use tempfile::tempdir;

use crate::running::{UR5_MAP, command, prints, shipped, write};

/// Processor time before the interrupt.
const WORKED: u64 = SECOND / 2;
/// Limit of the processor time after it.
const GONE: u64 = 2 * SECOND;

/// Writes rows of the shipped UR5 that repeat except for the last joint and a little noise.
fn rows(folder: &Path, map: &Path, count: usize) -> String {
    let some = prints(&["simulate", "ur5", "--map", map.to_str().unwrap(), "--samples", "1000"]);
    let mut lines = some.lines();
    let mut text = lines.next().unwrap().to_owned() + "\n";
    let lines: Vec<(&str, &str)> = lines.map(|line| line.rsplit_once(',').unwrap()).collect();
    for i in 0..count {
        let (first, z) = lines[i % lines.len()];
        let z: f64 = z.parse().unwrap();
        text += &format!("{first},{}\n", z + (i / lines.len()) as f64 * 1e-7);
    }
    let path = write(folder, "rows.csv", &text);
    path.to_str().unwrap().to_owned()
}

/// Returns a spec of a serial chain with this number of frames.
fn long(frames: usize) -> String {
    let mut spec = "[manipulator]\nname = \"long\"\nlength = \"mm\"\n".to_owned();
    for i in 0..frames {
        spec += &format!(
            "[[frame]]\nname = \"f{i}\"\nvariable = {{ name = \"q{i}\", kind = \"revolute\", limits = [-1, 1] }}\n\
             transform = \"Rz(q{i}) Tx({}) Rx(0.3)\"\n",
            10 + i % 7
        );
    }
    spec
}

/// Interrupts a command. Asserts that it ends by the signal, and not by its work.
fn interrupt(mut child: Child, name: &str) {
    let process = child.id();
    let before = processor_time(process).unwrap();
    kill(Pid::from_raw(process.try_into().unwrap()), Signal::SIGINT).unwrap();
    wait_for(&format!("the end of {name}"), || has_ended(process));
    let more = processor_time(process).unwrap() - before;
    println!("{name}: {more} hundredths of a second after {before}");
    assert_eq!(child.wait().unwrap().code(), Some(130), "{name}");
    assert!(more < GONE, "{name} works on for {more} hundredths of a second");
}

#[test]
fn whoever_is_interrupted_is_gone_at_once() {
    let folder = tempdir().unwrap();
    let map = write(folder.path(), "map.toml", UR5_MAP);
    let rows = rows(folder.path(), &map, 600_000);
    let study = "[study]\ntitle = \"many\"\n[workspace.random]\nsamples = 100000000\n";
    let study = write(folder.path(), "study.toml", study);
    let long = write(folder.path(), "long.toml", &long(3_000));
    let spec = write(folder.path(), "arm.toml", shipped("ur5"));
    let [map, study, long, spec] = [&map, &study, &long, &spec].map(|path| path.to_str().unwrap());
    let out = folder.path().join("out");
    let out = out.to_str().unwrap();
    let before = fs::read_dir(folder.path()).unwrap().count();
    let lines: [&[&str]; 8] = [
        &["analyze", spec, "--study", study],
        &["analyze", spec, "--study", study, "--out", out],
        &["plan", spec, "--map", map, "--optimal", "3000", "--candidates", "200000", "--out", out],
        &["identify", spec, &rows, "--map", map, "--out", out],
        &["measure", spec, &rows, "--map", map],
        &["compensate", spec, &rows, "--map", map, "--out", out],
        &["simulate", spec, "--map", map, "--samples", "1000000", "--out", out],
        &["check", long],
    ];
    for line in lines {
        let mut command = command(line);
        let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let is_at_work = || has_ended(child.id()) || processor_time(child.id()) >= Some(WORKED);
        wait_for(&format!("work of {line:?}"), is_at_work);
        interrupt(child, line[0]);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), before, "{line:?} leaves something");
    }
}

/// The command waits for a pipe that nobody writes to.
#[test]
fn a_pipe_that_never_ends_is_no_prison() {
    let folder = tempdir().unwrap();
    let map = write(folder.path(), "map.toml", UR5_MAP);
    let mut command = command(&["measure", "ur5", "/dev/stdin", "--map", map.to_str().unwrap()]);
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    // More than a pipe holds: the command has read the first rows when the last ones are written.
    let rows = "1,2,3,4,5,6,7,8,9\n".repeat(50_000);
    input.write_all(format!("q1,q2,q3,q4,q5,q6,x,y,z\n{rows}").as_bytes()).unwrap();
    interrupt(child, "measure of a pipe");
}
