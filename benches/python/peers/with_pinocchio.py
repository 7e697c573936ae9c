import numpy as np
import pinocchio as pin

DH = [(89.16, 0, np.pi / 2), (0, -425, 0), (0, -392.25, 0), (109.15, 0, np.pi / 2), (94.56, 0, -np.pi / 2), (113.3, 0, 0)]


def after(d, a, alpha):
    return pin.SE3(pin.utils.rotate("x", alpha), np.array([a, 0, d]))


model, parent, before = pin.Model(), 0, pin.SE3.Identity()
for i, row in enumerate(DH):
    parent, before = model.addJoint(parent, pin.JointModelRZ(), before, f"q{i + 1}"), after(*row)
tool = model.addFrame(pin.Frame("tool", parent, 0, before, pin.FrameType.OP_FRAME))
data = model.createData()


def pose_of_one(q):
    pin.forwardKinematics(model, data, q)
    return pin.updateFramePlacement(model, data, tool).homogeneous


def joint_jacobian_of_one(q):
    return pin.computeFrameJacobian(model, data, q, tool, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)


def pose(q):
    return np.array([pose_of_one(each) for each in q]) if q.ndim > 1 else pose_of_one(q)


def joint_jacobian(q):
    return np.array([joint_jacobian_of_one(each) for each in q]) if q.ndim > 1 else joint_jacobian_of_one(q)


# After every frame a fixed joint with six degrees of freedom: its columns are the errors of the frame.
loose, parent, before = pin.Model(), 0, pin.SE3.Identity()
for i, row in enumerate(DH):
    parent = loose.addJoint(parent, pin.JointModelRZ(), before, f"q{i + 1}")
    parent, before = loose.addJoint(parent, pin.JointModelFreeFlyer(), after(*row), f"e{i + 1}"), pin.SE3.Identity()
end = loose.addFrame(pin.Frame("tool", parent, 0, before, pin.FrameType.OP_FRAME))
loose_data, still = loose.createData(), pin.neutral(loose)
joints = list(loose.joints)[1:]
turns = [joint.idx_q for joint in joints if joint.nq == 1]
# Spin about Y, roll about Z, pitch about X.
errors = [joint.idx_v + k for joint in joints if joint.nv == 6 for k in (0, 1, 2, 4, 5, 3)]


def error_jacobian_of_one(q):
    still[turns] = q
    return pin.computeFrameJacobian(loose, loose_data, still, end, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)[:, errors]


def error_jacobian(q):
    return np.array([error_jacobian_of_one(each) for each in q]) if q.ndim > 1 else error_jacobian_of_one(q)
