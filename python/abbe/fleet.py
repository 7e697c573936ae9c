"""Jobs of a fleet of machines, on threads of this machine, on Ray or on Dask; and the bootstrap of one machine.

A table is a dict of columns of equal length, which pandas, polars and pyarrow accept. `row` converts one report to a row, and `table`
combines rows.

>>> import abbe, abbe.fleet
>>> ur5 = abbe.load("ur5")
>>> data = {name: ur5.simulate("ur5", samples=20, seed=seed).table("rows") for name, seed in [("a", 1), ("b", 2)]}
>>> abbe.fleet.identify(ur5, data, "ur5")["machine"]
['a', 'b']
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from os import PathLike
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np

from ._abbe import Machine, __version__
from ._arrays import columns
from .reports import IdentifyReport

__all__ = ["Identify", "bootstrap", "identify", "map", "row", "table"]

Row: TypeAlias = dict[str, Any]
Job: TypeAlias = Callable[[Any], Any]
Task: TypeAlias = list[tuple[str, Any]]
# Called with the number of finished machines and their total number; true prints them.
Progress: TypeAlias = bool | Callable[[int, int], object]

# Machines of a task are so many that each worker has this many tasks, and at most the second number.
_TASKS, _MOST = 8, 64


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


class Identify:
    """Job that identifies a machine: `Identify(machine, map, **options)(data)` is the report of `machine.identify(data, map, **options)`,
    computed by one thread."""

    def __init__(self, machine: Machine, map: str | PathLike[str] | Mapping[str, Any], **options: Any) -> None:
        self.machine, self.map, self.options = machine, map, {"threads": 1} | options

    def __call__(self, data: Any) -> IdentifyReport:
        return self.machine.identify(data, self.map, **self.options)

    def mark(self) -> str:
        """Return a mark of the job, which changes with its machine, map and options, and with the version of abbe."""
        options = [(name, value, _mark(value)) for name, value in sorted(self.options.items())]
        return hashlib.sha256(repr([__version__, self.machine.__reduce__()[1], _mark(self.map), options]).encode()).hexdigest()


def identify(
    machine: Machine, files: Any, map: str | PathLike[str] | Mapping[str, Any], *, by: str | None = None, engine: Literal["local", "ray", "dask"] = "local",
    workers: int | None = None, on_error: Literal["row", "raise"] = "row", resume: str | PathLike[str] | None = None,
    progress: Progress = False, **options: Any,
) -> dict[str, list[Any]]:
    """Identify a fleet, one row per machine.

    `files` are the measurements by the name of each machine, or a table of all of them with a column `by`; the keywords are those of
    `abbe.fleet.map`, `options` those of `Machine.identify`.
    """
    return _map(Identify(machine, map, **options), files, by, engine, workers, on_error, resume, progress)


def map(
    job: Job, fleet: Any, *, by: str | None = None, engine: Literal["local", "ray", "dask"] = "local", workers: int | None = None,
    on_error: Literal["row", "raise"] = "row", resume: str | PathLike[str] | None = None, progress: Progress = False,
) -> dict[str, list[Any]]:
    """Apply a job to each machine of a fleet. Return a table with a row for each, in the order of the fleet, whatever the engine.

    `fleet` is a mapping from the name of each machine to the argument of `job`, such as a path; or a table with a column `by` of names,
    such as one of pandas, polars or pyarrow, or the path of a Parquet file: the argument is then a dict of the columns of one machine.
    `job` returns a report of `identify`, or a dict, which becomes the row.

    `engine`: "local" for threads of this process, "ray" for the Ray cluster that is connected, or one of this machine, "dask" for the
    current client, or one of this machine. `workers`: their number; all cores without it. A task whose worker is lost runs again.

    `on_error`: "row" makes a machine that fails a row with its message in the column `error`; "raise" raises it. `resume`: a folder,
    which is made if it is not there; rows are kept in it as soon as they are known, and read again when the same call is repeated.
    Machines that failed, or whose data have changed, are computed again, and all with another version of abbe or, of `identify`, with
    another machine, map or option; another function of yours needs another folder. `progress`: true prints the
    number of machines that are done; a function is called with it, and with their number.
    """
    return _map(job, fleet, by, engine, workers, on_error, resume, progress)


def _map(
    job: Job, fleet: Any, by: str | None, engine: str, workers: int | None, on_error: str, resume: str | PathLike[str] | None,
    progress: Progress,
) -> dict[str, list[Any]]:
    if engine not in _ENGINES:
        raise ValueError(f"engine={engine!r}: one of {', '.join(_ENGINES)}")
    if on_error not in ("row", "raise"):
        raise ValueError(f'on_error={on_error!r}: "row" or "raise"')
    workers = workers or len(getattr(os, "sched_getaffinity", lambda _: range(os.cpu_count() or 1))(0))
    items = _items(fleet, by)
    kept = _Kept(resume, items, job) if resume is not None else None
    rows: dict[str, Row] = dict(kept.rows) if kept else {}
    waiting = [(name, item) for name, item in items.items() if name not in rows]
    size = max(1, min(_MOST, len(waiting) // (_TASKS * workers)))
    tasks = [waiting[i : i + size] for i in range(0, len(waiting), size)]
    for found in _ENGINES[engine](job, tasks, workers, on_error):
        rows |= {each["machine"]: each for each in found}
        if kept:
            kept.keep(found)
        if callable(progress):
            progress(len(rows), len(items))
        elif progress:
            print(f"\r{len(rows)} of {len(items)} machines", end="" if len(rows) < len(items) else "\n", file=sys.stderr, flush=True)
    return table(rows[name] for name in items)


def _items(fleet: Any, by: str | None) -> dict[str, Any]:
    """Return the argument of each machine by its name."""
    if by is None:
        if not isinstance(fleet, Mapping):
            raise TypeError("give a mapping from the name of each machine to its data, or a table and the column of names as `by`")
        return {str(name): item for name, item in fleet.items()}
    if isinstance(fleet, (str, PathLike)):
        from pyarrow import parquet  # type: ignore[import-untyped, import-not-found, unused-ignore]

        fleet = parquet.read_table(fleet)
    found = dict(columns(fleet, "fleet", None)[0])
    if by not in found:
        raise ValueError(f"the table has no column `{by}`: its columns are {', '.join(found)}")
    del found[by]
    # As they stand: a serial number may have more digits than a float.
    names = [_name(cell) for cell in np.asarray(fleet[by]).tolist()]
    if missing := sum(name in ("", "nan", "None", "NaT", "<NA>") for name in names):
        raise ValueError(f"the column `{by}` is empty in {missing} of {len(names)} rows")
    places: dict[str, list[int]] = {}
    for place, name in enumerate(names):
        places.setdefault(name, []).append(place)
    arrays = {name: cells if isinstance(cells, np.ndarray) else np.array(cells, dtype=object) for name, cells in found.items()}
    return {name: {column: cells[rows] for column, cells in arrays.items()} for name, rows in places.items()}


def _name(cell: Any) -> str:
    """Return the name in a cell: a serial number may be a number."""
    return str(int(cell)) if isinstance(cell, float) and cell.is_integer() else str(cell)


def _attempt(job: Job, task: Task, on_error: str) -> list[Row]:
    """Return the rows of some machines."""
    rows = []
    for name, item in task:
        try:
            found = job(item)
            rows.append({"machine": name} | dict(found) | {"machine": name} if isinstance(found, dict) else row(name, found))
        except Exception as error:
            if on_error == "raise":
                raise
            rows.append({"machine": name, "error": str(error) or type(error).__name__})
    return rows


def _local(job: Job, tasks: list[Task], workers: int, on_error: str) -> Iterator[list[Row]]:
    with ThreadPoolExecutor(workers) as pool:
        futures = [pool.submit(_attempt, job, task, on_error) for task in tasks]
        try:
            for future in as_completed(futures):
                yield future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def _ray(job: Job, tasks: list[Task], workers: int, on_error: str) -> Iterator[list[Row]]:
    import ray  # type: ignore[import-untyped, import-not-found, unused-ignore]

    if not ray.is_initialized():
        ray.init(num_cpus=workers, log_to_driver=False, include_dashboard=False)
    shared = ray.put(job)
    attempt = ray.remote(max_retries=3)(_attempt)
    waiting = [attempt.remote(shared, task, on_error) for task in tasks]
    while waiting:
        done, waiting = ray.wait(waiting)
        yield from ray.get(done)


def _dask(job: Job, tasks: list[Task], workers: int, on_error: str) -> Iterator[list[Row]]:
    from dask import distributed  # type: ignore[import-untyped, import-not-found, unused-ignore]

    def rows(client: Any) -> Iterator[list[Row]]:
        [shared] = client.scatter([job], broadcast=True)
        futures = [client.submit(_attempt, shared, task, on_error, pure=False, retries=3) for task in tasks]
        for future in distributed.as_completed(futures):
            yield future.result()

    try:
        client = distributed.get_client()
    except ValueError:
        with distributed.Client(n_workers=workers, threads_per_worker=1, dashboard_address=None) as client:
            yield from rows(client)
    else:
        yield from rows(client)


_ENGINES: dict[str, Callable[[Job, list[Task], int, str], Iterator[list[Row]]]] = {"local": _local, "ray": _ray, "dask": _dask}


class _Kept:
    """Rows of an earlier call, in a file of a folder."""

    def __init__(self, folder: str | PathLike[str], items: Mapping[str, Any], job: Job) -> None:
        Path(folder).mkdir(parents=True, exist_ok=True)
        self._file = Path(folder, "rows.jsonl")
        of_job = job.mark() if isinstance(job, Identify) else __version__
        self._marks = {name: f"{of_job} {_mark(item)}" for name, item in items.items()}
        self.rows: dict[str, Row] = {}
        text = self._file.read_text(encoding="utf-8") if self._file.exists() else ""
        # A line that was being written when the process ended is not whole.
        for line in text[: text.rfind("\n") + 1].splitlines():
            mark, row = json.loads(line)
            if self._marks.get(row["machine"]) == mark and "error" not in row:
                self.rows[row["machine"]] = row
        if not text.endswith("\n") and text:
            self._file.write_text(text[: text.rfind("\n") + 1], encoding="utf-8")

    def keep(self, rows: Iterable[Row]) -> None:
        lines = "".join(json.dumps([self._marks[row["machine"]], row], default=_as_json) + "\n" for row in rows)
        with open(self._file, "a", encoding="utf-8") as file:
            file.write(lines)


def _as_json(value: Any) -> Any:
    """Return what JSON has in place of an array, a number of NumPy, or anything else."""
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else str(value)


def _mark(item: Any) -> str:
    """Return a mark of data, which changes with them."""
    if isinstance(item, (str, PathLike)) and os.path.isfile(item):
        return hashlib.sha256(Path(item).read_bytes()).hexdigest()
    try:
        found, _ = columns(item, "data", None)
    except (TypeError, ValueError):
        return hashlib.sha256(repr(item).encode()).hexdigest()
    marked = hashlib.sha256()
    for name, cells in found:
        marked.update(name.encode() + b"\0")
        marked.update(cells.tobytes() if isinstance(cells, np.ndarray) else "\0".join(cells).encode())
    return marked.hexdigest()


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
