//! Warns of errors that are too large for a machine, before the fit.

use abbe::identify::{Failure, Loss, Options, fit};

use super::interpretation_check::{ROWS, subsample};
use super::setup::Setup;
use crate::data::{Data, Map};
use crate::{Notes, number};

/// Residual, as a share of the arm length, above which errors are too large for a machine.
const LARGE: f64 = 1e-2;

/// Returns a warning if a root mean square error is too large for a machine. `fitted` is the error
/// with base and tool fitted, if that fit succeeded.
pub(crate) fn too_large(rms: f64, fitted: Option<f64>, setup: &Setup) -> Option<String> {
    let large = LARGE * setup.arm;
    if rms <= large {
        return None;
    }
    let length = |value| number::length(value, setup.description.length);
    let share = number::percent(rms, setup.arm);
    let statement = format!("implausible errors of {} (root mean square), {share} of the arm:", length(rms));
    Some(match fitted {
        Some(left) if left <= large => format!(
            "{statement} {} remain with base and tool fitted. Check the placement of the \
             instrument (`base = \"unknown\"` in the map fits it) and of the target.",
            length(left)
        ),
        _ => format!(
            "{statement} no placement of base and tool and no other interpretation (units, signs, \
             column order) fits. Check that these are measurements of this machine; `abbe doctor` \
             tries more conventions."
        ),
    })
}

/// Warns if errors are too large for a machine even with base and tool fitted.
///
/// The median of the residuals of a robust fit decides, so that gross errors in less than half of
/// the rows do not matter. Call it after [`Setup::come_near`].
pub(crate) fn check_plausibility(
    setup: &Setup,
    map: &Map,
    data: &Data,
    notes: &mut dyn Notes,
) -> Result<(), Failure> {
    let rows = subsample(&data.observations, ROWS);
    if setup.delivered.figures(&rows, &[])?.rms <= LARGE * setup.arm {
        return Ok(());
    }
    let model = setup.real.with(setup.base_and_tool());
    let options = Options { loss: Loss::Tukey, expected: model.expected(&[])?, ..Options::default() };
    // The fixtures of instruments have no initial position.
    let placed = map.instruments().is_none();
    let rms = match fit(&model, &rows, &options) {
        Ok(found) => {
            let mut left = model.all_distances(&rows, &found.x)?.into_values();
            left.sort_by(f64::total_cmp);
            if left.get(left.len() / 2).is_none_or(|median| *median <= LARGE * setup.arm) {
                return Ok(());
            }
            if placed { None } else { Some(model.figures(&rows, &found.x)?.rms) }
        }
        Err(Failure::NotConverged { .. }) if placed => None,
        // The fit of all errors reports the failure.
        Err(_) => return Ok(()),
    };
    let rms = rms.map_or_else(|| Ok(setup.delivered.figures(&data.observations, &[])?.rms), Ok)?;
    if let Some(statement) = too_large(rms, None, setup) {
        notes.warn(&statement);
    }
    Ok(())
}
