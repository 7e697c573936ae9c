//! Points of the tool at which an identified machine was not measured, and the uncertainty there.

use abbe::Manipulator;
use abbe_spec::{Diagnostics, Spec};
use serde::Serialize;

use crate::calibration::{CalibrationErrors, PredictedErrors, Prediction, is_measured, tool_in_last_frame};
use crate::number::{digits, length};
use crate::{Notes, mistake};

/// Largest number of configurations at which the uncertainty is evaluated.
const SAMPLES: usize = 500;

/// Points of a tool other than those at which the errors of a spec were fitted. Standard deviations
/// are √trace of the covariance of a point, root mean square over configurations and points, in the
/// length unit.
#[derive(Clone, Debug, Serialize)]
pub struct OtherTool {
    /// Points of this tool in the last frame, in the length unit.
    pub points: Vec<[f64; 3]>,
    /// Points in the last frame at which the errors were fitted, in the length unit: nominal, and
    /// as they were found.
    pub fitted_points: Vec<[f64; 3]>,
    /// Standard deviation by the noise of the fitted measurements alone.
    pub by_noise: f64,
    /// Standard deviation with the errors that these measurements could not determine.
    pub standard_deviation: f64,
    /// Standard deviation that remains if the place of the tool on the last frame is measured,
    /// apart from the noise of that measurement.
    pub with_measured_place: f64,
    /// Warning in a sentence, for texts and pages.
    #[serde(skip)]
    pub sentence: String,
}

/// Warns if the points, in the frame of the tool, were not measured when the errors of a spec were
/// fitted. Returns `None` if they were. `what` names the configurations, in the plural: `rows`.
pub fn warn_of_other_tool<'r>(
    spec: &Spec,
    manipulator: &dyn Manipulator,
    points: &[[f64; 3]],
    what: &str,
    configurations: &mut dyn ExactSizeIterator<Item = (&'r [f64], &'r [f64])>,
    notes: &mut dyn Notes,
) -> Result<Option<OtherTool>, Diagnostics> {
    if spec.undetermined.of.is_empty() {
        return Ok(None);
    }
    let tool = tool_in_last_frame(manipulator).map_err(|error| mistake::whole(&spec.file, &error))?;
    let other = points.iter().filter(|point| !is_measured(spec, manipulator, &[tool.apply(**point)]));
    let other: Vec<[f64; 3]> = other.copied().collect();
    let step = configurations.len().div_ceil(SAMPLES).max(1);
    let configurations: Vec<(&[f64], &[f64])> = configurations.step_by(step).collect();
    let rms = |is_measured: bool, square: fn(&[PredictedErrors]) -> f64| {
        let errors = CalibrationErrors::new(spec, is_measured);
        let (mut sum, mut count) = (0.0, 0);
        for point in &other {
            let prediction = Prediction::new(spec, manipulator, &errors, *point)?;
            let predicted = configurations.iter();
            let predicted = predicted.filter_map(|(q, u)| prediction.errors_at(q.to_vec(), u.to_vec()).ok());
            let predicted: Vec<PredictedErrors> = predicted.collect();
            sum += square(&predicted);
            count += predicted.len();
        }
        (count > 0).then(|| (sum / count as f64).sqrt())
    };
    let all = (rms(true, squares), rms(false, squares), rms(false, squares_beside_place));
    let (Some(by_noise), Some(standard_deviation), Some(with_measured_place)) = all else { return Ok(None) };
    let points = other.iter().map(|point| tool.apply(*point)).collect();
    let mut found = OtherTool {
        points,
        fitted_points: spec.undetermined.points.clone(),
        by_noise,
        standard_deviation,
        with_measured_place,
        sentence: String::new(),
    };
    let warning = found.warning(spec, what);
    notes.warn(&warning);
    found.sentence = format!("{warning}.");
    Ok(Some(found))
}

impl OtherTool {
    fn warning(&self, spec: &Spec, what: &str) -> String {
        let frame = spec.frames.get(spec.tool_frame).map_or("", |frame| &frame.name);
        let place = |points: &[[f64; 3]]| match points {
            [[x, y, z], rest @ ..] => {
                let [x, y, z] = [x, y, z].map(|v| digits(*v, 6));
                let more = if rest.is_empty() { "" } else { " and others" };
                format!("({x}, {y}, {z}) {}{more}", spec.length.symbol())
            }
            [] => "no point".to_owned(),
        };
        let [noise, all, beside] = [self.by_noise, self.standard_deviation, self.with_measured_place]
            .map(|v| length(v, spec.length));
        let fitted = &self.fitted_points[..self.fitted_points.len().min(1)];
        format!(
            "the tool of these {what} has its point at {} of {frame}, and the errors of this spec were \
             fitted with a target at {}. Errors that this target could not show give the point a \
             standard deviation of {all}, not the {noise} that follow from the noise of the fit; {beside} \
             remain if the place of the tool on {frame} is measured. To determine these errors, \
             identify with this tool as well",
            place(&self.points),
            place(fitted),
        )
    }
}

/// Returns `Σ |M l|²` over configurations and parts.
fn squares(predicted: &[PredictedErrors]) -> f64 {
    let displacements = predicted.iter().flat_map(|errors| &errors.displacements);
    displacements.flatten().map(|v| v * v).sum()
}

/// Returns the same without the mean of each part in the axes of the tool: a displacement of the
/// tool on the last frame has the same effect.
fn squares_beside_place(predicted: &[PredictedErrors]) -> f64 {
    let parts = predicted.first().map_or(0, |errors| errors.displacements.len());
    let beside = |part: usize| {
        let in_tool = predicted.iter().map(|errors| {
            let [x, y, z, _] = errors.pose.0;
            [x, y, z].map(|axis| (0..3).map(|i| axis[i] * errors.displacements[part][i]).sum::<f64>())
        });
        let count = predicted.len() as f64;
        let sums = in_tool.fold([[0.0; 2]; 3], |sums, v| {
            std::array::from_fn(|i| [sums[i][0] + v[i], sums[i][1] + v[i] * v[i]])
        });
        sums.map(|[sum, squares]| (squares - sum * sum / count).max(0.0)).iter().sum::<f64>()
    };
    (0..parts).map(beside).sum()
}
