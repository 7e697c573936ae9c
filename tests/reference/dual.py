"""Dual numbers a + b d with d*d = 0: what is computed with them has its derivative, exact to rounding, beside its value."""

import math


class Dual:
    __slots__ = ("value", "slope")

    def __init__(self, value, slope=0.0):
        self.value, self.slope = value, slope

    def __add__(self, other):
        return Dual(self.value + value(other), self.slope + slope(other))

    def __sub__(self, other):
        return Dual(self.value - value(other), self.slope - slope(other))

    def __mul__(self, other):
        return Dual(self.value * value(other), self.slope * value(other) + self.value * slope(other))

    def __truediv__(self, other):
        quotient = self.value / value(other)
        return Dual(quotient, (self.slope - quotient * slope(other)) / value(other))

    def __neg__(self):
        return Dual(-self.value, -self.slope)

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other):
        return Dual(other) - self

    def __rtruediv__(self, other):
        return Dual(other) / self


def value(x):
    return x.value if isinstance(x, Dual) else x


def slope(x):
    return x.slope if isinstance(x, Dual) else 0.0


def lifted(function, derivative):
    """A function of one number, taken to dual numbers by the chain rule."""

    def of(x):
        if isinstance(x, Dual):
            return Dual(function(x.value), derivative(x.value) * x.slope)
        return function(x)

    return of


sin = lifted(math.sin, math.cos)
cos = lifted(math.cos, lambda x: -math.sin(x))
tan = lifted(math.tan, lambda x: 1 + math.tan(x) ** 2)
asin = lifted(math.asin, lambda x: 1 / math.sqrt(1 - x * x))
acos = lifted(math.acos, lambda x: -1 / math.sqrt(1 - x * x))
atan = lifted(math.atan, lambda x: 1 / (1 + x * x))
sqrt = lifted(math.sqrt, lambda x: 0.5 / math.sqrt(x))
absolute = lifted(abs, lambda x: math.copysign(1.0, x))
exp = lifted(math.exp, math.exp)
log = lifted(math.log, lambda x: 1 / x)
sign = lifted(lambda x: (x > 0) - (x < 0), lambda x: 0.0)


def atan2(y, x):
    if not (isinstance(y, Dual) or isinstance(x, Dual)):
        return math.atan2(y, x)
    square = value(x) ** 2 + value(y) ** 2
    return Dual(math.atan2(value(y), value(x)), (value(x) * slope(y) - value(y) * slope(x)) / square)


def power(base, exponent):
    """The exponent is a number."""
    return lifted(lambda x: x**exponent, lambda x: exponent * x ** (exponent - 1))(base)


def least(x, y):
    return x if value(x) <= value(y) else y


def greatest(x, y):
    return x if value(x) >= value(y) else y
