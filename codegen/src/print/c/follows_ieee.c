/* Returns 1 if infinity and NaN are recognized, and sums are computed in the order of the source, else 0. */
static int follows_ieee(void)
{
    volatile double infinity = HUGE_VAL;
    volatile double fraction = 0.4;
    const double not_finite[2] = { infinity, infinity - infinity };
    const double rounded = (fraction + ROUND) - ROUND;
    const int is_refused = (are_below(not_finite, 1, HUGE_VAL) == 0 && are_below(&not_finite[1], 1, HUGE_VAL) == 0) ? 1 : 0;
    return (is_refused != 0 && isnan(not_finite[1]) != 0 && fabs(rounded) < 0.25) ? 1 : 0;
}
