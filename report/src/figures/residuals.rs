//! Figures of residuals of measured points: vectors in space, over rows, over each joint, and
//! histograms.

use abbe::analysis::sampling::range_of;
use abbe_spec::Spec;
use abbe_study::{number::short, study_file::Over};

use super::histogram::{COLOURS, FigureRange, NamedValues, panel};
use super::{Quantity, norm, step, thinned};
use crate::scene::{Axis, Colour, Mark, Panel, Scene, View, with_margin};

/// Maximum number of vectors, of dots over rows, and of dots over a joint.
const VECTORS: usize = 400;
const DOTS: usize = 3000;
const DOTS_OVER_JOINT: usize = 1200;
/// Height of a panel with dots, in pixels.
const HEIGHT: f64 = 180.0;
/// Colours of errors before and after.
const BEFORE: Colour = Colour::GREY;
const AFTER: Colour = Colour::BAR;

/// Measured point with its error before and after, in the length unit of the spec.
pub(crate) struct Residual<'r> {
    pub(crate) q: &'r [f64],
    pub(crate) point: [f64; 3],
    pub(crate) before: Option<[f64; 3]>,
    pub(crate) after: [f64; 3],
}

/// Names of both errors; `before` is empty if there is only one.
pub(crate) struct ErrorNames {
    pub(crate) before: &'static str,
    pub(crate) after: &'static str,
}

/// Residuals to show in mm.
struct Residuals<'r> {
    residuals: &'r [Residual<'r>],
    names: &'r ErrorNames,
    spec: &'r Spec,
    to_mm: f64,
}

/// Builds all figures of a list of points.
pub(crate) fn scenes(residuals: &[Residual], names: &ErrorNames, spec: &Spec) -> Vec<Scene> {
    let errors = Residuals { residuals, names, spec, to_mm: 1e3 * spec.length.in_metres() };
    let mut scenes = vec![errors.vectors(), errors.over_rows()];
    scenes.extend(errors.over_joints());
    if !names.before.is_empty() {
        scenes.push(errors.histograms());
    }
    scenes
}

impl Residuals<'_> {
    /// Shows magnified errors as lines from the tool points.
    fn vectors(&self) -> Scene {
        let every = step(self.residuals.len(), VECTORS);
        let shown: Vec<&Residual> = self.residuals.iter().step_by(every).collect();
        let axes = [0, 1, 2].map(|axis| range_of(shown.iter().map(|residual| residual.point[axis])));
        let diagonal = norm(axes.map(|[least, most]| (most - least).max(0.0)));
        // The 95 % quantile of the lengths becomes a tenth of the diagonal.
        let scale = |error: &dyn Fn(&Residual) -> [f64; 3]| {
            let mut sizes: Vec<f64> = shown.iter().map(|residual| norm(error(residual))).collect();
            sizes.sort_by(f64::total_cmp);
            let long = sizes.get(sizes.len().saturating_sub(1) * 19 / 20).copied().unwrap_or_default();
            if long > 0.0 && diagonal > 0.0 { round_down(0.1 * diagonal / long) } else { 1.0 }
        };
        let ErrorNames { before, after } = self.names;
        let own = scale(&|residual| residual.after);
        let title = |name: &str, scale: f64| format!("{name}, × {}", short(scale));
        let (mut panels, mut last_scale) = (Vec::new(), None);
        if shown.iter().any(|residual| residual.before.is_some()) {
            let same = scale(&|residual| residual.before.unwrap_or(residual.after));
            let first = self.arrows(&shown, |residual| residual.before, same, BEFORE);
            panels.push(first.titled(title(before, same)));
            let second = self.arrows(&shown, |residual| Some(residual.after), same, AFTER);
            panels.push(second.titled(title(after, same)));
            last_scale = Some(same);
        }
        // Where one scale fits both errors, a second panel would repeat the one before.
        if last_scale != Some(own) {
            let last = self.arrows(&shown, |residual| Some(residual.after), own, AFTER);
            panels.push(last.titled(title(after, own)));
        }
        let caption = format!(
            "Dots are tool points; lines are the errors, enlarged by the factor above.{}",
            thinned(self.residuals.len(), every)
        );
        Scene::new("Residuals in space", panels.len(), panels).captioned(caption)
    }

    fn arrows(
        &self,
        shown: &[&Residual],
        error: impl Fn(&Residual) -> Option<[f64; 3]>,
        scale: f64,
        colour: Colour,
    ) -> Panel {
        let from = |residual: &&Residual| residual.point;
        let drawn = shown.iter().filter_map(|residual| {
            let error = error(residual)?;
            Some(vec![from(residual), std::array::from_fn(|i| residual.point[i] + scale * error[i])])
        });
        let lines = drawn.collect::<Vec<Vec<[f64; 3]>>>();
        let unit = self.spec.length.symbol();
        let spans =
            [0, 1, 2].map(|axis| with_margin(range_of(lines.iter().flatten().map(|end| end[axis])), 0.03));
        let longest = spans.iter().map(|[least, most]| most - least).fold(0.0, f64::max);
        let axes = ["x", "y", "z"].map(|name| Axis::linear(name, unit, [0.0; 2]));
        let mut spans = spans.into_iter();
        let axes = axes.map(|axis| {
            let [least, most] = spans.next().unwrap_or_default();
            let room = ((0.3 * longest - (most - least)) / 2.0).max(0.0);
            Axis { range: [least - room, most + room], ..axis }
        });
        let marks = vec![
            Mark::lines(colour, 1.1, lines),
            Mark::points(Colour::INK, 1.0, shown.iter().map(from).collect()),
        ];
        let height = if self.names.before.is_empty() { 500.0 } else { 270.0 };
        Panel::new(height, View::Space { axes, up: 2, equal: true, marks })
    }

    fn over_rows(&self) -> Scene {
        let every = step(self.residuals.len(), DOTS);
        let numbered = self.residuals.iter().enumerate().map(|(i, residual)| (i as f64 + 1.0, residual));
        let shown = numbered.step_by(every).collect::<Vec<_>>();
        let x = Axis::linear("point, in the order of the rows", "", [0.0, self.residuals.len() as f64 + 1.0]);
        let caption = thinned(self.residuals.len(), every);
        Scene::new("By row", 1, vec![self.dots(&shown, x)]).captioned(caption.trim())
    }

    /// Shows errors over each joint; none if no joint moves.
    fn over_joints(&self) -> Option<Scene> {
        let every = step(self.residuals.len(), DOTS_OVER_JOINT);
        let panel = |joint: usize| {
            let quantity = Quantity::over(Over::Variable(joint), self.spec);
            let at = |residual: &Residual| quantity.show(residual.q[joint]);
            let range = range_of(self.residuals.iter().map(at));
            let shown = self.residuals.iter().step_by(every).map(|residual| (at(residual), residual));
            let moves = range[1] - range[0] > 1e-9;
            moves.then(|| self.dots(&shown.collect::<Vec<_>>(), quantity.axis(with_margin(range, 0.03))))
        };
        let panels = (0..self.spec.variables.len()).filter_map(panel).collect::<Vec<_>>();
        let few = thinned(self.residuals.len(), every);
        let still = if panels.len() < self.spec.variables.len() {
            "Joints that do not move are omitted."
        } else {
            ""
        };
        let caption = format!("{still}{few}");
        (!panels.is_empty()).then(|| Scene::new("By joint", 3, panels).captioned(caption.trim()))
    }

    /// Shows norms as dots: before in grey, after in blue on top.
    fn dots(&self, shown: &[(f64, &Residual)], x: Axis) -> Panel {
        let norms = |error: fn(&Residual) -> Option<[f64; 3]>| {
            let norm = |(x, residual): &(f64, &Residual)| Some([*x, norm(error(residual)?) * self.to_mm]);
            shown.iter().filter_map(norm).collect::<Vec<_>>()
        };
        let lists = [
            (norms(|residual| residual.before), BEFORE, 0.45, self.names.before),
            (norms(|residual| Some(residual.after)), AFTER, 0.9, self.names.after),
        ];
        let all =
            self.residuals.iter().flat_map(|residual| residual.before.into_iter().chain([residual.after]));
        let reach = FigureRange::new(all.map(|error| norm(error) * self.to_mm).collect());
        let top = if reach.ends[1] > 0.0 { 1.05 * reach.ends[1] } else { 1.0 };
        let radius = match shown.len() {
            0..300 => 2.4,
            300..1500 => 1.9,
            _ => 1.5,
        };
        let lists = lists.into_iter().filter(|(places, ..)| !places.is_empty());
        let marks = lists.map(|(mut places, colour, opacity, name)| {
            places.retain(|[_, error]| *error <= top);
            Mark::points(colour, radius, places).faded(opacity).named(name)
        });
        Panel::plane(HEIGHT, x, Axis::linear(reach.title("error"), "mm", [0.0, top]), marks.collect())
    }

    fn histograms(&self) -> Scene {
        let ErrorNames { before, after } = self.names;
        let along = |axis: usize| {
            let values = self.residuals.iter().map(|residual| residual.after[axis] * self.to_mm);
            let name = ["x error", "y error", "z error"][axis];
            panel(name, "mm", &[NamedValues::new(values.collect(), COLOURS[axis])])
        };
        let norms = self.residuals.iter().map(|residual| norm(residual.after) * self.to_mm).collect();
        let first = self.residuals.iter().filter_map(|residual| Some(norm(residual.before?) * self.to_mm));
        let lists = [
            NamedValues { values: first.collect(), colour: BEFORE, name: before },
            NamedValues { values: norms, colour: AFTER, name: after },
        ];
        let lists = lists.into_iter().filter(|list| !list.values.is_empty()).collect::<Vec<_>>();
        let panels = [along(0), along(1), along(2), panel("norm of the error", "mm", &lists)];
        Scene::new("Distribution of errors", 2, panels.to_vec()).captioned(format!("x, y and z: {after}."))
    }
}

/// Rounds down to 1, 2 or 5 times a power of ten.
fn round_down(value: f64) -> f64 {
    let power = 10f64.powf(value.log10().floor());
    let factor = [5.0, 2.0, 1.0].into_iter().find(|factor| factor * power <= value * (1.0 + 1e-9));
    factor.unwrap_or(1.0) * power
}
