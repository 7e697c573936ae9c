"""Specs from objects: a class for each table of a spec file. `Manipulator(…).load()` is the machine.

Numbers without a unit are in the unit that a key states, `length unit` is that of the spec; texts such as `"2 mm"`
have their own. Where a field has another name than its key, it says so.

>>> from abbe.spec import DH, Frame, Manipulator, Source, Variable
>>> joint = Variable(name="q1", kind="revolute")
>>> frame = Frame(name="arm", variable=joint, dh=DH(theta="q1", d=0, a=300, alpha=0))
>>> bent = Source(name="bent", class_="repeatable", frame="arm", e_z="-0.1 mm")
>>> arm = Manipulator(name="arm", length="mm", frames=[frame], sources=[bent]).load()
>>> arm.pose([0.0])[0, 3]
np.float64(300.0)
"""

# Generated from the keys of the reader: `UPDATE_EXPECT=1 cargo test -p abbe-tests json_reference`.
from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from ._toml import File, Keys


@dataclass(kw_only=True)
class Manipulator(File):
    """`[manipulator]`, keys of the file."""

    name: str = field(metadata={"table": "manipulator"})
    """Name of the module and the type in generated code."""

    title: str | None = field(default=None, metadata={"table": "manipulator"})
    """Name of the machine in reports. Default: `name`."""

    description: str | None = field(default=None, metadata={"table": "manipulator"})
    """Description of the machine, for people. Default: empty."""

    reference: str | None = field(default=None, metadata={"table": "manipulator"})
    """Origin of the numbers, such as a drawing or a data sheet. Default: empty."""

    length: Literal["mm", "m"] = field(metadata={"table": "manipulator"})
    """Unit of every length: in this file, in generated code and in results."""

    orientation: Literal["rotation-vector", "euler-yzx", "iec-61217"] | None = field(default=None, metadata={"table": "manipulator"})
    """Meaning of rows 4 to 6 of `J_e`: a rotation vector, Euler angles about y, z, x, or the table angles of IEC
    61217: yaw about z, pitch about x, roll about y. Default: `"rotation-vector"`.
    """

    gravity: Sequence[float | str] | None = field(default=None, metadata={"table": "manipulator"})
    """Acceleration of gravity along x, y, z of `F_0`. Unit: give one. Default: none; loads need it."""

    parameters: Mapping[str, float | str | Parameter] | None = None
    """Lengths and angles of the chain that can be changed at run time. Default: none."""

    inputs: Mapping[str, float | str | Input] | None = None
    """Quantities that change from use to use, such as a payload or a temperature. Default: none."""

    tables: Mapping[str, Lookup] | None = None
    """Functions given by measured points. Default: none."""

    frames: Sequence[Frame] = field(metadata={"key": "frame"})
    """Transforms `A_1 … A_n`, from the base to the tip. Key: `frame`."""

    loops: Sequence[Loop] | None = field(default=None, metadata={"key": "loop"})
    """Conditions that frames of different branches meet: closed loops. Key: `loop`. Default: none."""

    limits: Sequence[Limit] | None = field(default=None, metadata={"key": "limit"})
    """Limits of sums and differences of joint variables, beside the limits of each. Key: `limit`. Default: none."""

    tool: Tool | None = None
    """Transform from `F_n` to the tool point. Default: no tool: the tool point is the origin of `F_n`."""

    sources: Sequence[Source] | None = field(default=None, metadata={"key": "source"})
    """Physical errors of the machine. Key: `source`. Default: none."""

    loads: Sequence[Load] | None = field(default=None, metadata={"key": "load"})
    """Masses, forces and moments that bend beams and compliances. Key: `load`. Default: none."""

    fitted: Mapping[str, Sequence[float | str]] | None = None
    """Ranges of joints and inputs in which `identify` fitted the errors; `measure`, `compensate` and `analyze` warn
    beyond them. Default: none.
    """

    covariance: Covariance | None = None
    """Covariance of the errors that `identify` fitted. Default: not known."""


@dataclass(kw_only=True)
class Parameter(Keys):
    """`[parameters.NAME]`."""

    value: float | str
    """Nominal value; its unit decides whether it is a length, an angle or another quantity. Unit: length unit, rad or
    1; others must be written.
    """

    description: str | None = None
    """Description of the parameter, for people. Default: empty."""

    reference: str | None = None
    """Origin of the value. Default: empty."""


@dataclass(kw_only=True)
class Input(Keys):
    """`[inputs.NAME]`."""

    value: float | str
    """Nominal value. Unit: length unit, rad or 1; others must be written."""

    range: Sequence[float | str] | None = None
    """Lower and upper limit. Unit: as `value`. Default: no limits."""

    levels: Sequence[float | str] | None = None
    """Values that are used, such as payloads of 0 and 8 kg: samples, and studies and plans that name no others, take
    these alone. Unit: as `value`. Default: any value in the range.
    """

    uncertainty: float | str | None = None
    """Standard uncertainty of the value in use, such as that of a load cell: a normal random source named
    `uncertainty of NAME`. Unit: as `value`. Default: none: the value is exact.
    """

    description: str | None = None
    """Description of the input, for people. Default: empty."""

    reference: str | None = None
    """Origin of the value and the range. Default: empty."""


@dataclass(kw_only=True)
class Lookup(Keys):
    """`[tables.NAME]`."""

    file: str | None = None
    """File of the points: a line of column names, then rows; lines that begin with `#` are comments. Default: the
    points are here.
    """

    x: Sequence[float | str] | Axis
    """Points at which the function was measured, in rising or falling order. Unit: length unit, rad or 1; others must
    be written.
    """

    y: Sequence[float | str] | Axis
    """Measured values, one for each `x`. Unit: as `x`."""

    interpolation: Literal["linear", "cubic"]
    """Curve between the points: straight lines, or monotone cubics."""

    outside: Literal["hold"] | None = None
    """Values beyond the first and the last point: `"hold"` keeps those of the ends. Default: an error."""

    description: str | None = None
    """Description of the function, repeated in generated code. Default: empty."""

    reference: str | None = None
    """Origin of the points. Default: empty."""


@dataclass(kw_only=True)
class Axis(Keys):
    """`[tables.NAME.x]`, `[tables.NAME.y]`."""

    column: str | None = None
    """Heading of the column. Default: required with `file`."""

    values: Sequence[float | str] | None = None
    """The numbers. Unit: `unit`. Default: required without `file`."""

    unit: str | None = None
    """Unit of the numbers. Default: a pure number."""


@dataclass(kw_only=True)
class Frame(Keys):
    """`[[frame]]`."""

    name: str
    """Name of the frame, by which sources refer to it; must be unique."""

    parent: str | None = None
    """Frame that it hangs on: where its transform begins. `base` is `F_0`. Default: the frame before it."""

    variable: Variable | None = None
    """Joint variable that moves the frame. Default: none: the frame is fixed."""

    description: str | None = None
    """Description, for people. Default: empty."""

    reference: str | None = None
    """Origin of the numbers. Default: empty."""

    transform: str | None = None
    """Motions from left to right, such as `Rz(q1) Tz(300)`: `Tx Ty Tz` translate along an axis, `Rx Ry Rz` rotate
    about one. Unit: length unit or rad. Default: one of these.
    """

    matrix: Sequence[Sequence[float | str]] | None = None
    """Homogeneous 4 × 4 matrix; it must be a rigid motion for all values of its names. Unit: length unit in the last
    column. Default: one of these.
    """

    dh: DH | None = None
    """Standard Denavit-Hartenberg numbers: `Rz(theta) Tz(d) Tx(a) Rx(alpha)`. Default: one of these."""

    mdh: DH | None = None
    """Modified (Craig's) Denavit-Hartenberg numbers: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`. Default: one of these."""

    origin: Origin | None = None
    """Origin of a URDF joint; the variable moves the frame along or about `axis`. Default: one of these."""

    axis: Sequence[float | str] | None = None
    """Axis of the variable, in the frame given by `origin`. Unit: 1. Default: `[1, 0, 0]`."""


@dataclass(kw_only=True)
class Variable(Keys):
    """`[frame.variable]`, `[loop.variable]`."""

    name: str
    """Name of the variable in expressions, commands and files."""

    kind: Literal["revolute", "prismatic"]
    """Kind of joint: an angle or a length."""

    limits: Sequence[float | str] | None = None
    """Lower and upper joint limit. Unit: length unit or rad. Default: no limits."""

    home: float | str | None = None
    """Value in the home position, within the limits. Unit: length unit or rad. Default: `0`."""

    description: str | None = None
    """Description of the joint, for people. Default: empty."""

    passive: bool | None = None
    """`true` for a joint without a drive, which the loops determine. Default: `false`."""


@dataclass(kw_only=True)
class DH(Keys):
    """`[frame.dh]`, `[frame.mdh]`."""

    theta: float | str
    """Rotation about z. Unit: rad."""

    d: float | str
    """Translation along z. Unit: length unit."""

    a: float | str
    """Translation along x. Unit: length unit."""

    alpha: float | str
    """Rotation about x. Unit: rad."""


@dataclass(kw_only=True)
class Origin(Keys):
    """`[frame.origin]`."""

    xyz: Sequence[float | str] | None = None
    """Position of the frame in the previous one. Unit: length unit. Default: `[0, 0, 0]`."""

    rpy: Sequence[float | str] | None = None
    """Roll, pitch and yaw of URDF, in this order: `Rz(yaw) Ry(pitch) Rx(roll)`. Unit: rad. Default: `[0, 0, 0]`."""


@dataclass(kw_only=True)
class Limit(Keys):
    """`[[limit]]`."""

    sum: float | str
    """Sum or difference of joint variables, such as `a2 + a3`, each with a constant factor or without. Unit: length
    unit or rad.
    """

    limits: Sequence[float | str] | None = None
    """Smallest and largest sum that the machine permits. Unit: length unit or rad. Default: one of the two."""

    equals: float | str | None = None
    """Value of the sum, where joints move together. Unit: length unit or rad. Default: one of the two."""


@dataclass(kw_only=True)
class Loop(Keys):
    """`[[loop]]`."""

    name: str
    """Name of the loop; must be unique."""

    frames: Sequence[str]
    """The two frames that meet, or between which the length is."""

    closes: Literal["point", "pose", "distance"] | Sequence[Literal["x", "y", "z", "rx", "ry", "rz"]]
    """What closes: the origins meet, the poses meet, the origins have a distance; or some coordinates of the first
    frame's pose relative to the second's are zero: the position `x`, `y`, `z` and the rotation `rx`, `ry`, `rz`
    along and about the axes of the second frame's parent.
    """

    length: float | str | None = None
    """Distance of the two origins: a leg or strut. Unit: length unit. Default: required for a distance."""

    variable: Variable | None = None
    """Joint variable of a leg, for `length`. Default: none: a strut."""

    description: str | None = None
    """Description of the loop, for people. Default: empty."""

    reference: str | None = None
    """Origin of the numbers. Default: empty."""


@dataclass(kw_only=True)
class Tool(Keys):
    """`[tool]`."""

    frame: str | None = None
    """Frame that carries the tool. Default: the last frame of the first chain, before any `parent`."""

    description: str | None = None
    """Description, for people. Default: empty."""

    reference: str | None = None
    """Origin of the numbers. Default: empty."""

    transform: str | None = None
    """Motions from left to right, such as `Rz(q1) Tz(300)`: `Tx Ty Tz` translate along an axis, `Rx Ry Rz` rotate
    about one. Unit: length unit or rad. Default: one of these.
    """

    matrix: Sequence[Sequence[float | str]] | None = None
    """Homogeneous 4 × 4 matrix; it must be a rigid motion for all values of its names. Unit: length unit in the last
    column. Default: one of these.
    """

    dh: DH | None = None
    """Standard Denavit-Hartenberg numbers: `Rz(theta) Tz(d) Tx(a) Rx(alpha)`. Default: one of these."""

    mdh: DH | None = None
    """Modified (Craig's) Denavit-Hartenberg numbers: `Rx(alpha) Tx(a) Rz(theta) Tz(d)`. Default: one of these."""

    origin: Origin | None = None
    """Origin of a URDF joint; the variable moves the frame along or about `axis`. Default: one of these."""

    axis: Sequence[float | str] | None = None
    """Axis of the variable, in the frame given by `origin`. Unit: 1. Default: `[1, 0, 0]`."""


@dataclass(kw_only=True)
class Effect(Keys):
    """`[[source.effect]]`."""

    frame: str | None = None
    """Frame that has the error; `"base"` is `F_0`, unless a frame has this name. Default: required without `joint`
    and `parameter`.
    """

    at: str | None = None
    """Location of the error on the link, as a transform from the frame; the error is in the axes of that location.
    Unit: length unit or rad. Default: at the frame itself.
    """

    e_x: float | str | None = None
    """Translation along x of the frame. Unit: length unit. Default: `0`."""

    e_y: float | str | None = None
    """Translation along y of the frame. Unit: length unit. Default: `0`."""

    e_z: float | str | None = None
    """Translation along z of the frame. Unit: length unit. Default: `0`."""

    e_s: float | str | None = None
    """Spin: rotation about **y** of the frame. Unit: rad. Default: `0`."""

    e_r: float | str | None = None
    """Roll: rotation about **z** of the frame. Unit: rad. Default: `0`."""

    e_p: float | str | None = None
    """Pitch: rotation about **x** of the frame. Unit: rad. Default: `0`."""

    beam: Beam | None = None
    """Beam with the frame at its tip, which bends under the loads beyond it. Default: none."""

    compliance: Compliance | None = None
    """Elastic joint or bearing at the frame, which yields to the loads at it or beyond it. Default: none."""

    joint: str | None = None
    """Joint that has the `error`, for example of its encoder, gearbox or zero offset, or the `stiffness`. Default:
    none.
    """

    parameter: str | None = None
    """Parameter with the `error`, wherever it occurs in the chain. Default: none."""

    error: float | str | None = None
    """Actual minus nominal value. Unit: as the joint or the parameter. Default: required with `parameter`; with
    `joint`, this or `stiffness`.
    """

    stiffness: float | str | None = None
    """Stiffness of the `joint`, which deviates by the moment of the loads about it (of a slide or leg, the force
    along it, as in `"20 N/um"`), divided by the stiffness. Unit: give one. Default: rigid.
    """

    moment: float | str | None = None
    """Measured moment (of a slide, force) on an elastic `joint`, for example an input that follows a torque sensor.
    Unit: give one. Default: that of the loads.
    """

    dh: DHErrors | None = None
    """Errors of the Denavit-Hartenberg numbers of the `frame`. Default: none."""


@dataclass(kw_only=True)
class Source(Effect):
    """`[[source]]`."""

    name: str
    """Name of the source, by which studies and options refer to it; must be unique."""

    class_: Literal["repeatable", "tolerance", "random"] = field(metadata={"key": "class"})
    """Repeatable: a known value and sign. Tolerance: one fixed value in each machine, unknown within its bound.
    Random: another value at each visit of a configuration. Key: `class`.
    """

    distribution: Literal["uniform", "normal", "triangular", "arcsine", "disc", "ball"] | None = None
    """Distribution of a tolerance over machines, or of a random source; its value is the half-width of a uniform or
    triangular distribution, the amplitude of an arcsine one, the standard deviation of a normal one, or the
    semi-axis of a disc or ball, in which two or three errors of a frame are evenly distributed together. Default:
    uniform for a tolerance; random sources must have it.
    """

    degrees_of_freedom: float | str | None = None
    """Degrees of freedom of the standard deviation of a normal source, if it was estimated: n − 1 for n readings.
    Unit: 1. Default: none: the standard deviation is known.
    """

    enabled: bool | None = None
    """Includes the source; `--enable` and `--disable` change it for a run. Default: `true`."""

    scale: float | str | None = None
    """Factor of all errors of the source, which `abbe allocate` writes; `--scale` multiplies it. Unit: 1. Default:
    `1`.
    """

    magnitude: Magnitude | None = None
    """Factor of the source and its uncertainty; `identify` fits it together with the errors of the frames. Default:
    none.
    """

    description: str | None = None
    """Description of the error, for people. Default: empty."""

    reference: str | None = None
    """Origin of the value, such as a data sheet or a measurement. Default: empty."""

    effects: Sequence[Effect] | None = field(default=None, metadata={"key": "effect"})
    """Effects on several frames; those of a random source share one random number. Key: `effect`. Default: none: the
    effect stands in the source.
    """


@dataclass(kw_only=True)
class DHErrors(Keys):
    """`[source.dh]`, `[source.effect.dh]`."""

    theta: float | str | None = None
    """Error of theta. Unit: rad. Default: `0`."""

    d: float | str | None = None
    """Error of d. Unit: length unit. Default: `0`."""

    a: float | str | None = None
    """Error of a. Unit: length unit. Default: `0`."""

    alpha: float | str | None = None
    """Error of alpha. Unit: rad. Default: `0`."""


@dataclass(kw_only=True)
class Magnitude(Keys):
    """`[source.magnitude]`."""

    value: float | str | None = None
    """Factor of the source. Unit: 1. Default: `1`."""

    standard_deviation: float | str | None = None
    """Standard deviation of `value` before any measurement; `analyze` adds it as a normal random source. Unit: 1.
    Default: none: nothing is known.
    """

    degrees_of_freedom: float | str | None = None
    """Degrees of freedom of `standard_deviation`, if it was estimated from few measurements. Unit: 1. Default: none:
    the standard deviation is known.
    """


@dataclass(kw_only=True)
class Beam(Keys):
    """`[source.beam]`, `[source.effect.beam]`."""

    length: float | str
    """Length from the clamped end to the frame. Unit: length unit."""

    axis: Literal["x", "y", "z"] | None = None
    """Axis of the frame along which the beam arrives at it. Default: `"x"`."""

    EI_x: float | str | None = None
    """Stiffness against bending about x: of a beam along y the deflection along z, along z that along y. Unit: give
    one. Default: required unless the beam is along x.
    """

    EI_y: float | str | None = None
    """Stiffness against bending about y: of a beam along x the deflection along z, along z that along x. Unit: give
    one. Default: required unless the beam is along y.
    """

    EI_z: float | str | None = None
    """Stiffness against bending about z: of a beam along x the deflection along y, along y that along x. Unit: give
    one. Default: required unless the beam is along z.
    """

    GJ: float | str | None = None
    """Torsional stiffness. Unit: give one. Default: rigid."""

    EA: float | str | None = None
    """Stiffness against extension. Unit: give one. Default: rigid."""

    mass_per_length: float | str | None = None
    """Mass per length, which weighs under `gravity`. Unit: give one. Default: `0`."""


@dataclass(kw_only=True)
class Compliance(Keys):
    """`[source.compliance]`, `[source.effect.compliance]`."""

    diagonal: Sequence[float | str] | None = None
    """Error per force or moment, each along or about its own axis: x, y, z, then about y, z, x. Unit: give one.
    Default: one of these.
    """

    matrix: Sequence[Sequence[float | str]] | None = None
    """Error (row) per force or moment (column), both along x, y, z, then about y, z, x; symmetric. Unit: give one.
    Default: one of these.
    """


@dataclass(kw_only=True)
class Load(Keys):
    """`[[load]]`."""

    name: str | None = None
    """Name of the load, for people. Default: none."""

    mass: float | str | None = None
    """Mass, which weighs under `gravity`. Unit: give one. Default: none."""

    force: Sequence[float | str] | None = None
    """Force that acts at `point`. Unit: give one. Default: none."""

    moment: Sequence[float | str] | None = None
    """Moment. Unit: give one. Default: none."""

    axes: Literal["frame", "base"] | None = None
    """Axes of `force` and `moment`: those of the moving frame, or those of `F_0`. Default: `"frame"`."""

    frame: str
    """Frame that carries the load."""

    point: Sequence[float | str] | Literal["tool"] | None = None
    """Point of action in that frame; `"tool"` is the tool point, with the frame that carries the tool. Unit: length
    unit. Default: the frame's origin.
    """

    description: str | None = None
    """Description of the load, for people. Default: empty."""

    reference: str | None = None
    """Origin of the values. Default: empty."""


@dataclass(kw_only=True)
class Covariance(Keys):
    """`[covariance]`."""

    of: Sequence[CovarianceOf]
    """Errors of the rows and columns."""

    rows: Sequence[Sequence[float | str]]
    """Covariance matrix of these errors; symmetric. Unit: length unit, rad, and 1."""


@dataclass(kw_only=True)
class CovarianceOf(Keys):
    """`[covariance.of]`."""

    source: str | None = None
    """Source; without `error`, the factor of the whole source, nominally 1. Default: none."""

    error: Literal["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"] | None = None
    """Error of a frame; with a source, the one that it has. Default: required without `source`."""

    frame: str | None = None
    """Frame that has the error, without a source. Default: `F_0`."""

    joint: str | None = None
    """Joint of which the source has an error; its covariance is that of an addend of this error. Default: none."""
