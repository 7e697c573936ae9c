"""UR5 by FIGAROH: python fit.py GRID.csv RANDOM.csv; the URDF, the files in FIGAROH's layout and its settings are beside it."""
import os
import sys
import tempfile
import shutil

import numpy as np
import pandas as pd

DH = [(89.16, 0, 90), (0, -425, 0), (0, -392.25, 0), (109.15, 0, 90), (94.56, 0, -90), (113.3, 0, 0)]
POINT = 1e-3 if "mm" not in sys.argv else 1.0  # FIGAROH computes in metres
ANGLE = np.pi / 180 if "rad" not in sys.argv else 1.0


def urdf():
    parts, (d, a, alpha) = ['<robot name="ur5"><link name="base"/>'], (0, 0, 0)
    names = [f"link{i}" for i in range(1, 7)] + ["target"]
    for i, name in enumerate(names):
        kind = "revolute" if i < 6 else "fixed"
        limit = '<axis xyz="0 0 1"/><limit lower="-6.3" upper="6.3" effort="1" velocity="1"/>' if i < 6 else ""
        parent = "base" if i == 0 else names[i - 1]
        parts.append(
            f'<link name="{name}"/><joint name="joint_{i + 1}" type="{kind}"><parent link="{parent}"/><child link="{name}"/>'
            f'<origin xyz="{a / 1e3} 0 {d / 1e3}" rpy="{np.radians(alpha)} 0 0"/>{limit}</joint>'
        )
        d, a, alpha = DH[min(i, 5)]
    return "".join(parts) + "</robot>"


def converted(path, name):
    data = pd.read_csv(path)
    table = {f"{axis}1": (data[f"{axis}_t"] - data[f"{axis}_dif"]) * POINT for axis in "xyz"}
    table |= {f"joint_{i}": data[f"joint_{i}"] * ANGLE for i in range(1, 7)}
    pd.DataFrame(table).to_csv(name, index=False)


grid, random = map(os.path.abspath, sys.argv[1:3])
settings = os.path.join(os.path.dirname(os.path.abspath(__file__)), "fit.yaml")
os.chdir(tempfile.mkdtemp())
shutil.copy(settings, "fit.yaml")
converted(grid, "grid.csv")
converted(random, "random.csv")
with open("ur5.urdf", "w") as file:
    file.write(urdf())

from figaroh.calibration.base_calibration import BaseCalibration
from figaroh.calibration.calibration_tools import calc_updated_fkm
from figaroh.calibration.data_loader import load_data
from figaroh.tools.robot import Robot


class Ur5(BaseCalibration):
    def cost_function(self, var):
        estimated = calc_updated_fkm(self.model, self.data, var, self.q_measured, self.calib_config)
        return self.apply_measurement_weighting(self._compute_logmap_residuals(self.PEE_measured, estimated))


fit = Ur5(Robot("ur5.urdf", "."), "fit.yaml")
fit.calib_config.update(known_baseframe=False, known_tipframe=False)
fit.initialize()
fit.solve()
settings = dict(fit.calib_config)
measured, q = load_data("random.csv", fit.model, settings)
estimated = calc_updated_fkm(fit.model, fit.data, fit.LM_result.x, q, settings)
print("POINTS", *(estimated.reshape(3, -1).T / POINT).ravel())
