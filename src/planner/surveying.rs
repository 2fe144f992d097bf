//! How what an operator sees is found, servo period by servo period.

use super::inputs::CycleInputs;
use super::planner::Planner;
use super::reference::TimeAhead;
use super::servo::further_scale;
use super::speed_limit::{Asked, SpeedLimit};
use super::survey::{Survey, SurveyState};
use crate::moves::Move;

/// Servo periods after which the place of the end of the plan is looked up anew, where it seems to be the same.
const LOOK_UP_PERIODS: u32 = 32;

/// How much a new look at how much slower than its feed a program runs counts.
const LEARNING: f64 = 0.02;

/// Moves may take so many times as long as at their feeds.
const SLOWEST: f64 = 100.0;

/// Less than this at feed says nothing of how much slower a program runs, seconds.
const LEAST_SECONDS: f64 = 0.01;

impl Planner {
    /// Looks at what limits the machine and how far it sees. Once in each servo period, behind [`Planner::cycle`] and with
    /// the same inputs. Nothing that is run depends on it.
    pub fn survey(&mut self, inputs: &CycleInputs) -> &Survey {
        self.survey.last.limit = self.speed_limit(inputs);
        self.reference.sum_time();
        self.look_ahead();
        &self.survey.last
    }

    /// What [`Self::survey`] has found last.
    pub fn surveyed(&self) -> Survey {
        if self.queue.is_empty() {
            SurveyState::NONE.last
        } else {
            self.survey.last
        }
    }

    /// Whether the machine stands still.
    pub fn stands(&self) -> bool {
        self.queue.is_empty() || self.axis_motion.stands()
    }

    /// How many moves have left the queue since the start of the machine.
    pub fn moves_done(&self) -> u64 {
        self.queue.first_serial()
    }

    fn speed_limit(&mut self, inputs: &CycleInputs) -> SpeedLimit {
        let map = self.axes.map();
        let position = match map.joints() {
            Some(_) => self.status.position,
            None => map.apply(&self.status.position),
        };
        let Some(running) = self.queue.front() else {
            self.axis_motion.begin(&position);
            return SpeedLimit::Nothing;
        };
        self.axis_motion.pass(&position, self.period);
        if map.joints().is_some() {
            let joints = self.executor.motion();
            self.axis_motion.pass_joints(joints, self.period);
        }
        let waits = self.status.waiting_for_spindle || self.status.waiting_for_index;
        if self.status.following_spindle || waits {
            return SpeedLimit::Spindle;
        }
        if self.is_held(inputs) {
            return SpeedLimit::Hold;
        }
        if self.axis_motion.stands() {
            return SpeedLimit::Rest;
        }
        let asked = self.asked(inputs, running);
        let speed = self.status.current_velocity;
        let (limits, map) = (self.axes.limits(), self.axes.map());
        self.axis_motion.limit(speed, &asked, limits, map)
    }

    /// How fast the running move may be.
    fn asked(&self, inputs: &CycleInputs, running: &Move) -> Asked {
        let by_operator = running.override_of(inputs.feed_scale, inputs.rapid_scale);
        Asked {
            feed: self.spindle.feed(running),
            scale: by_operator * further_scale(inputs, Some(running), &self.status),
            greatest: running.max_velocity,
            slider: self.slider_for(Some(running)),
        }
    }

    /// How far the machine sees, and how long what is queued takes.
    fn look_ahead(&mut self) {
        let Some(running) = self.queue.front() else {
            let survey = &mut self.survey;
            (survey.slowness, survey.place) = (1.0, None);
            survey.last.moves_ahead = 0;
            (survey.last.seconds_ahead, survey.last.seconds_queued) = (0.0, 0.0);
            return;
        };
        let first = self.queue.first_serial();
        let TimeAhead { seconds, end } = self.reference.time_ahead();
        let survey = &mut self.survey;
        survey.age += 1;
        if end != survey.end || survey.age >= LOOK_UP_PERIODS {
            (survey.end, survey.age) = (end, 0);
            survey.place = self.reference.place_in_moves(&self.queue, end);
        }
        let left = running.feed.min(running.max_velocity);
        let left = self.status.distance_to_go / left;
        let queued = left + self.queue.seconds_at_feed_from(first + 1);
        let behind = match survey.place {
            Some(place) if seconds > 0.0 && place.serial >= first => {
                survey.last.moves_ahead = (place.serial - first + 1) as usize;
                let rest = self.queue.seconds_at_feed_from(place.serial + 1);
                let of_leg = self.queue.seconds_at_feed_from(place.first) - rest;
                rest + place.left * of_leg
            }
            _ => {
                survey.last.moves_ahead = 0;
                queued
            }
        };
        let ahead = queued - behind;
        if ahead > LEAST_SECONDS {
            let slowness = (seconds / ahead).clamp(1.0, SLOWEST);
            survey.slowness += LEARNING * (slowness - survey.slowness);
        }
        survey.last.seconds_ahead = seconds;
        survey.last.seconds_queued = seconds + behind.max(0.0) * survey.slowness;
    }
}
