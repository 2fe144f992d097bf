//! The contours of an irregular pocket: the blocks from the label S to the label E of G66.
//!
//! Each contour begins with a block of G0, of which the first has the surface of the part as the coordinate of
//! the tool axis, and ends where it began. Between them G1, G2, G3, G6, G8, G9, the roundings G36 and chamfers G39,
//! polar coordinates and G93, G70, G71, G90 and G91 may stand, and no T, F, M, loop or call. (Fagor, CNC 8055
//! Programming Manual, "Irregular pocket canned cycle", 2D pockets.)

use super::block_words::BlockWords;
use super::interpreter::Interpreter;
use super::irregular_pockets::WordsBlock;
use crate::diagnostics::Diagnostic;
use crate::dialects::clearing::arrange::Fault;
use crate::dialects::control::Done;
use crate::program::arc::sweep;
use crate::program::corners::Corners;
use crate::program::moves::{Arc, Centre, Coordinate, Move, MoveKind};
use crate::program::{Action, Block, Origin};
use crate::source::Span;
use cavalier_contours::core::math::Vector2;
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use std::f64::consts::PI;

/// How far the end of a contour may lie from its beginning, machine units.
const CLOSED: f64 = 1e-3;

/// Motions below this are none, machine units.
const LEAST_MOTION: f64 = 1e-7;

/// The G functions that may stand in a contour.
const ALLOWED: [u32; 13] = [0, 1, 2, 3, 6, 8, 9, 36, 39, 70, 71, 90, 91];

/// A closed contour, machine units.
pub struct Contour {
    /// The block with which it begins.
    pub span: Span,
    /// Its pieces.
    pub line: Polyline,
    /// Of each piece the block.
    pub spans: Vec<Span>,
}

/// What the blocks of the contours say.
pub struct Contours {
    /// The contours, in their order.
    pub list: Vec<Contour>,
    /// The surface of the part along the axis of the tool, machine units.
    pub surface: f64,
}

impl Contours {
    /// The error for a fault that was found in the contours.
    pub fn error(&self, fault: Fault) -> Diagnostic {
        let span = |index: usize| self.list[index].span;
        match fault {
            Fault::Flat(at) => Diagnostic::error(span(at), "this contour encloses nothing")
                .help("a contour goes once round the pocket or an island"),
            Fault::Tangled(at) => {
                Diagnostic::error(span(at), "this contour crosses or touches itself")
                    .help("write one that goes once round without meeting itself")
            }
            Fault::Outside(_, at) => {
                Diagnostic::error(span(at), "this contour lies outside of the largest one")
                    .help("the largest contour is the pocket: the others are islands inside of it")
            }
            Fault::Crossing(_, at) => {
                Diagnostic::error(span(at), "this contour crosses or touches another one").help(
                    "unions and differences of contours (K) are not supported: write the outline \
                     of what they make as one contour",
                )
            }
        }
    }
}

/// Contours while their blocks run.
#[derive(Default)]
struct Reading {
    list: Vec<Contour>,
    surface: Option<f64>,
    /// The blocks of the contour that has begun.
    open: Option<(Span, Vector2, Vec<Block>)>,
}

impl Interpreter<'_> {
    /// Runs the blocks of contours; the tool stays where it is, and no mode changes.
    pub(super) fn read_contours(&mut self, blocks: &[WordsBlock]) -> Result<Contours, Diagnostic> {
        let (modal, polar) = (self.control.modal.clone(), self.polar);
        // No F is needed to describe a contour.
        self.control.modal.has_feed = true;
        let read = self.run_contours(blocks);
        (self.control.modal, self.polar) = (modal, polar);
        self.control.actions.clear();
        self.control.states.clear();
        read
    }

    fn run_contours(&mut self, blocks: &[WordsBlock]) -> Result<Contours, Diagnostic> {
        let mut reading = Reading::default();
        for WordsBlock { block, words } in blocks {
            let span = block.place.span;
            check_words(words, span)?;
            self.run_words(words, span)?;
            let actions = std::mem::take(&mut self.control.actions);
            let moves = actions.iter().find_map(|action| match action {
                Action::Move(path) => Some(path),
                _ => None,
            });
            match moves {
                Some(path) if path.kind == MoveKind::Rapid => {
                    self.begin(&mut reading, path, span)?
                }
                Some(path) => {
                    let Some((_, _, blocks)) = &mut reading.open else {
                        return Err(no_beginning(span));
                    };
                    self.check_flat(path, span)?;
                    blocks.push(Block {
                        origin: Origin {
                            file: span.file,
                            line: self.control.sources.line(span),
                            number: block.place.number,
                            span,
                        },
                        actions,
                        comment: None,
                        frame_text: None,
                    });
                }
                None => {}
            }
        }
        self.close(&mut reading)?;
        let surface = reading.surface;
        let span = blocks.first().map(|first| first.block.place.span);
        match (surface, span) {
            (Some(surface), _) => Ok(Contours {
                list: reading.list,
                surface,
            }),
            (None, span) => Err(no_beginning(span.unwrap_or(Span::start_of(0)))),
        }
    }

    /// G0: the contour before ends, and the next one begins.
    fn begin(&mut self, reading: &mut Reading, path: &Move, span: Span) -> Done {
        self.close(reading)?;
        let [first, second, normal] = self.control.modal.plane.axes();
        let stays = |axis: usize| path.target[axis] == Coordinate::Keep;
        let place = [first, second].map(|axis| path.end(axis));
        let ([Some(x), Some(y)], true) = (place, (3..9).all(stays)) else {
            return Err(
                Diagnostic::error(span, "where this contour begins is not known")
                    .help("write both axes of the plane, absolute: G0 G90 X10 Y10 Z0"),
            );
        };
        match (path.end(normal).filter(|_| !stays(normal)), reading.surface) {
            (Some(surface), None) => reading.surface = Some(surface),
            (Some(other), Some(surface)) if other != surface => {
                return Err(Diagnostic::error(
                    span,
                    "this contour begins at another height than the first one",
                )
                .help("the first contour gives the surface of the part for all"));
            }
            (None, None) => {
                return Err(Diagnostic::error(
                    span,
                    "the first contour does not say where the surface of the part is",
                )
                .help("write it as the axis of the tool beside G0: G0 G90 X10 Y10 Z0"));
            }
            _ => {}
        }
        reading.open = Some((span, Vector2::new(x, y), Vec::new()));
        Ok(())
    }

    /// The contour that has begun is complete.
    fn close(&mut self, reading: &mut Reading) -> Done {
        let Some((span, start, mut blocks)) = reading.open.take() else {
            return Ok(());
        };
        let mut corners = Corners::default();
        if let Some(first) = blocks.first_mut() {
            let plane = Action::Plane(self.control.modal.plane);
            first.actions.insert(0, plane);
        }
        blocks.into_iter().for_each(|block| corners.push(block));
        let blocks = corners.take_rest(self.control.diagnostics);
        let mut contour = Contour {
            span,
            line: Polyline::new_closed(),
            spans: Vec::new(),
        };
        let [first, second, _] = self.control.modal.plane.axes();
        let mut place = start;
        for block in &blocks {
            let span = block.origin.span;
            for action in &block.actions {
                let Action::Move(path) = action else {
                    continue;
                };
                let end = [first, second].map(|axis| path.end(axis));
                let [Some(x), Some(y)] = end else {
                    return Err(unknown(span));
                };
                let end = Vector2::new(x, y);
                contour.go(place, end, &path.kind, span)?;
                place = end;
            }
        }
        contour.check_closed(start, place)?;
        reading.list.push(contour);
        Ok(())
    }

    /// A contour lies in the plane.
    fn check_flat(&self, path: &Move, span: Span) -> Done {
        let [first, second, _] = self.control.modal.plane.axes();
        let mut others = (0..9).filter(|axis| ![first, second].contains(axis));
        if others.all(|axis| path.target[axis] == Coordinate::Keep) {
            return Ok(());
        }
        Err(
            Diagnostic::error(span, "this motion leaves the plane of the contour").help(
                "a contour has the two axes of the plane; only its first block has the third one",
            ),
        )
    }
}

impl Contour {
    /// On to a place; arcs in pieces below half a circle.
    fn go(&mut self, from: Vector2, to: Vector2, kind: &MoveKind, span: Span) -> Done {
        match kind {
            MoveKind::Line => {
                if (to - from).length() > LEAST_MOTION {
                    self.add(from, 0.0, span);
                }
                Ok(())
            }
            MoveKind::Arc(Arc {
                clockwise,
                centre: Centre::Offset(offset),
                extra_turns: 0,
            }) => {
                let centre = from + Vector2::new(offset[0], offset[1]);
                let seen = [from, to].map(|place| [place.x - centre.x, place.y - centre.y]);
                let turn = sweep(seen[0], seen[1], *clockwise, 0);
                let count = (turn / (0.75 * PI)).ceil().max(1.0);
                let part = match clockwise {
                    true => -turn / count,
                    false => turn / count,
                };
                for number in 0..count as u32 {
                    let begin = from.rotate_about(centre, part * f64::from(number));
                    self.add(begin, (part / 4.0).tan(), span);
                }
                Ok(())
            }
            _ => Err(unknown(span)),
        }
    }

    fn add(&mut self, place: Vector2, bulge: f64, span: Span) {
        self.line.add(place.x, place.y, bulge);
        self.spans.push(span);
    }

    fn check_closed(&self, start: Vector2, end: Vector2) -> Done {
        let Some(last) = self.spans.last() else {
            return Err(
                Diagnostic::error(self.span, "no contour follows on this G0")
                    .help("G0 begins a contour: write G1, G2 or G3 into the block behind it"),
            );
        };
        if (end - start).length() <= CLOSED && self.line.vertex_count() > 1 {
            return Ok(());
        }
        Err(Diagnostic::error(
            *last,
            format!(
                "the contour ends at {:.4} {:.4} and began at {:.4} {:.4}",
                end.x, end.y, start.x, start.y
            ),
        )
        .help("let its last block lead back to where its G0 went"))
    }
}

/// Refuses what does not belong to a contour.
fn check_words(words: &BlockWords, span: Span) -> Done {
    let strange = words
        .g
        .iter()
        .find(|g| !ALLOWED.contains(&g.value) && g.value != 93);
    if let Some(g) = strange {
        return Err(
            Diagnostic::error(g.span, format!("G{} in a contour of a pocket", g.value)).help(
                "contours are made of G0 to G3, G6, G8, G9, G36, G39, G70, G71, G90, G91 and G93",
            ),
        );
    }
    let mut rest = words.clone();
    rest.g.clear();
    rest.axes = [None; 9];
    rest.centre = [None; 3];
    (rest.radius, rest.corner_radius, rest.angle) = (None, None, None);
    if rest == BlockWords::default() {
        return Ok(());
    }
    Err(
        Diagnostic::error(span, "more than a motion in a contour of a pocket").help(
            "put F, S, T, D and M into the blocks of G67 and G68, and leave N at the end out",
        ),
    )
}

fn no_beginning(span: Span) -> Diagnostic {
    Diagnostic::error(span, "no contour has begun here")
        .help("begin each contour with G0, the first one with the surface: G0 G90 X10 Y10 Z0")
}

fn unknown(span: Span) -> Diagnostic {
    Diagnostic::error(span, "where this part of the contour goes is not known")
        .help("program the contour in absolute coordinates, with lines and arcs of the plane")
}
