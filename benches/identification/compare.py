"""Runs every program on the same rows, and on the same rows misread, and prints the results.

compare.py ABBE VENVS GRID.csv RANDOM.csv
"""
import csv
import itertools
import math
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROBOT = HERE.parent.parent / "manipulators"
ABBE, VENVS, GRID, RANDOM = sys.argv[1:]
# Words that mark the lines in which a program reports its own result.
TELLING = re.compile(
    r"Convergence:|Excluded:|condition is satisfied|evaluations is exceeded|error:|help|warning|note:|Traceback|Error", re.I
)
# Time limit of a program, s.
PATIENCE = 300


def lines(path, until=None):
    """Returns the number of handwritten lines: no comments, no docstrings, no prose about the robot."""
    text = re.sub(r'"""(?s:.*?)"""', '""', pathlib.Path(path).read_text())
    text = text.split(until)[0] if until else text
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("#"))


def points(path):
    """Returns the measured points: target minus difference."""
    with open(path, newline="") as file:
        return [[float(row[f"{axis}_t"]) - float(row[f"{axis}_dif"]) for axis in "xyz"] for row in csv.DictReader(file)]


MEASURED = points(RANDOM)


def run(*command):
    """Returns the output of a program and its processor time, which does not depend on other load."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        done = subprocess.CompletedProcess(command, 1, "", f"error: not done after {PATIENCE} s")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def told(text):
    """Returns the statements of a program about its result, in one cell."""
    found = [" ".join(line.split()) for line in text.splitlines() if TELLING.search(line) and "RuntimeWarning" not in line]
    return "; ".join(line[:180] for line in found[:4]).replace("|", "/") or "nothing"


def peer(name, misread):
    done, seconds = run(pathlib.Path(VENVS, name.lower(), "bin/python"), HERE / name.lower() / "fit.py", GRID, RANDOM, misread)
    found = re.search(r"^POINTS (.*)$", done.stdout, re.M)
    numbers = [float(number) for number in found[1].split()] if found else []
    return [numbers[i : i + 3] for i in range(0, len(numbers), 3)], seconds, told(done.stdout + done.stderr)


def abbe(misread):
    text = (ROBOT / "maps/ur5.toml").read_text()
    if misread == "mm":
        text = text.replace('unit = "mm"', 'unit = "m"')
    if misread == "rad":
        text = text.replace('unit = "deg"', 'unit = "rad"')
    with tempfile.TemporaryDirectory() as folder:
        chart, found, seen = (pathlib.Path(folder, name) for name in ("ur5.toml", "found.toml", "seen.csv"))
        chart.write_text(text)
        done, seconds = run(ABBE, "identify", "ur5", GRID, "--map", chart, "--out", found)
        if done.returncode != 0:
            return [], seconds, told(done.stderr)
        # Configurations at which the identified machine is compared.
        run(ABBE, "simulate", found, RANDOM, "--map", found.with_suffix(".map.toml"), "--noise", "1e-9mm", "--out", seen)
        return points(seen), seconds, told(done.stderr)


def mean(values):
    """Returns the mean and its standard error."""
    return f"{statistics.mean(values):.4f} ± {statistics.stdev(values) / math.sqrt(len(values)):.4f}"


def errors(predicted):
    return [math.dist(a, b) for a, b in zip(predicted, MEASURED)]


def row(*cells):
    print("| " + " | ".join(cells) + " |", flush=True)


WRITTEN = {
    "abbe": lines(ROBOT / "specs/ur5.toml", "[[source]]") + lines(ROBOT / "maps/ur5.toml"),
    "FIGAROH": lines(HERE / "figaroh/fit.py") + lines(HERE / "figaroh/fit.yaml"),
    "pybotics": lines(HERE / "pybotics/fit.py"),
    "SciPy": lines(HERE / "scipy/fit.py"),
}


def program(name, misread):
    return abbe(misread) if name == "abbe" else peer(name, misread)


heads = ["", "unseen mean, mm", "less that of abbe, row by row", "largest, mm", "processor time, s", "lines of the user", "what it says"]
print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
predicted = {}
for name, written in WRITTEN.items():
    predicted[name], seconds, said = program(name, "")
    if not predicted[name]:
        row(name, "none", "", "", f"{seconds:.2f}", str(written), said)
        continue
    unseen = errors(predicted[name])
    less = [a - b for a, b in zip(unseen, errors(predicted["abbe"]))]
    row(name, mean(unseen), mean(less) if any(less) else "", f"{max(unseen):.3f}", f"{seconds:.2f}", str(written), said)

print("\nHow far apart two programs say that the tool is, on the same unseen rows:\n")
print("| | mean, mm | largest, mm |\n|---|---|---|")
for a, b in itertools.combinations([name for name in predicted if predicted[name]], 2):
    apart = [math.dist(p, q) for p, q in zip(predicted[a], predicted[b])]
    row(f"{a}, {b}", f"{statistics.mean(apart):.4f}", f"{max(apart):.4f}")

for misread, title in [
    ("mm", "Millimetres of the measured points read as metres"),
    ("rad", "Degrees of the joints read as radians"),
]:
    print(f"\n{title}:\n\n| | unseen mean, mm | what it says |\n|---|---|---|")
    for name in WRITTEN:
        found, _, said = program(name, misread)
        row(name, mean(errors(found)) if found else "none", said)
