//! Integrals and roots of smooth functions.

/// Nonnegative nodes of the Gauss–Kronrod rule with 7 and 15 points on [−1, 1], and the weights of
/// both. The Gauss weight is 0 where the 7-point rule has no node.
const NODES: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0),
    (0.741_531_185_599_394_5, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_42, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_89, 0.0),
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];
/// Largest number of bisections of an interval.
const DEPTH: usize = 30;

/// Returns `∫ f` from `from` to `to`. Bisects an interval until its two rules, with 7 and 15
/// points, differ by less than `error`, and uses the 15-point rule, whose error is far smaller.
pub(super) fn integral(f: &dyn Fn(f64) -> f64, from: f64, to: f64, error: f64) -> f64 {
    let quarter = (to - from) / 4.0;
    let part =
        |i: i32| adaptive(f, from + quarter * f64::from(i), from + quarter * f64::from(i + 1), error, DEPTH);
    (0..4).map(part).sum()
}

fn adaptive(f: &dyn Fn(f64) -> f64, from: f64, to: f64, error: f64, depth: usize) -> f64 {
    let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
    let (mut fine, mut coarse) = (0.0, 0.0);
    for (node, kronrod, gauss) in NODES {
        let both = match node {
            0.0 => f(middle),
            _ => f(middle - half * node) + f(middle + half * node),
        };
        fine += kronrod * both;
        coarse += gauss * both;
    }
    let apart = (fine - coarse).abs() * half;
    if depth == 0 || apart <= error || apart.is_nan() {
        return fine * half;
    }
    adaptive(f, from, middle, error, depth - 1) + adaptive(f, middle, to, error, depth - 1)
}

/// Returns the root of an increasing function in a bracket, by the Illinois variant of the secant
/// method, until the bracket is closed.
pub(super) fn root(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (mut below, mut above) = (value(low), value(high));
    let mut side = 0;
    while high - low > 1e-14 * high {
        let chord = (low * above - high * below) / (above - below);
        let middle = if low < chord && chord < high { chord } else { (low + high) / 2.0 };
        let here = value(middle);
        if here.abs() < 1e-12 || middle <= low || middle >= high {
            return middle;
        }
        if here < 0.0 {
            (low, below) = (middle, here);
            above = if side == -1 { above / 2.0 } else { above };
            side = -1;
        } else {
            (high, above) = (middle, here);
            below = if side == 1 { below / 2.0 } else { below };
            side = 1;
        }
    }
    (low + high) / 2.0
}

#[cfg(test)]
mod tests;
