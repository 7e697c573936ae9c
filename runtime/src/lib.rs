//! What generated manipulators and their users call.
//!
//! A manipulator is a chain `A_T = A_1 A_2 … A_n · T` of frames, each followed in the real machine by six
//! small [generalized errors](Component). Generated modules (and the interpreter) give the closed form of its
//! pose and of its error Jacobian `J_e = ∂X_T/∂ε`, so that `ΔX ≈ J_e ε`; this crate gives them their types,
//! the exact chain to check them against, and the analysis of a machine's errors over its workspace.
//!
//! The core is `no_std`, never allocates, and is all that poses, Jacobians and compensated commands need. Only `std` is on
//! by default:
//!
//! | feature | brings | and builds |
//! |---|---|---|
//! | `std` | the platform's own functions in place of `libm`'s | |
//! | `nalgebra` | poses and Jacobians as nalgebra types, without copying | nalgebra |
//! | `lanes` | the module `lanes`: many configurations at once | bytemuck, pulp |
//! | `analysis` | the modules `analysis` (errors over a workspace) and `laws` (tests of your manipulator) | those of `lanes` and `nalgebra`, rand |
//! | `identify` | the modules `identify` (errors from measurements) and `control` (charts of a machine that is checked again and again) | those of `analysis` |
//! | `parallel` | sweeps on all cores: the same results, sooner | those of `analysis`, rayon |
//! | `serde` | errors, and parts of budgets, that can be written and read | those of `analysis`, serde |
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
