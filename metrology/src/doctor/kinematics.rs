//! Poses of a spec, split into base, the frames up to the tool, and tool.

use abbe::{Error, Manipulator, Pose, VariableKind, analysis::sampling};
use abbe_interpreter::Interpreter;
use abbe_spec::{DhConvention, Frame, Spec};

use crate::interpretations::{Chain, Parts};

/// Spec that can be evaluated as written, or with its Denavit-Hartenberg parameters read in the
/// other convention.
pub(super) struct Kinematics {
    as_written: Interpreter,
    pub(super) other: Option<Interpreter>,
    parameters: Vec<f64>,
    kinds: Vec<VariableKind>,
    /// Frames from the base to the tool.
    path: Vec<usize>,
    /// Number of these before the first joint; 0 with passive joints, which have no order.
    fixed: usize,
    pub(super) has_tool: bool,
    metres: f64,
}

impl Kinematics {
    pub(super) fn new(spec: &Spec) -> Result<Self, Error> {
        let as_written = Interpreter::new(spec.clone());
        let other = spec.frames.iter().any(|frame| frame.convention.is_some()).then(|| {
            let frames = spec.frames.iter().map(in_other_convention).collect();
            Interpreter::new(Spec { frames, ..spec.clone() })
        });
        let (moving, path) = (spec.variables_of_transforms(), spec.path(Some(spec.tool_frame)));
        let fixed = match spec.passive.is_empty() {
            true => path.iter().take_while(|frame| moving[**frame].is_empty()).count(),
            false => 0,
        };
        let parameters = sampling::nominal_parameters(as_written.description());
        let home: Vec<f64> = spec.variables.iter().map(|variable| variable.home).collect();
        let mut kinematics = Self {
            parameters,
            kinds: spec.variables.iter().map(|variable| variable.kind).collect(),
            path,
            fixed,
            has_tool: true,
            metres: spec.length.in_metres(),
            as_written,
            other,
        };
        let [_, _, tool] = kinematics.parts(&home, false)?;
        kinematics.has_tool = tool != Pose::IDENTITY;
        Ok(kinematics)
    }

    /// Returns true if the chain starts with fixed frames.
    pub(super) fn has_base(&self) -> bool {
        self.fixed > 0
    }
}

impl Chain for Kinematics {
    fn kinds(&self) -> &[VariableKind] {
        &self.kinds
    }

    fn metres(&self) -> f64 {
        self.metres
    }

    fn parts(&self, q: &[f64], other_convention: bool) -> Result<Parts, Error> {
        let interpreter = self.other.as_ref().filter(|_| other_convention).unwrap_or(&self.as_written);
        let mut transforms = vec![Pose::IDENTITY; interpreter.description().frames.len() + 1];
        interpreter.transforms(q, &self.parameters, &mut transforms)?;
        let product =
            |all: &[usize]| all.iter().fold(Pose::IDENTITY, |product, next| product.then(&transforms[*next]));
        let (base, chain) = self.path.split_at(self.fixed);
        Ok([product(base), product(chain), transforms[transforms.len() - 1]])
    }
}

/// Returns the frame with the same four parameters in the other convention.
fn in_other_convention(frame: &Frame) -> Frame {
    let mut frame = frame.clone();
    let (Some(convention), [a, b, c, d]) = (frame.convention, &frame.factors[..]) else { return frame };
    // Factor order: standard theta, d, a, alpha; modified alpha, a, theta, d.
    let (factors, other) = match convention {
        DhConvention::Standard => ([d, c, a, b], DhConvention::Modified),
        DhConvention::Modified => ([c, d, b, a], DhConvention::Standard),
    };
    frame.factors = factors.map(Clone::clone).to_vec();
    frame.convention = Some(other);
    frame
}
