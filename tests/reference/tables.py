"""Functions through measured points: straight lines, or cubics with the slopes of Fritsch and Butland (pchip)."""

import bisect
import csv

from dual import Dual, value


def table(given, folder, constant):
    """A function of one number, from `[tables.NAME]`."""
    xs, ys = (axis(given[key], given.get("file"), folder, constant) for key in "xy")
    slopes = cubic_slopes(xs, ys) if given["interpolation"] == "cubic" else None
    holds = given.get("outside") == "hold"

    def of(x):
        at = value(x)
        if holds and not xs[0] <= at <= xs[-1]:
            return ys[0] if at < xs[0] else ys[-1]
        k = min(max(bisect.bisect_right(xs, at) - 1, 0), len(xs) - 2)
        y, slope = piece(at - xs[k], xs[k + 1] - xs[k], ys[k : k + 2], slopes and slopes[k : k + 2])
        return Dual(y, slope * x.slope) if isinstance(x, Dual) else y

    return of


def axis(given, file, folder, constant):
    """Numbers, a list with a unit, or a column of the file."""
    if isinstance(given, list):
        return [constant(x) for x in given]
    unit = constant(f"1 {given['unit']}") if given.get("unit") else 1.0
    if "values" in given:
        return [constant(x) * unit for x in given["values"]]
    with open(folder / file, newline="") as lines:
        return [float(row[given["column"]]) * unit for row in csv.DictReader(lines)]


def piece(t, width, ys, slopes):
    """Value and slope at t behind the first of two points: Hermite's cubic, or the line."""
    secant = (ys[1] - ys[0]) / width
    if not slopes:
        return ys[0] + secant * t, secant
    u = t / width
    a, b = slopes
    y = (1 - u) ** 2 * (1 + 2 * u) * ys[0] + u * u * (3 - 2 * u) * ys[1] + width * u * (1 - u) * ((1 - u) * a - u * b)
    return y, 6 * u * (1 - u) * secant + (1 - u) * (1 - 3 * u) * a + u * (3 * u - 2) * b


def cubic_slopes(xs, ys):
    """Inside, the weighted harmonic mean of both secants, 0 where they differ in sign; at the ends, three points' parabola."""
    h = [b - a for a, b in zip(xs, xs[1:])]
    d = [(b - a) / w for a, b, w in zip(ys, ys[1:], h)]
    if len(d) == 1:
        return [d[0], d[0]]
    inner = []
    for h1, h2, d1, d2 in zip(h, h[1:], d, d[1:]):
        near, far = h1 + 2 * h2, 2 * h1 + h2
        inner.append((near + far) / (near / d1 + far / d2) if d1 * d2 > 0 else 0.0)
    return [end_slope(h[0], h[1], d[0], d[1]), *inner, end_slope(h[-1], h[-2], d[-1], d[-2])]


def end_slope(h1, h2, d1, d2):
    slope = ((2 * h1 + h2) * d1 - h1 * d2) / (h1 + h2)
    if slope * d1 <= 0:
        return 0.0
    return 3 * d1 if d1 * d2 <= 0 and abs(slope) > abs(3 * d1) else slope
