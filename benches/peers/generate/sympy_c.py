"""SymPy: `cse`, then its C printer. Numbers are symbols until then: SymPy distributes numbers over sums."""

import sympy as sp
from chain import GIVEN, Chain, fractions

SUFFIX = "c"


def function(table, kind, name):
    """Returns the source of one function, and the part of the source to count."""
    numbers = fractions(table)
    constants = sp.symbols(f"k:{len(numbers)}")
    q = sp.symbols(table["variables"])
    chain = Chain(table, q, constants, sp.sin, sp.cos)
    e = sp.symbols(f"e:{6 * len(chain.frames)}")
    if kind in GIVEN:
        outputs, second = [("result", getattr(chain, kind)(e))], "const double *e"
    else:
        outputs, second = list(zip(("pose", "result"), getattr(chain, kind)())), "double *pose"
    shared, results = sp.cse([sp.sympify(value) for _, values in outputs for value in values])
    lines = [f"void {name}(const double *q, {second}, double *result) {{"]
    lines += [f"const double {k} = {number!r};" for k, number in zip(constants, numbers)]
    lines += [f"const double {symbol} = q[{i}];" for i, symbol in enumerate(q)]
    if kind in GIVEN:
        lines += [f"const double {symbol} = e[{i}];" for i, symbol in enumerate(e)]
    lines += [f"const double {symbol} = {sp.ccode(value)};" for symbol, value in shared]
    places = [f"{array}[{i}]" for array, values in outputs for i in range(len(values))]
    lines += [f"{place} = {sp.ccode(value)};" for place, value in zip(places, results)]
    text = "\n  ".join(lines) + "\n}\n"
    return "#include <math.h>\n\n" + text, text
