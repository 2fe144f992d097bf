//! Pockets: rectangular (G87) and circular (G88), milled from the middle outwards, layer by layer.
//!
//! `G87 X Y Z I J K B C D H L V`: the middle, the reference plane Z and the bottom I as in drilling; J and K are
//! half of the length and half of the width (G88: J is the radius), and J above 0 goes round clockwise;
//! B the depth of a layer and C the step between two rounds, below 0 exactly so deep and wide and the
//! last one less, above 0 all alike and at most so; D how far the surface lies behind the reference plane;
//! L what is left for the last round with the feed H; V the feed into the depth, half of F if it is left
//! out. (Fagor, CNC 8055 Programming Manual, "Rectangular pocket canned cycle", "Circular pocket canned
//! cycle"; CNC 8060, "ISO canned cycles".)

use super::block_words::BlockWords;
use super::cycles::Cycle;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::source::Span;

/// The default step between two rounds, over the diameter of the tool.
const USUAL_STEP: f64 = 0.75;

/// The widest step of a rectangle that leaves nothing in its corners, over the radius of the tool: two
/// corners are then less than (1 + sqrt 2) radii apart along the diagonal.
const WIDEST_STEP: f64 = 1.7;

/// A pocket that is in force; lengths in machine units, feeds in those of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pocket {
    /// Half of its length and width; twice the radius of a circular one.
    half: [f64; 2],
    circular: bool,
    clockwise: bool,
    /// B.
    layer: f64,
    /// C.
    step: Option<f64>,
    /// D.
    surface: f64,
    /// L.
    finish: f64,
    /// H.
    finish_feed: Option<f64>,
    /// V.
    plunge_feed: Option<f64>,
}

/// A pocket with the tool that mills it.
struct Milling {
    pocket: Pocket,
    /// Radius of the tool, as the program is scaled.
    radius: f64,
    /// Diameter of the tool as it is.
    diameter: f64,
    /// The middle, along the first and the second axis of the plane.
    middle: [f64; 2],
    /// F, units of the program.
    feed: f64,
    span: Span,
}

impl Pocket {
    /// Takes the words of a pocket out of its block, whose letters mean something else elsewhere. What is
    /// not there stays as in `old`.
    pub fn take(
        words: &mut BlockWords,
        g: At<u32>,
        old: Option<Pocket>,
        factor: f64,
    ) -> Result<Pocket, Diagnostic> {
        let circular = old.map_or(g.value == 88, |old| old.circular);
        let given = Given::take(words);
        let needed = |letter: &str, value: Option<f64>, old: Option<f64>| match value
            .map(|value| value * factor)
            .or(old)
        {
            Some(value) if value != 0.0 => Ok(value),
            _ => Err(wrong(
                g,
                &format!("needs {letter}, and not 0"),
                "write G87 X50 Y50 Z2 I-10 J40 K25 B3 or G88 X50 Y50 Z2 I-10 J25 B3",
            )),
        };
        let sign = |old: Pocket| if old.clockwise { 1.0 } else { -1.0 };
        let length = needed("J", given.length, old.map(|old| old.half[0] * sign(old)))?;
        let width = match (circular, given.width) {
            (false, width) => needed("K", width, old.map(|old| old.half[1]))?,
            (true, None) => length,
            (true, Some(_)) => {
                return Err(wrong(g, "has no K", "J is the radius of a circular pocket"));
            }
        };
        if given.step == Some(0.0) {
            return Err(wrong(
                g,
                "with the step C0",
                "leave C out for 3/4 of the tool",
            ));
        }
        if given.surface.is_some_and(|surface| surface < 0.0) {
            return Err(wrong(
                g,
                "with D below 0",
                "the surface lies behind the reference plane",
            ));
        }
        let length_of = |value: Option<f64>| value.map(|value| value * factor);
        let above_0 = |value: Option<f64>| value.filter(|value| *value > 0.0);
        Ok(Pocket {
            half: [length.abs(), width.abs()],
            circular,
            clockwise: length > 0.0,
            layer: needed("B", given.layer, old.map(|old| old.layer))?,
            step: length_of(given.step).or(old.and_then(|old| old.step)),
            surface: length_of(given.surface).unwrap_or(old.map_or(0.0, |old| old.surface)),
            finish: length_of(given.finish).map_or(old.map_or(0.0, |old| old.finish), f64::abs),
            finish_feed: above_0(given.finish_feed).or(old.and_then(|old| old.finish_feed)),
            plunge_feed: above_0(given.plunge_feed).or(old.and_then(|old| old.plunge_feed)),
        })
    }
}

/// The words of a pocket as they are written.
struct Given {
    length: Option<f64>,
    width: Option<f64>,
    layer: Option<f64>,
    step: Option<f64>,
    surface: Option<f64>,
    finish: Option<f64>,
    finish_feed: Option<f64>,
    plunge_feed: Option<f64>,
}

impl Given {
    fn take(words: &mut BlockWords) -> Given {
        let value = |word: Option<At<f64>>| word.map(|word| word.value);
        let mut axis = |axis: usize| words.axes[axis].take().and_then(|word| word.value);
        Given {
            layer: axis(4),
            step: axis(5),
            plunge_feed: axis(7),
            length: value(words.centre[1].take()),
            width: value(words.centre[2].take()),
            surface: value(words.offset.take()),
            finish: value(words.pitch.take()),
            finish_feed: value(words.finish_feed.take()),
        }
    }
}

impl Interpreter<'_> {
    /// Mills a pocket around the place where the tool is, from the reference plane; ends above its
    /// middle.
    pub(super) fn mill_pocket(&mut self, cycle: &Cycle, pocket: Pocket) -> Done {
        let span = cycle.span();
        let code = if pocket.circular { "G88" } else { "G87" };
        let row = self.tool.row();
        let Some((tool, diameter)) = self.control.tool_diameter(code, row, span)? else {
            return Ok(());
        };
        self.tell_diameter(code, tool, diameter, span);
        let [first, second, _] = self.control.modal.plane.axes();
        let places = [first, second].map(|axis| self.control.present(axis));
        let [Some(x), Some(y)] = places else {
            return Err(Diagnostic::unknown_place(
                span,
                "where this pocket lies is not known ahead of time",
            )
            .help("program its middle absolute in the block of the cycle"));
        };
        let Some(feed) = self.control.modal.feed else {
            return Err(Diagnostic::error(span, "a pocket, and no F is in force")
                .help("write F in its block"));
        };
        let factor = self.control.modal.length_factor;
        let milling = Milling {
            pocket,
            diameter,
            // The scale of the program makes the pocket larger, not the tool.
            radius: diameter / 2.0 / self.transforms.scale(),
            middle: [x * factor, y * factor],
            feed: feed / self.control.modal.feed_factor,
            span,
        };
        milling.check()?;
        let before = self.control.modal.motion;
        let done = self.mill_layers(&milling, cycle);
        self.control.modal.motion = before;
        done
    }

    /// Says with which tool `code` is milled.
    pub(super) fn tell_diameter(&mut self, code: &str, tool: u32, diameter: f64, span: Span) {
        self.control.diagnostics.push(
            Diagnostic::warning(
                span,
                format!(
                    "{code} is milled with the diameter {diameter} of T{tool} in the tool table"
                ),
            )
            .help("open the program again when the table has changed"),
        );
    }

    fn mill_layers(&mut self, milling: &Milling, cycle: &Cycle) -> Done {
        let pocket = milling.pocket;
        let (reference, bottom) = cycle.depths();
        let down = (bottom - reference).signum();
        let surface = reference + pocket.surface * down;
        let clearance = self.floor_clearance();
        for depth in parts((bottom - surface).abs(), pocket.layer) {
            if !self.control.count_block(milling.span) {
                return Ok(());
            }
            let floor = surface + depth * down;
            self.cycle_feed(
                pocket.plunge_feed.unwrap_or(milling.feed / 2.0),
                milling.span,
            )?;
            self.normal_way(floor, Motion::Line, milling.span)?;
            self.cycle_feed(milling.feed, milling.span)?;
            self.mill_rounds(milling)?;
            self.mill_wall(milling)?;
            let above = floor - clearance * down;
            self.normal_way(above, Motion::Rapid, milling.span)?;
            self.pocket_way([0.0; 2], Motion::Rapid, None, milling)?;
        }
        self.cycle_feed(milling.feed, milling.span)
    }

    /// From the middle outwards, up to what is left for the wall.
    fn mill_rounds(&mut self, milling: &Milling) -> Done {
        let [length, width] = milling.rough();
        let narrow = length.min(width);
        let rounds = parts(narrow, milling.step());
        // The first one of a rectangle is a slot along its longer side.
        let slot = (!milling.pocket.circular && length != width).then_some(0.0);
        for out in slot.into_iter().chain(rounds) {
            if !self.control.count_block(milling.span) {
                return Ok(());
            }
            self.mill_round([length - narrow + out, width - narrow + out], milling)?;
        }
        Ok(())
    }

    /// The last round, with a quarter of a circle to the wall and another away from it.
    fn mill_wall(&mut self, milling: &Milling) -> Done {
        let pocket = milling.pocket;
        if pocket.finish == 0.0 {
            return Ok(());
        }
        let feed = pocket.finish_feed.unwrap_or(milling.feed);
        self.cycle_feed(feed, milling.span)?;
        let [length, width] = milling.wall();
        let turn = pocket.finish.min(width / 2.0);
        let side = if pocket.clockwise { -1.0 } else { 1.0 };
        self.pocket_way([length - turn, -side * turn], Motion::Line, None, milling)?;
        self.pocket_way(
            [length, 0.0],
            milling.way_round(),
            Some([0.0, side * turn]),
            milling,
        )?;
        self.mill_round([length, width], milling)?;
        self.pocket_way(
            [length - turn, side * turn],
            milling.way_round(),
            Some([-turn, 0.0]),
            milling,
        )
    }

    /// Once round, from the middle of the side at the end of the first axis.
    fn mill_round(&mut self, [length, width]: [f64; 2], milling: &Milling) -> Done {
        self.pocket_way([length, 0.0], Motion::Line, None, milling)?;
        if milling.pocket.circular {
            let to_middle = Some([-length, 0.0]);
            return match length == 0.0 {
                true => Ok(()),
                false => self.pocket_way([length, 0.0], milling.way_round(), to_middle, milling),
            };
        }
        let side = if milling.pocket.clockwise {
            -width
        } else {
            width
        };
        for corner in [
            [length, side],
            [-length, side],
            [-length, -side],
            [length, -side],
            [length, 0.0],
        ] {
            self.pocket_way(corner, Motion::Line, None, milling)?;
        }
        Ok(())
    }

    /// To a place seen from the middle, machine units, unless the tool is there; `centre` of an arc: from
    /// its start.
    fn pocket_way(
        &mut self,
        place: [f64; 2],
        motion: Motion,
        centre: Option<[f64; 2]>,
        milling: &Milling,
    ) -> Done {
        let place = [0, 1].map(|at| milling.middle[at] + place[at]);
        self.plane_way(place, motion, centre, milling.span)
    }
}

impl Milling {
    /// Refuses a tool that does not fit.
    fn check(&self) -> Done {
        let [length, width] = self.rough();
        if length < 0.0 || width < 0.0 {
            return Err(Diagnostic::error(
                self.span,
                format!(
                    "a tool of the diameter {} does not fit into this pocket",
                    self.diameter
                ),
            )
            .help("check J, K and L, and the diameter in LinuxCNC's tool table"));
        }
        match self.pocket.step {
            Some(step) if step.abs() > 2.0 * self.radius => Err(Diagnostic::error(
                self.span,
                "the step C is wider than the tool",
            )
            .help("leave C out for 3/4 of the diameter")),
            _ => Ok(()),
        }
    }

    /// Half of length and width of the round along the wall.
    fn wall(&self) -> [f64; 2] {
        self.pocket.half.map(|half| half - self.radius)
    }

    /// The same of the last one before it.
    fn rough(&self) -> [f64; 2] {
        self.wall().map(|half| half - self.pocket.finish)
    }

    /// Between two rounds; below 0 as C is.
    fn step(&self) -> f64 {
        let usual = USUAL_STEP * 2.0 * self.radius;
        let step = self.pocket.step.unwrap_or(usual);
        let widest = match self.pocket.circular {
            true => 2.0 * self.radius,
            false => WIDEST_STEP * self.radius,
        };
        step.abs().min(widest).copysign(step)
    }

    fn way_round(&self) -> Motion {
        match self.pocket.clockwise {
            true => Motion::Clockwise,
            false => Motion::Counterclockwise,
        }
    }
}

/// The ends of the parts into which a length is cut: alike and at most `part` long, or, where it is
/// below 0, exactly so long and the last one shorter.
pub(super) fn parts(length: f64, part: f64) -> impl Iterator<Item = f64> {
    // A rest by rounding is none.
    let count = (length / part.abs() - 1e-9).ceil().max(0.0);
    let end = move |number: f64| match number >= count {
        true => length,
        false if part < 0.0 => -part * number,
        false => length * number / count,
    };
    (1..=count as u64).map(move |number| end(number as f64))
}

fn wrong(g: At<u32>, what: &str, help: &str) -> Diagnostic {
    Diagnostic::error(g.span, format!("G{} {what}", g.value)).help(help)
}

#[cfg(test)]
mod tests {
    use super::parts;

    #[test]
    fn parts_are_alike_or_as_long_as_they_are_told() {
        for (length, part, ends) in [
            (10.0, 3.0, &[2.5, 5.0, 7.5, 10.0][..]),
            (10.0, -3.0, &[3.0, 6.0, 9.0, 10.0]),
            (0.9, 0.3, &[0.3, 0.6, 0.9]),
            (2.0, -3.0, &[2.0]),
            (0.0, 3.0, &[]),
        ] {
            let found: Vec<f64> = parts(length, part).collect();
            assert_eq!(found.len(), ends.len(), "{length} {part}");
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-9;
            assert!(found.iter().zip(ends).all(near), "{length} {part}");
        }
    }
}
