"""Random specs that together use every form of the language, each with configurations to look at."""

import itertools
import math
import random
import re

SOURCES = [
    "repeatable", "uniform", "normal", "triangular", "arcsine", "effects", "random effects", "at", "disabled", "magnitude",
    "beam", "beam at", "beam without EA", "compliance", "compliance matrix", "compliance at", "joint", "parameter", "dh source",
    "joint effects",
]  # fmt: skip
FUNCTIONS = ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "abs", "min", "max", "sign", "exp", "log"]
UNITS = [
    "m", "mm", "um", "nm", "cm", "inch", "rad", "deg", "mrad", "urad", "arcmin", "arcsec", "kg", "g", "lb", "t", "N", "kN", "mN",
    "Pa", "kPa", "MPa", "GPa", "s", "min", "h", "K", "ppm", "%",
]  # fmt: skip
# What 30 specs use together.
FORMS = {
    *SOURCES, "product", "matrix", "dh", "mdh", "origin", "fixed", "fixed origin", "coupled to another",
    "axis x", "axis z", "axis given", "revolute", "prismatic", "home", "no home", "rotation-vector", "euler-yzx", "iec-61217",
    "no tool", "tool product", "tool matrix", "tool dh", "tool origin", "beam x", "beam y", "beam z", "beam default", "weightless", "mass per length",
    "mass", "force", "force and moment", "load at a point", "load at the tool", "path", "grid", "inputs set", "inputs crossed", "inputs at both ends", "inputs beside", *FUNCTIONS, *UNITS,
    "estimated", "estimated magnitude", "magnitude known", "linear", "cubic", "errors of dh", "errors of mdh",
}  # fmt: skip


class Writer:
    """Writes one spec. What it writes is typed: angles, lengths, plain numbers; `used` are the forms taken so far."""

    def __init__(self, seed, used):
        self.random = random.Random(seed)
        self.used = used
        self.seed = seed
        self.length = ["mm", "m"][seed % 2]
        self.scale = 1000.0 if self.length == "mm" else 1.0
        self.variables, self.lines = [], []
        self.frames, self.dh = [], []
        self.parameters = {}

    def pick(self, *choices):
        """One of these forms; half of the time one that no spec before this one has."""
        unused = [choice for choice in choices if choice not in self.used]
        choice = self.random.choice(unused if unused and self.random.random() < 0.5 else choices)
        self.used.add(choice)
        return choice

    def number(self, low=-1.0, high=1.0):
        return f"{self.random.uniform(low, high):.6g}"

    def long(self, low=-0.6, high=0.6):
        """A length in metres, in a unit of the spec's choice."""
        metres = self.random.uniform(low, high)
        return self.of_size(metres, {"m": 1, "mm": 1e-3, "um": 1e-6, "nm": 1e-9, "cm": 1e-2, "inch": 0.0254})

    def of_size(self, size, units):
        """A number with one of these units, each with its size."""
        unit = self.pick(*units)
        return f"{size / units[unit]:.9g} {unit}"

    # Expressions over the variables that may stand there.

    def angle(self, names, depth=1):
        turns = [name for name in names if name.startswith("q")]
        options = [f"{self.number(-180, 180)} deg", f"{self.number(-900, 900)} mrad", self.number(), "pi/4"]
        options += [f"{self.number(-9e5, 9e5)} urad", f"{self.number(-900, 900)} arcmin", f"{self.number(-9e4, 9e4)} arcsec"]
        options += turns * 3
        if depth:
            x = self.plain(names, depth - 1)
            options += [f"atan({x})", f"asin(({x})/(2 + abs({x})))", f"acos(0.3*sin({x}))"]
            options.append(f"atan2({self.length_of(names, depth - 1)}, {self.long(0.2, 0.7)})")
            options.append(f"{self.number()}*({self.angle(names, depth - 1)})")
        return self.random.choice(options)

    def length_of(self, names, depth=1):
        slides = [name for name in names if name.startswith(("d", "s"))]
        options = [self.long(), self.long(), *slides * 3]
        if depth:
            options.append(f"({self.length_of(names, depth - 1)}) * ({self.plain(names, depth - 1)})")
            options.append(f"({self.length_of(names, depth - 1)} - {self.length_of(names, depth - 1)})")
            options.append(f"sqrt(({self.length_of(names, depth - 1)})^2 + ({self.long(0.1)})^2)")
        return self.random.choice(options)

    def plain(self, names, depth=2):
        if not depth:
            return self.number()
        angle, x, y = self.angle(names, depth - 1), self.plain(names, depth - 1), self.plain(names, depth - 1)
        length = self.length_of(names, depth - 1)
        return self.random.choice(
            [
                f"sin({angle})",
                f"cos({angle} - {x})",
                f"tan(0.1*sin({angle}))",
                f"({length})/({self.long(0.3, 0.9)})",
                f"({x} + {y}*cos({angle}))",
                f"-({x})^2",
                f"({x} - {y})^3/(1 + ({y})^2)",
                f"sqrt(1 + ({x})^2)",
                f"abs({x})",
                *self.tabulated(x, length),
                f"exp(-({length}/({self.long(0.4, 0.9)}))^2)",
                f"max({x}, {y})",
                f"min({x}, sin({angle}))",
                f"sign({x})*log(2 + ({y})^2)",
            ]
        )

    def tabulated(self, x, length):
        """Tables of a plain number (linear, here) and of a length (cubic, in a file), held beyond their ends."""
        return [f"profile({x})", f"rail({length})/(1 mm)", f"bow({length})"]

    def tables(self, folder):
        rows = ["place,height"]
        for k in range(7):
            rows.append(f"{-700 + 200 * k + self.random.uniform(-60, 60):.6g},{self.number(-900, 900)}")
        (folder / f"rail{self.seed}.csv").write_text("\n".join(rows) + "\n")
        self.add("[tables.profile]", f"x = [-2, -0.5, 0.1, 1.2, 3]", f"y = [{', '.join(self.number() for _ in range(5))}]")
        self.add(f'interpolation = "{self.pick("linear", "cubic")}"', 'outside = "hold"')
        self.add("[tables.rail]", f'file = "rail{self.seed}.csv"', 'interpolation = "cubic"', 'outside = "hold"')
        self.add('x = { column = "place", unit = "mm" }', 'y = { column = "height", unit = "um" }')
        self.add("[tables.bow]", 'x = { values = [-40, -8, 3, 25, 60], unit = "cm" }', "y = [0.1, -0.4, 0.3, 0.35, -0.2]")
        self.add('interpolation = "linear"', 'outside = "hold"')

    # The file.

    def add(self, *lines):
        self.lines += lines

    def spec(self, folder):
        turn = self.random
        orientation = self.pick("rotation-vector", "euler-yzx", "iec-61217")
        self.add("[manipulator]", f'name = "random{self.seed}"', f'length = "{self.length}"')
        if orientation != "rotation-vector" or turn.random() < 0.5:
            self.add(f'orientation = "{orientation}"')
        self.add(f'gravity = ["0.3 m/s^2", "-1100 mm/s^2", "{self.of_size(-9.7, {"m/s^2": 1, "m/min^2": 1 / 3600, "m/h^2": 1 / 3600**2})}"]')
        self.add("[parameters]")
        for k in range(3):
            self.parameters[f"s{k}"] = self.random.uniform(0.1, 0.6)
            self.add(f's{k} = {{ value = "{self.parameters[f"s{k}"] * 1000:.9g} mm" }}')
        stiff = {"N*m^2": 1, "kN*m^2": 1e3, "mN*m^2": 1e-3, "Pa*m^4": 1, "kPa*m^4": 1e3, "MPa*m^4": 1e6, "GPa*cm^4": 10, "GPa*mm^4": 1e-3}
        for name in ("EI", "GJ"):
            self.add(f'{name} = {{ value = "{self.of_size(self.random.uniform(1e4, 9e4), stiff)}" }}')
        self.add("[inputs]", 'payload = { value = "2.5 kg", range = ["0 kg", "7500 g"] }')
        self.add('warmth = { value = "3 K", range = ["-10 K", "10 K"] }', "approach = { value = 1, range = [-1, 1] }")
        self.tables(folder)
        count = turn.randint(3, 6)
        moving = turn.sample(range(count), turn.randint(2, count))
        for i in range(count):
            self.frame(i, i in moving)
        tool = self.pick("no tool", "tool product", "tool matrix", "tool dh", "tool origin")
        if tool == "tool product":
            self.add("[tool]", f'transform = "Tx({self.long()}) Ry({self.angle([], 0)}) Tz(s1) Ty({self.long()})"')
        elif tool == "tool matrix":
            self.add("[tool]", f'matrix = [[0, -1, 0, "{self.long()}"], [1, 0, 0, "s2"], [0, 0, 1, 0.1], [0, 0, 0, 1]]')
        elif tool == "tool dh":
            self.add("[tool]", f'dh = {{ theta = 0.3, d = "s1", a = "{self.long()}", alpha = "{self.angle([], 0)}" }}')
        elif tool == "tool origin":
            self.add("[tool]", f'origin = {{ xyz = ["s1", "{self.long()}", 0], rpy = [0.1, "{self.angle([], 0)}", "3 deg"] }}')
        chain = "\n".join(self.lines[self.lines.index("[[frame]]") :])
        self.in_the_chain = [name for name in self.parameters if re.search(rf"\b{name}\b", chain)]
        for k in range(2):
            self.load(k)
        for k in range(turn.randint(5, 8)):
            self.source(k)
        return "\n".join(self.lines) + "\n"

    def names(self):
        return [name for name, _, _ in self.variables] + list(self.parameters)

    def frame(self, i, moves):
        name = f"f{i}"
        self.frames.append(name)
        self.add("", "[[frame]]", f'name = "{name}"')
        if not moves:
            if self.pick("fixed", "fixed origin") == "fixed":
                self.add(f'transform = "Tx({self.long()}) Rz({self.angle([], 0)}) Ty(s0) Rx(0.2)"')
            else:
                self.add(f'origin = {{ xyz = [0.1, "{self.long()}", 0], rpy = [0.3, "-20 deg", {self.number()}] }}')
            return
        kind = self.pick("revolute", "prismatic")
        variable = f"{'q' if kind == 'revolute' else 'd'}{i}"
        if kind == "revolute":
            low, high = round(self.random.uniform(-140, -10), 3), round(self.random.uniform(0.2, 2.5), 4)
            limits = f'"{low} deg", {high}'
            low = math.radians(low)
        else:
            low, high = round(self.random.uniform(-0.5, 0.05), 4), round(self.random.uniform(300, 900), 3)
            limits = f'"{low} m", "{high} mm"'
            low, high = low * self.scale, high * self.scale / 1000
        home = low + 0.3 * (high - low)
        # Without a home it is 0, which must lie inside.
        shown = f", home = {home:.6g}" if low > 0 or self.pick("home", "no home") == "home" else ""
        self.add(f'variable = {{ name = "{variable}", kind = "{kind}", limits = [{limits}]{shown} }}')
        self.matrix(i, variable, kind)
        self.variables.append((variable, low, high))

    def matrix(self, i, variable, kind):
        form = self.pick("product", "matrix", "dh", "mdh", "origin", "coupled")
        turns = kind == "revolute"
        others = [name for name, _, _ in self.variables if name.startswith(variable[0])]
        if form == "coupled" and others:
            argument = f"{variable} - 0.5*{others[0]}"
            self.used.add("coupled to another")
        else:
            argument = self.random.choice([variable, f"-{variable} + {self.angle([], 0) if turns else self.long()}"])
        if form in ("dh", "mdh"):
            self.dh.append((form, self.frames[-1]))
            theta, d = (argument, f'"{self.long()}"') if turns else (self.angle([], 0), f'"{argument}"')
            theta = f'"{theta}"'
            alpha = self.random.choice(['"pi/2"', '"-pi/2"', "0", '"17 deg"'])
            self.add(f'{form} = {{ theta = {theta}, d = {d}, a = "{self.random.choice(["s0", self.long()])}", alpha = {alpha} }}')
        elif form == "origin":
            self.add(f'origin = {{ xyz = ["{self.long()}", 0, "s1"], rpy = ["pi/2", 0, {self.number()}] }}')
            axis = self.pick("axis x", "axis z", "axis given")
            if axis == "axis z":
                self.add("axis = [0, 0, 1]")
            elif axis == "axis given":
                self.add("axis = [0.48, -0.6, 0.64]")
        elif form == "matrix" and turns:
            c, s = f"cos({argument})", f"sin({argument})"
            self.add(f'matrix = [["{c}", 0, "{s}", "s2"], [0, 1, 0, "-{self.long(0.1, 0.5)}"],')
            self.add(f'    ["-{s}", 0, "{c}", 0], [0, 0, 0, 1]]')
        elif form == "matrix":
            self.add(f'matrix = [[1, 0, 0, "{self.long()}"], [0, 0, -1, "{argument}"], [0, 1, 0, "s1"], [0, 0, 0, 1]]')
        else:
            motion = self.random.choice("xyz")
            kind = "R" if turns else "T"
            self.add(f'transform = "Ty(s{i % 3}) {kind}{motion}({argument}) Rx({self.angle([], 0)}) Tz({self.long()})"')

    def load(self, k):
        """The first hangs on the last frame, so that it acts on every beam; the second anywhere, so that it may stand beside one."""
        self.add("", "[[load]]", f'name = "load {k}"')
        if k == 0:
            at_tool = self.pick("load at a point", "load at the tool") == "load at the tool"
            self.add(f'frame = "{self.frames[-1]}"', 'mass = "payload"')
            self.add('point = "tool"' if at_tool else f'point = ["{self.long()}", "{self.long()}", {self.number(-0.2, 0.2)}]')
            return
        frame = self.random.choice(self.frames)
        self.add(f'frame = "{frame}"', f"point = [{', '.join(f'{self.quoted(self.long(-0.4, 0.2))}' for _ in range(3))}]")
        form = self.pick("mass", "force", "force and moment")
        if form == "mass":
            mass = self.of_size(1.5, {"kg": 1, "g": 1e-3, "lb": 0.45359237, "t": 1000})
            self.add(f'mass = "2*payload + {mass}"')
            return
        self.add(f'force = ["{self.number(-30, 30)} N", "{self.number()} kN", "10 N * approach"]')
        if form == "force and moment":
            self.add(f'moment = [0, "{self.number(-9, 9)} N*m", "{self.number(-900, 900)} N*mm"]')
        axes = self.pick("axes given", "axes default")
        if axes == "axes given":
            self.add(f'axes = "{self.random.choice(["base", "frame"])}"')

    def quoted(self, text):
        return f'"{text}"'

    # Sources.

    def source(self, k):
        begin = len(self.lines)
        self.one_source(k)
        # Random errors that are all negative are refused: a half-width has no sign.
        if not {'class = "random"', 'class = "tolerance"'}.isdisjoint(self.lines[begin:]):
            stated = [i for i in range(begin, len(self.lines)) if re.match(r"(e_.|error|dh) = ", self.lines[i])]
            for first in stated[:1]:
                self.lines[first] = re.sub(r'"-?([\d.e-]+ \w+)[^"]*"', r'"\1"', self.lines[first], count=1)

    def one_source(self, k):
        form = self.pick(*SOURCES)
        self.add("", "[[source]]", f'name = "source {k}"')
        if form in ("uniform", "normal", "triangular", "arcsine"):
            unknown = "tolerance" if self.seed % 3 == 0 else "random"
            self.add(f'class = "{unknown}"', f'distribution = "{form}"')
            if form == "normal" and self.seed % 2:
                self.used.add("estimated")
                self.add(f"degrees_of_freedom = {4 + self.seed % 9}")
        elif form == "random effects":
            self.add('class = "random"', f'distribution = "{self.pick("uniform", "normal", "triangular", "arcsine")}"')
        elif form in ("joint", "parameter", "dh source", "joint effects", "at", "beam") and self.random.random() < 0.4:
            self.add('class = "random"', f'distribution = "{self.pick("uniform", "normal", "triangular", "arcsine")}"')
        else:
            self.add('class = "repeatable"')
        if form == "magnitude":
            freedom = ", degrees_of_freedom = 6" if self.seed % 2 else ""
            self.used.add("estimated magnitude" if freedom else "magnitude known")
            self.add(f"magnitude = {{ value = {self.number()}, standard_deviation = 0.2{freedom} }}")
        if form == "disabled":
            self.add("enabled = false")
        if "effects" in form:
            for frame in self.random.sample(self.frames, 2):
                self.add("[[source.effect]]", f'frame = "{frame}"')
                self.errors()
                if self.random.random() < 0.4:
                    self.place()
            return
        if form == "dh source" and self.dh:
            # Rather of a kind whose errors no spec has yet.
            kind, name = min(self.dh, key=lambda frame: (f"errors of {frame[0]}" in self.used, self.random.random()))
            self.used.add(f"errors of {kind}")
            sizes = {key: f"{self.number()} {'mm' if key in 'da' else 'mrad'}" for key in ("theta", "d", "a", "alpha")}
            some = self.random.sample(sorted(sizes), self.random.randint(1, 4))
            errors = ", ".join(f'{key} = "{sizes[key]} * ({self.plain(self.names())})"' for key in some)
            self.add(f'frame = "{name}"', f"dh = {{ {errors} }}")
            return
        if form == "joint effects":
            for variable, _, _ in self.variables[:2]:
                unit = "mrad" if variable[0] == "q" else "mm"
                self.add("[[source.effect]]", f'joint = "{variable}"', f'error = "{self.number()} {unit}"')
            self.add("[[source.effect]]", f'parameter = "{self.in_the_chain[0]}"', f'error = "{self.number()} mm"')
            self.add("[[source.effect]]", f'frame = "{self.frames[0]}"')
            self.errors()
            return
        if form in ("joint", "dh source"):
            variable, _, _ = self.random.choice(self.variables)
            size = f"{self.number()} mrad" if variable.startswith("q") else f"{self.number()} mm"
            self.add(f'joint = "{variable}"', f'error = "{size} * ({self.plain(self.names())})"')
            return
        if form == "parameter":
            self.add(f'parameter = "{self.random.choice(self.in_the_chain)}"', f'error = "{self.number()} mm"')
            return
        frame = self.random.choice(self.frames)
        if form.startswith(("beam", "compliance")):
            # The first load hangs on the last frame: it acts on every beam.
            self.add(f'frame = "{frame}"')
            if form in ("beam at", "compliance at"):
                self.place()
            self.elastic(form)
            return
        self.add(f'frame = "{frame}"')
        self.errors()
        if form == "at":
            self.place()

    def place(self):
        self.used.add("at")
        self.add(f'at = "Ty({self.long()}) Rz({self.angle(self.names())}) Tx({self.length_of(self.names())})"')

    def errors(self):
        for component in self.random.sample(["e_x", "e_y", "e_z", "e_s", "e_r", "e_p"], self.random.randint(1, 4)):
            size = f"{self.number()} mm" if component in ("e_x", "e_y", "e_z") else f"{self.number()} mrad"
            factors = ["", f" * {self.plain(self.names())}", " * approach", " * warmth * 0.1/K", " * 60 %", " * warmth * 8e4 ppm/K"]
            factor = self.random.choice(factors)
            self.add(f'{component} = "{size}{factor}"')

    @staticmethod
    def bending(axis):
        """Both bending stiffnesses of a beam, named by the axes that follow its own."""
        first, second = {"beam y": "zx", "beam z": "xy"}.get(axis, "yz")
        return [f'EI_{first} = "EI"', f'EI_{second} = "0.7*EI"']

    def elastic(self, form):
        if form.startswith("beam"):
            axis = self.pick("beam x", "beam y", "beam z", "beam default")
            parts = [f'length = "{self.random.choice(["s0", "s1", "0.45 m"])}"', *self.bending(axis)]
            if self.random.random() < 0.7:
                parts.append('GJ = "GJ"')
            if form != "beam without EA":
                parts.append('EA = "8e6 N"')
            if self.pick("weightless", "mass per length") == "mass per length":
                parts.append(f'mass_per_length = "{self.number(1, 30)} kg/m"')
            if axis != "beam default":
                parts.append(f'axis = "{axis[-1]}"')
            self.add(f"beam = {{ {', '.join(parts)} }}")
        elif form != "compliance matrix":
            self.add('compliance = { diagonal = ["1e-6 m/N", "2e-4 mm/N", 0, "3e-6 rad/(N*m)", "1e-9/(N*mm)", 0] }')
        else:
            self.add("compliance = { matrix = [")
            for i in range(6):
                row = []
                for j in range(6):
                    unit = {2: "m/N", 1: "rad/N", 0: "rad/(N*m)"}[(i < 3) + (j < 3)]
                    row.append(f'"{(3.0 if i == j else 0.1 + 0.05 * abs(i - j)) * 1e-6:.6g} {unit}"')
                self.add(f"    [{', '.join(row)}],")
            self.add("] }")

    # Where to look.

    def everything(self, folder):
        """The spec, some configurations, and a study's workspace with what that means."""
        text = self.spec(folder)
        self.used |= {form for form in (*FUNCTIONS, *UNITS) if re.search(rf"(?<![\w.]){re.escape(form)}(?!\w)", text)}
        places = self.configurations(25)
        return text, places, *self.workspace([dict(place) for place in places], folder)

    def configurations(self, count):
        """Values of all variables, in coherent units."""
        return [{name: self.random.uniform(low, high) for name, low, high in self.variables} for _ in range(count)]

    def workspace(self, configurations, folder):
        """What a study says of where to look, and the configurations (with inputs) that it means."""
        form, inputs = self.pick("path", "grid"), self.pick("inputs set", "inputs crossed", "inputs at both ends", "inputs beside")
        names = [name for name, _, _ in self.variables]
        if inputs == "inputs crossed":
            configurations, crossed = configurations[:6], {"payload": [0.5, 4.0], "warmth": [-3.0, 0.0, 10.0], "approach": [1.0]}
            text = f'[workspace.inputs]\npayload = ["500 g", "4 kg"]\nwarmth = ["-3 K", "0 K", "10 K"]\napproach = [1]\n'
        elif inputs == "inputs at both ends":
            configurations, crossed = configurations[:4], {"payload": [0.0, 7.5], "warmth": [-10.0, 10.0], "approach": [-1.0, 1.0]}
            text = ""
        else:
            crossed = {"payload": [6.25], "warmth": [-2.0], "approach": [-0.5]}
            text = '[study.set]\npayload = "6.25 kg"\nwarmth = "-2 K"\napproach = -0.5\n'
        if form == "path":
            if inputs == "inputs beside":
                # Of two inputs the file has a column; the third is set.
                text = "[study.set]\nwarmth = \"-2 K\"\n"
                del crossed["payload"], crossed["approach"]
                names += ["payload", "approach"]
                for k, place in enumerate(configurations):
                    place |= {"payload": 0.3 * k, "approach": self.random.uniform(-1, 1)}
            units = {"q": "rad", "d": self.length}
            columns = [f"{name} ({units[name[0]]})" if name[0] in units else {"payload": "payload (kg)"}.get(name, name) for name in names]
            rows = [",".join(repr(place[name]) for name in names) for place in configurations]
            (folder / f"path{self.seed}.csv").write_text("\n".join([",".join(columns), *rows]) + "\n")
            text += f'[workspace.path]\nfile = "path{self.seed}.csv"\n'
        else:
            # Two variables; the others stay at home.
            (one, low, high), (two, _, end) = self.variables[:2]
            count = len(configurations) // 3 + 1
            text += f"[workspace.grid]\n{one} = {{ from = {low!r}, to = {high!r}, count = {count} }}\n{two} = [0.2, {end!r}, 0.1]\n"
            values = [low + (high - low) * k / (count - 1) for k in range(count)]
            configurations = [{one: x, two: y} for x in values for y in (0.2, end, 0.1)]
            if inputs == "inputs beside":
                del crossed["payload"]
                text = text.replace('payload = "6.25 kg"\n', "") + 'payload = ["0 kg", "7 kg"]\n'
                configurations = [{**place, "payload": mass} for place in configurations for mass in (0.0, 7.0)]
        fixed = {name: values[0] for name, values in crossed.items()} if "[study.set]" in text else {}
        combinations = itertools.product(*crossed.values())
        return text, [{**place, **dict(zip(crossed, values))} for values in combinations for place in configurations], fixed
