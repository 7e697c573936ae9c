"""Imported URDF robots compared with Pinocchio: the same poses and joint Jacobians.

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

MIXED = """<robot name="mixed">
  <link name="ground"/> <link name="foot"/> <link name="carriage"/> <link name="arm"/> <link name="plate"/>
  <link name="finger"/> <link name="wheel"/> <link name="tip"/>
  <joint name="foot" type="fixed">
    <parent link="ground"/> <child link="foot"/> <origin xyz="0.1 -0.2 0.3" rpy="0.1 1.5707963267948966 -0.4"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="foot"/> <child link="carriage"/> <origin xyz="0 0 0.5"/> <axis xyz="3 -4 1"/>
    <limit lower="-0.2" upper="0.9" effort="1" velocity="1"/>
  </joint>
  <joint name="Turn Table" type="continuous">
    <parent link="carriage"/> <child link="arm"/> <origin rpy="0 0.3 0"/> <axis xyz="-2 2 1"/>
  </joint>
  <joint name="mount" type="fixed">
    <parent link="arm"/> <child link="plate"/> <origin xyz="0.4 0 0" rpy="1.57079632679 0 3.1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="plate"/> <child link="finger"/> <origin xyz="0.3 0.1 0" rpy="0.7 -0.2 0.1"/> <axis xyz="0 -1 0"/>
    <limit lower="-2" upper="1.5" effort="1" velocity="1"/>
  </joint>
  <joint name="wheel" type="revolute">
    <parent link="finger"/> <child link="wheel"/> <origin xyz="0 0 0.2"/> <axis xyz="0.6 0 0.8"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/> <mimic joint="elbow" multiplier="-1.5" offset="0.25"/>
  </joint>
  <joint name="hook" type="fixed">
    <parent link="wheel"/> <child link="tip"/> <origin xyz="0 0.07 0.2" rpy="0 0 1"/>
  </joint>
</robot>
"""


def imported(file, base, tip, folder, *more):
    spec = folder / "robot.toml"
    ends = [f"--{end}={link}" for end, link in [("base", base), ("tip", tip)] if link]
    arguments = [COMMAND, "import", str(file), *ends, "--force", "-o", str(spec), *more]
    subprocess.run(arguments, check=True, capture_output=True)
    return abbe.load(spec)


def largest_differences(file, base, tip, folder, *more):
    """Return the largest differences of poses and joint Jacobians over random values of all joints; joints outside the chain have no effect."""
    machine = imported(file, base, tip, folder, *more)
    model = pin.buildModelFromUrdf(str(file), mimic=True)
    data = model.createData()
    base = base or next(frame.name for frame in model.frames if frame.type == pin.FrameType.BODY and frame.name != "universe")
    first, last = (model.getFrameId(link, pin.FrameType.BODY) for link in (base, tip))
    assert last < model.nframes and first < model.nframes
    identifiers = {"".join(c if c.isalnum() and c.isascii() else "_" for c in name.lower()): name for name in model.names}
    joints = [model.joints[model.getJointId(identifiers[variable])] for variable in machine.variables]
    lower, upper = np.clip(machine.limits, -4, 4).T
    of_pose = of_jacobian = 0.0
    for q in np.random.default_rng(14).uniform(lower, upper, (CONFIGURATIONS, len(joints))):
        whole = pin.neutral(model)
        for joint, value in zip(joints, q):
            # Pinocchio represents a joint without limits by cosine and sine.
            whole[joint.idx_q : joint.idx_q + joint.nq] = value if joint.nq == 1 else [np.cos(value), np.sin(value)]
        pin.computeJointJacobians(model, data, whole)
        pin.updateFramePlacements(model, data)
        pose = data.oMf[first].actInv(data.oMf[last])
        jacobian = pin.getFrameJacobian(model, data, last, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        back = data.oMf[first].rotation.T
        jacobian = np.vstack([back @ jacobian[:3], back @ jacobian[3:]])[:, [joint.idx_v for joint in joints]]
        of_pose = max(of_pose, np.abs(machine.pose(q) - pose.homogeneous).max())
        of_jacobian = max(of_jacobian, np.abs(machine.joint_jacobian(q) - jacobian).max())
    return of_pose, of_jacobian


@pytest.mark.parametrize("more", [(), ("--fold",)])
def test_everything_that_a_chain_can_have(tmp_path, more):
    file = tmp_path / "mixed.urdf"
    file.write_text(MIXED)
    differences = largest_differences(file, "ground", "tip", tmp_path, *more)
    assert max(differences) < 1e-12, differences


@pytest.mark.parametrize("name", ROBOTS)
def test_public_robots(tmp_path, name):
    path, base, tip = ROBOTS[name]
    differences = largest_differences(described(path), base, tip, tmp_path)
    print(f"{name}: pose {differences[0]:.1e}, joint Jacobian {differences[1]:.1e}")
    assert max(differences) < 1e-12, differences
