"""Beams and compliances: what loads do to them, by integrating strains along the beam."""

import math
from dataclasses import dataclass

from rigid import AXES, chained, inverse, product, turned_back

# Gauss-Legendre, four points on [-1, 1]: exact to degree 7.
NODES = [
    (sign * math.sqrt(3 / 7 + other * 2 / 7 * math.sqrt(6 / 5)), (18 - other * math.sqrt(30)) / 36)
    for sign in (-1, 1)
    for other in (-1, 1)
]


@dataclass
class Acting:
    """A force and a moment at a point; `inner` if it acts on the link itself and not on one behind it."""

    inner: bool
    point: list
    force: list
    moment: list


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(a, b):
    return [x + y for x, y in zip(a, b)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def times(k, a):
    return [k * x for x in a]


def turned(a, vector):
    """R v."""
    return [sum(row[k] * vector[k] for k in range(3)) for row in a]


def moved(a, point):
    return [sum(row[k] * point[k] for k in range(3)) + row[3] for row in a]


def acting(spec, effect, names, nominal):
    """Everything that a beam or compliance may carry: loads of its frame and of those behind it, in F_0; and the weights of
    other beams. Of a beam on the same link, a compliance carries the part that is beyond it along the beam."""
    frame, result = effect.frame, []
    for load in spec.loads:
        if load.frame < frame:
            continue
        at = chained(nominal[: load.frame + 1])
        if load.point is None:
            point = [row[3] for row in chained(nominal)]
        else:
            point = moved(at, [x(names) for x in load.point])
        axes = turned if load.follows else lambda _, vector: vector
        force = axes(at, [x(names) for x in load.force])
        force = plus(force, times(load.mass(names), spec.gravity))
        moment = axes(at, [x(names) for x in load.moment])
        result.append(Acting(load.frame == frame, point, force, moment))
    for other in (other for source in spec.sources if source.enabled for other in source.effects):
        if other.beam and other.frame >= frame and other is not effect and "mass_per_length" in other.beam:
            place, along = place_of(other, names, nominal), AXES[other.beam["axis"]]
            length = other.beam["length"](names)
            if other.frame == frame and effect.compliance:
                here = [row[3] for row in place_of(effect, names, nominal)]
                length = min(max(-moved(inverse(place), here)[along], 0.0), length)
            middle = moved(place, [-length / 2 if k == along else 0.0 for k in range(3)])
            weight = times(length * other.beam["mass_per_length"](names), spec.gravity)
            result.append(Acting(other.frame == frame, middle, weight, [0.0] * 3))
    return result


def place_of(effect, names, nominal):
    frame = chained(nominal[: effect.frame + 1])
    return product(frame, effect.at(names)) if effect.at else frame


def local(place, load):
    """The same in the coordinates of a place."""
    point = moved(inverse(place), load.point)
    return Acting(load.inner, point, turned_back(place, load.force), turned_back(place, load.moment))


def compliance(spec, effect, names, nominal):
    """C w: the wrench in the order of the errors is f_x f_y f_z, then the moments about y, z, x."""
    place = place_of(effect, names, nominal)
    force, moment = [0.0] * 3, [0.0] * 3
    for load in acting(spec, effect, names, nominal):
        load = local(place, load)
        force, moment = plus(force, load.force), plus(moment, plus(load.moment, cross(load.point, load.force)))
    wrench = force + [moment[1], moment[2], moment[0]]
    return [sum(c(names) * w for c, w in zip(row, wrench)) for row in effect.compliance]


def beam(spec, effect, names, nominal):
    """The end of a beam whose other end is clamped, `length` behind it along its axis.

    A section at s carries what lies beyond it: a force N and a moment there stretch it by N/EA, twist it by M_t/GJ and
    bend it by M_b/EI about each axis. The end moves by the integral of stretch, and of curvature x lever. What acts on
    the link itself does so where it stands beside the beam."""
    place = place_of(effect, names, nominal)
    k = AXES[effect.beam["axis"]]
    length = effect.beam["length"](names)
    # EI_x, EI_y and EI_z are about their own axes.
    soft = [0.0] * 3
    for axis, key in ((k, "GJ"), *((i, f"EI_{'xyz'[i]}") for i in range(3) if i != k)):
        soft[axis] = 1 / effect.beam[key](names) if key in effect.beam else 0.0
    stretch = 1 / effect.beam["EA"](names) if "EA" in effect.beam else 0.0
    per_length = effect.beam["mass_per_length"](names) if "mass_per_length" in effect.beam else 0.0
    weight = times(per_length, turned_back(place, spec.gravity))
    along = [1.0 if i == k else 0.0 for i in range(3)]
    loads = [local(place, load) for load in acting(spec, effect, names, nominal)]

    cuts = sorted({-length, 0.0, *(load.point[k] for load in loads if load.inner and -length < load.point[k] < 0)})
    shift, turn = [0.0] * 3, [0.0] * 3
    for left, right in zip(cuts, cuts[1:]):
        for node, share in NODES:
            s = (left + right) / 2 + (right - left) / 2 * node
            share = share * (right - left) / 2
            section = times(s, along)
            # The beam's own weight beyond the section: its middle is half way to the end.
            force = times(-s, weight)
            moment = cross(times(-s / 2, along), force)
            for load in loads:
                if load.inner and load.point[k] < s:
                    continue
                force = plus(force, load.force)
                moment = plus(moment, plus(load.moment, cross(minus(load.point, section), load.force)))
            curvature = [c * m for c, m in zip(soft, moment)]
            turn = plus(turn, times(share, curvature))
            shift = plus(shift, times(share, cross(curvature, times(-s, along))))
            shift = plus(shift, times(share * stretch * force[k], along))
    return [*shift, turn[1], turn[2], turn[0]]
