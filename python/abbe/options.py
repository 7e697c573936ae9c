"""Names that options accept, for editors and type checkers."""

# Generated from the options of the jobs: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`.
from typing import Literal, TypeAlias

Convention: TypeAlias = Literal["standard", "modified"]
Criterion: TypeAlias = Literal["v", "d"]
Format: TypeAlias = Literal["dh", "urdf", "ur-calibration", "isg-csv", "kinematics-comp", "linuxcnc", "linuxcnc-matrixkins", "linuxcnc-genhexkins", "table"]
Language: TypeAlias = Literal["rust", "c", "js", "python", "matlab", "st", "plcopen", "fmu"]
Real: TypeAlias = Literal["double", "float"]
Robust: TypeAlias = Literal["none", "huber", "tukey"]
Terms: TypeAlias = Literal["auto", "joint", "load", "elastic", "backlash", "product", "drift", "profile"]
