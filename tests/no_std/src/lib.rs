//! Error of the patient positioner, for a controller without an operating system.
#![no_std]

include!("../../golden/pps.rs");

/// Returns the error of the treatment point along x at `q`, in mm. NaN if it cannot be evaluated.
///
/// # Safety
/// `q` points to six numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sideways_error(q: *const [f64; 6]) -> f64 {
    let (q, s) = (unsafe { &*q }, pps::Parameters::NOMINAL);
    let errors = pps::generalized_errors(q, &s, &pps::Inputs::NOMINAL);
    match (pps::error_jacobian(q, &s), errors) {
        (Ok((_, columns)), Ok(errors)) => {
            columns.iter().zip(errors.as_flattened()).map(|(column, error)| column[0] * error).sum()
        }
        _ => f64::NAN,
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
