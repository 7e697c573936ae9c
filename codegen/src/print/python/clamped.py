def _clamped(value, lower, upper):
    """Return the nearest value of an interval, and its lower end for NaN."""
    return np.fmin(np.fmax(value, lower), upper)
