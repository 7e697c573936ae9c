"""The norm of a Gaussian vector: X = s h(w), where s is chi distributed, w uniform on the unit sphere and h² = wᵀ C w.

So P(|X| <= r) is the mean over the sphere of the chi distribution at r / h(w), here by double exponential quadrature, which
is good for flat covariances too: its points crowd logarithmically at the ends.
"""

import math

ROOT2 = math.sqrt(2)


def chi(dimension, x):
    """Distribution of the length of a standard Gaussian vector."""
    if dimension == 1:
        return math.erf(x / ROOT2)
    if dimension == 2:
        return -math.expm1(-x * x / 2)
    return math.erf(x / ROOT2) - math.sqrt(2 / math.pi) * x * math.exp(-x * x / 2)


class Rule:
    """Points of [0, 1] with their distances from 1 and weights; and the squares of cosine and sine over a quarter turn."""

    def __init__(self, step, reach=3.4):
        self.line = []
        for k in range(-int(reach / step), int(reach / step) + 1):
            u = math.pi / 2 * math.sinh(k * step)
            weight = step * math.pi / 4 * math.cosh(k * step) / math.cosh(u) ** 2
            self.line.append((1 / (1 + math.exp(-2 * u)), 1 / (1 + math.exp(2 * u)), weight))
        turn = math.pi / 2
        self.quarter = [(math.sin(turn * b) ** 2, math.sin(turn * a) ** 2, w) for a, b, w in self.line]


COARSE, FINE = Rule(0.14), Rule(0.05)


def eigenvectors(c):
    """Of a symmetric 3 x 3 matrix, by Jacobi's rotations: values ascending, and the vector of each."""
    a = [list(row) for row in c]
    vectors = [[float(i == j) for j in range(3)] for i in range(3)]
    for _ in range(30):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if a[p][q] == 0.0:
                continue
            angle = 0.5 * math.atan2(2 * a[p][q], a[q][q] - a[p][p])
            c, s = math.cos(angle), math.sin(angle)
            for row in (*a, *vectors):
                row[p], row[q] = c * row[p] - s * row[q], s * row[p] + c * row[q]
            a[p], a[q] = [[c * x - s * y for x, y in zip(a[p], a[q])], [s * x + c * y for x, y in zip(a[p], a[q])]]
    pairs = sorted((max(a[k][k], 0.0), [row[k] for row in vectors]) for k in range(3))
    return [value for value, _ in pairs], [vector for _, vector in pairs]


def probability(radius, values, rule=FINE):
    """That a Gaussian vector with these principal variances is no longer than the radius."""
    values = [value for value in values if value > 1e-15 * max(values)]
    if len(values) == 1:
        return chi(1, radius / math.sqrt(values[0]))
    if len(values) == 2:
        a, b = values
        return sum(w * chi(2, radius / math.sqrt(a * c + b * s)) for c, s, w in rule.quarter)
    a, b, c = values
    total = 0.0
    # The height z on the sphere is uniform, so is the angle about it.
    for z, rest, weight in rule.line:
        flat = rest * (1 + z)
        total += weight * sum(
            w * chi(3, radius / math.sqrt(flat * (a * cc + b * ss) + c * z * z)) for cc, ss, w in rule.quarter
        )
    return total


def quantile(p, covariance):
    """The radius of the ball that holds the share p."""
    values, _ = eigenvectors(covariance)
    if values[2] == 0.0:
        return 0.0
    low, high = 0.0, 10 * math.sqrt(sum(values))
    below, above = -p, probability(high, values, COARSE) - p
    # Illinois: the secant through both ends, an end that stays counts half.
    for _ in range(100):
        middle = (low * above - high * below) / (above - below)
        error = probability(middle, values, COARSE) - p
        if abs(error) < 1e-12 or high - low < 1e-12 * high:
            break
        if error > 0:
            high, above, below = middle, error, below / 2
        else:
            low, below, above = middle, error, above / 2
    # A step of Newton's with the fine rule.
    ahead = probability(middle * (1 + 1e-5), values)
    here = probability(middle, values)
    return middle + (p - here) * middle * 1e-5 / (ahead - here)
