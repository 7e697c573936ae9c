//! The shortest step of corrected commands in C: by normal equations as in the Rust code, or by
//! orthogonalization in single precision, where normal equations would lose all digits.

use super::real::Real;
use crate::print::compensated::Tolerances;

/// Solver of a step, with the constants that depend on the precision.
pub(super) struct Solver {
    /// Helper functions, the solver for fewer than six joints, and the solver for more.
    pub(super) texts: [&'static str; 3],
    pub(super) tolerances: Tolerances,
}

impl Solver {
    pub(super) fn new(real: Real) -> Self {
        match real {
            Real::Double => Self { texts: [SOLVE, BY_COLUMNS, BY_ROWS], tolerances: Tolerances::DOUBLE },
            // Rounding errors of a Jacobian of about one metre are 6e-8 and must not act like a
            // direction in which the tool moves. Rotations are weighted by 1/1000 and must be
            // solved down to a least singular value of 0.1, that is 1e-4. The damping lies between
            // the two, as in double precision. A pose is accurate to about 1e-6 m; such a singular
            // value amplifies that to 1e-5.
            Real::Float => Self {
                texts: [ORTHOGONALIZE, ORTHOGONAL_COLUMNS, ORTHOGONAL_ROWS],
                tolerances: Tolerances {
                    damping: f64::sqrt(abbe_core::compensator::DAMPING),
                    rest: 1e-5,
                    reached: [1e-5; 2],
                    least_sine: 1e-18,
                },
            },
        }
    }
}

/// Solver for fewer than six joints.
const BY_COLUMNS: &str = "\
/* Returns the shortest step: of (J^T J) x = J^T b. */
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

/// Solver for six joints or more.
const BY_ROWS: &str = "\
/* Returns the shortest step: J^T x of (J J^T) x = b. */
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
/* Iterated Tikhonov regularization by Cholesky factorization of M + lambda, for positive semidefinite M: the first
 * pass solves (M + lambda) x = b, each other one adds lambda (M + lambda)^-1 of the one before. x overwrites b. */
static void solve(double m[6][6], double *b)
{
    double x[6] = { 0.0 };
    for (int i = 0; i < 6; i++) {
        for (int j = 0; j <= i; j++) {
            const double rest = m[i][j] - dot(m[i], m[j], j);
            if (i == j) {
                m[i][j] = sqrt(((rest > 0.0) ? rest : 0.0) + DAMPING);
            } else {
                m[i][j] = rest / m[j][j];
            }
        }
    }
    for (int pass = 0; pass < PASSES; pass++) {
        for (int i = 0; i < 6; i++) {
            b[i] = (b[i] - dot(m[i], b, i)) / m[i][i];
        }
        for (int i = 5; i >= 0; i--) {
            double known = 0.0;
            for (int j = i + 1; j < 6; j++) {
                known += m[j][i] * b[j];
            }
            b[i] = (b[i] - known) / m[i][i];
        }
        for (int i = 0; i < 6; i++) {
            x[i] += b[i];
            b[i] *= DAMPING;
        }
    }
    for (int i = 0; i < 6; i++) {
        b[i] = x[i];
    }
}

";

/// Single precision: the squares of rows in radians, weighted by 1/1000, would have no significant
/// digits.
const ORTHOGONALIZE: &str = "\
/* QR factorization by Gram-Schmidt: overwrites the columns by orthonormal ones and fills r. The
 * entries of column j below row FULL + j are 0. */
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

/// Solver for fewer than six joints.
const ORTHOGONAL_COLUMNS: &str = "\
/* Returns the shortest step, by iterated Tikhonov regularization: each pass adds min |J x - b|^2 + lambda |x|^2 of
 * what b has left. */
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
    for (int pass = 0; pass < PASSES; pass++) {
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

/// Solver for six joints or more.
const ORTHOGONAL_ROWS: &str = "\
/* Returns the shortest step, by iterated Tikhonov regularization: each pass adds J^T (J J^T + lambda)^-1 of what b has
 * left. */
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
    for (int pass = 0; pass < PASSES; pass++) {
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
