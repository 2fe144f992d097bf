//! Canned cycles: which are in force, with which data, and where they run.
//!
//! Z, R, Q and P hold until G80 or G0 to G3. In G91 R counts from the initial level, where the axis of the
//! tool was when the first cycle began, and Z from R. (Fanuc, Series 30i, User's Manual, "Canned cycle
//! for drilling".)

use super::block_words::{BlockWords, g_name};
use super::interpreter::Interpreter;
use crate::diagnostics::Diagnostic;
use crate::dialects::control::Done;
use crate::dialects::control::modal::Motion;
use crate::dialects::control::words::{At, MotionWords};
use crate::source::Span;

/// How often a block can be repeated.
const REPEAT_LIMIT: f64 = 9999.0;

/// Whether a G number, times ten, is that of a canned cycle.
pub fn is_cycle(code: u32) -> bool {
    matches!(
        code,
        730 | 740 | 760 | 810 | 820 | 830 | 840 | 842 | 843 | 850 | 860 | 890
    )
}

/// A level as it was written, units of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    value: f64,
    incremental: bool,
}

/// A cycle that is in force.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// The G function, times ten.
    pub code: u32,
    /// Where the tool was when the first cycle began, units of the program; `None` where that is not known ahead of
    /// time.
    initial: Option<f64>,
    return_level: Option<Level>,
    bottom: Option<Level>,
    /// Q, units of the program.
    pub step: Option<At<f64>>,
    /// P, seconds.
    pub dwell: f64,
    /// Where P stands.
    pub dwell_at: Option<Span>,
    /// Whether P was given for this cycle, and not for one before it.
    pub own_dwell: bool,
    /// I and J of G76, units of the program.
    pub shift: [f64; 2],
    /// The G function.
    pub span: Span,
}

/// A hole, units of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// The return level R.
    pub top: f64,
    /// The bottom.
    pub bottom: f64,
}

impl Cycle {
    /// The initial level, units of the program: G98 returns to it, and R of G91 counts from it.
    ///
    /// # Errors
    ///
    /// Where it is not known ahead of time.
    pub fn initial(&self) -> Result<f64, Diagnostic> {
        self.initial.ok_or_else(|| {
            Diagnostic::unknown_place(
                self.span,
                "a canned cycle, and where the tool is above the part is not known ahead of time",
            )
            .help(
                "program the axis of the tool absolute before the cycle (G43 H1 Z50.), behind the last change of tool \
                 or offset, or write G99 with R in G90",
            )
        })
    }

    /// The zero point is another, and what the initial level is there is not known.
    pub fn forget_initial(&mut self) {
        self.initial = None;
    }
}

impl Interpreter<'_> {
    /// A block with the G function of a cycle.
    pub(super) fn define_cycle(&mut self, words: &mut BlockWords, g: At<u32>, block: Span) -> Done {
        self.control.refuse_compensation(g.span, "a canned cycle")?;
        let [_, _, normal] = self.control.modal.plane.axes();
        let At { value: code, span } = g;
        self.cycle = Some(match self.cycle.take() {
            Some(old) => Cycle {
                code,
                span,
                own_dwell: old.own_dwell && old.code == code,
                ..old
            },
            None => Cycle {
                code,
                initial: self.control.present(normal),
                return_level: None,
                bottom: None,
                step: None,
                dwell: 0.0,
                dwell_at: None,
                own_dwell: false,
                shift: [0.0; 2],
                span,
            },
        });
        self.cycle_block(words, block)
    }

    /// A block while a cycle is in force: it runs if the block names a place, or its levels.
    pub(super) fn cycle_block(&mut self, words: &mut BlockWords, block: Span) -> Done {
        let Some(mut cycle) = self.cycle.take() else {
            return Ok(());
        };
        let [_, _, normal] = self.control.modal.plane.axes();
        let incremental = self.control.modal.incremental;
        let runs = words.first_axis().is_some() || words.radius.is_some();
        let level = |word: At<f64>| Level {
            value: word.value,
            incremental,
        };
        cycle.bottom = words.axes[normal].take().map(level).or(cycle.bottom);
        cycle.return_level = words.radius.take().map(level).or(cycle.return_level);
        cycle.step = words.q.take().or(cycle.step);
        let dwell_at = words.p.map(|word| word.span);
        if let Some(dwell) = self.take_dwell(words)? {
            cycle.dwell = dwell;
            cycle.dwell_at = dwell_at;
            cycle.own_dwell = true;
        }
        self.read_shift(words, &mut cycle)?;
        let times = repeats(words)?;
        self.cycle = Some(cycle);
        if !runs {
            return match times {
                None => Ok(()),
                Some(times) => Err(Diagnostic::error(
                    times.span,
                    "nothing is repeated in this block",
                )
                .help("K repeats the hole at the place that its block names")),
            };
        }
        let times = times.map_or(1, |times| times.value);
        let motion = self.motion_words(words);
        if self.polar.is_none() {
            return self.run_cycle_at(&motion, times, block);
        }
        // An increment of the angle leads elsewhere each time.
        for _ in 0..times.max(1) {
            let mut place = motion;
            self.resolve_polar(&mut place, block)?;
            self.run_cycle_at(&place, times.min(1), block)?;
        }
        Ok(())
    }

    /// I and J of fine boring (G76), and the first and second axis of its plane.
    fn read_shift(&self, words: &mut BlockWords, cycle: &mut Cycle) -> Done {
        if cycle.code != 760 {
            return Ok(());
        }
        let [first, second, _] = self.control.modal.plane.axes();
        let given = [first, second].map(|axis| words.centre[axis].take());
        for (along, word) in cycle.shift.iter_mut().zip(given) {
            *along = word.map_or(*along, |word| word.value);
        }
        Ok(())
    }

    /// `times` holes at a place.
    pub(super) fn run_cycle_at(&mut self, motion: &MotionWords, times: u32, block: Span) -> Done {
        // K0 keeps the data of the cycle and does nothing.
        if times == 0 {
            return self.skip_place(motion, block);
        }
        self.check_skipped(motion, block)?;
        self.control.refuse_compensation(block, "a canned cycle")?;
        self.control.begin_cycle();
        for _ in 0..times {
            if !self.control.count_block(block) {
                return Ok(());
            }
            if motion.names_an_axis() {
                self.check_settled_motion(motion, block)?;
                self.rapid(motion, block)?;
            }
            self.drill()?;
        }
        self.control.end_cycle();
        Ok(())
    }

    /// To the place of a hole: rapid, whatever motion is in force.
    pub(super) fn rapid(&mut self, motion: &MotionWords, block: Span) -> Done {
        let before = self.control.modal.motion.replace(Motion::Rapid);
        let done = self.control.motion(motion, block, false, false);
        self.control.modal.motion = before;
        done
    }

    /// The levels of a hole.
    pub(super) fn hole(&self, cycle: &Cycle) -> Result<Hole, Diagnostic> {
        let missing = |what: &str| {
            Diagnostic::error(cycle.span, format!("{} needs {what}", g_name(cycle.code))).help(
                format!("write {} X10. Y10. Z-5. R2. F100.", g_name(cycle.code)),
            )
        };
        let top = cycle
            .return_level
            .ok_or_else(|| missing("the return level R"))?;
        let top = match top.incremental {
            true => cycle.initial()? + top.value,
            false => top.value,
        };
        let bottom = cycle.bottom.ok_or_else(|| missing("the bottom Z"))?;
        let bottom = match bottom.incremental {
            true => top + bottom.value,
            false => bottom.value,
        };
        if bottom >= top {
            return Err(Diagnostic::error(
                cycle.span,
                format!("the bottom {bottom} is not below R, {top}"),
            )
            .help("check Z and R; in G91 Z counts from R, and R from the level before the cycle"));
        }
        Ok(Hole { top, bottom })
    }
}

/// K, or L of older controls.
fn repeats(words: &mut BlockWords) -> Result<Option<At<u32>>, Diagnostic> {
    let word = match (words.centre[2].take(), words.l.take()) {
        (Some(_), Some(l)) => {
            return Err(Diagnostic::error(l.span, "K and L both say how often")
                .help("leave one of them out"));
        }
        (k, l) => k.or(l),
    };
    match word {
        None => Ok(None),
        Some(At { value, span })
            if value.fract() == 0.0 && (0.0..=REPEAT_LIMIT).contains(&value) =>
        {
            Ok(Some(At {
                value: value as u32,
                span,
            }))
        }
        Some(At { span, .. }) => Err(Diagnostic::error(
            span,
            "K is how often the hole is repeated: a whole number up to 9999",
        )),
    }
}
