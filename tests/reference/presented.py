"""Tool points brought to a point of the room: joints by Newton's method, their Jacobian by dual numbers."""

import itertools

from dual import Dual
from kinematics import transforms
from rigid import chained, derivative


def solved(spec, names, solve, point):
    """The names with the joints `solve` such that the tool point is at `point`; None if that takes them beyond limits."""
    names = dict(names)
    for _ in range(20):
        here = [row[3] for row in chained(transforms(spec, names))]
        columns = []
        for joint in solve:
            _, change = derivative(transforms(spec, {**names, joint: Dual(names[joint], 1.0)}))
            columns.append([row[3] for row in change])
        steps = linear_solution(columns, [p - h for p, h in zip(point, here)])
        for joint, step in zip(solve, steps):
            names[joint] += step
        if max(map(abs, steps)) < 1e-11 * (1000 if spec.length == "mm" else 1):
            break
    for variable in spec.variables:
        low, high = variable["limits"]
        if not low - 1e-9 <= names[variable["name"]] <= high + 1e-9:
            return None
    return names


def linear_solution(columns, right):
    """x with sum x_k column_k = right: Cramer's rule."""
    whole = determinant(columns)
    return [determinant([right if k == j else column for k, column in enumerate(columns)]) / whole for j in range(3)]


def determinant(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def presented(spec, point, solve, lists):
    """Every combination of the lists by name, presented; and how many cannot be."""
    reached, missed = [], 0
    for values in itertools.product(*lists.values()):
        names = solved(spec, spec.names(dict(zip(lists, values))), solve, point)
        if names is None:
            missed += 1
        else:
            reached.append(names)
    return reached, missed
