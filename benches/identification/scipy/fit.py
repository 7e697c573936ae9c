"""UR5 by SciPy's least squares and a chain written by hand: python fit.py GRID.csv RANDOM.csv"""
import sys

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

POINT = 1.0 if "mm" not in sys.argv else 1e3  # the chain is in millimetres: as if in metres
ANGLE = np.pi / 180 if "rad" not in sys.argv else 1.0
DH = np.array([[89.16, 0, 90], [0, -425, 0], [0, -392.25, 0], [109.15, 0, 90], [94.56, 0, -90], [113.3, 0, 0]])
DH[:, 2] = np.radians(DH[:, 2])


def read(path):
    data = np.loadtxt(path, delimiter=",", skiprows=1)
    return data[:, 7:] * ANGLE, (data[:, 1:4] - data[:, 4:7]) * POINT


def points(x, q):
    """A_i = Rz Tz Tx Rx, and Ry of the second joint, whose axis is parallel to the third; base; target."""
    errors, beta, base, target = x[:24].reshape(6, 4), x[24], x[25:31], x[31:]
    at = np.tile(target, (len(q), 1))
    for i in reversed(range(6)):
        d, a, alpha = DH[i] + errors[i, :3]
        at = Rotation.from_euler("x", alpha).apply(at)
        if i == 1:
            at = Rotation.from_euler("y", beta).apply(at)
        at = Rotation.from_euler("z", q[:, [i]] + errors[i, 3]).apply(at + [a, 0, d])
    return Rotation.from_rotvec(base[3:]).apply(at) + base[:3]


q, measured = read(sys.argv[1])
result = least_squares(lambda x: (points(x, q) - measured).ravel(), np.zeros(34), method="lm", x_scale="jac")
print(result.message, f"cost {result.cost:.6g}, {result.nfev} evaluations")
q, measured = read(sys.argv[2])
print("POINTS", *(points(result.x, q) / POINT).ravel())
