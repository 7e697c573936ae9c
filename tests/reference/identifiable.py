"""How many generalized errors measurements can tell apart: the rank of error Jacobians under each other."""

import math

from dual import Dual
from kinematics import Configuration
from rigid import error


def ranks(spec, places, base):
    """Of poses and of points, by Gram-Schmidt with the largest column next; `base` adds errors of F_0 itself."""
    columns = None
    for names in places:
        configuration = Configuration(spec, names)
        here = configuration.error_jacobian()
        if base:
            for k in range(6):
                moved = error([Dual(0.0, 1.0) if j == k else 0.0 for j in range(6)])
                here.append(configuration.rows([moved, *configuration.nominal]))
        columns = [a + b for a, b in zip(columns, here)] if columns else here
    points = [[x for i, x in enumerate(column) if i % 6 < 3] for column in columns]
    return rank(columns), rank(points)


def rank(columns):
    columns = [column for column in map(normalized, columns) if column]
    count = 0
    while columns:
        longest = max(columns, key=length)
        if length(longest) < 1e-7:
            break
        count += 1
        along = normalized(longest)
        columns = [
            [x - share * a for x, a in zip(column, along)]
            for column in columns
            for share in [sum(x * a for x, a in zip(column, along))]
        ]
    return count


def length(column):
    return math.sqrt(sum(x * x for x in column))


def normalized(column):
    size = length(column)
    return [x / size for x in column] if size > 1e-12 else None
