"""A spec file as what it says: frames whose matrices are functions of named values, sources, loads."""

import math
import tomllib
from dataclasses import dataclass, field

from expressions import Expressions
from rigid import chained, elementary, rotation, translation
from tables import table

COMPONENTS = ["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"]
DH = ["theta", "d", "a", "alpha"]


@dataclass
class Frame:
    name: str
    transform: object  # (names, errors of the four DH numbers) -> matrix
    variable: dict | None = None


@dataclass
class Effect:
    """What a source does at a frame, to a joint, or to a parameter."""

    frame: int | None = None
    errors: list = field(default_factory=list)  # six expressions
    at: object = None  # names -> matrix
    beam: dict | None = None
    compliance: list | None = None  # six rows of six expressions, in the order of the errors
    joint: str | None = None
    parameter: str | None = None
    dh: dict | None = None
    error: object = None


@dataclass
class Source:
    name: str
    repeatable: bool
    distribution: str | None
    effects: list
    enabled: bool = True
    scale: float = 1.0
    freedom: float = math.inf  # degrees of freedom of a standard deviation
    value: float | None = None  # the standard deviation of a magnitude, of what is not known of one


@dataclass
class Load:
    """What acts at a point of a frame; without a point at the tool point."""

    frame: int
    point: list | None
    mass: object
    force: list
    moment: list
    follows: bool  # force and moment are in the axes of the frame, or else in those of F_0


class Spec:
    def __init__(self, text, folder=None):
        spec = tomllib.loads(text)
        header = spec["manipulator"]
        self.length, self.name = header["length"], header["name"]
        self.orientation = header.get("orientation", "rotation-vector")
        self.read = Expressions(self.length)
        constant = self.read.constant
        for name, given in spec.get("tables", {}).items():
            self.read.names[name] = table(given, folder, constant)
        self.gravity = [constant(x) for x in header.get("gravity", [0, 0, 0])]
        self.parameters = {name: constant(table["value"]) for name, table in spec.get("parameters", {}).items()}
        self.inputs = {name: constant(table["value"]) for name, table in spec.get("inputs", {}).items()}
        self.ranges = {
            name: [constant(x) for x in table["range"]]
            for name, table in spec.get("inputs", {}).items()
            if "range" in table
        }
        self.frames = [self.frame(table) for table in spec["frame"]]
        self.index = {frame.name: i for i, frame in enumerate(self.frames)}
        self.variables = [frame.variable for frame in self.frames if frame.variable]
        self.tool = self.matrix(spec.get("tool", {"transform": "Tx(0)"}))
        self.loads = [self.load(table) for table in spec.get("load", [])]
        self.sources = [self.source(table) for table in spec.get("source", [])]
        self.sources += [self.unknown(table) for table in spec.get("source", []) if "standard_deviation" in table.get("magnitude", {})]

    def home(self):
        return {variable["name"]: variable["home"] for variable in self.variables}

    def names(self, configuration, **changes):
        """Every name with its value."""
        return {**self.parameters, **self.inputs, **self.home(), **configuration, **changes}

    # Frames.

    def frame(self, table):
        variable = table.get("variable")
        if variable:
            limits = [self.read.constant(x) for x in variable["limits"]] if "limits" in variable else None
            inside = min(max(0.0, limits[0]), limits[1]) if limits else 0.0
            home = self.read.constant(variable["home"]) if "home" in variable else inside
            variable = {"name": variable["name"], "kind": variable["kind"], "limits": limits, "home": home}
        return Frame(table["name"], self.matrix(table, variable), variable)

    def matrix(self, table, variable=None):
        """A function of the names, and of errors of DH numbers where there are such."""
        read = self.read.expression
        if "transform" in table:
            factors = self.read.motions(table["transform"])
            return lambda names, dh=None: chained(elementary(motion, amount(names)) for motion, amount in factors)
        if "matrix" in table:
            rows = [[read(x) for x in row] for row in table["matrix"][:3]]
            return lambda names, dh=None: [[x(names) for x in row] for row in rows]
        if "dh" in table or "mdh" in table:
            kind = "dh" if "dh" in table else "mdh"
            numbers = {key: read(table[kind][key]) for key in DH}
            order = ["Rz theta", "Tz d", "Tx a", "Rx alpha"]
            order = order if kind == "dh" else [order[k] for k in (3, 2, 0, 1)]

            def of_dh(names, errors=None):
                amounts = {key: number(names) for key, number in numbers.items()}
                for key, error in (errors or {}).items():
                    amounts[key] = amounts[key] + error
                return chained(elementary(*(m, amounts[key])) for m, key in (step.split() for step in order))

            return of_dh
        return self.urdf(table, variable)

    def urdf(self, table, variable):
        read = self.read.expression
        origin = table.get("origin", {})
        xyz = [read(x) for x in origin.get("xyz", [0, 0, 0])]
        rpy = [read(x) for x in origin.get("rpy", [0, 0, 0])]
        axis = [self.read.constant(x) for x in table.get("axis", [1, 0, 0])]

        def of_origin(names, dh=None):
            roll, pitch, yaw = (x(names) for x in rpy)
            factors = [translation(*(x(names) for x in xyz))]
            factors += [elementary("Rz", yaw), elementary("Ry", pitch), elementary("Rx", roll)]
            if variable:
                amount = names[variable["name"]]
                turns = variable["kind"] == "revolute"
                factors.append(rotation(axis, amount) if turns else translation(*(amount * x for x in axis)))
            return chained(factors)

        return of_origin

    # Sources.

    def source(self, table):
        effects = table.get("effect", [table])
        return Source(
            table["name"],
            table["class"] == "repeatable",
            table.get("distribution"),
            [self.effect(effect) for effect in effects],
            table.get("enabled", True),
            table.get("magnitude", {}).get("value", 1.0),
            table.get("degrees_of_freedom", math.inf),
        )

    def unknown(self, table):
        """What is not known of a magnitude: a normal source, so many times the errors of magnitude 1."""
        source, magnitude = self.source(table), table["magnitude"]
        source.name += " (its magnitude)"
        source.repeatable, source.distribution = False, "normal"
        source.scale = source.value = magnitude["standard_deviation"]
        source.freedom = magnitude.get("degrees_of_freedom", math.inf)
        return source

    def effect(self, table):
        read = self.read.expression
        effect = Effect(frame=self.index.get(table.get("frame")))
        if "at" in table:
            factors = self.read.motions(table["at"])
            effect.at = lambda names: chained(elementary(motion, amount(names)) for motion, amount in factors)
        if "beam" in table:
            stiff = {key: read(x) for key, x in table["beam"].items() if key != "axis"}
            effect.beam = {**stiff, "axis": table["beam"].get("axis", "x")}
        elif "compliance" in table:
            given = table["compliance"]
            zero = read(0)
            if "matrix" in given:
                effect.compliance = [[read(x) for x in row] for row in given["matrix"]]
            else:
                diagonal = [read(x) for x in given["diagonal"]]
                effect.compliance = [[diagonal[i] if i == j else zero for j in range(6)] for i in range(6)]
        elif "joint" in table:
            effect.joint, effect.error = table["joint"], read(table["error"])
        elif "parameter" in table:
            effect.parameter, effect.error = table["parameter"], read(table["error"])
        elif "dh" in table or "mdh" in table:
            effect.dh = {key: read(x) for key, x in (table.get("dh") or table["mdh"]).items()}
        else:
            effect.errors = [read(table.get(component, 0)) for component in COMPONENTS]
        return effect

    def load(self, table):
        read = self.read.expression
        point = table.get("point", [0, 0, 0])
        at_tool = point == "tool"
        frame = len(self.frames) - 1 if at_tool else self.index[table["frame"]]
        return Load(
            frame,
            None if at_tool else [read(x) for x in point],
            read(table.get("mass", 0)),
            [read(x) for x in table.get("force", [0, 0, 0])],
            [read(x) for x in table.get("moment", [0, 0, 0])],
            table.get("axes", "frame") == "frame",
        )
