# The compiled part: written by hand, held against the module by mypy's stubtest.
from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, TypeAlias, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._fields import Figure

__all__ = ["Commands", "Machine", "Part", "Report", "SpecError", "Table", "__version__", "_part", "_restore", "import_dh", "import_urdf", "load", "merge", "shipped"]

__version__: str

_Array: TypeAlias = NDArray[np.float64]
# An array, or a table with columns named as the joint variables: a mapping, a frame of pandas or polars, a table of pyarrow.
_Joints: TypeAlias = ArrayLike | Mapping[str, ArrayLike] | Any
# A number in coherent units, text with a unit, or a value for each configuration.
_Input: TypeAlias = float | str | ArrayLike

# Called with how many are done, and of how many.
_Progress: TypeAlias = Callable[[int, int], object]
_Path: TypeAlias = str | PathLike[str]
# The path of a CSV file, or a table with columns that a map names.
_Measured: TypeAlias = _Path | Mapping[str, ArrayLike] | Any
# A number in the length unit of the spec, or text with a unit.
_Length: TypeAlias = float | str

class SpecError(ValueError):
    file: str
    line: int | None
    column: int | None
    help: str | None

@final
class Machine:
    @property
    def name(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def length(self) -> str: ...
    @property
    def orientation(self) -> str: ...
    @property
    def rows(self) -> tuple[str, ...]: ...
    @property
    def columns(self) -> tuple[str, ...]: ...
    @property
    def variables(self) -> tuple[str, ...]: ...
    @property
    def limits(self) -> list[tuple[float, float]]: ...
    @property
    def home(self) -> list[float]: ...
    @property
    def frames(self) -> tuple[str, ...]: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def inputs(self) -> dict[str, float]: ...
    @property
    def sources(self) -> tuple[str, ...]: ...
    def with_parameters(self, **values: float | str) -> Machine: ...
    def enable(self, *sources: str) -> Machine: ...
    def disable(self, *sources: str) -> Machine: ...
    def pose(self, q: _Joints, *, out: _Array | None = None) -> _Array: ...
    def transforms(self, q: _Joints, *, out: _Array | None = None) -> _Array: ...
    def error_jacobian(self, q: _Joints, *, out: _Array | None = None) -> _Array: ...
    def joint_jacobian(self, q: _Joints, *, out: _Array | None = None) -> _Array: ...
    def parameter_jacobian(self, q: _Joints, *, out: _Array | None = None) -> _Array: ...
    def displacement(self, q: _Joints, errors: ArrayLike, *, out: _Array | None = None) -> _Array: ...
    def covariance(self, q: _Joints, sigma: ArrayLike, *, out: _Array | None = None) -> _Array: ...
    def generalized_errors(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array: ...
    def predict(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array: ...
    def source_displacements(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array: ...
    def real_pose(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array: ...
    def inverse(self, target: ArrayLike, q0: _Joints | None = None) -> _Array: ...
    def compensate(
        self, q: _Joints, *, tolerance: _Length | None = None, progress: _Progress | None = None, **inputs: _Input
    ) -> Commands: ...
    def check(self) -> Report: ...
    @overload
    def analyze(
        self,
        study: _Path | None = None,
        *,
        study_text: str | None = None,
        monte_carlo: int = 0,
        seed: int | None = None,
        figures: bool = True,
        shard: None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Report: ...
    @overload
    def analyze(
        self,
        study: _Path | None = None,
        *,
        study_text: str | None = None,
        monte_carlo: int = 0,
        seed: int | None = None,
        figures: bool = True,
        shard: tuple[int, int],
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Part: ...
    def bound(
        self,
        study: _Path | None = None,
        *,
        study_text: str | None = None,
        gap: float = 0.01,
        least: bool = False,
        boxes: int = 300_000,
        time: float | None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Report: ...
    def measure(self, data: _Measured, map: _Path, *, new_station: bool = False, accept: str | None = None) -> Report: ...
    def identify(
        self,
        data: _Measured,
        map: _Path,
        *,
        test: _Measured | None = None,
        terms: str | Sequence[str] | None = None,
        robust: str | None = None,
        prior: float | str | None = None,
        folds: int = 10,
        time: float | None = None,
        resample: int | None = None,
        accept: str | None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Report: ...
    def plan(
        self,
        map: _Path,
        *,
        sets: _Path | None = None,
        count: int = 50,
        criterion: str = "v",
        candidates: int = 500,
        model_error: _Length | None = None,
        study: _Path | None = None,
        seed: int | None = None,
        progress: _Progress | None = None,
    ) -> Report: ...
    def simulate(
        self,
        map: _Path,
        *,
        data: _Measured | None = None,
        samples: int = 100,
        noise: _Length | None = None,
        outliers: float = 0.0,
        random: bool = False,
        seed: int = 0,
    ) -> Report: ...
    def monitor(
        self,
        data: _Measured | Sequence[_Measured],
        map: _Path,
        *,
        tolerance: _Length | None = None,
        since: str | None = None,
        false_alarm: int = 365,
    ) -> Report: ...
    def doctor(self, data: _Measured | _Joints, seen: ArrayLike | None = None, *, within: _Length | None = None) -> Report: ...
    def export(
        self,
        to: str,
        *,
        urdf: _Path | None = None,
        base: str | None = None,
        tip: str | None = None,
        nodes: int | None = None,
        samples: int = 1000,
        seed: int = 0,
    ) -> Report: ...
    def generate(self, language: str = "rust", *, real: str | None = None) -> str: ...
    def __reduce__(self) -> tuple[Any, tuple[str, str | None, list[tuple[str, str]]]]: ...

@final
class Commands:
    @property
    def q(self) -> _Array: ...
    @property
    def left(self) -> _Array: ...
    @property
    def reason(self) -> str | None | list[str | None]: ...

@final
class Report:
    @property
    def notes(self) -> list[str]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def to_json(self) -> str: ...
    def report(self, folder: _Path, *, overwrite: bool = False) -> list[str]: ...
    def load(self) -> Machine: ...
    def figures(self) -> dict[str, Figure]: ...
    def figure(self, name: str) -> Figure: ...
    def tables(self) -> list[str]: ...
    def table(self, name: str) -> Table: ...
    def __getattr__(self, name: str) -> Any: ...
    def __dir__(self) -> list[str]: ...
    def _repr_html_(self) -> str | None: ...

@final
class Part:
    @staticmethod
    def load(file: _Path) -> Part: ...
    def save(self, file: _Path) -> None: ...
    @property
    def shard(self) -> tuple[int, int]: ...
    @property
    def configurations(self) -> int: ...
    @property
    def unreachable(self) -> int: ...
    def __reduce__(self) -> tuple[Any, tuple[bytes]]: ...

@final
class Table:
    @property
    def columns(self) -> tuple[str, ...]: ...
    def to_dict(self) -> dict[str, list[Any]]: ...
    def __len__(self) -> int: ...
    def __arrow_c_schema__(self) -> object: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...
    def _repr_html_(self) -> str: ...

def import_dh(
    table: _Path | Mapping[str, ArrayLike] | Any | None = None,
    *,
    convention: str,
    text: str | None = None,
    units: str | None = None,
    round_angles: bool = False,
) -> Report: ...
def import_urdf(
    file: _Path | None = None,
    *,
    text: str | None = None,
    base: str | None = None,
    tip: str | None = None,
    fold: bool = False,
    round_angles: bool = False,
) -> Report: ...
def load(spec: str | PathLike[str] | None = None, *, text: str | None = None) -> Machine: ...
def merge(
    parts: Iterable[Part | _Path], *, threads: int | None = None, progress: _Progress | None = None
) -> Report: ...
def shipped() -> list[str]: ...
def _part(bytes: bytes) -> Part: ...
def _restore(origin: str, text: str | None, changes: list[tuple[str, str]]) -> Machine: ...
