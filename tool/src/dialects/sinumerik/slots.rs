//! SLOT1 and LONGHOLE: slots that point away from the middle of a circle; see [`super::milling`].

use super::cycle_parameters::Cycle;
use super::interpreter::Interpreter;
use super::milling::{Levels, Milling};
use super::outline::Outline;
use super::pockets::allowance;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::words::At;
use framepath::frame::angle::sin_cos_degrees;

/// How many slots a cycle may mill.
const SLOT_LIMIT: f64 = 1000.0;

/// What VARI of SLOT1 asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Work {
    rough: bool,
    finish: bool,
    /// Whether the tool goes down in rapid motion.
    drops: bool,
}

impl Interpreter<'_> {
    pub(super) fn slots(&mut self, cycle: &Cycle, radius: f64) -> Done {
        let length = cycle.needed("LENG", "the length of a slot")?.abs();
        let width = cycle.needed("WID", "the width of a slot")?.abs();
        if width > length {
            return Err(cycle.unsupported("WID", "a slot is not wider than it is long"));
        }
        let part = Outline {
            half: [length / 2.0, width / 2.0],
            corner: width / 2.0,
        };
        cycle.check_modes(&[0])?;
        let levels = self.slot_levels(cycle)?;
        let work = work(cycle)?;
        let clockwise = self.goes_clockwise(cycle, "CDIR")?;
        for (middle, turned) in places(cycle, length)? {
            let milling = Milling {
                cycle,
                middle,
                turned,
                clockwise,
                radius,
                levels,
                feeds: self.feeds(cycle, "FFP1", "FFD")?,
            };
            if work.rough {
                self.rough_slot(&milling, &part, work.drops)?;
            }
            if work.finish {
                self.finish_slot(milling, &part)?;
            }
            self.plunge(levels.retraction, true, cycle.span)?;
        }
        Ok(())
    }

    fn rough_slot(&mut self, milling: &Milling, part: &Outline, drops: bool) -> Done {
        let cycle = milling.cycle;
        let way = milling.way_in(part, allowance(cycle, "FAL")?)?;
        let bottom = milling.levels.bottom + allowance(cycle, "_FALD")?;
        let step = milling.width_of_step(None);
        let ways = way.clearing(step, milling.radius);
        let start = [0.0; 2];
        self.approach(milling, start)?;
        for floor in milling.levels.floors(bottom) {
            if !self.control.count_block(cycle.span) {
                return Ok(());
            }
            self.mill_to(milling, start)?;
            self.infeed(milling, floor, drops)?;
            for way in &ways {
                self.mill_round(milling, way)?;
            }
        }
        Ok(())
    }

    /// The wall, in steps of MIDF with the feed FFP2 and the speed SSF.
    fn finish_slot(&mut self, mut milling: Milling, part: &Outline) -> Done {
        let cycle = milling.cycle;
        let way = milling.way_in(part, 0.0)?;
        milling.levels.step = cycle.or_zero("MIDF")?.abs();
        let span = cycle.span_of("FFP2");
        if let Some(value) = cycle.nonzero("FFP2")? {
            milling.feeds.surface = Some(At { value, span });
        }
        let speed = self.control.modal.spindle_speed;
        if let Some(value) = cycle.nonzero("SSF")? {
            let span = cycle.span_of("SSF");
            self.control.speed(At { value, span })?;
        }
        let start = [way.half[0] - way.half[1], 0.0];
        self.plunge(milling.levels.safe, true, cycle.span)?;
        self.approach(&milling, start)?;
        for floor in milling.levels.floors(milling.levels.bottom) {
            if !self.control.count_block(cycle.span) {
                return Ok(());
            }
            self.mill_to(&milling, start)?;
            self.infeed(&milling, floor, false)?;
            self.mill_round(&milling, &way)?;
        }
        match speed.filter(|speed| Some(*speed) != self.control.modal.spindle_speed) {
            Some(value) => self.control.speed(At { value, span }),
            None => Ok(()),
        }
    }

    /// LONGHOLE: to and fro, deeper at each end.
    pub(super) fn long_holes(&mut self, cycle: &Cycle, radius: f64) -> Done {
        let length = cycle.needed("LENG", "the length of a slot")?.abs();
        if length < 2.0 * radius {
            return Err(Diagnostic::error(
                cycle.span_of("LENG"),
                format!("a tool of the diameter {} does not fit here", 2.0 * radius),
            )
            .help("check LENG, and D of the tool in LinuxCNC's tool table"));
        }
        let reach = length / 2.0 - radius;
        let levels = self.slot_levels(cycle)?;
        for (middle, turned) in places(cycle, length)? {
            let milling = Milling {
                cycle,
                middle,
                turned,
                clockwise: false,
                radius,
                levels,
                feeds: self.feeds(cycle, "FFP1", "FFD")?,
            };
            let mut end = -reach;
            self.approach(&milling, [end, 0.0])?;
            for floor in levels.floors(levels.bottom) {
                if !self.control.count_block(cycle.span) {
                    return Ok(());
                }
                self.infeed(&milling, floor, false)?;
                end = -end;
                self.mill_to(&milling, [end, 0.0])?;
            }
            self.plunge(levels.retraction, true, cycle.span)?;
        }
        Ok(())
    }

    fn slot_levels(&self, cycle: &Cycle) -> Result<Levels, Diagnostic> {
        let bottom = self.depth(cycle, cycle.or_zero("RFP")?, cycle.mode(0)?)?;
        self.levels(cycle, "", bottom)
    }
}

/// The middles of the slots and their directions. RAD is from the middle of the circle to the near end of a
/// slot, and INDA from one to the next, in degrees; 0 spreads them evenly.
fn places(cycle: &Cycle, length: f64) -> Result<Vec<([f64; 2], f64)>, Diagnostic> {
    let count = cycle.or_zero("NUM")?;
    if count.fract() != 0.0 || !(1.0..=SLOT_LIMIT).contains(&count) {
        return Err(cycle.unsupported("NUM", "it is the number of slots"));
    }
    let step = cycle.nonzero("INDA")?.unwrap_or(360.0 / count);
    let distance = cycle.or_zero("RAD")? + length / 2.0;
    let (x, y) = (cycle.or_zero("CPA")?, cycle.or_zero("CPO")?);
    let first = cycle.or_zero("STA1")?;
    let place = |number: u32| {
        let direction = first + f64::from(number) * step;
        let (sin, cos) = sin_cos_degrees(direction);
        ([x + distance * cos, y + distance * sin], direction)
    };
    Ok((0..count as u32).map(place).collect())
}

fn work(cycle: &Cycle) -> Result<Work, Diagnostic> {
    let (units, tens) = (cycle.digit("VARI", 0)?, cycle.digit("VARI", 1)?);
    let drops = match (tens, cycle.or_zero("VARI")? < 100.0) {
        (0, true) => true,
        (1, true) => false,
        _ => {
            return Err(cycle.unsupported(
                "VARI",
                "its second digit is 0 or 1: going down on a helix or to and fro is not translated",
            ));
        }
    };
    let (rough, finish) = match units {
        0 => (true, true),
        1 => (true, false),
        2 => (false, true),
        _ => {
            return Err(cycle.unsupported(
                "VARI",
                "its last digit is 0 for the whole, 1 for roughing, 2 for finishing",
            ));
        }
    };
    Ok(Work {
        rough,
        finish,
        drops,
    })
}
