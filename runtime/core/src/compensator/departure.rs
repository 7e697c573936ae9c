//! Step within the bounds of the cycle, by iterated Tikhonov regularization.
//!
//! Without bounds, the share `(λ / (σ² + λ))^m` of `b` is left after m passes along a singular
//! vector with the singular value σ. With more passes the step is exact closer to a singular pose,
//! and at the pose it is as short as one pass makes it with a smaller λ (Engl, Hanke, Neubauer:
//! Regularization of Inverse Problems, 1996, chapter 5).
//!
//! Passes about 0 forget what the cycle before had, so that the bound of a change holds in the last
//! one only.
//!
//! Within bounds, a pass minimizes a strictly convex function over a box (`l ≤ d ≤ u`). Its minimum
//! has `d_j = clamp(c_j + J_jᵀ z)` with `z = (b − J d) / λ`, where c is the result of the pass
//! before. Joints are free or held at an end, as Stark and Parker do (Bounded-variable least
//! squares, Computational Statistics 10, 1995): d moves towards the minimum of the free joints, up
//! to the first end that one of them meets, which is then held. At that minimum, of the held joints
//! whose `clamp(c_j + J_jᵀ z)` is elsewhere, the one whose `c_j + J_jᵀ z` is furthest is released.
//! Every move reduces the function, so that no set of held joints comes twice, except by rounding:
//! a joint is released at most [`RELEASES`] times in a pass. `held` counts: it is −r for a free
//! joint that was released r times, 1 + r for a held one.

use super::shortest::{add, dot, pull};
use super::{Bounds, Problem, clamped};
use crate::Scalar;

/// Number of passes m.
pub const PASSES: usize = 4;

/// Largest number of times that a joint is released in a pass.
pub const RELEASES: f64 = 2.0;

/// Returns the largest number of systems of six equations that are solved in a cycle: each joint
/// may meet its bounds and leave them several times.
pub const fn solves(variables: usize) -> usize {
    8 * (variables + 1)
}

impl Problem<'_> {
    /// Sets `towards` to the command + d, from `q`, where `left` is left. Weights the columns.
    pub(super) fn depart<Q: Clone + AsRef<[f64]> + AsMut<[f64]>>(
        &self,
        bounds: &Bounds<Q>,
        q: &Q,
        towards: &mut Q,
        columns: &mut [[f64; 6]],
        left: &[f64; 6],
        solved: &mut usize,
    ) {
        let mut wanted = self.weighted(*left).map(|row| -row);
        let [mut d, mut center, mut goal, mut held, mut lower, mut upper] = [(); 6].map(|()| q.clone());
        let [d, center, goal, held, lower, upper] =
            [&mut d, &mut center, &mut goal, &mut held, &mut lower, &mut upper].map(AsMut::as_mut);
        // In rad and metres from the command.
        let about = |q: &Q, j: usize| (q.as_ref()[j] - bounds.command.as_ref()[j]) / self.unit(j);
        for (j, column) in columns.iter_mut().enumerate() {
            (lower[j], upper[j], center[j]) = (about(&bounds.least, j), about(&bounds.most, j), 0.0);
            *column = self.weighted(column.map(|entry| entry * self.unit(j)));
            d[j] = about(q, j);
            add(&mut wanted, column, d[j]);
            (d[j], held[j]) = within(d[j], [lower[j], upper[j]]);
        }
        let mut passes = 0;
        while passes < PASSES && *solved < solves(d.len()) {
            *solved += 1;
            let mut b = wanted;
            for (j, column) in columns.iter().enumerate() {
                add(&mut b, column, if held[j] > 0.0 { -d[j] } else { -center[j] });
            }
            let pull = pull(columns, held, &b);
            let (mut share, mut first) = (1.0, None);
            for (j, column) in columns.iter().enumerate() {
                goal[j] = center[j] + dot(column, &pull);
                let end = clamped(goal[j], [lower[j], upper[j]]);
                if held[j] > 0.0 || end == goal[j] {
                    continue;
                }
                let part = (end - d[j]) / (goal[j] - d[j]);
                if part < share {
                    (share, first) = (part, Some((j, end)));
                }
            }
            for j in (0..d.len()).filter(|j| held[*j] <= 0.0) {
                d[j] = clamped(d[j] + share * (goal[j] - d[j]), [lower[j], upper[j]]);
            }
            if let Some((j, end)) = first {
                (held[j], d[j]) = (1.0 - held[j], end);
                continue;
            }
            let (mut furthest, mut released) = (0.0, None);
            for j in (0..d.len()).filter(|j| 0.0 < held[*j] && held[*j] <= RELEASES) {
                let far = Scalar::abs(goal[j] - d[j]);
                if clamped(goal[j], [lower[j], upper[j]]) != d[j] && far > furthest {
                    (furthest, released) = (far, Some(j));
                }
            }
            if let Some(j) = released {
                held[j] = -held[j];
                continue;
            }
            passes += 1;
            center.copy_from_slice(d);
            held.iter_mut().for_each(|held| *held = clamped(*held, [0.0, 1.0]));
            if passes == PASSES - 1 {
                for j in 0..d.len() {
                    (lower[j], upper[j]) = (about(&bounds.lower, j), about(&bounds.upper, j));
                    (d[j], held[j]) = within(d[j], [lower[j], upper[j]]);
                }
            }
        }
        for j in 0..d.len() {
            let (low, high) = (bounds.lower.as_ref()[j], bounds.upper.as_ref()[j]);
            let inside = clamped(bounds.command.as_ref()[j] + d[j] * self.unit(j), [low, high]);
            towards.as_mut()[j] = match () {
                () if d[j] <= lower[j] => low,
                () if d[j] >= upper[j] => high,
                () => inside,
            };
        }
    }
}

/// Returns the nearest number of an interval, and 1 at its ends or beyond them, else 0.
fn within(number: f64, [lower, upper]: [f64; 2]) -> (f64, f64) {
    (clamped(number, [lower, upper]), if lower < number && number < upper { 0.0 } else { 1.0 })
}
