"""The shipped manipulators: the paper's own job, and each of them at some random configurations."""

import json
import math
import pathlib
import random
import tomllib

import questions
from budget import Sweep
from presented import presented
from spec import Spec

SPECS = pathlib.Path(__file__).parents[2] / "manipulators/specs"


def paper(comparison):
    """27 points of the treatment volume at the isocentre, in 37 angles of spin."""
    spec = Spec((SPECS / "pps.toml").read_text(), SPECS)
    lists = {
        "x": [-250.0, 0.0, 250.0],
        "y": [-100.0, 100.0, 300.0],
        "z": [600.0, 850.0, 1100.0],
        "q4": [math.radians(5 * k) for k in range(-18, 19)],
    }
    names, missed = presented(spec, [1128.0, 1626.0, 1846.0], ["d1", "d2", "d3"], lists)
    report = comparison.abbe("analyze", "pps")
    comparison.numbers("pps.unreachable", missed, report["unreachable"])
    questions.budget(comparison, "pps", Sweep(spec, names, spec.names({})), report)


def some_configurations(comparison, folder):
    for file in sorted(SPECS.glob("*.toml")):
        spec, name = Spec(file.read_text(), SPECS), file.stem
        generator = random.Random(name)
        limits = {v["name"]: v["limits"] or (-2.0, 2.0) for v in spec.variables}
        configurations = [{v: generator.uniform(*ends) for v, ends in limits.items()} for _ in range(8)]
        questions.jacobian(comparison, f"{name}.jacobian", name, spec, configurations[0], {})
        if not any(source.enabled for source in spec.sources):
            continue
        units = {v["name"]: "rad" if v["kind"] == "revolute" else spec.length for v in spec.variables}
        lines = [",".join(f"{v} ({unit})" for v, unit in units.items())]
        lines += [",".join(map(repr, there.values())) for there in configurations]
        (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
        # Inputs as they are without a study.
        inputs = tomllib.loads(file.read_text()).get("inputs", {})
        fixed = "".join(f"{key} = {json.dumps(given['value'])}\n" for key, given in inputs.items())
        study = folder / f"{name}_study.toml"
        study.write_text(f'[study]\ntitle = "some"\n[study.set]\n{fixed}[workspace.path]\nfile = "{name}.csv"\n')
        report = comparison.abbe("analyze", name, "--study", str(study))
        names = [spec.names(there) for there in configurations]
        questions.budget(comparison, name, Sweep(spec, names, spec.names({})), report)
