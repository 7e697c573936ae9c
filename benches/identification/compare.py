"""Runs every program on the same rows, and on the same rows misread, and prints what came out.

compare.py ABBE VENVS GRID.csv RANDOM.csv
"""
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROBOT = HERE.parent.parent / "manipulators"
ABBE, VENVS, GRID, RANDOM = sys.argv[1:]
# What a program says of its own result: the lines with one of these words.
TELLING = re.compile(r"Convergence:|Excluded:|Condition:|condition is satisfied|error:|help|warning|note:|Traceback|Error", re.I)


# The longest that a program is waited for, s.
PATIENCE = 600


def lines(path, until=None):
    """Lines that somebody had to write: no comments, no docstrings, no prose about the robot."""
    text = re.sub(r'"""(?s:.*?)"""', '""', pathlib.Path(path).read_text())
    text = text.split(until)[0] if until else text
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("#"))


def run(*command):
    start = time.monotonic()
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        done = subprocess.CompletedProcess(command, 1, "", f"error: not done after {PATIENCE} s")
    return done, time.monotonic() - start


def told(text):
    found = [" ".join(line.split()) for line in text.splitlines() if TELLING.search(line)]
    return [line[:150] for line in found[:4]]


def peer(name, misread):
    def fit():
        done, seconds = run(pathlib.Path(VENVS, name, "bin/python"), HERE / name / "fit.py", GRID, RANDOM, misread)
        unseen = re.search(r"^UNSEEN (.*)$", done.stdout, re.M)
        distances = [float(number) for number in unseen[1].split()] if unseen else []
        return distances, seconds, told(done.stdout + done.stderr)

    return fit


def abbe(misread):
    def fit():
        text = (ROBOT / "maps/ur5.toml").read_text()
        if misread == "mm":
            text = text.replace('unit = "mm"', 'unit = "m"')
        if misread == "rad":
            text = text.replace('unit = "deg"', 'unit = "rad"')
        with tempfile.TemporaryDirectory() as folder:
            chart = pathlib.Path(folder, "ur5.toml")
            chart.write_text(text)
            done, seconds = run(ABBE, "identify", "ur5", GRID, "--map", chart, "--test", RANDOM, "--json")
        unseen = json.loads(done.stdout)["test"]["after"] if done.stdout.startswith("{") else None
        return unseen, seconds, told(done.stderr)

    return fit


def shown(unseen):
    """Mean and its standard error, and the largest."""
    if not unseen:
        return "none", ""
    if isinstance(unseen, dict):
        n = unseen["count"] if "count" in unseen else sum(1 for _ in open(RANDOM)) - 1
        mean, largest = unseen["mean"], unseen["max"]
        error = math.sqrt(max(unseen["rms"] ** 2 - mean**2, 0.0) / (n - 1))
    else:
        mean, largest = statistics.mean(unseen), max(unseen)
        error = statistics.stdev(unseen) / math.sqrt(len(unseen))
    return f"{mean:.4f} ± {error:.4f}", f"{largest:.3f}"


PROGRAMS = [
    ("abbe", abbe, lines(ROBOT / "specs/ur5.toml", "[[source]]") + lines(ROBOT / "maps/ur5.toml")),
    ("FIGAROH", lambda misread: peer("figaroh", misread), lines(HERE / "figaroh/fit.py") + lines(HERE / "figaroh/fit.yaml")),
    ("pybotics", lambda misread: peer("pybotics", misread), lines(HERE / "pybotics/fit.py")),
    ("SciPy", lambda misread: peer("scipy", misread), lines(HERE / "scipy/fit.py")),
]
MISREAD = [("mm", "Millimetres of the measured points read as metres"), ("rad", "Degrees of the joints read as radians")]

print("| | unseen mean, mm | largest, mm | s | lines of the user |\n|---|---|---|---|---|")
for name, program, written in PROGRAMS:
    unseen, seconds, _ = program("")()
    print("| " + " | ".join([name, *shown(unseen), f"{seconds:.2f}", str(written)]) + " |", flush=True)
for misread, title in MISREAD:
    print(f"\n{title}:\n\n| | unseen mean, mm | what it says |\n|---|---|---|")
    for name, program, _ in PROGRAMS:
        unseen, _, said = program(misread)()
        print(f"| {name} | {shown(unseen)[0]} | {'; '.join(said).replace('|', '/') or 'nothing'} |", flush=True)
