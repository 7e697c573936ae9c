//! The shortest step of corrected commands in C: by squares, as the Rust code has it, or by orthogonal columns where squares
//! would have no digits left.

use super::real::Real;
use crate::print::compensated::Tolerances;

/// How a step is found, and the numbers that depend on how many digits there are.
pub(super) struct Solver {
    /// What is needed first, then the step of six joints or fewer, and that of more.
    pub(super) texts: [&'static str; 3],
    pub(super) tolerances: Tolerances,
}

impl Solver {
    pub(super) fn of(real: Real) -> Self {
        match real {
            Real::Double => Self { texts: [SOLVE, BY_COLUMNS, BY_ROWS], tolerances: Tolerances::DOUBLE },
            // Steps are bounded where rounding, 6e-8 of a Jacobian of about one metre, would be taken for a direction in which
            // the tool moves; turns, which count a thousandth, are wanted down to a least singular value of 0.1, 1e-4: between
            // the two. A pose is known to about 1e-6 m, which such a singular value makes 1e-5.
            Real::Float => Self {
                texts: [ORTHOGONALIZE, ORTHOGONAL_COLUMNS, ORTHOGONAL_ROWS],
                tolerances: Tolerances { damping: 3e-6, rest: 1e-5, least_sine: 1e-18 },
            },
        }
    }
}

/// Of six joints or fewer.
const BY_COLUMNS: &str = "\
/* The shortest step, (J^T J + lambda)^-1 J^T b. */
static void shortest(double columns[COUNT][6], const double *b, double *step)
{
    double m[6][6] = { { 0.0 } };
    double x[6] = { 0.0 };
    for (int i = 0; i < COUNT; i++) {
        x[i] = dot(columns[i], b, 6);
        for (int j = 0; j <= i; j++) {
            m[i][j] = dot(columns[i], columns[j], 6);
        }
    }
    solve(m, x);
    for (int k = 0; k < COUNT; k++) {
        step[k] = x[k];
    }
}
";

/// Of more joints.
const BY_ROWS: &str = "\
/* The shortest step, J^T (J J^T + lambda)^-1 b. */
static void shortest(double columns[COUNT][6], const double *b, double *step)
{
    double m[6][6] = { { 0.0 } };
    double x[6];
    for (int i = 0; i < 6; i++) {
        x[i] = b[i];
        for (int j = 0; j < 6; j++) {
            for (int k = 0; k < COUNT; k++) {
                m[i][j] += columns[k][i] * columns[k][j];
            }
        }
    }
    solve(m, x);
    for (int k = 0; k < COUNT; k++) {
        step[k] = dot(columns[k], x, 6);
    }
}
";

const SOLVE: &str = "\
/* (M + lambda) x = b by Cholesky, for M positive semidefinite; b becomes x. */
static void solve(double m[6][6], double *b)
{
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j <= i; j++) {
            const double rest = m[i][j] - dot(m[i], m[j], j);
            if (i == j) {
                m[i][j] = sqrt(((rest > 0.0) ? rest : 0.0) + DAMPING);
            } else {
                m[i][j] = rest / m[j][j];
            }
        }
        b[i] = (b[i] - dot(m[i], b, i)) / m[i][i];
    }
    for (int i = 5; i >= 0; i--) {
        double known = 0.0;
        for (int j = i + 1; j < 6; j++) {
            known += m[j][i] * b[j];
        }
        b[i] = (b[i] - known) / m[i][i];
    }
}

";

/// In single precision: squares of the columns, whose rows in rad are a thousandth of the others, would have no digits left.
const ORTHOGONALIZE: &str = "\
/* Gram and Schmidt: the columns become orthogonal to each other and of length 1, and r is what they were made of. Column j has
 * nothing below row FULL + j. */
static void orthogonalize(double a[RANK][LONG], double r[RANK][RANK])
{
    for (int j = 0; j < RANK; j++) {
        for (int k = 0; k < j; k++) {
            r[k][j] = dot(a[k], a[j], FULL + 1 + k);
            for (int i = 0; i <= FULL + k; i++) {
                a[j][i] -= r[k][j] * a[k][i];
            }
        }
        r[j][j] = sqrt(dot(a[j], a[j], FULL + 1 + j));
        for (int i = 0; i <= FULL + j; i++) {
            a[j][i] /= r[j][j];
        }
    }
}

";

/// Of six joints or fewer.
const ORTHOGONAL_COLUMNS: &str = "\
/* The shortest step, min |J x - b|^2 + lambda |x|^2, and once more for what it leaves. */
static void shortest(double columns[COUNT][6], const double *b, double *step)
{
    double a[COUNT][LONG] = { { 0.0 } };
    double r[COUNT][COUNT];
    double left[6];
    for (int j = 0; j < COUNT; j++) {
        for (int i = 0; i < 6; i++) {
            a[j][i] = columns[j][i];
        }
        a[j][6 + j] = DAMPING;
        step[j] = 0.0;
    }
    orthogonalize(a, r);
    for (int i = 0; i < 6; i++) {
        left[i] = b[i];
    }
    for (int time = 0; time < 2; time++) {
        double x[COUNT];
        for (int j = COUNT - 1; j >= 0; j--) {
            x[j] = dot(a[j], left, 6);
            for (int k = j + 1; k < COUNT; k++) {
                x[j] -= r[j][k] * x[k];
            }
            x[j] /= r[j][j];
        }
        for (int j = 0; j < COUNT; j++) {
            step[j] += x[j];
            for (int i = 0; i < 6; i++) {
                left[i] -= columns[j][i] * x[j];
            }
        }
    }
}
";

/// Of more joints.
const ORTHOGONAL_ROWS: &str = "\
/* The shortest step, J^T (J J^T + lambda)^-1 b, and once more for what it leaves. */
static void shortest(double columns[COUNT][6], const double *b, double *step)
{
    double a[6][LONG] = { { 0.0 } };
    double r[6][6];
    double left[6];
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j < COUNT; j++) {
            a[i][j] = columns[j][i];
        }
        a[i][COUNT + i] = DAMPING;
        left[i] = b[i];
    }
    for (int j = 0; j < COUNT; j++) {
        step[j] = 0.0;
    }
    orthogonalize(a, r);
    for (int time = 0; time < 2; time++) {
        double y[6];
        for (int i = 0; i < 6; i++) {
            y[i] = left[i];
            for (int k = 0; k < i; k++) {
                y[i] -= r[k][i] * y[k];
            }
            y[i] /= r[i][i];
        }
        for (int j = 0; j < COUNT; j++) {
            double x = 0.0;
            for (int i = 0; i < 6; i++) {
                x += a[i][j] * y[i];
            }
            step[j] += x;
            for (int i = 0; i < 6; i++) {
                left[i] -= columns[j][i] * x;
            }
        }
    }
}
";
