"""SymForce: its C++ generator, whose functions take Eigen matrices: the same doubles, aligned."""

import tempfile
from pathlib import Path

import symforce

symforce.set_epsilon_to_number()

import symforce.symbolic as sf  # noqa: E402
from chain import GIVEN, Chain, fractions  # noqa: E402
from symforce import codegen  # noqa: E402
from symforce.values import Values  # noqa: E402

SUFFIX = "cpp"


def function(table, kind, name):
    """Returns the source of one function with its C name, and the part of the source to count."""
    q = sf.Matrix(len(table["variables"]), 1, sf.symbols(table["variables"]))
    inputs = Values(q=q)
    chain = Chain(table, list(q), fractions(table), sf.sin, sf.cos)
    n = len(chain.frames)
    if kind in GIVEN:
        e = sf.Matrix(6 * n, 1, [sf.Symbol(f"e{i}") for i in range(6 * n)])
        inputs["e"] = e
        outputs = {"result": (GIVEN[kind], 1, getattr(chain, kind)(list(e)))}
        second = "const double *e"
    else:
        pose, result = getattr(chain, kind)()
        rows, columns = (6, 6 * n) if kind == "dense" else (18 * n, 1)
        outputs = {"pose": (12, 1, pose), "result": (rows, columns, result)}
        second = "double *pose"
    matrices = Values()
    for output, (rows, columns, values) in outputs.items():
        # By rows; ours are by columns.
        matrices[output] = sf.Matrix(rows, columns, [values[i + rows * j] for i in range(rows) for j in range(columns)])
    generator = codegen.Codegen(inputs=inputs, outputs=matrices, config=codegen.CppConfig(), name=name)
    with tempfile.TemporaryDirectory() as folder:
        generated = generator.generate_function(output_dir=folder, skip_directory_nesting=True)
        (header,) = generated.generated_files
        text = Path(header).read_text(encoding="utf-8").replace("#pragma once", "")
    inner = "".join(word.capitalize() for word in name.split("_"))
    sizes = [(key, value.shape, "const ") for key, value in inputs.items()]
    sizes += [(key, value.shape, "") for key, value in matrices.items()]
    casts = [
        f"{'*' if const else ''}reinterpret_cast<{const}Eigen::Matrix<double, {rows}, {columns}> *>({key})"
        for key, (rows, columns), const in sizes
    ]
    wrapper = f"""
extern "C" void {name}(const double *q, {second}, double *result) {{
  sym::{inner}<double>({", ".join(casts)});
}}
"""
    return text + wrapper, text[text.index("template <") :]
