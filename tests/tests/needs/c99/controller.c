
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

int main(void)
{
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
