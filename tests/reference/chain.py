"""The error Jacobian of two manipulators by differences of the exact chain, written without the project.

Says anew which generalized error turns about which axis: e_s about Y, e_r about Z, e_p about X, and
R = R_y(e_s) R_z(e_r) R_x(e_p). Rows 1-3: the tool point in F_0. Rows 4-6: the small rotation in F_0 axes.

    python3 tests/reference/chain.py > tests/reference/error_jacobians.json
    python3 tests/reference/chain.py --check        # the file is what this prints
"""

import json
import math
import pathlib
import sys


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def move(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turn_x(t):
    c, s = math.cos(t), math.sin(t)
    return [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]]


def turn_y(t):
    c, s = math.cos(t), math.sin(t)
    return [[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]]


def turn_z(t):
    c, s = math.cos(t), math.sin(t)
    return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def chained(*factors):
    result = move(0, 0, 0)
    for factor in factors:
        result = product(result, factor)
    return result


def error(e_x, e_y, e_z, e_s, e_r, e_p):
    return chained(move(e_x, e_y, e_z), turn_y(e_s), turn_z(e_r), turn_x(e_p))


def pps(q):
    """The paper's positioner, mm: A_1 ... A_6 and the tool at its nominal treatment point."""
    d1, d2, d3, q4, q5, q6 = q
    return [
        move(d1, 0, 0),
        move(0, 600 + d2, 0),
        move(0, 0, 718 + d3),
        turn_y(q4),
        chained(move(0, 300, 0), turn_z(q5)),
        chained(turn_x(q6), move(0, 346, 0)),
        move(0, 100, 850),
    ]


def puma560(q):
    """PUMA 560, m: standard Denavit-Hartenberg numbers d, a, alpha."""
    quarter = math.pi / 2
    rows = [(0, 0, quarter), (0, 0.4318, 0), (0.15005, 0.0203, -quarter), (0.4318, 0, quarter), (0, 0, -quarter), (0, 0, 0)]
    return [chained(turn_z(t), move(a, 0, d), turn_x(alpha)) for t, (d, a, alpha) in zip(q, rows)] + [move(0, 0, 0)]


def real(transforms, errors):
    factors = []
    for i, transform in enumerate(transforms[:-1]):
        factors += [transform, error(*errors[6 * i : 6 * i + 6])]
    return chained(*factors, transforms[-1])


def error_jacobian(transforms):
    """Columns by central differences with Richardson's step, six rows each."""
    count = 6 * (len(transforms) - 1)
    ideal = real(transforms, [0] * count)

    def slope(k, step):
        poses = []
        for sign in (1, -1):
            errors = [0] * count
            errors[k] = sign * step
            poses.append(real(transforms, errors))
        change = [[(poses[0][i][j] - poses[1][i][j]) / (2 * step) for j in range(4)] for i in range(3)]
        # dR R^T is the cross product matrix of the small rotation.
        spin = [[sum(change[i][m] * ideal[j][m] for m in range(3)) for j in range(3)] for i in range(3)]
        return [change[0][3], change[1][3], change[2][3], spin[2][1], spin[0][2], spin[1][0]]

    columns = []
    for k in range(count):
        coarse, fine = slope(k, 2e-3), slope(k, 1e-3)
        columns.append([(4 * f - c) / 3 for f, c in zip(fine, coarse)])
    return columns


CONFIGURATIONS = {
    "pps": (pps, [[1128, 280, 0, 0, 0, 0], [300, 40, 900, 0.7, -0.03, 0.02], [2000, 500, 1200, -1.4, 0.05, -0.05]]),
    "puma560": (puma560, [[0.3, -0.4, 0.9, 1.1, -0.8, 0.5], [-2.1, 1.7, -1.2, 0.2, 1.3, -2.9]]),
}


def text():
    cases = [
        {"manipulator": name, "q": q, "error_jacobian": [[round(x, 9) + 0.0 for x in column] for column in error_jacobian(chain(q))]}
        for name, (chain, configurations) in CONFIGURATIONS.items()
        for q in configurations
    ]
    return "[\n" + ",\n".join(json.dumps(case) for case in cases) + "\n]\n"


if __name__ == "__main__":
    if "--check" in sys.argv:
        kept = json.loads(pathlib.Path(__file__).with_name("error_jacobians.json").read_text())
        made = json.loads(text())
        assert [case["q"] for case in kept] == [case["q"] for case in made]
        pairs = zip(kept, made)
        worst = max(
            abs(x - y)
            for a, b in pairs
            for left, right in zip(a["error_jacobian"], b["error_jacobian"])
            for x, y in zip(left, right)
        )
        sys.exit(f"error_jacobians.json is off by {worst}" if worst > 1e-8 else 0)
    print(text(), end="")
