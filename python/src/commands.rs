//! Inverse kinematics, and commands that compensate the errors of the machine.

use abbe::analysis::{InverseKinematics, Target, inverse};
use abbe::{Pose, identify::Failure};
use abbe_metrology::compensate;
use abbe_study::calibration::{CalibrationErrors, Prediction};
use abbe_study::mistake;
use numpy::PyUntypedArrayMethods;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use rayon::prelude::*;

use crate::arrays::{empty, numbers, output_array, tuple};
use crate::job::{length, run};
use crate::{Machine, guarded};

/// Returns the solutions of each target; of several, none where there are none, with a warning.
fn solved<E: std::fmt::Display + Send>(
    py: Python<'_>,
    lead: &[usize],
    targets: &[Target],
    solve: impl Fn(&Target) -> std::result::Result<Vec<Vec<f64>>, E> + Sync,
) -> PyResult<Vec<Vec<Vec<f64>>>> {
    if let ([], [target]) = (lead, targets) {
        let found = guarded(|| Ok(py.detach(|| solve(target).map_err(|reason| reason.to_string()))))?;
        return found.map(|found| vec![found]).map_err(PyValueError::new_err);
    }
    let work = |notes: &mut dyn abbe_study::Notes| {
        let found: Vec<_> = targets.par_iter().map(|target| solve(target).unwrap_or_default()).collect();
        let none = found.iter().filter(|rows| rows.is_empty()).count();
        if none > 0 {
            notes.warn(&format!("{none} of {} targets are not reached: their rows are NaN", found.len()));
        }
        Ok(found)
    };
    run(py, None, None, work).map(|(found, _)| found)
}

/// Returns the leading dimensions and the targets that an array describes: poses or tool points.
fn targets_of(target: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<Target>)> {
    let checked = target.py().import("abbe._arrays")?.call_method1("targets", (target,))?;
    let array = numbers(&checked, "target", None)?;
    let values = array.as_slice()?;
    Ok(match array.shape() {
        [lead @ .., 4, 4] => {
            (lead.to_vec(), values.chunks_exact(16).map(|one| Target::Pose(pose(one))).collect())
        }
        shape => (
            shape[..shape.len() - 1].to_vec(),
            values.chunks_exact(3).map(|one| Target::Point([one[0], one[1], one[2]])).collect(),
        ),
    })
}

impl Machine {
    /// Returns the joints at which a search begins: `q0`, or home.
    fn start(&self, py: Python<'_>, q0: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<f64>> {
        let Some(q0) = q0 else { return Ok(self.home()) };
        let array = numbers(q0, "q0", Some(self.variable_names.bind(py)))?;
        if array.shape() != [self.home().len()] {
            return Err(PyValueError::new_err(format!("`q0` has shape {}", tuple(array.shape()))));
        }
        Ok(array.as_slice()?.to_vec())
    }
}

#[pymethods]
impl Machine {
    /// (…, nq): joints, within their limits, at which the ideal tool reaches `target` in F_0.
    ///
    /// `target`: poses (…, 4, 4) or tool points (…, 3), in the length unit. `q0`: start of each
    /// search, home by default. Of one target, raises ValueError, with the reason, if no solution
    /// is found; of several, its row is NaN, and a warning has their number.
    ///
    /// >>> import abbe
    /// >>> ur5 = abbe.load("ur5")
    /// >>> q = ur5.inverse(ur5.pose([0.1, -1, 1, 0.2, 0.3, 0]), ur5.home)
    /// >>> bool(abs(ur5.pose(q) - ur5.pose([0.1, -1, 1, 0.2, 0.3, 0])).max() < 1e-6)
    /// True
    #[pyo3(signature = (target, q0=None))]
    fn inverse<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let ((lead, targets), start) = (targets_of(target)?, self.start(py, q0)?);
        let all: Vec<usize> = (0..start.len()).collect();
        let find = |target: &Target| inverse(&self.interpreter, &self.parameters, &start, &all, target);
        let found = solved(py, &lead, &targets, |target| find(target).map(|q| vec![q]))?;
        let nan = || vec![f64::NAN; start.len()];
        let rows: Vec<f64> =
            found.into_iter().flat_map(|rows| rows.into_iter().next().unwrap_or_else(nan)).collect();
        filled(py, &[&lead[..], &[start.len()]].concat(), &rows)
    }

    /// (…, m, nq): all joints, within their limits, at which the ideal tool has the pose `target`
    /// in F_0, those nearest to `q0` first; of several targets, rows beyond the solutions of one
    /// are NaN.
    ///
    /// `target`, `q0`: as for `inverse`, but of poses. Revolute joints have the full turn
    /// nearest to `q0`, and joints that are free to move there stay as in `q0`. Arms with a
    /// spherical wrist, of whose other axes two neighbours intersect or are parallel, arms with
    /// three parallel axes, gantries with three revolute joints, and platforms on legs are solved
    /// in closed form; of others, solutions may be missing. Without any, as `inverse`.
    ///
    /// >>> import abbe
    /// >>> ur5 = abbe.load("ur5")
    /// >>> ur5.inverses(ur5.pose([0.1, -1, 1, 0.2, 0.3, 0])).shape
    /// (8, 6)
    #[pyo3(signature = (target, q0=None))]
    fn inverses<'py>(
        &self,
        py: Python<'py>,
        target: &Bound<'py, PyAny>,
        q0: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let ((lead, targets), start) = (targets_of(target)?, self.start(py, q0)?);
        let refused = |reason: &dyn ToString| PyValueError::new_err(reason.to_string());
        if targets.iter().any(|target| matches!(target, Target::Point(_))) {
            return Err(refused(&"`target` has tool points: give poses (…, 4, 4)"));
        }
        let kinematics = InverseKinematics::new(&self.interpreter, &self.parameters);
        let kinematics = kinematics.map_err(|reason| refused(&reason))?;
        let found = solved(py, &lead, &targets, |target| match target {
            Target::Pose(pose) => kinematics.solve(&start, pose),
            _ => Ok(Vec::new()),
        })?;
        let (most, nq) = (found.iter().map(Vec::len).max().unwrap_or(0), start.len());
        let row = |rows: Vec<Vec<f64>>| {
            let mut row = rows.concat();
            row.resize(most * nq, f64::NAN);
            row
        };
        let rows: Vec<f64> = found.into_iter().flat_map(row).collect();
        filled(py, &[&lead[..], &[most, nq]].concat(), &rows)
    }

    /// (…, 3, 3): covariance of the tool point in F_0 of an identified machine: by the covariance
    /// of what was identified, and by the random sources of the spec. Squares of the length unit.
    ///
    /// `inputs`: as for `generalized_errors`. A machine whose spec has no covariance raises
    /// ValueError.
    ///
    /// >>> import abbe
    /// >>> ur5 = abbe.load("ur5")
    /// >>> found = ur5.identify(ur5.simulate("ur5", samples=60, seed=1).table("rows"), "ur5").load()
    /// >>> found.tool_covariance([found.home, found.home]).shape
    /// (2, 3, 3)
    #[pyo3(signature = (q, **inputs))]
    fn tool_covariance<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let spec = &self.machine.spec;
        let description = abbe::Manipulator::description(&self.interpreter);
        let joints = self.given_joints(q)?;
        let inputs = self.given_inputs(q, inputs, &joints.lead)?;
        let lead = joints.lead.clone();
        let (joints, inputs) = (joints.argument()?, inputs.argument()?);
        let errors = CalibrationErrors::new(spec);
        let prediction = Prediction::new(spec, &self.interpreter, &errors, [0.0; 3]);
        let prediction = prediction.ok_or_else(|| {
            PyValueError::new_err("the spec of this machine has no [covariance]: `identify` writes it")
        })?;
        let mut rows = Vec::new();
        for i in 0..lead.iter().product() {
            py.check_signals()?;
            let (q, u) = (joints.at(i, description.variables.len()), inputs.at(i, description.inputs.len()));
            let covariance = prediction.covariance(q.to_vec(), u.to_vec()).map_err(|failure| {
                let reason = match failure {
                    Failure::Observation { error, .. } => error.to_string(),
                    failure => failure.to_string(),
                };
                PyValueError::new_err(format!("configuration {i}: {reason}"))
            })?;
            rows.extend(covariance.into_iter().flatten());
        }
        filled(py, &[&lead[..], &[3, 3]].concat(), &rows)
    }

    /// Computes joint commands at which the real tool has the ideal pose of `q`. Returns Commands.
    ///
    /// `tolerance`: largest error allowed to remain at the tool point, in the length unit or as
    /// text with a unit; 1 rad counts as 1 m; "0.001mm" by default. `weight`: length that weighs as
    /// much as 1 rad where both cannot be reached; without it the position has priority. `inputs`:
    /// as for `generalized_errors`. `progress(done, total)` is called at intervals. Commands beyond
    /// the joint limits raise ValueError.
    #[pyo3(signature = (q, *, tolerance=None, weight=None, progress=None, **inputs))]
    fn compensate<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        tolerance: Option<&Bound<'py, PyAny>>,
        weight: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        inputs: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let description = abbe::Manipulator::description(&self.interpreter);
        let usual = PyString::new(py, compensate::options::TOLERANCE).into_any();
        let tolerance = length("tolerance", tolerance.unwrap_or(&usual), &self.machine.spec)?;
        let weight = weight.map(|weight| length("weight", weight, &self.machine.spec)).transpose()?;
        let given = self.given_joints(q)?;
        let inputs = self.given_inputs(q, inputs, &given.lead)?;
        let (lead, nq) = (given.lead.clone(), description.variables.len());
        let (given, inputs) = (given.argument()?, inputs.argument()?);
        let (q, nu) = (given.values, description.inputs.len());
        let count: usize = lead.iter().product();
        let work = |notes: &mut dyn abbe_study::Notes| {
            let commands = compensate::CommandCorrector::new(&self.interpreter, tolerance, weight)?;
            let mut found = Vec::new();
            for i in 0..count {
                notes.progress(i, count);
                notes.go_on()?;
                let u = if inputs.each { &inputs.values[nu * i..][..nu] } else { inputs.values };
                found.push(commands.correct(&q[nq * i..][..nq], u).map_err(|reason| {
                    let at = if lead.is_empty() { String::new() } else { format!("configuration {i}: ") };
                    let help =
                        "leave this configuration out, or look at what the spec's expressions are there";
                    mistake::with_help(&self.machine.origin, at + &reason, help)
                })?);
            }
            Ok(found)
        };
        let (found, _) = run(py, None, progress, work)?;
        let corrected: Vec<f64> = found.iter().flat_map(|command| command.q.clone()).collect();
        let left: Vec<f64> = found.iter().flat_map(|command| command.remaining).collect();
        let reasons: Vec<Option<String>> = found.into_iter().map(|command| command.reason).collect();
        let reason = match &reasons[..] {
            [reason] if lead.is_empty() => reason.into_pyobject(py)?.into_any().unbind(),
            reasons => reasons.into_pyobject(py)?.into_any().unbind(),
        };
        let q = filled(py, &[&lead[..], &[nq]].concat(), &corrected)?;
        let left = filled(py, &[&lead[..], &[6]].concat(), &left)?;
        py.import("abbe._fields")?.getattr("Commands")?.call1((q, left, reason))
    }
}

/// Converts a homogeneous matrix, row by row.
fn pose(values: &[f64]) -> Pose {
    Pose(std::array::from_fn(|j| std::array::from_fn(|i| values[4 * i + j])))
}

fn filled<'py>(py: Python<'py>, shape: &[usize], values: &[f64]) -> PyResult<Bound<'py, PyAny>> {
    let array = empty(py, shape)?;
    output_array(&array, shape)?.as_slice_mut()?.copy_from_slice(values);
    Ok(array)
}
