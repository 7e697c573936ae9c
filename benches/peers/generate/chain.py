"""The structured form of pose, error Jacobian and what follows from it, the same for every library of symbols.

F_i has the axes R_i in F_0 and, from its origin to the tool point, the lever l_i = p_T − p_i. Its columns of J_e are

    e_x e_y e_z  along x, y, z             (R_i e; 0)
    e_s e_r e_p  about y, z, x (in turn)   (R_i a × l_i; R_i a)

The R_i are prefix products; the levers are summed from the tip, which costs every library less than p_T − p_i.
"""

import re

TURNS = [1, 2, 0]  # spin about y, roll about z, pitch about x
FRACTION = re.compile(r"(?<![\w.])\d+\.\d+(?:e-?\d+)?")


def fractions(table):
    """Returns the noninteger numbers of a table."""
    entries = sum((row for rows in table["transforms"] for row in rows), [])
    return sorted({float(number) for entry in entries for number in FRACTION.findall(entry)})


class Chain:
    """A manipulator in the scalars of one library."""

    def __init__(self, table, q, constants, sin, cos):
        """`q` are the variables, `constants` the scalars of the table's `fractions`."""
        names = dict(zip(table["variables"], q), sin=sin, cos=cos)
        numbers = dict(zip(fractions(table), constants))

        def entry(text):
            named = FRACTION.sub(lambda match: f"numbers[{match[0]}]", text)
            return eval(named, {"numbers": numbers}, names)

        transforms = [[[entry(e) for e in row] for row in rows] for rows in table["transforms"]]
        rotations = [[row[:3] for row in rows] for rows in transforms]
        offsets = [[row[3] for row in rows] for rows in transforms]
        self.frames = [rotations[0]]
        for rotation in rotations[1:]:
            self.frames.append(product(self.frames[-1], rotation))
        tool = self.frames.pop()
        # Vectors from F_i's origin to that of F_{i+1}, or to the tool point; and their sums.
        steps = [turned(frame, offset) for frame, offset in zip(self.frames, offsets[1:])]
        self.levers = [steps[-1]]
        for step in reversed(steps[:-1]):
            self.levers.insert(0, added(step, self.levers[0]))
        point = added(offsets[0], self.levers[0])
        self.pose = sum((axis(tool, j) for j in range(3)), []) + point

    def dense(self):
        """Returns the pose, 12 numbers by columns, and J_e, 36 n numbers by columns."""
        columns = []
        for frame, lever in zip(self.frames, self.levers):
            for j in range(3):
                columns += [*axis(frame, j), 0, 0, 0]
            for j in TURNS:
                columns += [*cross(axis(frame, j), lever), *axis(frame, j)]
        return self.pose, columns

    def distinct(self):
        """Returns the pose, and for every frame R_i by columns and the moments R_i a × l_i about y, z, x: 18 n numbers."""
        numbers = []
        for frame, lever in zip(self.frames, self.levers):
            for j in range(3):
                numbers += axis(frame, j)
            for j in TURNS:
                numbers += cross(axis(frame, j), lever)
        return self.pose, numbers

    def displacement(self, errors):
        """Returns ΔX = J_e ε without J_e: Σ (R_i t + R_i θ × l_i; R_i θ)."""
        shift, turn = [0] * 3, [0] * 3
        for i, (frame, lever) in enumerate(zip(self.frames, self.levers)):
            x, y, z, s, r, p = errors[6 * i : 6 * i + 6]
            rotation = turned(frame, [p, s, r])
            turn = added(turn, rotation)
            shift = added(shift, added(turned(frame, [x, y, z]), cross(rotation, lever)))
        return shift + turn

    def covariance(self, variances):
        """Returns J_e diag(σ²) J_eᵀ, 36 numbers by columns."""
        _, numbers = self.dense()
        columns = [numbers[start : start + 6] for start in range(0, len(numbers), 6)]
        weighted = [[variance * c for c in column] for variance, column in zip(variances, columns)]

        def entry(i, j):
            return sum((w[i] * c[j] for w, c in zip(weighted, columns)), 0)

        upper = {(i, j): entry(i, j) for j in range(6) for i in range(j + 1)}
        return [upper[min(i, j), max(i, j)] for j in range(6) for i in range(6)]


# Number of results of the kinds that take six more numbers per frame: ε or σ².
GIVEN = {"displacement": 6, "covariance": 36}


def axis(rotation, j):
    return [row[j] for row in rotation]


def added(a, b):
    return [a + b for a, b in zip(a, b)]


def turned(rotation, v):
    return [row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in rotation]


def product(a, b):
    columns = [turned(a, axis(b, j)) for j in range(3)]
    return [[column[i] for column in columns] for i in range(3)]


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
