//! The report, as tables in Markdown.

use std::fmt;
use std::time::Instant;

use abbe::Function;
use abbe_codegen::chain::Model;
use abbe_codegen::print;
use abbe_codegen::program::straight_line;
use abbe_spec::Spec;

use crate::answers::{Angles, Answers, COUNT};
use crate::measure::Times;
use crate::peers;
use crate::ratios;
use crate::row::{Kind, Row, Side};

/// Largest deviation by rounding. Larger ones are wrong results.
const ROUNDING: f64 = 1e-13;

/// Largest error of central differences of step 1e-4.
const DIFFERENCES: f64 = 5e-8;

/// Results of all measurements.
pub struct Report {
    rounds: usize,
    angles: Angles,
    generated: Vec<serde_json::Value>,
    times: Vec<String>,
    ratios: Vec<String>,
    operations: Vec<String>,
    differences: f64,
    wrong: bool,
}

impl Report {
    pub fn new(rounds: usize, angles: Angles) -> Self {
        let (times, ratios, operations) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            rounds,
            angles,
            generated: peers::generated(),
            times,
            ratios,
            operations,
            differences: 0.0,
            wrong: false,
        }
    }

    /// Returns whether a result was wrong.
    pub fn wrong(&self) -> bool {
        self.wrong
    }

    /// Adds the results of one robot.
    pub fn add(
        &mut self,
        robot: &str,
        spec: &str,
        answers: &Answers,
        rows: &[Row],
        times: Vec<Times>,
        deviations: Vec<f64>,
    ) {
        self.ratios.extend(ratios::lines(robot, rows, &times));
        let measured: Vec<(&Row, Times, f64)> =
            rows.iter().zip(times).zip(deviations).map(|((row, times), off)| (row, times, off)).collect();
        let best = Kind::ALL.map(|kind| {
            let peers = measured.iter().filter(|(row, ..)| row.kind == kind && row.side.is_peer());
            peers.map(|(_, times, _)| times.median).fold(f64::INFINITY, f64::min)
        });
        let mut names: Vec<&str> = Vec::new();
        for row in rows {
            if !names.contains(&row.name.as_str()) {
                names.push(&row.name);
            }
        }
        for name in names {
            let own: Vec<_> = measured.iter().filter(|(row, ..)| row.name == name).collect();
            let cells = Kind::ALL.map(|kind| match own.iter().find(|(row, ..)| row.kind == kind) {
                None => String::new(),
                Some((row, times, _)) => {
                    let ratio = match row.side {
                        Side::Ours | Side::OurC => {
                            format!(" **{:.2} ×**", best[kind as usize] / times.median)
                        }
                        _ => String::new(),
                    };
                    format!("{:.1} ({:.1}){ratio}", times.median, times.minimum)
                }
            });
            let off = own.iter().map(|(.., off)| *off).fold(0.0, f64::max);
            self.wrong |= off > ROUNDING;
            self.times.push(format!("| {robot} | {name} | {} | {off:.1e} |", cells.join(" | ")));
        }
        self.differences = self.differences.max(answers.differences);
        self.wrong |= answers.differences > DIFFERENCES;
        self.operations.push(ours(robot, spec));
        self.operations.extend(self.generated.iter().filter(|row| row["robot"] == robot).map(|row| {
            let count = |kind: &str| format!("{} / {}", row[kind]["mul"], row[kind]["add"]);
            let library = format!("{} {}", row["library"], row["version"]).replace('"', "");
            let milliseconds = 1e3 * row["dense"]["seconds"].as_f64().unwrap_or(f64::NAN);
            let counts = Kind::ALL.map(|kind| count(kind.name())).join(" | ");
            format!("| {robot} | {library} | {counts} | {milliseconds:.1} |")
        }));
    }
}

/// Returns our operation counts, and the time from the text of the spec to that of the whole
/// module.
fn ours(robot: &str, spec: &str) -> String {
    let mut seconds: Vec<f64> = (0..21)
        .map(|_| {
            let start = Instant::now();
            let spec = Spec::parse(robot, spec).expect("it was compiled");
            std::hint::black_box(print::rust(&spec));
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    let spec = Spec::parse(robot, spec).expect("it was compiled");
    let model = Model::new(&spec);
    let counts = Kind::ALL.map(|kind| {
        let count = match kind {
            Kind::Dense => Function::ErrorJacobian,
            Kind::Distinct => Function::ErrorJacobianDistinct,
            Kind::Displacement => Function::Displacement,
            Kind::Covariance => Function::Covariance,
        };
        let count = straight_line(count, &model).operations();
        format!("{} / {}", count.mul, count.add)
    });
    let milliseconds = 1e3 * seconds[seconds.len() / 2];
    format!("| {robot} | abbe, the whole module | {} | {milliseconds:.1} |", counts.join(" | "))
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (rustc, flags, gcc) = (env!("PEERS_RUSTC"), env!("PEERS_FLAGS"), env!("PEERS_GCC"));
        writeln!(f, "{}; {rustc}, {flags}; {gcc}.\n", processor())?;
        let angles = match self.angles {
            Angles::Quarter => "±90°",
            Angles::Limits => "the limits",
        };
        let rounds = self.rounds;
        writeln!(
            f,
            "ns per configuration, median (minimum) of {rounds} rounds over {COUNT} configurations, angles within {angles};"
        )?;
        writeln!(
            f,
            "× is how much faster than the best peer; the deviation is the largest from the loop over"
        )?;
        writeln!(
            f,
            "frames, which is {:.0e} from central differences of the exact chain.\n",
            self.differences
        )?;
        let titles = Kind::ALL.map(Kind::title).join(" | ");
        writeln!(f, "| robot | | {titles} | deviation |\n|---|---|---|---|---|---|---|")?;
        self.times.iter().try_for_each(|row| writeln!(f, "{row}"))?;
        writeln!(f, "\nRatios of medians: above 1 is in our favour, but for the interpreter.\n")?;
        writeln!(f, "{}", ratios::head())?;
        self.ratios.iter().try_for_each(|row| writeln!(f, "{row}"))?;
        writeln!(f, "\nMultiplications / additions, and ms from the robot to the code of J_e dense.\n")?;
        writeln!(f, "| robot | | {titles} | ms |\n|---|---|---|---|---|---|---|")?;
        self.operations.iter().try_for_each(|row| writeln!(f, "{row}"))?;
        writeln!(
            f,
            "\nBytes of code and constants of J_e dense, with all that it calls but the system's functions.\n"
        )?;
        writeln!(f, "| robot | | `-O3` | `-Os` |\n|---|---|---|---|")?;
        for size in peers::sizes() {
            let [robot, library] = ["robot", "library"].map(|key| size[key].as_str().unwrap_or_default());
            writeln!(f, "| {robot} | {} | {} | {} |", peers::shown(library), size["fast"], size["small"])?;
        }
        if self.wrong {
            writeln!(f, "\nA deviation is too large: there is a wrong answer, and the comparison is void.")?;
        }
        Ok(())
    }
}

/// Returns the name of the processor, if the system reports it.
fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = info.lines().find(|line| line.starts_with(name))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    };
    let wide = field("flags").is_some_and(|flags| flags.split(' ').any(|flag| flag == "avx512f"));
    let name = field("model name").unwrap_or_else(|| std::env::consts::ARCH.to_owned());
    format!("{name}{}", if wide { " with AVX-512" } else { "" })
}
