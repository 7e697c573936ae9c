"""Beams and compliances: what loads do to them, by integrating strains along the beam."""

import math

from rigid import AXES, chained, inverse, product, turned_back

# Gauss-Legendre, four points on [-1, 1]: exact to degree 7.
NODES = [
    (sign * math.sqrt(3 / 7 + other * 2 / 7 * math.sqrt(6 / 5)), (18 - other * math.sqrt(30)) / 36)
    for sign in (-1, 1)
    for other in (-1, 1)
]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def times(k, a):
    return [k * x for x in a]


def seen_from(place, nominal, spec, names, first):
    """The loads at frame `first` or behind it: force and point, in the coordinates of `place`, which is given in F_0."""
    back = inverse(place)
    loads = []
    for load in spec.loads:
        if load.frame < first:
            continue
        frame = chained(nominal[: load.frame + 1])
        x, y, z = (p(names) for p in load.point)
        point = [row[0] * x + row[1] * y + row[2] * z + row[3] for row in frame]
        point = [sum(row[k] * point[k] for k in range(3)) + row[3] for row in back]
        force = turned_back(place, times(load.mass(names), spec.gravity))
        loads.append((load, point, force))
    return loads


def place_of(effect, names, nominal):
    frame = chained(nominal[: effect.frame + 1])
    return product(frame, effect.at(names)) if effect.at else frame


def compliance(spec, effect, names, nominal):
    """C w: the wrench in the order of the errors is f_x f_y f_z, then the moments about y, z, x."""
    place = place_of(effect, names, nominal)
    force, moment = [0.0] * 3, [0.0] * 3
    for _, point, f in seen_from(place, nominal, spec, names, effect.frame):
        force, moment = plus(force, f), plus(moment, cross(point, f))
    wrench = force + [moment[1], moment[2], moment[0]]
    return [sum(c(names) * w for c, w in zip(row, wrench)) for row in effect.compliance]


def beam(spec, effect, names, nominal):
    """The end of a beam whose other end is clamped, `length` behind it along its axis.

    A section at s carries what lies beyond it: force N and moment M there stretch it by N/EA, twist it by M_t/GJ and bend
    it by M_b/EI, about each axis. The end moves by the integral of stretch, and of curvature x lever."""
    place = place_of(effect, names, nominal)
    k = AXES[effect.beam["axis"]]
    first, second = (k + 1) % 3, (k + 2) % 3
    length = effect.beam["length"](names)
    # EI_y and EI_z are about the two axes that follow the beam's own.
    soft = [0.0] * 3
    for axis, key in ((k, "GJ"), (first, "EI_y"), (second, "EI_z")):
        soft[axis] = 1 / effect.beam[key](names) if key in effect.beam else 0.0
    stretch = 1 / effect.beam["EA"](names) if "EA" in effect.beam else 0.0
    along = [1.0 if i == k else 0.0 for i in range(3)]

    loads = seen_from(place, nominal, spec, names, effect.frame)
    shift, turn = [0.0] * 3, [0.0] * 3
    cuts = [-length, 0.0]
    for left, right in zip(cuts, cuts[1:]):
        for node, weight in NODES:
            s = (left + right) / 2 + (right - left) / 2 * node
            weight = weight * (right - left) / 2
            section = times(s, along)
            force, moment = [0.0] * 3, [0.0] * 3
            for load, point, f in loads:
                force, moment = plus(force, f), plus(moment, cross(minus(point, section), f))
            curvature = [c * m for c, m in zip(soft, moment)]
            turn = plus(turn, times(weight, curvature))
            shift = plus(shift, times(weight, cross(curvature, minus([0.0] * 3, section))))
            shift = plus(shift, times(weight * stretch * force[k], along))
    return [*shift, turn[1], turn[2], turn[0]]
