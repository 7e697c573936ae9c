"""abbe: predict, rank, measure, identify and compensate the errors of a manipulator from its spec.

>>> import abbe
>>> ur5 = abbe.load("ur5")              # a shipped name or the path of a spec file
>>> ur5.error_jacobian(ur5.home).shape  # six rows, six columns per frame
(6, 36)

Lengths are in the unit of the spec, angles in rad, everything in the base frame F_0. Matrices are row-major, as usual in NumPy.
"""

from ._abbe import Machine, Part, Report, SpecError, Table, __version__, import_dh, import_urdf, load, merge, positioning, shipped
from ._fields import Commands

__all__ = ["Commands", "Machine", "Part", "Report", "SpecError", "Table", "__version__", "import_dh", "import_urdf", "load", "merge", "positioning", "shipped"]
