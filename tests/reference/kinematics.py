"""The real chain A_1 E_1 … A_n E_n T as it is defined, and what follows from it by dual numbers alone.

Each source has a magnitude: 0 is the ideal machine, 1 what the spec says. What a source does to first order is the
derivative of the real chain by its magnitude.
"""

import elastic
import rigid
from dual import Dual, asin, atan2, slope
from rigid import chained, derivative, error, inverse, turned_back, values


def transforms(spec, names):
    """The nominal matrices, the tool's last."""
    return [frame.transform(names) for frame in spec.frames] + [spec.tool(names)]


def generalized_errors(spec, effect, names, nominal):
    """The six numbers of an effect where it acts, at magnitude 1."""
    if effect.beam:
        return elastic.beam(spec, effect, names, nominal)
    if effect.compliance:
        return elastic.compliance(spec, effect, names, nominal)
    return [error(names) for error in effect.errors]


class Configuration:
    """A machine at one configuration: the matrices, and what each source does there."""

    def __init__(self, spec, names):
        self.spec, self.names = spec, names
        self.nominal = transforms(spec, names)
        self.effects = {id(effect): self.number(effect) for source in spec.sources for effect in source.effects}

    def number(self, effect):
        if effect.joint or effect.parameter:
            return effect.error(self.names)
        if effect.dh:
            return {key: error(self.names) for key, error in effect.dh.items()}
        place = effect.at(self.names) if effect.at else None
        return generalized_errors(self.spec, effect, self.names, self.nominal), place

    def groups(self, magnitudes):
        """[A_1, … E_1], … [A_n, … E_n], [T] of the real machine; `magnitudes` are pairs of a source and its number."""
        spec = self.spec
        names, dh = dict(self.names), {}
        errors = [None] * len(spec.frames)
        located = [[] for _ in spec.frames]
        for source, magnitude in magnitudes:
            magnitude = source.scale * magnitude
            for effect in source.effects:
                number = self.effects[id(effect)]
                i = effect.frame
                if effect.joint or effect.parameter:
                    name = effect.joint or effect.parameter
                    names[name] = names[name] + magnitude * number
                elif effect.dh:
                    sums = dh.setdefault(i, {})
                    for key, x in number.items():
                        sums[key] = sums.get(key, 0.0) + magnitude * x
                else:
                    e, place = number
                    e = [magnitude * x if x else 0.0 for x in e]
                    if place:
                        located[i].append(chained([place, error(e), inverse(place)]))
                    else:
                        errors[i] = [x + y for x, y in zip(errors[i], e)] if errors[i] else e
        moved = names != self.names
        groups = []
        for i, frame in enumerate(spec.frames):
            real = frame.transform(names, dh.get(i)) if moved or i in dh else self.nominal[i]
            # Errors elsewhere on the link in the order of the file, then the sum of those of the frame itself.
            groups.append([real, *located[i], *([error(errors[i])] if errors[i] else [])])
        return [*groups, [spec.tool(names) if moved else self.nominal[-1]]]

    def factors(self, magnitudes):
        return [factor for group in self.groups(magnitudes) for factor in group]

    def pose(self):
        return chained(self.nominal)

    def displacement(self, source):
        """First order: position and rotation rows of the derivative by the source's magnitude."""
        return self.rows(self.factors([(source, Dual(0.0, 1.0))]))

    def rows(self, factors):
        pose, change = derivative(factors)
        position, turn = rigid.small_motion(pose, change)
        if self.spec.orientation in EULER:
            turn = EULER[self.spec.orientation](pose, change)
        return position + turn

    def error_jacobian(self):
        """6n columns of six rows: the derivative of the real chain by each generalized error."""
        columns = []
        for i in range(len(self.spec.frames)):
            for k in range(6):
                e = [Dual(0.0, 1.0) if j == k else 0.0 for j in range(6)]
                columns.append(self.rows([*self.nominal[: i + 1], error(e), *self.nominal[i + 1 :]]))
        return columns

    def equivalent_errors(self, sources):
        """The 6n generalized errors of all these sources together: a small motion of each frame in its own axes.

        What moves the tool belongs to the last frame, in front of the tool."""
        groups = self.groups([(source, Dual(0.0, 1.0)) for source in sources])
        tool = groups.pop()[0]
        groups[-1] += [tool, inverse(values(tool))]
        result = []
        for group in groups:
            pose, change = derivative(group)
            shift, turn = (turned_back(pose, v) for v in rigid.small_motion(pose, change))
            # Spin about y, roll about z, pitch about x.
            result += [*shift, turn[1], turn[2], turn[0]]
        return result


def euler_slopes(pose, change):
    """Spin, roll and pitch of R = R_y R_z R_x."""
    r = [[Dual(pose[i][j], change[i][j]) for j in range(3)] for i in range(3)]
    spin = atan2(-r[2][0], r[0][0])
    roll = asin(r[1][0])
    pitch = atan2(-r[1][2], r[1][1])
    return [slope(spin), slope(roll), slope(pitch)]


def table_slopes(pose, change):
    """Yaw, pitch and roll of R = R_z R_x R_y, the table angles of IEC 61217."""
    r = [[Dual(pose[i][j], change[i][j]) for j in range(3)] for i in range(3)]
    yaw = atan2(-r[0][1], r[1][1])
    pitch = asin(r[2][1])
    roll = atan2(-r[2][0], r[2][2])
    return [slope(yaw), slope(pitch), slope(roll)]


EULER = {"euler-yzx": euler_slopes, "iec-61217": table_slopes}


def exact_position(configuration, magnitudes):
    return [row[3] for row in chained(configuration.factors(magnitudes))]
