/* Returns 1 if every input is within its range, else 0. */
static int inputs_are_in_range(const double *u)
{
    int inside = 1;
    for (int k = 0; k < COUNT; k++) {
        inside = (inside != 0 && u[k] >= NAME_ranges[k][0] && u[k] <= NAME_ranges[k][1]) ? 1 : 0;
    }
    return inside;
}
