double command_at[COUNT];
double first[COUNT];
double change[COUNT];
double largest[COUNT];
double rotations[3];
/* One configuration, any, and beyond each limit; nothing, the change or the size holds corrections. */
for (int at_call = 0; at_call < CASES; at_call++) {
    const int k = calls[at_call];
    for (int j = 0; j < COUNT; j++) {
        const double lower = NAME_limits[j][0];
        const double span = NAME_limits[j][1] - lower;
        double share = (double)(1 + (((7 * k) + (3 * j)) % 13)) / 14.0;
        if (k >= ANYWHERE && ((k - SAME) % JOINTS) == j) {
            share = (k < BELOW) ? -0.001 : 1.001;
        }
        command_at[j] = (k < SAME || !(span < 1e30)) ? given_q[j] : (lower + (share * span));
        first[j] = SHARE_OF_LAST * NAME_change[j];
        const int scale = WHICH;
        change[j] = scales[scale] * NAME_change[j];
        largest[j] = scales[8 + scale] * NAME_largest[j];
    }
    for (int i = 0; i < 3; i++) {
        rotations[i] = (((k + i) % 4) == 3) ? 0.0 : 1.0;
    }
    const int found = NAME_FUNCTION(GIVEN);
    const int kind = (found == UPPER_NOT_REACHED) ? UPPER_NOT_CONVERGED : found;
    if (kind != statuses[at_call]SUMS) {
        return NUMBER;
    }
}
