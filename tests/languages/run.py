# python3 run.py MODULE NAMES INPUT OUTPUT: calls functions of a generated module, for all configurations at once and for
# the first by itself.
#
# NAMES has JSON: the arrays that are given, and of every function its name, the names of its arguments and those of its
# results. INPUT holds doubles, the arrays of one configuration after the other; OUTPUT gets what every function returns, in
# the order of the names.
import importlib.util
import json
import sys

import numpy as np

module, names, given, output = sys.argv[1:]
spec = importlib.util.spec_from_file_location("robot", module)
robot = importlib.util.module_from_spec(spec)
spec.loader.exec_module(robot)
with open(names) as file:
    names = json.load(file)

shapes = {array["name"]: tuple(array["shape"]) for array in names["arrays"]}
rows = np.fromfile(given).reshape(-1, sum(int(np.prod(shape)) for shape in shapes.values()))
arguments, at = {}, 0
for name, shape in shapes.items():
    count = int(np.prod(shape))
    arguments[name] = rows[:, at : at + count].reshape((len(rows), *shape))
    if name == "target":
        # A pose is given as `pose` returns it.
        arguments[name] = np.swapaxes(arguments[name], -1, -2)
    at += count

results = []
for name, taken, filled in names["functions"]:
    called = getattr(robot, name)
    given = [arguments[name] for name in taken]
    arrays = called(*given)
    first = called(*(array[0] for array in given))
    if not isinstance(arrays, tuple):
        arrays, first = (arrays,), (first,)
    for one, of_first, array in zip(filled, first, arrays, strict=True):
        assert np.array_equal(of_first, array[0], equal_nan=True), f"{name}: the first by itself"
        if one in ("pose", "transforms", "columns"):
            array = np.swapaxes(array, -1, -2)
        results.append(array.reshape(len(rows), int(np.prod(array.shape[1:]))))
    # What has the nominal values need not be given them.
    if set(taken) == {"q", "s"}:
        nominal = called(given[0])
        nominal = nominal[0] if isinstance(nominal, tuple) else nominal
        assert np.array_equal(nominal, arrays[0], equal_nan=True), f"{name}: nominal parameters"
np.concatenate(results, axis=1).astype(float).tofile(output)

# The inverse takes what `pose` returns, of one configuration and of many.
if hasattr(robot, "inverse"):
    for q in (arguments["q"], arguments["q"][0]):
        solutions = robot.inverse(q, None, robot.pose(q))[0]
        assert solutions.shape[:-2] == q.shape[:-1], solutions.shape

# Another shape is told, not computed with.
try:
    robot.pose(np.zeros(shapes["q"][0] + 1))
except ValueError as refused:
    assert "expected" in str(refused), refused
else:
    raise AssertionError("a shape that is wrong is taken")
