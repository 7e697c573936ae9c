"""Random specs that together use every form of the language, each with configurations to look at."""

import math
import random

# Forms that the command does not have yet.
MISSING = {"joint", "parameter", "dh source", "triangular", "arcsine", "new functions", "new units", "table", "located exactly"}

FRAME_FORMS = ["product", "matrix", "dh", "mdh", "origin", "fixed", "fixed origin", "coupled"]
SOURCE_FORMS = [
    "repeatable", "uniform", "normal", "effects", "random effects", "at", "beam", "beam at", "compliance", "compliance matrix",
    "disabled", "beam without EA",
    "joint", "parameter", "dh source", "triangular", "arcsine",
]  # fmt: skip


class Writer:
    """Writes one spec. What it writes is typed: angles, lengths, plain numbers; `used` are the forms it took."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.used = set()
        self.seed = seed
        self.length = ["mm", "m"][seed % 2]
        self.scale = 1000.0 if self.length == "mm" else 1.0
        self.variables, self.lines = [], []
        self.frames = []
        self.parameters = {}

    def pick(self, *choices):
        choice = self.random.choice([c for c in choices if c not in MISSING])
        self.used.add(choice)
        return choice

    def number(self, low=-1.0, high=1.0):
        return f"{self.random.uniform(low, high):.6g}"

    def long(self, low=-0.6, high=0.6):
        """A length in metres, in a unit of the spec's choice."""
        metres = self.random.uniform(low, high)
        return self.random.choice([f"{metres:.6g} m", f"{metres * 1000:.6g} mm", f"{metres * 1e6:.7g} um"])

    # Expressions over the variables that may stand there.

    def angle(self, names, depth=1):
        turns = [name for name in names if name.startswith("q")]
        options = [f"{self.number(-180, 180)} deg", f"{self.number(-900, 900)} mrad", self.number(), "pi/4"]
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
                f"exp(-({length}/({self.long(0.4, 0.9)}))^2)" if "new functions" not in MISSING else x,
                f"max({x}, {y})" if "new functions" not in MISSING else y,
                f"min({x}, sin({angle}))" if "new functions" not in MISSING else y,
                f"sign({x})*log(2 + ({y})^2)" if "new functions" not in MISSING else y,
            ]
        )

    # The file.

    def add(self, *lines):
        self.lines += lines

    def spec(self):
        turn = self.random
        orientation = self.pick("rotation-vector", "euler-yzx")
        self.add("[manipulator]", f'name = "random{self.seed}"', f'length = "{self.length}"')
        if orientation == "euler-yzx" or turn.random() < 0.5:
            self.add(f'orientation = "{orientation}"')
        self.add('gravity = ["0.3 m/s^2", "-1.1 m/s^2", "-9.7 m/s^2"]')
        self.add("[parameters]")
        for k in range(3):
            self.parameters[f"s{k}"] = self.random.uniform(0.1, 0.6)
            self.add(f's{k} = {{ value = "{self.parameters[f"s{k}"] * 1000:.9g} mm" }}')
        self.add(f'EI = {{ value = "{self.number(1e4, 9e4)} N*m^2" }}', f'GJ = {{ value = "{self.number(1e4, 9e4)} N*m^2" }}')
        self.add("[inputs]", 'payload = { value = "2.5 kg", range = ["0 kg", "7500 g"] }')
        self.add('warmth = { value = "3 K", range = ["-10 K", "10 K"] }', "approach = { value = 1, range = [-1, 1] }")
        count = turn.randint(3, 6)
        moving = turn.sample(range(count), turn.randint(2, count))
        for i in range(count):
            self.frame(i, i in moving)
        tool = self.pick("no tool", "tool product", "tool matrix")
        if tool == "tool product":
            self.add("[tool]", f'transform = "Tx({self.long()}) Ry({self.angle([], 0)}) Tz(s1) Ty({self.long()})"')
        elif tool == "tool matrix":
            self.add("[tool]", f'matrix = [[0, -1, 0, "{self.long()}"], [1, 0, 0, "s2"], [0, 0, 1, 0.1], [0, 0, 0, 1]]')
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
            low, high = self.random.uniform(-2.5, -0.2), self.random.uniform(0.2, 2.5)
            limits = f'"{math.degrees(low):.6g} deg", {high:.6g}'
            low = math.radians(float(f"{math.degrees(low):.6g}"))
        else:
            low, high = self.random.uniform(-0.5, 0.1), self.random.uniform(0.3, 0.9)
            limits = f'"{low:.6g} m", "{high * 1000:.6g} mm"'
            low, high = low * self.scale, high * self.scale
        low, high = float(f"{low:.6g}"), float(f"{high:.6g}")
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
            self.used.add("really coupled")
        else:
            argument = self.random.choice([variable, f"-{variable} + {self.angle([], 0) if turns else self.long()}"])
        if form in ("dh", "mdh"):
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
        frame = self.frames[-1] if k == 0 else self.random.choice(self.frames)
        mass = "payload" if k == 0 else "2*payload + 1.5 kg"
        point = f'["{self.long()}", "{self.long()}", {self.number(-0.2, 0.2)}]'
        self.add("", "[[load]]", f'name = "load {k}"', f'mass = "{mass}"', f'frame = "{frame}"', f"point = {point}")

    # Sources.

    def source(self, k):
        form = self.pick(*SOURCE_FORMS)
        self.add("", "[[source]]", f'name = "source {k}"')
        if form in ("uniform", "normal", "triangular", "arcsine"):
            self.add('class = "random"', f'distribution = "{form}"')
        elif form == "random effects":
            self.add('class = "random"', f'distribution = "{self.pick("uniform", "normal", "triangular", "arcsine")}"')
        elif form in ("joint", "parameter", "dh source") and self.random.random() < 0.5:
            self.add('class = "random"', f'distribution = "{self.pick("uniform", "normal")}"')
        else:
            self.add('class = "repeatable"')
        if form == "disabled":
            self.add("enabled = false")
        if "effects" in form:
            for frame in self.random.sample(self.frames, 2):
                self.add("[[source.effect]]", f'frame = "{frame}"')
                self.errors()
                if self.random.random() < 0.4:
                    self.place()
            return
        if form == "joint":
            variable, _, _ = self.random.choice(self.variables)
            size = f"{self.number()} mrad" if variable.startswith("q") else f"{self.number()} mm"
            self.add(f'joint = "{variable}"', f'error = "{size} * ({self.plain(self.names())})"')
            return
        if form == "parameter":
            self.add(f'parameter = "s{self.random.randrange(3)}"', f'error = "{self.number()} mm"')
            return
        frame = self.random.choice(self.frames)
        if form.startswith(("beam", "compliance")):
            # The first load hangs on the last frame: it acts on every beam.
            self.add(f'frame = "{frame}"')
            if form == "beam at":
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
            factor = self.random.choice(["", f" * {self.plain(self.names())}", " * approach", " * warmth * 0.1/K"])
            self.add(f'{component} = "{size}{factor}"')

    def elastic(self, form):
        if form.startswith("beam"):
            axis = self.pick("beam x", "beam y", "beam z", "beam default")
            parts = [f'length = "{self.random.choice(["s0", "s1", "0.45 m"])}"', 'EI_y = "EI"', 'EI_z = "0.7*EI"']
            if self.random.random() < 0.7:
                parts.append('GJ = "GJ"')
            if form != "beam without EA":
                parts.append('EA = "8e6 N"')
            if axis != "beam default":
                parts.append(f'axis = "{axis[-1]}"')
            self.add(f"beam = {{ {', '.join(parts)} }}")
        elif form == "compliance":
            self.add('compliance = { diagonal = ["1e-6 m/N", "2e-4 mm/N", 0, "3e-6 rad/(N*m)", "1e-9 1/(N*mm)", 0] }'.replace("1e-9 1/(N*mm)", "1e-9/(N*mm)"))
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

    def configurations(self, count):
        """Values of all variables, in coherent units."""
        return [{name: self.random.uniform(low, high) for name, low, high in self.variables} for _ in range(count)]

    def workspace(self, configurations, folder):
        """What a study says of where to look, and the configurations that it means."""
        if self.pick("path", "grid") == "path":
            units = [f"{name} ({'rad' if name[0] == 'q' else self.length})" for name, _, _ in self.variables]
            rows = [",".join(repr(value) for value in place.values()) for place in configurations]
            (folder / f"path{self.seed}.csv").write_text("\n".join([",".join(units), *rows]) + "\n")
            return f'[workspace.path]\nfile = "path{self.seed}.csv"\n', configurations
        # Two variables; the others stay at home.
        (one, low, high), (two, _, end) = self.variables[:2]
        values = [low + (high - low) * k / 4 for k in range(5)]
        text = f"[workspace.grid]\n{one} = {{ from = {low!r}, to = {high!r}, count = 5 }}\n{two} = [0.2, {end!r}, 0.1]\n"
        return text, [{one: x, two: y} for x in values for y in (0.2, end, 0.1)]
