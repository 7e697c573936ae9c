//! The ledger: the sources in rows, their sums in the last ones.

use abbe::analysis::{Extreme, Figures, Measurand, SourceErrors};

use super::report::Report;
use super::unit;
use crate::listing::Listing;
use crate::number::{self, fixed, percent, unbroken};

/// One row: a source, or a sum over the sources. Norms of the position error, in the length unit.
pub struct Entry<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Of a source: its class, and its rank by the largest error, 1 for the largest.
    pub source: Option<(&'static str, usize)>,
    /// The largest, and where.
    pub largest: Extreme,
    /// The root mean square over the configurations; the worst case has none.
    pub rms: Option<f64>,
}

/// The sources, the largest first.
pub(super) fn sources(report: &Report) -> Vec<Entry<'_>> {
    let entry = |(alone, rank): (&SourceErrors, usize)| Entry {
        name: &report.source(alone.source).name,
        source: Some((number::class(alone.class).0, rank)),
        largest: Extreme { value: alone.plain_max.norm, configuration: alone.worst },
        rms: Some(alone.rms),
    };
    let mut entries = report.budget.sources.iter().zip(report.budget.ranks()).map(entry).collect::<Vec<_>>();
    entries.sort_by_key(|entry| entry.source.map(|(_, rank)| rank));
    entries
}

/// What they are together.
pub(super) fn sums(report: &Report) -> [Entry<'static>; 4] {
    let combined = &report.budget.combined;
    let [repeatable, random, both] = combined.rms.map(Some);
    [
        ("repeatable, with signs", combined.repeatable_radius, repeatable),
        ("random, root sum of squares", combined.random_radius, random),
        ("all together", combined.radius, both),
        ("worst case, all norms added", combined.worst_case_radius, None),
    ]
    .map(|(name, largest, rms)| Entry { name, source: None, largest, rms })
}

/// The ledger as a table.
pub fn ledger(report: &Report) -> Listing {
    let tolerance = report.study.tolerance;
    let mut header = vec!["source", "max", "RMS", "rank", "worst at (the rest as at home)"];
    if tolerance.is_some() {
        header.insert(3, "of tolerance");
    }
    let mut rows = Vec::new();
    for Entry { name, source, largest, rms } in sources(report).into_iter().chain(sums(report)) {
        let at = report
            .configuration(largest.configuration)
            .filter(|_| largest.value > 0.0)
            .map(|worst| unbroken(&report.label(worst)));
        let show = |value| fixed(value, report.decimals());
        let mut cells = vec![
            name.to_owned(),
            show(largest.value),
            rms.map(show).unwrap_or_default(),
            source.map(|(_, rank)| rank.to_string()).unwrap_or_default(),
            at.unwrap_or_default(),
        ];
        if let Some(tolerance) = tolerance {
            cells.insert(3, percent(largest.value, tolerance));
        }
        rows.push(cells);
    }
    let numbers = 1..header.len() - 1;
    Listing { header, rows, numbers }
}

/// The ledger of the orientation in mrad: rows 4–6 and their norm. None if nothing turns the tool.
pub fn turns(report: &Report) -> Option<Listing> {
    let (errors, combined, _) = report.budget.errors(Measurand::Orientation);
    if combined.worst_case_radius.value == 0.0 {
        return None;
    }
    let ranks = report.budget.ranks_for(Measurand::Orientation);
    let mut order = ranks.into_iter().zip(errors).collect::<Vec<_>>();
    order.sort_by_key(|(rank, _)| *rank);
    let show = |value| unit::fixed(report, Measurand::Orientation, value);
    let [first, second, third] = unit::rows(report, Measurand::Orientation);
    let mut header = vec!["source", first, second, third, "norm", "RMS", "worst at (the rest as at home)"];
    let tolerance = report.study.orientation_tolerance;
    if tolerance.is_some() {
        header.insert(5, "of tolerance");
    }
    let row = |name: &str, rows: [Option<f64>; 3], norm: Extreme, rms: Option<f64>| {
        // What is the same everywhere is worst nowhere.
        let varies = norm.value > rms.unwrap_or_default() * (1.0 + 1e-9);
        let at = report.configuration(norm.configuration).filter(|_| varies);
        let mut cells = vec![name.to_owned()];
        cells.extend(rows.map(|row| row.map(show).unwrap_or_default()));
        cells.extend([show(norm.value), rms.map(show).unwrap_or_default()]);
        cells.push(at.map(|worst| unbroken(&report.label(worst))).unwrap_or_default());
        if let Some(tolerance) = tolerance {
            cells.insert(5, percent(norm.value, tolerance));
        }
        cells
    };
    let alone = order.into_iter().map(|(_, alone)| {
        let Figures { x, y, z, norm } = alone.plain_max;
        let norm = Extreme { value: norm, configuration: alone.worst };
        row(&report.source(alone.source).name, [x, y, z].map(Some), norm, Some(alone.rms))
    });
    let [repeatable, random, both] = combined.rms.map(Some);
    let together = [
        row("repeatable, with signs", combined.repeatable.map(Some), combined.repeatable_radius, repeatable),
        row("random, root sum of squares", combined.random.map(Some), combined.random_radius, random),
        row("all together", [None; 3], combined.radius, both),
    ];
    let rows = alone.chain(together).collect();
    let numbers = 1..header.len() - 1;
    Some(Listing { header, rows, numbers })
}

/// What a tolerance of the study allows each source, and what is gained by making it smaller.
pub fn allowed(report: &Report, measurand: Measurand) -> Option<Listing> {
    let admissible = report.admissible(measurand)?;
    let (_, _, gains) = report.budget.errors(measurand);
    let (factor, _) = unit::of(report, measurand);
    let times = |scale: Option<f64>| {
        scale.map_or("any".to_owned(), |scale| format!("× {}", number::digits(scale, 3)))
    };
    let row = |source: usize| {
        vec![
            report.source(source).name.clone(),
            times(admissible.alone[source]),
            times(admissible.equal[source]),
            fixed(factor * gains[source], report.decimals_of(measurand) + 1),
        ]
    };
    let rows = report.budget.tighten_first_for(measurand).into_iter().map(row).collect();
    Some(Listing {
        header: vec!["source", "alone at most", "equal shares", "gain per percent"],
        rows,
        numbers: 1..4,
    })
}
