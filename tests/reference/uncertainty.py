"""The uncertainty budget of the GUM at one configuration, and how likely a tolerance is met there."""

import itertools
import math
import random

import gaussian
from gaussian import FINE, eigenvectors, quantile
from monte_carlo import DRAWS

# Standard deviation of a source whose value is 1.
DEVIATION = {"uniform": 1 / math.sqrt(3), "normal": 1.0, "triangular": 1 / math.sqrt(6), "arcsine": 1 / math.sqrt(2)}
COVERAGE = 0.95
K = 1.959963984540054  # half-width of 95 % of a standard normal variable


def norm(v):
    return math.sqrt(sum(x * x for x in v))


class Uncertainty:
    """Rows are x, y, z (or the three turns): sources are pairs of a source and its displacement at magnitude 1."""

    def __init__(self, moves):
        self.bias = [sum(move[i] for source, move in moves if source.repeatable) for i in range(3)]
        self.random = [(s, move) for s, move in moves if not s.repeatable and any(move)]
        self.standard = [[DEVIATION[s.distribution] * x for x in move] for s, move in self.random]
        self.covariance = [[sum(u[i] * u[j] for u in self.standard) for j in range(3)] for i in range(3)]
        self.total = sum(self.covariance[i][i] for i in range(3))

    def combined(self):
        """u along each row and of the norm."""
        return [math.sqrt(self.covariance[i][i]) for i in range(3)] + [math.sqrt(self.total)]

    def expanded(self):
        """U = k u: of the rows with k = 1.96, of the norm with the quantile of a normal vector."""
        return [K * u for u in self.combined()[:3]] + [quantile(COVERAGE, self.covariance)]

    def largest(self):
        """The largest error that bounded sources can make: at one of the corners of their box; none if one is not bounded."""
        if any(s.distribution == "normal" for s, _ in self.random):
            return None
        corners = itertools.product((-1, 1), repeat=len(self.random))
        errors = ([b + sum(sign * move[i] for sign, (_, move) in zip(signs, self.random)) for i, b in enumerate(self.bias)] for signs in corners)
        return max(map(norm, errors))

    def probability(self, tolerance, count, seed):
        """That the error is within a tolerance, bias and all, and how far that may be off."""
        if all(s.distribution == "normal" for s, _ in self.random):
            return probability_within(tolerance, self.bias, self.covariance), 0.0
        return self.share_within(tolerance, self.bias, count, seed)

    def shares(self):
        return [norm(u) ** 2 / self.total for u in self.standard]

    def draw(self, generator):
        return [sum(m * move[i] for m, (_, move) in drawn) for drawn in [self.magnitudes(generator)] for i in range(3)]

    def magnitudes(self, generator):
        return [(DRAWS[s.distribution](generator), (s, move)) for s, move in self.random]

    def share_within(self, radius, bias, count, seed):
        """The share of draws whose norm is within the radius, and its standard error."""
        generator = random.Random(seed)
        inside = 0
        for _ in range(count):
            x = [a + b for a, b in zip(bias, self.draw(generator))]
            inside += norm(x) <= radius
        p = inside / count
        return p, math.sqrt(max(p * (1 - p), 1 / count) / count)


def probability_within(radius, bias, covariance):
    """P(|b + X| <= r) of a normal vector X: along the widest principal axis by the error function, across by quadrature."""
    values, axes = eigenvectors(covariance)
    centre = [sum(a * b for a, b in zip(axis, bias)) for axis in axes]
    small = 1e-15 * max(values)
    deviations = [math.sqrt(value) if value > small else 0.0 for value in values]
    return slab(radius * radius, list(zip(centre, deviations)))


def slab(square, rest):
    """The share of the rest of the axes within what is left of the radius."""
    (centre, deviation), *others = rest
    if square <= 0:
        return 0.0
    reach = math.sqrt(square)
    if not others:
        if deviation == 0:
            return float(abs(centre) <= reach)
        ends = [(end - centre) / (deviation * gaussian.ROOT2) for end in (-reach, reach)]
        return (math.erf(ends[1]) - math.erf(ends[0])) / 2
    if deviation == 0:
        return slab(square - centre * centre, others) if abs(centre) < reach else 0.0
    low, high = max(-reach, centre - 9 * deviation), min(reach, centre + 9 * deviation)
    if low >= high:
        return 0.0
    total = 0.0
    for a, b, weight in FINE.line:
        x = low + (high - low) * a if a < b else high - (high - low) * b
        density = math.exp(-(((x - centre) / deviation) ** 2) / 2) / (deviation * math.sqrt(2 * math.pi))
        if density > 0:
            total += weight * (high - low) * density * slab((reach - x) * (reach + x), others)
    return total
