//! Motions in coordinates of the machine (G28, G30, G53), and shifts of the zero (G52, G92).

use super::block_words::{BlockWords, g_name};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, Dimension};
use crate::source::Span;

impl Interpreter<'_> {
    /// `G28 X0 Y0 Z0`: over that place to the reference position, which is 0 in machine coordinates.
    pub(super) fn home(&mut self, words: &mut BlockWords, g: At<u32>) -> Done {
        let At { value: code, span } = g;
        if code == 300 {
            return Err(Diagnostic::error(
                span,
                "where the second reference position (G30) is, is set at the machine",
            )
            .help("write its coordinates: G53 X-100. Y0 Z0"));
        }
        if words.first_axis().is_none() {
            return Err(Diagnostic::error(span, "G28 needs axes").help("write G91 G28 Z0"));
        }
        self.control.note_once(
            "G28",
            "G28 moves to 0 in coordinates of the machine, which must be the reference position",
            span,
        );
        self.control.refuse_compensation(span, "G28")?;
        if self.polar.is_some() && (words.axes[0].is_some() || words.axes[1].is_some()) {
            return Err(Diagnostic::error(span, "G28 with X or Y in G16").help("write G15 before"));
        }
        let mut motion = self.motion_words(words);
        let stays = self.control.modal.incremental
            && motion.axes.iter().flatten().all(|word| word.value.0 == 0.0);
        if !stays && self.control.modal.incremental {
            self.refuse_skipped(&motion, span)?;
        }
        self.leave_skipped(&motion);
        let before = self.control.modal.motion.replace(Motion::Rapid);
        let over = match stays {
            true => Ok(()),
            false => self.control.motion(&motion, span, false, false),
        };
        for word in motion.axes.iter_mut().flatten() {
            word.value = (0.0, Dimension::Absolute);
        }
        let done = over.and_then(|()| self.control.machine_move(&motion, span, false, false));
        self.control.modal.motion = before;
        done
    }

    /// G53: in its block only, rapid whatever motion is in force, without tool length.
    pub(super) fn machine_coordinates(&mut self, words: &mut BlockWords, span: Span) -> Done {
        if words.first_axis().is_none() {
            return Err(Diagnostic::error(span, "G53 needs axes in its block")
                .help("it moves in coordinates of the machine; G54 to G59 choose a work offset"));
        }
        if let Some(g) = words.g.iter().find(|g| matches!(g.value, 10 | 20 | 30)) {
            return Err(Diagnostic::error(
                g.span,
                format!("G53 moves rapidly, {} does not", g_name(g.value)),
            )
            .help("write G0 G53 Z0"));
        }
        let motion = self.motion_words(words);
        self.leave_skipped(&motion);
        let before = self.control.modal.motion.replace(Motion::Rapid);
        let done = self.control.machine_move(&motion, span, false, false);
        self.control.modal.motion = before;
        done
    }

    /// G52 and G92.
    pub(super) fn shift(&mut self, words: &mut BlockWords, g: At<u32>, _block: Span) -> Done {
        let At { value: code, span } = g;
        let name = g_name(code);
        if !self.transforms.is_empty() {
            return Err(Diagnostic::error(
                span,
                format!("{name} while G51, G51.1, G68 or G68.2 is in force"),
            )
            .help("end them with G69, G50 and G50.1 before"));
        }
        let motion = self.motion_words(words);
        if code == 520 {
            return self.control.local_offset(&motion, span);
        }
        // G92 S has been the limit of the spindle speed.
        if !motion.is_motion() && self.speed_limit.is_some() {
            return Ok(());
        }
        self.refuse_skipped(&motion, span)?;
        self.control.preset(&motion, span)
    }
}
