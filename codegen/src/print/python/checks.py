NAMES = (np.broadcast_to(array, array.shape[:1] + batch) for array in given)
for name, array in {FINITE}.items():
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name}: a number is not finite")
