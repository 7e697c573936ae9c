/* Returns 1 if the sines and cosines of twelve angles, COUNT at a time, are as expected, else 0. */
static int sines_by_COUNT_are_right(const double sines[36])
{
    double s[12];
    double c[12];
    int all = 1;
    for (int k = 0; k < 12; k += COUNT) {
        SIN_COS(sines[k], &s[k], &c[k]);
    }
    for (int k = 0; k < 12; k++) {
        all *= (fabs(s[k] - sines[12 + k]) <= BOUND && fabs(c[k] - sines[24 + k]) <= BOUND) ? 1 : 0;
    }
    return all;
}
