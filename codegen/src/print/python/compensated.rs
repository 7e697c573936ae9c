//! Corrected commands on NumPy arrays of configurations, by the fixed number of steps of
//! `abbe::compensator`.

use abbe_core::function::COMPENSATED;
use abbe_spec::Spec;

use super::functions::face;
use super::operators::number;
use crate::print::compensated::{Tolerances, numbered, statuses};
use crate::print::layout::Writer;
use crate::program::Routines;

pub(super) fn compensated(writer: &mut Writer, spec: &Spec, routines: &Routines) {
    if !routines.has_compensated() {
        return;
    }
    let statuses = statuses(&Tolerances::DOUBLE);
    face(writer, &routines.description, &COMPENSATED, Some(["status", &statuses]), Some(WITHOUT_LAST));
    writer.blank();
    writer.blank();
    writer.paragraphs(&numbered(TEXT, spec, &Tolerances::DOUBLE, number));
}

/// Arguments that may be left out.
const WITHOUT_LAST: &str = "Without `last`, no cycle precedes: corrections have any size. With it, `change` and `largest` are \
     those of the variables in `description` if they are left out, and `rotations` is the whole pose. Raises ValueError if \
     a number is not finite or an input is outside its range";

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


def _weighed(axes, rows):
    """Weight the position in metres, and the rotations about the weighted axes of the tool in rad.

    1 rad counts as 1 mm, so that the position has priority.
    """
    turns = np.sum(axes * rows[..., None, 3:], axis=-1)
    return np.concatenate([rows[..., :3] * METRE, turns * LEVER], axis=-1)


def _clamped(value, lower, upper):
    """Return the nearest value of an interval, and its lower end for NaN."""
    return np.fmin(np.fmax(value, lower), upper)


def _solve(m, b):
    """Iterated Tikhonov regularization by Cholesky factorization of M + lambda, for positive semidefinite M.

    The first pass solves (M + lambda) x = b, each other one adds lambda (M + lambda)^-1 of the one before.
    """
    lower, x, b = np.zeros(m.shape), np.zeros(b.shape), b.copy()
    for i in range(b.shape[-1]):
        for j in range(i + 1):
            rest = m[..., i, j] - np.sum(lower[..., i, :j] * lower[..., j, :j], axis=-1)
            is_pivot = i == j
            lower[..., i, j] = np.sqrt(np.maximum(rest, 0.0) + DAMPING) if is_pivot else rest / lower[..., j, j]
    for _ in range(PASSES):
        for i in range(b.shape[-1]):
            b[..., i] = (b[..., i] - np.sum(lower[..., i, :i] * b[..., :i], axis=-1)) / lower[..., i, i]
        for i in reversed(range(b.shape[-1])):
            known = np.sum(lower[..., i + 1 :, i] * b[..., i + 1 :], axis=-1)
            b[..., i] = (b[..., i] - known) / lower[..., i, i]
        x, b = x + b, b * DAMPING
    return x


def _shortest(columns, b):
    """Return the shortest step: x of (J^T J) x = J^T b, and for six joints or more J^T x of (J J^T) x = b."""
    if columns.shape[-2] < 6:
        m = np.sum(columns[..., :, None, :] * columns[..., None, :, :], axis=-1)
        return _solve(m, np.sum(columns * b[..., None, :], axis=-1))
    m = np.sum(columns[..., :, None] * columns[..., None, :], axis=-3)
    return np.sum(columns * _solve(m, b)[..., None, :], axis=-1)


def _depart(axes, start, bounds, q, twists, after, units):
    """Return start + step, with variables that exceed a bound held at it, the one with the largest excess first."""
    columns = _weighed(axes[..., None, :, :], twists.reshape(twists.shape[:-1] + (COUNT, 6)) * units[:, None])
    wanted = -_weighed(axes, after) + np.sum(columns * ((q - start) / units)[..., None], axis=-2)
    for _ in range(COUNT + 1):
        step = _shortest(columns, wanted)
        # Skip variables that are held or do not move the tool.
        moves = np.any(columns != 0.0, axis=-1)
        q = np.where(moves, start + step * units, q)
        clamped = _clamped(q, *bounds)
        beyond = np.where(moves, np.abs(q - clamped) / units, 0.0)
        held = (np.arange(COUNT) == np.argmax(beyond, axis=-1)[..., None]) & (beyond > 0.0)
        if not np.any(held):
            break
        q = np.where(held, clamped, q)
        shift = np.where(held, (start - q) / units, 0.0)
        wanted = wanted + np.sum(columns * shift[..., None], axis=-2)
        columns = np.where(held[..., None], 0.0, columns)
    return _clamped(q, *bounds)


def _compensated(batch, *given):
    q, s, u, last, change, largest, rotations = map(_numbers_last, given)
    arguments = {"q": q, "s": s, "u": u, "last": last, "rotations": rotations}
    for name, array in arguments.items():
        if not np.all(np.isfinite(array)):
            raise ValueError(f"{name}: a number is not finite")
    units = np.array([UNIT_LIST])
    limits = np.array([variable["limits"] for variable in description["variables"]]).T
    start, last, rotations = (
        np.broadcast_to(array, batch + array.shape[-1:]) for array in (_clamped(q, *limits), last, rotations)
    )
    far, size = (np.where(bound > 0.0, bound, 0.0) for bound in (change, largest))
    bounds = [_clamped(start + _clamped(end, last - far, last + far), *limits) for end in (-size, size)]
    target = _numbers_last(_pose(batch, *given[:2]))
    axes = target[..., :9].reshape(batch + (3, 3)) * rotations[..., None]

    def error(q):
        real, columns = map(_numbers_last, _compensator_step(batch, _numbers_first(q), *given[1:3]))
        rows = _deviation(target, real)
        if not np.all(np.isfinite(rows)):
            raise ValueError("a result is not finite")
        return rows, columns, np.sum(_weighed(axes, rows) ** 2, axis=-1)

    before, _, cost = error(q)
    at = _clamped(start + last, *bounds)
    now, columns, least = error(at)
    inside = np.all((q >= bounds[0]) & (q <= bounds[1]), axis=-1)
    better = inside & (cost < least)
    least = np.where(better, cost, least)
    corrected, after = (np.where(better[..., None], *pair) for pair in ((q, at), (before, now)))
    for _ in range(ITERATIONS):
        before_step = at
        at = _depart(axes, start, bounds, at, columns, now, units)
        moved = np.max(np.abs(at - before_step) / units, axis=-1)
        now, columns, cost = error(at)
        better = cost < least
        least = np.where(better, cost, least)
        corrected = np.where(better[..., None], at, corrected)
        after = np.where(better[..., None], now, after)
    outside = np.any(start != q, axis=-1)
    position, turn = (np.sqrt(np.sum(rows**2, axis=-1)) for rows in np.split(_weighed(axes, after), 2, axis=-1))
    held = np.any((corrected <= bounds[0]) | (corrected >= bounds[1]), axis=-1)
    cases = {
        "OUTSIDE_LIMITS": outside,
        "OK": (position <= REACHED_POSITION) & (turn <= REACHED_ROTATION),
        "HELD": held,
        "NOT_CONVERGED": moved > REST,
    }
    statuses = description["statuses"]
    status = np.select(list(cases.values()), [statuses[name] for name in cases], statuses["NOT_REACHED"])
    results = (corrected, corrected - start, before, after)
    return *map(_numbers_first, results), status
"#;
