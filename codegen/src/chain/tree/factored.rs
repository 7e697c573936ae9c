//! Solution of linear equations in straight-line code.
//!
//! A sparse matrix is put in block-triangular order. Each row is matched with a column in which it
//! has an entry. The columns then form a graph: one depends on those in which its row has entries.
//! Columns that depend on each other are one block (Duff, Reid 1978), and a block comes after all
//! on which it depends.

use abbe_spec::Function;

use super::units::Units;
use crate::graph::{Graph, Node};

/// A square matrix A, factored block by block: its rows and columns are sorted such that it is
/// block lower triangular, and each block on the diagonal is `S A_bb = Q R` by Householder's
/// reflections, which are backward stable (Golub, Van Loan: Matrix Computations, 5.2). S divides
/// each row by its unit: rows of lengths in mm would leave nothing of rows of angles beside them.
pub(super) struct Factored {
    columns: Vec<Vec<Node>>,
    blocks: Vec<FactoredBlock>,
}

/// A block on the diagonal.
struct FactoredBlock {
    block: Block,
    /// Diagonal of S.
    scales: Vec<Node>,
    reflections: Vec<Option<Reflection>>,
    /// Columns of R, above the diagonal.
    upper: Vec<Vec<Node>>,
    /// Reciprocals of the diagonal of R.
    reciprocals: Vec<Node>,
    determinant: Node,
    /// Diagonal of R, each entry with its unit.
    pivots: Vec<(Node, f64)>,
}

/// The reflection `H = I − β v vᵀ` of the entries from its index on.
struct Reflection {
    direction: Vec<Node>,
    factor: Node,
}

impl Factored {
    /// Factors `φ_p`, given by columns.
    pub(super) fn new(graph: &mut Graph, columns: Vec<Vec<Node>>, units: &Units) -> Self {
        let zero = graph.zero();
        let blocks = blocks(columns.len(), |row, column| columns[column][row] != zero);
        let blocks =
            blocks.into_iter().map(|block| FactoredBlock::new(graph, &columns, units, block)).collect();
        Self { columns, blocks }
    }

    /// Returns the determinant of each block on the diagonal, and its factors with their units: one
    /// of them is zero where the block is singular. Their product says less: it is small, too,
    /// where many joints are short against their loops.
    pub(super) fn determinants(&self) -> impl Iterator<Item = (Node, &[(Node, f64)])> {
        self.blocks.iter().map(|factored| (factored.determinant, &factored.pivots[..]))
    }

    /// Returns the solution x of `A x = b`: `A_bb x_b = b_b − Σ A_bc x_c` over the blocks c before
    /// b.
    pub(super) fn solve(&self, graph: &mut Graph, right: &[Node]) -> Vec<Node> {
        let mut solution = vec![graph.zero(); right.len()];
        for factored in &self.blocks {
            let rest = |row: &usize| {
                // What is not known yet is zero.
                let terms: Vec<Node> = self.columns.iter().map(|column| column[*row]).collect();
                let known = graph.products(&terms, &solution);
                graph.sub(right[*row], known)
            };
            let rest: Vec<Node> = factored.block.rows.iter().map(rest).collect();
            let found = factored.solve(graph, rest);
            factored.block.columns.iter().zip(found).for_each(|(column, found)| solution[*column] = found);
        }
        solution
    }

    /// Returns the solution y of `y A = c`, a row, from the last block to the first.
    pub(super) fn solve_row(&self, graph: &mut Graph, row: &[Node]) -> Vec<Node> {
        let mut solution = vec![graph.zero(); row.len()];
        for factored in self.blocks.iter().rev() {
            let rest = |column: &usize| {
                let known = graph.products(&self.columns[*column], &solution);
                graph.sub(row[*column], known)
            };
            let rest: Vec<Node> = factored.block.columns.iter().map(rest).collect();
            let found = factored.solve_row(graph, &rest);
            factored.block.rows.iter().zip(found).for_each(|(row, found)| solution[*row] = found);
        }
        solution
    }
}

impl FactoredBlock {
    /// Factors a block. With the entries x of a column from the diagonal on:
    ///
    /// ```text
    /// σ = ±|x|, with the sign of x_1        v = x + σ e_1        β = 1 / (σ v_1)        H x = −σ e_1
    /// ```
    ///
    /// Each reflection changes the sign of the determinant.
    fn new(graph: &mut Graph, all: &[Vec<Node>], units: &Units, block: Block) -> Self {
        let least = block.rows.iter().map(|row| units.equations[*row]).fold(f64::INFINITY, f64::min);
        // Powers of two round nothing.
        let scale = |row: &usize| graph.constant((least / units.equations[*row]).log2().round().exp2());
        let scales: Vec<Node> = block.rows.iter().map(scale).collect();
        let mut columns: Vec<Vec<Node>> = Vec::new();
        for column in &block.columns {
            let entries = block.rows.iter().map(|row| all[*column][*row]);
            columns.push(scales.iter().zip(entries).map(|(scale, entry)| graph.mul(*scale, entry)).collect());
        }
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        let (mut reflections, mut reciprocals, mut pivots, mut determinant) =
            (Vec::new(), Vec::new(), Vec::new(), one);
        for k in 0..columns.len() {
            let mut direction = columns[k][k..].to_vec();
            let reflection = direction[1..].iter().any(|entry| *entry != zero).then(|| {
                let square = graph.products(&direction, &direction);
                let (length, side) = (graph.sqrt(square), graph.call(Function::Side, direction[0]));
                let signed = graph.mul(side, length);
                direction[0] = graph.add(direction[0], signed);
                let product = graph.mul(signed, direction[0]);
                columns[k][k] = graph.neg(signed);
                Reflection { factor: graph.div(one, product), direction }
            });
            if let Some(reflection) = &reflection {
                columns[k + 1..].iter_mut().for_each(|column| reflection.apply(graph, &mut column[k..]));
                determinant = graph.neg(determinant);
            }
            pivots.push((columns[k][k], least / units.passive[block.columns[k]]));
            determinant = graph.mul(determinant, columns[k][k]);
            reciprocals.push(graph.div(one, columns[k][k]));
            reflections.push(reflection);
        }
        let upper = (0..).zip(columns).map(|(k, column)| column[..k].to_vec()).collect();
        Self { block, scales, reflections, upper, reciprocals, determinant, pivots }
    }

    /// Returns `x = R⁻¹ Qᵀ S b`.
    fn solve(&self, graph: &mut Graph, right: Vec<Node>) -> Vec<Node> {
        let mut solution = self.scaled(graph, right);
        for (k, reflection) in self.reflections.iter().enumerate() {
            reflection.iter().for_each(|reflection| reflection.apply(graph, &mut solution[k..]));
        }
        for k in (0..solution.len()).rev() {
            for j in k + 1..solution.len() {
                solution[k] = graph.sub_product(solution[k], self.upper[j][k], solution[j]);
            }
            solution[k] = graph.mul(solution[k], self.reciprocals[k]);
        }
        solution
    }

    /// Returns `y = c R⁻¹ Qᵀ S`.
    fn solve_row(&self, graph: &mut Graph, row: &[Node]) -> Vec<Node> {
        let mut solution: Vec<Node> = Vec::new();
        for (k, entry) in row.iter().enumerate() {
            let known = graph.products(&self.upper[k], &solution);
            let rest = graph.sub(*entry, known);
            solution.push(graph.mul(rest, self.reciprocals[k]));
        }
        for (k, reflection) in self.reflections.iter().enumerate().rev() {
            reflection.iter().for_each(|reflection| reflection.apply(graph, &mut solution[k..]));
        }
        self.scaled(graph, solution)
    }

    fn scaled(&self, graph: &mut Graph, vector: Vec<Node>) -> Vec<Node> {
        vector.into_iter().zip(&self.scales).map(|(entry, scale)| graph.mul(*scale, entry)).collect()
    }
}

impl Reflection {
    fn apply(&self, graph: &mut Graph, vector: &mut [Node]) {
        let product = graph.products(&self.direction, vector);
        let along = graph.mul(self.factor, product);
        for (entry, direction) in vector.iter_mut().zip(&self.direction) {
            *entry = graph.sub_product(*entry, along, *direction);
        }
    }
}

/// Rows and columns of a block on the diagonal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub(super) rows: Vec<usize>,
    pub(super) columns: Vec<usize>,
}

/// Returns the blocks of a square matrix, each after those on which it depends. A matrix that is
/// singular whatever its entries are is one block.
pub(super) fn blocks(count: usize, has_entry: impl Fn(usize, usize) -> bool) -> Vec<Block> {
    let mut column_of = vec![None; count];
    for column in 0..count {
        if !assign(column, count, &has_entry, &mut column_of, &mut vec![false; count]) {
            let all: Vec<usize> = (0..count).collect();
            return vec![Block { rows: all.clone(), columns: all }];
        }
    }
    let mut row_of = vec![0; count];
    for (row, column) in column_of.into_iter().enumerate() {
        column.into_iter().for_each(|column: usize| row_of[column] = row);
    }
    // `reaches[a][b]`: column a depends on b, maybe through others (Warshall).
    let mut reaches: Vec<Vec<bool>> =
        (0..count).map(|a| (0..count).map(|b| a == b || has_entry(row_of[a], b)).collect()).collect();
    for through in 0..count {
        let further = reaches[through].clone();
        for reached in reaches.iter_mut().filter(|reached| reached[through]) {
            reached.iter_mut().zip(&further).for_each(|(reaches, more)| *reaches |= more);
        }
    }
    // What depends on more comes later.
    let weight = |column: &usize| reaches[*column].iter().filter(|reaches| **reaches).count();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(weight);
    let mut blocks: Vec<Block> = Vec::new();
    for column in order {
        let mut same = blocks.iter_mut().filter(|block| {
            let other = block.columns[0];
            reaches[column][other] && reaches[other][column]
        });
        match same.next() {
            Some(block) => {
                block.rows.push(row_of[column]);
                block.columns.push(column);
            }
            None => blocks.push(Block { rows: vec![row_of[column]], columns: vec![column] }),
        }
    }
    blocks
}

/// Matches a column with a row, and matched columns with other rows where that makes room.
fn assign(
    column: usize,
    count: usize,
    has_entry: &impl Fn(usize, usize) -> bool,
    column_of: &mut [Option<usize>],
    tried: &mut [bool],
) -> bool {
    for row in 0..count {
        if !has_entry(row, column) || std::mem::replace(&mut tried[row], true) {
            continue;
        }
        if column_of[row].is_none_or(|other| assign(other, count, has_entry, column_of, tried)) {
            column_of[row] = Some(column);
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests;
