//! Patterns of places at which a modal cycle or subprogram runs: HOLES1 (a row), HOLES2 (a circle),
//! CYCLE801 (a grid or its frame), CYCLE802 (single places). (Siemens, SINUMERIK 840D sl, Programming Manual
//! Job Planning, "External programming of cycles".)

use super::cycle_parameters::Cycle;
use super::interpreter::Interpreter;
use super::syntax::{Block, Call};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::run::Next;
use framepath::frame::angle::sin_cos_degrees;

/// How many holes a pattern may have.
const HOLE_LIMIT: u32 = 10_000;

/// How many places CYCLE802 has.
const PLACES: usize = 9;

impl Interpreter<'_> {
    /// The modal subprogram or cycle at each place of a pattern.
    pub(super) fn pattern(&mut self, call: &Call, block: &Block) -> Done {
        let Some(cycle) = self.cycle(call)? else {
            return Ok(());
        };
        let places = match cycle.name {
            "HOLES1" => row(&cycle)?,
            "HOLES2" => circle(&cycle)?,
            "CYCLE801" => grid(&cycle)?,
            _ => single_places(&cycle)?,
        };
        if self.modal_call.is_none() {
            return Err(Diagnostic::error(
                call.span,
                format!("{} without a modal cycle", call.name),
            )
            .help("say before what is done at the holes: MCALL CYCLE81(10,0,2,-5)"));
        }
        let [first, second, _] = self.control.modal.plane.axes();
        for at in places {
            if !self.control.count_block(call.span) {
                return Ok(());
            }
            self.rapid_to(&[first, second], &at, call.span)?;
            self.control.finish_marker(&block.place);
            if !matches!(self.run_modal_call(block, 0)?, Next::Block(_)) {
                return Ok(());
            }
        }
        Ok(())
    }
}

/// How many holes; at least 1.
fn count(cycle: &Cycle, name: &str) -> Result<u32, Diagnostic> {
    let count = cycle.or_zero(name)?;
    if count.fract() != 0.0 || !(1.0..=f64::from(HOLE_LIMIT)).contains(&count) {
        return Err(Diagnostic::error(
            cycle.span_of(name),
            format!("{name} = {count} is not a number of holes"),
        ));
    }
    Ok(count as u32)
}

/// A place at a distance from another one in a direction, degrees.
fn from([x, y]: [f64; 2], distance: f64, direction: f64) -> [f64; 2] {
    let (sin, cos) = sin_cos_degrees(direction);
    [x + distance * cos, y + distance * sin]
}

fn row(cycle: &Cycle) -> Result<Vec<[f64; 2]>, Diagnostic> {
    let start = [cycle.or_zero("SPCA")?, cycle.or_zero("SPCO")?];
    let (begin, step) = (cycle.or_zero("FDIS")?, cycle.or_zero("DBH")?);
    let direction = cycle.or_zero("STA1")?;
    let place = |number: u32| from(start, begin + f64::from(number) * step, direction);
    Ok((0..count(cycle, "NUM")?).map(place).collect())
}

/// The thousands of `_VARI` say whether it is a whole circle (1) or a part of one (2); its tens, whether
/// the way from hole to hole is straight.
fn circle(cycle: &Cycle) -> Result<Vec<[f64; 2]>, Diagnostic> {
    let centre = [cycle.or_zero("CPA")?, cycle.or_zero("CPO")?];
    let (radius, begin) = (cycle.or_zero("RAD")?, cycle.or_zero("STA1")?);
    let count = count(cycle, "NUM")?;
    cycle.check_digits("_VARI", &[3], 2)?;
    let step = match (cycle.nonzero("INDA")?, cycle.digit("_VARI", 3)?) {
        (Some(step), 0 | 2) => step,
        _ => 360.0 / f64::from(count),
    };
    let place = |number: u32| from(centre, radius, begin + f64::from(number) * step);
    Ok((0..count).map(place).collect())
}

/// Row by row to and fro, or once round the frame (`_VARI` = 1).
fn grid(cycle: &Cycle) -> Result<Vec<[f64; 2]>, Diagnostic> {
    let corner = [cycle.or_zero("_SPCA")?, cycle.or_zero("_SPCO")?];
    let direction = cycle.or_zero("_STA")?;
    let steps = [cycle.or_zero("_DIS1")?, cycle.or_zero("_DIS2")?];
    let (columns, rows) = (count(cycle, "_NUM1")?, count(cycle, "_NUM2")?);
    if u64::from(columns) * u64::from(rows) > u64::from(HOLE_LIMIT) {
        return Err(Diagnostic::error(
            cycle.span,
            format!("a grid of {columns} by {rows} holes: at most {HOLE_LIMIT} are supported"),
        ));
    }
    let cells = match cycle.or_zero("_VARI")? {
        0.0 => to_and_fro(columns, rows),
        1.0 => around(columns, rows),
        _ => return Err(cycle.unsupported("_VARI", "0 is a grid, 1 its frame")),
    };
    let place = |[column, row]: [u32; 2]| {
        let along = from(corner, f64::from(column) * steps[0], direction);
        from(along, f64::from(row) * steps[1], direction + 90.0)
    };
    Ok(cells.into_iter().map(place).collect())
}

fn to_and_fro(columns: u32, rows: u32) -> Vec<[u32; 2]> {
    let row = |row: u32| {
        (0..columns).map(move |column| match row % 2 {
            0 => [column, row],
            _ => [columns - 1 - column, row],
        })
    };
    (0..rows).flat_map(row).collect()
}

fn around(columns: u32, rows: u32) -> Vec<[u32; 2]> {
    if columns == 1 || rows == 1 {
        return to_and_fro(columns, rows);
    }
    let (right, top) = (columns - 1, rows - 1);
    let there = (0..right).map(|column| [column, 0]);
    let up = (0..top).map(|row| [right, row]);
    let back = (1..=right).rev().map(|column| [column, top]);
    let down = (1..=top).rev().map(|row| [0, row]);
    there.chain(up).chain(back).chain(down).collect()
}

/// `_X0`, `_Y0` and so on as far as they are given; `_XA` and `_YA` have a digit for each, 1 for absolute, 2
/// for from the place before.
fn single_places(cycle: &Cycle) -> Result<Vec<[f64; 2]>, Diagnostic> {
    let incremental = [is_incremental(cycle, "_XA")?, is_incremental(cycle, "_YA")?];
    let mut places: Vec<[f64; 2]> = Vec::new();
    for number in 0..PLACES {
        let names = [format!("_X{number}"), format!("_Y{number}")];
        let given = [cycle.number(&names[0])?, cycle.number(&names[1])?];
        if given == [None; 2] {
            continue;
        }
        let before = places.last().copied();
        let mut place = [0.0; 2];
        for axis in [0, 1] {
            place[axis] = match (given[axis], before, incremental[axis]) {
                (Some(value), Some(before), true) => before[axis] + value,
                (Some(value), _, _) => value,
                (None, Some(before), _) => before[axis],
                (None, None, _) => return Err(cycle.missing(&names[axis])),
            };
        }
        places.push(place);
    }
    match places.is_empty() {
        true => Err(cycle.missing("_X0")),
        false => Ok(places),
    }
}

/// Whether the places behind the first count from the one before. Where some do and some do not, it is
/// not told apart which.
fn is_incremental(cycle: &Cycle, name: &str) -> Result<bool, Diagnostic> {
    let digits = cycle.or_zero(name)?.to_string();
    match digits.trim_start_matches('0') {
        "" => Ok(false),
        all if all.chars().all(|digit| digit == '1') => Ok(false),
        "222222222" | "222222221" | "122222222" => Ok(true),
        _ => Err(cycle.unsupported(
            name,
            "write 111111111 and all places absolute, or 222222222 and all but the first incremental",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_the_border_of_its_grid() {
        for (columns, rows) in [(3, 3), (4, 2), (1, 5), (5, 1), (2, 2)] {
            let frame = around(columns, rows);
            let border = to_and_fro(columns, rows).into_iter().filter(|cell| {
                cell[0] == 0 || cell[1] == 0 || cell[0] == columns - 1 || cell[1] == rows - 1
            });
            let mut sorted = frame.clone();
            sorted.sort_unstable();
            let mut border: Vec<[u32; 2]> = border.collect();
            border.sort_unstable();
            assert_eq!(sorted, border);
            let near = |a: [u32; 2], b: [u32; 2]| a[0].abs_diff(b[0]) + a[1].abs_diff(b[1]) == 1;
            assert!(
                frame.windows(2).all(|pair| near(pair[0], pair[1])),
                "{frame:?}"
            );
        }
    }
}
