/* Returns 1 if the sum of the numbers weighted 1 to 7 cyclically is as expected up to rounding, else 0. */
static int sums_to(const double *numbers, int count, double expected, double rounding)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) {
        sum += (double)(k % 7 + 1) * numbers[k];
    }
    return (fabs(sum - expected) <= rounding) ? 1 : 0;
}
