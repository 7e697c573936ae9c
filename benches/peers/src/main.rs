//! Benchmark of `J_e` by abbe and its peers: generated, checked, and measured in one process.
//!
//! Run it by `benches/peers/run`. README.md explains the tables.

mod answers;
mod batch;
mod measure;
mod ours;
mod peers;
mod pinocchio;
mod ratios;
mod report;
mod row;
mod span;

use abbe::lanes::Batches;
use abbe_interpreter::Interpreter;
use abbe_spec::Spec;

use crate::answers::{Angles, Answers};
use crate::report::Report;
use crate::row::{Row, Side};

/// Generated modules of the benchmark's own specs.
mod bench {
    abbe::include_manipulators!();
}

fn main() {
    let Some((rounds, angles)) = arguments() else {
        eprintln!("usage: run [--limits] [ROUNDS]");
        std::process::exit(2);
    };
    let mut report = Report::new(rounds, angles);
    let mut compare = |name: &str, spec: &str, robot: &'static dyn Batches, mut rows: Vec<Row>| {
        let answers = Answers::new(robot, angles);
        for block in [batch::FEW, batch::MANY] {
            rows.extend(batch::rows("abbe", Side::Ours, robot, block, &answers.inputs));
        }
        let interpreted = interpreter(name, spec);
        rows.extend(batch::rows("interpreter", Side::Interpreter, interpreted, batch::MANY, &answers.inputs));
        rows.extend(peers::ours(name));
        rows.extend(pinocchio::rows(robot));
        rows.extend(peers::rows(name));
        let deviations = rows.iter_mut().map(|row| answers.deviation(row)).collect();
        let times = measure::interleaved(&mut rows, &answers.inputs, rounds);
        report.add(name, spec, &answers, &rows, times, deviations);
    };
    compare(
        "puma560",
        shipped("puma560"),
        &abbe_manipulators::puma560::Puma560,
        ours::rows!(abbe_manipulators::puma560),
    );
    compare(
        "puma560_flange",
        include_str!("../specs/puma560_flange.toml"),
        &bench::puma560_flange::Puma560Flange,
        ours::rows!(crate::bench::puma560_flange),
    );
    compare(
        "ppprrr",
        include_str!("../specs/ppprrr.toml"),
        &bench::ppprrr::Ppprrr,
        ours::rows!(crate::bench::ppprrr),
    );
    compare("iiwa", shipped("iiwa"), &abbe_manipulators::iiwa::Iiwa, ours::rows!(abbe_manipulators::iiwa));
    print!("{report}");
    if report.wrong() {
        std::process::exit(1);
    }
}

/// Returns an interpreter of a spec with static lifetime.
fn interpreter(name: &str, spec: &str) -> &'static dyn Batches {
    let spec = Box::leak(Box::new(Spec::parse(name, spec).expect("it was compiled")));
    Box::leak(Box::new(Interpreter::new(spec.clone())))
}

fn arguments() -> Option<(usize, Angles)> {
    let (mut rounds, mut angles) = (400, Angles::Quarter);
    for argument in std::env::args().skip(1) {
        match argument.as_str() {
            "--limits" => angles = Angles::Limits,
            number => rounds = number.parse().ok().filter(|rounds| *rounds > 0)?,
        }
    }
    Some((rounds, angles))
}

fn shipped(name: &str) -> &'static str {
    abbe_manipulators::SHIPPED.iter().find(|shipped| shipped.name == name).expect("a shipped robot").spec
}
