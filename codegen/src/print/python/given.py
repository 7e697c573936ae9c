def _given(**arguments):
    """Return the common leading shape of the arguments, and each argument with its numbers in the first axis."""
    nominal = {
        "s": [parameter["nominal"] for parameter in description["parameters"]],
        "u": [value["nominal"] for value in description["inputs"]],
        "last": [0.0 for variable in description["variables"]],
        "rotations": [1.0, 1.0, 1.0],
    }
    if "last" in arguments:
        is_first = arguments["last"][0] is None
        for bound in ("change", "largest"):
            nominal[bound] = [np.inf if is_first else variable[bound] for variable in description["variables"]]
    flat = []
    for name, (array, shape) in arguments.items():
        array = np.asarray(nominal[name] if array is None else array, dtype=float)
        leading = array.ndim - len(shape)
        if leading < 0 or array.shape[leading:] != shape:
            expected = ", ".join(map(str, ("...", *shape)))
            raise ValueError(f"{name}: expected shape ({expected}), found {array.shape}")
        if name == "target":
            # A pose is flat by its columns.
            array = array.swapaxes(-1, -2)
        count = int(np.prod(shape))
        flat.append(_numbers_first(array.reshape(array.shape[:leading] + (count,))))
    for value, record in zip(flat[2] if "u" in arguments else [], description["inputs"]):
        lower, upper = record["range"]
        if np.any((value < lower) | (value > upper)):
            raise ValueError(f"input {record['name']} is outside its range, {lower} to {upper}")
    batch = np.broadcast_shapes(*(array.shape[1:] for array in flat))
    padded = (array.reshape(array.shape[:1] + (1,) * (len(batch) + 1 - array.ndim) + array.shape[1:]) for array in flat)
    return batch, *padded


def _numbers_first(array):
    """Move the numbers of each configuration to the first axis."""
    return array.transpose(array.ndim - 1, *range(array.ndim - 1))


def _numbers_last(array):
    """Move the numbers of each configuration to the last axis."""
    return array.transpose(*range(1, array.ndim), 0)


def _behind(numbers, shape, order, batch):
    """Give a result its shape and the order of its axes, behind those of the configurations."""
    first = len(shape)
    return numbers.reshape(shape + batch).transpose(*range(first, first + len(batch)), *order)
