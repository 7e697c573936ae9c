"""The smallest sphere around points: it stands on two, three or four of them (Welzl)."""

import itertools
import math

from presented import linear_solution


def centre_through(points):
    """Of the smallest sphere through up to four points; None if they are on a line, say."""
    origin, *rest = points
    edges = [[x - o for x, o in zip(p, origin)] for p in rest]
    # The centre is origin + sum c_k edge_k with 2 edge_j . centre = edge_j . edge_j.
    gram = [[2 * dot(a, b) for a in edges] for b in edges]
    count = len(edges)
    padded = [[gram[i][j] if i < count and j < count else float(i == j) for i in range(3)] for j in range(3)]
    right = [dot(edge, edge) for edge in edges] + [0.0] * (3 - count)
    try:
        shares = linear_solution(padded, right)
    except ZeroDivisionError:
        return None
    offset = [sum(share * edge[k] for share, edge in zip(shares, edges)) for k in range(3)]
    return [o + x for o, x in zip(origin, offset)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def distance(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)))


def smallest(points):
    """The smallest sphere around five points at most: its radius, its centre, and those on which it stands."""
    best = None
    for count in range(1, min(len(points), 4) + 1):
        for chosen in itertools.combinations(points, count):
            centre = centre_through(chosen)
            if centre:
                # All points, whatever rounding does where they are nearly in line.
                radius = max(distance(centre, p) for p in points)
                if best is None or radius < best[0] * (1 - 1e-14):
                    best = radius, centre, list(chosen)
    return best


def enclosing(points):
    """Centre and radius: the farthest point joins those that the sphere stands on until none is outside."""
    radius, centre, support = smallest(points[:1])
    rounding = 1e-15 * max(abs(x) for p in points for x in p)
    for _ in range(1000):
        far = max(points, key=lambda p: distance(p, centre))
        if distance(far, centre) <= radius * (1 + 1e-13) + rounding or far in support:
            return centre, distance(far, centre)
        radius, centre, support = smallest([*support, far])
    raise ArithmeticError("no enclosing sphere")
