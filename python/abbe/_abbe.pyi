# Stubs of the compiled part: signatures written by hand, checked against the module by mypy's stubtest; docstrings are those of the
# module, written by `UPDATE_EXPECT=1 python -m pytest python/tests/test_stubs.py`.
from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypeAlias, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import options
from ._fields import Commands, Fields, Figure, Page
from .spec import Manipulator, Source
from .reports import (
    AllocateReport,
    AnalyzeReport,
    BoundReport,
    CheckReport,
    DoctorReport,
    ExportReport,
    IdentifyReport,
    ImportReport,
    MeasureReport,
    MonitorReport,
    PlanReport,
    PositioningReport,
    SimulateReport,
)

__all__ = ["Machine", "Part", "Report", "SpecError", "Table", "__version__", "_part", "_report", "_restore", "_table", "import_dh", "import_urdf", "load", "merge", "positioning", "shipped"]

__version__: str

_Array: TypeAlias = NDArray[np.float64]
# An array, or a table with columns named as the joint variables: a mapping, a pandas or polars frame, a pyarrow table.
_Joints: TypeAlias = ArrayLike | Mapping[str, ArrayLike] | Fields | Any
# A number in coherent units, text with a unit, or one value per configuration.
_Input: TypeAlias = float | str | ArrayLike

# Called with the number of finished steps and their total number.
_Progress: TypeAlias = Callable[[int, int], object]
_Path: TypeAlias = str | PathLike[str]
# The path of a CSV file, or a table with the columns of a map.
_Measured: TypeAlias = _Path | Mapping[str, ArrayLike] | Any
# The path of a study, or a study as a dict.
_Study: TypeAlias = _Path | Mapping[str, Any]
# The path of a map, a shipped name, a map as a dict, or its text.
_Map: TypeAlias = _Path | Mapping[str, Any]
# A number in the length unit of the spec, or text with a unit.
_Length: TypeAlias = float | str

class SpecError(ValueError):
    """A mistake in a spec, a study, a map, data or an option, as rustc would show it.

    ``str(error)`` is the whole text. ``file`` names the file or option; ``line`` and ``column`` count from 1 and are None if the mistake is about the file as a whole; ``help`` is the way out, if there is one. They are those of the first mistake.
    """
    file: str
    line: int | None
    column: int | None
    help: str | None

@final
class Machine:
    """Manipulator, read from a spec and ready to be evaluated. Immutable: methods that change it
    return another machine.

    Lengths are in the unit of the spec (`length`), angles in rad, everything in the base frame F_0.
    `q` has one number per joint variable in the order of `variables`, or is a table with columns of
    these names. Leading dimensions, written as …, are those of the result.
    """
    @property
    def name(self) -> str:
        """Name of the manipulator."""
    @property
    def text(self) -> str:
        """Text of the spec with the changes of `with_parameters`, `enable`, `disable` and `scale`, as
        `abbe.load(text=…)` reads it. Raises ValueError if the text has no place for a change.

        >>> import abbe
        >>> changed = abbe.load("pps").with_parameters(x="25 cm").disable("assembly")
        >>> abbe.load(text=changed.text).parameters["x"]
        250.0
        """
    def with_source(self, source: Source | Mapping[str, Any]) -> Machine:
        """Returns a machine with one more error source: an `abbe.spec.Source`, or a dict of its keys.

        >>> import abbe
        >>> bent = {"name": "bent", "class": "repeatable", "frame": "elbow", "e_z": "0.1 mm"}
        >>> abbe.load("ur5").with_source(bent).sources[-1]
        'bent'
        """
    @property
    def title(self) -> str:
        """Title of the manipulator."""
    @property
    def length(self) -> str:
        """Unit of every length: "mm" or "m"."""
    @property
    def orientation(self) -> str:
        """Representation of orientations in rows 4 to 6: "rotation-vector", "euler-yzx" or
        "iec-61217".
        """
    @property
    def rows(self) -> tuple[str, ...]:
        """Names of the six rows of displacements and Jacobians."""
    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the 6n columns of the error Jacobian: e_x1 e_y1 e_z1 e_s1 e_r1 e_p1, then those of
        frame 2 …
        """
    @property
    def variables(self) -> tuple[str, ...]:
        """Names of the joint variables, in the order of q."""
    @property
    def passive_variables(self) -> tuple[str, ...]:
        """Names of the passive variables, which loops determine, in the order of `passive`."""
    @property
    def limits(self) -> list[tuple[float, float]]:
        """Lower and upper limit of each joint variable in the length unit or rad; infinite if the spec
        has none.
        """
    @property
    def home(self) -> list[float]:
        """Home configuration, in the length unit and rad."""
    @property
    def frames(self) -> tuple[str, ...]:
        """Names of the frames F_1 … F_n."""
    @property
    def parameters(self) -> dict[str, float]:
        """Structural parameters by name, in coherent units (`units`): the length unit, kg, s, rad, K."""
    @property
    def inputs(self) -> dict[str, float]:
        """Nominal inputs by name, in coherent units (`units`)."""
    @property
    def units(self) -> dict[str, str]:
        """Units of `parameters` and `inputs` by name: "mm", "kg", "mm*kg/s^2" …; "" for pure numbers
        and for angles, which are in rad.

        >>> import abbe
        >>> abbe.load("pps").units["x"]
        'mm'
        """
    @property
    def sources(self) -> tuple[str, ...]:
        """Names of the enabled error sources, in the order of `source_displacements`."""
    def with_parameters(self, **values: float | str) -> Machine:
        """Returns a machine with other nominal values of parameters and inputs: numbers in coherent
        units, or text with a unit.

        >>> import abbe
        >>> abbe.load("pps").with_parameters(x=250, y="25 cm").parameters["y"]
        250.0
        """
    def enable(self, *sources: str) -> Machine:
        """Returns a machine with these error sources enabled."""
    def disable(self, *sources: str) -> Machine:
        """Returns a machine with these error sources disabled."""
    def scale(self, source: str, factor: float) -> Machine:
        """Returns a machine with the errors of this source multiplied by `factor`, which is not
        negative.
        """
    def pose(self, q: _Joints, *, out: _Array | None = None) -> _Array:
        """(…, 4, 4): nominal pose of the tool in F_0, as rows and columns of a homogeneous matrix.
        Column 3 is the tool point, in the length unit.

        >>> import abbe
        >>> pps = abbe.load("pps")
        >>> pps.pose(pps.home)[:3, 3]
        array([1128., 1626., 1568.])
        """
    def transforms(self, q: _Joints, *, out: _Array | None = None) -> _Array:
        """(…, n + 1, 4, 4): transforms A_1 … A_n and the tool T, with lengths in the length unit.

        A_1 maps coordinates in F_1 to F_0, A_i those in F_i to F_{i-1}, and T those of the tool
        to F_n. Rows and columns as for `pose`.
        """
    def error_jacobian(self, q: _Joints, *, out: _Array | None = None) -> _Array:
        """(…, 6, 6n): error Jacobian J_e = ∂X_T/∂ε in F_0.

        Rows: x, y, z of the tool point in the length unit, then three rows of its orientation
        in rad (`rows`). Columns: e_x e_y e_z (length unit) e_s e_r e_p (rad; about Y, Z, X) of
        frame 1, then of frame 2 … (`columns`). If the orientation rows are Euler angles, their
        singularities raise ValueError.

        >>> import abbe
        >>> pps = abbe.load("pps")
        >>> jacobian = pps.error_jacobian(pps.home)
        >>> jacobian.shape, float(jacobian[0, pps.columns.index("e_s1")])
        ((6, 36), 1568.0)
        """
    def joint_jacobian(self, q: _Joints, *, out: _Array | None = None) -> _Array:
        """(…, 6, nq): joint Jacobian J_q = ∂X_T/∂q in F_0.

        Rows as for `error_jacobian`. Columns: one per joint variable, per rad or
        per length unit.
        """
    def parameter_jacobian(self, q: _Joints, *, out: _Array | None = None) -> _Array:
        """(…, 6, ns): parameter Jacobian ∂X_T/∂s in F_0.

        Rows as for `error_jacobian`. Columns: one per structural parameter in the order of
        `parameters`, per coherent unit.
        """
    def parameter_derivatives(
        self, q: _Joints, of: Literal["predict", "error_jacobian"] = "predict", **inputs: _Input
    ) -> _Array:
        """(…, ns, 6) or (…, ns, 6, 6n): derivatives of ΔX or of J_e by the structural parameters, in
        the order of `parameters`.

        `of`: "predict" for ΔX by the repeatable sources, or "error_jacobian"; units are those of
        that function per coherent unit of the parameter. The derivatives are exact; the first call
        takes some milliseconds to find them. `inputs`: as for `generalized_errors`. Loops stay
        closed.

        >>> import abbe
        >>> pps = abbe.load("pps")
        >>> pps.parameter_derivatives(pps.home).shape == (len(pps.parameters), 6)
        True
        """
    def passive(self, q: _Joints, *, out: _Array | None = None) -> _Array:
        """(…, np): values of the passive variables for which all loops close, reached continuously
        from home, in the length unit and rad.

        One for each passive variable, in the order of the frames that declare them.
        Configurations where the loops do not close raise ValueError, and so does a machine
        without loops.
        """
    def displacement(self, q: _Joints, errors: ArrayLike, *, out: _Array | None = None) -> _Array:
        """(…, 6): displacement ΔX = J_e ε in F_0 for given errors ε, real minus ideal.

        `errors`: (6n,) for all configurations or (…, 6n), in the order of `columns`, or (…, n,
        6) as `generalized_errors` returns them. Rows as for `error_jacobian`, in the
        length unit and rad.
        """
    def displaced_pose(self, q: _Joints, errors: ArrayLike, *, out: _Array | None = None) -> _Array:
        """(…, 4, 4): exact pose of the tool in F_0 with given errors ε of the frames: by the chain
        A_1 E_1 … A_n E_n T, with all loops closed.

        `errors`: as for `displacement`. Rows, columns and units as for `pose`.
        """
    def covariance(self, q: _Joints, sigma: ArrayLike, *, out: _Array | None = None) -> _Array:
        """(…, 6, 6): covariance J_e diag(σ²) J_eᵀ of ΔX in F_0 for independent errors.

        `sigma`: standard deviation of every error, (6n,) or (…, 6n), in the order and units of
        `columns`, not negative. Rows and columns as the rows of `error_jacobian`, in products
        of their units.
        """
    def leg_forces(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array:
        """(…, np): forces that close the loops under the loads, to first order, in units N and
        N·m.

        One for each equation of the loops, in their order; that of a leg is positive if it
        presses its ends apart. `inputs`: as for `generalized_errors`. Configurations where the
        loops do not close raise ValueError, and so does a machine without loops.
        """
    def generalized_errors(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array:
        """(…, n, 6): errors ε of the repeatable sources of the spec: for each frame F_i, in its
        axes, e_x e_y e_z (length unit) e_s e_r e_p (rad).

        `inputs`: inputs of the spec by name, each a number in coherent units, text with a unit,
        or an array with one value per configuration; by default the column of that name if `q`
        is a table, or else nominal. The same holds for all functions with inputs.
        """
    def predict(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array:
        """(…, 6): displacement ΔX in F_0 by the repeatable sources of the spec, to first order,
        real minus ideal.

        Rows as for `error_jacobian`, in the length unit and rad. `inputs`: as for
        `generalized_errors`.
        """
    def source_displacements(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array:
        """(…, S, 6): displacement ΔX in F_0 by each source of `sources` alone; for a random
        source, by its magnitude.

        Columns as the rows of `error_jacobian`, in the length unit and rad. `inputs`: as for
        `generalized_errors`.
        """
    def real_pose(self, q: _Joints, *, out: _Array | None = None, **inputs: _Input) -> _Array:
        """(…, 4, 4): pose of the tool in F_0 with the errors of the repeatable sources, by the
        exact chain A_1 E_1 … A_n E_n T.

        Rows, columns and units as for `pose`. `inputs`: as for `generalized_errors`.
        """
    def inverse(self, target: ArrayLike, q0: _Joints | None = None) -> _Array:
        """(…, nq): joints, within their limits, at which the ideal tool reaches `target` in F_0.

        `target`: poses (…, 4, 4) or tool points (…, 3), in the length unit. `q0`: start of each
        search, home by default. Of one target, raises ValueError, with the reason, if no solution
        is found; of several, its row is NaN, and a warning has their number.

        >>> import abbe
        >>> ur5 = abbe.load("ur5")
        >>> q = ur5.inverse(ur5.pose([0.1, -1, 1, 0.2, 0.3, 0]), ur5.home)
        >>> bool(abs(ur5.pose(q) - ur5.pose([0.1, -1, 1, 0.2, 0.3, 0])).max() < 1e-6)
        True
        """
    def inverses(self, target: ArrayLike, q0: _Joints | None = None) -> _Array:
        """(…, m, nq): all joints, within their limits, at which the ideal tool has the pose `target`
        in F_0, those nearest to `q0` first; of several targets, rows beyond the solutions of one
        are NaN.

        `target`, `q0`: as for `inverse`, but of poses. Revolute joints have the full turn
        nearest to `q0`, and joints that are free to move there stay as in `q0`. Arms with a
        spherical wrist, of whose other axes two neighbours intersect or are parallel, arms with
        three parallel axes, gantries with three revolute joints, and platforms on legs are solved
        in closed form; of others, solutions may be missing. Without any, as `inverse`.

        >>> import abbe
        >>> ur5 = abbe.load("ur5")
        >>> ur5.inverses(ur5.pose([0.1, -1, 1, 0.2, 0.3, 0])).shape
        (8, 6)
        """
    def tool_covariance(self, q: _Joints, **inputs: _Input) -> _Array:
        """(…, 3, 3): covariance of the tool point in F_0 of an identified machine: by the covariance
        of what was identified, and by the random sources of the spec. Squares of the length unit.

        `inputs`: as for `generalized_errors`. A machine whose spec has no covariance raises
        ValueError.

        >>> import abbe
        >>> ur5 = abbe.load("ur5")
        >>> found = ur5.identify(ur5.simulate("ur5", samples=60, seed=1).table("rows"), "ur5").load()
        >>> found.tool_covariance([found.home, found.home]).shape
        (2, 3, 3)
        """
    def compensate(
        self,
        q: _Joints,
        *,
        tolerance: _Length | None = None,
        weight: _Length | None = None,
        progress: _Progress | None = None,
        **inputs: _Input,
    ) -> Commands:
        """Computes joint commands at which the real tool has the ideal pose of `q`. Returns Commands.

        `tolerance`: largest error allowed to remain at the tool point, in the length unit or as
        text with a unit; 1 rad counts as 1 m; "0.001mm" by default. `weight`: length that weighs as
        much as 1 rad where both cannot be reached; without it the position has priority. `inputs`:
        as for `generalized_errors`. `progress(done, total)` is called at intervals. Commands beyond
        the joint limits raise ValueError.
        """
    def check(self) -> CheckReport:
        """Checks the spec, and compares J_e with the exact chain. The report has the model, its chain
        at home and the identifiable errors.

        Fields: `abbe.reports.CheckReport`.

        >>> import abbe
        >>> all(law.holds for law in abbe.load("scara").check().laws)
        True
        """
    @overload
    def analyze(
        self,
        study: _Study | None = None,
        *,
        study_text: str | None = None,
        q: _Joints | None = None,
        tolerance: str | list[str] | None = None,
        monte_carlo: int = 0,
        seed: int | None = None,
        figures: bool = True,
        shard: None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> AnalyzeReport:
        """Computes the errors of every source, and of all sources together, over a workspace, and the
        verdict on the tolerances of the study.

        `study`: path of a study file, or a study as a dict; `study_text`: its text. Without both:
        the study beside the spec, or the study shipped with the manipulator, or joint samples.
        `tolerance`: in place of that of the study, a text such as `"0.3 mm"` or `"0.5 mrad"`, or
        both in a list. `q`: configurations (m, nq) in place of the study's workspace, with nominal
        inputs. `monte_carlo`: number of draws at the worst configuration and at home. `seed`: of
        the draws and of the study's random samples. `figures`: collect data for `.report(folder)`
        and `.figure(name)`.

        `.table("configurations")` has the configurations, the ideal tool point, and its
        displacements by each source. Lengths are in the unit of the spec, angles in rad. Fields:
        `abbe.reports.AnalyzeReport`.

        >>> import abbe
        >>> report = abbe.load("pps").analyze()
        >>> print(f"{report.combined.radius:.3f}")
        5.480

        With `shard=(i, n)`, i from 1 to n, computes part i of n of the workspace and returns a
        Part; `abbe.merge` of all parts is the report.
        """
    @overload
    def analyze(
        self,
        study: _Study | None = None,
        *,
        study_text: str | None = None,
        q: _Joints | None = None,
        tolerance: str | list[str] | None = None,
        monte_carlo: int = 0,
        seed: int | None = None,
        figures: bool = True,
        shard: tuple[int, int],
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> Part:
        """Computes the errors of every source, and of all sources together, over a workspace, and the
        verdict on the tolerances of the study.

        `study`: path of a study file, or a study as a dict; `study_text`: its text. Without both:
        the study beside the spec, or the study shipped with the manipulator, or joint samples.
        `tolerance`: in place of that of the study, a text such as `"0.3 mm"` or `"0.5 mrad"`, or
        both in a list. `q`: configurations (m, nq) in place of the study's workspace, with nominal
        inputs. `monte_carlo`: number of draws at the worst configuration and at home. `seed`: of
        the draws and of the study's random samples. `figures`: collect data for `.report(folder)`
        and `.figure(name)`.

        `.table("configurations")` has the configurations, the ideal tool point, and its
        displacements by each source. Lengths are in the unit of the spec, angles in rad. Fields:
        `abbe.reports.AnalyzeReport`.

        >>> import abbe
        >>> report = abbe.load("pps").analyze()
        >>> print(f"{report.combined.radius:.3f}")
        5.480

        With `shard=(i, n)`, i from 1 to n, computes part i of n of the workspace and returns a
        Part; `abbe.merge` of all parts is the report.
        """
    def explore(self, study: _Study | None = None, *, study_text: str | None = None, height: int = 900) -> Page:
        """Returns a live page of the machine: joints, inputs, parameters and the factor of each source
        can be varied, and it shows the errors there by the generated code. Notebooks show it in a
        frame; `.save(path)` writes it as a file that needs no network.

        `study`, `study_text`: as for `analyze`; the page has the tolerance and some configurations
        of the study. `height`: of the frame in a notebook, in pixels.

        >>> import abbe
        >>> abbe.load("ur5").explore()
        <abbe page: Universal Robots UR5 with a tracker target>
        """
    def allocate(
        self,
        study: _Study | None = None,
        *,
        study_text: str | None = None,
        tolerance: str | list[str] | None = None,
        loosen: bool = False,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> AllocateReport:
        """Allocates the tolerance: factors of the error sources that keep it at least cost.

        `study`, `study_text`, `tolerance`: as for `analyze`; the study also has the costs.
        `loosen`: allow factors above 1.

        `.sources` have the `.factor` of each `.source`. The tolerance is kept by the criterion of
        the study with these factors and with all smaller ones. `.cost` is the sum of the costs,
        `.one_factor_cost` that with the same factor for all, and `.active` has the configurations
        at which the tolerance is reached. `scale` applies a factor to a machine, and `text` is its
        spec.

        Lengths are in the unit of the spec, angles in rad. Fields: `abbe.reports.AllocateReport`.

        >>> import abbe
        >>> report = abbe.load("pps").allocate()
        >>> min((source.factor, source.source) for source in report.sources)[1]
        'assembly'
        """
    def bound(
        self,
        study: _Study | None = None,
        *,
        study_text: str | None = None,
        tolerance: str | list[str] | None = None,
        gap: float = 0.01,
        least: bool = False,
        boxes: int = 300_000,
        time: float | None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> BoundReport:
        """Certifies upper bounds of the errors over a box of joints, parameters and inputs.

        `study`, `study_text`, `tolerance`: as for `analyze`; the box encloses the workspace of the
        study. `gap`: relative gap between the certified bound and the largest error found at which
        the search stops. `boxes`: maximum number of boxes to examine for each error. `time`: time
        limit in seconds. `least`: also certify lower bounds, `.dexterity` and `.stiffness`.

        `.repeatable`, `.random` and `.total`, the worst case of all, have the errors `.norm`, `.x`,
        `.y`, `.z` and `.orientation`. To first order, the true maximum of each lies between
        `.found`, attained at `.at`, and `.certified`, which is None if nothing could be proved.
        `.remainder.certified` bounds the difference between the exact chain and first order for the
        repeatable sources. `.after_one_step.position` and `.orientation` bound what one step of
        compensation leaves. `.margin` and `.orientation_margin` are the differences to the
        tolerances of the study.

        `.dexterity.point` and `.pose` bound the least singular value of `J_q` from below (metres,
        rad). `.stiffness` bounds the ratio of a force at the tool point to its deflection, in N/m;
        None for a rigid machine.

        Lengths are in the unit of the spec, angles in rad, in F_0. Fields:
        `abbe.reports.BoundReport`.

        >>> import abbe
        >>> norm = abbe.load("machine3").bound().repeatable.norm
        >>> f"{norm.found:.3f} <= {norm.certified:.3f}", norm.complete
        ('0.155 <= 0.156', True)
        """
    def measure(self, data: _Measured, map: _Map, *, new_station: bool = False, corrected: bool = False, accept: str | None = None) -> MeasureReport:
        """Evaluates measurements: accuracy and repeatability against the ideal machine, and the
        residuals after its sources.

        `data`: a CSV file, or a table with the columns of the map: a dict of arrays, a pandas or
        polars frame, a pyarrow table; its rows count from 0. Rows that cannot be used are listed in
        `.messages`. `map`: path of the map of the columns, or a shipped name. `new_station`:
        estimate the station of the instrument from the data instead of taking it from the map.
        `corrected`: the rows hold commands that were corrected by this machine's errors. `accept`:
        limits of the machine such as "mean 0.15 mm, max 0.3 mm".

        `.table("rows")` has ΔX of each row, the prediction by the machine with its sources, and
        measured minus predicted; for instruments that read numbers, reading minus prediction and
        prediction.

        `.report(folder)` writes report.html and errors.csv. Fields: `abbe.reports.MeasureReport`.
        """
    def identify(
        self,
        data: _Measured,
        map: _Map,
        *,
        test: _Measured | None = None,
        only: Literal["placement"] | None = None,
        terms: options.Terms | Sequence[options.Terms] | None = None,
        robust: options.Robust | None = None,
        prior: float | Literal["spec", "auto"] | None = None,
        folds: int = 10,
        time: float | None = None,
        resample: int | None = None,
        accept: str | None = None,
        threads: int | None = None,
        progress: _Progress | None = None,
    ) -> IdentifyReport:
        """Identifies the errors of the real machine from measurements, with their uncertainties, and
        validates the result on data that were not fitted.

        `data`, `test`: measurements to fit and to test, CSV files or tables as for `measure`.
        `map`: path of the map of their columns, or a shipped name. `only="placement"`: fit no error
        of the machine, only where machine, instruments and targets are. `terms`: families of
        additional error terms to try: "auto" for all, or one or several of joint, load, elastic,
        backlash, product, drift, profile. `robust`: robust loss, "none", "huber" or "tukey".
        `prior`: prior standard deviation of the errors, relative to the length of the arm and in
        rad: "auto" for 0.001 times a scale that the data choose, a number (0 holds them at zero),
        or "spec"; additional terms have 0.001 at most. `folds`: number of folds of the
        cross-validation. `time`: time limit in seconds for the search for additional terms.
        `resample=b`: repetition b of a bootstrap over configurations (`abbe.fleet.bootstrap` runs
        many). `accept`: limits such as "mean 0.15 mm, max 0.3 mm".

        `.table("rows")` has the residuals of every point in the frame of the instrument, with only
        base and tool fitted ("x before" …) and with the identified model ("x" …). `.covariance` is
        that of the identified errors. `.report(folder)` writes report.html, found.toml and
        found.map.toml; `.load()` returns the identified machine, with the changes of this one.
        Fields: `abbe.reports.IdentifyReport`.
        """
    def plan(
        self,
        map: _Map,
        *,
        sets: _Path | None = None,
        count: int | None = None,
        criterion: options.Criterion = "v",
        candidates: int | _Joints = 500,
        model_error: _Length | None = None,
        study: _Study | None = None,
        seed: int | None = None,
        progress: _Progress | None = None,
    ) -> PlanReport:
        """Plans measurements, and predicts the uncertainty of the tool point after identification.

        `map`: path of the map of the measurements, or a shipped name. `sets`: path of a plan file
        with sets of configurations: `count` of them are chosen, or all are evaluated; without it,
        `count` (50) configurations are chosen from `candidates`: a number of samples, or
        configurations (m, nq) as an array, or a table with columns of joints and inputs.
        `criterion`: "v" for the smallest mean variance of the tool point over the workspace of
        `study`, "d" for the largest determinant of the information matrix. `seed`: of random
        candidates; without it they are evenly distributed. `model_error`: model error at the tool
        point in addition to the noise of the instrument, in the length unit or as text with a unit.

        `.report(folder)` writes plan.csv. Fields: `abbe.reports.PlanReport`.
        """
    def simulate(
        self,
        map: _Map,
        *,
        data: _Measured | None = None,
        samples: int = 100,
        noise: _Length | None = None,
        outliers: float = 0.0,
        random: bool = False,
        seed: int = 0,
    ) -> SimulateReport:
        """Simulates measurements of the machine with the repeatable errors of its sources.

        `map`: path of the map of the columns to write, or a shipped name. `data`: joint commands in
        a CSV file or a table; without it, `samples` random configurations. `noise`: standard
        deviation of each coordinate, in the length unit or as text with a unit; by default the
        uncertainty in the map. `outliers`: fraction of the rows that are outliers. `random`: also
        draw the random sources, independently in every row. `seed`: of configurations, noise,
        outliers and random sources.

        `.report(folder)` writes measurements.csv. Fields: `abbe.reports.SimulateReport`.
        """
    def monitor(
        self,
        data: _Measured | Sequence[_Measured],
        map: _Map,
        *,
        tolerance: _Length | None = None,
        since: str | None = None,
        false_alarm: int = 365,
    ) -> MonitorReport:
        """Detects drift and jumps of a machine with control charts of a few points that are measured
        repeatedly.

        `data`: CSV files or tables in chronological order, or one with a date column. `map`: path
        of the map of the columns, or a shipped name. `tolerance`: allowed displacement of the tool
        point since the first check, in the length unit or as text with a unit. `since`: date of the
        first check to use. `false_alarm`: average number of checks per false alarm, over all
        charts.

        `.report(folder)` writes report.html. Fields: `abbe.reports.MonitorReport`.
        """
    def doctor(self, data: _Measured | _Joints, seen: ArrayLike | None = None, *, within: _Length | None = None) -> DoctorReport:
        """Finds the conventions of measured data: units, signs, order, zeros, Euler angles and more,
        from about ten rows of joints and poses.

        `data`: a CSV file or a table with one column per joint, found by the names of the variables
        or else taken from the first columns, then x, y, z and, optionally, an orientation.
        Alternatively joints alone (m, nq), with `seen`: positions (m, 3), positions and three
        angles (m, 6) or a quaternion (m, 7), matrices (m, 12), (m, 16) or (m, 4, 4). `within`:
        largest position residual of an interpretation that fits, in the length unit or as text with
        a unit.

        `.statements["answer"]` states the result. `.found` lists the interpretations that fit.
        `.map` is the text of the map of the first one, or None; `.report(folder)` writes it as
        doctor.map.toml.
        If the interpretation changes the spec, `.load()` returns the corrected machine, and
        doctor.spec.toml is its spec.

        Residuals are in the length unit and rad. Fields: `abbe.reports.DoctorReport`.

        >>> import abbe, numpy as np
        >>> ur5 = abbe.load("ur5")
        >>> q = np.random.default_rng(0).uniform(-2, 2, (10, 6))
        >>> report = ur5.doctor(np.degrees(q), ur5.pose(q)[:, :3, 3] / 1000)
        >>> found = report.found[0].interpretation
        >>> found.joints_in_degrees, found.lengths_in
        (True, 'm')
        """
    def export(
        self,
        to: options.Format,
        *,
        urdf: _Path | None = None,
        base: str | None = None,
        tip: str | None = None,
        nodes: int | None = None,
        samples: int = 1000,
        seed: int = 0,
    ) -> ExportReport:
        """Exports the repeatable sources of the machine to files that controllers and other programs
        load, and evaluates the errors that remain.

        `to`: "dh", "urdf" (a corrected copy of the file `urdf` of the nominal robot, from its link
        `base` to `tip`; without `urdf` one of the frames, and a file of the loops),
        "ur-calibration", "isg-csv", "kinematics-comp", "linuxcnc", "linuxcnc-matrixkins",
        "linuxcnc-genhexkins" or "table". `nodes`: number of table nodes per
        axis or joint. `samples`, `seed`: number and seed of the random configurations at which the
        remaining errors are evaluated, in the length unit and rad.

        `.files` have `.name` and `.text`; `.report(folder)` writes them. `.left_out` lists what
        the format cannot hold. Raises SpecError if the machine cannot be written in the format.
        Fields: `abbe.reports.ExportReport`.

        >>> import abbe
        >>> machine = abbe.load("machine3").with_parameters(temperature_rise="3 K")
        >>> report = machine.export("isg-csv", nodes=21)
        >>> report.files[0].name, report.remains.position.largest < report.before.position.largest
        ('machine3.volcomp.csv', True)
        """
    def generate(self, language: options.Language = "rust", *, real: options.Real | None = None, only: str | None = None, name: str | None = None) -> str:
        """Returns the closed form as source code in one text.

        `language`: "rust", "c", "js", "python", "matlab", "st" or "plcopen". `real`: floating-point
        type of C, "double" (default) or "float". The text of C is the header followed by the
        source; `generate_files` returns them one by one. The same spec always gives the same text.

        `only`: functions to write, with what they need, separated by commas, for "c", "js",
        "python" and "matlab"; None for all. `name`: name in the code instead of the machine's.
        """
    def generate_files(self, language: options.Language = "rust", *, real: options.Real | None = None, only: str | None = None, name: str | None = None) -> dict[str, str]:
        """Returns the closed form as source files: their names and texts, to be written to one folder.

        Options as for `generate`.

        >>> import abbe
        >>> list(abbe.load("scara").generate_files("c"))
        ['scara.h', 'scara.c']
        """
    def __reduce__(self) -> tuple[Any, tuple[str, str | None, list[tuple[str, str]]]]: ...

class Report:
    """Result of a job. Its fields, also nested ones, have the names of the JSON report and are
    described by its class in `abbe.reports`; `print` shows the answer on one screen, `full()` every
    table.
    """
    @property
    def messages(self) -> list[str]:
        """Notes and warnings of the job, in the order in which it gave them."""
    @property
    def statements(self) -> dict[str, str]:
        """Sentences of the report by their names, which stay: `answer` is the first line of its text."""
    @property
    def covariance(self) -> _Array:
        """(p, p): covariance of the identified errors of the machine, relative to base and target, in
        the length unit and rad. The first column of `table("covariance")` has the names of its rows
        and columns: those of `Machine.columns`, `e_x0` … of the base, and names of sources.
        """
    def to_dict(self) -> dict[str, Any]:
        """Returns all fields as plain dicts, lists, numbers and texts."""
    def full(self) -> str:
        """Returns every table and every sentence as text."""
    def to_json(self) -> str:
        """Returns the JSON report of the command as one line."""
    def report(self, folder: _Path, *, overwrite: bool = False) -> list[str]:
        """Writes pages and figures into a folder, which is made if necessary. Returns the file names.
        Raises FileExistsError if a file exists, unless `overwrite` is true.
        """
    def explore(self, *, height: int = 900) -> Page:
        """Returns the page of the report, which notebooks show in a frame of this height in pixels.
        Its head is a live page of the machine.
        """
    def load(self) -> Machine:
        """Returns the machine that was imported, identified, or corrected by the doctor. Raises
        ValueError if the report has none.
        """
    def figures(self) -> dict[str, Figure]:
        """Returns the figures by name. Notebooks show them; `.svg` is the picture, `.scene` its
        content as plain data.
        """
    def figure(self, name: str) -> Figure:
        """Returns one figure, which notebooks show. `.svg` is the picture; `.scene` is its content as
        plain data: panels with axes and marks (lines, points, bands, bars, surfaces), all numbers
        in the units of the axes.
        """
    def tables(self) -> list[str]:
        """Returns the names of the tables: fields that are lists of records; `rows` if the report has
        one row per measurement; `configurations`, the errors at each configuration of an analysis,
        which are computed again when they are asked for; and the `covariance` of an identification.
        """
    def table(self, name: str) -> Table:
        """Returns one table, which any Arrow reader takes without a copy. An empty list is a table
        without rows and columns.

        >>> import abbe
        >>> ledger = abbe.load("pps").analyze().table("ledger.sources")
        >>> len(ledger), ledger.columns
        (7, ('name', 'max', 'rms', 'share_of_tolerance', 'share', 'factor', 'class', 'rank'))
        """
    def __dir__(self) -> list[str]: ...
    def __reduce__(self) -> tuple[Any, tuple[Any]]: ...
    def _repr_html_(self) -> str: ...

@final
class Part:
    """Part of an analysis, from `Machine.analyze(…, shard=(i, n))` or `Part.load`. It can be pickled;
    `abbe.merge` of all parts is the report.
    """
    @staticmethod
    def load(file: _Path) -> Part:
        """Reads a part file, written by `save` or by `abbe analyze --shard`."""
    def save(self, file: _Path, *, overwrite: bool = False) -> None:
        """Writes the part to a file for `Part.load` or `abbe merge`. Raises FileExistsError if the
        file exists, unless `overwrite` is true.
        """
    @property
    def shard(self) -> tuple[int, int]:
        """Number of the part, from 1 on, and number of parts."""
    @property
    def configurations(self) -> int:
        """Number of configurations reached."""
    @property
    def unreachable(self) -> int:
        """Number of unreachable configurations."""
    def __reduce__(self) -> tuple[Any, tuple[bytes]]: ...

@final
class Table:
    """Table with named columns of numbers, texts or booleans. Any Arrow reader takes it without a
    copy: ``pandas.DataFrame.from_arrow``, ``polars.DataFrame``, ``pyarrow.table``, and duckdb by
    the name of the variable.

    Missing values are null, never NaN. Units are those of the fields of the report.
    """
    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
    def to_dict(self) -> dict[str, list[Any]]:
        """Returns the columns by name, as lists with None for missing values."""
    def __getitem__(self, name: str, /) -> Any:
        """"""
    def __len__(self) -> int: ...
    def __reduce__(self) -> tuple[Any, tuple[str]]: ...
    def __arrow_c_schema__(self) -> object: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...
    def _repr_html_(self) -> str: ...

def import_dh(
    table: _Path | Mapping[str, ArrayLike] | Any | None = None,
    *,
    convention: options.Convention,
    text: str | None = None,
    units: str | None = None,
    round_angles: bool = False,
) -> ImportReport:
    """Converts a table of Denavit-Hartenberg parameters to a spec. `table` is a CSV file or a table
    with the columns theta, d, a and alpha; `text` is such a file, or the output of the Robotics
    Toolbox.

    `convention`: "standard", Rz(theta) Tz(d) Tx(a) Rx(alpha), or "modified" (Craig), Rx(alpha)
    Tx(a) Rz(theta) Tz(d). `units`: units of columns whose header names none, such as "mm,deg";
    there is no default. The length unit of the spec is that of the table. Otherwise as
    `import_urdf`.

    >>> import abbe
    >>> rows = {"theta": ["q1", "q2 + 90"], "d": [0, 120], "a": [400, 0], "alpha": [0, -90],
    ...         "lower": [-170, -90], "upper": [170, 90]}
    >>> abbe.import_dh(rows, convention="standard", units="mm,deg").load().pose([0, 0])[:3, 3]
    array([400.,   0., 120.])
    """
def import_urdf(
    file: _Path | None = None,
    *,
    text: str | None = None,
    base: str | None = None,
    tip: str | None = None,
    fold: bool = False,
    round_angles: bool = False,
) -> ImportReport:
    """Converts a URDF robot to a spec, from a `file` or its `text`.

    `base`, `tip`: links whose frames are F_0 and the tool point; by default the root link and the
    last link, if there is only one. `fold`: merge fixed joints into the frames that follow them; by
    default each is a frame with errors of its own. `round_angles`: round angles within 1e-5 rad of
    a multiple of 45° to that multiple. Lengths of the spec are in m.

    `.load()` of the report returns the machine, `.spec` is the text of its spec, `.messages` lists
    what was left out, and `.report(folder)` writes the spec. Raises SpecError, with a place, if the
    file is wrong. Fields: `abbe.reports.ImportReport`.

    >>> import abbe
    >>> urdf = '''<robot name="arm"> <link name="base"/> <link name="hand"/>
    ...   <joint name="Elbow" type="revolute"> <parent link="base"/> <child link="hand"/>
    ...     <axis xyz="0 0 1"/> <limit lower="-1" upper="1" effort="1" velocity="1"/>
    ...   </joint> </robot>'''
    >>> abbe.import_urdf(text=urdf).load()
    Machine('arm': 1 frame, 1 joint variable, m)
    """
def load(spec: str | PathLike[str] | Manipulator | None = None, *, text: str | None = None) -> Machine:
    """Loads a manipulator from a spec file, by a shipped name (see `abbe.shipped()`), from an
    `abbe.spec.Manipulator`, or from the `text` of a spec.

    Raises SpecError, with place and remedy, if the spec is wrong.

    >>> import abbe
    >>> abbe.load("pps")
    Machine('pps': 6 frames, 6 joint variables, mm)
    """
def merge(
    parts: Iterable[Part | _Path], *, threads: int | None = None, progress: _Progress | None = None
) -> AnalyzeReport:
    """Merges all parts of an analysis, in any order. The report is byte for byte that of a single
    `Machine.analyze`.

    `parts`: Parts, or paths of their files. Raises SpecError if parts are missing, duplicate,
    damaged or from different analyses.

    >>> import abbe
    >>> pps = abbe.load("pps")
    >>> report = abbe.merge(pps.analyze(shard=(i, 3)) for i in (1, 2, 3))
    >>> report.to_json() == pps.analyze().to_json()
    True
    """
def positioning(
    data: _Path | Mapping[str, Any] | Any,
    *,
    reading_uncertainty: str | None = None,
    scale_uncertainty: str | None = None,
    accept: str | None = None,
) -> PositioningReport:
    """Evaluates runs of one axis by ISO 230-2, body diagonals by ISO 230-6, or circles by ISO 230-4.

    `data`: a CSV file or a table with columns `position (mm)`, `direction` (`+` or `-`) and
    `deviation (um)` or `actual (mm)`; or with one column for each pass, `1+ (um)`, `1- (um)`, …
    A column `diagonal` names the body diagonal of each row. A column `angle (deg)` instead of
    `position` has a circular test, whose deviations are those of the radius. `reading_uncertainty`,
    `scale_uncertainty`: standard uncertainties of one reading of the instrument, "0.1 um", and of
    its scale, "1 um/m". `accept`: limits of characteristics, "A 12 um, B 3 um"; the report then has
    a verdict, `accepted`.

    Positions are in mm or deg, characteristics in um or arcsec. `.table("rows")` has the mean
    deviations of an axis at its positions. Fields: `abbe.reports.PositioningReport`.

    >>> import abbe
    >>> runs = {"position (mm)": [0, 100], "1+ (um)": [1.0, 4.0], "1- (um)": [0.0, 2.0]}
    >>> report = abbe.positioning(runs)
    >>> both = report.lines[0].bidirectional
    >>> both and both.reversal.value
    2.0
    """
def shipped() -> list[str]:
    """Returns the names of the shipped manipulators that have compiled code; `load` also finds the
    mechanisms that `abbe list` shows.
    """
def _part(bytes: bytes) -> Part: ...
def _report(saved: Any) -> Report: ...
def _restore(origin: str, text: str | None, changes: list[tuple[str, str]]) -> Machine: ...
def _table(columns: str) -> Table: ...
