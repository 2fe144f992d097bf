//! POCKET3 and POCKET4; see [`super::milling`].

use super::cycle_parameters::Cycle;
use super::interpreter::Interpreter;
use super::milling::{Levels, Milling};
use super::outline::{Outline, Piece};
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;

/// What the last digit of `_VARI` asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Work {
    Rough,
    Finish,
    FinishWall,
}

/// The allowances at the wall and at the floor, and the step between two ways.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Allowances {
    wall: f64,
    floor: f64,
    step: f64,
}

impl Interpreter<'_> {
    pub(super) fn pocket(&mut self, cycle: &Cycle, radius: f64) -> Done {
        let (part, turned) = part_outline(cycle, radius)?;
        cycle.check_digits("_GMODE", &[3, 4], 1)?;
        cycle.check_modes(&[0, 1])?;
        let reference = cycle.or_zero("_RFP")?;
        let depth = cycle.needed("_DP", "the depth")?;
        let bottom = match cycle.mode(0)? {
            1 => reference - depth.abs(),
            _ => depth,
        };
        let milling = Milling {
            cycle,
            middle: [cycle.or_zero("_PA")?, cycle.or_zero("_PO")?],
            turned,
            clockwise: self.goes_clockwise(cycle, "_CDIR")?,
            radius,
            levels: self.levels(cycle, "_", bottom)?,
            feeds: self.feeds(cycle, "_FFP1", "_FFD")?,
        };
        let step = cycle.nonzero("_MIDA")?.map(|step| match cycle.mode(1) {
            // In per cent of the diameter.
            Ok(1) => step.abs() / 100.0 * 2.0 * radius,
            _ => step.abs(),
        });
        let allowances = Allowances {
            wall: allowance(cycle, "_FAL")?,
            floor: allowance(cycle, "_FALD")?,
            step: milling.width_of_step(step),
        };
        let drops = infeed_is_rapid(cycle)?;
        match work(cycle)? {
            Work::Rough => self.rough_pocket(&milling, &part, &allowances, drops)?,
            Work::FinishWall => self.finish_wall(&milling, &part, &allowances)?,
            Work::Finish => {
                self.finish_wall(&milling, &part, &allowances)?;
                let floor = [milling.levels.bottom];
                // There is an allowance on the floor: no rapid motion into it.
                self.clear(&milling, &part, &floor, 0.0, allowances.step, false)?;
            }
        }
        self.plunge(milling.levels.retraction, true, cycle.span)
    }

    fn rough_pocket(
        &mut self,
        milling: &Milling,
        part: &Outline,
        allowances: &Allowances,
        drops: bool,
    ) -> Done {
        let bottom = milling.levels.bottom + allowances.floor;
        if bottom >= milling.levels.reference {
            return Err(milling.cycle.unsupported(
                "_FALD",
                "the allowance at the floor is not less than the depth",
            ));
        }
        let floors = milling.levels.floors(bottom);
        self.clear(
            milling,
            part,
            &floors,
            allowances.wall,
            allowances.step,
            drops,
        )
    }

    /// Clears the pocket on each of these floors, from the middle outwards.
    fn clear(
        &mut self,
        milling: &Milling,
        part: &Outline,
        floors: &[f64],
        allowance: f64,
        step: f64,
        drops: bool,
    ) -> Done {
        let span = milling.cycle.span;
        let last = milling.way_in(part, allowance)?;
        let ways = last.clearing(step, milling.radius);
        let Levels {
            reference, safe, ..
        } = milling.levels;
        let mut above = safe;
        for (at, floor) in floors.iter().enumerate() {
            if !self.control.count_block(span) {
                return Ok(());
            }
            if at == 0 {
                self.approach(milling, [0.0; 2])?;
            } else {
                // Off the floor, over the middle, and as far down as there is nothing.
                let lifted = (above + safe - reference).min(safe);
                self.plunge(lifted, true, span)?;
                self.rapid_in(milling, [0.0; 2])?;
            }
            self.infeed(milling, *floor, drops)?;
            above = *floor;
            for way in &ways {
                if !self.control.count_block(span) {
                    return Ok(());
                }
                self.mill_round(milling, way)?;
            }
        }
        Ok(())
    }

    fn rapid_in(&mut self, milling: &Milling, place: [f64; 2]) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let target = milling.place(place);
        self.rapid_to(&[first, second], &target, milling.cycle.span)
    }

    /// Once round the wall on each floor, with a quarter of a circle to it and another away from it.
    fn finish_wall(&mut self, milling: &Milling, part: &Outline, allowances: &Allowances) -> Done {
        let span = milling.cycle.span;
        let way = milling.way_in(part, 0.0)?;
        let [length, width] = way.half;
        let turn = (allowances.wall + milling.radius / 2.0).min(length.min(width));
        let side = if milling.clockwise { -1.0 } else { 1.0 };
        let begin = [length - turn, -side * turn];
        let end = [length - turn, side * turn];
        for (at, floor) in milling
            .levels
            .floors(milling.levels.bottom)
            .into_iter()
            .enumerate()
        {
            if !self.control.count_block(span) {
                return Ok(());
            }
            match at {
                0 => self.approach(milling, begin)?,
                _ => self.mill_to(milling, begin)?,
            }
            self.infeed(milling, floor, false)?;
            if turn == 0.0 {
                self.mill_round(milling, &way)?;
                continue;
            }
            let centre = Some([length - turn, 0.0]);
            let onto = Piece {
                end: [length, 0.0],
                centre,
            };
            self.mill_piece(milling, &onto, milling.clockwise)?;
            self.mill_round(milling, &way)?;
            self.mill_piece(milling, &Piece { end, centre }, milling.clockwise)?;
        }
        self.plunge(milling.levels.safe, true, span)
    }
}

/// The outline of the part, and how far it is turned. Corners are not sharper than the tool.
fn part_outline(cycle: &Cycle, radius: f64) -> Result<(Outline, f64), Diagnostic> {
    if cycle.name == "POCKET4" {
        let corner = cycle.needed("_PRAD", "the radius of the pocket")?;
        let half = [corner; 2];
        return Ok((Outline { half, corner }, 0.0));
    }
    let length = cycle.needed("_LENG", "the length of the pocket")?.abs() / 2.0;
    let width = cycle.needed("_WID", "the width of the pocket")?.abs() / 2.0;
    let corner = cycle.or_zero("_CRAD")?.max(radius);
    let outline = Outline {
        half: [length, width],
        corner: corner.min(length).min(width),
    };
    Ok((outline, cycle.or_zero("_STA")?))
}

pub(super) fn allowance(cycle: &Cycle, name: &str) -> Result<f64, Diagnostic> {
    match cycle.or_zero(name)? {
        allowance if allowance >= 0.0 => Ok(allowance),
        _ => Err(cycle.unsupported(name, "an allowance is at least 0")),
    }
}

fn work(cycle: &Cycle) -> Result<Work, Diagnostic> {
    match cycle.digit("_VARI", 0)? {
        0 | 1 => Ok(Work::Rough),
        2 => Ok(Work::Finish),
        4 => Ok(Work::FinishWall),
        _ => Err(cycle.unsupported(
            "_VARI",
            "its last digit is 1 for roughing, 2 for finishing, 4 for finishing the wall",
        )),
    }
}

/// The tens of `_VARI`: 0 goes down in rapid motion, 1 with the feed.
fn infeed_is_rapid(cycle: &Cycle) -> Result<bool, Diagnostic> {
    let others = (2..10).map(|place| cycle.digit("_VARI", place));
    for digit in others {
        if digit? != 0 {
            return Err(cycle.unsupported("_VARI", "it has two digits here"));
        }
    }
    match cycle.digit("_VARI", 1)? {
        0 => Ok(true),
        1 => Ok(false),
        2 => Err(cycle.unsupported(
            "_VARI",
            "going down on a helix is not translated: write 1 as its second digit to go straight down",
        )),
        _ => Err(cycle.unsupported(
            "_VARI",
            "going down to and fro is not translated: write 1 as its second digit to go straight down",
        )),
    }
}
