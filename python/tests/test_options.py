"""Options: the same defaults as the command, and error messages in terms of Python."""

import ast
import inspect
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

import abbe

COMMAND = os.environ.get("ABBE")
ur5 = abbe.load("ur5")

# Options with another name in the command.
NAMES = {"language": "lang"}


def defaults(method):
    """Yield the defaults that are numbers or texts, with the option names of the command."""
    for name, parameter in inspect.signature(method).parameters.items():
        if isinstance(parameter.default, int | float | str) and not isinstance(parameter.default, bool):
            yield NAMES.get(name, name.replace("_", "-")), parameter.default


def number(text):
    return float(text.removesuffix("%")) / (100 if text.endswith("%") else 1)


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
@pytest.mark.parametrize("job", ["bound", "export", "generate", "identify", "monitor", "plan", "simulate"])
def test_the_defaults_are_those_of_the_command(job):
    printed = subprocess.run([COMMAND, job, "--help"], check=True, capture_output=True, text=True).stdout
    # The help of an option ends at the next option.
    options = dict(re.findall(r"^ +(?:-\w, )?--([\w-]+)(.*?)(?=^ +(?:-\w, )?--|\Z)", printed, re.M | re.S))
    checked = 0
    for name, default in defaults(getattr(abbe.Machine, job)):
        said = re.search(r"\[default: ([^\]]*)\]", options.get(name, ""))
        if said is None:
            assert (job, name) == ("plan", "count"), f"abbe {job} --{name} has no default"
        elif isinstance(default, str):
            assert said[1] == default
        else:
            assert number(said[1]) == default
        checked += 1
    assert checked > 0


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: ur5.analyze(monte_carlo=10_000_001), "`monte_carlo` is from 1 to 10000000"),
        (lambda: ur5.analyze(threads=1025), "`threads` is from 1 to 1024"),
        (lambda: ur5.bound(gap=0), "`gap`: a gap must be positive"),
        (lambda: ur5.bound(boxes=0), "`boxes` is from 1 to 100000000"),
        (lambda: ur5.export("table", nodes=1), "`nodes` is from 2 to 1000000"),
        (lambda: ur5.export("dh", samples=0), "`samples` is from 1 to 1000000"),
        (lambda: ur5.export("csv"), 'to="csv": "dh", "urdf"'),
        (lambda: ur5.generate("cobol"), 'language="cobol": "rust", "c"'),
        (lambda: ur5.generate("c", real="half"), 'real="half": "double" or "float"'),
        (lambda: ur5.identify("a", "b", terms="wind"), 'terms="wind": "auto", "joint"'),
        (lambda: ur5.identify("a", "b", robust="very"), 'robust="very": "none", "huber" or "tukey"'),
        (lambda: ur5.identify("a", "b", folds=1), "`folds` is from 2 to 1000"),
        (lambda: ur5.monitor(["a"], "b", false_alarm=9), "`false_alarm` is from 10 to 100000"),
        (lambda: ur5.plan("a", criterion="w"), 'criterion="w": "v" or "d"'),
        (lambda: ur5.plan("a", count=5001), "`count` is from 1 to 5000"),
        (lambda: ur5.plan("a", candidates=0), "`candidates` is from 1 to 1000000"),
        (lambda: ur5.simulate("a", samples=0), "`samples` is from 1 to 10000000"),
        (lambda: ur5.simulate("a", outliers=float("nan")), "`outliers` is from 0 to 1"),
        (lambda: abbe.import_dh({}, convention="craig"), 'convention="craig": "standard" or "modified"'),
    ],
)
def test_what_is_not_allowed(call, says):
    with pytest.raises(ValueError) as caught:
        call()
    assert str(caught.value).startswith(says) and "--" not in str(caught.value)


def whole_numbers():
    """Yield the arguments of all methods and functions that are whole numbers, by the stubs."""
    tree = ast.parse((Path(abbe.__file__).parent / "_abbe.pyi").read_text(encoding="utf-8"))
    owners = [(None, tree.body)] + [(node.name, node.body) for node in tree.body if isinstance(node, ast.ClassDef)]
    for owner, body in owners:
        for node in body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
                for argument in node.args.args + node.args.kwonlyargs:
                    if argument.annotation and re.search(r"\bint\b", ast.unparse(argument.annotation)):
                        yield owner, node.name, argument.arg


REQUIRED = {"identify": ("a", "ur5"), "plan": ("ur5",), "simulate": ("ur5",), "monitor": (["a"], "ur5"), "export": ("dh",), "merge": ([],)}


@pytest.mark.parametrize("wrong", [-1, -(2**70), 2**70, np.int64(-1)])
def test_whole_numbers_out_of_range(wrong, tmp_path):
    rows = tmp_path / "rows.csv"
    rows.write_text(str(ur5.simulate("ur5", samples=20)), encoding="utf-8")
    found = set(whole_numbers())
    assert {("Machine", "analyze", name) for name in ("monte_carlo", "seed", "shard", "threads")} <= found and len(found) > 15
    for owner, function, name in sorted(found, key=str):
        method = getattr({"Machine": ur5, "Report": ur5.analyze(), None: abbe}[owner], function)
        required = [str(rows) if one == "a" else one for one in REQUIRED.get(function, ())]
        value = (wrong, wrong) if name == "shard" else wrong
        with pytest.raises(ValueError, match=f"`{name}`.* (from [-0-9]+ to [0-9]+|between 1 and)"):
            method(*required, **{name: value})
