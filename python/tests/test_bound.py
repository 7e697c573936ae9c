"""What is certified from Python is what the command certifies."""

import json
import os
import subprocess

import numpy as np
import pytest

import abbe

COMMAND = os.environ.get("ABBE")
machine3 = abbe.load("machine3")


@pytest.mark.skipif(COMMAND is None, reason="ABBE names no command")
def test_it_is_what_the_command_prints():
    report = machine3.bound(gap=0.001)
    arguments = [COMMAND, "bound", "machine3", "--gap", "0.1%"]
    assert json.loads(report.to_json()) == json.loads(subprocess.check_output([*arguments, "--json"]))
    assert str(report).strip() == subprocess.check_output(arguments, text=True).strip()


def test_nothing_that_is_drawn_exceeds_it():
    warm = machine3.with_parameters(temperature_rise="8 K")
    report = warm.bound()
    assert list(report.to_dict()["box"]) == ["x", "y", "z"]
    norm = report.repeatable.norm
    q = np.random.default_rng(1).uniform([0, 0, 0], [600, 400, 450], (20_000, 3))
    drawn = np.linalg.norm(warm.predict(q)[:, :3], axis=1).max()
    assert 0.9 * norm.found < drawn <= norm.certified and norm.found <= norm.certified <= 1.01 * norm.found


def test_what_cannot_be_is_refused():
    for wrong in ({"gap": 0.0}, {"gap": float("nan")}, {"time": -1.0}):
        with pytest.raises(ValueError, match="gap|time"):
            machine3.bound(**wrong)
