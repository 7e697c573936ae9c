"""What sources do alone and together over a workspace: the figures of section 5 of the paper."""

import math

from kinematics import Configuration, exact_position

# What the first-order bound of a random source is: its half-width, or three standard deviations.
BOUND = {"uniform": 1.0, "normal": 3.0, "triangular": 1.0, "arcsine": 1.0}
# Standard deviation of a source whose value is 1.
DEVIATION = {"uniform": 1 / math.sqrt(3), "normal": 1.0, "triangular": 1 / math.sqrt(6), "arcsine": 1 / math.sqrt(2)}


def norm(v):
    return math.sqrt(sum(x * x for x in v))


def bound(source):
    return 1.0 if source.repeatable else BOUND[source.distribution]


class Sweep:
    """Displacements (six rows) of every enabled source at every configuration, and at home."""

    def __init__(self, spec, configurations, home):
        self.spec = spec
        self.sources = [source for source in spec.sources if source.enabled]
        self.places = [Configuration(spec, names) for names in configurations]
        self.moves = [[place.displacement(source) for source in self.sources] for place in self.places]
        at_home = Configuration(spec, home)
        self.home = [at_home.displacement(source) for source in self.sources]

    def alone(self, k):
        source = self.sources[k]
        scale = bound(source)
        moves = [[scale * x for x in row[k]] for row in self.moves]
        home = [scale * x for x in self.home[k][:3]]
        points = [move[:3] for move in moves]
        # The sign of a random error is not known, neither here nor at home.
        homes = [home] if source.repeatable else [home, [-x for x in home]]
        spread = points if source.repeatable else points + [[-x for x in p] for p in points]
        return {
            "plain_max": per_axis(points),
            "half_peak_to_peak": {axis: half_spread([p[i] for p in spread]) for i, axis in enumerate("xyz")},
            "relative_to_home": per_axis([[a - b for a, b in zip(p, h)] for p in points for h in homes]),
            "orientation": [max(abs(move[3 + i]) for move in moves) for i in range(3)],
        }

    def sums(self, row):
        """Repeatable sources added, random ones as root sum of squares of bounds, at one configuration."""
        repeatable, squares, variances = [0.0] * 3, [0.0] * 3, [0.0] * 3
        for source, move in zip(self.sources, row):
            if source.repeatable:
                repeatable = [a + b for a, b in zip(repeatable, move)]
            else:
                squares = [a + (bound(source) * b) ** 2 for a, b in zip(squares, move)]
                variances = [a + (DEVIATION[source.distribution] * b) ** 2 for a, b in zip(variances, move)]
        return repeatable, [math.sqrt(x) for x in squares], [math.sqrt(x) for x in variances]

    def combined(self):
        rows = [self.sums(row) for row in self.moves]
        both = [norm(a) + norm(b) for a, b, _ in rows]
        return {
            "repeatable_radius": max(norm(a) for a, _, _ in rows),
            "random_radius": max(norm(b) for _, b, _ in rows),
            "radius": max(both),
            "repeatable": [max(abs(a[i]) for a, _, _ in rows) for i in range(3)],
            "random": [max(b[i] for _, b, _ in rows) for i in range(3)],
            "rms": {
                "repeatable": root_mean_square([norm(a) for a, _, _ in rows]),
                "random": root_mean_square([norm(b) for _, b, _ in rows]),
                "both": root_mean_square(both),
            },
            "standard_deviation": [max(c[i] for _, _, c in rows) for i in range(3)],
            "standard_radius": max(norm(c) for _, _, c in rows),
            "worst_case": [max(sum(abs(bound(s) * m[i]) for s, m in zip(self.sources, row)) for row in self.moves) for i in range(3)],
        }


    def largest_remainder(self):
        """What first order leaves of the repeatable sources on the exact chain, at most."""
        repeatable = [(source, 1.0) for source in self.sources if source.repeatable]
        largest = 0.0
        for place, row in zip(self.places, self.moves):
            ideal, real = exact_position(place, []), exact_position(place, repeatable)
            first_order = self.sums(row)[0]
            largest = max(largest, norm([r - i - f for r, i, f in zip(real, ideal, first_order)]))
        return largest


def per_axis(points):
    figures = {axis: max(abs(p[i]) for p in points) for i, axis in enumerate("xyz")}
    return {**figures, "norm": max(norm(p) for p in points)}


def half_spread(numbers):
    return (max(numbers) - min(numbers)) / 2


def root_mean_square(numbers):
    return math.sqrt(sum(x * x for x in numbers) / len(numbers))
