//! Errors that are too large for a machine: a warning before anything is fitted to them.

use abbe::identify::{Failure, Loss, Options, fit};

use super::misread::{ROWS, some};
use super::setup::Setup;
use crate::data::{Data, Map};
use crate::{Notes, number};

/// The share of the arm beyond which errors are too large for a machine.
const LARGE: f64 = 1e-2;

/// Returns a warning if the root mean square of errors is too large for a machine; `fitted` is that with base and tool fitted, if they
/// could be.
pub(crate) fn too_large(rms: f64, fitted: Option<f64>, setup: &Setup) -> Option<String> {
    let large = LARGE * setup.arm;
    if rms <= large {
        return None;
    }
    let length = |value| number::length(value, setup.description.length);
    let share = number::percent(rms, setup.arm);
    let said = format!("these errors are {} (root mean square), {share} of the arm:", length(rms));
    Some(match fitted {
        Some(left) if left <= large => format!(
            "{said} with base and tool fitted {} are left. Where does the instrument stand (`base = \"unknown\"` in the map finds \
             it), and where does the target sit?",
            length(left)
        ),
        _ => format!(
            "{said} neither another place of base and tool nor another reading (units, signs, orders of columns) that was tried brings \
             the machine near them. Are they measurements of this machine?"
        ),
    })
}

/// Warns of data to which errors are to be fitted if base and tool alone, which are fitted as well, leave errors that are too
/// large for a machine: in half of the rows and more, so that gross errors are none. After [`Setup::come_near`].
pub(crate) fn check_plausibility(
    setup: &Setup,
    map: &Map,
    data: &Data,
    notes: &mut dyn Notes,
) -> Result<(), Failure> {
    let rows = some(&data.observations, ROWS);
    if setup.delivered.figures(&rows, &[])?.rms <= LARGE * setup.arm {
        return Ok(());
    }
    let model = setup.real.with(setup.base_and_tool());
    let options = Options { loss: Loss::Tukey, expected: model.expected(&[])?, ..Options::default() };
    // Where fixtures stand that readings are of is not known before.
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
        // The fit of all errors will say it.
        Err(_) => return Ok(()),
    };
    let rms = rms.map_or_else(|| Ok(setup.delivered.figures(&data.observations, &[])?.rms), Ok)?;
    if let Some(said) = too_large(rms, None, setup) {
        notes.warn(&said);
    }
    Ok(())
}
