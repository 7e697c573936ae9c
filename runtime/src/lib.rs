//! The types, the exact chain and the error analysis that generated manipulators and their users
//! call.
//!
//! A manipulator is a chain `A_T = A_1 A_2 … A_n · T` of frames. In the real machine six small
//! [generalized errors](Component) follow each frame. Generated modules (and the interpreter)
//! evaluate its pose and its error Jacobian `J_e = ∂X_T/∂ε` in closed form, so that `ΔX ≈ J_e ε`.
//! This crate defines their types, the exact chain that verifies them, and the analysis of a
//! machine's errors over its workspace.
//!
//! The core is `no_std` and never allocates. It suffices for poses, Jacobians and compensated
//! commands. Only the feature `std` is on by default:
//!
//! | feature | adds | dependencies |
//! |---|---|---|
//! | `std` | the platform's math functions in place of `libm`'s | |
//! | `nalgebra` | views of poses and Jacobians as nalgebra types, without copying | nalgebra |
//! | `lanes` | the module `lanes`: batches of configurations in SIMD lanes | bytemuck, pulp |
//! | `analysis` | the modules `analysis` (errors over a workspace) and `laws` (tests for your own manipulator) | those of `lanes` and `nalgebra`, rand |
//! | `identify` | the modules `identify` (errors from measurements) and `control` (control charts for repeated checks) | those of `analysis` |
//! | `parallel` | multithreaded sweeps with the same results | those of `analysis`, rayon |
//! | `serde` | serialization of errors and of partial budgets | those of `analysis`, serde |
//!
//! | convention | here |
//! |---|---|
//! | frames | `A_i` takes `F_i` coordinates to `F_{i-1}`; the tool comes after `E_n` |
//! | generalized errors | `e_x e_y e_z e_s e_r e_p` per frame; spin turns about **Y**, roll about **Z**, pitch about **X** |
//! | rows of a Jacobian | x, y, z of the tool point in `F_0`, then three of [`Orientation`] |
//! | columns of `J_e` | six per frame, frame 1 first |
//! | arrays | column-major: a 6 × 36 Jacobian is `[[f64; 6]; 36]`, a pose `[[f64; 3]; 4]` |
//! | units | the spec's length unit, radians |
#![cfg_attr(not(feature = "std"), no_std)]

pub use abbe_core::*;

#[cfg(feature = "analysis")]
pub use abbe_analysis as analysis;
#[cfg(feature = "identify")]
pub use abbe_calibration::{control, identify};
