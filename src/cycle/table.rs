//! The cells of the reference that lie ahead, in a ring of fixed size.

use super::cell::Cell;
use super::feed_block::{BLOCK_LENGTH, FeedBlock};
use super::stored_cell::StoredCell;
use crate::axes::{AXIS_COUNT, Axes};
use crate::lanes::{LANE_COUNT, Lanes, ZEROS};
use crate::ring::Ring;

/// Cells that the table holds, the one that runs included.
pub const CAPACITY: usize = 1024;

/// Cells that can be pushed: what is behind the last one must not reach into the block of the first.
pub const USABLE: usize = CAPACITY - BLOCK_LENGTH;

const BLOCK_COUNT: usize = CAPACITY / BLOCK_LENGTH;

/// As the numbers of cells count.
const BLOCK_CELLS: u64 = BLOCK_LENGTH as u64;

/// Why a cell was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PushError {
    /// No limits and no servo period have been set.
    NotConfigured,
    /// The table is full: wait until the executor has advanced.
    Full,
    /// The reference was closed: nothing follows its end.
    Closed,
    /// A velocity or acceleration at the start of the cell is infinite or not a number.
    NotFinite {
        /// Index of the axis.
        axis: usize,
    },
    /// The path velocity, its derivative, the feed ratio or the programmed feed is infinite or
    /// not a number, or the programmed feed is not positive.
    Feed,
}

/// Why the reference cannot be closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CloseError {
    /// There is no cell to end in.
    Empty,
    /// It was closed before.
    Closed,
    /// The end is not within the last cell, or not ahead of the machine.
    OutsideLastCell,
}

/// The reference at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub velocity: Lanes,
    pub acceleration: Lanes,
    /// The cell that the instant lies in, counted from the first one of the table.
    pub cell: usize,
}

/// Path velocity of the reference at one instant, and its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Along {
    pub velocity: f64,
    pub acceleration: f64,
    pub jerk: f64,
}

/// The cells of the reference from the one that runs, in time units of one cell. All times are
/// counted from the start of the first cell; [`Table::discard`] moves this origin, so that time
/// never grows large and a program may run for days.
#[derive(Clone, Debug)]
pub struct Table {
    cells: Ring<StoredCell, CAPACITY>,
    blocks: Ring<FeedBlock, BLOCK_COUNT>,
    /// Cells discarded since the last clear: the number of the first one.
    first: u64,
    length: usize,
    end: Option<f64>,
}

impl Table {
    pub const fn new() -> Self {
        Self {
            cells: Ring::filled_with(StoredCell::STANDSTILL),
            blocks: Ring::filled_with(FeedBlock::EMPTY),
            first: 0,
            length: 0,
            end: None,
        }
    }

    pub fn clear(&mut self) {
        self.first = 0;
        self.length = 0;
        self.end = None;
        // With no cell, every look-up answers with the one at the end.
        self.write(StoredCell::STANDSTILL);
    }

    /// Cells known from the first one on.
    pub fn length(&self) -> usize {
        self.length
    }

    /// When the reference comes to rest for good, if that is known.
    pub fn end(&self) -> Option<f64> {
        self.end
    }

    /// Whether the reference is known up to `time`. The end of the last cell takes the start of
    /// the next one, so an open table is known up to the start of its last cell.
    #[inline(always)]
    pub fn knows(&self, time: f64) -> bool {
        self.end.is_some() || time < self.length as f64 - 1.0
    }

    /// Whether `time` is at or behind the end of a closed reference.
    #[inline(always)]
    pub fn is_behind_end(&self, time: f64) -> bool {
        match self.end {
            Some(end) => time >= end,
            None => false,
        }
    }

    /// Adds a cell; `period` is the servo period, seconds.
    pub fn push(&mut self, cell: &Cell, period: f64) -> Result<(), PushError> {
        if self.end.is_some() {
            return Err(PushError::Closed);
        }
        if self.length >= USABLE {
            return Err(PushError::Full);
        }
        check(cell)?;
        let stored = StoredCell::new(cell, period);
        let number = self.number(self.length);
        let block = self.blocks.at_mut(number / BLOCK_CELLS);
        if number.is_multiple_of(BLOCK_CELLS) || self.length == 0 {
            *block = FeedBlock::EMPTY;
        }
        block.include(&stored);
        self.write(stored);
        self.length += 1;
        Ok(())
    }

    /// The reference comes to rest `time` after the start of the last cell, 0 to 1.
    pub fn close(&mut self, time: f64, now: f64) -> Result<(), CloseError> {
        if self.end.is_some() {
            return Err(CloseError::Closed);
        }
        if self.length == 0 {
            return Err(CloseError::Empty);
        }
        let end = self.length as f64 - 1.0 + time;
        if !(0.0..=1.0 + 1e-9).contains(&time) || end < now {
            return Err(CloseError::OutsideLastCell);
        }
        self.end = Some(end);
        let last = self.number(self.length - 1);
        self.cells.at_mut(last).include_standstill();
        self.write(StoredCell::STANDSTILL);
        Ok(())
    }

    /// Forgets `count` cells and counts time from the one after.
    pub fn discard(&mut self, count: usize) {
        let count = count.min(self.length);
        self.first = self.first.wrapping_add(count as u64);
        self.length -= count;
        if let Some(end) = &mut self.end {
            *end -= count as f64;
        }
    }

    /// The cell with this index from the first one, or the last one that is known.
    #[inline(always)]
    pub fn cell(&self, index: usize) -> &StoredCell {
        self.cells.at(self.number(index.min(self.length)))
    }

    /// Velocity and acceleration at `time`: a cubic position in each cell has a linear
    /// acceleration, and the velocity is its integral.
    #[inline(always)]
    pub fn node(&self, time: f64) -> Node {
        // A cast saturates.
        let cell = (time as usize).min(self.length);
        let start = self.cell(cell);
        let end = self.cell(cell + 1);
        let part = ((time - cell as f64).clamp(0.0, 1.0)) as f32;
        let bend = 0.5 * part * (1.0 - part);
        let mut node = Node {
            velocity: ZEROS,
            acceleration: ZEROS,
            cell,
        };
        for lane in 0..LANE_COUNT {
            let (v0, v1) = (start.velocity[lane], end.velocity[lane]);
            let (a0, a1) = (start.acceleration[lane], end.acceleration[lane]);
            node.velocity[lane] = v0 + part * (v1 - v0) - bend * (a1 - a0);
            node.acceleration[lane] = a0 + part * (a1 - a0);
        }
        node
    }

    /// Path velocity at `time` with its derivatives, as [`Self::node`] for the axes.
    #[inline(always)]
    pub fn along(&self, time: f64) -> Along {
        let cell = (time as usize).min(self.length);
        let (start, end) = (self.cell(cell), self.cell(cell + 1));
        let part = (time - cell as f64).clamp(0.0, 1.0);
        let (v0, v1) = (f64::from(start.path_velocity), f64::from(end.path_velocity));
        let (a0, a1) = (
            f64::from(start.path_acceleration),
            f64::from(end.path_acceleration),
        );
        Along {
            velocity: v0 + part * (v1 - v0) - 0.5 * part * (1.0 - part) * (a1 - a0),
            acceleration: a0 + part * (a1 - a0),
            jerk: a1 - a0,
        }
    }

    /// Blocks of cells from the one that `time` lies in, as far as cells are known, at most
    /// enough for `cells` cells.
    pub fn blocks(&self, time: f64, cells: usize) -> impl Iterator<Item = &FeedBlock> {
        let first = (time as usize).min(self.length);
        let number = self.number(first);
        let offset = (number % BLOCK_CELLS) as usize;
        let known = self.length - first;
        let count = (known.min(cells) + offset).div_ceil(BLOCK_LENGTH);
        let block = number / BLOCK_CELLS;
        (0..count.min(BLOCK_COUNT) as u64).map(move |i| self.blocks.at(block.wrapping_add(i)))
    }

    /// The spindle that the first cells with feed per turn follow.
    pub fn spindle(&self) -> Option<usize> {
        let follows = |cell: &&StoredCell| cell.planned_turns > 0.0;
        let offset = (self.first % BLOCK_CELLS) as usize;
        let blocks = self.blocks(0.0, USABLE).enumerate();
        blocks
            .filter(|(_, block)| block.planned_turns > 0.0)
            .find_map(|(block, _)| {
                let from = (block * BLOCK_LENGTH).saturating_sub(offset);
                let to = ((block + 1) * BLOCK_LENGTH - offset).min(self.length);
                (from..to).map(|index| self.cell(index)).find(follows)
            })
            .map(|cell| usize::from(cell.spindle))
    }

    #[inline(always)]
    fn number(&self, index: usize) -> u64 {
        self.first.wrapping_add(index as u64)
    }

    /// Writes the slot behind the last cell.
    fn write(&mut self, cell: StoredCell) {
        let number = self.number(self.length);
        *self.cells.at_mut(number) = cell;
    }
}

fn check(cell: &Cell) -> Result<(), PushError> {
    let finite = |axes: &Axes, axis: usize| axes.get(axis).is_some_and(|value| value.is_finite());
    for axis in 0..AXIS_COUNT {
        if !finite(&cell.velocity, axis) || !finite(&cell.acceleration, axis) {
            return Err(PushError::NotFinite { axis });
        }
    }
    let feed = [
        cell.path_velocity,
        cell.path_acceleration,
        cell.feed_ratio,
        cell.programmed_feed,
    ];
    if feed.iter().any(|value| !value.is_finite()) || cell.programmed_feed <= 0.0 {
        return Err(PushError::Feed);
    }
    if cell
        .feed_per_turn
        .is_some_and(|with| with.planned_turns.is_nan())
    {
        return Err(PushError::Feed);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::cell::FeedPerTurn;
    use super::*;

    /// A cell of a cubic position along X with a jerk of 0.006 in units of the period.
    fn cubic(start: f64) -> Cell {
        let velocity = Axes::x() * (0.003 * start * start - 0.4);
        let acceleration = Axes::x() * (0.006 * start);
        Cell {
            velocity,
            acceleration,
            acceleration_min: acceleration,
            acceleration_max: acceleration + Axes::x() * 0.006,
            jerk_min: Axes::x() * 0.006,
            jerk_max: Axes::x() * 0.006,
            path_velocity: start,
            path_acceleration: 0.0,
            feed_ratio: 1.0,
            programmed_feed: 1.0,
            feed_per_turn: None,
            rapid: false,
            override_enabled: true,
        }
    }

    #[test]
    fn a_cubic_is_exact_between_the_cells() {
        let mut table = Box::new(Table::new());
        table.clear();
        for i in 0..10 {
            table.push(&cubic(f64::from(i)), 1.0).unwrap();
        }
        assert!(table.knows(8.9) && !table.knows(9.0));
        for i in 0..=90 {
            let time = f64::from(i) * 0.1;
            let node = table.node(time);
            assert!((f64::from(node.velocity[0]) - (0.003 * time * time - 0.4)).abs() < 1e-7);
            assert!((f64::from(node.acceleration[0]) - 0.006 * time).abs() < 1e-7);
        }
    }

    #[test]
    fn the_ring_goes_round() {
        let mut table = Box::new(Table::new());
        table.clear();
        let mut pushed = 0.0;
        for round in 0..5000 {
            while table.length() < 300 + round % 7 {
                table.push(&cubic(pushed), 1.0).unwrap();
                pushed += 1.0;
            }
            let first = pushed - table.length() as f64;
            assert_eq!(table.cell(0).feed(), first);
            assert_eq!(table.cell(200).feed(), first + 200.0);
            assert!((7..=8).contains(&table.blocks(0.0, 100).count()));
            table.discard(1 + round % 3);
        }
    }

    #[test]
    fn the_first_spindle_ahead_is_found() {
        let mut table = Box::new(Table::new());
        table.clear();
        assert_eq!(table.spindle(), None);
        let followed = |cell: usize| match cell {
            50..70 => Some(3),
            90.. => Some(1),
            _ => None,
        };
        for cell in 0..120 {
            let feed_per_turn = followed(cell).map(|spindle| FeedPerTurn {
                spindle,
                planned_turns: 10.0,
            });
            let cell = Cell {
                feed_per_turn,
                ..cubic(1.0)
            };
            table.push(&cell, 1.0).unwrap();
        }
        for discarded in 0..120 {
            assert_eq!(table.spindle(), (discarded..120).find_map(followed));
            table.discard(1);
        }
        assert_eq!(table.spindle(), None);
    }

    #[test]
    fn behind_the_end_it_stands_still() {
        let mut table = Box::new(Table::new());
        table.clear();
        table.push(&cubic(0.0), 1.0).unwrap();
        table.push(&cubic(1.0), 1.0).unwrap();
        table.close(0.5, 0.0).unwrap();
        assert_eq!(table.end(), Some(1.5));
        assert!(table.is_behind_end(1.5) && !table.is_behind_end(1.4));
        for time in [2.0, 7.0, 1e9, f64::INFINITY] {
            let node = table.node(time);
            assert_eq!(node.velocity, ZEROS);
            assert_eq!(node.acceleration, ZEROS);
        }
        assert_eq!(table.cell(1).acceleration_min[0], 0.0);
        table.discard(1);
        assert_eq!(table.end(), Some(0.5));
    }
}
