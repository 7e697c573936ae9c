# python3 run.py MODULE FUNCTIONS INPUT OUTPUT: calls functions of a generated module, for all configurations at once and for
# the first by itself.
#
# FUNCTIONS has JSON: a name, the names of the arguments and those of the results each. INPUT holds doubles, q, s, u, errors,
# variances and magnitudes of one configuration after the other; OUTPUT gets what every function returns, in the order of the
# names.
import importlib.util
import json
import sys

import numpy as np

module, functions, given, output = sys.argv[1:]
spec = importlib.util.spec_from_file_location("robot", module)
robot = importlib.util.module_from_spec(spec)
spec.loader.exec_module(robot)
with open(functions) as file:
    functions = json.load(file)

frames, variables, parameters, inputs, sources = (
    len(robot.description[name]) for name in ("frames", "variables", "parameters", "inputs", "sources")
)
shapes = {
    "q": (variables,),
    "s": (parameters,),
    "u": (inputs,),
    "errors": (frames, 6),
    "variances": (frames, 6),
    "magnitudes": (sources,),
}
rows = np.fromfile(given).reshape(-1, sum(int(np.prod(shape)) for shape in shapes.values()))
arguments, at = {}, 0
for name, shape in shapes.items():
    count = int(np.prod(shape))
    arguments[name] = rows[:, at : at + count].reshape((len(rows), *shape))
    at += count

results = []
for name, names, filled in functions:
    called = getattr(robot, name)
    given = [arguments[name] for name in names]
    arrays = called(*given)
    first = called(*(array[0] for array in given))
    if not isinstance(arrays, tuple):
        arrays, first = (arrays,), (first,)
    for one, of_first, array in zip(filled, first, arrays, strict=True):
        assert np.array_equal(of_first, array[0]), f"{name}: the first by itself"
        if one in ("pose", "transforms", "columns"):
            array = np.swapaxes(array, -1, -2)
        results.append(array.reshape(len(rows), int(np.prod(array.shape[1:]))))
    # What has the nominal values need not be given them.
    if set(names) == {"q", "s"}:
        nominal = called(given[0])
        nominal = nominal[0] if isinstance(nominal, tuple) else nominal
        assert np.array_equal(nominal, arrays[0]), f"{name}: nominal parameters"
np.concatenate(results, axis=1).astype(float).tofile(output)

# Another shape is told, not computed with.
try:
    robot.pose(np.zeros(variables + 1))
except ValueError as refused:
    assert "expected" in str(refused), refused
else:
    raise AssertionError("a shape that is wrong is taken")
