"""What sources do alone and together over a workspace: the figures of section 5 of the paper."""

import math

from kinematics import Configuration, exact_position
from uncertainty import DEVIATION, Uncertainty, norm

# What the first-order bound of a random source is: its half-width, or three standard deviations.
BOUND = {"uniform": 1.0, "normal": 3.0, "triangular": 1.0, "arcsine": 1.0}


def bound(source):
    return 1.0 if source.repeatable else BOUND[source.distribution]


class Sweep:
    """Displacements (six rows) of every enabled source at every configuration, and at home."""

    def __init__(self, spec, configurations, home):
        self.spec = spec
        self.sources = [source for source in spec.sources if source.enabled]
        self.places = [Configuration(spec, names) for names in configurations]
        self.moves = [self.moves_at(place) for place in self.places]
        self.home_names = home
        at_home = Configuration(spec, home)
        self.home = self.moves_at(at_home)

    def moves_at(self, configuration):
        return [configuration.displacement(source) for source in self.sources]

    def uncertainty(self, row, first=0):
        """The budget of the GUM of three rows from `first` on, where sources move the tool like this."""
        return Uncertainty([(source, move[first : first + 3]) for source, move in zip(self.sources, row)])

    def alone(self, k, first=0):
        """One source over the workspace: of the position, or from row 3 on of the orientation."""
        source = self.sources[k]
        points = [[bound(source) * x for x in row[k][first : first + 3]] for row in self.moves]
        home = [bound(source) * x for x in self.home[k][first : first + 3]]
        # The sign of a random error is not known, neither here nor at home.
        homes = [home] if source.repeatable else [home, [-x for x in home]]
        spread = points if source.repeatable else points + [[-x for x in p] for p in points]
        halves = {axis: half_spread([p[i] for p in spread]) for i, axis in enumerate("xyz")}
        return {
            "plain_max": per_axis(points),
            "half_peak_to_peak": {**halves, "norm": norm(list(halves.values())) if source.repeatable else max(map(norm, points))},
            "relative_to_home": per_axis([[a - b for a, b in zip(p, h)] for p in points for h in homes]),
        }

    def sums(self, row, first=0):
        """Repeatable sources added, random ones as root sum of squares of bounds and of standard deviations, and the worst signs."""
        repeatable, squares, variances, worst = ([0.0] * 3 for _ in range(4))
        for source, move in zip(self.sources, row):
            for i, x in enumerate(move[first : first + 3]):
                if source.repeatable:
                    repeatable[i] += x
                else:
                    worst[i] += abs(bound(source) * x)
                    squares[i] += (bound(source) * x) ** 2
                    variances[i] += (DEVIATION[source.distribution] * x) ** 2
        worst = [abs(x) + y for x, y in zip(repeatable, worst)]
        return repeatable, [math.sqrt(x) for x in squares], [math.sqrt(x) for x in variances], worst

    def combined(self, first=0):
        repeatable, random, standard, worst = zip(*(self.sums(row, first) for row in self.moves))
        both = [norm(a) + norm(b) for a, b in zip(repeatable, random)]
        return {
            "repeatable_radius": max(map(norm, repeatable)),
            "random_radius": max(map(norm, random)),
            "radius": max(both),
            "repeatable": largest_entries(repeatable),
            "random": largest_entries(random),
            "standard_deviation": largest_entries(standard),
            "standard_radius": max(map(norm, standard)),
            "rms": {
                "repeatable": root_mean_square(map(norm, repeatable)),
                "random": root_mean_square(map(norm, random)),
                "both": root_mean_square(both),
            },
            "worst_case": largest_entries(worst),
            "worst_case_radius": max(self.uncertainty(row, first).worst_case() for row in self.moves),
        }

    def largest_remainder(self):
        """What first order leaves on the exact chain at most: of all sources, the random ones at their bounds with signs that add."""
        largest = 0.0
        for place, row in zip(self.places, self.moves):
            moves = [(s, [bound(s) * x for x in move[:3]]) for s, move in zip(self.sources, row)]
            first_order = [sum(x) for x in zip([0.0] * 3, *(move for s, move in moves if s.repeatable))]
            magnitudes = [(s, bound(s)) for s in self.sources if s.repeatable]
            for source, move in [(s, move) for s, move in moves if not s.repeatable]:
                along = sum(a * b for a, b in zip(first_order, move))
                sign = -1.0 if along < -1e-9 * norm(first_order) * norm(move) else 1.0
                magnitudes.append((source, sign * bound(source)))
                first_order = [a + sign * b for a, b in zip(first_order, move)]
            # In the order of the spec, which matters in the exact chain.
            magnitudes.sort(key=lambda one: self.sources.index(one[0]))
            ideal, real = exact_position(place, []), exact_position(place, magnitudes)
            largest = max(largest, norm([r - i - f for r, i, f in zip(real, ideal, first_order)]))
        return largest


def per_axis(points):
    figures = {axis: max(abs(p[i]) for p in points) for i, axis in enumerate("xyz")}
    return {**figures, "norm": max(norm(p) for p in points)}


def half_spread(numbers):
    return (max(numbers) - min(numbers)) / 2


def largest_entries(rows):
    return [max(abs(row[i]) for row in rows) for i in range(3)]


def root_mean_square(numbers):
    numbers = list(numbers)
    return math.sqrt(sum(x * x for x in numbers) / len(numbers))
