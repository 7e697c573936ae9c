"""Many identifications: one row for each machine of a fleet, or for each repetition of a bootstrap.

A table is a dict of columns of equal length, which pandas, polars and pyarrow take as it is. `row` makes one row of one report: what
`identify` found on a worker of Ray or Dask becomes a row there, and `table` puts rows together.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import Any

import numpy as np

from ._abbe import Machine, Report

__all__ = ["bootstrap", "identify", "row", "table"]


def row(name: str, report: Report) -> dict[str, Any]:
    """What was found of one machine: `machine`; each parameter as `e_x1`, with its standard deviation as `e_x1 sd`.

    Parameters are those of the machine itself: where it stands, and what is mounted on its tool, are left out. Which ones stand for the
    combinations that are known depends on the spec and on what was measured; machines of one spec measured alike have the same.
    """
    found: dict[str, Any] = {"machine": name}
    for parameter in report.parameters:
        if parameter.kind == "machine":
            found[parameter.name] = parameter.value
            found[f"{parameter.name} sd"] = parameter.standard_deviation
    return found


def table(rows: Iterable[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Columns of rows, in the order in which they come first; None where a row has nothing of that name.

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
    """One row for each machine of a fleet: `files` has the measurements of each by its name, `options` are those of
    `Machine.identify`."""
    return table(row(name, machine.identify(file, map, **options)) for name, file in files.items())


def bootstrap(
    machine: Machine,
    data: str | PathLike[str],
    map: str | PathLike[str],
    *,
    repetitions: int = 200,
    **options: Any,
) -> dict[str, list[Any]]:
    """One row for each parameter: `parameter`; its `value` and `sd` as identified; `bootstrap sd`, and the ends `2.5 %` and `97.5 %`
    of what the repetitions gave.

    A repetition identifies the machine from as many configurations as were measured, drawn with replacement, with all their rows:
    rows of one configuration share its errors, and are not independent. Repetition b is `machine.identify(…, resample=b)`,
    whoever computes it.
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
