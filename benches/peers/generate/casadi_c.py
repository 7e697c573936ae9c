"""CasADi: SX expressions, `cse`, C. Its functions take arrays of arguments and of results."""

import casadi as ca
from chain import GIVEN, Chain, fractions

SUFFIX = "c"


def function(table, kind, name):
    """Returns the source of one function with its C name, and the part of the source to count."""
    q = ca.SX.sym("q", len(table["variables"]))
    chain = Chain(table, ca.vertsplit(q), fractions(table), ca.sin, ca.cos)
    if kind in GIVEN:
        e = ca.SX.sym("e", 6 * len(chain.frames))
        inputs, outputs = [q, e], [getattr(chain, kind)(ca.vertsplit(e))]
        arguments, arrays = "const double *q, const double *e, double *result", ("q, e", "result")
    else:
        inputs, outputs = [q], getattr(chain, kind)()
        arguments, arrays = "const double *q, double *pose, double *result", ("q", "pose, result")
    # Zeros are written as well: a dense result is dense.
    outputs = [ca.densify(output) for output in ca.cse([ca.vertcat(*output) for output in outputs])]
    generator = ca.CodeGenerator(f"{name}.c")
    generator.add(ca.Function(f"{name}_inner", inputs, outputs))
    text = generator.dump()
    counted = text[text.index("static int casadi_f0(") :]
    counted = counted[: counted.index("\n}")]
    wrapper = f"""
void {name}({arguments}) {{
  const double *arg[] = {{{arrays[0]}}};
  double *res[] = {{{arrays[1]}}};
  {name}_inner(arg, res, 0, 0, 0);
}}
"""
    return text + wrapper, counted
