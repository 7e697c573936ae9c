"""Identification of many machines, and bootstrap of one machine.

A table is a dict of columns of equal length, which pandas, polars and pyarrow accept. `row` converts one report to a row, for example on
a Ray or Dask worker, and `table` combines rows.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any

import numpy as np

from ._abbe import Machine
from .reports import IdentifyReport

__all__ = ["bootstrap", "identify", "row", "table"]


def row(name: str, report: IdentifyReport) -> dict[str, Any]:
    """Return the identified errors of one machine: its name as `machine`, each parameter, such as `e_x1`, and its standard deviation, `e_x1 sd`.

    Only parameters of the machine itself are included, not those of station and targets. The parameters that represent the identifiable
    combinations depend on the spec and on the measurements: machines with the same spec and the same plan have the same parameters.
    """
    found: dict[str, Any] = {"machine": name}
    for parameter in report.parameters:
        if parameter.kind == "machine":
            found[parameter.name] = parameter.value
            found[f"{parameter.name} sd"] = parameter.standard_deviation
    return found


def table(rows: Iterable[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Combine rows to columns, in the order of their first occurrence, with None for missing values.

    >>> import abbe.fleet
    >>> abbe.fleet.table([{"machine": "1", "e_x1": 0.1}, {"machine": "2", "e_y1": 0.2}])
    {'machine': ['1', '2'], 'e_x1': [0.1, None], 'e_y1': [None, 0.2]}
    """
    rows = list(rows)
    names = dict.fromkeys(name for each in rows for name in each)
    return {name: [each.get(name) for each in rows] for name in names}


def identify(
    machine: Machine, files: Mapping[str, str | PathLike[str]], map: str | PathLike[str], **options: Any
) -> dict[str, list[Any]]:
    """Identify a fleet, one row per machine.

    `files` maps the name of each machine to its measurements; `options` are those of `Machine.identify`.
    """
    return table(row(name, machine.identify(file, map, **options)) for name, file in files.items())


def bootstrap(
    machine: Machine,
    data: str | PathLike[str],
    map: str | PathLike[str],
    *,
    repetitions: int = 200,
    **options: Any,
) -> dict[str, list[Any]]:
    """Bootstrap the identification of a machine, one row per parameter.

    Columns: `parameter`, its identified `value` and `sd`, and the standard deviation (`bootstrap sd`) and quantiles (`2.5 %`, `97.5 %`) of
    the repetitions.

    Each repetition resamples configurations with replacement, together with all their rows, because rows of one configuration share its
    errors and are not independent. Repetition b is `machine.identify(…, resample=b)` and can be computed anywhere.
    """
    if repetitions < 2:
        raise ValueError("`repetitions`: from 2 on")
    found = row("all", machine.identify(data, map, **options))
    drawn = [row(str(b), machine.identify(data, map, resample=b, **options)) for b in range(repetitions)]
    rows = []
    for name, value in found.items():
        if name == "machine" or name.endswith(" sd"):
            continue
        values = np.array([each[name] for each in drawn if name in each])
        several = len(values) > 1
        ends = np.quantile(values, [0.025, 0.975]) if several else [None, None]
        rows.append(
            {
                "parameter": name,
                "value": value,
                "sd": found[f"{name} sd"],
                "bootstrap sd": float(values.std(ddof=1)) if several else None,
                "2.5 %": None if ends[0] is None else float(ends[0]),
                "97.5 %": None if ends[1] is None else float(ends[1]),
            }
        )
    return table(rows)
