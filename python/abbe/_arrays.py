"""What users give as numbers, made into arrays of double numbers. Imported when it is first needed: NumPy takes its time."""

from collections.abc import Mapping

import numpy as np


def numbers(value, what, names):
    """A C-contiguous, aligned array of `value`; of a table, its columns `names` side by side."""
    if names is not None and (known := _columns(value)) is not None:
        missing = [name for name in names if name not in known]
        if missing:
            raise ValueError(f"`{what}` has no column {', '.join(missing)}: columns are named as the joint variables, {', '.join(names)}")
        columns = [_real(value[name], name) for name in names]
        value = np.stack(np.broadcast_arrays(*columns), axis=-1) if columns else np.empty(0)
    return np.require(_real(value, what), np.float64, ["C", "A"])


def _real(value, what):
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"`{what}` is a masked array: say what its masked values are, with .filled(…)")
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"`{what}` must be real numbers, not {array.dtype}")
    return array


def _columns(value):
    """The names of the columns of a table: a mapping, a structured array, a frame of pandas or polars, a table of pyarrow."""
    if isinstance(value, Mapping):
        return value.keys()
    if isinstance(value, np.ndarray):
        return value.dtype.names
    for attribute in ("column_names", "columns"):
        columns = getattr(value, attribute, None)
        if columns is not None and not callable(columns):
            return list(columns)
    return None
