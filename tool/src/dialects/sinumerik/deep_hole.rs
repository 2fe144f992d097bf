//! CYCLE83: deep holes in strokes, which break or clear chips. (Siemens, SINUMERIK 840D, Programming Guide
//! Cycles, "Deep-hole drilling".)

use super::cycle_parameters::Cycle;
use super::drilling::Hole;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::program::Action;

/// How many strokes a deep hole may take.
const STROKE_LIMIT: usize = 1000;

/// How far chip breaking comes back where the cycle does not say it (`_VRT` = 0), millimetres.
const CHIP_BREAKING: f64 = 1.0;

/// How the strokes of a deep hole become shorter.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Degression {
    /// By so much each; 0 for not at all.
    less: f64,
    /// To this share each, above 0 and at most 1.
    share: f64,
    /// The shortest stroke, but for the last ones.
    least: f64,
}

/// Dwells of CYCLE83, with the decimal places of `_AMODE` that give their units.
const DWELLS: [(&str, u32); 3] = [("DTB", 1), ("DTS", 2), ("_DTD", 3)];

impl Interpreter<'_> {
    pub(super) fn deep_hole(&mut self, hole: &Hole) -> Done {
        let cycle = hole.cycle;
        let first = first_depth(hole)?;
        let degression = degression(cycle)?;
        let unit = dwell_unit(cycle)?;
        let share = first_feed(cycle)?;
        self.say_how_modes_are_read(cycle)?;
        self.say_that_strokes_stay_short(cycle, first, &degression);
        let clears = match cycle.or_zero("VARI")? {
            0.0 => false,
            1.0 => true,
            _ => return Err(cycle.unsupported("VARI", "0 breaks chips, 1 clears them")),
        };
        let total = hole.reference - hole.bottom;
        let depths = strokes(total, first, &degression).ok_or_else(|| {
            Diagnostic::error(
                cycle.span,
                "the strokes of this cycle do not lead to the bottom",
            )
            .help("check the first depth (FDEP, FDPR), DAM and _MDEP")
        })?;
        let at_depth = cycle.or_zero("DTB")?;
        let at_bottom = cycle.nonzero("_DTD")?.unwrap_or(at_depth);
        let before = self.control.modal.feed;
        let last = depths.len() - 1;
        for (at, depth) in depths.into_iter().enumerate() {
            if !self.control.count_block(cycle.span) {
                return Ok(());
            }
            if at == 0 {
                self.scale_feed(before, share);
            }
            let bottom = hole.reference - depth;
            self.plunge(bottom, false, cycle.span)?;
            self.restore_feed(before);
            if at == last {
                return self.wait_by(cycle, at_bottom, unit);
            }
            self.wait_by(cycle, at_depth, unit)?;
            match clears {
                true => self.clear_chips(hole, bottom, unit)?,
                false => self.break_chips(hole, bottom)?,
            }
        }
        Ok(())
    }

    /// What these digits of `_AMODE` mean is not in the manuals that are at hand: posts write them.
    fn say_how_modes_are_read(&mut self, cycle: &Cycle) -> Done {
        for (name, none, place, digit, reading) in [
            ("DAM", 0.0, 5, "sixth", "1 as an amount, 2 as per cent"),
            ("FRF", 1.0, 6, "seventh", "1 as a factor, 2 as per cent"),
        ] {
            let value = cycle.nonzero(name)?.filter(|value| *value != none);
            if cycle.mode(place)? != 0 && value.is_some() {
                let message = format!(
                    "{name} by the {digit} digit of _AMODE: {reading}; look at the strokes and feeds before you cut"
                );
                let span = cycle.span_of("_AMODE");
                self.control
                    .note_once(&format!("{name} of CYCLE83"), &message, span);
            }
        }
        Ok(())
    }

    /// Programs have a first stroke that is shorter than what the others are to be shortened by; controls may
    /// go on with longer ones.
    fn say_that_strokes_stay_short(&mut self, cycle: &Cycle, first: f64, degression: &Degression) {
        if degression.least > first {
            let message =
                "the first stroke is shorter than DAM or _MDEP: no stroke is longer than the first";
            self.control
                .note_once("first stroke of CYCLE83", message, cycle.span);
        }
    }

    fn scale_feed(&mut self, feed: Option<f64>, share: f64) {
        if let Some(feed) = feed.filter(|_| share != 1.0) {
            self.control.modal.feed = Some(feed * share);
            self.control.actions.push(Action::Feed(feed * share));
        }
    }

    fn break_chips(&mut self, hole: &Hole, bottom: f64) -> Done {
        let back = match hole.cycle.nonzero("_VRT")? {
            Some(back) => back.abs(),
            None => CHIP_BREAKING / self.millimetres(),
        };
        self.plunge((bottom + back).min(hole.safe), false, hole.cycle.span)
    }

    /// Out of the hole and back to shortly before the bottom of the last stroke: `_DIS1`, or without it
    /// 0.6 mm up to a depth of 30 mm, then a fiftieth of it, at most 7 mm.
    fn clear_chips(&mut self, hole: &Hole, bottom: f64, unit: u32) -> Done {
        let cycle = hole.cycle;
        self.plunge(hole.safe, true, cycle.span)?;
        self.wait_by(cycle, cycle.or_zero("DTS")?, unit)?;
        let factor = self.millimetres();
        let own = ((hole.reference - bottom) * factor / 50.0).clamp(0.6, 7.0) / factor;
        let ahead = match (cycle.nonzero("_DIS1")?, cycle.mode(7)?) {
            (None, _) => own,
            (Some(ahead), 0) => ahead.abs(),
            // The control takes one of both: the longer way with feed is right for either.
            (Some(ahead), _) => ahead.abs().max(own),
        };
        self.plunge((bottom + ahead).min(hole.safe), true, cycle.span)
    }
}

/// The depth of the first stroke: FDPR, or from FDEP.
fn first_depth(hole: &Hole) -> Result<f64, Diagnostic> {
    let cycle = hole.cycle;
    let relative = cycle.nonzero("FDPR")?.map(f64::abs);
    let absolute = cycle.number("FDEP")?.map(|place| hole.reference - place);
    let first = match cycle.mode(4)? {
        0 => relative.or(absolute),
        1 => relative,
        _ => absolute,
    };
    Ok(first.unwrap_or(hole.reference - hole.bottom))
}

/// DAM: an amount above 0, a factor below 0, or as the sixth digit of `_AMODE` says: 1 an amount, 2 per
/// cent.
fn degression(cycle: &Cycle) -> Result<Degression, Diagnostic> {
    let amount = cycle.or_zero("DAM")?;
    let (less, share) = match cycle.mode(5)? {
        0 if amount < 0.0 => (0.0, -amount),
        2 if amount != 0.0 => (0.0, amount / 100.0),
        _ => (amount, 1.0),
    };
    if less < 0.0 || !(share > 0.0 && share <= 1.0) {
        return Err(cycle.unsupported(
            "DAM",
            "it is an amount above 0, or a factor from -1 to 0, or with 2 as the sixth digit of _AMODE \
             from 0 to 100 per cent",
        ));
    }
    let least = cycle.nonzero("_MDEP")?.map_or(less, f64::abs);
    Ok(Degression { less, share, least })
}

/// FRF: the feed of the first stroke over that of the program; in per cent where the seventh digit of
/// `_AMODE` is 2.
fn first_feed(cycle: &Cycle) -> Result<f64, Diagnostic> {
    let Some(share) = cycle.nonzero("FRF")? else {
        return Ok(1.0);
    };
    let share = match cycle.mode(6)? {
        2 => share / 100.0,
        _ => share,
    };
    match (0.001..=1.0).contains(&share) {
        true => Ok(share),
        false => Err(cycle.unsupported(
            "FRF",
            "it is a factor from 0.001 to 1, or with 2 as the seventh digit of _AMODE up to 100 per cent",
        )),
    }
}

/// The unit of the dwells, which is one for all of them here; see [`Interpreter::wait_by`].
fn dwell_unit(cycle: &Cycle) -> Result<u32, Diagnostic> {
    let mut units = [0; 3];
    let mut dwells = [0.0; 3];
    for (at, (name, place)) in DWELLS.into_iter().enumerate() {
        units[at] = cycle.mode(place)?;
        dwells[at] = cycle.or_zero(name)?;
    }
    let [first, ..] = units;
    if units == [first; 3] || dwells == [0.0; 3] {
        return Ok(first);
    }
    match units.contains(&2) || dwells.iter().any(|dwell| *dwell < 0.0) {
        false => Ok(1),
        true => Err(cycle.unsupported(
            "_AMODE",
            "give all dwells in one unit: its second to fourth digits are 1 for seconds, 2 for revolutions",
        )),
    }
}

/// The depths of the strokes, from the reference plane: each stroke is shorter than the one before until
/// it would be shorter than the least; the last two share what is left. `None` where they never reach the
/// bottom.
fn strokes(total: f64, first: f64, degression: &Degression) -> Option<Vec<f64>> {
    let Degression { less, share, least } = *degression;
    if !(first > 0.0 && less >= 0.0) {
        return None;
    }
    let shortens = less > 0.0 || share < 1.0;
    let mut depths = vec![first.min(total)];
    let mut stroke = first;
    while let Some(depth) = depths.last().copied().filter(|depth| *depth < total) {
        if shortens {
            stroke = (stroke * share - less).max(least).min(stroke);
        }
        let left = total - depth;
        let next = match left {
            left if left <= stroke => left,
            left if shortens && left < 2.0 * stroke && stroke == least => left / 2.0,
            _ => stroke,
        };
        // Rounding must not leave a last stroke of nothing.
        depths.push(if total - depth - next < 1e-9 * total {
            total
        } else {
            depth + next
        });
        if depths.len() > STROKE_LIMIT {
            return None;
        }
    }
    Some(depths)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn by(less: f64, share: f64, least: f64) -> Degression {
        Degression { less, share, least }
    }

    #[test]
    fn strokes_become_shorter_and_end_at_the_bottom() {
        for (total, first, degression, depths) in [
            (10.0, 4.0, by(0.0, 1.0, 0.0), Some(vec![4.0, 8.0, 10.0])),
            (10.0, 4.0, by(0.0, 1.0, 4.0), Some(vec![4.0, 8.0, 10.0])),
            (10.0, 20.0, by(1.0, 1.0, 1.0), Some(vec![10.0])),
            (
                20.0,
                8.0,
                by(3.0, 1.0, 3.0),
                Some(vec![8.0, 13.0, 16.0, 18.0, 20.0]),
            ),
            (14.0, 8.0, by(0.0, 0.5, 1.0), Some(vec![8.0, 12.0, 14.0])),
            (16.0, 8.0, by(0.0, 0.5, 4.0), Some(vec![8.0, 12.0, 16.0])),
            (
                17.0,
                8.0,
                by(5.0, 1.0, 4.0),
                Some(vec![8.0, 12.0, 14.5, 17.0]),
            ),
            (10.0, 0.0, by(1.0, 1.0, 1.0), None),
            (10.0, 1e-9, by(0.0, 1.0, 0.0), None),
        ] {
            assert_eq!(strokes(total, first, &degression), depths, "{degression:?}");
        }
    }
}
