q, s, u, last, change, largest, rotations = (
    np.broadcast_to(array, array.shape[:1] + batch) for array in given
)
for name, array in {"q": q, "s": s, "u": u, "last": last, "rotations": rotations}.items():
    if not np.all(np.isfinite(array)):
        raise ValueError(f"{name}: a number is not finite")
