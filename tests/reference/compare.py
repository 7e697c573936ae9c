"""What the command says of 30 random specs, against this folder's own mathematics.

    python3 tests/reference/compare.py target/debug/abbe [--only SEED]
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import monte_carlo
import random_specs
from budget import Sweep
from identifiable import ranks
from kinematics import Configuration
from presented import presented
from spec import Spec

SPECS = 30
SPECS_FOLDER = pathlib.Path(__file__).parents[2] / "manipulators/specs"
TOLERANCE = 1e-9
DRAWN_EVERY, CHECKED_EVERY = 10, 3
DRAWS = 20_000


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


    def drawn(self, place, ours, theirs, standard_error):
        self.compared += 1
        apart = abs(ours - theirs)
        # What does not vary is the same to rounding.
        if apart > 3 * standard_error + TOLERANCE * abs(ours):
            self.failures.append(f"{place}: {theirs!r}, expected {ours!r} within 3 x {standard_error:.2g}")


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
    configurations = writer.configurations(25)
    for configuration in configurations[:2]:
        jacobian(command, file, spec, configuration, comparison, f"random{seed}.jacobian")
    if seed % CHECKED_EVERY == 0:
        check(command, file, spec, configurations[:15], comparison, f"random{seed}.check")
    workspace, configurations = writer.workspace(configurations, folder)
    enabled = [source.name for source in spec.sources if not source.enabled][:1]
    for source in spec.sources:
        source.enabled = source.enabled or source.name in enabled
    study = write(folder / f"study{seed}.toml", f'[study]\ntitle = "random"\nenable = {enabled}\n{workspace}')
    drawn = seed % DRAWN_EVERY == 0
    report = abbe(command, "analyze", file, "--study", study, *(["--monte-carlo", str(DRAWS)] if drawn else []))
    sweep = Sweep(spec, [spec.names(place) for place in configurations], spec.names({}))
    budget(sweep, report, comparison, f"random{seed}")
    if drawn:
        for place in ("worst", "home"):
            at = report["monte_carlo"][place]
            configuration = Configuration(spec, spec.names(at["at"]))
            drawn_alike(configuration, sweep.sources, at, comparison, f"random{seed}.monte_carlo.{place}")
    return writer.used


def check(command, file, spec, configurations, comparison, place):
    report = abbe(command, "check", file)
    for ours, theirs in zip(spec.variables, report["variables"], strict=True):
        comparison.numbers(f"{place}.limits", ours["limits"], theirs["limits"], 1.0)
        comparison.numbers(f"{place}.home", ours["home"], theirs["home"], 1.0)
    for name, value in {**spec.parameters, **spec.inputs}.items():
        theirs = next(x for x in report["parameters"] + report["inputs"] if x["name"] == name)
        comparison.numbers(f"{place}.{name}", value, theirs["nominal"])
        if name in spec.ranges:
            comparison.numbers(f"{place}.{name}.range", spec.ranges[name], theirs["range"], 1.0)
    names = [spec.names(configuration) for configuration in configurations]
    for base in (False, True):
        for measured, ours in zip(("pose", "point"), ranks(spec, names, base)):
            [theirs] = [x for x in report["identifiable"] if (x["measurement"], x["base"]) == (measured, base)]
            comparison.numbers(f"{place}.identifiable {measured} {base}", ours, theirs["rank"])


def paper(command, comparison):
    """The paper's job: 27 points of the treatment volume at the isocentre, in 37 angles of spin."""
    file = SPECS_FOLDER / "pps.toml"
    spec = Spec(file.read_text())
    lists = {
        "x": [-250.0, 0.0, 250.0],
        "y": [-100.0, 100.0, 300.0],
        "z": [600.0, 850.0, 1100.0],
        "q4": [math.radians(5 * k) for k in range(-18, 19)],
    }
    names, missed = presented(spec, [1128.0, 1626.0, 1846.0], ["d1", "d2", "d3"], lists)
    report = abbe(command, "analyze", "pps")
    comparison.numbers("pps.unreachable", missed, report["unreachable"])
    comparison.numbers("pps.configurations", len(names), report["configurations"])
    budget(Sweep(spec, names, spec.names({})), report, comparison, "pps")


def drawn_alike(configuration, sources, theirs, comparison, place):
    """Two independent samples: three standard errors of their difference apart at most."""
    errors = monte_carlo.draws(configuration, sources, DRAWS // 2, seed=5)
    ours = monte_carlo.summary(errors, [quantile["probability"] for quantile in theirs["quantiles"]])
    variances = [theirs["covariance"][i][i] for i in range(3)]
    for i in range(3):
        error = math.hypot(ours["mean_error"][i], math.sqrt(variances[i] / DRAWS))
        comparison.drawn(f"{place}.mean[{i}]", ours["mean"][i], theirs["mean"][i], error)
        for j in range(3):
            error = math.hypot(ours["covariance_error"][i][j], theirs["covariance_standard_error"][i][j])
            pair = ours["covariance"][i][j], theirs["covariance"][i][j]
            comparison.drawn(f"{place}.covariance[{i}][{j}]", *pair, error)
    for (value, error), quantile in zip(ours["quantiles"], theirs["quantiles"]):
        error = math.hypot(error, quantile["standard_error"])
        comparison.drawn(f"{place}.quantile {quantile['probability']}", value, quantile["value"], error)


def jacobian(command, file, spec, configuration, comparison, place):
    changes = {"s1": 0.4321 * (1000 if spec.length == "mm" else 1), "payload": 4.25}
    values = ",".join(repr(configuration[variable["name"]]) for variable in spec.variables)
    sets = [f"--set={name}={value!r}{' kg' if name == 'payload' else ''}" for name, value in changes.items()]
    report = abbe(command, "jacobian", file, f"--q={values}", *sets)
    configuration = Configuration(spec, spec.names(configuration, **changes))
    pose, columns = configuration.pose(), configuration.error_jacobian()
    scale = max(abs(x) for column in columns for x in column)
    comparison.numbers(f"{place}.pose", pose, report["pose"][:3], scale)
    rows = [list(row) for row in zip(*columns)]
    comparison.numbers(f"{place}.error_jacobian", rows, report["error_jacobian"], scale)
    repeatable = [source for source in spec.sources if source.enabled and source.repeatable]
    errors = configuration.equivalent_errors(repeatable)
    largest = max(map(abs, errors))
    comparison.numbers(f"{place}.generalized_errors", errors, report["generalized_errors"], largest)


def budget(sweep, report, comparison, place):
    comparison.numbers(f"{place}.configurations", len(sweep.places), report["configurations"])
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
    if "located exactly" not in random_specs.MISSING:
        exact = report["first_order"]["largest_difference"]
        comparison.numbers(f"{place}.first_order", sweep.largest_remainder(), exact, combined["radius"])


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("command")
    arguments.add_argument("--only", type=int)
    arguments.add_argument("--keep")
    options = arguments.parse_args()
    comparison, used = Comparison(), set()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(options.keep or folder)
        if options.only is None:
            paper(options.command, comparison)
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
