//! Loops of the Jacobians and of the quantities accumulated over the frames.

use abbe_core::{Orientation, function::Count};

use super::{Body, POSE, RoutineBuilder, RowsArray, sums::Twists};
use crate::chain::{Accumulated, Columns, Local, swing};
use crate::graph::Node;
use crate::program::{Row, Stage};

impl RoutineBuilder<'_, '_> {
    /// Computes `J_e`: all of its columns, or only the entries that are neither zero nor repeated.
    pub(super) fn error_jacobian(&mut self, distinct: bool) {
        let terms = self.terms();
        let frames = self.frames(terms);
        let pose = self.array("pose");
        self.copy(frames, Row::Last, pose);
        let last = self.last_axis();
        let rows = self.rows(|body| body.frame(pose, Row::All).axes[last]);
        let mut body = Body::default();
        let (at, tool) = (body.frame(frames, Row::NEXT), body.frame(pose, Row::All));
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
    }

    /// Computes `∂X_T/∂x` of variables or parameters, with rows by the spec's orientation.
    pub(super) fn symbol_jacobian(&mut self, by_parameters: bool) {
        let terms = self.terms();
        let frames = self.frames(terms);
        let pose = self.array("pose");
        self.copy(frames, Row::Last, pose);
        let twists = if by_parameters { &self.loops.parameters } else { &self.loops.joints };
        let last = self.last_axis();
        let axis = move |body: &mut Body| body.frame(pose, Row::All).axes[last];
        if twists.count == 0 {
            // No symbol moves any frame.
            self.margin_alone(axis);
            self.stages.push(Stage::Clear(self.array("columns")));
            return;
        }
        let rows = self.rows(axis);
        self.columns_of_twists(twists, terms, frames, &rows);
    }

    /// Computes the pose with errors, and `J_q` with rotation-vector rows.
    pub(super) fn compensator_step(&mut self) {
        if self.loops.joints.count == 0 {
            self.stages.push(Stage::Clear(self.array("columns")));
        } else {
            let terms = self.terms();
            let frames = self.frames(terms);
            self.columns_of_twists(&self.loops.joints, terms, frames, &RowsArray::ROTATION_VECTOR);
        }
        let arrays = ["q", "s", "u", "pose"].map(|name| self.array(name));
        self.call("real_pose", &arrays);
    }

    /// Computes the columns from the twists of the transforms. With the frame (R, p) before a
    /// transform:
    ///
    /// ```text
    /// ω = R ω_l        v = R v_l + ω × (p_T − p)
    /// ```
    fn columns_of_twists(&mut self, twists: &Twists, terms: usize, frames: usize, rows: &RowsArray) {
        let columns = self.array("columns");
        self.stages.push(Stage::Clear(columns));
        let entries = self.zeros("twists", &[Count::Exactly(twists.count), Count::Exactly(6)]);
        self.stages.push(Stage::Sums { sums: twists.sums, terms, entries });
        let listed = |column| Row::Listed { table: twists.table, column };
        let mut body = Body::default();
        let (before, tool) = (body.frame(frames, listed(0)), body.frame(frames, Row::Last));
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

    /// Accumulates the effects of all frames' errors, or of their variances, on the tool point from
    /// the tip to the base.
    pub(super) fn accumulate<A: Accumulated>(&mut self, errors: &str, result: &str) {
        let links = self.links();
        let euler = self.loops.orientation != Orientation::RotationVector;
        let lever = self.zeros("lever", &[Count::Exactly(3)]);
        let axis = euler.then(|| self.zeros("direction", &[Count::Exactly(3)]));
        let state = self.zeros("sum", &[Count::Exactly(A::NUMBERS)]);
        let mut body = Body::default();
        let tool = body.frame(links, Row::Last);
        body.write(lever, Row::All, &tool.position);
        if let Some(axis) = axis {
            body.write(axis, Row::All, &tool.axes[self.last_axis()]);
        }
        self.once(body);

        let mut body = Body::default();
        let link = body.frame(links, Row::NEXT);
        let errors = body.six(self.array(errors), Row::EACH);
        let numbers = body.read(state, Row::All, A::NUMBERS);
        let point = body.vector(lever, Row::All);
        let last_axis = axis.map(|axis| body.vector(axis, Row::All));
        let g = &mut body.graph;
        let mut sum = A::from_numbers(&numbers);
        sum.add(g, errors, point);
        let (turn, shift) = (Local::Rotation(link.axes), Local::Shift(link.position));
        sum.turn(g, &turn);
        let point = turn.direction(g, point);
        let point = shift.point(g, point);
        let last_axis = last_axis.map(|axis| turn.direction(g, axis));
        body.write(state, Row::All, &sum.numbers());
        body.write(lever, Row::All, &point);
        if let (Some(array), Some(node)) = (axis, last_axis) {
            body.write(array, Row::All, &node);
        }
        self.backwards(body);

        let euler = |axis| self.rows(|body| body.vector(axis, Row::All));
        let rows = axis.map_or(RowsArray::ROTATION_VECTOR, euler);
        let mut body = Body::default();
        let numbers = body.read(state, Row::All, A::NUMBERS);
        let rows = rows.read(&mut body);
        let nodes = A::from_numbers(&numbers).rows(&mut body.graph, &rows);
        body.write(self.array(result), Row::All, &nodes.concat());
        self.once(body);
    }

    /// Computes ΔX of each source alone from the columns of `J_e`.
    pub(super) fn by_source(&mut self) {
        if self.loops.model.effects.is_empty() {
            if self.margin().is_some() {
                let pose = self.zeros("pose", &POSE);
                self.call("pose", &[self.array("q"), self.array("s"), pose]);
                let last = self.last_axis();
                self.margin_alone(|body| body.frame(pose, Row::All).axes[last]);
            }
            self.stages.push(Stage::Clear(self.array("displacements")));
            return;
        }
        let pose = self.zeros("pose", &POSE);
        let columns = self.zeros("columns", &[Count::Errors, Count::Exactly(6)]);
        let effects = self.zeros("effects", &[Count::Effects]);
        let [q, s, u] = ["q", "s", "u"].map(|name| self.array(name));
        let arrays: Vec<usize> = [q, s, pose, columns].into_iter().chain(self.margin()).collect();
        self.call("error_jacobian", &arrays);
        self.call("effects", &[q, s, u, effects]);
        let displacements = self.array("displacements");
        self.stages.push(Stage::Clear(displacements));
        let table = self.loops.tables.len() - 1;
        let listed = |column| Row::Listed { table, column };
        let mut body = Body::default();
        let value = body.read(effects, Row::EACH, 1)[0];
        let column = body.six(columns, listed(0));
        let sum = body.six(displacements, listed(1));
        let g = &mut body.graph;
        let sum = [0, 1, 2, 3, 4, 5].map(|i| g.add_product(sum[i], value, column[i]));
        body.write(displacements, listed(1), &sum);
        self.each(Count::Effects, body);
    }

    /// Computes `ΔX = J_e ε` of the repeatable sources.
    pub(super) fn predicted_displacement(&mut self) {
        let errors = self.generalized_errors();
        let [q, s, displacement] = ["q", "s", "displacement"].map(|name| self.array(name));
        let arrays: Vec<usize> = [q, s, errors, displacement].into_iter().chain(self.margin()).collect();
        self.call("displacement", &arrays);
    }
}
