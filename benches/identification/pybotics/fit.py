"""UR5 by pybotics, as its examples calibrate: python fit.py GRID.csv RANDOM.csv"""
import sys

import numpy as np
from pybotics.optimization import OptimizationHandler, optimize_accuracy
from pybotics.robot import Robot
from scipy.optimize import least_squares

POINT = 1.0 if "mm" not in sys.argv else 1e3  # the chain is in millimetres: as if in metres
ANGLE = np.pi / 180 if "rad" not in sys.argv else 1.0
# Modified Denavit-Hartenberg: alpha, a, theta, d.
HALF = np.pi / 2
CHAIN = [[0, 0, 0, 89.16], [HALF, 0, 0, 0], [0, -425, 0, 0], [0, -392.25, 0, 109.15], [HALF, 0, 0, 94.56], [-HALF, 0, 0, 113.3]]


def read(path):
    data = np.loadtxt(path, delimiter=",", skiprows=1)
    return data[:, 7:] * ANGLE, (data[:, 1:4] - data[:, 4:7]) * POINT


handler = OptimizationHandler(
    Robot.from_parameters(np.array(CHAIN, dtype=float)),
    kinematic_chain_mask=True,
    tool_mask=[True, True, True, False, False, False],
    world_mask=True,
)
q, points = read(sys.argv[1])
result = least_squares(optimize_accuracy, handler.generate_optimization_vector(), args=(handler, q, points), verbose=1)
handler.apply_optimization_vector(result.x)
points = [handler.robot.fk(joints)[:3, 3] / POINT for joints in read(sys.argv[2])[0]]
print("POINTS", *np.ravel(points))
