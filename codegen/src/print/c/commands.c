for (int k = 0; k < CASES; k++) {
    for (int j = 0; j < COUNT; j++) {
        command[j] = given_q[j];
        first[j] = shares[5 * k] * NAME_change[j];
        change[j] = shares[(5 * k) + 1] * NAME_change[j];
        largest[j] = shares[(5 * k) + 2] * NAME_largest[j];
    }
    rotations[2] = shares[(5 * k) + 3];
    command[JOINT] += shares[(5 * k) + 4];
    const int found = CALL;
    const int kind = (found == UPPER_NOT_REACHED) ? UPPER_NOT_CONVERGED : found;
    if (kind != statuses[k] || WRONG) {
        return NUMBER;
    }
}
