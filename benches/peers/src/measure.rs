//! Many short rounds over all rows, so that disturbances of the machine affect all alike.

use std::hint::black_box;
use std::time::Instant;

use crate::answers::COUNT;
use crate::row::{Inputs, Output, Row};

/// Times in ns per configuration.
#[derive(Clone, Copy)]
pub struct Times {
    pub median: f64,
    pub minimum: f64,
}

/// Measures all rows in turn, `rounds` times. Each round begins with the next row.
pub fn interleaved(rows: &mut [Row], inputs: &Inputs, rounds: usize) -> Vec<Times> {
    let mut output = Output::new();
    let mut nanoseconds = vec![Vec::with_capacity(rounds); rows.len()];
    for round in 0..rounds {
        for place in 0..rows.len() {
            let row = (round + place) % rows.len();
            // Warm up code and branch prediction before the clock starts.
            rows[row].run.run(inputs, 0..COUNT / 4, &mut output);
            let start = Instant::now();
            rows[row].run.run(black_box(inputs), 0..COUNT, black_box(&mut output));
            nanoseconds[row].push(start.elapsed().as_nanos() as f64 / COUNT as f64);
        }
    }
    nanoseconds
        .into_iter()
        .map(|mut all| {
            all.sort_by(f64::total_cmp);
            Times { median: all[rounds / 2], minimum: all[0] }
        })
        .collect()
}
