//! Ctrl-C during long work: the process ends at once with status 130 and leaves no file.
//!
//! Each command would take minutes. The time until the end is printed; its limit is generous for
//! busy computers, yet far below the duration of the work.

#![cfg(unix)]

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::tempdir;

use crate::running::{UR5_MAP, command, prints, shipped, write};

/// Time before the interrupt.
const WORKED: Duration = Duration::from_millis(1500);
/// Limit of the time until the process ends.
const GONE: Duration = Duration::from_secs(5);

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

fn interrupt(mut child: Child, name: &str) {
    std::thread::sleep(WORKED);
    assert!(child.try_wait().unwrap().is_none(), "{name}: it was to take longer");
    let sent = Instant::now();
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    while child.try_wait().unwrap().is_none() {
        assert!(sent.elapsed() < GONE, "{name} works on");
        std::thread::sleep(Duration::from_millis(2));
    }
    println!("{name}: gone after {:.3} s", sent.elapsed().as_secs_f64());
    assert_eq!(child.wait().unwrap().code(), Some(130), "{name}");
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
        interrupt(command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap(), line[0]);
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
    input.write_all(b"q1,q2,q3,q4,q5,q6,x,y,z\n1,2,3,4,5,6,7,8,9\n").unwrap();
    interrupt(child, "measure of a pipe");
}
