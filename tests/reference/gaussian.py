"""The norm of a Gaussian vector: X = s h(w), where s is chi distributed, w uniform on the unit sphere and h² = wᵀ C w.

So P(|X| <= r) is the mean over the sphere of the chi distribution at r / h(w), here by double exponential quadrature, which
is good for flat covariances too: its points crowd logarithmically at the ends.
"""

import math

ROOT2 = math.sqrt(2)


def incomplete_beta(a, b, x):
    """The share of a beta distribution below x, by its continued fraction; x is below its mean."""
    front = math.exp(a * math.log(x) + b * math.log1p(-x) + math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)) / a
    c, d, value = 1.0, 1 / (1 - (a + b) * x / (a + 1)), 1.0
    value = d
    for m in range(1, 10000):
        for numerator in (
            m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)),
        ):
            d, c = 1 / (1 + numerator * d), 1 + numerator / c
            value *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return front * value


def student(x, freedom):
    """The share of Student's t between -x and x."""
    inside, outside = x * x / (freedom + x * x), freedom / (freedom + x * x)
    if inside < 1 / (3 + freedom):
        return incomplete_beta(0.5, freedom / 2, inside) if x > 0 else 0.0
    return 1 - incomplete_beta(freedom / 2, 0.5, outside)


def student_chi(dimension, x, freedom):
    """Of a vector of Student's t: a standard Gaussian one over the root of a chi square over its degrees of freedom."""
    if dimension == 2:
        return -math.expm1(-freedom / 2 * math.log1p(x * x / freedom))
    if dimension == 1:
        return student(x, freedom)
    scale = math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2) - math.log(freedom * math.pi) / 2
    return student(x, freedom) - 2 * x * math.exp(scale - (freedom + 1) / 2 * math.log1p(x * x / freedom))


def chi(dimension, x, freedom=math.inf):
    """Distribution of the length of a standard Gaussian vector, or of one of Student's t."""
    if freedom < math.inf:
        return student_chi(dimension, x, freedom)
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


MANY = 1e5
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


def probability(radius, values, rule=FINE, freedom=math.inf):
    """That a Gaussian vector with these principal variances is no longer than the radius."""
    values = [value for value in values if value > 1e-15 * max(values)]
    if len(values) == 1:
        return chi(1, radius / math.sqrt(values[0]), freedom)
    if len(values) == 2:
        a, b = values
        return sum(w * chi(2, radius / math.sqrt(a * c + b * s), freedom) for c, s, w in rule.quarter)
    a, b, c = values
    total = 0.0
    # The height z on the sphere is uniform, so is the angle about it.
    for z, rest, weight in rule.line:
        flat = rest * (1 + z)
        total += weight * sum(
            w * chi(3, radius / math.sqrt(flat * (a * cc + b * ss) + c * z * z), freedom) for cc, ss, w in rule.quarter
        )
    return total


def quantile(p, covariance, freedom=math.inf):
    """The radius of the ball that holds the share p."""
    values, _ = eigenvectors(covariance)
    if values[2] == 0.0:
        return 0.0
    if MANY < freedom < math.inf:
        # In proportion to 1/freedom, to its square; the functions of student() lose digits here.
        normal = quantile(p, covariance)
        return normal + (quantile(p, covariance, MANY) - normal) * MANY / freedom
    low, high = 0.0, 10 * math.sqrt(sum(values))
    while probability(high, values, COARSE, freedom) < p:
        high *= 2
    below, above = -p, probability(high, values, COARSE, freedom) - p
    # Illinois: the secant through both ends, an end that stays counts half.
    for _ in range(100):
        middle = (low * above - high * below) / (above - below)
        error = probability(middle, values, COARSE, freedom) - p
        if abs(error) < 1e-12 or high - low < 1e-12 * high:
            break
        if error > 0:
            high, above, below = middle, error, below / 2
        else:
            low, below, above = middle, error, above / 2
    # A step of Newton's with the fine rule.
    ahead = probability(middle * (1 + 1e-5), values, FINE, freedom)
    here = probability(middle, values, FINE, freedom)
    return middle + (p - here) * middle * 1e-5 / (ahead - here)
