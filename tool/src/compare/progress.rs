//! How far a comparison is, on a terminal.

use crate::format::time_left;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt;

/// Steps of the bar in a run: half of them for the run itself, half for its optimum.
const STEPS: u64 = 1000;

/// A bar on standard error; nothing if that is no terminal.
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// For so many runs.
    pub(super) fn new(runs: usize) -> Self {
        let bar =
            ProgressBar::with_draw_target(Some(runs as u64 * STEPS), ProgressDrawTarget::stderr());
        let template = "{msg}  {bar:30} {percent:>3} %  {elapsed}{left}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            // The bar's own estimate is 0 s until the first run is done.
            bar.set_style(style.with_key("left", write_left));
        }
        bar.set_message("comparing");
        Progress(bar)
    }

    /// What runs now.
    pub(super) fn name(&self, name: &str) {
        self.0.set_message(name.to_owned());
    }

    /// A run is done, with its optimum if one was asked for.
    pub(super) fn run_done(&self) {
        let runs = self.0.position() / STEPS + 1;
        self.0.set_position(runs * STEPS);
    }

    /// So many runs will not be needed.
    pub(super) fn runs_left_out(&self, count: usize) {
        let length = self.0.length().unwrap_or(0);
        self.0
            .set_length(length.saturating_sub(count as u64 * STEPS));
    }

    /// The optimum of this run is found for a share of it.
    #[cfg(feature = "optimum")]
    pub(super) fn optimum_done(&self, share: f64) {
        let start = self.0.position() / STEPS * STEPS;
        let within = 0.5 + 0.49 * share.clamp(0.0, 1.0);
        self.0.set_position(start + (within * STEPS as f64) as u64);
    }

    /// Writes to standard output meanwhile.
    pub(super) fn suspend<T>(&self, write: impl FnOnce() -> T) -> T {
        self.0.suspend(write)
    }

    pub(super) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

fn write_left(state: &ProgressState, out: &mut dyn fmt::Write) {
    let left = time_left(state.elapsed(), state.pos(), state.len().unwrap_or(0));
    // Nothing can be done about a terminal that takes none.
    let _ = out.write_str(&left);
}
