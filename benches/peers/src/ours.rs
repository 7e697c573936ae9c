//! Our rows, and the baseline: the loop over frames.

/// Returns the rows of a generated module, one configuration at a time. Add the row of a new
/// function here: `Row::jacobian`, or `Row::given` if it takes ε or σ².
macro_rules! rows {
    ($module:path) => {{
        use $crate::row::{Kind, Row, Side};
        use $module::{DISTINCT, ERRORS, FRAMES, VARIABLES, raw};

        type Pose = [[f64; 3]; 4];
        type Columns = [[f64; 6]; ERRORS];

        // Never inlined into the calling loop, like the peers' functions.
        #[inline(never)]
        fn dense(q: &[f64; VARIABLES], pose: &mut Pose, columns: &mut Columns) {
            raw::error_jacobian(q, &[], pose, columns);
        }

        #[inline(never)]
        fn distinct(q: &[f64; VARIABLES], pose: &mut Pose, numbers: &mut [[[f64; 3]; DISTINCT]; FRAMES]) {
            raw::error_jacobian_distinct(q, &[], pose, numbers);
        }

        #[inline(never)]
        fn displacement(q: &[f64; VARIABLES], errors: &[[f64; 6]; FRAMES], shift: &mut [f64; 6]) {
            raw::displacement(q, &[], errors, shift);
        }

        #[inline(never)]
        fn covariance(q: &[f64; VARIABLES], variances: &[[f64; 6]; FRAMES], result: &mut [[f64; 6]; 6]) {
            raw::covariance(q, &[], variances, result);
        }

        #[inline(never)]
        fn by_loop(q: &[f64; VARIABLES], pose: &mut Pose, columns: &mut Columns) {
            let mut transforms = [[[0.0; 3]; 4]; FRAMES + 1];
            raw::transforms(q, &[], &mut transforms);
            let mut poses = [abbe_tests::frame_loop::Frame::default(); FRAMES + 1];
            *pose = abbe_tests::frame_loop::error_jacobian(&transforms, &mut poses, columns);
        }

        #[inline(never)]
        fn displacement_by_loop(q: &[f64; VARIABLES], errors: &[[f64; 6]; FRAMES], shift: &mut [f64; 6]) {
            let (mut pose, mut columns) = ([[0.0; 3]; 4], [[0.0; 6]; ERRORS]);
            by_loop(q, &mut pose, &mut columns);
            *shift = [0.0; 6];
            for (column, error) in columns.iter().zip(errors.as_flattened()) {
                for (sum, entry) in shift.iter_mut().zip(column) {
                    *sum += entry * error;
                }
            }
        }

        #[inline(never)]
        fn covariance_by_loop(
            q: &[f64; VARIABLES],
            variances: &[[f64; 6]; FRAMES],
            result: &mut [[f64; 6]; 6],
        ) {
            let (mut pose, mut columns) = ([[0.0; 3]; 4], [[0.0; 6]; ERRORS]);
            by_loop(q, &mut pose, &mut columns);
            *result = [[0.0; 6]; 6];
            for (column, variance) in columns.iter().zip(variances.as_flattened()) {
                for (sums, entry) in result.iter_mut().zip(column) {
                    let weighted = variance * entry;
                    for (sum, entry) in sums.iter_mut().zip(column) {
                        *sum += weighted * entry;
                    }
                }
            }
        }

        // Adapts a function of arrays to slices: all rows write to the same memory.
        macro_rules! jacobian {
            ($name:expr, $side:expr, $kind:expr, $function:expr, $chunks:ident) => {
                Row::jacobian($name, $side, $kind, |q, pose, result| {
                    let q = q.try_into().expect("all variables");
                    let pose = pose.as_chunks_mut().0.first_chunk_mut().expect("room for a pose");
                    $function(q, pose, $crate::ours::$chunks!(result));
                })
            };
        }
        macro_rules! given {
            ($name:expr, $side:expr, $kind:expr, $function:expr, $chunks:ident) => {
                Row::given($name, $side, $kind, |q, given, result| {
                    let q = q.try_into().expect("all variables");
                    let given = given.as_chunks().0.try_into().expect("six a frame");
                    $function(q, given, $crate::ours::$chunks!(result));
                })
            };
        }

        let (ours, by_hand) = ("abbe, Rust", "nalgebra, loop over frames");
        vec![
            jacobian!(ours, Side::Ours, Kind::Dense, dense, columns),
            jacobian!(ours, Side::Ours, Kind::Distinct, distinct, vectors),
            given!(ours, Side::Ours, Kind::Displacement, displacement, numbers),
            given!(ours, Side::Ours, Kind::Covariance, covariance, columns),
            jacobian!(by_hand, Side::Baseline, Kind::Dense, by_loop, columns),
            given!(by_hand, Side::Baseline, Kind::Displacement, displacement_by_loop, numbers),
            given!(by_hand, Side::Baseline, Kind::Covariance, covariance_by_loop, columns),
        ]
    }};
}

/// Returns the first numbers of a slice as an array.
macro_rules! numbers {
    ($slice:ident) => {
        $slice.first_chunk_mut().expect("room for all")
    };
}

/// Returns the first columns in a slice as an array.
macro_rules! columns {
    ($slice:ident) => {
        $slice.as_chunks_mut().0.first_chunk_mut().expect("room for all")
    };
}

/// Returns the first groups of vectors in a slice as an array.
macro_rules! vectors {
    ($slice:ident) => {
        $slice.as_chunks_mut().0.as_chunks_mut().0.first_chunk_mut().expect("room for all")
    };
}

pub(crate) use {columns, numbers, rows, vectors};
