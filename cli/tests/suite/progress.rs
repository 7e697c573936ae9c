//! A long run shows its progress on a terminal: count, total, remaining time and Ctrl-C. Nothing of
//! that goes into a pipe.

use std::fs::{self, File};
use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Instant;

use abbe_tests::processes::{WATCHDOG, has_ended, processor_time, wait_for};
use abbe_tests::thorough;
use nix::pty::{Winsize, openpty};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::running::command;
use crate::workshop::Workshop;

/// Number of rows of `long.csv` and of `some.csv`.
const ROWS: [usize; 2] = [400_000, 30_000];

/// Long runs; the test ends them after the first progress line. An ordinary run has the first two.
const LONG: [&str; 4] = [
    "analyze s.toml --study slow.toml",
    "identify s.toml some.csv --map m.toml --terms auto",
    "plan s.toml --map m.toml --optimal 2000 --candidates 50000",
    "compensate s.toml long.csv --map m.toml",
];

/// Runs with long parts that have no count; they show the elapsed time. An ordinary run has the
/// first.
const UNCOUNTED: [&str; 3] = [
    "check long.toml",
    "measure s.toml long.csv --map m.toml",
    "simulate s.toml --map m.toml --samples 2000000",
];

/// Returns the workshop with long measurements and a long chain. The measurements have errors that
/// many terms explain.
fn workshop() -> Workshop {
    let workshop = Workshop::new();
    let row = |i: usize| {
        let (d1, degrees) = ((i % 801) as f64, (i % 299) as f64 - 149.0);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let turns = |times: f64| (times * degrees.to_radians()).sin_cos();
        let x = 850.0 * cos + 0.03 * turns(2.0).1 + 0.02 * turns(3.0).0;
        let y = 850.0 * sin + 0.02 * turns(2.0).0 + 0.01 * turns(5.0).1;
        let z = d1 + 200.0 + 0.02 * sin + 0.01 * turns(3.0).1 + 1e-7 * d1 * d1;
        format!("{d1},{degrees},{x},{y},{z}\n")
    };
    for (name, count) in ["long.csv", "some.csv"].into_iter().zip(ROWS) {
        if name == "some.csv" || thorough() {
            let rows: String = (0..count).map(row).collect();
            fs::write(workshop.at(name), format!("d1,q2 (deg),x,y,z\n{rows}")).unwrap();
        }
    }
    fs::write(workshop.at("long.toml"), abbe_tests::chains::revolute_chain(1500)).unwrap();
    let slow = "[study]\ntitle = \"Slow\"\n[workspace.joints]\nsamples = 100000000\n";
    fs::write(workshop.at("slow.toml"), slow).unwrap();
    workshop
}

/// Reads from one end of a terminal on a thread.
fn heard(mut from: File) -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        let mut piece = [0; 4096];
        // Reading from a terminal without a writer ends with an error.
        while let Ok(length @ 1..) = from.read(&mut piece) {
            if sender.send(piece[..length].to_vec()).is_err() {
                return;
            }
        }
    });
    receiver
}

/// Parses count and total from a progress line that also has the remaining time and Ctrl-C.
fn progress_counts(text: &str) -> Option<(usize, usize)> {
    let (before, after) = text.split_once(" done, ")?;
    let (before, total) = before.rsplit_once(" of ")?;
    let done = before.rsplit(|c: char| !c.is_ascii_digit()).next()?;
    let (left, _) = after.split_once(" left, Ctrl-C stops")?;
    let number = left.trim_end_matches(['s', 'm', 'h', 'd', 'w', 'y']);
    (number != left && number.parse().is_ok_and(|number: u64| number > 0)).then_some(())?;
    Some((done.parse().ok()?, total.parse().ok()?))
}

/// Sends Ctrl-C and returns the exit status.
fn interrupted(mut child: Child) -> Option<i32> {
    kill(Pid::from_raw(child.id().try_into().unwrap()), Signal::SIGINT).unwrap();
    let status = child.wait().unwrap();
    status.code().or(status.signal())
}

fn start(workshop: &Workshop, line: &str, stderr: Stdio) -> Child {
    let mut command = command(&workshop.words(line));
    command.stdout(Stdio::null()).stderr(stderr).spawn().expect("the binary starts")
}

#[test]
fn what_takes_long_says_how_long_to_a_terminal_alone() {
    let workshop = workshop();
    let [counted, uncounted] = if thorough() { [LONG.len(), UNCOUNTED.len()] } else { [2, 1] };
    for line in LONG.into_iter().take(counted).chain(UNCOUNTED.into_iter().take(uncounted)) {
        let size = Winsize { ws_row: 24, ws_col: 100, ws_xpixel: 0, ws_ypixel: 0 };
        let terminal = openpty(&size, None).unwrap();
        // The first to start has had at least as much time at every moment.
        let mut piped = start(&workshop, line, Stdio::piped());
        let watched = start(&workshop, line, terminal.slave.into());
        let pipe = piped.stderr.take().unwrap();
        let pieces = heard(File::from(terminal.master));
        let (mut text, begun) = (String::new(), Instant::now());
        let found = loop {
            let piece = pieces.recv_timeout(WATCHDOG.saturating_sub(begun.elapsed()));
            text += &String::from_utf8_lossy(&piece.unwrap_or_else(|_| panic!("{line} shows only {text:?}")));
            let at_work = text.contains("running for ") && text.contains("s, Ctrl-C stops");
            if let Some(found) = progress_counts(&text) {
                break found;
            } else if at_work && UNCOUNTED.contains(&line) {
                break (0, 2);
            }
        };
        let worked = processor_time(watched.id());
        assert!(found.0 < found.1 && found.1 > 1, "{line}: {found:?}");
        assert_eq!(interrupted(watched), Some(130), "{line}");
        // Waits until the other has done the work after which this one wrote.
        let is_as_far = || has_ended(piped.id()) || processor_time(piped.id()) >= worked;
        wait_for(&format!("as much work of {line} in a pipe"), is_as_far);
        assert!([Some(0), Some(130)].contains(&interrupted(piped)), "{line}");
        let mut text = String::new();
        { pipe }.read_to_string(&mut text).unwrap();
        assert!(
            !text.contains(" done, ")
                && !text.contains("at work")
                && !text.contains("Ctrl-C")
                && !text.contains('\r'),
            "{line}: {text}"
        );
    }
}

#[test]
fn what_a_line_of_progress_tells() {
    assert_eq!(progress_counts("\r####------ 12 of 345 done, 6s left, Ctrl-C stops"), Some((12, 345)));
    for text in [
        "",
        "12 of 345 done",
        "12 of 345 done,  left, Ctrl-C stops",
        "12 of 345 done, 0s left, Ctrl-C stops",
        "of done, 6s left, Ctrl-C stops",
    ] {
        assert_eq!(progress_counts(text), None, "{text}");
    }
}
