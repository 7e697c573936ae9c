"""Numbers from Python equal those of the command to the last bit."""

import json
import os
import subprocess

import numpy as np
import pytest

import abbe

COMMAND = os.environ.get("ABBE")


@pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
@pytest.mark.parametrize("name", abbe.shipped())
def test_jacobian(name):
    machine = abbe.load(name)
    q = [home + 0.1 * (i + 1) for i, home in enumerate(machine.home)]
    values = ",".join(map(repr, q))
    printed = subprocess.run([COMMAND, "jacobian", name, f"--q={values}", "--json"], check=True, capture_output=True)
    said = json.loads(printed.stdout)
    assert said["q"] == q and tuple(said["rows"]) == machine.rows and tuple(said["columns"]) == machine.columns
    assert np.array_equal(machine.pose(q), said["pose"])
    assert np.array_equal(machine.error_jacobian(q), said["error_jacobian"])
    assert np.array_equal(machine.generalized_errors(q).ravel(), said["generalized_errors"])
