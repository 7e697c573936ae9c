//! Commands killed while they write: every file is either old or new, none is lost, and the same
//! command can run again without `--force`. Only after `kill -9` may a set of files be partly old
//! and partly new, and may temporary files remain.
//!
//! Kills are placed by events, not by time: after a part of the processor time, or while temporary
//! files are there. `ABBE_KILLS=1000` sets the number of kills.

#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use abbe_tests::processes::{has_ended, processor_time, wait_for, watch_for};
use abbe_tests::thorough;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::running::command;
use crate::workshop::{Workshop, contents};

/// Default number of kills, and that of a thorough run.
const KILLS: [usize; 2] = [18, 54];

/// Commands in two forms whose output differs; `{}` is `d` or `t`, `[]` is 1 or 2.
const COMMANDS: [&str; 9] = [
    "generate {}.spec.toml --out arm.rs",
    "simulate s.toml --map m.toml --samples 5000 --seed [] --out data.csv",
    "plan s.toml --map m.toml --optimal 20 --candidates [][] --out plan.csv",
    "compensate s.toml {}.csv --map m.toml --out commands.csv --report commands.html",
    "monitor s.toml {}.csv {}.csv --map m.toml --report watched.html",
    "identify s.toml {}.csv --map m.toml --out found.toml --report found.html",
    "measure s.toml {}.csv --map m.toml --out measured",
    "analyze s.toml --monte-carlo 100 --seed [] --out analyzed",
    "analyze {}.spec.toml --out again",
];

fn words(workshop: &Workshop, line: &str, form: usize) -> Vec<String> {
    let line = line.replace("{}", ["d", "t"][form]).replace("[]", ["3", "4"][form]);
    line.split_whitespace()
        .map(|word| {
            let path = word.contains('.') || ["measured", "analyzed", "again"].contains(&word);
            if path { workshop.path(word) } else { word.to_owned() }
        })
        .collect()
}

fn start(words: &[String]) -> Command {
    let mut command = command(words);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Event at which a command is killed.
#[derive(Clone, Copy, Debug)]
enum Moment {
    /// Processor time in hundredths of a second.
    Worked(u64),
    /// First temporary file, and a number of looks at the folder after it.
    Writing(usize),
}

/// Workshop, the output files of both forms of a command, and its processor time in hundredths of a
/// second.
struct Victim {
    workshop: Workshop,
    line: &'static str,
    forms: [BTreeMap<PathBuf, Vec<u8>>; 2],
    time: u64,
}

impl Victim {
    fn new(line: &'static str) -> Self {
        let workshop = Workshop::new();
        let spec = fs::read_to_string(workshop.at("s.toml")).unwrap();
        fs::write(workshop.at("d.spec.toml"), &spec).unwrap();
        fs::write(workshop.at("t.spec.toml"), spec.replace("450 mm", "460 mm")).unwrap();
        let mut time = 0;
        let forms = [1, 0].map(|form| {
            let mut child = start(&words(&workshop, line, form)).spawn().unwrap();
            wait_for(&format!("the end of {line}"), || has_ended(child.id()));
            time = processor_time(child.id()).unwrap();
            let status = child.wait().unwrap();
            assert!(status.code().is_some_and(|code| code <= 1), "{line}: {status}");
            contents(workshop.0.path())
        });
        let [second, first] = forms;
        assert!(first != second && first.keys().eq(second.keys()), "{line}");
        Self { workshop, line, forms: [first, second], time }
    }

    /// Returns the temporary files present, which `docs/output.md` allows to delete.
    fn temporary(&self) -> Vec<PathBuf> {
        contents(self.workshop.0.path()).into_keys().filter(|path| is_temporary(path)).collect()
    }

    /// Waits until a process comes to a moment, or to its end.
    fn wait(&self, process: u32, moment: Moment) {
        let mut looks = 0;
        let mut has_come = || match moment {
            Moment::Worked(time) => processor_time(process) >= Some(time),
            Moment::Writing(more) => {
                looks += usize::from(has_temporary(self.workshop.0.path()) || looks > 0);
                looks > more
            }
        };
        watch_for(&format!("{moment:?} of {}", self.line), || has_ended(process) || has_come());
    }

    /// Returns the form that wrote the differing files; none if they are from both.
    fn form(&self) -> Option<usize> {
        let now = contents(self.workshop.0.path());
        for (path, before) in &self.forms[0] {
            let content = now.get(path).unwrap_or_else(|| panic!("{} is lost", path.display()));
            let whole = content == before || *content == self.forms[1][path];
            assert!(whole, "half a file: {}", path.display());
        }
        assert!(now.keys().all(|path| is_temporary(path) || self.forms[0].contains_key(path)));
        (0..2).find(|form| self.forms[*form].iter().all(|(path, content)| now[path] == *content))
    }
}

/// Returns whether there is a temporary file in a folder or a folder in it. Either may vanish.
fn has_temporary(folder: &Path) -> bool {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.into_iter().any(|entry| {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        is_temporary(&entry.path()) || is_folder && has_temporary(&entry.path())
    })
}

fn is_temporary(path: &Path) -> bool {
    let name = path.file_name().unwrap().to_string_lossy();
    name.starts_with(".abbe-") && name.ends_with(".tmp")
}

#[test]
fn whoever_is_killed_leaves_whole_files_and_can_be_run_again() {
    let asked = std::env::var("ABBE_KILLS").ok().map(|kills| kills.parse::<usize>().unwrap());
    let mut random = Xoshiro256PlusPlus::seed_from_u64(9);
    let victims = COMMANDS.map(Victim::new);
    // SIGHUP is ignored under `nohup`.
    let ignored = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = ignored.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    let signals: Vec<Signal> = [Signal::SIGKILL, Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP]
        .into_iter()
        .filter(|signal| *signal != Signal::SIGHUP || ignored & (1 << (*signal as i32 - 1)) == 0)
        .collect();
    let (mut kills, mut killed, mut mixed, mut left) = (0, 0, 0, 0);
    let count = asked.unwrap_or(KILLS[usize::from(thorough())]);
    // Goes on as long as every command ends before its signal.
    for i in 0..100 * count {
        if i >= count && killed > 0 {
            break;
        }
        kills += 1;
        if i % 100 == 99 {
            println!("{kills} kills, {killed} before the end, {left} left something, {mixed} sets in halves");
        }
        let victim = &victims[i % victims.len()];
        let signal = signals[random.random_range(0..signals.len())];
        let (name, number) = (signal.as_str(), signal as i32);
        let before = victim.form();
        let next = before.map_or(0, |form| 1 - form);
        let mut child = start(&words(&victim.workshop, victim.line, next)).spawn().unwrap();
        // Most kills hit the end of the run, where files are written.
        let moment = if random.random_bool(0.7) {
            Moment::Writing(random.random_range(0..40))
        } else {
            Moment::Worked(random.random_range(0..=victim.time))
        };
        victim.wait(child.id(), moment);
        kill(Pid::from_raw(child.id().try_into().unwrap()), signal).unwrap();
        let status = child.wait().unwrap();
        let ended = match number {
            9 => status.signal() == Some(9),
            // A signal before the handler is installed ends the process directly.
            n => status.code() == Some(128 + n) || status.signal() == Some(n),
        };
        let finished = status.code().is_some_and(|code| code <= 1);
        assert!(ended || finished, "{}: {name}: {status}", victim.line);
        killed += usize::from(ended);
        let after = victim.form();
        if after.is_none() {
            // Only SIGKILL, which cannot be caught, may leave a set partly written.
            assert!(ended && number == 9, "{}: {name}: a set in halves", victim.line);
            mixed += 1;
        }
        let found = victim.temporary();
        assert!(found.is_empty() || number == 9, "{}: {name}: {status} leaves {found:?}", victim.line);
        left += usize::from(!found.is_empty());
        // The killed command runs again without --force, whatever it left, and leaves nothing more.
        if !found.is_empty() || after.is_none() || random.random_bool(0.2) {
            let again = start(&words(&victim.workshop, victim.line, next)).status().unwrap();
            assert!(again.code().is_some_and(|code| code <= 1), "{}: {again}", victim.line);
            assert_eq!(victim.form(), Some(next));
            assert_eq!(victim.temporary(), found);
        }
        found.iter().for_each(|path| fs::remove_file(path).unwrap());
    }
    println!("{kills} kills, {killed} before the end, {left} left something, {mixed} sets in halves");
    assert!(killed > 0);
}
