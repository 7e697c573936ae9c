"""Calibrated URDF in Pinocchio: with six errors of every frame and joint zero offsets, the tool agrees with the identified spec.

`pip install pin example-robot-data` installs both; tests without them are skipped.
"""

import os
import subprocess

import numpy as np
import pytest

import abbe

from robots import ROBOTS, described

pin = pytest.importorskip("pinocchio", reason="Pinocchio (pip install pin) is not installed")

COMMAND = os.environ.get("ABBE")
pytestmark = pytest.mark.skipif(not COMMAND, reason="the environment variable ABBE does not name the abbe command")
CONFIGURATIONS = 1000

CELL = """<?xml version="1.0"?>
<!-- The cell by the window. -->
<robot name="cell">
  <link name="floor"/> <link name="carriage"/> <link name="upper"/> <link name="plate"/> <link name="fore"/> <link name="tool"/>
  <joint name="lift" type="prismatic">
    <parent link="floor"/> <child link="carriage"/> <axis xyz="0 0 1"/>
    <limit lower="0" upper="0.8" effort="1" velocity="1"/>
  </joint>
  <joint name="shoulder" type="revolute">
    <parent link="carriage"/> <child link="upper"/> <origin rpy="0.3 0 -1.5708" xyz="0.1 0 0.4"/> <axis xyz="0 0.6 0.8"/>
    <limit lower="-2.6" upper="2.6" effort="1" velocity="1"/>
  </joint>
  <joint name="mount" type="fixed"> <parent link="upper"/> <child link="plate"/> <origin xyz="0.2 0 0"/> </joint>
  <joint name="elbow" type="revolute">
    <parent link="plate"/> <child link="fore"/> <origin rpy="3.14159 1.2 -3.1"/> <axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="flange" type="fixed"> <parent link="fore"/> <child link="tool"/> <origin xyz="0.4 0 0"/> </joint>
</robot>
"""


def found(spec):
    """Return the spec with six constant errors of every frame, up to 1 mm and 1 mrad, and a zero offset of every joint."""
    machine = abbe.load(spec)
    random = np.random.default_rng(14)
    text = spec.read_text()
    for frame in machine.frames:
        errors = [f'{name} = "{random.uniform(-1, 1)!r} {unit}"' for name, unit in zip(COMPONENTS, ["mm"] * 3 + ["mrad"] * 3)]
        text += f'\n[[source]]\nname = "found: {frame}"\nclass = "repeatable"\nframe = "{frame}"\n' + "\n".join(errors) + "\n"
    for variable in machine.variables:
        unit = "mm" if variable == "lift" or "torso" in variable else "mrad"
        text += f'\n[[source]]\nname = "zero of {variable}"\nclass = "repeatable"\njoint = "{variable}"\nerror = "{random.uniform(-2, 2)!r} {unit}"\n'
    file = spec.with_name("found.toml")
    file.write_text(text)
    return file


COMPONENTS = ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"]


def run(*arguments):
    subprocess.run([COMMAND, *map(str, arguments)], check=True, capture_output=True)


def calibrated(file, base, tip, folder, *fold):
    """Return the largest distances of the calibrated and of the nominal tool from the tool of the identified spec."""
    ends = ["--base", base, "--tip", tip]
    nominal, result = folder / "robot.toml", folder / "calibrated.urdf"
    run("import", file, *ends, *fold, "--force", "-o", nominal)
    spec = found(nominal)
    run("export", spec, "--to", "urdf", "--from", file, *ends, "--force", "-o", result)
    machine = abbe.load(spec)
    lower, upper = np.clip(machine.limits, -4, 4).T
    largest = []
    for robot in (result, file):
        model = pin.buildModelFromUrdf(str(robot))
        data = model.createData()
        first, last = (model.getFrameId(link, pin.FrameType.BODY) for link in (base, tip))
        names = {"".join(c if c.isalnum() and c.isascii() else "_" for c in name.lower()): name for name in model.names}
        joints = [model.joints[model.getJointId(names[variable])] for variable in machine.variables]
        difference = 0.0
        for q in np.random.default_rng(7).uniform(lower, upper, (CONFIGURATIONS, len(joints))):
            whole = pin.neutral(model)
            for joint, value in zip(joints, q):
                whole[joint.idx_q : joint.idx_q + joint.nq] = value if joint.nq == 1 else [np.cos(value), np.sin(value)]
            pin.framesForwardKinematics(model, data, whole)
            pose = data.oMf[first].actInv(data.oMf[last])
            difference = max(difference, np.abs(machine.real_pose(q) - pose.homogeneous).max())
        largest.append(difference)
    return largest


@pytest.mark.parametrize("fold", [(), ("--fold",)])
def test_a_calibrated_file_has_the_found_tool(tmp_path, fold):
    file = tmp_path / "cell.urdf"
    file.write_text(CELL)
    after, before = calibrated(file, "floor", "tool", tmp_path, *fold)
    assert before > 1e-3 and after < 1e-9, (before, after)
    assert "<!-- The cell by the window. -->" in (tmp_path / "calibrated.urdf").read_text()


@pytest.mark.parametrize("name", ["ur5", "panda", "tiago"])
def test_public_robots(tmp_path, name):
    path, base, tip = ROBOTS[name]
    after, before = calibrated(described(path), base, tip, tmp_path)
    print(f"{name}: {before:.1e} m or rad from the nominal file, {after:.1e} from the calibrated one")
    assert before > 1e-3 and after < 1e-9, (before, after)
