//! Threads (G33): motions in step with the spindle, until one of G0 to G3. (Fagor, CNC 8055 Programming
//! Manual, "Electronic threading".)

use super::block_words::BlockWords;
use super::g_functions::OneShot;
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::source::Span;

impl Interpreter<'_> {
    /// Whether the block is a thread, by its own G33 or by one before.
    pub(super) fn is_thread(&self, words: &BlockWords, once: &OneShot) -> bool {
        let moves = once.arc_form.is_none() && words.names_a_place();
        once.thread.is_some() || self.thread.is_some() && (moves || once.cycle.is_some())
    }

    /// `G33 Z-20 L1.5`: a thread along one axis. Without L the pitch is that of the thread before.
    pub(super) fn thread(&mut self, words: &BlockWords, once: &OneShot, block: Span) -> Done {
        let span = once.thread.unwrap_or(block);
        if once.cycle.is_some() || self.cycle.is_some() {
            return Err(
                Diagnostic::error(span, "G33 is in force, and a canned cycle")
                    .help("end the cycle with G80 before G33, and G33 with G0 before a cycle"),
            );
        }
        let factor = self.control.modal.length_factor;
        let mut rest = words.clone();
        let own = rest.pitch.take().map(|pitch| pitch.value);
        let pitch = own.or(self.thread.map(|pitch| pitch / factor));
        let other = once.of_path().map(|g| g.span).or(rest.beside_axes());
        let motion = self.motion_words(words, &OneShot::default())?;
        let named: Vec<usize> = (0..9).filter(|axis| motion.axes[*axis].is_some()).collect();
        match (named[..].first(), named.len(), pitch, other) {
            (Some(&axis @ 0..3), 1, Some(pitch), None) => {
                self.thread = Some(pitch * factor);
                self.control.thread(&motion, pitch, axis, span)
            }
            _ => Err(Diagnostic::error(
                other.unwrap_or(span),
                "a thread needs one of X, Y and Z and its pitch L",
            )
            .help(
                "write G33 Z-20 L1.5 and nothing else; an angle of entry (Q) and slopes are not supported",
            )),
        }
    }
}
