"""Robot descriptions of the package example-robot-data."""

import os
import site

import pytest

# Package, base and tip of each file. Some files have a slide, wheels, grippers or second arms besides the chain.
ROBOTS = {
    "ur5": ("ur_description/urdf/ur5_robot.urdf", "base_link", "tool0"),
    "ur10": ("ur_description/urdf/ur10_robot.urdf", "base_link", "tool0"),
    "panda": ("panda_description/urdf/panda.urdf", "panda_link0", "panda_hand"),
    "kinova": ("kinova_description/robots/kinova.urdf", None, "j2s6s200_end_effector"),
    "tiago": ("tiago_description/robots/tiago.urdf", "base_footprint", "arm_tool_link"),
    "xarm7": ("xarm_description/urdf/xarm7.urdf", "link_base", "link7"),
    "z1": ("z1_description/urdf/z1.urdf", None, "gripperStator"),
    "baxter": ("baxter_description/urdf/baxter.urdf", "base", "left_gripper"),
}


def described(path):
    """Return the path of a file of example-robot-data. Skip the test without the package."""
    for base in site.getsitepackages():
        folder = os.path.join(base, "cmeel.prefix/share/example-robot-data/robots")
        if os.path.isdir(folder):
            return os.path.join(folder, path)
    pytest.skip("example-robot-data (pip install example-robot-data) is not installed")
