//! Roughing (G67) and finishing (G68) of an irregular pocket.
//!
//! `G67 A B C I R K V Q F S T D M`: B the depth of a layer and C the step between two rounds, as in G87; I the bottom
//! and R the reference plane, absolute; V the feed into the depth, half of F if it is left out. A asks for parallel
//! cuts at an angle: rounds along the contours are milled as well then, with a warning, and the part is the same. Q, the
//! angle of plunging, is refused but for 90. `G68 B L Q I R K V F S T D M`: L is what roughing leaves at the
//! walls; without B the whole depth is one layer; Q1 goes round against the direction of the programmed outline, and
//! islands are followed in the other direction than the outline; I and R are those of G67 if they are left out. A
//! G67 without B and a G68 without L, which the control leaves out in silence, are refused, and so is J, which belongs to
//! 3D pockets. (Fagor, CNC 8055 Programming Manual, "Irregular pocket canned cycle", 2D pockets. But for B, C, I, R and V, which are those of other cycles, the words were not compared with its text.)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::irregular_pockets::{IrregularPocket, Operation, WordsBlock};
use super::pockets::parts;
use crate::diagnostics::Diagnostic;
use crate::dialects::clearing::rounds::{Tool, clear};
use crate::dialects::clearing::walls::{follow, not_reached};
use crate::dialects::clearing::{Cut, Trouble};
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::At;
use crate::source::Span;
use cavalier_contours::polyline::{PlineOrientation, PlineSource};

/// The default step between two rounds, over the diameter of the tool.
const USUAL_STEP: f64 = 0.75;

/// Roughing or finishing; lengths in machine units, feeds in those of the program.
pub struct Milling {
    operation: Operation,
    /// G67 or G68.
    g: At<u32>,
    /// B; none where all is one layer.
    layer: Option<f64>,
    /// C.
    step: Option<f64>,
    /// A.
    angle: Option<Span>,
    /// Q1 of G68.
    against: bool,
    /// L.
    pub allowance: f64,
    /// R and I.
    pub depths: [f64; 2],
    /// V.
    plunge_feed: Option<f64>,
    /// What is not of the pocket: T, D, S, F and M.
    rest: BlockWords,
}

/// Takes words from a block whose letters mean something else elsewhere.
struct Taken {
    g: At<u32>,
    words: BlockWords,
}

impl Taken {
    fn new(operation: &Operation, code: u32) -> Taken {
        let block = &operation.blocks[operation.main];
        let mut words = block.words.clone();
        let span = block.block.place.span;
        let found = words.g.iter().position(|g| g.value == code);
        let g = found.map(|at| words.g.remove(at));
        Taken {
            g: g.unwrap_or(At { value: code, span }),
            words,
        }
    }

    fn axis(&mut self, axis: usize) -> Option<At<f64>> {
        let word = self.words.axes[axis].take()?;
        word.value.map(|value| At {
            value,
            span: word.span,
        })
    }

    fn wrong(&self, what: &str, help: &str) -> Diagnostic {
        wrong(self.g, what, help)
    }

    /// R and I, or those of roughing.
    fn depths(&mut self, old: Option<[f64; 2]>, factor: f64) -> Result<[f64; 2], Diagnostic> {
        let given = [self.words.radius.take(), self.words.centre[0].take()];
        let mut depths = [0.0; 2];
        for (at, letter) in ["R, the reference plane", "I, the bottom"]
            .into_iter()
            .enumerate()
        {
            let value = given[at].map(|word| word.value * factor);
            depths[at] = value.or(old.map(|old| old[at])).ok_or_else(|| {
                self.wrong(
                    &format!("needs {letter}, absolute"),
                    "write G67 B5 C8 I-20 R2 and G68 B0 L0.5 I-20 R2",
                )
            })?;
        }
        Ok(depths)
    }

    /// K and V.
    fn common(&mut self) -> Result<Option<f64>, Diagnostic> {
        if let Some(kind) = self.words.centre[2].take()
            && ![0.0, 1.0].contains(&kind.value)
        {
            return Err(Diagnostic::error(kind.span, "K is 0 or 1")
                .help("leave K out: contours that cross are not supported"));
        }
        let plunge = self.axis(7);
        Ok(plunge.map(|word| word.value).filter(|value| *value > 0.0))
    }
}

impl Milling {
    /// The words of G67; lengths of the program times `factor` are machine units.
    pub fn rough(operation: Operation, factor: f64) -> Result<Milling, Diagnostic> {
        let mut taken = Taken::new(&operation, 67);
        let [angle, layer, step] = [3, 4, 5].map(|axis| taken.axis(axis));
        let depths = taken.depths(None, factor)?;
        let plunge_feed = taken.common()?;
        let Some(layer) = layer.filter(|layer| layer.value != 0.0) else {
            return Err(taken.wrong(
                "needs B, the depth of a layer, and not 0",
                "write G67 B5 C8 I-20 R2, or leave R out of G66 if there is nothing to rough",
            ));
        };
        if let Some(plunge) = taken.words.angle.take().filter(|angle| angle.value != 90.0) {
            return Err(
                Diagnostic::error(plunge.span, "plunging at an angle is not supported").help(
                    "leave Q out: the tool plunges straight; holes can be drilled with D of G66",
                ),
            );
        }
        if let Some(step) = step.filter(|step| step.value < 0.0) {
            return Err(Diagnostic::error(step.span, "the step C is below 0")
                .help("leave C out for 3/4 of the diameter"));
        }
        let step = step
            .map(|step| step.value * factor)
            .filter(|step| *step > 0.0);
        Ok(Milling {
            operation,
            g: taken.g,
            layer: Some(layer.value * factor),
            step,
            angle: angle.map(|angle| angle.span),
            against: false,
            allowance: 0.0,
            depths,
            plunge_feed,
            rest: taken.words,
        })
    }

    /// The words of G68; `depths` are those of roughing.
    pub fn finish(
        operation: Operation,
        depths: Option<[f64; 2]>,
        factor: f64,
    ) -> Result<Milling, Diagnostic> {
        let mut taken = Taken::new(&operation, 68);
        let layer = taken.axis(4).filter(|layer| layer.value != 0.0);
        let depths = taken.depths(depths, factor)?;
        let plunge_feed = taken.common()?;
        let allowance = taken
            .words
            .pitch
            .take()
            .map_or(0.0, |word| word.value.abs());
        if allowance == 0.0 {
            return Err(taken.wrong(
                "needs L, what is left for it at the walls",
                "write G68 B0 L0.5, or leave F out of G66 if nothing is to be finished",
            ));
        }
        if let Some(tip) = taken.words.centre[1] {
            return Err(Diagnostic::error(
                tip.span,
                "J belongs to 3D pockets, which are not supported",
            )
            .help("leave J out where the walls are upright"));
        }
        let direction = taken.words.angle.take();
        if let Some(direction) = direction.filter(|word| ![0.0, 1.0].contains(&word.value)) {
            return Err(Diagnostic::error(direction.span, "Q of G68 is 0 or 1")
                .help("Q0 goes round as the outline is programmed, Q1 against it"));
        }
        Ok(Milling {
            operation,
            g: taken.g,
            layer: layer.map(|layer| layer.value * factor),
            step: None,
            angle: None,
            against: direction.is_some_and(|word| word.value == 1.0),
            allowance: allowance * factor,
            depths,
            plunge_feed,
            rest: taken.words,
        })
    }

    /// Which way the bottom lies, if the planes lie in their order: 1 or -1.
    fn check_depths(&self, pocket: &IrregularPocket) -> Result<f64, Diagnostic> {
        let surface = pocket.contours.surface;
        let [reference, bottom] = self.depths;
        let down = (bottom - surface).signum();
        let ordered =
            (surface - reference) * down >= 0.0 && (reference - pocket.start) * down >= 0.0;
        match ordered && bottom != surface {
            true => Ok(down),
            false => Err(wrong(
                self.g,
                "needs the bottom I below the surface, the reference plane R above it, and the tool above R",
                "check I and R, the third axis of the first contour, and where the tool is before G66",
            )),
        }
    }

    fn code(&self) -> String {
        format!("G{}", self.g.value)
    }

    fn unfit(&self, trouble: Trouble, diameter: f64) -> Diagnostic {
        let (what, help) = match trouble {
            Trouble::Unfit => (
                format!("a tool of the diameter {diameter} does not fit into this pocket"),
                "check the contours, L, and the diameter in LinuxCNC's tool table",
            ),
            Trouble::Inexact => (
                "the way of the tool through this pocket cannot be worked out exactly".to_string(),
                "check the contours for pieces that are very short, or almost touch each other",
            ),
            Trouble::Endless => (
                "this pocket has too many rounds".to_string(),
                "check C; --most-blocks raises the limit",
            ),
        };
        Diagnostic::error(self.g.span, what).help(help)
    }
}

impl Interpreter<'_> {
    /// Diameter of the tool that the blocks of an operation name, and its number; see
    /// [`tool_diameter`](crate::dialects::control::Control::tool_diameter).
    fn named_diameter(&mut self, milling: &Milling) -> Result<Option<(u32, f64)>, Diagnostic> {
        let mut row = self.tool.row();
        let blocks = &milling.operation.blocks[..=milling.operation.main];
        for WordsBlock { words, .. } in blocks {
            if let Some(tool) = words.tool {
                row = tool.value.1.or(Some(tool.value.0 as u32));
            }
            row = words.offset.map(|offset| offset.value as u32).or(row);
        }
        self.control
            .tool_diameter(&milling.code(), row, milling.g.span)
    }

    /// The radius of the tool as the program is scaled, and the ways of roughing; `None` where the tool tables
    /// cannot be read, which has been said.
    pub(super) fn rough_cuts(
        &mut self,
        pocket: &IrregularPocket,
        rough: &Milling,
        allowance: f64,
    ) -> Result<Option<(f64, Vec<Cut>)>, Diagnostic> {
        let Some((_, diameter)) = self.named_diameter(rough)? else {
            return Ok(None);
        };
        // The scale of the program makes the pocket larger, not the tool.
        let radius = diameter / 2.0 / self.transforms.scale();
        let step = rough.step.unwrap_or(USUAL_STEP * 2.0 * radius);
        if step > 2.0 * radius {
            return Err(
                Diagnostic::error(rough.g.span, "the step C is wider than the tool")
                    .help("leave C out for 3/4 of the diameter"),
            );
        }
        if let Some(angle) = rough.angle {
            self.control.diagnostics.push(
                Diagnostic::warning(
                    angle,
                    "A asks for parallel cuts: rounds along the contours are milled instead, and the \
                     finished pocket is the same",
                )
                .help("leave A out if that is meant"),
            );
        }
        let tool = Tool {
            radius,
            allowance,
            step,
        };
        let span = rough.g.span;
        let region = &pocket.arranged.region;
        let cuts = clear(region, &tool, &mut || self.control.count_block(span));
        let cuts = cuts.map_err(|trouble| rough.unfit(trouble, diameter))?;
        if let Some(place) = pocket.not_reached(radius + allowance) {
            self.control.diagnostics.push(
                Diagnostic::warning(
                    place,
                    format!("roughing with the diameter {diameter} does not come to this wall: material is left"),
                )
                .help("rough with a smaller tool, or see what the finishing tool meets here"),
            );
        }
        Ok(Some((radius, cuts)))
    }

    /// Carries out G67.
    pub(super) fn mill_rough(
        &mut self,
        pocket: &IrregularPocket,
        rough: &Milling,
        radius: f64,
        cuts: &[Cut],
    ) -> Done {
        self.mill_operation(pocket, rough, |_, diameter| {
            match (diameter / 2.0 - radius).abs() < 1e-9 {
                true => Ok(cuts.to_vec()),
                false => Err(wrong(
                    rough.g,
                    "is to be milled with a tool that is not in the spindle",
                    "change to it beside G67: T3 D3 M6",
                )),
            }
        })
    }

    /// Carries out G68.
    pub(super) fn mill_finish(&mut self, pocket: &IrregularPocket, finish: &Milling) -> Done {
        self.mill_operation(pocket, finish, |interpreter, diameter| {
            let radius = diameter / 2.0;
            if let Some(place) = pocket.not_reached(radius) {
                return Err(Diagnostic::error(
                    place,
                    format!("the finishing tool of the diameter {diameter} does not come to this wall"),
                )
                .help("finish with a smaller tool, or write the contour that it can make"));
            }
            let outline = &pocket.contours.list[pocket.arranged.outline].line;
            let clockwise = (outline.orientation() == PlineOrientation::Clockwise) != finish.against;
            let starts = pocket.contours.list.iter().map(|one| one.line.at(0).pos());
            let starts: Vec<_> = starts.collect();
            let walls = follow(&pocket.arranged.region, radius, clockwise, &starts);
            let walls = walls.map_err(|trouble| finish.unfit(trouble, diameter))?;
            if walls.without_entry > 0 {
                interpreter.control.diagnostics.push(
                    Diagnostic::warning(
                        finish.g.span,
                        "there is no room to come to each wall on an arc: the tool plunges at the wall",
                    )
                    .help("finish with a smaller tool if that leaves a mark"),
                );
            }
            Ok(walls.cuts)
        })
    }

    /// The blocks of an operation, in which the one with its G function mills the cuts for a tool of a diameter, as the
    /// program is scaled.
    fn mill_operation(
        &mut self,
        pocket: &IrregularPocket,
        milling: &Milling,
        mut cuts: impl FnMut(&mut Self, f64) -> Result<Vec<Cut>, Diagnostic>,
    ) -> Done {
        for (index, WordsBlock { block, words }) in milling.operation.blocks.iter().enumerate() {
            let span = block.place.span;
            if index != milling.operation.main {
                self.run_tool_words(words, span)?;
                self.control.finish_block(&block.place);
                continue;
            }
            self.run_tool_words(&milling.rest, span)?;
            let code = milling.code();
            let row = self.tool.row();
            let Some((tool, diameter)) = self.control.tool_diameter(&code, row, milling.g.span)?
            else {
                return Ok(());
            };
            self.tell_diameter(&code, tool, diameter, milling.g.span);
            let cuts = cuts(self, diameter / self.transforms.scale())?;
            self.control.turn_spindle();
            self.normal_way(pocket.start, Motion::Rapid, milling.g.span)?;
            self.mill_cuts(pocket, milling, &cuts)?;
            self.control.finish_block(&block.place);
        }
        Ok(())
    }

    /// All layers of all cuts, from the starting plane and back to it.
    fn mill_cuts(&mut self, pocket: &IrregularPocket, milling: &Milling, cuts: &[Cut]) -> Done {
        let span = milling.g.span;
        let down = milling.check_depths(pocket)?;
        let surface = pocket.contours.surface;
        let [reference, bottom] = milling.depths;
        let depth = (bottom - surface).abs();
        let Some(feed) = self.control.modal.feed else {
            return Err(Diagnostic::error(span, "a pocket, and no F is in force")
                .help("write F in its block"));
        };
        let feed = feed / self.control.modal.feed_factor;
        let plunge = milling.plunge_feed.unwrap_or(feed / 2.0);
        let clearance = self.floor_clearance();
        let mut near = reference;
        for layer in parts(depth, milling.layer.unwrap_or(depth)) {
            let floor = surface + layer * down;
            for cut in cuts {
                if !self.control.count_block(span) {
                    return Ok(());
                }
                self.plane_way(cut.start, Motion::Rapid, None, span)?;
                self.normal_way(near, Motion::Rapid, span)?;
                self.cycle_feed(plunge, span)?;
                self.normal_way(floor, Motion::Line, span)?;
                self.cycle_feed(feed, span)?;
                self.mill_cut(cut, span)?;
                self.normal_way(reference, Motion::Rapid, span)?;
            }
            // What is cut is passed in rapid motion, but not what lies above the reference plane.
            let above = floor - clearance * down;
            near = match (above - reference) * down > 0.0 {
                true => above,
                false => reference,
            };
        }
        self.normal_way(pocket.start, Motion::Rapid, span)
    }

    fn mill_cut(&mut self, cut: &Cut, span: Span) -> Done {
        for step in &cut.steps {
            let (motion, centre) = match step.arc {
                None => (Motion::Line, None),
                Some((centre, true)) => (Motion::Clockwise, Some(centre)),
                Some((centre, false)) => (Motion::Counterclockwise, Some(centre)),
            };
            self.plane_way(step.to, motion, centre, span)?;
        }
        Ok(())
    }
}

impl IrregularPocket {
    /// The block of the first piece of a wall to which a tool does not come that goes round so deep in the pocket.
    fn not_reached(&self, depth: f64) -> Option<Span> {
        let shown = |index: &usize| !self.arranged.hidden.contains(index);
        let contours = (0..self.contours.list.len()).filter(shown);
        let pieces = contours.flat_map(|index| {
            let contour = &self.contours.list[index];
            contour
                .line
                .iter_segments()
                .zip(contour.spans.iter().copied())
        });
        let (pieces, spans): (Vec<_>, Vec<_>) = pieces.unzip();
        not_reached(&self.arranged.region, depth, &pieces).map(|index| spans[index])
    }
}

fn wrong(g: At<u32>, what: &str, help: &str) -> Diagnostic {
    Diagnostic::error(g.span, format!("G{} {what}", g.value)).help(help)
}
