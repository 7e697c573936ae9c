//! Our rows, and the loop over frames that they are compared with.

use crate::row::{Kind, Row, Side};

/// A function of a generated module.
pub type Jacobian<const VARIABLES: usize, const COLUMNS: usize> =
    fn(&[f64; VARIABLES], &mut [[f64; 3]; 4], &mut [[f64; 6]; COLUMNS]);

/// The row of such a function, in the memory that all share.
pub fn dense<const VARIABLES: usize, const COLUMNS: usize>(
    name: &'static str,
    side: Side,
    function: Jacobian<VARIABLES, COLUMNS>,
) -> Row {
    Row::jacobian(name, side, Kind::Dense, move |q, pose, result| {
        let q = q.try_into().expect("all variables");
        let pose = pose.as_chunks_mut().0.first_chunk_mut().expect("room for a pose");
        let columns = result.as_chunks_mut().0.first_chunk_mut().expect("room for all columns");
        function(q, pose, columns);
    })
}

/// The rows of a generated module. **New paths get their row here**: `Row::jacobian` and `Row::displacement` for
/// functions of one configuration, `Row::batch` for those of many.
macro_rules! rows {
    ($module:path) => {{
        use $crate::row::{Row, Side};
        use $module::{ERRORS, FRAMES, VARIABLES, raw};

        // Like the peers' functions, none is merged with the loop that calls it.
        #[inline(never)]
        fn dense(q: &[f64; VARIABLES], pose: &mut [[f64; 3]; 4], columns: &mut [[f64; 6]; ERRORS]) {
            raw::error_jacobian(q, &[], pose, columns);
        }

        #[inline(never)]
        fn by_loop(q: &[f64; VARIABLES], pose: &mut [[f64; 3]; 4], columns: &mut [[f64; 6]; ERRORS]) {
            let mut transforms = [[[0.0; 3]; 4]; FRAMES + 1];
            raw::transforms(q, &[], &mut transforms);
            let mut poses = [abbe_tests::frame_loop::Frame::default(); FRAMES + 1];
            *pose = abbe_tests::frame_loop::error_jacobian(&transforms, &mut poses, columns);
        }

        #[inline(never)]
        fn by_loop_displacement(q: &[f64; VARIABLES], errors: &[f64; ERRORS], shift: &mut [f64; 6]) {
            let (mut pose, mut columns) = ([[0.0; 3]; 4], [[0.0; 6]; ERRORS]);
            by_loop(q, &mut pose, &mut columns);
            *shift = [0.0; 6];
            for (column, error) in columns.iter().zip(errors) {
                for (sum, entry) in shift.iter_mut().zip(column) {
                    *sum += entry * error;
                }
            }
        }

        vec![
            $crate::ours::dense("abbe, Rust", Side::Ours, dense),
            $crate::ours::dense("nalgebra, loop over frames", Side::Baseline, by_loop),
            Row::displacement("nalgebra, loop over frames", Side::Baseline, |q, errors, shift| {
                let q = q.try_into().expect("all variables");
                let errors = errors.try_into().expect("six a frame");
                let (shift, _) = shift.split_first_chunk_mut().expect("room for six");
                by_loop_displacement(q, errors, shift);
            }),
        ]
    }};
}

pub(crate) use rows;
