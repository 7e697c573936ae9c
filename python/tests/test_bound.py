"""Bounds from Python are those of the command."""

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
    assert subprocess.check_output(arguments, text=True).startswith(str(report))
    assert report.full() == subprocess.check_output([*arguments, "--full"], text=True)


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


def test_dexterity_is_the_least_singular_value():
    assert machine3.bound().dexterity is None
    robot = abbe.load("pps")
    dexterity = robot.bound(least=True, boxes=2000).dexterity
    for rows, least in ((3, dexterity.point), (6, dexterity.pose)):
        q = [least.at[name] for name in ("d1", "d2", "d3", "q4", "q5", "q6")]
        tool = {name: least.at[name] for name in ("x", "y", "z")}
        # Prismatic joints move by metres.
        columns = robot.with_parameters(**tool).joint_jacobian(q)[:rows] * [1000, 1000, 1000, 1, 1, 1]
        columns[:3] /= 1000
        found = np.linalg.svd(columns, compute_uv=False).min()
        assert least.certified <= least.found == pytest.approx(found, abs=1e-9)


def test_one_step_of_compensation_leaves_no_more_than_is_certified():
    robot = abbe.load("machine3").with_parameters(temperature_rise="8 K")
    left = robot.bound().after_one_step.position
    q = np.random.default_rng(2).uniform([20, 20, 20], [580, 380, 430], (500, 3))
    for q in q:
        corrected = q - robot.predict(q[None])[0, :3]
        missed = robot.real_pose(corrected)[:3, 3] - robot.pose(q)[:3, 3]
        assert np.linalg.norm(missed) <= left


def test_stiffness_is_what_a_force_at_the_tool_says():
    text = """
[manipulator]
name = "arm"
length = "mm"
gravity = [0, 0, 0]
[inputs]
push = { value = "0 N", range = ["-100 N", "100 N"] }
[[frame]]
name = "1"
variable = { name = "turn", kind = "revolute", limits = ["-60 deg", "60 deg"] }
transform = "Rz(turn) Tx(600 mm)"
[[frame]]
name = "2"
variable = { name = "bend", kind = "revolute", limits = ["-120 deg", "120 deg"] }
transform = "Rz(bend) Tx(400 mm)"
[[source]]
name = "gear"
class = "repeatable"
frame = "2"
at = "Tx(-400 mm)"
compliance = { diagonal = [0, 0, 0, 0, "1e-5/(N*m)", "1e-5/(N*m)"] }
[[source]]
name = "link"
class = "repeatable"
frame = "1"
beam = { length = "600 mm", EI_y = "2e4 N*m^2", EI_z = "3e4 N*m^2", GJ = "1e4 N*m^2" }
"""
    axes = ['["push", 0, 0]', '[0, "push", 0]', '[0, 0, "push"]']
    load = '[[load]]\nframe = "2"\npoint = "tool"\naxes = "base"\nforce = '
    stiffness = abbe.load(text=text + load + axes[1]).bound(least=True).stiffness
    assert stiffness.complete and stiffness.certified <= stiffness.found
    q = [stiffness.at["turn"], stiffness.at["bend"]]
    # Deflection in mm under 100 N, axis by axis.
    moved = [
        abbe.load(text=text + load + axis).with_parameters(push="100 N").predict(np.array([q]))[0, :3]
        for axis in axes
    ]
    softest = np.linalg.svd(np.array(moved) / 1000 / 100, compute_uv=False).max()
    assert stiffness.found == pytest.approx(1 / softest, rel=1e-9)
