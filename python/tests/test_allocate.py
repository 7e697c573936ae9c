"""Allocations from Python are those of the command."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import abbe

COMMAND = os.environ.get("ABBE")
pps = abbe.load("pps")


@pytest.mark.skipif(COMMAND is None, reason="ABBE names no command")
def test_it_is_what_the_command_prints():
    report = pps.allocate(tolerance="0.4 mm", loosen=True)
    arguments = [COMMAND, "allocate", "pps", "--tolerance", "0.4 mm", "--loosen", "--json"]
    assert json.loads(report.to_json()) == json.loads(subprocess.check_output(arguments))


def test_the_scaled_machine_needs_no_more():
    scaled = pps
    for source in pps.allocate().sources:
        scaled = scaled.scale(source.source, source.factor)
    assert all(source.factor == 1.0 for source in scaled.allocate().sources)
    study = Path(__file__).parents[2] / "manipulators/studies/pps.toml"
    assert all(source.factor == 1.0 for source in abbe.load(text=scaled.text).allocate(study=study).sources)
