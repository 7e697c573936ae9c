def _dot(a, b):
    """Return the sum of the products of two lists, added one by one."""
    return np.add.accumulate(a * b, axis=0)[-1] if len(a) > 0 else 0.0
