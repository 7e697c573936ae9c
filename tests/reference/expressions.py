"""Expressions of a spec, turned into Python: numbers with units, names, functions. Dimensions are not checked here."""

import math
import re

import dual

FUNCTIONS = {
    "sin": dual.sin,
    "cos": dual.cos,
    "tan": dual.tan,
    "asin": dual.asin,
    "acos": dual.acos,
    "atan": dual.atan,
    "atan2": dual.atan2,
    "sqrt": dual.sqrt,
    "abs": dual.absolute,
    "min": dual.least,
    "max": dual.greatest,
    "sign": dual.sign,
    "exp": dual.exp,
    "log": dual.log,
}
TOKEN = re.compile(r"\s*(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|[A-Za-z_]\w*|[-+*/^(),%])")


def units(length):
    """Every unit in the coherent system of that length, kg, s, rad, K."""
    m = {"m": 1.0, "mm": 1000.0}[length]
    newton, gravity = m, 9.80665
    inch, pound = 0.0254 * m, 0.45359237
    return {
        "m": m, "cm": m / 100, "mm": m / 1000, "um": m / 1e6, "nm": m / 1e9, "inch": inch,
        "rad": 1.0, "mrad": 1e-3, "urad": 1e-6, "deg": math.pi / 180, "arcmin": math.pi / 10800, "arcsec": math.pi / 648000,
        "kg": 1.0, "g": 1e-3, "t": 1000.0, "lb": pound,
        "N": newton, "mN": newton / 1000, "kN": newton * 1000, "lbf": pound * gravity * m,
        "Pa": newton / m**2, "kPa": 1e3 * newton / m**2, "MPa": 1e6 * newton / m**2, "GPa": 1e9 * newton / m**2,
        "s": 1.0, "min": 60.0, "h": 3600.0, "K": 1.0, "ppm": 1e-6, "%": 0.01,
    }  # fmt: skip


class Reader:
    """Reads one text from left to right; each function returns Python source."""

    def __init__(self, text, units):
        self.text, self.units, self.at = text, units, 0
        self.tokens = []
        position = 0
        while text[position:].strip():
            match = TOKEN.match(text, position)
            if not match:
                raise ValueError(f"cannot read {text[position:]!r}")
            self.tokens.append(match[1])
            position = match.end()

    def peek(self, ahead=0):
        at = self.at + ahead
        return self.tokens[at] if at < len(self.tokens) else None

    def take(self, *expected):
        token = self.peek()
        if expected and token not in expected:
            raise ValueError(f"{self.text!r}: {token!r} where {expected} is due")
        self.at += 1
        return token

    def sum(self):
        code = self.product()
        while self.peek() in ("+", "-"):
            code = f"({code} {self.take()} {self.product()})"
        return code

    def product(self):
        code = self.negation()
        while self.peek() in ("*", "/"):
            code = f"({code} {self.take()} {self.negation()})"
        return code

    def negation(self):
        if self.peek() in ("-", "+"):
            return f"({self.take()}{self.negation()})"
        return self.power()

    def power(self):
        base = self.primary()
        if self.peek() == "^":
            self.take()
            return f"power({base}, {self.negation()})"
        return base

    def primary(self):
        token = self.take()
        if token == "(":
            code = self.sum()
            self.take(")")
            return code
        if token[0].isdigit() or token[0] == ".":
            factor = self.unit()
            return f"({float(token)!r}{factor})" if factor else repr(float(token))
        if self.peek() == "(":
            self.take()
            arguments = [self.sum()]
            while self.peek() == ",":
                self.take()
                arguments.append(self.sum())
            self.take(")")
            return f"{token}({', '.join(arguments)})"
        return token

    def is_unit(self, ahead=0):
        token = self.peek(ahead)
        return token in self.units and self.peek(ahead + 1) != "("

    def unit(self):
        """What stands behind a number: `mm`, `N*mm^2`, `/K`, `um/m/K`, `/(N*mm)`."""
        code = ""
        if self.is_unit():
            code = f" * {self.one_unit()}"
        while self.peek() in ("*", "/"):
            if self.is_unit(1):
                code += f" {self.take()} {self.one_unit()}"
            elif self.peek(1) == "(" and self.is_unit(2):
                code += f" {self.take()} ("
                self.take("(")
                code += self.one_unit()
                while self.peek() in ("*", "/"):
                    code += f" {self.take()} {self.one_unit()}"
                self.take(")")
                code += ")"
            else:
                break
        return code

    def one_unit(self):
        code = repr(self.units[self.take()])
        if self.peek() == "^":
            self.take()
            sign = self.take() if self.peek() == "-" else ""
            code = f"{code} ** {sign}{self.take()}"
        return code


class Expressions:
    """Reads the entries of one spec: a number, or text."""

    def __init__(self, length, tables=None):
        self.units = units(length)
        self.names = {"power": dual.power, "pi": math.pi, "__builtins__": {}, **FUNCTIONS, **(tables or {})}

    def expression(self, entry):
        """A function of the values of names."""
        if not isinstance(entry, str):
            constant = float(entry)
            return lambda names: constant
        reader = Reader(entry, self.units)
        code = reader.sum()
        if reader.peek() is not None:
            raise ValueError(f"{entry!r}: {reader.peek()!r} is left over")
        compiled = compile(code, entry, "eval")
        return lambda names: eval(compiled, self.names, names)

    def constant(self, entry):
        return self.expression(entry)({})

    def motions(self, text):
        """`Tx(…) Rz(…)` as letters of motion and axis with their arguments."""
        reader = Reader(text, self.units)
        factors = []
        while reader.peek() is not None:
            motion = reader.take("Tx", "Ty", "Tz", "Rx", "Ry", "Rz")
            reader.take("(")
            code = compile(reader.sum(), text, "eval")
            reader.take(")")
            factors.append((motion, lambda names, code=code: eval(code, self.names, names)))
        return factors
