//! The functions of long chains as loops over their frames.
//!
//! Straight-line code of long chains outgrows the instruction cache and takes its time to compile. The bodies of the
//! loops are built by what builds straight-line code, from the entries of any transform in place of those of one.
//! `body` is such a body, `sums` the transforms as sums of few terms.

mod body;
mod sums;

use abbe::Function;
use abbe::function::Count;

use self::body::Body;
use self::sums::{Sum, Twists};
use super::routine::{Array, Place, Repeated, Role, Routine, Row, Stage, Sums, Table};
use super::{Operations, Program};
use crate::chain::{Accumulated, Columns, Covariance, Displacement, Local, Model, Rows, swing};
use crate::graph::{Node, Vector};
use crate::spec::{Orientation, Spec};

const POSE: [Count; 2] = [Count::Exactly(4), Count::Exactly(3)];

/// What loops go over, and what helps them.
pub(super) struct Loops<'m> {
    model: &'m Model,
    orientation: Orientation,
    motions: usize,
    joints: Twists,
    parameters: Twists,
    terms: Vec<Node>,
    sums: Vec<Sums>,
    tables: Vec<Table>,
}

impl<'m> Loops<'m> {
    pub(super) fn new(spec: &Spec, model: &'m Model) -> Self {
        let mut sum = Sum::new(&model.graph);
        let motions = sum.motions(&model.transforms);
        let joints = sum.twists(["JOINT_TWISTS", "JOINT_TWIST"], &model.joint_local_twists);
        let parameters = sum.twists(["PARAMETER_TWISTS", "PARAMETER_TWIST"], &model.parameter_local_twists);
        let Sum { terms, sums, mut tables, .. } = sum;
        let by_source =
            model.effects.iter().map(|effect| [6 * effect.frame + effect.component as usize, effect.source]);
        let rows = by_source.collect();
        tables.push(Table {
            name: "EFFECT_COLUMNS",
            documentation: "Column of `J_e` and source of every effect.",
            rows,
        });
        let terms = terms.into_iter().collect();
        Self { model, orientation: spec.orientation, motions, joints, parameters, terms, sums, tables }
    }

    /// The helpers, tables and sums.
    pub(super) fn finish(self) -> (Vec<Routine>, Vec<Table>, Vec<Sums>) {
        let array = |name, shape: &[Count], role| Array { name, shape: shape.to_vec(), role };
        let terms = [Count::Exactly(self.terms.len())];
        let program = Program::new(&self.model.graph, &self.terms);
        let arrays = vec![
            array("q", &[Count::Variables], Role::Argument),
            array("s", &[Count::Parameters], Role::Argument),
            array("terms", &terms, Role::Result),
        ];
        let writes = vec![Place { array: 2, row: Row::All }];
        let stage = Stage::Block(super::Block { reads: vec![], program, writes, repeated: None });
        let routine = |name, arrays, stage| Routine {
            function: None,
            name,
            arrays,
            stages: vec![stage],
            operations: Operations::default(),
        };
        let of_terms = routine("chain_terms", arrays, stage);
        let shape = [Count::FramesAndTool, POSE[0], POSE[1]];
        let arrays = vec![array("terms", &terms, Role::Argument), array("transforms", &shape, Role::Result)];
        let sums = Stage::Sums { sums: self.motions, terms: 0, entries: 1 };
        (vec![of_terms, routine("chain_transforms", arrays, sums)], self.tables, self.sums)
    }

    /// The stages of a function, and the arrays that they need; none if it has no loop.
    pub(super) fn stages(&mut self, function: Function, arrays: &mut Vec<Array>) -> Option<Vec<Stage>> {
        let mut draft = Draft { loops: self, arrays, stages: Vec::new() };
        match function {
            Function::Effects | Function::GeneralizedErrors => return None,
            Function::Transforms => {
                let terms = draft.terms();
                let transforms = draft.array("transforms");
                draft.call("chain_transforms", &[terms, transforms]);
            }
            Function::Pose => {
                let chain = draft.chain();
                let frame = draft.along(&chain, None, None);
                draft.give_pose(frame);
            }
            Function::ErrorJacobian => draft.error_jacobian(false),
            Function::ErrorJacobianDistinct => draft.error_jacobian(true),
            Function::JointJacobian => draft.symbol_jacobian(false),
            Function::ParameterJacobian => draft.symbol_jacobian(true),
            Function::Displacement => {
                let errors = draft.array("errors");
                draft.accumulate::<Displacement>(errors, "displacement");
            }
            Function::PredictedDisplacement => {
                let errors = draft.generalized_errors();
                draft.accumulate::<Displacement>(errors, "displacement");
            }
            Function::Covariance => {
                let variances = draft.array("variances");
                draft.accumulate::<Covariance>(variances, "covariance");
            }
            Function::SourceDisplacements => draft.by_source(),
            Function::RealPose => {
                let errors = draft.generalized_errors();
                let chain = draft.chain();
                let frame = draft.along(&chain, None, Some(errors));
                draft.give_pose(frame);
            }
            Function::CompensatorStep => draft.compensator_step(),
        }
        Some(draft.stages)
    }
}

/// A routine that is being written.
struct Draft<'d, 'm> {
    loops: &'d Loops<'m>,
    arrays: &'d mut Vec<Array>,
    stages: Vec<Stage>,
}

/// Arrays of the terms and of the transforms of them.
struct Chain {
    terms: usize,
    transforms: usize,
}

impl Draft<'_, '_> {
    /// The argument or result of that name.
    fn array(&self, name: &str) -> usize {
        self.arrays.iter().position(|array| array.name == name).expect("the signature has it")
    }

    fn local(&mut self, name: &'static str, shape: &[Count], role: Role) -> usize {
        self.arrays.push(Array { name, shape: shape.to_vec(), role });
        self.arrays.len() - 1
    }

    fn zeros(&mut self, name: &'static str, shape: &[Count]) -> usize {
        self.local(name, shape, Role::Zeros)
    }

    fn call(&mut self, routine: &'static str, arrays: &[usize]) {
        self.stages.push(Stage::Call { routine, arrays: arrays.to_vec() });
    }

    fn once(&mut self, body: Body) {
        self.stages.push(body.stage(None));
    }

    fn each(&mut self, count: Count, body: Body) {
        self.stages.push(body.stage(Some(Repeated { count, backwards: false })));
    }

    fn backwards(&mut self, body: Body) {
        self.stages.push(body.stage(Some(Repeated { count: Count::Frames, backwards: true })));
    }

    fn terms(&mut self) -> usize {
        let (q, s) = (self.array("q"), self.array("s"));
        let terms = self.zeros("terms", &[Count::Exactly(self.loops.terms.len())]);
        self.call("chain_terms", &[q, s, terms]);
        terms
    }

    fn chain(&mut self) -> Chain {
        let terms = self.terms();
        let transforms = self.zeros("transforms", &[Count::FramesAndTool, POSE[0], POSE[1]]);
        self.call("chain_transforms", &[terms, transforms]);
        Chain { terms, transforms }
    }

    fn generalized_errors(&mut self) -> usize {
        let arguments = ["q", "s", "u"].map(|name| self.array(name));
        let errors = self.zeros("errors", &[Count::Frames, Count::Exactly(6)]);
        self.call("generalized_errors", &[arguments[0], arguments[1], arguments[2], errors]);
        errors
    }

    /// From the base to the tip, equations (2) and (6): `F ← F A_i`, or `F A_i E_i`; the tool has no error. What is kept
    /// takes the place of the transforms, which nobody needs any more.
    fn along(&mut self, chain: &Chain, kept: Option<Kept>, errors: Option<usize>) -> usize {
        let frame = self.local("frame", &POSE, Role::Identity);
        let mut body = Body::new();
        let at = body.frame(frame, Row::All);
        let transform = body.frame(chain.transforms, Row::EACH);
        let mut next = body.graph.then(&at, &transform);
        if let Some(errors) = errors {
            let errors = body.six(errors, Row::EACH);
            next = crate::chain::displaced(&mut body.graph, next, &errors);
        }
        match kept {
            Some(Kept::Before) => body.write_frame(chain.transforms, Row::EACH, &at),
            Some(Kept::After) => body.write_frame(chain.transforms, Row::EACH, &next),
            None => {}
        }
        body.write_frame(frame, Row::All, &next);
        match errors {
            None => self.each(Count::FramesAndTool, body),
            Some(_) => {
                self.each(Count::Frames, body);
                let mut body = Body::new();
                let (at, tool) = (body.frame(frame, Row::All), body.frame(chain.transforms, Row::Last));
                let next = body.graph.then(&at, &tool);
                body.write_frame(frame, Row::All, &next);
                self.once(body);
            }
        }
        frame
    }

    fn give_pose(&mut self, frame: usize) {
        let to = self.array("pose");
        self.stages.push(Stage::Copy { from: frame, to });
    }

    /// What rows 4–6 take, and the margin, from the x axis of the tool in an array.
    fn rows(&mut self, axis: impl FnOnce(&mut Body) -> Vector) -> RowsArray {
        if self.loops.orientation == Orientation::RotationVector {
            return RowsArray(None);
        }
        let euler = self.zeros("euler", &[Count::Exactly(Rows::PARTS)]);
        let mut body = Body::new();
        let axis = axis(&mut body);
        let rows = Rows::new(&mut body.graph, Orientation::EulerYzx, axis);
        body.write(euler, Row::All, &rows.parts());
        if let (Some(margin), Some(node)) =
            (self.arrays.iter().position(|array| array.role == Role::Margin), rows.margin())
        {
            body.write(margin, Row::All, &[node]);
        }
        self.once(body);
        RowsArray(Some(euler))
    }

    /// `J_e`, all of its columns or what of them is neither zero nor repeated.
    fn error_jacobian(&mut self, distinct: bool) {
        let chain = self.chain();
        let frame = self.along(&chain, Some(Kept::After), None);
        let rows = self.rows(|body| body.frame(frame, Row::All).axes[0]);
        let mut body = Body::new();
        let (at, tool) = (body.frame(chain.transforms, Row::EACH), body.frame(frame, Row::All));
        let rows = rows.read(&mut body);
        let g = &mut body.graph;
        let lever = g.sub_vectors(tool.position, at.position);
        let moments = at.axes.map(|axis| g.cross(axis, lever));
        let columns = Columns::new(g, &at, moments, &rows);
        if distinct {
            let array = self.array("distinct");
            let vectors = columns.distinct(&rows);
            let stride = vectors.len() / 3;
            for (offset, vector) in vectors.chunks(3).enumerate() {
                body.write(array, Row::Each { stride, offset }, vector);
            }
        } else {
            let array = self.array("columns");
            for (offset, column) in columns.dense(g).iter().enumerate() {
                body.write(array, Row::Each { stride: 6, offset }, column);
            }
        }
        self.each(Count::Frames, body);
        self.give_pose(frame);
    }

    /// `∂X_T/∂x` of variables or parameters, rows as the spec's orientation says.
    fn symbol_jacobian(&mut self, by_parameters: bool) {
        let chain = self.chain();
        let frame = self.along(&chain, Some(Kept::Before), None);
        let rows = self.rows(|body| body.frame(frame, Row::All).axes[0]);
        let twists = if by_parameters { &self.loops.parameters } else { &self.loops.joints };
        self.columns_of_twists(&chain, twists, frame, &rows);
        self.give_pose(frame);
    }

    /// The pose with errors, and `J_q` with rotation-vector rows.
    fn compensator_step(&mut self) {
        let chain = self.chain();
        let frame = self.along(&chain, Some(Kept::Before), None);
        self.columns_of_twists(&chain, &self.loops.joints, frame, &RowsArray(None));
        let arrays = ["q", "s", "u", "pose"].map(|name| self.array(name));
        self.call("real_pose", &arrays);
    }

    /// The columns of what symbols do to the transforms: with the frame (R, p) before a transform
    ///
    /// ```text
    /// ω = R ω_l        v = R v_l + ω × (p_T − p)
    /// ```
    fn columns_of_twists(&mut self, chain: &Chain, twists: &Twists, frame: usize, rows: &RowsArray) {
        let columns = self.array("columns");
        self.stages.push(Stage::Clear(columns));
        let entries = self.zeros("twists", &[Count::Exactly(twists.count), Count::Exactly(6)]);
        self.stages.push(Stage::Sums { sums: twists.sums, terms: chain.terms, entries });
        let listed = |column| Row::Listed { table: twists.table, column };
        let mut body = Body::new();
        let (before, tool) = (body.frame(chain.transforms, listed(0)), body.frame(frame, Row::All));
        let [velocity, turn] = body.twist(entries, Row::EACH);
        let sum = body.six(columns, listed(1));
        let rows = rows.read(&mut body);
        let g = &mut body.graph;
        let turn = g.turn(&before.axes, turn);
        let velocity = g.turn(&before.axes, velocity);
        let velocity = swing(g, velocity, turn, tool.position, before.position);
        let column = rows.column(g, velocity, turn);
        let column: Vec<Node> = sum.iter().zip(column).map(|(a, b)| g.add(*a, b)).collect();
        body.write(columns, listed(1), &column);
        self.each(Count::Exactly(twists.count), body);
    }

    /// From the tip to the base: what the errors of all frames, or their variances, do to the tool point.
    fn accumulate<A: Accumulated>(&mut self, errors: usize, result: &'static str) {
        let chain = self.chain();
        let euler = self.loops.orientation == Orientation::EulerYzx;
        let lever = self.zeros("lever", &[Count::Exactly(3)]);
        let axis = euler.then(|| self.zeros("direction", &[Count::Exactly(3)]));
        let state = self.zeros("sum", &[Count::Exactly(A::NUMBERS)]);
        let mut body = Body::new();
        let tool = body.frame(chain.transforms, Row::Last);
        body.write(lever, Row::All, &tool.position);
        if let Some(axis) = axis {
            body.write(axis, Row::All, &tool.axes[0]);
        }
        self.once(body);

        let mut body = Body::new();
        let transform = body.frame(chain.transforms, Row::EACH);
        let errors = body.six(errors, Row::EACH);
        let numbers = body.read(state, Row::All, A::NUMBERS);
        let point = body.vector(lever, Row::All);
        let first_axis = axis.map(|axis| body.vector(axis, Row::All));
        let g = &mut body.graph;
        let mut sum = A::from_numbers(&numbers);
        sum.add(g, errors, point);
        let (turn, shift) = (Local::Rotation(transform.axes), Local::Shift(transform.position));
        sum.turn(g, &turn);
        let point = turn.direction(g, point);
        let point = shift.point(g, point);
        let first_axis = first_axis.map(|axis| turn.direction(g, axis));
        body.write(state, Row::All, &sum.numbers());
        body.write(lever, Row::All, &point);
        if let (Some(array), Some(node)) = (axis, first_axis) {
            body.write(array, Row::All, &node);
        }
        self.backwards(body);

        let rows = match axis {
            Some(axis) => self.rows(|body| body.vector(axis, Row::All)),
            None => RowsArray(None),
        };
        let mut body = Body::new();
        let numbers = body.read(state, Row::All, A::NUMBERS);
        let rows = rows.read(&mut body);
        let nodes = A::from_numbers(&numbers).rows(&mut body.graph, &rows);
        body.write(self.array(result), Row::All, &nodes.concat());
        self.once(body);
    }

    /// ΔX of each source by itself from the columns of `J_e`.
    fn by_source(&mut self) {
        let pose = self.zeros("pose", &POSE);
        let columns = self.zeros("columns", &[Count::Errors, Count::Exactly(6)]);
        let effects = self.zeros("effects", &[Count::Effects]);
        let [q, s, u] = ["q", "s", "u"].map(|name| self.array(name));
        let margin = self.arrays.iter().position(|array| array.role == Role::Margin);
        let arrays: Vec<usize> = [q, s, pose, columns].into_iter().chain(margin).collect();
        self.call("error_jacobian", &arrays);
        self.call("effects", &[q, s, u, effects]);
        let displacements = self.array("displacements");
        self.stages.push(Stage::Clear(displacements));
        let table = self.loops.tables.len() - 1;
        let listed = |column| Row::Listed { table, column };
        let mut body = Body::new();
        let value = body.read(effects, Row::EACH, 1)[0];
        let column = body.six(columns, listed(0));
        let sum = body.six(displacements, listed(1));
        let g = &mut body.graph;
        let sum = [0, 1, 2, 3, 4, 5].map(|i| {
            let part = g.mul(value, column[i]);
            g.add(sum[i], part)
        });
        body.write(displacements, listed(1), &sum);
        self.each(Count::Effects, body);
    }
}

/// Which frames a loop keeps.
#[derive(Clone, Copy)]
enum Kept {
    /// Those that transforms are reached from.
    Before,
    /// Those that transforms lead to.
    After,
}

/// Where what rows 4–6 take is kept; rotation vectors take nothing.
struct RowsArray(Option<usize>);

impl RowsArray {
    fn read(&self, body: &mut Body) -> Rows {
        match self.0 {
            None => Rows::RotationVector,
            Some(array) => Rows::from_parts(&body.read(array, Row::All, Rows::PARTS)),
        }
    }
}
