#include <math.h>
#include <stdio.h>

#include "NAME.h"

/* Returns a number from 0 to 1, another one at each call. */
static double any(void)
{
    static unsigned state = 1U;
    state = 1664525U * state + 1013904223U;
    return (double)(state >> 8) / (double)0x1000000;
}

/* Prints how many poses have no joints, and the largest error of the best joints: a share of the size, and of a unit vector. */
int main(void)
{
    int missing = 0;
    double worst = 0.0;
    for (int k = 0; k < COUNT; k++) {
        REAL q[UPPER_VARIABLES];
        REAL target[12];
        REAL solutions[UPPER_SOLUTIONS * UPPER_VARIABLES];
        REAL found[UPPER_SOLUTIONS];
        for (int j = 0; j < UPPER_VARIABLES; j++) {
            const double lower = (double)NAME_limits[j][0];
            q[j] = (REAL)(lower + any() * ((double)NAME_limits[j][1] - lower));
        }
        /* Every other time one joint is at a limit, or at the middle of them. */
        const int at = k / 2 % UPPER_VARIABLES;
        const REAL middle = (NAME_limits[at][0] + NAME_limits[at][1]) / 2;
        q[at] = (k % 2 == 0) ? q[at] : (k % 3 == 2) ? middle : NAME_limits[at][k % 3];
        if (NAME_pose(q, PARAMETERS target) != 0 || NAME_inverse(q, PARAMETERS target, solutions, found) != 0) {
            return 1;
        }
        double best = HUGE_VAL;
        for (int row = 0; row < UPPER_SOLUTIONS; row++) {
            REAL there[12];
            double most = 0.0;
            if (found[row] == 0 || NAME_pose(&solutions[row * UPPER_VARIABLES], PARAMETERS there) != 0) {
                continue;
            }
            for (int i = 0; i < 12; i++) {
                most = fmax(most, fabs((double)there[i] - (double)target[i]) / ((i < 9) ? 1.0 : SIZE));
            }
            best = fmin(best, most);
        }
        missing += (best == HUGE_VAL) ? 1 : 0;
        worst = (best == HUGE_VAL) ? worst : fmax(worst, best);
    }
    printf("%d %g\n", missing, worst);
    return 0;
}
