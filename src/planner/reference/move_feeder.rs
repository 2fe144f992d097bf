//! From the queue to the path: moves are added as they arrive, and it is known when nothing more is to
//! be expected.

use super::outlook::Outlook;
use super::supply_depth::{Expected, SupplyDepth};
use crate::moves::{MotionType, Move, SynchronisationMode, TerminationCondition};
use crate::path::{BlendError, BlendedPath, ProgrammedMove};
use crate::planner::move_jerk;

/// Moves that are added to the path in a cycle at most. LinuxCNC sends one a cycle; more wait only
/// after a rest that dropped the path.
const MOVES_A_CYCLE: usize = 16;

/// Seconds without a move after which nothing more is expected, where moves came fast.
const SHORTEST_SILENCE: f64 = 8e-3;
/// A move is overdue after so many times the mean time between two.
const OVERDUE: f64 = 1.5;
/// Where they came slowly, nothing more is expected after so many times that.
const SILENCE: f64 = 3.0;
/// And at most, seconds.
const LONGEST_SILENCE: f64 = 0.5;

/// So many moves in a row came when the machine rested at the end of the one before: the next one is not waited for longer than this,
/// seconds, when such a move has come.
const LONE_MOVES: u32 = 3;
const LONE_SILENCE: f64 = 2e-3;

/// Where moves come slowly, the next one is not waited for if so many like those before would not make final what is not.
const IN_VAIN: f64 = 50.0;

/// The share of a new interval in the mean one, where it is shorter than that ..
const FORGETTING: f64 = 0.25;
/// .. and where it is longer.
const LEARNING: f64 = 0.5;

/// What of the queue is on the path.
#[derive(Debug)]
pub(super) struct MoveFeeder {
    /// Serial number of the first move of the path.
    first: u64,
    /// Serial number of the next move to be added.
    next: u64,
    /// Whether the path ends with its first move.
    single: bool,
    /// Whether the path has to end before the next move.
    barred: bool,
    /// How many paths of a single move were before this one, without any other in between.
    lone_moves: u32,
    /// Seconds since the last move came.
    silence: f64,
    /// Seconds between two moves, in the mean.
    interval: f64,
    /// The same on this path: its shape depends on nothing that was before.
    own_interval: f64,
    /// Path distances when the last move came: where the path ended with it, and up to where it was final.
    added_end: f64,
    final_end: f64,
    /// By how much each move makes the path longer, in the mean, and by how much more of it was final than when the one before
    /// came.
    length: f64,
    gain: f64,
    /// How many moves are queued where no more come.
    depth: SupplyDepth,
    /// What the last move added was like.
    kind: Kind,
    /// What no axis may exceed in it.
    axis_jerk: f64,
    /// And what it was coupled to.
    coupling: Coupling,
}

/// What tells moves apart that are not to be merged.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Kind {
    rapid: bool,
    overridden: bool,
    probes: bool,
    /// Feed or pitch for a turn of the spindle, 0 without.
    per_turn: f64,
}

/// What a move is coupled to: from one to another the machine comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Coupling {
    /// Time only.
    None,
    /// The speed of a spindle (its number), which may change to and from time.
    Speed(usize),
    /// The angle of a spindle (its number).
    Thread(usize),
    /// By itself: a rigid tap, or a move of a locking indexer.
    Alone,
}

impl Coupling {
    fn of(queued: &Move) -> Self {
        match queued.synchronisation {
            _ if queued.indexer_joint.is_some() => Self::Alone,
            None => Self::None,
            Some(with) => match with.mode {
                SynchronisationMode::Speed => Self::Speed(with.spindle),
                SynchronisationMode::Thread { .. } => Self::Thread(with.spindle),
                SynchronisationMode::Tap { .. } => Self::Alone,
            },
        }
    }

    /// Whether the machine may pass from a move of this kind to one of the next without a rest.
    fn passes_to(self, next: Self) -> bool {
        match (self, next) {
            (Self::Alone, _) | (_, Self::Alone) => false,
            (Self::None, Self::Speed(_)) | (Self::Speed(_), Self::None) => true,
            (a, b) => a == b,
        }
    }
}

impl MoveFeeder {
    pub const fn new() -> Self {
        Self {
            first: 0,
            next: 0,
            single: false,
            barred: false,
            lone_moves: 0,
            silence: 0.0,
            interval: 0.0,
            own_interval: 0.0,
            added_end: 0.0,
            final_end: 0.0,
            length: f64::INFINITY,
            gain: f64::INFINITY,
            depth: SupplyDepth::new(),
            kind: Kind {
                rapid: false,
                overridden: false,
                probes: false,
                per_turn: 0.0,
            },
            axis_jerk: f64::INFINITY,
            coupling: Coupling::None,
        }
    }

    /// Begins with a move. `single`: and ends with it.
    pub fn restart(&mut self, first: u64, single: bool) {
        // How moves come does not depend on where the path begins.
        let depth = core::mem::replace(&mut self.depth, SupplyDepth::new());
        *self = Self {
            first,
            next: first,
            single,
            lone_moves: if self.has_one_move() {
                self.lone_moves.saturating_add(1)
            } else {
                0
            },
            interval: self.interval,
            depth,
            ..Self::new()
        };
    }

    /// Serial number of the first move that is not on the path.
    pub fn next(&self) -> u64 {
        self.next
    }

    /// Whether the path ends with its first move.
    pub fn is_single(&self) -> bool {
        self.single
    }

    /// Whether the machine has to come to rest at the end of the path.
    pub fn is_barred(&self) -> bool {
        self.barred
    }

    /// Whether the next move is overdue, or not to be expected within `seconds`.
    pub fn is_late(&self, seconds: f64) -> bool {
        let overdue = self.silence >= OVERDUE * self.interval;
        let far = self.interval - self.silence > seconds;
        self.silence >= SHORTEST_SILENCE && (overdue || far)
    }

    /// Whether the next move, however soon it comes, would not help a machine that is short of path: moves come slowly and are
    /// short, and hardly any more of it became final with the last one, while as much as `lack` of what has come is not.
    pub fn comes_in_vain(&self, lack: f64) -> bool {
        let slowly = self.own_interval >= SHORTEST_SILENCE && self.silence >= SHORTEST_SILENCE;
        slowly && self.length.max(self.gain) * IN_VAIN < lack
    }

    /// Whether moves come so slowly that the machine may have to wait for the next one.
    pub fn is_slow(&self) -> bool {
        let interval = self.own_interval.max(self.silence);
        self.expected() != Expected::Anything || interval >= SHORTEST_SILENCE
    }

    /// Whether there are several moves, and they came without a pause.
    pub fn came_at_once(&self) -> bool {
        self.next > self.first + 1 && self.own_interval < SHORTEST_SILENCE
    }

    /// Whether no move came in this servo period, nor in the one before.
    pub fn pauses(&self, period: f64) -> bool {
        self.silence > 1.5 * period
    }

    /// Whether nothing more is to be expected for a while.
    pub fn is_silent(&self) -> bool {
        self.is_silent_beyond(0.0)
    }

    /// Whether that has been so for `seconds`.
    pub fn is_silent_beyond(&self, seconds: f64) -> bool {
        let silence = if self.lone_moves >= LONE_MOVES && self.has_one_move() {
            LONE_SILENCE
        } else {
            let silence = (SILENCE * self.interval).min(LONGEST_SILENCE);
            silence.max(SHORTEST_SILENCE)
        };
        self.silence >= silence + seconds
    }

    /// Whether there is one move on the path.
    fn has_one_move(&self) -> bool {
        self.next == self.first + 1
    }

    /// Whether what comes next is in time for a machine that is held, however late it is. A thread or a tap is ready when its
    /// spindle is.
    pub fn may_follow_while_held(&self) -> bool {
        let by_angle = matches!(self.coupling, Coupling::Thread(_) | Coupling::Alone);
        self.expected() == Expected::Anything && !self.barred && !by_angle
    }

    /// What the depth of the queue tells of the next move.
    pub fn expected(&self) -> Expected {
        self.depth.expected()
    }

    /// Adds what has come since the last cycle.
    ///
    /// # Errors
    /// A move that the path refuses for another reason than lack of room.
    pub fn feed(&mut self, path: &mut BlendedPath, outlook: &Outlook) -> Result<(), BlendError> {
        self.silence += outlook.now.period;
        let queue = outlook.queue;
        self.depth.look(queue.first_serial(), queue.len());
        let before = self.next;
        for _ in 0..MOVES_A_CYCLE {
            let Some(queued) = outlook.queue.released(self.next) else {
                break;
            };
            let follows = self.next != self.first;
            let coupling = Coupling::of(queued);
            let passes = self.coupling.passes_to(coupling);
            let other_jerk = !move_jerk::is_same(queued.axis_jerk, self.axis_jerk);
            self.barred =
                follows && (self.single || queued.wait_for_spindle || !passes || other_jerk);
            if self.barred {
                break;
            }
            match path.add(&self.programmed(queued, follows, outlook)) {
                Ok(()) => {}
                Err(BlendError::Full) => {
                    self.silence = 0.0;
                    break;
                }
                Err(error) => return Err(error),
            }
            self.kind = kind(queued);
            self.axis_jerk = queued.axis_jerk;
            self.coupling = coupling;
            if follows {
                let gap = self.silence.min(LONGEST_SILENCE);
                for interval in [&mut self.interval, &mut self.own_interval] {
                    let share = if gap > *interval {
                        LEARNING
                    } else {
                        FORGETTING
                    };
                    *interval += share * (gap - *interval);
                }
            }
            self.next += 1;
            self.silence = 0.0;
        }
        self.barred |= self.single && self.next != self.first;
        if self.next != before {
            self.measure_path(path);
        }
        Ok(())
    }

    /// Moves came: how much of the path they are, and how much the one before has made final.
    fn measure_path(&mut self, path: &BlendedPath) {
        let (added, known) = (path.added_end(), path.final_end());
        let length = added - self.added_end;
        if self.length.is_finite() {
            self.length += FORGETTING * (length - self.length);
        } else if self.added_end > 0.0 {
            // The first move of a path is like no other.
            self.length = length;
        }
        self.gain = known - self.final_end;
        (self.added_end, self.final_end) = (added, known);
    }

    /// A move as the path takes it.
    fn programmed(&self, queued: &Move, follows: bool, outlook: &Outlook) -> ProgrammedMove {
        let feed = queued.feed.min(queued.max_velocity);
        let new = kind(queued);
        // Feed per turn may be raised by the spindle as well.
        let raisable = new.overridden || queued.synchronisation.is_some();
        let greatest_feed = if raisable && !new.rapid {
            queued.max_velocity
        } else {
            feed
        };
        ProgrammedMove {
            serial: self.next,
            shape: queued.shape,
            feed,
            feed_word: queued.feed_word,
            greatest_feed,
            termination: match queued.termination {
                TerminationCondition::Continuous { tolerance } => {
                    TerminationCondition::Continuous {
                        tolerance: tolerance.min(outlook.now.greatest_tolerance),
                    }
                }
                other => other,
            },
            // A probing move may end anywhere.
            stop_before: follows && (new.probes || self.kind.probes),
            separate: !queued.outputs.is_empty() || new != self.kind,
            may_swing_out: queued.synchronisation.is_none(),
            near_limit: queued.near_limit,
        }
    }
}

fn kind(queued: &Move) -> Kind {
    Kind {
        rapid: queued.motion_type.is_rapid(),
        overridden: queued.override_enabled(),
        probes: queued.motion_type == MotionType::Probing,
        per_turn: queued.synchronisation.map_or(0.0, |with| with.per_turn),
    }
}
