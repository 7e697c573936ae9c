//! What one source does alone over the workspace, in three metrics.

use super::sampling::norm;
use crate::Class;

/// A figure per axis of `F_0`, and of the norm of the position error. In the length unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Figures {
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// Along z.
    pub z: f64,
    /// Of the norm.
    pub norm: f64,
}

impl From<[f64; 4]> for Figures {
    fn from([x, y, z, norm]: [f64; 4]) -> Self {
        Self { x, y, z, norm }
    }
}

/// What one source does alone over the workspace.
///
/// ΔX(q) is the position error of a repeatable source. Of a random one b(q) is the bound: what is drawn lies
/// anywhere between −b(q) and +b(q), all effects of the source together.
///
/// | metric | repeatable | random |
/// |---|---|---|
/// | plain maximum | max \|ΔX\|; max ‖ΔX‖ | max \|b\|; max ‖b‖ |
/// | half peak-to-peak | (max ΔX − min ΔX) / 2; (max ‖ΔX‖ − min ‖ΔX‖) / 2 | as plain: the interval is symmetric |
/// | relative to home | max \|ΔX(q) − ΔX(home)\|; max ‖ΔX(q) − ΔX(home)‖ | worst difference of two draws: max \|b(q)\| + \|b(home)\|; max ‖b(q) ± b(home)‖ |
///
/// All are zero for an empty workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceErrors {
    /// Index of the source.
    pub source: usize,
    /// Repeatable or random.
    pub class: Class,
    /// The largest error.
    pub plain_max: Figures,
    /// Half of what the error varies by.
    pub half_peak_to_peak: Figures,
    /// The largest difference from the error at home.
    pub relative_to_home: Figures,
    /// The root mean square of the norm of the error over the configurations.
    pub rms: f64,
    /// The largest of each of rows 4–6, rad.
    pub orientation: [f64; 3],
    /// Index of the configuration with the largest norm; none for an empty workspace.
    pub worst: Option<usize>,
}

/// Gathers [`SourceErrors`] configuration by configuration.
pub(super) struct Tally {
    home: [f64; 6],
    least: [f64; 4],
    largest: [f64; 4],
    count: usize,
    squares: f64,
    errors: SourceErrors,
}

impl Tally {
    /// Of a source with this error (bound, if random) at home.
    pub(super) fn new(source: usize, class: Class, home: [f64; 6]) -> Self {
        let none = Figures::default();
        let errors = SourceErrors {
            source,
            class,
            plain_max: none,
            half_peak_to_peak: none,
            relative_to_home: none,
            rms: 0.0,
            orientation: [0.0; 3],
            worst: None,
        };
        let (least, largest) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        Self { home, least, largest, count: 0, squares: 0.0, errors }
    }

    /// Takes in the error (bound, if random) at a configuration.
    pub(super) fn add(&mut self, index: usize, deviation: &[f64; 6]) {
        let position = position(deviation);
        let [x, y, z] = position;
        let figures = [x, y, z, norm(position)];
        for (i, &figure) in figures.iter().enumerate() {
            self.least[i] = self.least[i].min(figure);
            self.largest[i] = self.largest[i].max(figure);
        }
        self.count += 1;
        self.squares += figures[3] * figures[3];
        let errors = &mut self.errors;
        if errors.worst.is_none() || figures[3] > errors.plain_max.norm {
            errors.worst = Some(index);
        }
        errors.plain_max = errors.plain_max.or_larger(figures);
        for (largest, row) in errors.orientation.iter_mut().zip(&deviation[3..]) {
            *largest = largest.max(row.abs());
        }
        let relative = relative(errors.class, position, self::position(&self.home));
        errors.relative_to_home = errors.relative_to_home.or_larger(relative);
    }

    pub(super) fn finish(self) -> SourceErrors {
        let mut errors = self.errors;
        errors.rms = (self.squares / self.count.max(1) as f64).sqrt();
        errors.half_peak_to_peak = match errors.class {
            Class::Random(_) => errors.plain_max,
            Class::Repeatable if errors.worst.is_none() => Figures::default(),
            Class::Repeatable => core::array::from_fn(|i| (self.largest[i] - self.least[i]) / 2.0).into(),
        };
        errors
    }
}

impl Figures {
    fn or_larger(self, [x, y, z, norm]: [f64; 4]) -> Self {
        Self {
            x: self.x.max(x.abs()),
            y: self.y.max(y.abs()),
            z: self.z.max(z.abs()),
            norm: self.norm.max(norm),
        }
    }
}

/// The (worst) difference from home, per axis and its norm.
///
/// The difference of two draws `t b(q) − t' b(home)` is worst where t and t' are ±1.
fn relative(class: Class, here: [f64; 3], home: [f64; 3]) -> [f64; 4] {
    let difference = core::array::from_fn(|i| here[i] - home[i]);
    let [x, y, z] = difference;
    match class {
        Class::Repeatable => [x, y, z, norm(difference)],
        Class::Random(_) => {
            let sum = core::array::from_fn(|i| here[i] + home[i]);
            let [x, y, z] = core::array::from_fn(|i| here[i].abs() + home[i].abs());
            [x, y, z, norm(difference).max(norm(sum))]
        }
    }
}

/// Rows 1–3.
pub(super) fn position(deviation: &[f64; 6]) -> [f64; 3] {
    [deviation[0], deviation[1], deviation[2]]
}
