//! Numbers of many configurations, in the layout of lanes.

use core::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::{InstructionSet, Lanes, Register};

/// Cache line: the unit of loads and stores of registers.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C, align(64))]
struct Line([f64; 8]);

/// Table of numbers: `rows` numbers for each of `count` configurations.
///
/// A tile holds as many configurations as the instruction set has lanes. Tiles are consecutive;
/// within a tile, rows are consecutive; within a row, lanes are adjacent. The lanes after the last
/// configuration hold the value last set, or 0.
#[derive(Clone, Debug)]
pub struct Tiles {
    set: InstructionSet,
    rows: usize,
    count: usize,
    lines: Vec<Line>,
}

/// Has no rows and no configurations.
impl Default for Tiles {
    fn default() -> Self {
        Self::new(InstructionSet::BASELINE, 0, 0)
    }
}

impl Tiles {
    /// Creates a table of zeros for an instruction set.
    pub fn new(set: InstructionSet, rows: usize, count: usize) -> Self {
        let mut tiles = Self { set, rows, count: 0, lines: Vec::new() };
        tiles.resize(count);
        tiles
    }

    /// Changes the number of configurations. Their values are 0 or left over.
    pub fn resize(&mut self, count: usize) {
        self.count = count;
        let numbers = self.tiles() * self.set.width() * self.rows;
        self.lines.resize(numbers.div_ceil(8), Line([0.0; 8]));
    }

    /// Changes instruction set, rows and configurations without clearing: the values are
    /// unspecified.
    pub fn reshape(&mut self, set: InstructionSet, rows: usize, count: usize) {
        (self.set, self.rows) = (set, rows);
        self.resize(count);
    }

    /// Returns the instruction set of the layout.
    pub fn instruction_set(&self) -> InstructionSet {
        self.set
    }

    /// Returns the number of rows: numbers per configuration.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of configurations.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns the number of tiles.
    pub fn tiles(&self) -> usize {
        self.count.div_ceil(self.set.width())
    }

    /// Returns a number of a configuration.
    ///
    /// # Panics
    ///
    /// Panics if the row or the configuration is out of range.
    #[inline]
    pub fn get(&self, row: usize, configuration: usize) -> f64 {
        self.numbers()[self.place(row, configuration)]
    }

    /// Sets a number of a configuration.
    ///
    /// # Panics
    ///
    /// Panics if the row or the configuration is out of range.
    #[inline]
    pub fn set_value(&mut self, row: usize, configuration: usize, value: f64) {
        let place = self.place(row, configuration);
        self.numbers_mut()[place] = value;
    }

    /// Sets a row to one value at all configurations.
    ///
    /// # Panics
    ///
    /// Panics if the row is out of range.
    pub fn fill_row(&mut self, row: usize, value: f64) {
        assert!(row < self.rows, "row {row} of {}", self.rows);
        for lane in 0..self.tiles() * self.set.width() {
            let place = self.place_of_lane(row, lane);
            self.numbers_mut()[place] = value;
        }
    }

    /// Sets some rows of `count` configurations from `first` on, configuration after configuration.
    /// `at` is called with the index into `rows`.
    ///
    /// # Panics
    ///
    /// Panics if a row or a configuration is out of range.
    pub fn set_each(&mut self, rows: &[usize], first: usize, count: usize, mut at: impl FnMut(usize) -> f64) {
        assert!(
            rows.iter().all(|row| *row < self.rows) && first + count <= self.count,
            "no such row or configuration"
        );
        let (width, height) = (self.set.width(), self.rows);
        let shift = width.trailing_zeros();
        let numbers = self.numbers_mut();
        for configuration in first..first + count {
            let start = (((configuration >> shift) * height) << shift) + (configuration & (width - 1));
            for (which, row) in rows.iter().enumerate() {
                numbers[start + (row << shift)] = at(which);
            }
        }
    }

    /// Sets a row of the configurations from `first` on, the first of a tile.
    ///
    /// # Panics
    ///
    /// Panics if the row or a configuration is out of range, or if no tile begins at `first`.
    #[inline(always)]
    pub fn set_row(&mut self, row: usize, first: usize, values: &[f64]) {
        let (width, height) = (self.set.width(), self.rows);
        assert!(
            row < height && first.is_multiple_of(width) && first + values.len() <= self.count,
            "no such row or configuration"
        );
        let numbers = &mut self.numbers_mut()[first * height + row * width..];
        for (values, numbers) in values.chunks(width).zip(numbers.chunks_mut(width * height)) {
            numbers[..values.len()].copy_from_slice(values);
        }
    }

    /// Repeats the last configuration in the unused lanes after it.
    pub fn pad(&mut self) {
        let Some(last) = self.count.checked_sub(1) else { return };
        for row in 0..self.rows {
            let value = self.get(row, last);
            for lane in self.count..self.tiles() * self.set.width() {
                let place = self.place_of_lane(row, lane);
                self.numbers_mut()[place] = value;
            }
        }
    }

    /// Copies the first rows of all configurations to new tiles.
    ///
    /// # Panics
    ///
    /// Panics if there are fewer rows.
    pub fn first_rows(&self, rows: usize) -> Self {
        let mut first = Self::new(self.set, rows, self.count);
        let size = rows * self.set.width();
        for tile in 0..self.tiles() {
            let numbers = &self.numbers()[tile * self.rows * self.set.width()..][..size];
            first.numbers_mut()[tile * size..][..size].copy_from_slice(numbers);
        }
        first
    }

    /// Copies some rows of a configuration to `values`.
    pub fn copy_rows(&self, rows: Range<usize>, configuration: usize, values: &mut [f64]) {
        for (row, value) in rows.zip(values) {
            *value = self.get(row, configuration);
        }
    }

    /// Copies some rows of the configurations from `first` on to `values`, as many as fit:
    /// configuration after configuration, in the order of `rows`. The inverse of
    /// [`set_each`](Self::set_each).
    ///
    /// # Panics
    ///
    /// Panics if a row or a configuration is out of range.
    pub fn copy_each(&self, rows: &[usize], first: usize, values: &mut [f64]) {
        let count = if rows.is_empty() { 0 } else { values.len() / rows.len() };
        assert!(
            rows.iter().all(|row| *row < self.rows) && first + count <= self.count,
            "no such row or configuration"
        );
        let (width, height) = (self.set.width(), self.rows);
        let shift = width.trailing_zeros();
        let numbers = self.numbers();
        for (values, configuration) in values.chunks_exact_mut(rows.len().max(1)).zip(first..first + count) {
            let start = (((configuration >> shift) * height) << shift) + (configuration & (width - 1));
            for (value, row) in values.iter_mut().zip(rows) {
                *value = numbers[start + (row << shift)];
            }
        }
    }

    /// Returns the rows of a tile.
    ///
    /// # Panics
    ///
    /// Panics if the tile is out of range, or the lanes are those of another instruction set.
    #[inline(always)]
    pub fn tile<R: Register>(&self, tile: usize) -> &[Lanes<R>] {
        assert!(R::WIDTH == self.set.width(), "lanes of another instruction set");
        &bytemuck::cast_slice::<Line, Lanes<R>>(&self.lines)[tile * self.rows..][..self.rows]
    }

    /// Returns the rows of a tile for writing.
    ///
    /// # Panics
    ///
    /// Panics as [`tile`](Self::tile) does.
    #[inline(always)]
    pub fn tile_mut<R: Register>(&mut self, tile: usize) -> &mut [Lanes<R>] {
        assert!(R::WIDTH == self.set.width(), "lanes of another instruction set");
        &mut bytemuck::cast_slice_mut::<Line, Lanes<R>>(&mut self.lines)[tile * self.rows..][..self.rows]
    }

    fn numbers(&self) -> &[f64] {
        bytemuck::cast_slice(&self.lines)
    }

    fn numbers_mut(&mut self) -> &mut [f64] {
        bytemuck::cast_slice_mut(&mut self.lines)
    }

    #[inline]
    fn place(&self, row: usize, configuration: usize) -> usize {
        assert!(
            row < self.rows && configuration < self.count,
            "no row {row} or no configuration {configuration}"
        );
        self.place_of_lane(row, configuration)
    }

    #[inline]
    fn place_of_lane(&self, row: usize, lane: usize) -> usize {
        // Widths are powers of two: shifts replace divisions.
        let (width, shift) = (self.set.width(), self.set.width().trailing_zeros());
        ((((lane >> shift) * self.rows) + row) << shift) + (lane & (width - 1))
    }
}
