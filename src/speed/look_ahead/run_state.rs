//! How far a run from rest to rest has come.

/// Seconds behind the frozen part at which a candidate leaves the plan: more after each one that the
/// machine has overtaken.
pub(super) const SHORTEST_LEAD: f64 = 16e-3;

/// What the planner keeps in mind besides the plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct RunState {
    /// Whether a candidate is being made.
    pub candidate_begun: bool,
    /// The next interval to be frozen.
    pub next: usize,
    /// The time at which it starts.
    pub frozen_time: f64,
    /// Intervals before this one have been refined.
    pub refined: usize,
    /// The first interval that the last step of the refinement might change.
    pub paced: usize,
    /// Steps of the refinement since the plan or its caps changed.
    pub fresh_steps: u32,
    /// What the end of the plan hardly influences any more.
    pub settled: usize,
    /// Where the braking to the final rest begins.
    pub braking: usize,
    /// Seconds from the frozen part until then, as far as anybody asks.
    pub braking_in: f64,
    /// Up to this interval its seconds are counted in that.
    pub counted: usize,
    /// What the program's speeds are multiplied by.
    pub raise: f64,
    /// Share of them for a first plan that was refused otherwise.
    pub slower: f64,
    /// The length of the intervals of the last candidate, in the mean.
    pub spacing: f64,
    /// The length that was known in the slice before the first plan.
    pub seen: f64,
    /// Slices since more of it became known.
    pub quiet: u32,
    /// Seconds behind the frozen part at which a candidate leaves the plan at the earliest.
    pub lead: f64,
    /// How often a candidate was refused since one was adopted.
    pub failures: u32,
    /// Slices until the next extension may be tried.
    pub pause: u32,
    /// Slices since the last extension.
    pub waited: u32,
    /// Steps of the refinement since the last extension.
    pub steps: u32,
}

impl RunState {
    /// At rest, nothing planned.
    pub const AT_REST: Self = Self {
        candidate_begun: false,
        next: 0,
        frozen_time: 0.0,
        refined: 1,
        paced: 0,
        fresh_steps: 0,
        settled: 1,
        braking: 1,
        braking_in: 0.0,
        counted: 0,
        raise: 1.0,
        slower: 1.0,
        spacing: 0.0,
        seen: 0.0,
        quiet: 0,
        lead: SHORTEST_LEAD,
        failures: 0,
        pause: 0,
        waited: 0,
        steps: 0,
    };
}
