"""Rigid motions as rows of a 3 x 4 matrix: numbers, or dual numbers split into a value and a slope."""

from dual import cos, sin, slope, value

IDENTITY = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]
AXES = {"x": 0, "y": 1, "z": 2}


def product(a, b):
    """Of matrices whose entries are plain or dual numbers."""
    (b00, b01, b02, b03), (b10, b11, b12, b13), (b20, b21, b22, b23) = b
    return [
        [
            r0 * b00 + r1 * b10 + r2 * b20,
            r0 * b01 + r1 * b11 + r2 * b21,
            r0 * b02 + r1 * b12 + r2 * b22,
            r0 * b03 + r1 * b13 + r2 * b23 + r3,
        ]
        for r0, r1, r2, r3 in a
    ]


def chained(factors):
    result = IDENTITY
    for factor in factors:
        result = product(result, factor)
    return result


def inverse(a):
    turned = [[a[j][i] for j in range(3)] for i in range(3)]
    return [row + [-(row[0] * a[0][3] + row[1] * a[1][3] + row[2] * a[2][3])] for row in turned]


def turned_back(a, vector):
    """R^T v."""
    return [sum(a[k][j] * vector[k] for k in range(3)) for j in range(3)]


def translation(x, y, z):
    return [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]]


def rotation(axis, angle):
    """About an axis of unit length: R = c I + (1 - c) a a^T + s [a]."""
    c, s, (x, y, z) = cos(angle), sin(angle), axis
    t = 1.0 - c
    return [
        [c + t * (x * x), t * (x * y) - s * z, t * (x * z) + s * y, 0.0],
        [t * (y * x) + s * z, c + t * (y * y), t * (y * z) - s * x, 0.0],
        [t * (z * x) - s * y, t * (z * y) + s * x, c + t * (z * z), 0.0],
    ]


def unit(axis):
    return [1.0 if k == AXES[axis] else 0.0 for k in range(3)]


def elementary(motion, amount):
    """Tx, Ty, Tz, Rx, Ry, Rz."""
    kind, axis = motion
    if kind == "R":
        return rotation(unit(axis), amount)
    return translation(*(amount if k == AXES[axis] else 0.0 for k in range(3)))


def error(e):
    """E of (e_x, e_y, e_z, e_s, e_r, e_p): spin about y, then roll about z, then pitch about x."""
    e_x, e_y, e_z, e_s, e_r, e_p = e
    turn = chained([elementary("Ry", e_s), elementary("Rz", e_r), elementary("Rx", e_p)])
    return product(translation(e_x, e_y, e_z), turn)


def values(a):
    return [[value(x) for x in row] for row in a]


def slopes(a):
    return [[slope(x) for x in row] for row in a]


def is_plain(a):
    return all(isinstance(x, (float, int)) for row in a for x in row)


def derivative(factors):
    """Value and slope of a product of matrices with dual entries: (XY)' = X' Y + X Y'."""
    total, change = IDENTITY, None
    for factor in factors:
        plain = is_plain(factor)
        v = factor if plain else values(factor)
        parts = []
        if change is not None:
            parts.append(product(change, v))
        if not plain:
            parts.append(turned(total, slopes(factor)))
        total = product(total, v)
        if parts:
            change = [[sum(entries) for entries in zip(*rows)] for rows in zip(*parts)]
    return total, change or [[0.0] * 4 for _ in range(3)]


def turned(a, change):
    """A X', where the last row of X' is zero."""
    return [[sum(a[i][k] * change[k][j] for k in range(3)) for j in range(4)] for i in range(3)]


def small_motion(a, change):
    """What a motion and its slope come to: the slope of its origin, and the small rotation, both in the outer frame."""
    spin = [[sum(change[i][k] * a[j][k] for k in range(3)) for j in range(3)] for i in range(3)]
    return [change[i][3] for i in range(3)], [spin[2][1], spin[0][2], spin[1][0]]
