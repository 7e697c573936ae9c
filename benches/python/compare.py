"""Prints the times of poses and Jacobians of a UR5 in Python, with abbe and with its peers: compare.py BATCH [CONFIGURATIONS]"""

import importlib
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

# One core for all.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "peers"))

import numpy as np  # noqa: E402

PEERS = {"abbe": "with_abbe", "Pinocchio": "with_pinocchio", "Robotics Toolbox": "with_roboticstoolbox"}
FUNCTIONS = {"pose": "pose, 4 × 4", "joint_jacobian": "J_q, 6 × 6", "error_jacobian": "J_e, 6 × 36"}
# Minimum time of a round, s; slower peers get fewer configurations, which is reported.
ROUND, LONGEST, ROUNDS = 0.05, 20.0, 5


def taken(function, q, count):
    """Returns the seconds of one call, the mean over a round."""
    calls, begin = 0, time.perf_counter()
    while True:
        function(q)
        calls += 1
        seconds = time.perf_counter() - begin
        if seconds > ROUND:
            return seconds / calls / count


def shown(seconds):
    for unit, factor in (("ns", 1e9), ("µs", 1e6), ("ms", 1e3)):
        if seconds * factor < 1000:
            break
    return f"{seconds * factor:.3g} {unit}"


def lines(file):
    text = [line.strip() for line in file.read_text(encoding="utf-8").splitlines()]
    return sum(1 for line in text if line and not line.startswith("#"))


def check(modules):
    """Checks that all compute the same results."""
    q = np.random.default_rng(1).uniform(-3, 3, (20, 6))
    for function in FUNCTIONS:
        expected = getattr(modules["abbe"], function)(q)
        for name, module in modules.items():
            if hasattr(module, function):
                # mm: rounding errors of a chain of 1000 mm.
                difference = np.abs(getattr(module, function)(q) - expected).max()
                assert difference < 1e-9, (name, function, difference)


def import_time():
    """Returns the milliseconds of `import abbe` in a fresh interpreter, minus those of an empty one. It does not import NumPy."""
    code = "import time; begin = time.perf_counter(); import abbe; print(time.perf_counter() - begin)"
    runs = [float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout) for _ in range(15)]
    return statistics.median(runs) * 1e3


def main(batch, most=1_000_000):
    modules = {name: importlib.import_module(module) for name, module in PEERS.items()}
    check(modules)
    joints = np.random.default_rng(0).uniform(-3, 3, (most, 6))
    print("\n| a configuration | " + " | ".join(modules) + " |\n|---|" + "---|" * len(modules))
    for function, title in FUNCTIONS.items():
        for count in (1, 1000, most):
            q = joints[0] if count == 1 else joints[:count]
            cells = {name: [] for name, module in modules.items() if hasattr(module, function)}
            fewer = {}
            for name in cells:
                each = taken(getattr(modules[name], function), q[:1000] if count > 1000 else q, min(count, 1000))
                fewer[name] = count if each * count < LONGEST else max(1000, int(LONGEST / each))
            # Alternating, so that other load affects both.
            for _ in range(1 if max(fewer.values()) > 1000 and len(cells) > 1 else ROUNDS):
                for name, seconds in cells.items():
                    here = q[: fewer[name]] if count > 1 else q
                    seconds.append(taken(getattr(modules[name], function), here, fewer[name]))
            row = [shown(statistics.median(cells[name])) if name in cells else "" for name in modules]
            print(f"| {title}, N = {count:,} | " + " | ".join(row) + " |")
    print("| lines of the user | " + " | ".join(str(lines(HERE / "peers" / f"{module}.py")) for module in PEERS.values()) + " |")

    out = np.empty((most, 6, 36))
    rust, python, into = [], [], []
    for _ in range(7):
        rust.append([float(each) for each in subprocess.run([batch, str(most), "1"], capture_output=True, text=True, check=True).stdout.split()])
        python.append(taken(modules["abbe"].error_jacobian, joints, most) * 1e9)
        into.append(taken(lambda q: modules["abbe"].error_jacobian(q, out=out), joints, most) * 1e9)
    interpreted, compiled = (statistics.median(each) for each in zip(*rust, strict=True))
    found, given = statistics.median(python), statistics.median(into)
    print(f"\n{most:,} J_e, written row by row, ns each: Python {found:.0f}, into an array that is there {given:.0f};")
    print(f"Rust {interpreted:.0f} by the interpreter and {compiled:.0f} compiled: Python takes {found / interpreted:.2f} × the interpreter's")
    print(f"import abbe: {import_time():.0f} ms")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:3]))
