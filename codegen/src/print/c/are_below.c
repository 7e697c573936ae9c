/* Returns 1 if the absolute value of every number is below the limit, else 0; NaN is not. */
static int are_below(const double *numbers, int count, double limit)
{
    unsigned wrong = 0U;
    for (int k = 0; k < count; k++) {
        wrong |= (fabs(numbers[k]) < limit) ? 0U : 1U;
    }
    return (wrong == 0U) ? 1 : 0;
}
