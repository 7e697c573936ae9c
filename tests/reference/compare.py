"""What the command says of 30 random specs, against this folder's own mathematics.

    python3 tests/reference/compare.py target/debug/abbe [--only SEED]
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import random_specs
from budget import Sweep
from kinematics import Configuration
from spec import Spec

SPECS = 30
TOLERANCE = 1e-9


class Comparison:
    def __init__(self):
        self.compared, self.failures, self.largest = 0, [], 0.0

    def numbers(self, place, ours, theirs, scale=0.0):
        """Two numbers, lists or tables of numbers; relative to the larger of themselves and `scale`."""
        if isinstance(ours, dict):
            for key, value in ours.items():
                self.numbers(f"{place}.{key}", value, theirs[key], scale)
        elif isinstance(ours, (list, tuple)):
            if len(ours) != len(theirs):
                self.failures.append(f"{place}: {len(theirs)} entries, expected {len(ours)}")
            for i, (a, b) in enumerate(zip(ours, theirs)):
                self.numbers(f"{place}[{i}]", a, b, scale)
        else:
            difference = abs(ours - theirs) / max(abs(ours), scale, 1e-300)
            self.compared += 1
            self.largest = max(self.largest, difference)
            if not difference <= TOLERANCE:
                self.failures.append(f"{place}: {theirs!r}, expected {ours!r}")


def abbe(command, *arguments):
    result = subprocess.run([command, *arguments, "--json"], capture_output=True, text=True)
    if result.returncode == 2 or not result.stdout:
        raise RuntimeError(f"{' '.join(arguments)}\n{result.stderr}")
    return json.loads(result.stdout)


def write(path, text):
    path.write_text(text)
    return str(path)


def compare_one(command, seed, folder, comparison):
    writer = random_specs.Writer(seed)
    text = writer.spec()
    file = write(folder / f"random{seed}.toml", text)
    spec = Spec(text)
    variables = [variable["name"] for variable in spec.variables]
    configurations = writer.configurations(25)
    for place in configurations[:2]:
        jacobian(command, file, spec, place, comparison, seed)
    columns = [f"{name} ({'rad' if name[0] == 'q' else spec.length})" for name in variables]
    rows = [",".join(columns)] + [",".join(repr(place[name]) for name in variables) for place in configurations]
    write(folder / f"path{seed}.csv", "\n".join(rows) + "\n")
    study = f'[study]\ntitle = "random"\n[workspace.path]\nfile = "path{seed}.csv"\n'
    report = abbe(command, "analyze", file, "--study", write(folder / f"study{seed}.toml", study))
    names = [spec.names(place) for place in configurations]
    sweep = Sweep(spec, names, spec.names({}))
    budget(sweep, report, comparison, seed)
    return writer.used


def jacobian(command, file, spec, place, comparison, seed):
    changes = {"s1": 0.4321 * (1000 if spec.length == "mm" else 1), "payload": 4.25}
    values = ",".join(repr(place[variable["name"]]) for variable in spec.variables)
    sets = [f"--set={name}={value!r}{' kg' if name == 'payload' else ''}" for name, value in changes.items()]
    report = abbe(command, "jacobian", file, f"--q={values}", *sets)
    configuration = Configuration(spec, spec.names(place, **changes))
    place = f"random{seed}.jacobian"
    pose, columns = configuration.pose(), configuration.error_jacobian()
    scale = max(abs(x) for column in columns for x in column)
    comparison.numbers(f"{place}.pose", pose, report["pose"][:3], scale)
    rows = [list(row) for row in zip(*columns)]
    comparison.numbers(f"{place}.error_jacobian", rows, report["error_jacobian"], scale)
    repeatable = [source for source in spec.sources if source.enabled and source.repeatable]
    errors = configuration.equivalent_errors(repeatable)
    largest = max(map(abs, errors))
    comparison.numbers(f"{place}.generalized_errors", errors, report["generalized_errors"], largest)


def budget(sweep, report, comparison, seed):
    place = f"random{seed}"
    theirs = {source["name"]: source for source in report["sources"]}
    if set(theirs) != {source.name for source in sweep.sources}:
        comparison.failures.append(f"{place}: sources {sorted(theirs)}")
        return
    for k, source in enumerate(sweep.sources):
        alone = sweep.alone(k)
        scale = alone["plain_max"]["norm"]
        turned = alone.pop("orientation")
        comparison.numbers(f"{place}.{source.name}", alone, theirs[source.name], scale)
        comparison.numbers(f"{place}.{source.name}.orientation", turned, theirs[source.name]["orientation"], max(turned))
    combined = sweep.combined()
    comparison.numbers(f"{place}.combined", combined, report["combined"], combined["radius"])


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("command")
    arguments.add_argument("--only", type=int)
    arguments.add_argument("--keep")
    options = arguments.parse_args()
    comparison, used = Comparison(), set()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(options.keep or folder)
        for seed in range(SPECS) if options.only is None else [options.only]:
            try:
                used |= compare_one(options.command, seed, folder, comparison)
            except RuntimeError as error:
                comparison.failures.append(f"random{seed}: {error}")
    for failure in comparison.failures[:40]:
        print(failure)
    forms = {*random_specs.FRAME_FORMS, *random_specs.SOURCE_FORMS} - random_specs.MISSING
    if options.only is None and forms - used:
        comparison.failures.append(f"no spec used {sorted(forms - used)}")
        print(comparison.failures[-1])
    print(f"{comparison.compared} numbers compared; the largest difference is {comparison.largest:.1e} of their size")
    sys.exit(1 if comparison.failures else 0)


if __name__ == "__main__":
    main()
