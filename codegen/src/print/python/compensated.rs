//! Corrected commands on NumPy arrays of configurations, by the fixed number of steps of
//! `abbe::compensator`.

use abbe_core::function::{COMPENSATED, CONVERGED};
use abbe_spec::Spec;

use super::functions::face;
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered};
use crate::print::layout::Writer;
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    if spec.variables.is_empty() {
        return;
    }
    face(writer, &routines.description, &COMPENSATED, Some(["converged", CONVERGED]), None);
    writer.blank();
    writer.blank();
    writer.paragraphs(&numbered(TEXT, spec, &Tolerances::DOUBLE, number));
}

const TEXT: &str = r#"
def _deviation(ideal, real):
    """Return the deviation of the real from the ideal pose: position in F_0, and the rotation vector of R_real R_ideal^T."""
    a, b = (pose.reshape(pose.shape[:-1] + (4, 3)) for pose in (ideal, real))
    turn = sum(b[..., k, :, None] * a[..., k, None, :] for k in range(3))
    v = np.stack([turn[..., i, j] - turn[..., j, i] for i, j in ((2, 1), (0, 2), (1, 0))], axis=-1)
    twice_sine = np.sqrt(np.sum(v * v, axis=-1))
    angle = np.arctan2(twice_sine, turn[..., 0, 0] + turn[..., 1, 1] + turn[..., 2, 2] - 1.0)
    scale = np.where(twice_sine < LEAST_SINE, 0.5, angle / np.maximum(twice_sine, LEAST_SINE))
    return np.concatenate([b[..., 3, :] - a[..., 3, :], v * scale[..., None]], axis=-1)


def _weighed(rows):
    """Weight the rows in metres and rad: 1 rad counts as 1 mm, so that the position has priority."""
    return rows * np.repeat([METRE, LEVER], 3)


def _solve(m, b):
    """Solve (M + lambda) x = b by Cholesky factorization, for positive semidefinite M."""
    lower, x = np.zeros(m.shape), np.zeros(b.shape)
    for i in range(b.shape[-1]):
        for j in range(i + 1):
            rest = m[..., i, j] - np.sum(lower[..., i, :j] * lower[..., j, :j], axis=-1)
            is_pivot = i == j
            lower[..., i, j] = np.sqrt(np.maximum(rest, 0.0) + DAMPING) if is_pivot else rest / lower[..., j, j]
        x[..., i] = (b[..., i] - np.sum(lower[..., i, :i] * x[..., :i], axis=-1)) / lower[..., i, i]
    for i in reversed(range(b.shape[-1])):
        known = np.sum(lower[..., i + 1 :, i] * x[..., i + 1 :], axis=-1)
        x[..., i] = (x[..., i] - known) / lower[..., i, i]
    return x


def _shortest(columns, b):
    """Return the shortest step, (J^T J + lambda)^-1 J^T b; for more than six joints J^T (J J^T + lambda)^-1 b."""
    if columns.shape[-2] <= 6:
        m = np.sum(columns[..., :, None, :] * columns[..., None, :, :], axis=-1)
        return _solve(m, np.sum(columns * b[..., None, :], axis=-1))
    m = np.sum(columns[..., :, None] * columns[..., None, :], axis=-3)
    return np.sum(columns * _solve(m, b)[..., None, :], axis=-1)


def _depart(start, q, twists, after, units, limits):
    """Return start + step, with variables that exceed a limit held at it, the one with the largest excess first."""
    columns = _weighed(twists.reshape(twists.shape[:-1] + (COUNT, 6)) * units[:, None])
    wanted = -_weighed(after) + np.sum(columns * ((q - start) / units)[..., None], axis=-2)
    for _ in range(COUNT + 1):
        step = _shortest(columns, wanted)
        # Skip variables that are held or do not move the tool.
        moves = np.any(columns != 0.0, axis=-1)
        q = np.where(moves, start + step * units, q)
        clamped = np.clip(q, *limits)
        beyond = np.where(moves, np.abs(q - clamped) / units, 0.0)
        held = (np.arange(COUNT) == np.argmax(beyond, axis=-1)[..., None]) & (beyond > 0.0)
        if not np.any(held):
            break
        q = np.where(held, clamped, q)
        shift = np.where(held, (start - q) / units, 0.0)
        wanted = wanted + np.sum(columns * shift[..., None], axis=-2)
        columns = np.where(held[..., None], 0.0, columns)
    return np.clip(q, *limits)


def _compensated(batch, q, s, u):
    units = np.array([UNIT_LIST])
    limits = np.array([variable["limits"] for variable in description["variables"]]).T
    start = np.broadcast_to(q, batch + (COUNT,))
    target = _pose(batch, q, s)
    real, columns = _compensator_step(batch, q, s, u)
    before = _deviation(target, real)
    inside = np.all((start >= limits[0]) & (start <= limits[1]), axis=-1)
    least = np.where(inside, np.sum(_weighed(before) ** 2, axis=-1), np.inf)
    corrected, after = start, before
    at, now = start, before
    for _ in range(ITERATIONS):
        before_step = at
        at = _depart(start, at, columns, now, units, limits)
        moved = np.max(np.abs(at - before_step) / units, axis=-1)
        real, columns = _compensator_step(batch, at, s, u)
        now = _deviation(target, real)
        cost = np.sum(_weighed(now) ** 2, axis=-1)
        better = cost < least
        least = np.where(better, cost, least)
        corrected = np.where(better[..., None], at, corrected)
        after = np.where(better[..., None], now, after)
    return corrected, before, after, moved <= REST
"#;
