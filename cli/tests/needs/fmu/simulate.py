"""Validates a functional mock-up unit with FMPy, compiles it, and simulates it: simulate.py UNIT COMPILER INPUT OUTPUT.

COMPILER is `fmpy`, which reads how from the description, or `cc`, whose library becomes part of the archive. INPUT has names of
variables, and rows that stand for a second each; OUTPUT gets the outputs of each row by co-simulation and by model exchange."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile

import fmpy
import numpy as np
from fmpy.build import build_platform_binary
from fmpy.validation import validate_fmu

# CMake may be one of Python's packages.
os.environ["PATH"] = os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"]

WARNINGS = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion", "-Werror"]


def compiled(unit, compiler):
    """The unit with a library for this machine."""
    folder = tempfile.mkdtemp(dir=os.path.dirname(unit))
    with zipfile.ZipFile(unit) as archive:
        archive.extractall(folder)
    if compiler == "fmpy":
        build_platform_binary(folder, configuration="Debug", all_warnings=True)
        return folder
    description = fmpy.read_model_description(unit)
    platform = "linux64" if description.fmiVersion == "2.0" else fmpy.platform_tuple
    name = description.coSimulation.modelIdentifier
    library = f"binaries/{platform}/{name}{fmpy.sharedLibraryExtension}"
    os.makedirs(os.path.dirname(os.path.join(folder, library)))
    files = [os.path.join(folder, "sources", file) for file in description.buildConfigurations[0].sourceFileSets[0].sourceFiles]
    subprocess.run(["cc", "-shared", "-fPIC", *WARNINGS, "-o", os.path.join(folder, library), *files, "-lm"], check=True)
    binary = f"{folder}.fmu"
    shutil.copy(unit, binary)
    with zipfile.ZipFile(binary, "a") as archive:
        archive.write(os.path.join(folder, library), library)
    assert validate_fmu(binary) == [], validate_fmu(binary)
    return binary


def simulated(unit, kind, names, rows):
    """The outputs of every row."""
    last = len(rows) if kind == "CoSimulation" else len(rows) - 1
    table = np.array([(float(k), *row) for k, row in enumerate(rows)], dtype=[("time", float)] + [(name, float) for name in names])
    found = fmpy.simulate_fmu(unit, fmi_type=kind, input=table, start_time=0.0, stop_time=float(last), output_interval=1.0, solver="Euler", step_size=1.0)
    # Of several samples at one time the last is that after what was set.
    at = {time: k for k, time in enumerate(found["time"])}
    # In co-simulation what was set at a time is seen a step later.
    later = 1.0 if kind == "CoSimulation" else 0.0
    outputs = found.dtype.names[1:]
    return outputs, [[found[name][at[k + later]].item() for name in outputs] for k in range(len(rows))]


def main(unit, compiler, given, result):
    problems = validate_fmu(unit)
    assert problems == [], problems
    with open(given) as file:
        given = json.load(file)
    binary = compiled(unit, compiler)
    kinds = ["CoSimulation", "ModelExchange"]
    found = {kind: simulated(binary, kind, given["names"], given["rows"]) for kind in kinds}
    with open(result, "w") as file:
        json.dump(found, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
