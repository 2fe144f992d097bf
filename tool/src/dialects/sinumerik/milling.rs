//! Milling cycles, written out as moves: POCKET3 (a rectangular pocket), POCKET4 (a circular one), SLOT1
//! (slots on a circle), LONGHOLE (slots as wide as the tool). (Siemens, SINUMERIK 840D, Programming Guide
//! Cycles, "Milling cycles"; SINUMERIK 840D sl, Programming Manual Job Planning, "External programming of
//! cycles".)
//!
//! The cutter's diameter is that in LinuxCNC's tool table. A pocket is cleared layer by layer from its middle
//! outwards.

use super::arc_words::absolute;
use super::cycle_parameters::Cycle;
use super::interpreter::Interpreter;
use super::outline::{Outline, Piece};
use super::syntax::Call;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, MotionWords};
use crate::program::Spindle;
use crate::source::Span;
use framepath::frame::angle::sin_cos_degrees;

/// How wide a step is at most where the cycle does not say it, over the diameter of the tool.
const USUAL_STEP: f64 = 0.8;

/// How many layers a cycle may have.
const LAYER_LIMIT: f64 = 10_000.0;

/// A cycle at its place; lengths in units of the program.
pub(super) struct Milling<'a> {
    pub cycle: &'a Cycle<'a>,
    /// The middle, along the first and the second axis of the plane.
    pub middle: [f64; 2],
    /// How far its length is turned from the first axis, degrees.
    pub turned: f64,
    /// How it goes round.
    pub clockwise: bool,
    /// The radius of the tool.
    pub radius: f64,
    pub levels: Levels,
    pub feeds: Feeds,
}

/// Along the normal of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    pub retraction: f64,
    pub reference: f64,
    pub safe: f64,
    pub bottom: f64,
    /// The deepest step; 0 for all at once.
    pub step: f64,
}

impl Levels {
    /// The floors of the layers down to `bottom`, all of one thickness.
    pub fn floors(&self, bottom: f64) -> Vec<f64> {
        let depth = self.reference - bottom;
        let count = match self.step > 0.0 {
            true => (depth / self.step - 1e-9).ceil().max(1.0),
            false => 1.0,
        };
        let floor = |number: u32| match f64::from(number) == count {
            true => bottom,
            false => self.reference - depth * f64::from(number) / count,
        };
        (1..=count as u32).map(floor).collect()
    }
}

/// Units of the program; `None` for that in force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Feeds {
    pub surface: Option<At<f64>>,
    pub depth: Option<At<f64>>,
}

impl Interpreter<'_> {
    /// A milling cycle.
    pub(super) fn mill(&mut self, call: &Call) -> Done {
        self.control
            .refuse_compensation(call.span, "a milling cycle")?;
        let Some(cycle) = self.cycle(call)? else {
            return Ok(());
        };
        let Some(radius) = self.cutter_radius(&cycle)? else {
            return Ok(());
        };
        let feed = self.control.modal.feed;
        let motion = self.control.modal.motion;
        let done = match cycle.name {
            "POCKET3" | "POCKET4" => self.pocket(&cycle, radius),
            "SLOT1" => self.slots(&cycle, radius),
            _ => self.long_holes(&cycle, radius),
        };
        self.control.modal.motion = motion;
        self.restore_feed(feed);
        done
    }

    /// The radius of the tool in units of the program; `None` where the tool table cannot be read, which
    /// has been reported.
    pub(super) fn cutter_radius(&mut self, cycle: &Cycle) -> Result<Option<f64>, Diagnostic> {
        let row = self.radius_row(cycle.span)?;
        let found = self.control.tool_diameter(cycle.name, row, cycle.span)?;
        let Some((tool, diameter)) = found else {
            return Ok(None);
        };
        let message = format!(
            "{} is milled with the diameter {diameter} of T{tool} in the tool table",
            cycle.name
        );
        self.control.diagnostics.push(
            Diagnostic::warning(cycle.span, message)
                .help("open the program again when the table has changed"),
        );
        Ok(Some(diameter / 2.0 / self.control.modal.length_factor))
    }

    /// The row of the tool table with the edge in force, if that is not the tool's own.
    fn radius_row(&self, span: Span) -> Result<Option<u32>, Diagnostic> {
        match self.edge {
            Some(edge) if edge >= 2.0 => self.edge_row(edge as u32, span).map(Some),
            _ => Ok(None),
        }
    }

    /// The radius of the tool, machine units; 0 where the tool table cannot be read, which has been
    /// reported.
    pub(super) fn tool_radius(&mut self, what: &str, span: Span) -> Result<f64, Diagnostic> {
        let row = self.radius_row(span)?;
        let found = self.control.tool_diameter(what, row, span)?;
        Ok(found.map_or(0.0, |(_, diameter)| diameter / 2.0))
    }

    /// RTP, RFP, SDIS, DP and the infeed, whose names begin with `prefix`.
    pub(super) fn levels(
        &self,
        cycle: &Cycle,
        prefix: &str,
        bottom: f64,
    ) -> Result<Levels, Diagnostic> {
        let value = |name: &str| cycle.or_zero(&format!("{prefix}{name}"));
        let reference = value("RFP")?;
        let retraction = cycle.needed(&format!("{prefix}RTP"), "the retraction plane")?;
        let (clearance, step) = (value("SDIS")?, value("MID")?);
        let safe = reference + clearance;
        if clearance < 0.0 || bottom >= reference || retraction < safe || step < 0.0 {
            return Err(Diagnostic::error(
                cycle.span,
                "the planes of this cycle are not in the order RTP, RFP + SDIS, RFP, DP from above",
            )
            .help("check the retraction plane, the reference plane, the depth and the infeed"));
        }
        if step > 0.0 && (reference - bottom) / step > LAYER_LIMIT {
            let name = format!("{prefix}MID");
            return Err(cycle.unsupported(&name, "this would take too many layers"));
        }
        Ok(Levels {
            retraction,
            reference,
            safe,
            bottom,
            step,
        })
    }

    pub(super) fn feeds(
        &self,
        cycle: &Cycle,
        surface: &str,
        depth: &str,
    ) -> Result<Feeds, Diagnostic> {
        let feed = |name: &str| {
            let span = cycle.span_of(name);
            cycle
                .nonzero(name)
                .map(|feed| feed.map(|value| At { value, span }))
        };
        let surface = feed(surface)?;
        Ok(Feeds {
            surface,
            depth: feed(depth)?.or(surface),
        })
    }

    /// CDIR: 0 climbs, 1 does not, 2 is clockwise and 3 counterclockwise. A tool that turns clockwise climbs
    /// with the material on its right.
    pub(super) fn goes_clockwise(&self, cycle: &Cycle, name: &str) -> Result<bool, Diagnostic> {
        let turns_back = self.control.modal.spindle == Some(Spindle::Counterclockwise);
        match cycle.or_zero(name)? {
            0.0 => Ok(turns_back),
            1.0 => Ok(!turns_back),
            2.0 => Ok(true),
            3.0 => Ok(false),
            _ => Err(cycle.unsupported(
                name,
                "0 climbs, 1 is up-cut, 2 is clockwise, 3 counterclockwise",
            )),
        }
    }

    /// To the place above its middle.
    pub(super) fn approach(&mut self, milling: &Milling, place: [f64; 2]) -> Done {
        let span = milling.cycle.span;
        let Levels {
            retraction, safe, ..
        } = milling.levels;
        let [first, second, normal] = self.control.modal.plane.axes();
        let target = milling.place(place);
        let is_above = self
            .control
            .present(normal)
            .is_some_and(|height| height > retraction);
        if !is_above {
            self.plunge(retraction, true, span)?;
        }
        self.rapid_to(&[first, second], &target, span)?;
        self.plunge(retraction, true, span)?;
        self.plunge(safe, true, span)
    }

    /// Down with the feed of the depth; with that of the surface it goes on.
    pub(super) fn infeed(&mut self, milling: &Milling, floor: f64, rapid: bool) -> Done {
        if !rapid {
            self.mill_feed(milling.feeds.depth)?;
        }
        self.plunge(floor, rapid, milling.cycle.span)?;
        self.mill_feed(milling.feeds.surface)
    }

    pub(super) fn mill_feed(&mut self, feed: Option<At<f64>>) -> Done {
        let Some(feed) = feed else {
            return Ok(());
        };
        match self.control.modal.feed == Some(feed.value * self.control.modal.feed_factor) {
            true => Ok(()),
            false => self.control.feed(feed),
        }
    }

    /// To a place seen from the middle, with the feed.
    pub(super) fn mill_to(&mut self, milling: &Milling, end: [f64; 2]) -> Done {
        self.mill_piece(milling, &Piece { end, centre: None }, false)
    }

    /// Once round an outline, from and to the middle of its side.
    pub(super) fn mill_round(&mut self, milling: &Milling, outline: &Outline) -> Done {
        self.mill_to(milling, [outline.half[0], 0.0])?;
        for piece in outline.way_round(milling.clockwise) {
            self.mill_piece(milling, &piece, milling.clockwise)?;
        }
        Ok(())
    }

    /// A line, or an arc in a direction.
    pub(super) fn mill_piece(&mut self, milling: &Milling, piece: &Piece, clockwise: bool) -> Done {
        let span = milling.cycle.span;
        let axes = self.control.modal.plane.axes();
        let end = milling.place(piece.end);
        let mut words = MotionWords::default();
        let mut stays = piece.centre.is_none();
        for at in [0, 1] {
            stays &= self.control.present(axes[at]) == Some(end[at]);
            words.axes[axes[at]] = Some(absolute(end[at], span));
        }
        if stays {
            return Ok(());
        }
        if let Some(centre) = piece.centre {
            let centre = milling.place(centre);
            for at in [0, 1] {
                words.centre[axes[at]] = Some(absolute(centre[at], span));
            }
        }
        self.control.modal.motion = Some(match (piece.centre, clockwise) {
            (None, _) => Motion::Line,
            (Some(_), true) => Motion::Clockwise,
            (Some(_), false) => Motion::Counterclockwise,
        });
        self.control.motion(&words, span, false, false)
    }
}

impl Milling<'_> {
    /// Where a place seen from the middle lies along the axes of the plane.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = sin_cos_degrees(self.turned);
        [
            self.middle[0] + x * cos - y * sin,
            self.middle[1] + x * sin + y * cos,
        ]
    }

    /// How far apart two ways lie at most: the step of the cycle, or so much of the tool.
    pub fn width_of_step(&self, given: Option<f64>) -> f64 {
        given.unwrap_or(USUAL_STEP * 2.0 * self.radius)
    }

    /// The way of the tool along an outline of the part, with an allowance.
    ///
    /// # Errors
    ///
    /// The tool does not fit into it.
    pub fn way_in(&self, part: &Outline, allowance: f64) -> Result<Outline, Diagnostic> {
        let inset = self.radius + allowance;
        if part.half.iter().any(|half| *half < inset - 1e-9) {
            return Err(Diagnostic::error(
                self.cycle.span,
                format!(
                    "a tool of the diameter {} does not fit here",
                    2.0 * self.radius
                ),
            )
            .help(
                "check length, width and allowance of the cycle, and D of the tool in LinuxCNC's \
                     tool table",
            ));
        }
        Ok(part.inside(inset))
    }
}
