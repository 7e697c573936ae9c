/* Sine and cosine. For |x| <= FAR the error is below ERROR units in the last place and results are
 * identical on all machines: Cody-Waite reduction by quarter turns, then minimax polynomials. For
 * larger |x|, and at 0, math.h is used. Requires rounding to nearest, and no contraction of
 * a * b + c. */
static void sin_cos(double x, double *sine, double *cosine)
{
    const double round = ROUND;
    if (!(fabs(x) <= RANGE) || !(fabs(x) > 0.0)) {
        *sine = sin(x);
        *cosine = cos(x);
        return;
    }
    const double rounded = x * TURNS + round;
    const double turns = rounded - round;
    const unsigned quadrant = (unsigned)(int)turns & 3U;
    double r = x - turns * QUARTER;
    REDUCTION
    const double z = r * r;
    if ((quadrant & 1U) != 0U) {
        r = -r;
    }
    POLYNOMIALS
    if ((quadrant & 1U) != 0U) {
        const double other = s;
        s = c;
        c = other;
    }
    *sine = ((quadrant & 2U) != 0U) ? -s : s;
    *cosine = ((quadrant & 2U) != 0U) ? -c : c;
}
