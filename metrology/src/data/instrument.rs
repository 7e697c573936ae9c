//! Instruments that are read one number at a time, several of them in one file.

use std::collections::HashMap;
use std::ops::Range;

use abbe::analysis::sampling::norm;
use abbe::identify::{Camera, Fixture, InstrumentKind, KnownDistance, Observable, Reference};

use super::column::Column;

/// Reason of a row without readings.
pub(super) const NOTHING_READ: &str = "no reading in this row";

/// One instrument of a map.
#[derive(Clone, Debug)]
pub struct Instrument {
    /// Name in reports.
    pub name: String,
    /// Kind of instrument.
    pub kind: &'static InstrumentKind,
    /// Columns of its readings; empty if it is touched.
    pub columns: Vec<Column>,
    /// Factor of its readings to coherent units.
    pub factor: f64,
    /// Unit of its readings as in the map; the length unit if it is touched.
    pub unit: String,
    /// Value in the column `setup` of the rows in which it is read; all rows if none.
    pub setup: Option<f64>,
    /// Range of readings; the length unit or rad.
    pub range: Option<[f64; 2]>,
    /// Standard deviation of a reading; none if it is estimated from the data.
    pub uncertainty: Option<f64>,
    /// Indices of its observables.
    pub observables: Range<usize>,
}

/// The instruments of a map, with their targets and fixtures.
#[derive(Clone, Debug, Default)]
pub struct Instruments {
    /// The instruments.
    pub list: Vec<Instrument>,
    /// Nominal positions of the targets in the frame of the tool; none where they are to be found
    /// from the data.
    pub targets: Vec<Option<[f64; 3]>>,
    /// Fixtures in `F_0`.
    pub fixtures: Vec<Fixture>,
    /// Known distances between fixtures.
    pub known_distances: Vec<KnownDistance>,
    /// Observables of all instruments.
    pub observables: Vec<Observable>,
    /// Indices of the instruments whose fixture and zero were identified before.
    pub found: Vec<usize>,
    /// The camera, if it is the instrument.
    pub camera: Option<Camera>,
    /// Indices of the instruments whose position `at` is not stated.
    pub unplaced: Vec<usize>,
    /// Column of the setup of a row.
    pub setup: Option<Column>,
}

impl Instruments {
    /// Returns the names of all observables: that of the instrument, with the axis if it has three,
    /// or with the name of the column of a camera.
    pub(crate) fn names(&self) -> Vec<String> {
        let of = |instrument: &Instrument| match instrument.observables.len() {
            _ if self.camera.is_some() => {
                let column = |column: &Column| format!("{}_{}", instrument.name, column.name);
                instrument.columns.iter().map(column).collect()
            }
            3 => ["x", "y", "z"].map(|axis| format!("{}_{axis}", instrument.name)).to_vec(),
            _ => vec![instrument.name.clone()],
        };
        self.list.iter().flat_map(of).collect()
    }

    /// Returns the unit of each of the [`names`](Self::names).
    pub(crate) fn units(&self) -> Vec<String> {
        let own = |instrument: &Instrument| vec![instrument.unit.clone(); instrument.observables.len()];
        self.list.iter().flat_map(own).collect()
    }

    /// Returns the index of the fixture of an instrument, if it has one.
    pub fn fixture_of(&self, instrument: usize) -> Option<usize> {
        self.observables[self.list[instrument].observables.start].fixture
    }

    /// Returns the index of the first instrument that observes a fixture.
    pub(crate) fn instrument_at(&self, fixture: usize) -> Option<usize> {
        (0..self.list.len()).find(|instrument| self.fixture_of(*instrument) == Some(fixture))
    }

    /// Iterates over the instruments at unknown positions.
    pub(crate) fn at_unknown_positions(&self) -> impl Iterator<Item = usize> {
        self.unplaced.iter().copied().filter(|instrument| !self.found.contains(instrument))
    }

    /// Returns whether the readings of any instrument depend on the pose of `F_0`.
    pub(super) fn see_the_base(&self) -> bool {
        self.list.iter().any(|instrument| instrument.kind.sees_base)
    }

    /// Returns whether the readings of any instrument refer to the previous row.
    pub(crate) fn depend_on_previous_row(&self) -> bool {
        self.list.iter().any(|instrument| instrument.kind.reference == Reference::PreviousRow)
    }

    /// Removes the readings that refer to the previous row, of all instruments or of those alone
    /// that a setup has.
    pub(super) fn at_first(&self, mut readings: Vec<Option<f64>>, of_setups: bool) -> Vec<Option<f64>> {
        let moved = self.list.iter().filter(|one| one.kind.reference == Reference::PreviousRow);
        moved
            .filter(|one| one.setup.is_some() || !of_setups)
            .for_each(|instrument| readings[instrument.observables.clone()].fill(None));
        readings
    }

    /// Returns the standard deviation of the first observable that is a length; that of a camera
    /// for a board that fills the width of the image.
    pub(super) fn uncertainty(&self) -> f64 {
        if let (Some(camera), Some(first)) = (&self.camera, self.observables.first()) {
            let across = self.observables.iter().map(|one| norm(one.corner)).fold(0.0, f64::max);
            return first.uncertainty * across / camera.image[0];
        }
        let lengths = self.observables.iter().find(|reading| !reading.kind.is_angle);
        lengths.map_or(1.0, |reading| reading.uncertainty)
    }

    /// Returns each setup with the indices of its instruments; a single one without a column of
    /// setups.
    pub fn setups(&self) -> Vec<(Option<f64>, Vec<usize>)> {
        let mut numbers: Vec<f64> = self.list.iter().filter_map(|instrument| instrument.setup).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        let all = if numbers.is_empty() { vec![None] } else { numbers.into_iter().map(Some).collect() };
        all.into_iter().map(|setup| (setup, self.read_in(setup))).collect()
    }

    /// Returns the indices of the instruments of a setup.
    pub(super) fn read_in(&self, setup: Option<f64>) -> Vec<usize> {
        let read = |i: &usize| self.list[*i].setup.is_none() || self.list[*i].setup == setup;
        (0..self.list.len()).filter(read).collect()
    }

    /// Returns placeholders for the readings of these instruments.
    pub fn unread(&self, instruments: &[usize]) -> Vec<Option<f64>> {
        let mut readings = vec![None; self.observables.len()];
        for i in instruments {
            readings[self.list[*i].observables.clone()].fill(Some(0.0));
        }
        readings
    }

    /// Returns the setup of a row with these readings.
    pub(super) fn setup_of(&self, readings: &[Option<f64>]) -> Option<f64> {
        let read = |instrument: &&Instrument| {
            instrument.setup.is_some() && readings[instrument.observables.clone()].iter().any(Option::is_some)
        };
        self.list.iter().find(read).and_then(|instrument| instrument.setup)
    }

    /// Converts the numbers of a row to readings; none where a cell is empty.
    ///
    /// The numbers are the setup, if there is a column for it, then the columns of all instruments.
    /// Returns the reason if the row has no reading.
    pub(super) fn read(&self, numbers: &[Option<f64>]) -> Result<Vec<Option<f64>>, String> {
        let skipped = usize::from(self.setup.is_some());
        let setup = numbers[..skipped].first().copied().flatten();
        let (_, places) = self.distinct_columns();
        let cell = |column: &Column| *numbers.get(skipped + places.get(&*column.name)?)?;
        let mut readings = vec![None; self.observables.len()];
        let read = self.read_in(setup);
        if read.is_empty() {
            let is_stated = setup.is_some() || skipped == 0;
            return Err(
                if is_stated { "the map has no instrument in this setup" } else { NOTHING_READ }.to_owned()
            );
        }
        for instrument in read.into_iter().map(|i| &self.list[i]) {
            for (place, reading) in instrument.observables.clone().enumerate() {
                readings[reading] = match instrument.kind.is_touched() {
                    true => Some(0.0),
                    false => cell(&instrument.columns[place]).map(|number| number * instrument.factor),
                };
            }
        }
        if readings.iter().all(Option::is_none) {
            return Err(NOTHING_READ.to_owned());
        }
        if let Some(camera) = &self.camera {
            check_view(camera, &readings)?;
        }
        Ok(readings)
    }

    /// Converts readings to the numbers of a row, in the order of [`read`](Self::read).
    pub(super) fn numbers(&self, readings: &[Option<f64>]) -> Vec<Option<f64>> {
        let mut numbers: Vec<Option<f64>> = self.setup.iter().map(|_| self.setup_of(readings)).collect();
        let (columns, places) = self.distinct_columns();
        let mut of_columns = vec![None; columns.len()];
        for instrument in &self.list {
            for (column, reading) in instrument.columns.iter().zip(&readings[instrument.observables.clone()])
            {
                let number = &mut of_columns[places[&*column.name]];
                *number = number.or(reading.map(|value| value / instrument.factor));
            }
        }
        numbers.extend(of_columns);
        numbers
    }

    /// Returns the columns of setup and readings.
    pub(super) fn columns(&self) -> Vec<&Column> {
        self.setup.iter().chain(self.distinct_columns().0).collect()
    }

    /// Returns the distinct columns of all instruments: one that is used in several setups has one
    /// column; and their places by name.
    fn distinct_columns(&self) -> (Vec<&Column>, HashMap<&str, usize>) {
        let (mut distinct, mut places) = (Vec::new(), HashMap::new());
        for column in self.list.iter().flat_map(|instrument| &instrument.columns) {
            places.entry(&*column.name).or_insert_with(|| {
                distinct.push(column);
                distinct.len() - 1
            });
        }
        (distinct, places)
    }
}

/// Smallest number of corners from which the pose of a board is computed.
const FEWEST: usize = 4;

/// Checks the pixels of one view; returns the reason if it cannot be used.
fn check_view(camera: &Camera, readings: &[Option<f64>]) -> Result<(), String> {
    let mut found = 0;
    for (i, pixel) in readings.chunks_exact(2).enumerate() {
        let corner = i + 1;
        match pixel {
            [Some(u), Some(v)] if camera.is_inside([*u, *v]) => found += 1,
            [Some(u), Some(v)] => {
                let [width, height] = camera.image;
                return Err(format!(
                    "corner {corner} at ({u}, {v}) px is outside the image of {width} × {height} px"
                ));
            }
            [None, None] => {}
            _ => return Err(format!("only one of the two pixels of corner {corner}")),
        }
    }
    if found < FEWEST {
        return Err(format!("{found} corners in this view; {FEWEST} are needed for the pose of the board"));
    }
    Ok(())
}
