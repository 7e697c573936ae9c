//! Repeatable errors of a machine as functions of the configuration.
//!
//! Errors of a chain, and the frames with them.

use abbe::{Error, Manipulator, Pose, repeatable_magnitudes};
use abbe_codegen::chain::deviations;
use abbe_codegen::graph::{Graph, Node};
use abbe_interpreter::Interpreter;
use abbe_spec::{ChainNumber, Spec, Symbol};

/// Part of the chain that an error changes.
#[derive(Clone, Copy, Debug)]
enum ErrorSite {
    /// One of the six errors of a frame: indices of frame and component.
    Frame(usize, usize),
    /// A joint variable, parameter or Denavit-Hartenberg number.
    Number(ChainNumber),
}

/// Error of one site by one source.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cause {
    /// Index among the enabled sources.
    pub(super) source: usize,
    site: ErrorSite,
}

/// Errors of all enabled sources.
pub(super) struct ErrorModel {
    /// Machine without errors of numbers of the chain: its effects are those of frames.
    frame_effects: Interpreter,
    graph: Graph,
    /// Causes of the effects of frames, then of the deviations.
    pub(super) causes: Vec<Cause>,
    /// Errors of numbers of the chain, nodes of `graph`.
    deviations: Vec<Node>,
    /// Factor of each source: its magnitude if it is repeatable, else 0.
    pub(super) magnitudes: Vec<f64>,
}

impl ErrorModel {
    /// Collects the errors of a spec, whose functions are those of `manipulator`.
    pub(super) fn new(spec: &Spec, manipulator: &Interpreter) -> Self {
        let mut without_deviations = spec.clone();
        without_deviations.sources.iter_mut().for_each(|source| source.deviations.clear());
        let frame_effects = Interpreter::new(without_deviations);
        let mut causes = Vec::new();
        for effect in frame_effects.description().effects.iter() {
            let site = ErrorSite::Frame(effect.frame, effect.component.index());
            causes.push(Cause { source: effect.source, site });
        }
        let (graph, of_numbers) = deviations(spec);
        causes.extend(
            of_numbers.iter().map(|of| Cause { source: of.source, site: ErrorSite::Number(of.number) }),
        );
        let deviations = of_numbers.into_iter().map(|deviation| deviation.error).collect();
        let magnitudes = repeatable_magnitudes(manipulator.description());
        Self { frame_effects, graph, causes, deviations, magnitudes }
    }

    /// Returns the value of every cause at a configuration, without the factors of the sources.
    pub(super) fn values(&self, q: &[f64], s: &[f64], u: &[f64]) -> Result<Vec<f64>, Error> {
        let mut values = vec![0.0; self.causes.len() - self.deviations.len()];
        self.frame_effects.effects(q, s, u, &mut values)?;
        let mut passive = vec![0.0; self.frame_effects.description().passive().count()];
        self.frame_effects.passive(q, s, &mut passive)?;
        let symbol = |symbol| match symbol {
            Symbol::Variable(i) => q[i],
            Symbol::Parameter(i) => s[i],
            Symbol::Input(i) => u[i],
            Symbol::Local(i) => passive[i],
            _ => 0.0,
        };
        values.extend(self.graph.evaluate(&self.deviations, symbol));
        Ok(values)
    }

    /// Returns the errors for one value per cause.
    pub(super) fn errors(&self, spec: &Spec, values: impl Iterator<Item = f64>) -> ChainErrors {
        let mut errors = ChainErrors::none(spec);
        for (cause, value) in self.causes.iter().zip(values) {
            let value = value * self.magnitudes[cause.source];
            *match cause.site {
                ErrorSite::Frame(frame, component) => &mut errors.frames[frame][component],
                ErrorSite::Number(ChainNumber::Joint(i)) => &mut errors.joints[i],
                ErrorSite::Number(ChainNumber::Parameter(i)) => &mut errors.parameters[i],
                ErrorSite::Number(ChainNumber::DenavitHartenberg { frame, number }) => {
                    &mut errors.dh_numbers[frame][number as usize]
                }
            } += value;
        }
        errors
    }
}

impl Cause {
    /// Returns the variable of the frame or joint that the error belongs to.
    pub(super) fn variable(&self, spec: &Spec) -> Option<usize> {
        match self.site {
            ErrorSite::Frame(frame, _) | ErrorSite::Number(ChainNumber::DenavitHartenberg { frame, .. }) => {
                spec.frames[frame].variable
            }
            ErrorSite::Number(ChainNumber::Joint(variable)) => Some(variable),
            ErrorSite::Number(ChainNumber::Parameter(_)) => None,
        }
    }
}

/// Errors of a chain at one configuration, or their means.
#[derive(Clone, Debug)]
pub(crate) struct ChainErrors {
    /// Generalized errors of each frame: `e_x e_y e_z e_s e_r e_p`.
    pub(crate) frames: Vec<[f64; 6]>,
    /// Errors of the joint variables.
    pub(crate) joints: Vec<f64>,
    /// Errors of the structural parameters.
    pub(crate) parameters: Vec<f64>,
    /// Errors of theta, d, a and alpha of each frame.
    pub(crate) dh_numbers: Vec<[f64; 4]>,
}

impl ChainErrors {
    /// Returns the errors of the nominal chain: zeros.
    pub(crate) fn none(spec: &Spec) -> Self {
        Self {
            frames: vec![[0.0; 6]; spec.frames.len()],
            joints: vec![0.0; spec.variables.len()],
            parameters: vec![0.0; spec.parameters.len()],
            dh_numbers: vec![[0.0; 4]; spec.frames.len()],
        }
    }
}

/// Frame of the real chain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// `A_i` with the errors of its numbers.
    pub(crate) transform: Pose,
    /// `E_i`.
    pub(crate) error: Pose,
}

impl Link {
    /// Returns `pose · A_i E_i`.
    pub(crate) fn after(&self, pose: &Pose) -> Pose {
        pose.then(&self.transform).then(&self.error)
    }
}

/// Returns the product `A_1 E_1 A_2 E_2 …`.
pub(crate) fn product(links: &[Link]) -> Pose {
    links.iter().fold(Pose::IDENTITY, |pose, link| link.after(&pose))
}

/// Returns `Rz(angle) Tz(shift)`.
pub(crate) fn about_z(angle: f64, shift: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    Pose([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, shift]])
}

/// Returns `Rx(angle) Tx(shift)`.
pub(crate) fn about_x(angle: f64, shift: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    Pose([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c], [shift, 0.0, 0.0]])
}
