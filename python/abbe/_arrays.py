"""Conversion of arguments to float64 arrays. Imported on first use, because importing NumPy is slow."""

import io
from collections.abc import Mapping
from csv import writer
from numbers import Integral, Real
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np


def numbers(value, what, names):
    """Convert `value` to a C-contiguous, aligned float64 array; of a table, stack the columns `names` along the last axis."""
    if names is not None and (known := _columns(value)) is not None:
        missing = [name for name in names if name not in known]
        if missing:
            raise ValueError(f"`{what}` has no column {', '.join(missing)}: columns are named as the joint variables, {', '.join(names)}")
        columns = [_real(value[name], name) for name in names]
        value = np.stack(np.broadcast_arrays(*columns), axis=-1) if columns else np.empty(0)
    return np.require(_real(value, what), np.float64, ["C", "A"])


def among(value, names):
    """Return the columns of a table that are among `names`, as a dict; an empty one of anything else than a table."""
    return {name: _real(value[name], name) for name in _columns(value) or () if name in names}


def columns(value, what, wanted):
    """Return the columns `wanted` of a table, or all columns, and the names of the others.

    A column is a float64 array, with NaN for missing values, or a list of texts.
    """
    names = _columns(value)
    if names is None:
        raise TypeError(
            f"`{what}` must be the path of a CSV file, or a table: a dict of arrays, a frame of pandas or polars, a table of pyarrow;"
            f" it is of type {type(value).__name__}"
        )
    found = [(str(name), _cells(value[name], name, what)) for name in names if wanted is None or name in wanted]
    return found, [str(name) for name in names if wanted is not None and name not in wanted]


def beside(joints, seen, names):
    """Return a table with the joint columns `names` and the columns of `seen`."""
    joints, seen = numbers(joints, "data", names), _real(seen, "seen")
    if joints.ndim != 2 or joints.shape[1] != len(names):
        raise ValueError(f"`data` has shape {joints.shape}: beside `seen` it has a row of joints for each, (m, {len(names)})")
    if seen.ndim not in (2, 3) or len(seen) != len(joints):
        raise ValueError(f"`seen` has shape {seen.shape}: give a row for each of `data`, ({len(joints)}, 3) or more, or ({len(joints)}, 4, 4)")
    seen = seen.reshape(len(seen), -1)
    return dict(zip(names, joints.T)) | {f"seen_{k + 1}": column for k, column in enumerate(seen.T)}


def candidates(value, names, units, sets, count, defaults):
    """Return the number of candidates of a plan, its file, the number to choose, and the folder of the file, if it is one of ours.

    Rows of candidates, also of inputs and parameters in `units`, are written as a file, with all their digits.
    """
    number, most = defaults
    if value is None or isinstance(value, Integral):
        return (number if value is None else int(value)), sets, count, None
    if sets is not None:
        raise ValueError("give `sets` or rows of `candidates`, not both")
    rows = numbers(value, "candidates", names)
    if rows.ndim != 2 or rows.shape[1] != len(names) or not len(rows):
        raise ValueError(f"`candidates` has shape {rows.shape}: give their number, or configurations (m, {len(names)}), one or more")
    others = {name: np.broadcast_to(_real(value[name], name), len(rows)) for name in _columns(value) or () if name in units}
    table = dict(zip(names, rows.T)) | {f"{name} ({units[name]})" if units[name] else name: column for name, column in others.items()}
    if not all(np.isfinite(column).all() for column in table.values()):
        raise ValueError("`candidates` has a number that is not finite")
    folder = TemporaryDirectory()
    Path(folder.name, "candidates.csv").write_text(csv(table, "candidates"), encoding="utf-8")
    plan = '[plan]\ntitle = "candidates"\n[[set]]\nname = "candidates"\nworkspace.path = { file = "candidates.csv" }\n'
    Path(folder.name, "candidates.toml").write_text(plan, encoding="utf-8")
    return number, Path(folder.name, "candidates.toml"), most if count is None else count, folder


def targets(value):
    """Convert poses (…, 4, 4) or tool points (…, 3) to an array, and check them."""
    array = numbers(value, "target", None)
    if not np.isfinite(array).all():
        raise ValueError("`target` has a number that is not finite")
    if array.shape[-2:] != (4, 4):
        if array.shape[-1:] != (3,):
            raise ValueError(f"`target` has shape {array.shape}: give poses (…, 4, 4) or tool points (…, 3)")
        return array
    if (array[..., 3, :] != [0, 0, 0, 1]).any():
        raise ValueError("the last row of `target` is not 0 0 0 1: a pose has the tool point in its last column; is it transposed?")
    rotation = array[..., :3, :3]
    if (np.abs(rotation.swapaxes(-1, -2) @ rotation - np.eye(3)) > 1e-6).any() or (np.linalg.det(rotation) < 0).any():
        raise ValueError("`target` has no rotation matrix: its first three columns must be perpendicular unit vectors, right-handed")
    return array


def matrix(table):
    """Return the columns of numbers of a table as an array."""
    return np.stack([table[name] for name in table.columns[1:]], axis=-1) if table.columns[1:] else np.empty((0, 0))


def csv(value, what):
    """Format a table as CSV text."""
    found = [(name, cells if isinstance(cells, list) else [_text(cell) for cell in cells.tolist()]) for name, cells in columns(value, what, None)[0]]
    lengths = {len(cells) for _, cells in found}
    if len(lengths) > 1:
        raise ValueError(f"the columns of `{what}` have different lengths: {', '.join(map(str, sorted(lengths)))}")
    names, cells = zip(*found) if found else ((), ())
    written = io.StringIO()
    writer(written, lineterminator="\n").writerows([names, *zip(*cells)])
    return written.getvalue()


def _text(number):
    """Format a number as its shortest text, and NaN as an empty text."""
    return "" if number != number else repr(number)


def _cells(column, name, what):
    if isinstance(column, np.ma.MaskedArray):
        raise TypeError(f"column `{name}` of `{what}` is a masked array: say what its masked values are, with .filled(…)")
    array = np.asarray(column)
    if array.ndim != 1:
        raise ValueError(f"column `{name}` of `{what}` has shape {array.shape}: it needs one cell for each row")
    if array.dtype.kind in "iuf":
        return np.require(array, np.float64, ["C", "A"])
    if array.dtype.kind == "M":
        return ["" if text == "NaT" else text for text in array.astype("M8[s]").astype(str)]
    if array.dtype.kind not in "OUTb":
        raise TypeError(f"column `{name}` of `{what}` must be numbers, texts or dates, not {array.dtype}")
    cells = [None if _is_missing(cell) else cell for cell in array.tolist()]
    if all(cell is None or (isinstance(cell, Real) and not isinstance(cell, bool)) for cell in cells):
        return np.array(cells, dtype=np.float64)
    return ["" if cell is None else str(cell) for cell in cells]


def _is_missing(cell):
    """Return true for None, NaN, and the missing values of pandas."""
    if cell is None or type(cell).__name__ in ("NAType", "NaTType"):
        return True
    return isinstance(cell, float) and cell != cell


def _real(value, what):
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"`{what}` is a masked array: say what its masked values are, with .filled(…)")
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"`{what}` must be real numbers, not {array.dtype}")
    return array


def _columns(value):
    """Return the column names of a mapping, a structured array, a pandas or polars frame, or a pyarrow table; None for anything else."""
    if isinstance(value, Mapping):
        return value.keys()
    if isinstance(value, np.ndarray):
        return value.dtype.names
    for attribute in ("column_names", "columns"):
        columns = getattr(value, attribute, None)
        if columns is not None and not callable(columns):
            return list(columns)
    return None
