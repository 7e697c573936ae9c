//! Block-triangular order of a sparse matrix.
//!
//! Each row is matched with a column in which it has an entry. The columns then form a graph: one
//! depends on those in which its row has entries. Columns that depend on each other are one block
//! (Duff, Reid 1978), and a block comes after all on which it depends.

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
        let is_free = column_of[row].is_none_or(|other| assign(other, count, has_entry, column_of, tried));
        if is_free {
            column_of[row] = Some(column);
            return true;
        }
    }
    false
}
