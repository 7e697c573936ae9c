"""All errors drawn on the exact chain with true rotations, at one configuration; every number with its standard error."""

import math
import random

from kinematics import exact_position

DRAWS = {
    "uniform": lambda r: r.uniform(-1, 1),
    "normal": lambda r: r.gauss(0, 1),
    "triangular": lambda r: r.triangular(-1, 1),
    "arcsine": lambda r: math.sin(r.uniform(-math.pi, math.pi)),
}


def draws(configuration, sources, count, seed):
    """Errors of the tool point, repeatable sources included."""
    generator = random.Random(seed)
    ideal = exact_position(configuration, [])
    errors = []
    for _ in range(count):
        drawn = [(s, 1.0 if s.repeatable else DRAWS[s.distribution](generator)) for s in sources]
        errors.append([x - y for x, y in zip(exact_position(configuration, drawn), ideal)])
    return errors


def summary(errors, probabilities):
    """Mean and covariance, quantiles of the norm, each with its standard error."""
    n = len(errors)
    mean = [sum(e[i] for e in errors) / n for i in range(3)]
    centred = [[x - m for x, m in zip(e, mean)] for e in errors]
    covariance = [[sum(c[i] * c[j] for c in centred) / n for j in range(3)] for i in range(3)]
    spread = [
        [math.sqrt(sum((c[i] * c[j] - covariance[i][j]) ** 2 for c in centred)) / n for j in range(3)]
        for i in range(3)
    ]
    norms = sorted(math.sqrt(sum(x * x for x in e)) for e in errors)
    quantiles = []
    for p in probabilities:
        # The standard error of an order statistic, from those that stand one standard deviation of its rank away.
        away = math.sqrt(n * p * (1 - p))
        low, high = (norms[min(max(round(n * p + side * away), 0), n - 1)] for side in (-1, 1))
        quantiles.append((norms[min(int(n * p), n - 1)], (high - low) / 2))
    return {
        "mean": mean,
        "mean_error": [math.sqrt(covariance[i][i] / n) for i in range(3)],
        "covariance": covariance,
        "covariance_error": spread,
        "quantiles": quantiles,
    }
