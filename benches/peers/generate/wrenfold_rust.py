"""wrenfold: its Rust generator. Numbers are arguments until then: wrenfold distributes numbers over sums."""

from typing import Annotated

from chain import GIVEN, Chain, fractions
from wrenfold import code_generation, sym
from wrenfold.type_annotations import Shape

SUFFIX = "rs"


def function(table, kind, name):
    """Returns the source of a module with one function with its C name, and the part of the source to count."""
    numbers = fractions(table)
    variables, frames = len(table["variables"]), len(table["transforms"]) - 1
    variables_type = Annotated[sym.MatrixExpr, Shape(variables, 1)]
    constants_type = Annotated[sym.MatrixExpr, Shape(len(numbers), 1)]
    errors_type = Annotated[sym.MatrixExpr, Shape(6 * frames, 1)]

    def chain(q, k):
        q, k = ([v[i] for i in range(count)] for v, count in ((q, variables), (k, len(numbers))))
        return Chain(table, q, k, sym.sin, sym.cos)

    def jacobian(q: variables_type, k: constants_type):
        pose, result = getattr(chain(q, k), kind)()
        return [out(pose, "pose"), out(result, "result")]

    def given(q: variables_type, k: constants_type, e: errors_type):
        return [out(getattr(chain(q, k), kind)([e[i] for i in range(6 * frames)]), "result")]

    def out(values, name):
        return code_generation.OutputArg(sym.vector(*values), name)

    generated = given if kind in GIVEN else jacobian
    description = code_generation.create_function_description(generated, name="inner")
    text = code_generation.RustGenerator().generate(code_generation.transpile(description))
    size = {"dense": 36 * frames, "distinct": 18 * frames, **GIVEN}[kind]
    second = f"&*second.cast::<[f64; {6 * frames}]>()" if kind in GIVEN else "&mut *second.cast::<[f64; 12]>()"
    result = f"&mut *result.cast::<[f64; {size}]>()"
    wrapper = f"""
const K: [f64; {len(numbers)}] = {numbers};

pub unsafe extern "C" fn {name}(q: *const f64, second: *mut f64, result: *mut f64) {{
    unsafe {{ inner(&*q.cast::<[f64; {variables}]>(), &K, {second}, {result}) }}
}}
"""
    return "use crate::span as wrenfold_traits;\n" + text + wrapper, text
