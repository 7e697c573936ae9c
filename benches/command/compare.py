"""Runs commands of two builds in turns, and prints the medians of their processor times and of the ratios."""

import os
import statistics
import subprocess
import sys

folder, runs = sys.argv[1], int(sys.argv[2])
COMMANDS = {
    "analyze pps": ["analyze", "pps"],
    "check pps": ["check", "pps"],
    "identify ur5, 10,000 rows": ["identify", "ur5", f"{folder}/rows.csv", "--map", "ur5"],
    "measure ur5, 10,000 rows": ["measure", "ur5", f"{folder}/rows.csv", "--map", "ur5"],
    "bound ur5": ["bound", "ur5"],
}


def seconds(build, arguments):
    process = subprocess.Popen([f"{folder}/{build}/release/abbe", *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, _, usage = os.wait4(process.pid, 0)
    return usage.ru_utime + usage.ru_stime


print(f"{'ms of processor time, medians':<32}{'shipped':>10}{'optimized':>10}{'ratio':>8}")
for name, arguments in COMMANDS.items():
    pairs = [[seconds(build, arguments) for build in ("shipped", "optimized")] for _ in range(runs)]
    shipped, optimized = (1e3 * statistics.median(times) for times in zip(*pairs))
    print(f"{name:<32}{shipped:>10.0f}{optimized:>10.0f}{statistics.median(a / b for a, b in pairs):>8.2f}")
