"""Numbers of the command beside numbers of this folder."""

import json
import math
import subprocess

TOLERANCE = 1e-9


class Refused(Exception):
    """The command took what it was given for a mistake."""


class Comparison:
    def __init__(self, command):
        self.command = command
        self.compared, self.failures, self.largest = 0, [], 0.0

    def abbe(self, *arguments):
        result = subprocess.run([self.command, *arguments, "--json"], capture_output=True, text=True)
        if result.returncode == 2 or not result.stdout:
            raise Refused(f"abbe {' '.join(arguments)}\n{result.stderr}")
        return json.loads(result.stdout)

    def attempt(self, question, *arguments):
        """Asks, and counts it as a failure if the command refuses."""
        try:
            return question(self, *arguments)
        except Refused as refused:
            self.failures.append(str(refused))

    def numbers(self, place, ours, theirs, size=0.0):
        """Numbers, or lists and tables of them: equal relative to the larger of themselves and a size."""
        if isinstance(ours, dict):
            for key, value in ours.items():
                self.numbers(f"{place}.{key}", value, theirs[key], size)
        elif isinstance(ours, (list, tuple)):
            if len(ours) != len(theirs):
                self.failures.append(f"{place}: {len(theirs)} entries, expected {len(ours)}")
            for i, (a, b) in enumerate(zip(ours, theirs)):
                self.numbers(f"{place}[{i}]", a, b, size)
        else:
            difference = abs(ours - theirs) / max(abs(ours), size, 1e-300)
            self.compared += 1
            self.largest = max(self.largest, difference)
            if not difference <= TOLERANCE:
                self.failures.append(f"{place}: {theirs!r}, expected {ours!r}")

    def optional(self, place, ours, theirs):
        """Numbers that may be missing on both sides."""
        for i, (a, b) in enumerate(zip(ours, theirs, strict=True)):
            if a is None or b is None:
                self.compared += 1
                if a is not b:
                    self.failures.append(f"{place}[{i}]: {b!r}, expected {a!r}")
            else:
                self.numbers(f"{place}[{i}]", a, b)

    def drawn(self, place, ours, theirs, standard_error, size):
        """Two numbers with chance in them; what does not vary is the same to rounding of its size."""
        self.compared += 1
        if not abs(ours - theirs) <= 3 * standard_error + TOLERANCE * size:
            self.failures.append(f"{place}: {theirs!r}, expected {ours!r} within 3 x {standard_error:.2g}")

    def share(self, place, ours, count, theirs, error):
        """A share of so many draws, or a computed probability, beside theirs with its standard error."""
        # That of ours if theirs is right: from ours itself it is too small where few draws lie outside.
        own = math.sqrt(max(theirs * (1 - theirs), 1 / count) / count) if count else 0.0
        self.drawn(place, ours, theirs, math.hypot(own, error), 1.0)
