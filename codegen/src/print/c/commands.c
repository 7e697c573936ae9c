/* Nothing holds the corrections, bounds hold them, or commands are beyond limits. */
for (int k = 0; k < CASES; k++) {
    const double *const row = &calls[WIDTH * k];
    BOUNDS
    const int found = NAME_CALLED;
    const int kind = (found == UPPER_NOT_REACHED) ? UPPER_NOT_CONVERGED : found;
    if (kind != statuses[k]SUMS) {
        return NUMBER;
    }
}
