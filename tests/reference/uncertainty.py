"""The uncertainty budget of the GUM at one configuration, and how likely a tolerance is met there."""

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

    def freedom(self):
        """Effective degrees of freedom: of the rows by the formula of Welch and Satterthwaite, of the norm their harmonic mean.

        For the norm what a source does along a principal axis counts more where that axis is long."""
        values, axes = eigenvectors(self.covariance)
        weights = [1 + (K * K - 1) * value / values[2] for value in values]
        squares = []
        for u in self.standard:
            along = [sum(a * b for a, b in zip(axis, u)) for axis in axes]
            squares.append([x * x for x in u] + [sum(w * x * x for w, x in zip(weights, along))])
        freedoms = [source.freedom for source, _ in self.random]
        effective = []
        for column in zip(*squares):
            total, power = sum(column), 2 if len(effective) < 3 else 1
            few = [(x / total, freedom) for x, freedom in zip(column, freedoms) if total and freedom < math.inf]
            inverse = sum(share**power / freedom for share, freedom in few)
            effective.append(1 / inverse if inverse > 0 else math.inf)
        return effective

    def factors(self):
        """k of the rows, from Student's t, and of the norm, from a vector of it."""
        freedoms = self.freedom()
        line = [[1.0, 0.0, 0.0], [0.0] * 3, [0.0] * 3]
        rows = [K if freedom == math.inf else quantile(COVERAGE, line, freedom) for freedom in freedoms[:3]]
        return rows + [quantile(COVERAGE, self.covariance, freedoms[3]) / math.sqrt(self.total)]

    def expanded(self):
        """U = k u."""
        return [k * u for k, u in zip(self.factors(), self.combined())]

    def is_normal(self):
        return all(s.distribution == "normal" and s.freedom == math.inf for s, _ in self.random)

    def is_bounded(self):
        return all(s.distribution != "normal" for s, _ in self.random)

    def worst_case(self):
        """The largest norm over all signs, by trying them: at the bounds, three standard deviations of normal sources."""
        sums = [self.bias]
        for source, move in self.random:
            size = 3.0 if source.distribution == "normal" else 1.0
            sums = [[x + sign * size * y for x, y in zip(total, move)] for total in sums for sign in (1, -1)]
        return max(map(norm, sums))

    def probability(self, tolerance, count, seed):
        """That the error is within a tolerance, bias and all, and from how many draws that is: none if it is computed."""
        if self.is_normal():
            return probability_within(tolerance, self.bias, self.covariance), None
        return self.share_within(tolerance, self.bias, count, seed), count

    def shares(self):
        return [norm(u) ** 2 / self.total for u in self.standard]

    def draw(self, generator):
        return [sum(m * move[i] for m, (_, move) in drawn) for drawn in [self.magnitudes(generator)] for i in range(3)]

    def magnitudes(self, generator):
        return [(draw(s, generator), (s, move)) for s, move in self.random]

    def share_within(self, radius, bias, count, seed):
        """The share of draws whose norm is within the radius."""
        generator = random.Random(seed)
        inside = 0
        for _ in range(count):
            x = [a + b for a, b in zip(bias, self.draw(generator))]
            inside += norm(x) <= radius
        return inside / count


def draw(source, generator):
    """Of magnitude 1; after Student's t if the standard deviation was estimated from few measurements."""
    drawn = DRAWS[source.distribution](generator)
    if source.freedom == math.inf:
        return drawn
    return drawn / math.sqrt(generator.gammavariate(source.freedom / 2, 2 / source.freedom))


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
