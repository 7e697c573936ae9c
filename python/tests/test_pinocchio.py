"""Pose and joint Jacobian of five manipulators compared with Pinocchio, from independent tables."""

import numpy as np
import pytest

import abbe

pin = pytest.importorskip("pinocchio", reason="Pinocchio (pip install pin) is not installed")

PI = np.pi


def x(turn, shift=0.0):
    return pin.SE3(pin.utils.rotate("x", turn), np.array([shift, 0.0, 0.0]))


def z(turn, shift=0.0):
    return pin.SE3(pin.utils.rotate("z", turn), np.array([0.0, 0.0, shift]))


def standard(*rows):
    """Yield the joints of a standard Denavit-Hartenberg table (d, a, alpha): Rz(q) Tz(d) Tx(a) Rx(alpha); prismatic if d is None."""
    identity = pin.SE3.Identity()
    for d, a, alpha in rows:
        joint = pin.JointModelPZ() if d is None else pin.JointModelRZ()
        yield identity, joint, z(0, d or 0.0) * x(alpha, a)


def modified(*rows):
    """Yield the joints of a modified table (Craig): Rx(alpha) Tx(a) Rz(q) Tz(d)."""
    for d, a, alpha in rows:
        yield x(alpha, a), pin.JointModelRZ(), z(0, d)


def urdf(*rows):
    for xyz, rpy in rows:
        yield pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array(xyz, dtype=float)), pin.JointModelRZ(), pin.SE3.Identity()


ROBOTS = {
    "ur5": (
        standard((89.16, 0, PI / 2), (0, -425, 0), (0, -392.25, 0), (109.15, 0, PI / 2), (94.56, 0, -PI / 2), (113.3, 0, 0)),
        z(0),
    ),
    "stanford": (
        standard((0.412, 0, -PI / 2), (0.154, 0, PI / 2), (None, 0, 0), (0, 0, -PI / 2), (0, 0, PI / 2), (0, 0, 0)),
        z(0),
    ),
    "wam": (
        standard((0, 0, -PI / 2), (0, 0, PI / 2), (550, 45, -PI / 2), (0, -45, PI / 2), (300, 0, -PI / 2), (0, 0, PI / 2), (60, 0, 0)),
        z(0, 44),
    ),
    "panda": (
        modified(
            (0.333, 0, 0), (0, 0, -PI / 2), (0.316, 0, PI / 2), (0, 0.0825, PI / 2), (0.384, -0.0825, -PI / 2), (0, 0, PI / 2), (0, 0.088, PI / 2)
        ),
        z(0, 0.107),
    ),
    "iiwa": (
        urdf(
            ([0, 0, 0.36], (0, 0, 0)),
            ([0, 0, 0], (PI / 2, 0, PI)),
            ([0, 0.42, 0], (PI / 2, 0, PI)),
            ([0, 0, 0], (PI / 2, 0, 0)),
            ([0, 0.4, 0], (-PI / 2, PI, 0)),
            ([0, 0, 0], (PI / 2, 0, 0)),
            ([0, 0, 0], (-PI / 2, PI, 0)),
        ),
        z(0, 0.126),
    ),
}


@pytest.mark.parametrize("name", ROBOTS)
def test_pinocchio(name):
    joints, tool = ROBOTS[name]
    model, parent, before = pin.Model(), 0, pin.SE3.Identity()
    for i, (placement, joint, after) in enumerate(joints):
        parent = model.addJoint(parent, joint, before * placement, f"q{i + 1}")
        before = after
    frame = model.addFrame(pin.Frame("tool", parent, 0, before * tool, pin.FrameType.OP_FRAME))
    data = model.createData()

    machine = abbe.load(name)
    lower, upper = np.clip(np.array(machine.limits).T, -10, 1e4)
    size = 1000.0 if machine.length == "mm" else 1.0
    for q in np.random.default_rng(0).uniform(lower, upper, (200, model.nq)):
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        pose = data.oMf[frame].homogeneous
        jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        assert np.abs(machine.pose(q) - pose).max() < 1e-12 * size
        assert np.abs(machine.joint_jacobian(q) - jacobian).max() < 1e-12 * size
