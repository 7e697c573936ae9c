"""Writes every peer's functions for every table.

main.py OUT TIMES TABLE…: in OUT, one source file for each library, robot and kind of result, and `generated.json` with
the libraries' versions, operation counts, and the median of the seconds that it took TIMES times from table to text.
"""

import importlib
import json
import statistics
import sys
import time
from importlib.metadata import version
from pathlib import Path

from count import operations

LIBRARIES = ["casadi", "symforce", "sympy", "wrenfold"]
MODULES = {"casadi": "casadi_c", "symforce": "symforce_cpp", "sympy": "sympy_c", "wrenfold": "wrenfold_rust"}
KINDS = ["dense", "distinct", "displacement", "covariance"]


def main():
    out, times, *tables = Path(sys.argv[1]), int(sys.argv[2]), *map(Path, sys.argv[3:])
    rows = []
    for library in LIBRARIES:
        module = importlib.import_module(MODULES[library])
        for path in tables:
            table = json.loads(path.read_text(encoding="utf-8"))
            row = {"library": library, "version": version(library), "robot": table["name"]}
            for kind in KINDS:
                name = f"{library}_{table['name']}_{kind}"
                seconds = []
                for _ in range(times):
                    start = time.perf_counter()
                    text, counted = module.function(table, kind, name)
                    seconds.append(time.perf_counter() - start)
                (out / f"{name}.{module.SUFFIX}").write_text(text, encoding="utf-8")
                mul, add = operations(counted)
                row[kind] = {"mul": mul, "add": add, "seconds": statistics.median(seconds)}
            rows.append(row)
    (out / "generated.json").write_text(json.dumps(rows, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
