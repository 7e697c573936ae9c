//! Frames and legs of machines whose frames branch and close loops, with the mean errors.

use abbe::{Error, Manipulator, Pose, real_pose};
use abbe_codegen::chain::transform;
use abbe_codegen::graph::{Frame, Graph, Node};
use abbe_spec::Factor;
use abbe_spec::expr::{Expression, Symbol};

use super::real_machine::RealMachine;

/// Returns `true` if joint variables, or passive ones, move a transform.
pub(crate) fn moves(factors: &[Factor]) -> bool {
    factors.iter().flat_map(Factor::expressions).flat_map(Expression::symbols).any(Symbol::is_joint)
}

impl RealMachine {
    /// Returns a transform where all variables are 0; loops stay open.
    pub(crate) fn pose_at_zero(&self, factors: &[Factor]) -> Pose {
        let mut graph = Graph::with_tables(&self.spec.tables);
        let Frame { axes: [x, y, z], position } = transform(&mut graph, factors);
        Pose([x, y, z, position].map(|column| column.map(|node| self.at_zero(&graph, node))))
    }

    /// Returns the errors of a frame.
    pub(crate) fn mean_error(&self, frame: usize) -> Pose {
        real_pose(&[Pose::IDENTITY; 2], &self.mean.frames[frame..=frame])
    }

    /// Returns an amount where all variables are 0, and the variable that is added to it or
    /// subtracted from it, if any, with its sign; `None` if it is anything else.
    pub(crate) fn affine(&self, amount: &Expression) -> Option<(f64, Option<(Symbol, f64)>)> {
        let mut graph = Graph::with_tables(&self.spec.tables);
        let node = graph.lower(amount);
        let mut own = None;
        for symbol in amount.symbols().filter(|symbol| symbol.is_joint()) {
            // Nodes read passive variables as local symbols.
            let slope =
                graph.diff(node, if let Symbol::Passive(i) = symbol { Symbol::Local(i) } else { symbol });
            let sign = graph.value(slope).filter(|slope| slope.abs() == 1.0)?;
            if own.replace((symbol, sign)).is_some_and(|(other, _)| other != symbol) {
                return None;
            }
        }
        Some((self.at_zero(&graph, node), own))
    }

    fn at_zero(&self, graph: &Graph, node: Node) -> f64 {
        graph.evaluate(&[node], |symbol| match symbol {
            Symbol::Variable(i) => self.mean.joints[i],
            Symbol::Parameter(i) => self.s[i] + self.mean.parameters[i],
            _ => 0.0,
        })[0]
    }

    /// Returns the pose of the tool, loops closed.
    pub(crate) fn mean_tool(&self, q: &[f64]) -> Result<Pose, Error> {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
        let (q, s) = (sum(q, &self.mean.joints), sum(&self.s, &self.mean.parameters));
        self.manipulator.displaced_pose(&q, &s, &self.mean.frames)
    }
}
