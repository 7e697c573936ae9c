double command[COUNT];
double first[COUNT];
double change[COUNT];
double largest[COUNT];
double rotations[3] = { 1.0, 1.0, 1.0 };
double corrected[COUNT];
double correction[COUNT];
double before[6];
double after[6];
/* Nothing holds the correction, bounds hold it in several ways, or a command is beyond a limit. */
for (int k = 0; k < CASES; k++) {
    for (int j = 0; j < COUNT; j++) {
        command[j] = given_q[j];
        first[j] = shares[5 * k] * NAME_change[j];
        change[j] = shares[(5 * k) + 1] * NAME_change[j];
        largest[j] = shares[(5 * k) + 2] * NAME_largest[j];
    }
    rotations[2] = shares[(5 * k) + 3];
    command[JOINT] += shares[(5 * k) + 4];
    const int found = NAME_compensated(command, GIVEN first, change, largest, rotations, corrected, correction, before, after);
    const int kind = (found == UPPER_NOT_REACHED) ? UPPER_NOT_CONVERGED : found;
    if (kind != statuses[k] || sums_to(corrected, COUNT, expected[4 * k], tolerances[4 * k]) == 0
        || sums_to(correction, COUNT, expected[(4 * k) + 1], tolerances[(4 * k) + 1]) == 0
        || sums_to(before, 6, expected[(4 * k) + 2], tolerances[(4 * k) + 2]) == 0
        || sums_to(after, 6, expected[(4 * k) + 3], tolerances[(4 * k) + 3]) == 0) {
        return NUMBER;
    }
}
