//! Feed, speed, tool, plane, offsets, compensation, corners: modes of the control.

use super::own_m::linuxcnc_m;
use super::words::At;
use super::{Control, Done};
use crate::diagnostics::Diagnostic;
use crate::program::{Action, Compensation, Coolant, FeedMode, Plane, Spindle};
use crate::source::Span;

impl Control<'_> {
    /// LinuxCNC cannot change frames, offsets, planes or tools under cutter compensation.
    pub fn refuse_compensation(&self, span: Span, what: &str) -> Done {
        if self.modal.compensation == Compensation::Off {
            return Ok(());
        }
        Err(
            Diagnostic::error(span, format!("{what} while cutter compensation is on"))
                .help("end the compensation with G40 before"),
        )
    }

    /// G93 to G95.
    pub fn feed_mode(&mut self, mode: FeedMode) {
        if mode == self.modal.feed_mode && self.modal.feed.is_some() {
            // LinuxCNC would forget F.
            return;
        }
        if mode != self.modal.feed_mode {
            self.modal.feed_mode = mode;
            // A number that meant mm/min must not go on as mm per revolution.
            self.modal.has_feed = false;
            self.modal.feed = None;
        }
        self.actions.push(Action::FeedMode(mode));
    }

    /// F, in units of the program.
    pub fn feed(&mut self, feed: At<f64>) -> Done {
        if feed.value <= 0.0 {
            return Err(Diagnostic::error(feed.span, "the feed must be above 0"));
        }
        let factor = match self.modal.feed_mode {
            FeedMode::InverseTime => 1.0,
            FeedMode::PerMinute | FeedMode::PerRevolution => self.modal.feed_factor,
        };
        self.feed_again(feed.value * factor);
        Ok(())
    }

    /// A feed that has been in force before, in machine units: the program may have changed its unit since.
    pub fn feed_again(&mut self, feed: f64) {
        self.modal.has_feed = true;
        self.modal.feed = Some(feed);
        self.actions.push(Action::Feed(feed));
    }

    /// S, revolutions per minute.
    pub fn speed(&mut self, speed: At<f64>) -> Done {
        if speed.value < 0.0 {
            return Err(
                Diagnostic::error(speed.span, "the spindle speed cannot be negative")
                    .help("M4 turns the other way"),
            );
        }
        if self.modal.surface_speed {
            self.end_surface_speed();
        }
        self.modal.spindle_speed = Some(speed.value);
        self.actions.push(Action::SpindleSpeed(speed.value));
        Ok(())
    }

    /// T by its number.
    pub fn tool(&mut self, number: f64, span: Span) -> Done {
        if number.fract() != 0.0 || !(0.0..=99999.0).contains(&number) {
            return Err(Diagnostic::error(
                span,
                format!("{number} is not the number of a tool"),
            ));
        }
        self.select_tool(number as u32);
        Ok(())
    }

    /// M6. With `with_length` the length of the new tool is compensated at once.
    pub fn tool_change(&mut self, span: Span, with_length: bool) -> Done {
        self.refuse_compensation(span, "the tool changes")?;
        self.modal.change_offset([true; 9]);
        self.actions.push(Action::ToolChange);
        self.tools.change();
        // LinuxCNC stops the spindle.
        if let Some(turning @ (Spindle::Clockwise | Spindle::Counterclockwise)) = self.modal.spindle
        {
            self.modal.spindle_before_change = Some(turning);
            self.modal.spindle = Some(Spindle::Stop);
        }
        if with_length {
            self.actions.push(Action::ToolLength(true));
        }
        Ok(())
    }

    /// The M functions of a block in the order in which controls and LinuxCNC execute them: tool change,
    /// spindle, coolant, others.
    pub fn in_order(m: &[At<u32>]) -> Vec<At<u32>> {
        let mut list = m.to_vec();
        list.sort_by_key(|m| match m.value {
            6 => 0,
            3..=5 => 1,
            7..=9 => 2,
            _ => 3,
        });
        list
    }

    /// M3 to M5, M7 to M9; `false` for any other number.
    pub fn switch(&mut self, m: u32) -> bool {
        self.actions.push(match m {
            3 => Action::Spindle(Spindle::Clockwise),
            4 => Action::Spindle(Spindle::Counterclockwise),
            5 => Action::Spindle(Spindle::Stop),
            7 => Action::Coolant(Coolant::Mist),
            8 => Action::Coolant(Coolant::Flood),
            9 => Action::Coolant(Coolant::Off),
            _ => return false,
        });
        if let Some(Action::Spindle(spindle)) = self.actions.last() {
            self.modal.spindle = Some(*spindle);
            self.modal.spindle_before_change = None;
        }
        true
    }

    /// Whether the operator's overrides act from here on. Under cutter compensation LinuxCNC switches
    /// nothing, not even to what is in force.
    pub fn overrides(&mut self, on: bool, span: Span) -> Done {
        let compensated = self.modal.compensation != Compensation::Off;
        if compensated && on == self.modal.overrides {
            return Ok(());
        }
        self.refuse_compensation(span, "the overrides are switched")?;
        self.modal.overrides = on;
        self.actions.push(Action::Overrides(on));
        Ok(())
    }

    /// The overrides are off while a tap is cut with feed. Where the program has switched them off itself,
    /// they stay so behind it.
    pub fn begin_tap_without_overrides(&mut self) {
        if self.modal.overrides {
            self.actions.push(Action::Overrides(false));
        }
    }

    /// The tap is cut; see [`Control::begin_tap_without_overrides`].
    pub fn end_tap_without_overrides(&mut self) {
        if self.modal.overrides {
            self.actions.push(Action::Overrides(true));
        }
    }

    /// An M function that neither the dialect nor LinuxCNC defines: passed on if the settings say so.
    pub fn other_m(&mut self, m: u32, span: Span) -> Done {
        if !self.settings.passed_m.contains(&m) {
            let help = match linuxcnc_m(m) {
                Some(meaning) => format!(
                    "to LinuxCNC it is something of its own ({meaning}): take it out, or write what it is to do \
                     with an M function of the user, M100 to M199"
                ),
                None => format!("if LinuxCNC has it on this machine, give --pass-m {m}"),
            };
            return Err(Diagnostic::error(span, format!("M{m} is not defined")).help(help));
        }
        self.actions.push(Action::OtherM(m));
        Ok(())
    }

    /// Tool length compensation of the tool in the spindle, on or off.
    pub fn tool_length(&mut self, on: bool, span: Span) -> Done {
        self.refuse_compensation(span, "the tool offset changes")?;
        let axes = self.axes_of_tool_offsets();
        self.modal.change_offset(axes);
        if !matches!(self.actions.last(), Some(Action::ToolLength(last)) if *last == on) {
            self.states.push(Action::ToolLength(on));
        }
        Ok(())
    }

    /// Length and radius by a row of the tool table; 0 for none.
    pub fn tool_offset(&mut self, number: u32, span: Span) -> Done {
        if number == 0 {
            return self.tool_length(false, span);
        }
        self.refuse_compensation(span, "the tool offset changes")?;
        let axes = self.axes_of_tool_offsets();
        self.modal.change_offset(axes);
        self.states.push(Action::ToolOffset(number));
        Ok(())
    }

    /// The row of the tool table that G41 and G42 take the radius from; 0 for none at all, `None` for that
    /// of the tool in the spindle. LinuxCNC takes D0 for the tool in the spindle: without a radius the
    /// diameter is given instead.
    pub fn radius_of_row(&mut self, row: Option<u32>) {
        let none = (row == Some(0)).then_some(0.0);
        self.states.push(Action::RadiusRow(row));
        self.states.push(Action::CutterDiameter(none));
    }

    /// G17 to G19.
    pub fn plane(&mut self, plane: Plane, span: Span) -> Done {
        if plane != self.modal.plane {
            self.refuse_compensation(span, "the plane changes")?;
            self.modal.plane = plane;
        }
        self.states.push(Action::Plane(plane));
        Ok(())
    }

    /// G40 to G42 of a block; `false` where nothing changes. LinuxCNC cannot switch on what is on: the
    /// same side again is left out, the other side is refused.
    pub fn switch_compensation(
        &mut self,
        compensation: At<Compensation>,
    ) -> Result<bool, Diagnostic> {
        let At { value, span } = compensation;
        if value != Compensation::Off {
            if value == self.modal.compensation {
                return Ok(false);
            }
            self.refuse_compensation(span, "the other side")?;
        }
        self.compensation(value, span)?;
        Ok(true)
    }

    /// G40 to G42.
    pub fn compensation(&mut self, compensation: Compensation, span: Span) -> Done {
        if compensation != Compensation::Off {
            self.refuse_compensation_plane(span, "cutter compensation")?;
        }
        let before = std::mem::replace(&mut self.modal.compensation, compensation);
        self.states.push(Action::Compensation(compensation));
        match (before, compensation) {
            (Compensation::Off, Compensation::Off) => {}
            (Compensation::Off, _) => self.hold_path_control(),
            (_, Compensation::Off) => self.release_path_control(),
            _ => {}
        }
        Ok(())
    }

    /// LinuxCNC compensates the radius of the cutter in G17 and G18 only. `what` needs it.
    pub fn refuse_compensation_plane(&self, span: Span, what: &str) -> Done {
        if self.modal.plane != Plane::Yz {
            return Ok(());
        }
        Err(
            Diagnostic::error(span, format!("{what} in the plane of G19")).help(
                "LinuxCNC compensates in G17 and G18 only: post the path of the tool's centre",
            ),
        )
    }

    /// Work offset 1 to 9: G54 to G59.3 of LinuxCNC.
    pub fn work_offset(&mut self, system: u8, span: Span) -> Done {
        self.refuse_compensation(span, "the work offset changes")?;
        self.modal.select_work_offset(system);
        self.states.push(Action::WorkOffset(system));
        Ok(())
    }

    /// A pause in seconds.
    pub fn dwell(&mut self, seconds: f64, span: Span) -> Done {
        if seconds < 0.0 {
            return Err(Diagnostic::error(span, "a dwell cannot be negative"));
        }
        self.actions.push(Action::Dwell(seconds));
        Ok(())
    }

    /// `what` waits for the operator; where it is `optional`, only with the optional stop on. LinuxCNC finishes the
    /// compensated path before it, although the next element is not known yet: the tool would go to beside the end
    /// of the last one, in an inside corner into the wall.
    ///
    /// # Errors
    ///
    /// Under cutter compensation, from the way onto the contour on.
    pub fn pause(&mut self, optional: bool, span: Span, what: &str) -> Done {
        if self.is_on_contour() {
            return Err(Diagnostic::error(
                span,
                format!(
                    "{what} while cutter compensation is on: LinuxCNC ends the compensated path there, and the tool \
                     would go into an inside corner"
                ),
            )
            .help("lead the tool off the contour and end the compensation with G40 before it"));
        }
        self.actions.push(Action::Pause { optional });
        Ok(())
    }

    /// F of G93 is the time of its whole block: it is that of no motion which is put before or behind it.
    pub fn refuse_inverse_time(&self, span: Span, what: &str) -> Done {
        if self.modal.feed_mode != FeedMode::InverseTime {
            return Ok(());
        }
        Err(
            Diagnostic::error(span, format!("{what} with feed in inverse time (G93)"))
                .help("write G94 and a feed per minute before"),
        )
    }

    /// A motion with feed needs one. `has_own`: whether the block has an F.
    pub fn check_feed(&mut self, has_own: bool, span: Span) -> Done {
        self.check_kept_speed()?;
        let inverse = self.modal.feed_mode == FeedMode::InverseTime;
        if self.modal.has_feed && (!inverse || has_own) {
            return Ok(());
        }
        if let (Some(feed), FeedMode::PerMinute) = (self.settings.feed, self.modal.feed_mode) {
            self.modal.has_feed = true;
            self.modal.feed = Some(feed);
            self.actions.push(Action::Feed(feed));
            return Ok(());
        }
        // Said once; the blocks after it have the same fault.
        self.modal.has_feed = true;
        Err(
            Diagnostic::error(span, "a motion with feed, and no F is in force").help(
                match inverse {
                    true => "with G93 every block needs its own F",
                    false => "add F to this block, in mm/min unless G95 says otherwise",
                },
            ),
        )
    }
}
