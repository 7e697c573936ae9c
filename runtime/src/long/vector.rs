//! Arithmetic of three numbers.

use super::Motion;
use crate::Scalar;

pub(super) type Vector<T> = [T; 3];

#[inline(always)]
pub(super) fn zero<T: Scalar>() -> Vector<T> {
    [T::constant(0.0); 3]
}

#[inline(always)]
pub(super) fn add<T: Scalar>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(super) fn sub<T: Scalar>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a × b`.
#[inline(always)]
pub(super) fn cross<T: Scalar>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}

/// `R v`.
#[inline(always)]
pub(super) fn turn<T: Scalar>(motion: &Motion<T>, v: Vector<T>) -> Vector<T> {
    let [x, y, z, _] = motion;
    [
        x[0].mul_add(v[0], y[0].mul_add(v[1], z[0] * v[2])),
        x[1].mul_add(v[0], y[1].mul_add(v[1], z[1] * v[2])),
        x[2].mul_add(v[0], y[2].mul_add(v[1], z[2] * v[2])),
    ]
}

/// `p + R v`.
#[inline(always)]
pub(super) fn carry<T: Scalar>(motion: &Motion<T>, v: Vector<T>) -> Vector<T> {
    let [x, y, z, p] = motion;
    [
        x[0].mul_add(v[0], y[0].mul_add(v[1], z[0].mul_add(v[2], p[0]))),
        x[1].mul_add(v[0], y[1].mul_add(v[1], z[1].mul_add(v[2], p[1]))),
        x[2].mul_add(v[0], y[2].mul_add(v[1], z[2].mul_add(v[2], p[2]))),
    ]
}

/// One motion after the other.
#[inline(always)]
pub(super) fn then<T: Scalar>(first: &Motion<T>, second: &Motion<T>) -> Motion<T> {
    [turn(first, second[0]), turn(first, second[1]), turn(first, second[2]), carry(first, second[3])]
}

/// No motion.
#[inline(always)]
pub(super) fn identity<T: Scalar>() -> Motion<T> {
    let (zero, one) = (T::constant(0.0), T::constant(1.0));
    [[one, zero, zero], [zero, one, zero], [zero, zero, one], [zero; 3]]
}

/// Translation and rotation about x, y, z of six errors in the order of ε: `e_s` turns about y, `e_r` about z, `e_p`
/// about x.
#[inline(always)]
pub(super) fn vectors<T: Scalar>(errors: &[T; 6]) -> [Vector<T>; 2] {
    let [x, y, z, spin, roll, pitch] = *errors;
    [[x, y, z], [pitch, spin, roll]]
}
