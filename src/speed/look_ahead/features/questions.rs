//! What is asked of the features around a place.

use super::super::feature::{Feature, GROWTH};
use super::groups::FeatureGroup;
use crate::lanes::lesser;

/// A question that features are asked from a place on, to one side and then to the other.
pub(super) trait Question {
    /// Whether a feature of this group may change the answer.
    fn concerns(&self, group: &FeatureGroup) -> bool;
    /// Whether neither this feature nor any behind it may.
    fn ends_behind(&self, feature: &Feature) -> bool;
    /// Whether neither this feature nor any before it may.
    fn ends_before(&self, feature: &Feature) -> bool;
    fn ask(&mut self, feature: &Feature);
}

/// The least spacing at `s`, and whether it lies in a change of shape.
pub(super) struct SpacingAsked {
    pub s: f64,
    /// No feature begins farther before its center ..
    pub before: f64,
    /// .. or ends farther behind it.
    pub behind: f64,
    pub least: f64,
    pub within: bool,
}

impl Question for SpacingAsked {
    fn concerns(&self, group: &FeatureGroup) -> bool {
        // Nowhere does one ask for less than within.
        group.spacing < self.least || !self.within && group.start <= self.s && self.s < group.end
    }

    fn ends_behind(&self, feature: &Feature) -> bool {
        GROWTH / (1.0 + GROWTH) * (feature.center - self.before - self.s) > self.least
    }

    fn ends_before(&self, feature: &Feature) -> bool {
        GROWTH * (self.s - feature.center - self.behind) > self.least
    }

    fn ask(&mut self, feature: &Feature) {
        let s = self.s;
        if feature.spacing < self.least {
            self.least = lesser(self.least, feature.spacing_at(s));
        }
        self.within = self.within || feature.speed > 0.0 && feature.start <= s && s < feature.end;
    }
}

/// The least spacing of the changes of shape between two places, or infinity.
pub(super) struct FinestAsked {
    pub from: f64,
    pub to: f64,
    /// Beyond both by so much they count, too.
    pub beside: f64,
    /// No feature begins farther before its center.
    pub before: f64,
    pub finest: f64,
}

impl Question for FinestAsked {
    fn concerns(&self, group: &FeatureGroup) -> bool {
        group.shape_spacing < self.finest
            && self.to > group.start - self.beside
            && self.from < group.end + self.beside
    }

    fn ends_behind(&self, feature: &Feature) -> bool {
        feature.center - self.before >= self.to + self.beside
    }

    fn ends_before(&self, _: &Feature) -> bool {
        true
    }

    fn ask(&mut self, feature: &Feature) {
        if feature.spacing < self.finest
            && feature.speed > 0.0
            && self.to > feature.start - self.beside
            && self.from < feature.end + self.beside
        {
            self.finest = feature.spacing;
        }
    }
}

/// About the most that v^2 can be at `s`, with this acceleration between there and where the features are at their limit
/// speeds.
pub(super) struct GreatestSpeedAsked {
    pub s: f64,
    pub acceleration: f64,
    /// No feature is at its limit speed farther from its center.
    pub widest: f64,
    pub least: f64,
}

impl Question for GreatestSpeedAsked {
    fn concerns(&self, group: &FeatureGroup) -> bool {
        // Nowhere does one allow less than in its middle.
        group.speed_squared < self.least
    }

    fn ends_behind(&self, feature: &Feature) -> bool {
        2.0 * self.acceleration * (feature.center - self.s - self.widest) > self.least
    }

    fn ends_before(&self, feature: &Feature) -> bool {
        2.0 * self.acceleration * (self.s - feature.center - self.widest) > self.least
    }

    fn ask(&mut self, feature: &Feature) {
        if feature.speed > 0.0 && feature.speed * feature.speed < self.least {
            let square = feature.greatest_speed_squared(self.s, self.acceleration);
            self.least = lesser(self.least, square);
        }
    }
}

/// The next place that a node should be on, near the end of an interval from `s` on.
pub(super) struct LandmarkAsked {
    pub s: f64,
    pub length: f64,
    best: Option<f64>,
    /// Where a change of shape with a jump begins.
    rise: Option<f64>,
}

impl LandmarkAsked {
    pub fn new(s: f64, length: f64) -> Self {
        Self {
            s,
            length,
            best: None,
            rise: None,
        }
    }

    /// What lies nearer to the start of the interval is none.
    pub fn nearest(&self) -> f64 {
        0.3 * self.length
    }

    /// Whether a feature that begins no farther than `before` from its center begins too far behind the interval.
    pub fn ends_behind(&self, feature: &Feature, before: f64) -> bool {
        feature.center - before - self.s >= 1.3 * self.length
    }

    fn is_near(&self, place: f64, nearest: f64) -> bool {
        place - self.s > nearest && place - self.s < 1.3 * self.length
    }

    fn consider(&mut self, place: f64, nearest: f64) {
        if self.is_near(place, nearest) && self.best.is_none_or(|other| place < other) {
            self.best = Some(place);
        }
    }

    /// Asks for the center of a feature.
    pub fn ask_center(&mut self, feature: &Feature) {
        self.consider(feature.center, self.nearest());
    }

    /// Asks for start, center and end of a change of shape that has none beside it.
    pub fn ask_alone(&mut self, feature: &Feature) {
        for place in [feature.start, feature.center, feature.end] {
            self.consider(place, self.nearest());
        }
    }

    /// Asks for the center and the ends of a feature with a jump, where a jump within `unseen` needs no node.
    ///
    /// The changes of shape at both ends of a short arc nearly cancel each other. Where they begin and end one after the
    /// other, the third derivative rises and falls within the length of the arc: a node belongs behind the rise, and before
    /// the fall.
    pub fn ask_jump(&mut self, feature: &Feature, unseen: f64) {
        let nearest = self.nearest();
        self.consider(feature.center, unseen.min(nearest));
        self.consider(feature.end, nearest);
        let place = feature.start;
        if self.is_near(place, nearest) {
            self.rise = Some(match self.rise {
                Some(other) if (place - other).abs() < nearest => place.max(other),
                Some(other) => place.min(other),
                None => place,
            });
        }
    }

    pub fn answer(&self) -> Option<f64> {
        self.best.into_iter().chain(self.rise).reduce(f64::min)
    }
}
