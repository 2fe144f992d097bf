//! Features in a row, and what they say at the utmost: most of those around a place need not be asked one by one.

use super::super::feature::Feature;
use crate::lanes::{greater, lesser};

/// Features in a group.
pub(super) const GROUP: usize = 16;

/// As many features in a row as [`GROUP`], or those of them that there are so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct FeatureGroup {
    /// None of them asks for a smaller spacing.
    pub spacing: f64,
    /// No change of shape does.
    pub shape_spacing: f64,
    /// No change of shape has a lower limit speed; its square.
    pub speed_squared: f64,
    /// No change of shape begins before this ..
    pub start: f64,
    /// .. or ends behind it.
    pub end: f64,
    /// A bit for each that asks for nodes where it begins and ends, not only at its center.
    pub wide: u32,
}

impl FeatureGroup {
    pub const EMPTY: Self = Self {
        spacing: f64::INFINITY,
        shape_spacing: f64::INFINITY,
        speed_squared: f64::INFINITY,
        start: f64::INFINITY,
        end: f64::NEG_INFINITY,
        wide: 0,
    };

    /// Counts in what a feature says.
    pub fn add(&mut self, feature: &Feature) {
        self.spacing = lesser(self.spacing, feature.spacing);
        if feature.speed > 0.0 {
            self.shape_spacing = lesser(self.shape_spacing, feature.spacing);
            self.speed_squared = lesser(self.speed_squared, feature.speed * feature.speed);
            self.start = lesser(self.start, feature.start);
            self.end = greater(self.end, feature.end);
        }
    }

    /// Notes of the feature at this place whether its ends may ask for nodes.
    pub fn mark(&mut self, place: usize, feature: &Feature) {
        let bit = 1 << (place % GROUP);
        if feature.may_be_wide() {
            self.wide |= bit;
        } else {
            self.wide &= !bit;
        }
    }

    /// The first place from this one on, within the group, that is marked.
    pub fn marked_from(&self, place: usize) -> Option<usize> {
        let marks = self.wide >> (place % GROUP);
        (marks != 0).then(|| place + marks.trailing_zeros() as usize)
    }
}
