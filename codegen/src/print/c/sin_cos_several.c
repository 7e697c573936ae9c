/* Sines and cosines of COUNT angles: those of sin_cos, on processors with vectors without branches. */
static void sin_cos_COUNT(const double *x, double *sines, double *cosines)
{
#if !defined(__OPTIMIZE_SIZE__) && (defined(__SSE2__) || defined(_M_X64) || defined(__aarch64__))
    const double round = ROUND;
    double s_of[COUNT];
    double c_of[COUNT];
    for (int k = 0; k < COUNT; k++) {
        const double turns = (x[k] * TURNS + round) - round;
        const double odd = fabs(turns - 2.0 * ((turns * 0.5 + round) - round));
        const double even = (turns - odd) * 0.5;
        const double sign = 1.0 - 2.0 * fabs(even - 2.0 * ((even * 0.5 + round) - round));
        double r = x[k] - turns * QUARTER;
        REDUCTION
        const double z = r * r;
        r = r * (1.0 - 2.0 * odd);
        POLYNOMIALS
        const double first = (odd > 0.5) ? c : s;
        const double second = (odd > 0.5) ? s : c;
        s_of[k] = sign * first;
        c_of[k] = sign * second;
    }
    for (int k = 0; k < COUNT; k++) {
        sines[k] = s_of[k];
        cosines[k] = c_of[k];
        if (!(fabs(x[k]) <= RANGE) || !(fabs(x[k]) > 0.0)) {
            sin_cos(x[k], &sines[k], &cosines[k]);
        }
    }
#else
    for (int k = 0; k < COUNT; k++) {
        sin_cos(x[k], &sines[k], &cosines[k]);
    }
#endif
}
