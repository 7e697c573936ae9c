//! Figures of a measurement: error cloud and histograms, as in Figures 13 and 14 of the paper.

use abbe::analysis::sampling::range_of;
use abbe_metrology::measure::Report;
use abbe_spec::Spec;

use super::cloud::views;
use super::histogram::{COLOURS, FigureRange, NamedValues, panel};
use super::residuals::{self, ErrorNames, Residual};
use super::{norm, step};
use crate::scene::{Axis, Colour, Mark, Scene, with_margin};

/// Maximum number of points.
const MOST: usize = 5000;
/// Title of the paper with Figures 13 and 14, for specs that cite it.
const PAPER: &str = "High Performance Medical Robot Requirements and Accuracy Analysis";

/// Builds the figures of a measurement, of points or of instrument readings.
pub(crate) fn scenes(report: &Report, spec: &Spec) -> Vec<Scene> {
    if !report.instruments.is_empty() {
        return readings(report);
    }
    let to_mm = 1e3 * spec.length.in_metres();
    let in_mm = |error: [f64; 3]| error.map(|entry| entry * to_mm);
    let errors = report
        .row_errors
        .iter()
        .map(|row| in_mm([row.error[0], row.error[1], row.error[2]]))
        .collect::<Vec<_>>();
    // Only the machine of the paper is compared with its figures.
    let cited = |scene: Scene, figure: u32| match spec.reference.contains(PAPER) {
        true => Scene { reference: format!("cf. Figure {figure} of the paper"), ..scene },
        false => scene,
    };
    let mut scenes = vec![
        cited(cloud(&errors), 13),
        cited(histograms("Accuracy", &errors).captioned("ΔX of all rows."), 14),
    ];
    let about = report.about_barycentres.iter().map(|error| in_mm(*error)).collect::<Vec<_>>();
    if !about.is_empty() {
        let caption = "Deviations from the barycentre of the visits of each configuration.";
        scenes.push(cited(histograms("Repeatability", &about).captioned(caption), 14));
    }
    let residuals = report.row_errors.iter().map(|row| Residual {
        q: &row.observation.q,
        point: row.point,
        before: None,
        after: [row.error[0], row.error[1], row.error[2]],
    });
    let names = ErrorNames { before: "", after: "ΔX" };
    scenes.extend(residuals::scenes(&residuals.collect::<Vec<_>>(), &names, spec));
    scenes
}

/// Shows three views of the error cloud, without outliers.
fn cloud(errors: &[[f64; 3]]) -> Scene {
    let reach = FigureRange::new(errors.iter().map(|error| norm(*error)).collect());
    let shown = errors.iter().filter(|error| reach.contains(norm(**error))).step_by(step(errors.len(), MOST));
    let shown = shown.collect::<Vec<_>>();
    let axes = [0, 1, 2].map(|axis| {
        let range = with_margin(range_of(shown.iter().map(|error| error[axis])), 0.05);
        Axis::linear(["x error", "y error", "z error"][axis], "mm", range)
    });
    let radius = if shown.len() < 300 { 2.2 } else { 1.6 };
    let panels = views(&axes, |[across, up]| {
        let dots = shown.iter().map(|error| [error[across], error[up]]).collect();
        vec![Mark::points(Colour::BAR, radius, dots).faded(0.7)]
    });
    let caption = match reach.beyond {
        0 => "Each dot is ΔX of one row.".to_owned(),
        1 => "Each dot is ΔX of one row; 1 is outside the figure.".to_owned(),
        beyond => format!("Each dot is ΔX of one row; {beyond} are outside the figure."),
    };
    Scene::new("Accuracy: errors in space", 3, panels).captioned(caption)
}

fn histograms(what: &str, errors: &[[f64; 3]]) -> Scene {
    let along = |axis: usize| errors.iter().map(|error| error[axis]).collect::<Vec<_>>();
    let norms = errors.iter().map(|error| norm(*error)).collect();
    let all = [along(0), along(1), along(2), norms].into_iter().zip(COLOURS);
    let names = ["x error", "y error", "z error", "norm of the error"];
    let panels =
        all.zip(names).map(|((values, colour), name)| panel(name, "mm", &[NamedValues::new(values, colour)]));
    Scene::new(format!("{what}: distribution of errors"), 2, panels.collect())
}

/// Shows one histogram of residuals per observable.
fn readings(report: &Report) -> Vec<Scene> {
    let of = |(i, name): (usize, &String)| {
        let left: Vec<f64> = report.row_readings.iter().filter_map(|row| row.left[i]).collect();
        let is_its = |instrument: &str| {
            *name == instrument || name.strip_prefix(instrument).is_some_and(|rest| rest.starts_with('_'))
        };
        let instrument = report.instruments.iter().find(|one| is_its(&one.name));
        let unit = instrument.map_or("", |one| &one.unit);
        let panel = panel(name, unit, &[NamedValues::new(left.clone(), Colour::INK)]);
        let scene = Scene::new(format!("{name}: distribution of residuals"), 1, vec![panel]);
        let caption = "Reading minus prediction with the repeatable sources of the spec.";
        (!left.is_empty()).then(|| scene.captioned(caption))
    };
    report.numbers.iter().enumerate().filter_map(of).collect()
}
