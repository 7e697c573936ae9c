"""What the command says of 30 random specs, and of the paper's robot, against this folder's own mathematics.

    python3 tests/reference/compare.py target/debug/abbe            # all of it
    python3 tests/reference/compare.py target/debug/abbe --only 7 --keep FOLDER
"""

import argparse
import pathlib
import sys
import tempfile

import questions
import random_specs
import shipped
import textbook
from budget import Sweep
from comparison import Comparison
from spec import Spec

CHECKED_EVERY, DRAWN_EVERY = 3, 10


def random_spec(comparison, writer, folder):
    """All questions about one random spec."""
    seed, place = writer.seed, f"random{writer.seed}"
    file = folder / f"{place}.toml"
    # Inputs that the study sets are the same everywhere, at home too.
    text, places, workspace, configurations, home = writer.everything(folder)
    file.write_text(text)
    file, spec = str(file), Spec(text, folder)
    for configuration in places[:2]:
        changes = {"s1": 0.4321 * (1000 if spec.length == "mm" else 1), "payload": 4.25}
        questions.jacobian(comparison, f"{place}.jacobian", file, spec, configuration, changes)
    if seed % CHECKED_EVERY == 0:
        questions.check(comparison, f"{place}.check", file, spec, places[:15])
    # The study switches on the first source that the spec switches off.
    enabled = [source.name for source in spec.sources if not source.enabled][:1]
    for source in spec.sources:
        source.enabled = source.enabled or source.name.removesuffix(" (its magnitude)") in enabled
    sweep = Sweep(spec, [spec.names(there) for there in configurations], spec.names(home))
    # Some are met for certain, some likely, some not.
    tolerances = [(0.4, 0.7, 1.1)[seed % 3] * sweep.combined(first)["radius"] for first in (0, 3)]
    study = folder / f"study{seed}.toml"
    asked = ", probability = 0.95" if seed % 4 < 2 else ""
    tolerance = f'{{ position = "{tolerances[0]!r} {spec.length}", orientation = "{tolerances[1]!r} rad"{asked} }}'
    study.write_text(f'[study]\ntitle = "random"\ntolerance = {tolerance}\nenable = {enabled}\n{workspace}')
    draws = ["--monte-carlo", str(questions.DRAWS)] if seed % DRAWN_EVERY == 0 else []
    report = comparison.abbe("analyze", file, "--study", str(study), *draws)
    questions.budget(comparison, place, sweep, report)
    questions.covered(comparison, place, sweep, report)
    if draws:
        questions.drawn(comparison, place, sweep, report)


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("command")
    arguments.add_argument("--specs", type=int, default=30, help="how many")
    arguments.add_argument("--all", action="store_true", help="not only those that are the first to use a form")
    arguments.add_argument("--only", type=int, metavar="SEED")
    arguments.add_argument("--half", choices=["first", "second"], help="of the specs; the paper's robot is in the second")
    arguments.add_argument("--keep", type=pathlib.Path, metavar="FOLDER")
    options = arguments.parse_args()
    comparison, used = Comparison(options.command), set()
    halves = {"first": range(options.specs // 2), "second": range(options.specs // 2, options.specs)}
    asked = halves.get(options.half, range(options.specs))
    with tempfile.TemporaryDirectory() as folder:
        folder = options.keep or pathlib.Path(folder)
        for seed in range(options.specs):
            # What later ones use depends on it.
            before = set(used)
            random_specs.Writer(seed, used).everything(folder)
            is_new = options.all or options.only is not None or used != before
            if is_new and seed in asked and options.only in (None, seed):
                comparison.attempt(random_spec, random_specs.Writer(seed, before), folder)
        if options.only is None and options.half != "first":
            comparison.attempt(shipped.paper)
            comparison.attempt(shipped.some_configurations, folder)
            comparison.attempt(textbook.arm, folder)
            textbook.beams(comparison, folder)
    if options.only is None:
        unused = sorted(random_specs.FORMS - used)
        if unused:
            comparison.failures.append(f"no spec uses {unused}")
    for failure in comparison.failures[:40]:
        print(failure)
    print(f"{comparison.compared} numbers compared; the largest difference is {comparison.largest:.1e} of their size")
    sys.exit(1 if comparison.failures else 0)


if __name__ == "__main__":
    main()
