import numpy as np
import roboticstoolbox as rtb

DH = [(89.16, 0, np.pi / 2), (0, -425, 0), (0, -392.25, 0), (109.15, 0, np.pi / 2), (94.56, 0, -np.pi / 2), (113.3, 0, 0)]
robot = rtb.DHRobot([rtb.RevoluteDH(d=d, a=a, alpha=alpha) for d, a, alpha in DH])


def pose(q):
    return robot.fkine(q).A


def joint_jacobian(q):
    return np.array([robot.jacob0(each) for each in q]) if q.ndim > 1 else robot.jacob0(q)
