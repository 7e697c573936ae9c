
#define REQUIRE(condition) do { if (!(condition)) { return __LINE__ % 200 + 1; } } while (0)

/* Largest move of a drive beyond that of its command, in bounds of the change. */
static double moved(const double *from, const double *to, const double *command, const double *before)
{
    double most = 0.0;
    for (int j = 0; j < PPS_VARIABLES; j++) {
        const double beyond = fabs(to[j] - from[j]) - fabs(command[j] - before[j]);
        most = fmax(most, beyond / pps_change[j]);
    }
    return most;
}

/* The path: every joint swings about its mid-travel, at its own frequency. */
static void at(double share, double q[PPS_VARIABLES])
{
    for (int j = 0; j < PPS_VARIABLES; j++) {
        const double lower = pps_limits[j][0];
        const double upper = pps_limits[j][1];
        q[j] = (lower + upper) / 2.0 + 0.3 * (upper - lower) * sin(6.28 * share * (j + 1));
    }
}

/* Along a path, and from any start to corrections that stand: bounds hold in every cycle, and corrections stop where
 * they are wanted without going beyond. Returns the line of what is wrong. */
static int approaches(void)
{
    static const double patient[PPS_INPUTS] = { 70.0, 0.0, 850.0 };
    double any[PPS_VARIABLES];
    double acceleration[PPS_VARIABLES];
    double reached[PPS_VARIABLES] = { 0.0 };
    double step[PPS_VARIABLES] = { 0.0 };
    double wanted[PPS_VARIABLES] = { 0.0 };
    for (int j = 0; j < PPS_VARIABLES; j++) {
        any[j] = HUGE_VAL;
        acceleration[j] = pps_change[j] / (7.0 + 5.0 * j);
    }
    for (int k = 0; k < 4000; k++) {
        double q[PPS_VARIABLES];
        double drives[PPS_VARIABLES];
        double pose[6];
        double after[6];
        double from[PPS_VARIABLES];
        double before[PPS_VARIABLES];
        memcpy(from, reached, sizeof from);
        memcpy(before, step, sizeof before);
        /* The path jumps three times, and stands in the last quarter. */
        at(floor(k / 1000.0) * 0.37 + fmin(k, 3000) / 40000.0, q);
        REQUIRE(pps_compensated(q, pps_parameters, patient, reached, any, pps_largest, pps_whole_pose, drives, wanted, pose,
                                after) == PPS_OK);
        approach(q, wanted, pps_change, acceleration, reached, step);
        for (int j = 0; j < PPS_VARIABLES; j++) {
            REQUIRE(fabs(reached[j] - from[j]) <= pps_change[j] * (1.0 + 1e-9));
            REQUIRE(fabs(step[j] - before[j]) <= acceleration[j] * (1.0 + 1e-9));
            /* The path stands: no correction turns round. */
            REQUIRE(k <= 3300 || step[j] * (wanted[j] - from[j]) >= -1e-18);
        }
    }
    for (int j = 0; j < PPS_VARIABLES; j++) {
        REQUIRE(fabs(wanted[j] - reached[j]) < 1e-6 * pps_change[j]);
    }
    /* Beside a limit, drives stop at it. */
    for (int k = 0; k < 200; k++) {
        double q[PPS_VARIABLES];
        at(0.0, q);
        for (int j = 0; j < PPS_VARIABLES; j++) {
            wanted[j] = (k < 100) ? pps_largest[j] : -pps_largest[j];
            q[j] = pps_limits[j][(k < 100) ? 1 : 0] - 0.3 * wanted[j];
        }
        approach(q, wanted, pps_change, acceleration, reached, step);
        for (int j = 0; j < PPS_VARIABLES; j++) {
            REQUIRE(q[j] + reached[j] >= pps_limits[j][0] - 1e-9 && q[j] + reached[j] <= pps_limits[j][1] + 1e-9);
        }
    }
    /* Any distance, from rest. */
    for (int k = 1; k < 500; k++) {
        double q[PPS_VARIABLES];
        double steps[PPS_VARIABLES] = { 0.0 };
        double now[PPS_VARIABLES] = { 0.0 };
        double goal[PPS_VARIABLES];
        int cycles = 0;
        at(0.0, q);
        for (int j = 0; j < PPS_VARIABLES; j++) {
            goal[j] = ((j % 2) == 0 ? 0.013 : -0.013) * k * pps_change[j];
        }
        for (; cycles < 1000; cycles++) {
            double before[PPS_VARIABLES];
            memcpy(before, steps, sizeof before);
            approach(q, goal, pps_change, acceleration, now, steps);
            for (int j = 0; j < PPS_VARIABLES; j++) {
                REQUIRE(fabs(steps[j] - before[j]) <= acceleration[j] * (1.0 + 1e-9));
                REQUIRE(fabs(now[j]) <= fabs(goal[j]) + 1e-9 * pps_change[j]);
            }
        }
        for (int j = 0; j < PPS_VARIABLES; j++) {
            REQUIRE(fabs(now[j] - goal[j]) < 1e-9 * pps_change[j]);
        }
    }
    return 0;
}

int main(void)
{
    const int wrong = approaches();
    if (wrong != 0) {
        return wrong;
    }
    static const double far[PPS_VARIABLES] = { 20.0, 20.0, 20.0, 0.05, 0.01, 0.01 };
    static struct controller controller;
    double standing[PPS_VARIABLES];
    double begin[PPS_VARIABLES];
    double before[PPS_VARIABLES];
    double q[PPS_VARIABLES];
    at(0.0, standing);
    for (int stop = 0; stop < 200; stop++) {
        /* At the command that the drives carry out where they stand, none moves. */
        REQUIRE(resume(&controller, standing, begin) == PPS_OK);
        REQUIRE(cycle(&controller, begin) == 0);
        REQUIRE(moved(standing, controller.drives, begin, begin) < 1e-6);
        /* Along a path that begins beside them, until something stops it. */
        REQUIRE(resume(&controller, standing, begin) == PPS_OK);
        for (int k = 0; k < 30; k++) {
            double from[PPS_VARIABLES];
            memcpy(from, controller.drives, sizeof from);
            at(stop / 200.0 + k / 2000.0, q);
            /* The nearest joints of a pose are those of the path. */
            double pose[12];
            double joints[PPS_VARIABLES];
            REQUIRE(pps_pose(q, pps_parameters, pose) == PPS_OK);
            REQUIRE(commanded((k == 0) ? q : before, pose, joints) == 1);
            REQUIRE(moved(q, joints, q, q) < 1e-6);
            REQUIRE(cycle(&controller, q) == 0);
            REQUIRE(moved(from, controller.drives, q, (k == 0) ? q : before) <= 1.0 + 1e-9);
            memcpy(before, q, sizeof before);
        }
        memcpy(standing, controller.drives, sizeof standing);
        q[stop % 6] = (stop % 3 == 0) ? (double)NAN : (stop % 3 == 1) ? -1e4 : HUGE_VAL;
        const int fault = cycle(&controller, q);
        REQUIRE(fault != 0);
        /* Nothing but `resume` ends the fault, whatever the command is. */
        for (int k = 0; k < 20; k++) {
            REQUIRE(cycle(&controller, before) == fault);
            REQUIRE(memcmp(standing, controller.drives, sizeof standing) == 0);
        }
        /* A path that begins elsewhere is refused. */
        REQUIRE(resume(&controller, standing, begin) == PPS_OK);
        before[1] += (before[1] < 280.0) ? 100.0 : -100.0;
        REQUIRE(cycle(&controller, before) == ELSEWHERE);
        REQUIRE(memcmp(standing, controller.drives, sizeof standing) == 0);
        /* The drives are pushed while they stand. */
        at((stop + 1) / 200.0, standing);
        for (int j = 0; j < PPS_VARIABLES; j++) {
            standing[j] += (stop % 7) / 7.0 * far[j];
        }
    }
    return 0;
}
